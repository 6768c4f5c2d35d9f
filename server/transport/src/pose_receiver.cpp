#include "transport/pose_receiver.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <deque>
#include <map>
#include <mutex>
#include <string>
#include <unordered_map>
#include <utility>

#include "pelagos_dds/entities.hpp"
#include "pelagos_dds/log_sink.hpp"
#include "pelagos_dds/receiver_thread.hpp"
#include "transport/local_plane.hpp"
#include "wire/convert.hpp"
#include "wire/topics.hpp"

namespace pelagos {
namespace {

// The rest between two rounds is what it adds to a pose's delay at most.
constexpr ReceiverThread::Pace kPace{std::chrono::milliseconds(500), std::chrono::milliseconds(1)};

/// Writers whose participant is remembered.
constexpr std::size_t kMostWriters = 1024;

/// Log lines of each kind of fault in ten seconds.
constexpr int kLinesPerFault = 2;

bool is_place(const GeodeticPose& pose) {
  return std::abs(pose.latitude_deg) <= 90.0 && pose.longitude_deg >= -180.0 && pose.longitude_deg <= 360.0 &&
         pose.height >= -12e3 && pose.height <= 1e5;
}

}  // namespace

class PoseReceiver::Implementation {
 public:
  Implementation(std::shared_ptr<DdsParticipant> participant, const std::vector<std::uint32_t>& bodies,
                 const GeodeticOrigin& origin, const DdsLog& log, const PoseLimits& limits)
      : log_(log),
        plane_(origin),
        participant_(std::move(participant)),
        own_ship_(*participant_, topics::own_ship_pose()),
        others_(*participant_, topics::body_pose()),
        geodetic_(*participant_, topics::geodetic_pose()),
        gate_(bodies, limits),
        thread_(*participant_, "poses", log_, kPace) {
    thread_.attach(own_ship_);
    thread_.attach(others_);
    thread_.attach(geodetic_);
    for (std::size_t fault = 0; fault <= kPoseFaults; ++fault) fault_logs_.emplace_back(log, kLinesPerFault);
    thread_.start([this] {
      take_poses(own_ship_);
      take_poses(others_);
      take_geodetic_poses();
    });
  }

  void take_newest(std::vector<ReceivedPose>& poses) {
    poses.clear();
    const std::lock_guard lock(mutex_);
    for (const auto& [body, pose] : newest_) poses.push_back(pose);
    newest_.clear();
  }

  PoseCounters counters() const {
    const std::lock_guard lock(mutex_);
    return gate_.counters();
  }

 private:
  void take_poses(const DdsReader& reader) {
    reader.take_all<pelagos_PoseV1>([&](const pelagos_PoseV1& sample, const dds_sample_info_t& info) {
      accept_pose(wire::from_wire(sample), {sample.sender, participant_of(reader, info.publication_handle)});
    });
  }

  void take_geodetic_poses() {
    geodetic_.take_all<pelagos_GeodeticPoseV1>(
        [&](const pelagos_GeodeticPoseV1& sample, const dds_sample_info_t& info) {
          const GeodeticPose pose = wire::from_wire(sample);
          const PoseSender sender{sample.sender, participant_of(geodetic_, info.publication_handle)};
          is_place(pose) ? accept_pose(plane_.to_world(pose), sender) : refuse_place(pose, sender);
        });
  }

  std::uint64_t participant_of(const DdsReader& reader, std::uint64_t writer) {
    if (const auto known = participants_.find(writer); known != participants_.end()) return known->second;
    if (participants_.size() >= kMostWriters) participants_.clear();
    return participants_[writer] = reader.participant_of(writer);
  }

  void accept_pose(BodyPose pose, const PoseSender& sender) {
    const auto now = PoseGate::Clock::now();
    std::optional<PoseFault> fault;
    std::optional<CourseContradiction> contradiction;
    PoseSender driver;
    {
      const std::lock_guard lock(mutex_);
      fault = gate_.check(pose, sender, now);
      contradiction = gate_.contradiction();
      driver = gate_.driver_of(pose.body);
      if (!fault) newest_[pose.body] = {pose, sender.number, now};
    }
    if (fault) log_fault(*fault, pose.body, sender, driver);
    if (contradiction) log_contradiction(*contradiction, pose.body, sender);
  }

  void refuse_place(const GeodeticPose& pose, const PoseSender& sender) {
    {
      const std::lock_guard lock(mutex_);
      gate_.refuse(PoseFault::kNoPlace);
    }
    log_fault(PoseFault::kNoPlace, pose.body, sender, sender);
  }

  void log_fault(PoseFault fault, std::uint32_t body, const PoseSender& sender, const PoseSender& driver) {
    std::string text = "pose of body " + std::to_string(body) + " from sender " + std::to_string(sender.number) +
                       " refused: " + std::string(describe(fault));
    if (fault == PoseFault::kSecondSender)
      text += driver.number == sender.number ? ": another program that sends as " + std::to_string(driver.number)
                                             : ": sender " + std::to_string(driver.number);
    fault_logs_[static_cast<std::size_t>(fault)].write(text);
  }

  void log_contradiction(const CourseContradiction& found, std::uint32_t body, const PoseSender& sender) {
    const char* unit = found.turning ? "rad/s" : "m/s";
    std::array<char, 240> text{};
    std::snprintf(
        text.data(), text.size(),
        "pose of body %u from sender %u: the %s %.3g %s contradicts its %s, which give %.3g %s; these are used", body,
        sender.number, found.turning ? "angular rate" : "velocity", found.sent, unit,
        found.turning ? "orientations" : "places", found.by_places, unit);
    fault_logs_[kPoseFaults].write(text.data());
  }

  RateLimitedLog log_;
  std::deque<RateLimitedLog> fault_logs_;  // by PoseFault, then contradictions: one kind must not hide another
  LocalPlane plane_;
  std::shared_ptr<DdsParticipant> participant_;
  DdsReader own_ship_;
  DdsReader others_;
  DdsReader geodetic_;
  std::unordered_map<std::uint64_t, std::uint64_t> participants_;  // by writer; the receiver's thread only

  mutable std::mutex mutex_;  // guards what follows; held for one pose at a time
  PoseGate gate_;
  std::map<std::uint32_t, ReceivedPose> newest_;

  ReceiverThread thread_;
};

PoseReceiver::PoseReceiver(std::shared_ptr<DdsParticipant> participant, const std::vector<std::uint32_t>& bodies,
                           const GeodeticOrigin& origin, DdsLog log, const PoseLimits& limits)
    : implementation_(
          std::make_unique<Implementation>(std::move(participant), bodies, origin, std::move(log), limits)) {}
PoseReceiver::~PoseReceiver() = default;

void PoseReceiver::take_newest(std::vector<ReceivedPose>& poses) { implementation_->take_newest(poses); }
PoseCounters PoseReceiver::counters() const { return implementation_->counters(); }

}  // namespace pelagos
