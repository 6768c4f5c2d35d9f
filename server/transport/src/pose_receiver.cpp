#include "transport/pose_receiver.hpp"

#include <atomic>
#include <cmath>
#include <deque>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "pelagos_dds/entities.hpp"
#include "pelagos_dds/log_sink.hpp"
#include "transport/local_plane.hpp"
#include "wire/convert.hpp"
#include "wire/topics.hpp"

namespace pelagos {
namespace {

constexpr auto kPollInterval = std::chrono::milliseconds(500);
// Between two rounds, so that a flood is taken in batches: it adds this much to a pose's delay at most.
constexpr auto kBatchInterval = std::chrono::milliseconds(1);

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
        waitset_(*participant_),
        gate_(bodies, limits) {
    waitset_.attach(own_ship_);
    waitset_.attach(others_);
    waitset_.attach(geodetic_);
    for (std::size_t fault = 0; fault < kPoseFaults; ++fault) fault_logs_.emplace_back(log, kLinesPerFault);
    thread_ = std::thread([this] { dispatch(); });
  }

  ~Implementation() {
    stop_ = true;
    waitset_.wake();
    thread_.join();
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

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
  void dispatch() {
    const auto accept = [this](const pelagos_PoseV1& sample) { accept_pose(wire::from_wire(sample), sample.sender); };
    const auto accept_geodetic = [this](const pelagos_GeodeticPoseV1& sample) {
      const GeodeticPose pose = wire::from_wire(sample);
      is_place(pose) ? accept_pose(plane_.to_world(pose), sample.sender) : refuse_place(pose, sample.sender);
    };
    while (!stop_) {
      waitset_.wait(kPollInterval);
      try {
        own_ship_.take_all<pelagos_PoseV1>(accept);
        others_.take_all<pelagos_PoseV1>(accept);
        geodetic_.take_all<pelagos_GeodeticPoseV1>(accept_geodetic);
      } catch (const std::exception& error) {  // out of memory: this round's poses are lost, the next may do
        log_.write(std::string("receiving poses failed: ") + error.what());
      }
      std::this_thread::sleep_for(kBatchInterval);
    }
  }

  void accept_pose(BodyPose pose, std::uint32_t sender) {
    const auto now = PoseGate::Clock::now();
    std::optional<PoseFault> fault;
    {
      const std::lock_guard lock(mutex_);
      fault = gate_.check(pose, sender, now);
      if (!fault) newest_[pose.body] = {pose, sender, now};
    }
    if (fault) log_fault(*fault, pose.body, sender);
  }

  void refuse_place(const GeodeticPose& pose, std::uint32_t sender) {
    {
      const std::lock_guard lock(mutex_);
      gate_.refuse(PoseFault::kNoPlace);
    }
    log_fault(PoseFault::kNoPlace, pose.body, sender);
  }

  void log_fault(PoseFault fault, std::uint32_t body, std::uint32_t sender) {
    fault_logs_[static_cast<std::size_t>(fault)].write("pose of body " + std::to_string(body) + " from sender " +
                                                       std::to_string(sender) +
                                                       " refused: " + std::string(describe(fault)));
  }

  RateLimitedLog log_;
  std::deque<RateLimitedLog> fault_logs_;  // by PoseFault: one kind of bad pose must not hide another
  LocalPlane plane_;
  std::shared_ptr<DdsParticipant> participant_;
  DdsReader own_ship_;
  DdsReader others_;
  DdsReader geodetic_;
  DdsWaitSet waitset_;
  std::atomic<bool> stop_{false};

  mutable std::mutex mutex_;  // guards what follows; held for one pose at a time
  PoseGate gate_;
  std::map<std::uint32_t, ReceivedPose> newest_;

  std::thread thread_;
};

PoseReceiver::PoseReceiver(std::shared_ptr<DdsParticipant> participant, const std::vector<std::uint32_t>& bodies,
                           const GeodeticOrigin& origin, DdsLog log, const PoseLimits& limits)
    : implementation_(
          std::make_unique<Implementation>(std::move(participant), bodies, origin, std::move(log), limits)) {}
PoseReceiver::~PoseReceiver() = default;

void PoseReceiver::take_newest(std::vector<ReceivedPose>& poses) { implementation_->take_newest(poses); }
PoseCounters PoseReceiver::counters() const { return implementation_->counters(); }

}  // namespace pelagos
