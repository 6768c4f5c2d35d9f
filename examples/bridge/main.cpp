// Example bridge: how a ship-bridge simulator tells Pelagos where its own ship is, and what it gets back.
//
// All that it takes is DDS:
//   1. write PoseV1 of idl/pelagos.idl, 30 to 60 times a second, to `own_ship_pose_v1` (own ship, body 1) or
//      `body_pose_v1` (other ships);
//   2. read BodyLoadV1 from `body_load_v1`: force and moment of the water on the ship, for its equations of motion;
//   3. ask for wave probes with ProbeRequestV1 on `probe_request_v1`, and read them from `probe_v1`;
//   4. ask for the sea's surface anywhere with SurfaceQueryV1 on `surface_query_v1`, and read SurfaceAnswerV1 from
//      `surface_answer_v1` (here by SurfaceClient).
// Any vendor's DDS and any language will do; this one uses the C types that Cyclone DDS's idlc makes of the IDL, and
// the project's thin RAII over its API (common/dds).

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <map>
#include <thread>

#include "client/surface_client.hpp"
#include "command_line/parse.hpp"
#include "command_line/stop_signals.hpp"
#include "options.hpp"
#include "pelagos.h"  // generated from idl/pelagos.idl
#include "pelagos_dds/entities.hpp"
#include "wire/topics.hpp"

namespace {

using namespace pelagos;
using namespace pelagos::example;
using Clock = std::chrono::steady_clock;

constexpr int kOk = 0;
constexpr int kFailed = 1;
constexpr int kBadArguments = 2;

volatile std::sig_atomic_t stop_requested = 0;
void request_stop(int) { stop_requested = 1; }

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

constexpr std::size_t kMostProbes = 256;  // as many as a server has

/// What came back last: the load on the ship and what its probes read.
class Feedback {
 public:
  Feedback(const DdsParticipant& participant, std::uint32_t body)
      : loads_(participant, topics::body_load()), probes_(participant, topics::probe()), body_(body) {}

  void print() {
    loads_.take_all<pelagos_BodyLoadV1>([&](const pelagos_BodyLoadV1& sample) {
      if (sample.body == body_) last_load_ = sample;
    });
    probes_.take_all<pelagos_ProbeV1>([&](const pelagos_ProbeV1& sample) {
      if (readings_.size() >= kMostProbes && !readings_.contains(sample.probe)) return;
      readings_[sample.probe] = sample;
      readings_[sample.probe].name = nullptr;  // lent only while it is looked at
    });
    if (last_load_) print_load(*last_load_);
    for (const auto& [id, reading] : readings_) print_probe(reading);
  }

 private:
  /// Up and bow up are positive here, whatever the axes of the wire.
  static void print_load(const pelagos_BodyLoadV1& load) {
    const double kilo_up = load.frame_of_body == pelagos_FRAME_NED ? -1e-3 : 1e-3;
    std::printf(
        "           water on hull  surge %9.1f kN  up %9.1f kN (buoyant %9.1f)  pitch %9.1f kN m  wetted %7.1f m3\n",
        1e-3 * load.force.x, kilo_up * load.force.z, kilo_up * load.buoyant_force.z, -kilo_up * load.moment.y,
        load.wetted_volume);
  }

  static void print_probe(const pelagos_ProbeV1& reading) {
    const bool ned = reading.world_frame == pelagos_FRAME_NED;
    const double up = ned ? -1.0 : 1.0;
    const double east = ned ? reading.velocity.y : reading.velocity.x;
    const double north = ned ? reading.velocity.x : reading.velocity.y;
    if (!reading.wet) {
      std::printf("           probe %-4u no water\n", reading.probe);
      return;
    }
    std::printf(
        "           probe %-4u surface at %7.2f m  water to the east %6.2f m/s, north %6.2f m/s, up %6.2f m/s\n",
        reading.probe, up * reading.surface.z, east, north, up * reading.velocity.z);
  }

  DdsReader loads_, probes_;
  std::uint32_t body_;
  std::optional<pelagos_BodyLoadV1> last_load_;
  std::map<std::uint32_t, pelagos_ProbeV1> readings_;
};

const char* source_name(SurfaceSource source) {
  switch (source) {
    case SurfaceSource::kParticles:
      return "particles";
    case SurfaceSource::kBlended:
      return "blended";
    case SurfaceSource::kWaveField:
      return "wave field";
    case SurfaceSource::kNoWater:
      break;
  }
  return "no water";
}

/// The surface at the places of --ask: prints the last answer and asks again, so that nobody waits.
class SurfaceAsker {
 public:
  SurfaceAsker(const std::shared_ptr<DdsParticipant>& participant, std::uint32_t client, SurfaceQuery query)
      : client_(participant, client), query_(std::move(query)) {}

  void print_and_ask() {
    for (const SurfaceReply& reply : client_.take()) print(reply.news);
    if (const auto sent = client_.ask(query_); sent.refusal)
      std::fprintf(stderr, "pelagos-example-bridge: %s\n", to_string(*sent.refusal).c_str());
  }

 private:
  void print(const SurfaceNews& news) const {
    if (!news.refusal.empty()) std::printf("           surface refused: %s\n", news.refusal.c_str());
    for (std::size_t k = 0; k < std::min(news.answer.places.size(), query_.places.size()); ++k) {
      const SurfaceAtPlace& at = news.answer.places[k];
      std::printf("           surface at east %8.1f m, north %8.1f m: %6.2f m at %.2f s (%s)\n", query_.places[k].x(),
                  query_.places[k].y(), at.height, news.answer.simulation_time, source_name(at.source));
    }
  }

  SurfaceClient client_;
  SurfaceQuery query_;
};

/// One request a probe, once: the topic keeps it for a server that starts later.
void ask_for_probes(const DdsWriter& writer, const Options& o) {
  for (std::size_t k = 0; k < o.probe_forward.size(); ++k) {
    pelagos_ProbeRequestV1 request{};
    request.sender = o.sender;
    request.probe = 100 * o.body + static_cast<std::uint32_t>(k) + 1;
    request.body = o.body;  // it goes with the ship
    request.frame = pelagos_FRAME_NED;
    request.position = {o.probe_forward[k], 0.0, 0.0};
    request.at_surface = true;
    if (!writer.write(&request)) std::fprintf(stderr, "pelagos-example-bridge: a probe could not be asked for\n");
  }
}

void report(const Track& track, double time, std::uint64_t sent, std::uint32_t servers) {
  const ShipState s = state_at(track, time);
  const double heading = s.heading_deg - 360.0 * std::floor(s.heading_deg / 360.0);
  std::printf(
      "t %6.1f s  east %8.2f m  north %8.2f m  up %6.2f m  heading %5.1f deg  speed %5.2f m/s  sent %llu  servers %u\n",
      time, s.east, s.north, s.up, heading, motion_at(track, time).velocity.head<2>().norm(),
      static_cast<unsigned long long>(sent), servers);
}

int send_track(const Options& o, const Track& track, const SurfaceQuery& query) {
  const auto shared = std::make_shared<DdsParticipant>(o.dds);
  const DdsParticipant& participant = *shared;
  const DdsWriter writer(participant, o.body == kOwnShip ? topics::own_ship_pose() : topics::body_pose());
  const DdsWriter requests(participant, topics::probe_request());
  Feedback feedback(participant, o.body);
  ask_for_probes(requests, o);
  std::optional<SurfaceAsker> surface;
  if (!query.places.empty()) surface.emplace(shared, o.sender, query);
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
      feedback.print();
      if (surface) surface->print_and_ask();
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
  if (const auto status = parse_command_line(app, argc, argv)) return *status;
  on_stop_signals(request_stop);
  options.dds.log = [](std::string_view line) {
    std::fprintf(stderr, "pelagos-example-bridge: %.*s\n", static_cast<int>(line.size()), line.data());
  };
  try {
    const auto track = make_track(options);
    const auto query = make_query(options);
    return track && query ? send_track(options, *track, *query) : kBadArguments;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pelagos-example-bridge: %s\n", error.what());
    return kFailed;
  }
}
