#include "client/frame_receiver.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <random>
#include <span>
#include <utility>

#include "client/frame_count.hpp"
#include "client/listening_time.hpp"
#include "client/source_watch.hpp"
#include "clock_exchange.hpp"
#include "packing/particle_codec.hpp"
#include "pelagos_dds/entities.hpp"
#include "pelagos_dds/log_sink.hpp"
#include "pelagos_dds/receiver_thread.hpp"
#include "refusal_log.hpp"
#include "wire/convert.hpp"
#include "wire/sample_fault.hpp"
#include "wire/topics.hpp"
#include "writer_owners.hpp"

namespace pelagos {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kPollInterval = std::chrono::milliseconds(250);
constexpr std::size_t kMostEvents = 256;
constexpr std::size_t kMostSpareFrames = 4;
constexpr std::size_t kMostWaitingFrames = 16, kMostWaitingParticles = wire::kMostParticles;
constexpr std::size_t kMostSlicks = 16, kMostWaitingDiscs = 4 * wire::kMostSlickElements;
constexpr std::size_t kMostTriangles = 1'000'000;  // of all bodies

std::uint64_t draw_viewer() {
  std::random_device device;
  const std::uint64_t high = device();
  return high << 32 | device();
}

}  // namespace

class FrameReceiver::Implementation {
 public:
  Implementation(const DdsSettings& settings, const LocalClocks& clocks)
      : clocks_(clocks),
        clock_(clocks.trust_host),
        log_(settings.log),
        refusals_(settings.log),
        participant_(settings),
        viewer_(draw_viewer()),
        exchange_(participant_, viewer_),
        answers_(participant_, topics::clock_answer()),
        schedules_(std::make_unique<DdsReader>(participant_, topics::schedule())),
        frames_(participant_, topics::ocean_frame()),
        scenes_(participant_, topics::scene_info()),
        seas_(std::make_unique<DdsReader>(participant_, topics::sea())),
        statuses_(participant_, topics::status()),
        shapes_(std::make_unique<DdsReader>(participant_, topics::body_shape())),
        winds_(participant_, topics::wind()),
        slicks_(participant_, topics::slick()),
        event_reader_(participant_, topics::event()),
        thread_(participant_, "samples", log_, {kPollInterval, {}}) {
    if (const auto warning = check_receive_buffer()) log_.write(*warning);
    for (const DdsReader* reader : {&answers_, schedules_.get(), &frames_, &scenes_, seas_.get(), shapes_.get(),
                                    &statuses_, &winds_, &slicks_, &event_reader_})
      thread_.attach(*reader);
    thread_.start([this] {
      last_looked_ = listening_.look(Clock::now()).time_since_epoch().count();
      take_samples();
    });
  }

  std::unique_ptr<OceanFrame> take_newest() {
    const std::lock_guard lock(mutex_);
    while (waiting_.size() > 1) drop_oldest();
    return take_oldest();
  }

  std::unique_ptr<OceanFrame> take_next() {
    const std::lock_guard lock(mutex_);
    return take_oldest();
  }

  std::shared_ptr<const OceanSlick> newest_slick() const {
    const std::lock_guard lock(mutex_);
    return slick_.empty() ? nullptr : slick_.back();
  }

  std::shared_ptr<const OceanSlick> slick_at(double time) const {
    const std::lock_guard lock(mutex_);
    const auto distance = [time](const auto& slick) { return std::abs(slick->simulation_time - time); };
    // The latest of those that are equally near.
    const auto nearest = std::min_element(slick_.rbegin(), slick_.rend(),
                                          [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
    return nearest == slick_.rend() ? nullptr : *nearest;
  }

  std::optional<DueInstant> due_at(std::int64_t steady_ns) const {
    const ClockStamp now = clocks_.now();
    const std::lock_guard lock(mutex_);
    return clock_.at(steady_ns, now);
  }

  ClockState clock_state() const {
    const ClockStamp now = clocks_.now();
    const std::lock_guard lock(mutex_);
    return clock_.state(now);
  }

  void tell(ViewerStatus status) {
    const ClockState clock = clock_state();
    status.viewer = viewer_;
    status.clock = clock.clock;
    status.clock_offset = 1e-9 * static_cast<double>(clock.offset_ns);
    status.clock_error = clock.error;
    status.source = read(&Implementation::source_);
    if (!teller_) teller_.emplace(participant_, topics::viewer_status());
    const pelagos_ViewerStatusV1 sample = wire::to_wire(status);
    if (!teller_->write(&sample)) log_.write("cannot publish viewer_status");
  }

  void recycle(std::unique_ptr<OceanFrame> frame) {
    if (!frame) return;
    const std::lock_guard lock(mutex_);
    if (spare_.size() < kMostSpareFrames) spare_.push_back(std::move(frame));
  }

  bool wait_for_frame(std::chrono::milliseconds timeout) const {
    std::unique_lock lock(mutex_);
    return arrived_.wait_for(lock, timeout, [this] { return !waiting_.empty(); });
  }

  /// The scene, with the sea's blends and the surfaces that have come so far.
  std::optional<SceneInfo> scene() const {
    const std::lock_guard lock(mutex_);
    std::optional<SceneInfo> scene = scene_;
    if (!scene) return scene;
    if (sea_) scene->sea = *sea_;
    for (BodyInfo& body : scene->bodies)
      if (const auto found = surfaces_.find(body.id); found != surfaces_.end()) body.surface = found->second;
    return scene;
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

  /// By the time in which this process listened: where it was stopped, nobody was silent.
  bool alive() const {
    const Clock::rep heard = last_heard_;
    return heard != 0 && Clock::duration(last_looked_ - heard) < SourceWatch::kSilence;
  }

  std::uint64_t scene_revision_ = 0;
  std::optional<ServerStatus> status_;
  std::optional<WindSettings> wind_;
  ReceiverCounters counters_;

 private:
  /// The mutex is held, and there is a frame.
  void drop_oldest() {
    ++counters_.replaced;
    waiting_particles_ -= waiting_.front()->particles.size();
    if (spare_.size() < kMostSpareFrames) spare_.push_back(std::move(waiting_.front()));
    waiting_.pop_front();
  }

  /// Likewise, but there may be none.
  std::unique_ptr<OceanFrame> take_oldest() {
    if (waiting_.empty()) return nullptr;
    std::unique_ptr<OceanFrame> frame = std::move(waiting_.front());
    waiting_.pop_front();
    waiting_particles_ -= frame->particles.size();
    return frame;
  }

  void take_samples() {
    take_clock();
    // The status first: with a frame of a paused sea comes that it is paused.
    take<pelagos_StatusV2>(statuses_, "status", &ReceiverCounters::others_refused, [this](const auto& sample) {
      ServerStatus status = wire::from_wire(sample);
      const ClockStamp now = clocks_.now();
      const std::lock_guard lock(mutex_);
      clock_.set_paused(status.paused, now);
      status_ = std::move(status);
    });
    take<pelagos_SceneInfoV1>(
        scenes_, "scene_info", &ReceiverCounters::others_refused, [this](const auto& sample) { accept_scene(sample); },
        [this](const auto& sample, const auto& sender) { keep_for_later(sample, sender); });
    take<pelagos_SeaV1>(*seas_, "sea", &ReceiverCounters::others_refused,
                        [this](const auto& sample) { accept_sea(sample); });
    take<pelagos_BodyShapeV1>(*shapes_, "body_shape", &ReceiverCounters::others_refused,
                              [this](const auto& sample) { accept_shape(sample); });
    take<pelagos_WindV1>(winds_, "wind", &ReceiverCounters::others_refused, [this](const auto& sample) {
      const std::lock_guard lock(mutex_);
      wind_ = sample.has_wind ? std::optional(wire::from_wire(sample.wind)) : std::nullopt;
    });
    take<pelagos_SlickV1>(slicks_, "slick", &ReceiverCounters::slicks_refused,
                          [this](const auto& sample) { accept_slick(sample); });
    take<pelagos_OceanFrameV1>(
        frames_, "frame", &ReceiverCounters::refused, [this](const auto& sample) { accept_frame(sample); },
        [this](const auto&, const auto&) {
          const std::lock_guard lock(mutex_);
          ++counters_.foreign;
        });
    take<pelagos_EventV1>(event_reader_, "event", &ReceiverCounters::others_refused, [this](const auto& sample) {
      Event event = wire::from_wire(sample);
      const std::lock_guard lock(mutex_);
      events_.push_back(std::move(event));
      if (events_.size() > kMostEvents) events_.pop_front();
    });
    if (std::exchange(ask_again_, false)) {  // a new reader gets what was written once
      schedules_ = std::make_unique<DdsReader>(participant_, topics::schedule());
      thread_.attach(*schedules_);
      shapes_ = std::make_unique<DdsReader>(participant_, topics::body_shape());
      thread_.attach(*shapes_);
      seas_ = std::make_unique<DdsReader>(participant_, topics::sea());
      thread_.attach(*seas_);
    }
  }

  /// Answers first: the time that they wait counts as a longer way. The schedule before the frames that it holds for.
  void take_clock() {
    take<pelagos_ClockAnswerV1>(answers_, "clock_answer", &ReceiverCounters::others_refused,
                                [this](const auto& sample) {
                                  const auto stamps = exchange_.match(sample, clocks_.now().clock_ns);
                                  if (!stamps) return;
                                  const std::lock_guard lock(mutex_);
                                  if (!clock_.take(*stamps)) ++counters_.others_refused;
                                });
    take<pelagos_ScheduleV1>(*schedules_, "schedule", &ReceiverCounters::others_refused, [this](const auto& sample) {
      const std::lock_guard lock(mutex_);
      clock_.take(wire::from_wire(sample));
    });
    exchange_.ask_if_due([this] { return clocks_.now().clock_ns; });
  }

  /// Takes what waits in a reader: `accept` gets the samples of the server that is followed, `other` those of others.
  template <class Sample, class Accept, class Other>
  void take(const DdsReader& reader, const char* topic, std::uint64_t ReceiverCounters::*refused, Accept&& accept,
            Other&& other) {
    reader.take_all<Sample>([&](const Sample& sample, const dds_sample_info_t& info) {
      const std::optional<Refusal> fault = wire::find_fault(sample);
      const SourceWatch::Sender sender{sample.source, owners_.of(reader, info.publication_handle)};
      const Standing standing = hear(sender, !fault);
      if (fault) {
        refusals_.tell(topic, *fault);
        const std::lock_guard lock(mutex_);
        ++(counters_.*refused);
      } else if (standing == Standing::kIntruder) {
        refuse_intruder(topic, sample.source);
      } else if (standing == Standing::kOther) {
        other(sample, sender);
      } else if (standing != Standing::kNobody) {
        accept(sample);
      }
    });
  }
  template <class Sample, class Accept>
  void take(const DdsReader& reader, const char* topic, std::uint64_t ReceiverCounters::*refused, Accept&& accept) {
    take<Sample>(reader, topic, refused, std::forward<Accept>(accept), [](const auto&, const auto&) {});
  }

  Standing hear(const SourceWatch::Sender& sender, bool valid) {
    const Standing standing = watch_.hear(sender, valid, listening_.at_last_look());
    if (standing == Standing::kTakenOver) go_over_to(sender);
    if (const auto heard = watch_.last_heard()) last_heard_ = heard->time_since_epoch().count();
    return standing;
  }

  void refuse_intruder(const char* topic, std::uint64_t source) {
    refusals_.tell_once("intruder", std::string("a second process sends ") + topic + " with the source " +
                                        std::to_string(source) +
                                        " of the server that is followed: its samples are refused while the first "
                                        "lives. docs/operators.md says how DDS Security keeps strangers out");
    const std::lock_guard lock(mutex_);
    ++counters_.intruding;
  }

  /// What was known is of another server.
  void go_over_to(const SourceWatch::Sender& sender) {
    count_.restart();
    exchange_.restart();
    ask_again_ = std::exchange(follows_, true);  // shapes and sea of the new server were passed over so far
    const std::lock_guard lock(mutex_);
    scene_.reset();
    sea_.reset();
    surfaces_.clear();
    status_.reset();
    wind_.reset();
    slick_.clear();
    clock_.restart();
    source_ = sender.source;
    // What the new server has said once, while the old one was followed.
    if (const auto other = std::find_if(other_scenes_.begin(), other_scenes_.end(),
                                        [&](const auto& entry) { return entry.first == sender; });
        other != other_scenes_.end()) {
      scene_ = std::move(other->second);
      ++scene_revision_;
      other_scenes_.erase(other);
    }
  }

  void accept_scene(const pelagos_SceneInfoV1& sample) {
    SceneInfo scene = wire::from_wire(sample);
    const std::lock_guard lock(mutex_);
    scene_ = std::move(scene);
    ++scene_revision_;
  }

  void accept_sea(const pelagos_SeaV1& sample) {
    WaveField sea = wire::from_wire(sample);
    const std::lock_guard lock(mutex_);
    sea_ = std::move(sea);
    if (scene_) ++scene_revision_;
  }

  void accept_shape(const pelagos_BodyShapeV1& sample) {
    auto surface = std::make_shared<const BodySurface>(wire::from_wire(sample));
    const std::lock_guard lock(mutex_);
    std::size_t triangles = surface->triangles.size();
    for (const auto& [body, other] : surfaces_)
      if (body != sample.body) triangles += other->triangles.size();
    const bool fits = surfaces_.size() < wire::kMostBodies || surfaces_.contains(sample.body);
    if (!fits || triangles > kMostTriangles) {
      ++counters_.others_refused;
      return;
    }
    surfaces_[sample.body] = std::move(surface);
    if (scene_) ++scene_revision_;
  }

  void keep_for_later(const pelagos_SceneInfoV1& sample, const SourceWatch::Sender& sender) {
    constexpr std::size_t kMostOthers = 8;
    std::erase_if(other_scenes_, [&](const auto& entry) { return entry.first == sender; });
    if (other_scenes_.size() >= kMostOthers) other_scenes_.pop_front();
    other_scenes_.emplace_back(sender, wire::from_wire(sample));
  }

  void accept_frame(const pelagos_OceanFrameV1& sample) {
    const FrameOrder order = count_.count(sample.frame, sample.wall_time_ns);
    if (order == FrameOrder::kRepeated) {
      const std::lock_guard lock(mutex_);
      ++counters_.repeated;
      return;
    }
    if (order == FrameOrder::kJump)
      refusals_.tell_once("jump", "the frame numbers of the server jumped to " + std::to_string(sample.frame) +
                                      ": jumps are counted by themselves, not as frames missed");
    const ClockStamp now = clocks_.now();
    std::unique_ptr<OceanFrame> frame = decode(sample);
    frame->received_ns = now.clock_ns;
    const std::lock_guard lock(mutex_);
    frame->completed_ns = clock_.completed(frame->wall_time_ns);
    if (!by_server(clock_.state(now).clock)) clock_.frame_arrived(now, frame->simulation_time);
    counters_.missed = count_.missed();
    counters_.jumps = count_.jumps();
    ++counters_.received;
    while (!waiting_.empty() && (waiting_.size() >= kMostWaitingFrames ||
                                 waiting_particles_ + frame->particles.size() > kMostWaitingParticles))
      drop_oldest();
    waiting_particles_ += frame->particles.size();
    waiting_.push_back(std::move(frame));
    arrived_.notify_all();
  }

  void accept_slick(const pelagos_SlickV1& sample) {
    auto slick = std::make_shared<OceanSlick>();
    slick->frame = sample.frame;
    slick->simulation_time = sample.simulation_time;
    slick->origin = wire::from_wire(sample.origin);
    slick->discs.reserve(sample.elements._length);
    for (std::uint32_t i = 0; i < sample.elements._length; ++i)
      slick->discs.push_back(wire::from_wire(sample.elements._buffer[i]));
    const std::lock_guard lock(mutex_);
    slick_.push_back(std::move(slick));
    std::size_t discs = 0;
    for (const auto& one : slick_) discs += one->discs.size();
    while (slick_.size() > kMostSlicks || (slick_.size() > 1 && discs > kMostWaitingDiscs)) {
      discs -= slick_.front()->discs.size();
      slick_.pop_front();
    }
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

  LocalClocks clocks_;
  ShowClock clock_;  ///< guarded by the mutex
  RateLimitedLog log_;
  RefusalLog refusals_;
  DdsParticipant participant_;
  const std::uint64_t viewer_;
  ClockExchange exchange_;  ///< of the dispatcher thread
  DdsReader answers_;
  std::unique_ptr<DdsReader> schedules_;
  std::optional<DdsWriter> teller_;  ///< of the thread that tells
  DdsReader frames_;
  DdsReader scenes_;
  std::unique_ptr<DdsReader> seas_;
  DdsReader statuses_;
  std::unique_ptr<DdsReader> shapes_;
  DdsReader winds_;
  DdsReader slicks_;
  DdsReader event_reader_;

  // Of the dispatcher thread alone.
  WriterOwners owners_;
  SourceWatch watch_{[this](const ParticipantId& process) { return is_matched(frames_, process); }};
  FrameCount count_;
  bool follows_ = false, ask_again_ = false;
  std::deque<std::pair<SourceWatch::Sender, SceneInfo>> other_scenes_;

  ListeningTime listening_{Clock::now()};
  std::atomic<Clock::rep> last_heard_{0}, last_looked_{0};  // ticks of the steady clock; 0: never
  mutable std::mutex mutex_;                                // guards what follows, and the public members
  mutable std::condition_variable arrived_;
  std::optional<SceneInfo> scene_;
  std::optional<WaveField> sea_;
  std::map<std::uint32_t, std::shared_ptr<const BodySurface>> surfaces_;  // by body
  std::deque<std::unique_ptr<OceanFrame>> waiting_;                       // the oldest first
  std::size_t waiting_particles_ = 0;
  std::deque<std::shared_ptr<const OceanSlick>> slick_;  // likewise
  std::uint64_t source_ = 0;
  std::vector<std::unique_ptr<OceanFrame>> spare_;
  std::deque<Event> events_;

  ReceiverThread thread_;
};

FrameReceiver::FrameReceiver(const DdsSettings& settings, const LocalClocks& clocks)
    : implementation_(std::make_unique<Implementation>(settings, clocks)) {}
FrameReceiver::~FrameReceiver() = default;

std::unique_ptr<OceanFrame> FrameReceiver::take_newest() { return implementation_->take_newest(); }
std::unique_ptr<OceanFrame> FrameReceiver::take_next() { return implementation_->take_next(); }
void FrameReceiver::recycle(std::unique_ptr<OceanFrame> frame) { implementation_->recycle(std::move(frame)); }
bool FrameReceiver::wait_for_frame(std::chrono::milliseconds timeout) const {
  return implementation_->wait_for_frame(timeout);
}
std::optional<SceneInfo> FrameReceiver::scene_info() const { return implementation_->scene(); }
std::uint64_t FrameReceiver::scene_revision() const { return implementation_->read(&Implementation::scene_revision_); }
std::optional<ServerStatus> FrameReceiver::status() const { return implementation_->read(&Implementation::status_); }
std::optional<WindSettings> FrameReceiver::wind() const { return implementation_->read(&Implementation::wind_); }
std::shared_ptr<const OceanSlick> FrameReceiver::slick() const { return implementation_->newest_slick(); }
std::shared_ptr<const OceanSlick> FrameReceiver::slick_at(double time) const { return implementation_->slick_at(time); }
std::optional<DueInstant> FrameReceiver::due_at(std::int64_t steady_ns) const {
  return implementation_->due_at(steady_ns);
}
ClockState FrameReceiver::clock_state() const { return implementation_->clock_state(); }
void FrameReceiver::tell(ViewerStatus status) { implementation_->tell(std::move(status)); }
std::vector<Event> FrameReceiver::take_events() { return implementation_->take_events(); }
bool FrameReceiver::server_alive() const { return implementation_->alive(); }
ReceiverCounters FrameReceiver::counters() const { return implementation_->read(&Implementation::counters_); }

}  // namespace pelagos
