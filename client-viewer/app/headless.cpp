#include <array>
#include <chrono>
#include <cstdio>
#include <thread>

#include "app/clock_notes.hpp"
#include "app/presentation.hpp"
#include "app/report.hpp"
#include "app/run.hpp"
#include "renderer/gl_context.hpp"
#include "source/awaited.hpp"

namespace pelagos {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double kStatusWait = 2.0;      // s
constexpr double kClockWait = 2.0;       // s
constexpr double kMeshWait = 20.0;       // s
constexpr double kSpareForecast = 8e-3;  // s, for a machine with other work
// s, ahead of what is known: a forecast beyond delay and this would ask for instants after the schedule's limit.
constexpr double kLongestAhead = 0.1;

double seconds_between(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

/// The folder must take files before anything else is tried.
void prepare_folder(const std::filesystem::path& folder, const std::filesystem::path& report_file) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw OutputError("cannot make the folder " + folder.string() + ": " + error.message());
  write_file(report_file, "{}\n");
}

class HeadlessRun {
 public:
  HeadlessRun(const Options& options, const Channel& channel, FrameSource& source)
      : options_(options),
        source_(source),
        view_(source, channel,
              {options.width, options.height, channel.guard_px, options.quality, true, options.weather},
              options.assets / "meshes", options.delay),
        clock_notes_(source) {
    report_.channel = channel.name;
    report_.renderer = renderer_name();
    report_.width = options.width;
    report_.height = options.height;
  }

  int run(const std::atomic<bool>& stop);

 private:
  bool wait_for_server(const std::atomic<bool>& stop);
  bool wait_for_meshes(const std::atomic<bool>& stop);
  bool knows_status();
  bool knows_clock();
  void give_up();
  void watch_pause();
  void draw_frame();
  void show_at(std::int64_t moment_ns);
  void watch_server(Clock::time_point now);
  void save_picture();
  [[nodiscard]] bool done(Clock::time_point start) const;
  void finish();

  const Options& options_;
  FrameSource& source_;
  Presentation view_;
  RunReport report_;
  ClockNotes clock_notes_;
  SwapForecast forecast_;
  std::string swaps_ = "shown_ns,simulation_time_s,skew_ms\n";
  Clock::time_point first_drawn_{}, last_drawn_{}, last_saved_{}, lost_{};
  bool was_alive_ = true;
  std::optional<Clock::time_point> scene_came_, schedule_came_;
};

bool HeadlessRun::wait_for_server(const std::atomic<bool>& stop) {
  const auto start = Clock::now();
  std::string told;
  while (!stop) {
    view_.update();
    if (view_.ready() && knows_status() && knows_clock()) return wait_for_meshes(stop);
    const double waited = seconds_between(start, Clock::now());
    if (waited > options_.wait) return view_.ready();
    const std::string text = awaited(source_, options_.domain);
    if (waited > 1.0 && text != told) {
      std::fprintf(stderr, "pelagos-viewer: waiting for %s\n", text.c_str());
      told = text;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return false;
}

/// The first picture shows all bodies, unless their meshes take too long.
bool HeadlessRun::wait_for_meshes(const std::atomic<bool>& stop) {
  const auto start = Clock::now();
  while (!stop && !view_.has_meshes()) {
    if (seconds_between(start, Clock::now()) > kMeshWait) {
      std::fprintf(stderr, "pelagos-viewer: the meshes are not all read after %g s: drawing without\n", kMeshWait);
      return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    view_.update();
  }
  return !stop;
}

/// Whether the sea is paused must be known before the first picture; a server says so every second. For old servers it
/// is not waited long.
bool HeadlessRun::knows_status() {
  if (source_.status()) return true;
  if (!scene_came_) scene_came_ = Clock::now();
  return options_.synthetic || seconds_between(*scene_came_, Clock::now()) > kStatusWait;
}

/// Where the server sends a schedule, its clock will be known in a moment.
bool HeadlessRun::knows_clock() {
  const ClockState state = source_.clock_state();
  if (!state.scheduled || by_server(state.clock)) return true;
  if (!schedule_came_) schedule_came_ = Clock::now();
  return seconds_between(*schedule_came_, Clock::now()) > kClockWait;
}

/// A picture that is ready too early waits for the moment that it was drawn for, as it would for a screen.
void HeadlessRun::show_at(std::int64_t moment_ns) {
  const std::int64_t early = moment_ns - source_.now_ns();
  if (early > 0) std::this_thread::sleep_for(std::chrono::nanoseconds(early));
  const std::int64_t shown = source_.now_ns();
  view_.shown(shown);
  if (!options_.swaps) return;
  std::array<char, 96> line{};
  std::snprintf(line.data(), line.size(), "%lld,%.6f,%.3f\n", static_cast<long long>(shown), view_.time(),
                1e3 * view_.last_skew());
  swaps_ += line.data();
}

void HeadlessRun::draw_frame() {
  const auto start = Clock::now();
  // The longest of the last pictures: then hardly any is late.
  const double until_shown = std::min(1.1 * forecast_.seconds(1.0) + kSpareForecast, view_.delay() + kLongestAhead);
  const std::int64_t moment = source_.now_ns() + static_cast<std::int64_t>(1e9 * until_shown);
  view_.draw(moment);
  const auto end = Clock::now();
  forecast_.add(seconds_between(start, end));
  show_at(moment);
  clock_notes_.look(view_);
  report_.frame_ms_sum += 1e3 * seconds_between(start, end);
  for (std::size_t i = 0; i < kPassNames.size(); ++i) report_.pass_ms_sum[i] += view_.renderer().pass_times()[i];
  watch_pause();
  if (view_.fresh() && !report_.paused) report_.latency.add(*view_.frame(), Clock::now(), system_time_ns());
  if (report_.frames_drawn++ == 0) first_drawn_ = start;
  last_drawn_ = end;
  watch_server(end);
}

void HeadlessRun::watch_pause() {
  const std::optional<ServerStatus> status = source_.status();
  const bool paused = status && status->paused;
  if (paused != report_.paused)
    std::fprintf(stderr,
                 paused ? "pelagos-viewer: the sea is paused at frame %llu\n"
                        : "pelagos-viewer: the sea goes on at frame %llu\n",
                 static_cast<unsigned long long>(view_.frame()->frame));
  report_.paused = paused;
}

void HeadlessRun::watch_server(Clock::time_point now) {
  const bool alive = view_.server_alive();
  if (!alive && was_alive_) std::fprintf(stderr, "pelagos-viewer: the server is gone; the last frame stays\n");
  if (alive && !was_alive_) std::fprintf(stderr, "pelagos-viewer: the server is back\n");
  if (!alive && !was_alive_) report_.seconds_without_server += seconds_between(lost_, now);
  lost_ = now;
  was_alive_ = alive;
}

void HeadlessRun::save_picture() {
  const auto start = Clock::now();
  Picture picture = view_.renderer().read_picture();
  const std::string frame = std::to_string(view_.frame()->frame);
  if (!options_.plain && !was_alive_) draw_banner(picture, "NO SERVER - LAST FRAME " + frame);
  if (!options_.plain && was_alive_ && report_.paused) draw_banner(picture, "PAUSED - FRAME " + frame);
  char name[32];
  std::snprintf(name, sizeof name, "_%04llu.png", static_cast<unsigned long long>(report_.pictures_written));
  report_.last_picture = report_.channel + name;
  write_png(picture, options_.out / report_.last_picture);
  ++report_.pictures_written;
  last_saved_ = start;
  report_.picture_ms_sum += 1e3 * seconds_between(start, Clock::now());
}

bool HeadlessRun::done(Clock::time_point start) const {
  return (options_.frames > 0 && report_.frames_drawn >= options_.frames) ||
         (options_.duration > 0.0 && seconds_between(start, Clock::now()) >= options_.duration);
}

void HeadlessRun::finish() {
  report_.scene = view_.scene().scene;
  report_.counters = source_.counters();
  report_.counters.replaced += view_.frames_never_drawn();
  report_.delay = view_.delay();
  report_.skew_ms = view_.skew().all_ms();
  report_.pictures_held = view_.pictures_held();
  report_.clock = source_.clock_state();
  if (options_.swaps) write_file(options_.out / (report_.channel + "_swaps.csv"), swaps_);
  report_.seconds = seconds_between(first_drawn_, last_drawn_);
  write_report(report_, options_.out / (report_.channel + ".json"));
}

void HeadlessRun::give_up() {
  std::array<char, 32> seconds{};
  std::snprintf(seconds.data(), seconds.size(), "%g s", options_.wait);
  const bool heard = source_.status() || source_.scene_info();
  const std::string domain = std::to_string(options_.domain);
  report_.errors.push_back(heard ? "no frame within " + std::string(seconds.data()) + " of " +
                                       awaited(source_, options_.domain) + "; wait longer with --wait"
                                 : "no server on DDS domain " + domain + " within " + seconds.data() +
                                       "; start pelagos-server with the same --domain, or wait longer with --wait");
  std::fprintf(stderr, "pelagos-viewer: %s\n", report_.errors.back().c_str());
}

int HeadlessRun::run(const std::atomic<bool>& stop) {
  if (!wait_for_server(stop)) {
    if (!stop) give_up();
    finish();
    return stop ? 0 : 1;
  }
  view_.draw(source_.now_ns());  // not shown: drivers compile for the first picture, which takes seconds in software
  view_.update();
  const auto start = Clock::now();
  bool saved = false;
  while (true) {
    const auto begin = Clock::now();
    draw_frame();
    saved = report_.pictures_written == 0 || seconds_between(last_saved_, begin) >= options_.every;
    if (saved) save_picture();
    if (stop || done(start)) break;
    const double spare = 1.0 / options_.rate - seconds_between(begin, Clock::now());
    if (spare > 0.0) std::this_thread::sleep_for(std::chrono::duration<double>(spare));
    view_.update();
  }
  if (!saved) save_picture();
  finish();
  return 0;
}

}  // namespace

int run_headless(const Options& options, const Channel& channel, FrameSource& source, const std::atomic<bool>& stop) {
  prepare_folder(options.out, options.out / (channel.name + ".json"));
  const HeadlessContext context;
  HeadlessRun run(options, channel, source);
  return run.run(stop);
}

}  // namespace pelagos
