// Example bridge: how a ship-bridge simulator tells Pelagos where its own ship is.
//
// All that it takes is DDS: write PoseV1 of idl/pelagos.idl, 30 to 60 times a second, to `own_ship_pose_v1` (own ship,
// body 1) or `body_pose_v1` (other ships). Any vendor's DDS and any language will do; this one uses the C types that
// Cyclone DDS's idlc makes of the IDL, and the project's thin RAII over its API.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <optional>
#include <thread>

#include "command_line/number_check.hpp"
#include "pelagos.h"  // generated from idl/pelagos.idl
#include "pelagos_dds/entities.hpp"
#include "track.hpp"
#include "version/version.hpp"
#include "wire/topics.hpp"

namespace {

using namespace pelagos;
using namespace pelagos::example;
using Clock = std::chrono::steady_clock;

constexpr int kOk = 0;
constexpr int kFailed = 1;
constexpr int kBadArguments = 2;
constexpr std::uint32_t kOwnShip = 1;

volatile std::sig_atomic_t stop_requested = 0;
void request_stop(int) { stop_requested = 1; }

struct Options {
  DdsSettings dds;
  std::uint32_t body = kOwnShip;
  std::uint32_t sender = 1;
  double duration = 0.0;  // s; 0: the track file's length, or 60
  double rate = 30.0;     // Hz
  std::string track_file;
  OvalTrack oval;
  double draft = 0.0;
  std::optional<double> radius_north, heave, pitch_deg, roll_deg;
};

void describe_options(CLI::App& app, Options& o) {
  app.set_version_flag("--version", std::string("pelagos-example-bridge ") + kVersion);
  app.add_option("--domain", o.dds.domain, "DDS domain")->check(CLI::Range(0, 230))->capture_default_str();
  app.add_option("--dds-config", o.dds.config_file, "Cyclone DDS configuration file (default: loopback)");
  app.add_option("--body", o.body, "id of the body; 1 is own ship")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  app.add_option("--sender", o.sender, "number that tells this bridge from others")->capture_default_str();
  app.add_option("--duration", o.duration, "s (default: length of the track file, or 60)")->check(NumberFrom(0.0, 1e7));
  app.add_option("--rate", o.rate, "poses a second")->check(NumberFrom(0.1, 1000.0))->capture_default_str();
  app.add_option("--track", o.track_file, "CSV: time,east,north,heading_deg[,up,pitch_deg,roll_deg], s, m, degrees");
  const NumberFrom place(-1e5, 1e5);
  const NumberFrom radius(0.1, 1e5);
  app.add_option("--east", o.oval.east, "built-in oval: centre, m")->check(place)->capture_default_str();
  app.add_option("--north", o.oval.north, "built-in oval: centre, m")->check(place)->capture_default_str();
  app.add_option("--radius", o.oval.radius_east, "built-in oval: half its width, m")
      ->check(radius)
      ->capture_default_str();
  app.add_option("--radius-north", o.radius_north, "built-in oval: half its length, m (default: a circle)")
      ->check(radius);
  app.add_option("--speed", o.oval.speed, "built-in oval: m/s")->check(NumberFrom(0.0, 50.0))->capture_default_str();
  app.add_option("--water-level", o.oval.up, "built-in oval: m")->check(place)->capture_default_str();
  app.add_option("--draft", o.draft, "built-in oval: the ship's origin is that far below the water level, m")
      ->check(place);
  app.add_option("--heave", o.heave, "m, amplitude (default: 0.1, with a file 0)")->check(NumberFrom(0.0, 20.0));
  app.add_option("--pitch", o.pitch_deg, "degrees, amplitude (default: 1.5, with a file 0)")
      ->check(NumberFrom(0.0, 45.0));
  app.add_option("--roll", o.roll_deg, "degrees, amplitude (default: 3, with a file 0)")->check(NumberFrom(0.0, 60.0));
}

/// Empty, and a message on stderr, if the track file is no good.
std::optional<Track> make_track(const Options& o) {
  Track track;
  const bool built_in = o.track_file.empty();
  if (built_in) {
    OvalTrack oval = o.oval;
    oval.radius_north = o.radius_north.value_or(oval.radius_east);
    oval.up -= o.draft;
    track.path = oval;
  } else {
    std::ifstream file(o.track_file);
    std::string error = o.track_file + ": cannot be read";
    auto path = file ? read_track(file, o.track_file, error) : std::nullopt;
    if (!path) {
      std::fprintf(stderr, "pelagos-example-bridge: %s\n", error.c_str());
      return std::nullopt;
    }
    track.path = std::move(*path);
  }
  track.sea = {o.heave.value_or(built_in ? 0.1 : 0.0), o.pitch_deg.value_or(built_in ? 1.5 : 0.0),
               o.roll_deg.value_or(built_in ? 3.0 : 0.0)};
  return track;
}

/// The sample as the IDL describes it, in NED as bridges have it.
pelagos_PoseV1 make_sample(const Options& o, const NedMotion& motion, double time) {
  const auto vector = [](const Eigen::Vector3d& v) { return pelagos_Vector3{v.x(), v.y(), v.z()}; };
  const Eigen::Quaterniond& q = motion.orientation;
  pelagos_PoseV1 sample{};
  sample.body = o.body;
  sample.sender = o.sender;
  sample.frame = pelagos_FRAME_NED;
  sample.time = time;
  sample.position = vector(motion.position);
  sample.orientation = {q.x(), q.y(), q.z(), q.w()};
  sample.velocity = vector(motion.velocity);
  sample.angular_rate_body = vector(motion.angular_rate_body);
  return sample;
}

/// What the water did to the body last, for people.
class LoadLine {
 public:
  LoadLine(const DdsParticipant& participant, std::uint32_t body)
      : reader_(participant, topics::body_load()), body_(body) {}

  void print() {
    reader_.take_all<pelagos_BodyLoadV1>([&](const pelagos_BodyLoadV1& sample) {
      if (sample.body == body_) last_ = sample;
    });
    if (!last_) return;
    const pelagos_BodyLoadV1& l = *last_;
    const bool ned = l.frame_of_body == pelagos_FRAME_NED;
    std::printf(
        "           water on hull  surge %9.1f kN  up %9.1f kN (buoyant %9.1f)  pitch %9.1f kN m  wetted %7.1f m3\n",
        1e-3 * l.force.x, (ned ? -1e-3 : 1e-3) * l.force.z, (ned ? -1e-3 : 1e-3) * l.buoyant_force.z,
        (ned ? 1e-3 : -1e-3) * l.moment.y, l.wetted_volume);
  }

 private:
  DdsReader reader_;
  std::uint32_t body_;
  std::optional<pelagos_BodyLoadV1> last_;
};

void report(const Track& track, double time, std::uint64_t sent, std::uint32_t servers) {
  const ShipState s = state_at(track, time);
  const double heading = s.heading_deg - 360.0 * std::floor(s.heading_deg / 360.0);
  std::printf(
      "t %6.1f s  east %8.2f m  north %8.2f m  up %6.2f m  heading %5.1f deg  speed %5.2f m/s  sent %llu  servers %u\n",
      time, s.east, s.north, s.up, heading, motion_at(track, time).velocity.head<2>().norm(),
      static_cast<unsigned long long>(sent), servers);
}

int send_track(const Options& o, const Track& track) {
  const DdsParticipant participant(o.dds);
  const DdsWriter writer(participant, o.body == kOwnShip ? topics::own_ship_pose() : topics::body_pose());

  LoadLine load(participant, o.body);
  const double length = std::isfinite(end_of(track)) ? end_of(track) : 60.0;
  const double duration = o.duration > 0.0 ? o.duration : length;
  // Times must increase, also for a bridge that is started again: seconds since 1970, then by a clock nobody sets.
  const double epoch = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  const auto start = Clock::now();
  std::uint64_t sent = 0;
  std::uint64_t failed = 0;
  double next_report = 0.0;
  for (std::uint64_t i = 0; stop_requested == 0; ++i) {
    const std::chrono::duration<double> due(static_cast<double>(i) / o.rate);
    if (due.count() > duration) break;
    std::this_thread::sleep_until(start + std::chrono::duration_cast<Clock::duration>(due));
    const pelagos_PoseV1 sample = make_sample(o, motion_at(track, due.count()), epoch + due.count());
    ++(writer.write(&sample) ? sent : failed);
    if (due.count() >= next_report) {
      report(track, due.count(), sent, writer.matched_readers());
      load.print();
      std::fflush(stdout);
      next_report += 1.0;
    }
  }
  std::printf("done: %llu poses sent, %llu failed\n", static_cast<unsigned long long>(sent),
              static_cast<unsigned long long>(failed));
  return failed == 0 ? kOk : kFailed;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Sends the track of a ship to a Pelagos server over DDS.", "pelagos-example-bridge");
  describe_options(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kOk : kBadArguments;
  }
  std::signal(SIGINT, request_stop);
  std::signal(SIGTERM, request_stop);
  options.dds.log = [](std::string_view line) {
    std::fprintf(stderr, "pelagos-example-bridge: %.*s\n", static_cast<int>(line.size()), line.data());
  };
  try {
    const auto track = make_track(options);
    return track ? send_track(options, *track) : kBadArguments;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pelagos-example-bridge: %s\n", error.what());
    return kFailed;
  }
}
