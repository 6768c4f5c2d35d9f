#include "client/frame_receiver.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <span>
#include <thread>
#include <utility>

#include "packing/particle_codec.hpp"
#include "pelagos_dds/entities.hpp"
#include "pelagos_dds/log_sink.hpp"
#include "wire/convert.hpp"
#include "wire/topics.hpp"

namespace pelagos {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kSourceSilence = std::chrono::seconds(2);
constexpr auto kPollInterval = std::chrono::milliseconds(250);
constexpr std::size_t kMostEvents = 256;
constexpr std::size_t kMostSpareFrames = 4;

}  // namespace

class FrameReceiver::Implementation {
 public:
  explicit Implementation(const DdsSettings& settings)
      : log_(settings.log),
        participant_(settings),
        frames_(participant_, topics::ocean_frame()),
        scenes_(participant_, topics::scene_info()),
        statuses_(participant_, topics::status()),
        winds_(participant_, topics::wind()),
        slicks_(participant_, topics::slick()),
        event_reader_(participant_, topics::event()),
        waitset_(participant_) {
    if (const auto warning = check_receive_buffer()) log_.write(*warning);
    waitset_.attach(frames_);
    waitset_.attach(scenes_, DDS_DATA_AVAILABLE_STATUS | DDS_LIVELINESS_CHANGED_STATUS);
    waitset_.attach(statuses_);
    waitset_.attach(winds_);
    waitset_.attach(slicks_);
    waitset_.attach(event_reader_);
    thread_ = std::thread([this] { dispatch(); });
  }

  ~Implementation() {
    stop_ = true;
    waitset_.wake();
    thread_.join();
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  std::unique_ptr<OceanFrame> take_newest() {
    const std::lock_guard lock(mutex_);
    return std::move(newest_);
  }

  void recycle(std::unique_ptr<OceanFrame> frame) {
    if (!frame) return;
    const std::lock_guard lock(mutex_);
    if (spare_.size() < kMostSpareFrames) spare_.push_back(std::move(frame));
  }

  bool wait_for_frame(std::chrono::milliseconds timeout) const {
    std::unique_lock lock(mutex_);
    return arrived_.wait_for(lock, timeout, [this] { return newest_ != nullptr; });
  }

  template <class Value>
  Value read(const Value Implementation::*member) const {
    const std::lock_guard lock(mutex_);
    return this->*member;
  }

  std::vector<Event> take_events() {
    const std::lock_guard lock(mutex_);
    std::vector<Event> result(events_.begin(), events_.end());
    events_.clear();
    return result;
  }

  bool alive() const { return alive_; }

  std::optional<SceneInfo> scene_;
  std::uint64_t scene_revision_ = 0;
  std::optional<ServerStatus> status_;
  std::optional<WindSettings> wind_;
  std::shared_ptr<const OceanSlick> slick_;
  ReceiverCounters counters_;

 private:
  void dispatch() {
    while (!stop_) {
      waitset_.wait(kPollInterval);
      try {
        take_samples();
      } catch (const std::exception& error) {  // out of memory: this round's samples are lost, the next may do
        log_.write(std::string("receiving failed: ") + error.what());
      }
    }
  }

  void take_samples() {
    alive_ = scenes_.alive_writers() > 0;
    scenes_.take_all<pelagos_SceneInfoV1>([this](const auto& sample) { accept_scene(sample); });
    frames_.take_all<pelagos_OceanFrameV1>([this](const auto& sample) { accept_frame(sample); });
    statuses_.take_all<pelagos_StatusV2>([this](const auto& sample) {
      if (!is_followed(sample.source)) return;
      ServerStatus status = wire::from_wire(sample);
      const std::lock_guard lock(mutex_);
      status_ = std::move(status);
    });
    winds_.take_all<pelagos_WindV1>([this](const auto& sample) {
      if (wire::find_fault(sample) != nullptr || !is_followed(sample.source)) return;
      const std::lock_guard lock(mutex_);
      wind_ = sample.has_wind ? std::optional(wire::from_wire(sample.wind)) : std::nullopt;
    });
    slicks_.take_all<pelagos_SlickV1>([this](const auto& sample) { accept_slick(sample); });
    event_reader_.take_all<pelagos_EventV1>([this](const auto& sample) {
      if (!is_followed(sample.source)) return;
      Event event = wire::from_wire(sample);
      const std::lock_guard lock(mutex_);
      events_.push_back(std::move(event));
      if (events_.size() > kMostEvents) events_.pop_front();
    });
  }

  /// Whether to listen to `source`; goes over to it if nobody is followed or the present one has gone silent.
  bool is_followed(std::uint64_t source) {
    const auto now = Clock::now();
    if (source == source_) {
      last_heard_ = now;
      return true;
    }
    if (source_ != 0 && now - last_heard_ < kSourceSilence) return false;
    source_ = source;
    last_heard_ = now;
    next_frame_.reset();
    const std::lock_guard lock(mutex_);
    scene_.reset();
    status_.reset();
    wind_.reset();
    slick_.reset();
    // What the new server has said once, while the old one was followed.
    if (const auto other = std::find_if(other_scenes_.begin(), other_scenes_.end(),
                                        [source](const auto& entry) { return entry.first == source; });
        other != other_scenes_.end()) {
      scene_ = std::move(other->second);
      ++scene_revision_;
      other_scenes_.erase(other);
    }
    return true;
  }

  void accept_scene(const pelagos_SceneInfoV1& sample) {
    if (const char* fault = wire::find_fault(sample)) {
      log_.write(std::string("scene_info refused: ") + fault);
      return;
    }
    SceneInfo scene = wire::from_wire(sample);
    if (!is_followed(sample.source)) {
      constexpr std::size_t kMostOthers = 8;
      if (other_scenes_.size() >= kMostOthers) other_scenes_.pop_front();
      other_scenes_.emplace_back(sample.source, std::move(scene));
      return;
    }
    const std::lock_guard lock(mutex_);
    scene_ = std::move(scene);
    ++scene_revision_;
  }

  void accept_frame(const pelagos_OceanFrameV1& sample) {
    if (const char* fault = wire::find_fault(sample)) {
      log_.write(std::string("frame refused: ") + fault);
      const std::lock_guard lock(mutex_);
      ++counters_.refused;
      return;
    }
    if (!is_followed(sample.source)) {
      const std::lock_guard lock(mutex_);
      ++counters_.foreign;
      return;
    }
    std::unique_ptr<OceanFrame> frame = decode(sample);
    const std::lock_guard lock(mutex_);
    if (next_frame_ && sample.frame > *next_frame_) counters_.missed += sample.frame - *next_frame_;
    next_frame_ = sample.frame + 1;
    ++counters_.received;
    if (newest_) {
      ++counters_.replaced;
      if (spare_.size() < kMostSpareFrames) spare_.push_back(std::move(newest_));
    }
    newest_ = std::move(frame);
    arrived_.notify_all();
  }

  void accept_slick(const pelagos_SlickV1& sample) {
    if (const char* fault = wire::find_fault(sample)) {
      log_.write(std::string("slick refused: ") + fault);
      const std::lock_guard lock(mutex_);
      ++counters_.slicks_refused;
      return;
    }
    if (!is_followed(sample.source)) return;
    auto slick = std::make_shared<OceanSlick>();
    slick->frame = sample.frame;
    slick->simulation_time = sample.simulation_time;
    slick->origin = wire::from_wire(sample.origin);
    slick->discs.reserve(sample.elements._length);
    for (std::uint32_t i = 0; i < sample.elements._length; ++i)
      slick->discs.push_back(wire::from_wire(sample.elements._buffer[i]));
    const std::lock_guard lock(mutex_);
    slick_ = std::move(slick);
    ++counters_.slicks;
  }

  std::unique_ptr<OceanFrame> decode(const pelagos_OceanFrameV1& sample) {
    std::unique_ptr<OceanFrame> frame = take_spare();
    const PackingScales scales = wire::scales_of(sample);
    frame->source = sample.source;
    frame->frame = sample.frame;
    frame->simulation_time = sample.simulation_time;
    frame->wall_time_ns = sample.wall_time_ns;
    frame->received = Clock::now();
    frame->origin = wire::from_wire(sample.origin);
    frame->box.min = scales.box_min.cast<double>();
    frame->box.max = frame->box.min + scales.box_size.cast<double>();
    frame->largest_speed = scales.largest_speed;
    frame->total_particles = sample.total_particles;
    // Checked by find_fault() already.
    (void)unpack_particles(std::span(sample.payload._buffer, sample.payload._length), scales, frame->particles);
    frame->bodies.clear();
    for (std::uint32_t i = 0; i < sample.bodies._length; ++i) {
      frame->bodies.push_back(wire::from_wire(sample.bodies._buffer[i]));
    }
    return frame;
  }

  std::unique_ptr<OceanFrame> take_spare() {
    {
      const std::lock_guard lock(mutex_);
      if (!spare_.empty()) {
        std::unique_ptr<OceanFrame> frame = std::move(spare_.back());
        spare_.pop_back();
        return frame;
      }
    }
    return std::make_unique<OceanFrame>();
  }

  RateLimitedLog log_;
  DdsParticipant participant_;
  DdsReader frames_;
  DdsReader scenes_;
  DdsReader statuses_;
  DdsReader winds_;
  DdsReader slicks_;
  DdsReader event_reader_;
  DdsWaitSet waitset_;

  // Of the dispatcher thread alone.
  std::uint64_t source_ = 0;
  Clock::time_point last_heard_{};
  std::optional<std::uint64_t> next_frame_;
  std::deque<std::pair<std::uint64_t, SceneInfo>> other_scenes_;

  std::atomic<bool> stop_{false};
  std::atomic<bool> alive_{false};
  mutable std::mutex mutex_;  // guards what follows, and the public members
  mutable std::condition_variable arrived_;
  std::unique_ptr<OceanFrame> newest_;
  std::vector<std::unique_ptr<OceanFrame>> spare_;
  std::deque<Event> events_;

  std::thread thread_;
};

FrameReceiver::FrameReceiver(const DdsSettings& settings)
    : implementation_(std::make_unique<Implementation>(settings)) {}
FrameReceiver::~FrameReceiver() = default;

std::unique_ptr<OceanFrame> FrameReceiver::take_newest() { return implementation_->take_newest(); }
void FrameReceiver::recycle(std::unique_ptr<OceanFrame> frame) { implementation_->recycle(std::move(frame)); }
bool FrameReceiver::wait_for_frame(std::chrono::milliseconds timeout) const {
  return implementation_->wait_for_frame(timeout);
}
std::optional<SceneInfo> FrameReceiver::scene_info() const { return implementation_->read(&Implementation::scene_); }
std::uint64_t FrameReceiver::scene_revision() const { return implementation_->read(&Implementation::scene_revision_); }
std::optional<ServerStatus> FrameReceiver::status() const { return implementation_->read(&Implementation::status_); }
std::optional<WindSettings> FrameReceiver::wind() const { return implementation_->read(&Implementation::wind_); }
std::shared_ptr<const OceanSlick> FrameReceiver::slick() const {
  return implementation_->read(&Implementation::slick_);
}
std::vector<Event> FrameReceiver::take_events() { return implementation_->take_events(); }
bool FrameReceiver::server_alive() const { return implementation_->alive(); }
ReceiverCounters FrameReceiver::counters() const { return implementation_->read(&Implementation::counters_); }

}  // namespace pelagos
