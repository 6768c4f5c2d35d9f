#include <chrono>
#include <cstdio>
#include <thread>

#include "app/presentation.hpp"
#include "app/report.hpp"
#include "app/run.hpp"
#include "renderer/gl_context.hpp"

namespace pelagos {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double kFastest = 1.0 / 60.0;  // s between frames
constexpr std::size_t kMostLatencies = 1'000'000;

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
        view_(source, channel, {options.width, options.height, channel.guard_px, options.quality, true},
              options.assets / "meshes") {
    report_.channel = channel.name;
    report_.renderer = renderer_name();
    report_.width = options.width;
    report_.height = options.height;
  }

  int run(const std::atomic<bool>& stop);

 private:
  bool wait_for_server(const std::atomic<bool>& stop);
  void draw_frame(bool fresh);
  void watch_server(Clock::time_point now);
  void save_picture();
  [[nodiscard]] bool done(Clock::time_point start) const;
  void finish();

  const Options& options_;
  FrameSource& source_;
  Presentation view_;
  RunReport report_;
  Clock::time_point first_drawn_{}, last_drawn_{}, last_saved_{}, lost_{};
  bool was_alive_ = true;
};

bool HeadlessRun::wait_for_server(const std::atomic<bool>& stop) {
  const auto start = Clock::now();
  bool told = false;
  while (!stop) {
    view_.update();
    if (view_.ready()) return true;
    const double waited = seconds_between(start, Clock::now());
    if (waited > options_.wait) return false;
    if (!told && waited > 1.0) {
      std::fprintf(stderr, "pelagos-viewer: waiting for a server on DDS domain %u\n", options_.domain);
      told = true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return false;
}

void HeadlessRun::draw_frame(bool fresh) {
  const auto start = Clock::now();
  view_.draw();
  const auto end = Clock::now();
  report_.frame_ms_sum += 1e3 * seconds_between(start, end);
  for (std::size_t i = 0; i < kPassNames.size(); ++i) report_.pass_ms_sum[i] += view_.renderer().pass_times()[i];
  if (fresh && report_.latency_ms.size() < kMostLatencies)
    report_.latency_ms.push_back(1e-6 * static_cast<double>(system_time_ns() - view_.frame()->wall_time_ns));
  if (report_.frames_drawn++ == 0) first_drawn_ = start;
  last_drawn_ = end;
  watch_server(end);
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
  if (!was_alive_) draw_banner(picture, "NO SERVER - LAST FRAME " + std::to_string(view_.frame()->frame));
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
  report_.seconds = seconds_between(first_drawn_, last_drawn_);
  write_report(report_, options_.out / (report_.channel + ".json"));
}

int HeadlessRun::run(const std::atomic<bool>& stop) {
  if (!wait_for_server(stop)) {
    if (!stop) {
      char text[200];
      std::snprintf(text, sizeof text,
                    "no server on DDS domain %u within %g s; start pelagos-server with the same --domain, or wait "
                    "longer with --wait",
                    options_.domain, options_.wait);
      report_.errors.push_back(text);
      std::fprintf(stderr, "pelagos-viewer: %s\n", report_.errors.back().c_str());
    }
    finish();
    return stop ? 0 : 1;
  }
  const auto start = Clock::now();
  bool fresh = true, saved = false;
  while (true) {
    const auto begin = Clock::now();
    draw_frame(fresh);
    saved = report_.pictures_written == 0 || seconds_between(last_saved_, begin) >= options_.every;
    if (saved) save_picture();
    if (stop || done(start)) break;
    const double spare = kFastest - seconds_between(begin, Clock::now());
    if (spare > 0.0) std::this_thread::sleep_for(std::chrono::duration<double>(spare));
    fresh = view_.update();
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
