#include "transport/frame_publisher.hpp"

#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <deque>
#include <mutex>
#include <optional>
#include <random>
#include <thread>
#include <utility>
#include <vector>

#include "pelagos_dds/entities.hpp"
#include "pelagos_dds/log_sink.hpp"
#include "wire/convert.hpp"
#include "wire/topics.hpp"

namespace pelagos {
namespace {

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;
using Microseconds = std::chrono::duration<double, std::micro>;

constexpr std::size_t kMostSpareSnapshots = 3;  // one being filled, one waiting, one being packed
constexpr std::size_t kMostWaitingEvents = 256;
/// The publisher looks for work that often instead of being woken: waking a thread can cost the simulation its core for
/// milliseconds on a busy machine (a mean hand-over of 0.35 ms with three viewers drawing, against a microsecond).
constexpr std::chrono::milliseconds kPoll{2};

std::uint64_t draw_source() {
  std::random_device device;
  const std::uint64_t high = device();
  return std::max<std::uint64_t>(1, high << 32 | device());
}

/// So often at least a server is heard, and its last frame is sent again while no new one comes: a viewer that joins a
/// paused sea has something to show within this time.
constexpr std::chrono::milliseconds kRepeat{500};

/// A thread that comes back from sleep may push another off its core at once, on busy machines for as long as a frame
/// takes to publish. A batch thread does not: it waits for its turn, some milliseconds later.
void use_batch_scheduling() {
  const sched_param parameters{};
  (void)pthread_setschedparam(pthread_self(), SCHED_BATCH, &parameters);  // without it, it works as well
}

/// Octets of an OceanFrameV1 in CDR besides the payload: encapsulation, header and bodies.
std::size_t header_octets(std::size_t bodies) { return 112 + bodies * 128; }

}  // namespace

class FramePublisher::Implementation {
 public:
  Implementation(std::shared_ptr<DdsParticipant> participant, const std::optional<SceneInfo>& info,
                 const PublisherSettings& settings, DdsLog log)
      : source_(settings.source != 0 ? settings.source : draw_source()),
        frame_(settings.bodies_in_ned ? pelagos_FRAME_NED : pelagos_FRAME_ENU),
        status_interval_(std::chrono::duration_cast<Clock::duration>(
            std::chrono::duration<double>(std::clamp(settings.status_interval, 0.0, 3600.0)))),
        log_(std::move(log)),
        participant_(std::move(participant)),
        scene_writer_(*participant_, topics::scene_info()),
        sea_writer_(*participant_, topics::sea()),
        shape_writer_(*participant_, topics::body_shape()),
        schedule_writer_(*participant_, topics::schedule()),
        frame_writer_(*participant_, topics::ocean_frame()),
        status_writer_(*participant_, topics::status()),
        wind_writer_(*participant_, topics::wind()),
        event_writer_(*participant_, topics::event()) {
    if (const auto warning = check_receive_buffer()) log_.write(*warning);  // viewers mostly run on this machine too
    if (info) publish_scene_info(*info);
    thread_ = std::thread([this] { run(); });
  }

  ~Implementation() {
    stop_ = true;
    thread_.join();
    for (std::atomic<Snapshot*>& slot : spare_) delete slot.load();
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  std::unique_ptr<Snapshot> acquire() {
    for (std::atomic<Snapshot*>& slot : spare_) {
      std::unique_ptr<Snapshot> snapshot(slot.exchange(nullptr));
      if (!snapshot) continue;
      snapshot->particles.clear();
      snapshot->bodies.clear();
      snapshot->loads.clear();
      snapshot->schedule.reset();
      return snapshot;
    }
    return std::make_unique<Snapshot>();
  }

  void submit(std::unique_ptr<Snapshot> snapshot) {
    if (!snapshot) return;
    const auto begin = Clock::now();
    ++submitted_;
    std::unique_ptr<Snapshot> replaced(waiting_.exchange(snapshot.release()));
    if (replaced) {
      ++dropped_;
      keep_spare(std::move(replaced));
    }
    // Only the submitting thread writes these.
    const double taken = Microseconds(Clock::now() - begin).count();
    handover_us_ = handover_us_ + taken;
    handover_us_peak_ = std::max(handover_us_peak_.load(), taken);
  }

  void submit_status(const ServerStatus& status) {
    {
      const std::lock_guard lock(mutex_);
      waiting_status_ = status;
    }
  }

  void publish_event(const Event& event) {
    {
      const std::lock_guard lock(mutex_);
      if (events_.size() >= kMostWaitingEvents) {
        events_.pop_front();
        ++counters_.events_dropped;
      }
      events_.push_back(event);
    }
  }

  void publish_scene_info(const SceneInfo& info) {
    {
      const std::lock_guard lock(mutex_);
      particle_spacing_ = info.particle_spacing;
    }
    for (const BodyInfo& body : info.bodies) {
      if (!body.surface) continue;
      const wire::BodyShapeSample shape(*body.surface, body.id, source_);
      count_write(shape_writer_.write(&shape.get()), "body_shape");
    }
    publish_now(info.sea);
    const wire::SceneInfoSample sample(info, source_);
    count_write(scene_writer_.write(&sample.get()), "scene_info");
  }

  void publish_sea(const WaveField& sea) {
    const std::lock_guard lock(mutex_);
    waiting_sea_ = sea;
  }

  void publish_schedule(const SchedulePiece& piece) {
    const std::lock_guard lock(mutex_);
    waiting_schedule_ = piece;
  }

  std::uint64_t source() const { return source_; }
  std::uint32_t viewers() const { return frame_writer_.matched_readers(); }

  PublisherCounters counters() const {
    const std::lock_guard lock(mutex_);
    PublisherCounters result = counters_;
    result.submitted = submitted_;
    result.dropped = dropped_;
    const auto frames = static_cast<double>(std::max<std::uint64_t>(1, result.published));
    result.handover_us_peak = handover_us_peak_;
    result.handover_us_mean = handover_us_ / static_cast<double>(std::max<std::uint64_t>(1, result.submitted));
    result.pack_ms_mean = pack_ms_ / frames;
    result.frame_ms_mean = frame_ms_ / frames;
    return result;
  }

 private:
  /// What there is to publish, taken out of the mailbox at once.
  struct Work {
    std::unique_ptr<Snapshot> snapshot;
    std::optional<ServerStatus> status;
    std::deque<Event> events;
    std::optional<WaveField> sea;
    std::optional<SchedulePiece> schedule;
    double particle_spacing = 0.0;
  };

  void run() {
    use_batch_scheduling();
    Work work;
    while (wait_for_work(work)) {
      try {
        publish(work);
      } catch (const std::exception& error) {  // out of memory: this frame is lost, the next may do
        count_write(false, error.what());
      }
      keep_spare(std::move(work.snapshot));
    }
  }

  /// False when stopped and nothing is left.
  bool wait_for_work(Work& work) {
    for (;;) {
      const bool last_round = stop_;
      work.snapshot.reset(waiting_.exchange(nullptr));
      {
        const std::lock_guard lock(mutex_);
        work.status = std::exchange(waiting_status_, std::nullopt);
        work.events = std::exchange(events_, {});
        work.sea = std::exchange(waiting_sea_, std::nullopt);
        work.schedule = std::exchange(waiting_schedule_, std::nullopt);
        work.particle_spacing = particle_spacing_;
      }
      if (work.snapshot || work.status || work.sea || work.schedule || !work.events.empty()) return true;
      if (Clock::now() - last_sign_ >= kRepeat) return true;  // with nothing new
      if (last_round) return false;
      std::this_thread::sleep_for(kPoll);
    }
  }

  void publish(const Work& work) {
    if (!work.snapshot && Clock::now() - last_sign_ >= kRepeat) repeat_last();
    for (const Event& event : work.events) {
      const pelagos_EventV1 sample = wire::to_wire(event, source_);
      count_write(event_writer_.write(&sample), "event");
    }
    if (work.sea) publish_now(*work.sea);
    publish_schedules(work);
    if (work.snapshot) publish_frame(*work.snapshot, work.particle_spacing);
    if (work.snapshot) publish_loads(*work.snapshot);
    if (work.snapshot) publish_probes(*work.snapshot);
    if (work.snapshot && work.snapshot->oil) publish_oil(*work.snapshot, *work.snapshot->oil);
    if (work.status) {
      publish_status(*work.status);
    } else if (work.snapshot && is_due(work.snapshot->status)) {
      publish_status(work.snapshot->status);
    }
  }

  /// In the order of their moments; of one moment that of the frame first, which the other one changes.
  void publish_schedules(const Work& work) {
    const SchedulePiece* of_frame = work.snapshot && work.snapshot->schedule ? &*work.snapshot->schedule : nullptr;
    const SchedulePiece* other = work.schedule ? &*work.schedule : nullptr;
    if (of_frame != nullptr && other != nullptr && other->clock_ns < of_frame->clock_ns) std::swap(of_frame, other);
    if (of_frame != nullptr) publish_now(*of_frame);
    if (other != nullptr) publish_now(*other);
  }

  void publish_now(const WaveField& sea) {
    const wire::SeaSample sample(sea, source_);
    count_write(sea_writer_.write(&sample.get()), "sea");
  }

  void publish_now(const SchedulePiece& piece) {
    const pelagos_ScheduleV1 sample = wire::to_wire(piece, source_);
    count_write(schedule_writer_.write(&sample), "schedule");
  }

  /// Once an interval, and at once when the sea stops or goes on.
  [[nodiscard]] bool is_due(const ServerStatus& status) const {
    return Clock::now() - last_status_ >= status_interval_ ||
           (status_to_repeat_ && status_to_repeat_->paused != status.paused);
  }

  /// What viewers that have just come need, and a sign of life for the others. The status first, so that they know
  /// whether the frame is that of a paused sea.
  void repeat_last() {
    last_sign_ = Clock::now();
    if (status_to_repeat_) publish_status(*status_to_repeat_);
    if (!has_frame_ || frame_writer_.matched_readers() == 0) return;
    count_write(frame_writer_.write(&frame_sample_.get()), "frame");
    if (oil_sample_) count_write(slick_writer_->write(&oil_sample_->slick()), "slick");
  }

  void publish_frame(const Snapshot& snapshot, double particle_spacing) {
    const auto begin = Clock::now();
    last_sign_ = begin;
    const std::uint32_t refused = frame_sample_.fill(snapshot, particle_spacing, source_, frame_);
    has_frame_ = true;
    const auto packed = Clock::now();
    const pelagos_OceanFrameV1& sample = frame_sample_.get();
    const bool written = frame_writer_.write(&sample);
    const auto end = Clock::now();
    count_write(written, "frame");
    if (refused > 0) {
      log_.write("frame " + std::to_string(snapshot.frame) + ": " + std::to_string(refused) +
                 " particles left out, their values are not finite or absurd");
    }
    const std::lock_guard lock(mutex_);
    counters_.refused_particles += refused;
    if (!written) return;
    ++counters_.published;
    pack_ms_ += Milliseconds(packed - begin).count();
    const double frame_ms = Milliseconds(end - begin).count();
    frame_ms_ += frame_ms;
    counters_.frame_ms_peak = std::max(counters_.frame_ms_peak, frame_ms);
    if (sample.count > 0) {
      const std::size_t octets = sample.payload._length + header_octets(snapshot.bodies.size());
      counters_.bytes_per_particle = static_cast<double>(octets) / sample.count;
    }
  }

  void publish_oil(const Snapshot& snapshot, const OilSnapshot& oil) {
    if (!slick_writer_) {  // the topics are there in scenes with oil only
      slick_writer_.emplace(*participant_, topics::slick());
      oil_budget_writer_.emplace(*participant_, topics::oil_budget());
    }
    oil_sample_.emplace(snapshot, oil, source_);
    count_write(slick_writer_->write(&oil_sample_->slick()), "slick");
    count_write(oil_budget_writer_->write(&oil_sample_->budget()), "oil_budget");
  }

  void publish_loads(const Snapshot& snapshot) {
    if (snapshot.loads.empty()) return;
    if (!load_writer_) load_writer_.emplace(*participant_, topics::body_load());  // in scenes with moving bodies only
    for (const BodyLoad& load : snapshot.loads) {
      const pelagos_BodyLoadV1 sample = wire::to_wire(load, snapshot, source_, frame_);
      count_write(load_writer_->write(&sample), "body_load");
    }
  }

  void publish_probes(const Snapshot& snapshot) {
    if (snapshot.probes.empty()) return;
    if (!probe_writer_) probe_writer_.emplace(*participant_, topics::probe());
    for (const ProbeReading& reading : snapshot.probes) {
      const pelagos_ProbeV1 sample = wire::to_wire(reading, snapshot, source_, frame_);
      count_write(probe_writer_->write(&sample), "probe");
      if (reading.air) publish_air(reading, snapshot);
    }
  }

  void publish_air(const ProbeReading& reading, const Snapshot& snapshot) {
    if (!air_writer_) air_writer_.emplace(*participant_, topics::air());
    const pelagos_AirV1 sample = wire::air_to_wire(reading, snapshot, source_, frame_);
    count_write(air_writer_->write(&sample), "air");
  }

  /// Status, and the wind with it.
  void publish_status(ServerStatus status) {
    last_status_ = Clock::now();
    status_to_repeat_ = status;
    {
      const std::lock_guard lock(mutex_);
      status.frames_published = counters_.published;
      status.frames_dropped = dropped_;
    }
    const wire::StatusSample sample(status, source_, frame_);
    count_write(status_writer_.write(&sample.get()), "status");

    pelagos_WindV1 wind{};
    wind.source = source_;
    wind.simulation_time = status.simulation_time;
    wind.has_wind = status.wind.has_value();
    wind.wind = wire::to_wire(status.wind);
    count_write(wind_writer_.write(&wind), "wind");
  }

  void count_write(bool written, const std::string& what) {
    if (written) return;
    log_.write("cannot publish " + what);
    const std::lock_guard lock(mutex_);
    ++counters_.failed;
  }

  void keep_spare(std::unique_ptr<Snapshot> snapshot) {
    for (std::atomic<Snapshot*>& slot : spare_) {
      Snapshot* empty = nullptr;
      if (!snapshot || slot.compare_exchange_strong(empty, snapshot.get())) {
        (void)snapshot.release();
        return;
      }
    }
  }

  const std::uint64_t source_;
  const pelagos_WorldFrame frame_;
  const Clock::duration status_interval_;
  RateLimitedLog log_;
  std::shared_ptr<DdsParticipant> participant_;
  DdsWriter scene_writer_;
  DdsWriter sea_writer_;
  DdsWriter shape_writer_;
  DdsWriter schedule_writer_;
  DdsWriter frame_writer_;
  DdsWriter status_writer_;
  DdsWriter wind_writer_;
  DdsWriter event_writer_;
  std::optional<DdsWriter> load_writer_, probe_writer_, air_writer_;  ///< of the publisher thread
  std::optional<DdsWriter> slick_writer_, oil_budget_writer_;         ///< of the publisher thread

  // Of the publisher thread alone.
  wire::OceanFrameSample frame_sample_;
  bool has_frame_ = false;                     ///< in frame_sample_
  std::optional<wire::OilSample> oil_sample_;  ///< of the same frame; of its skimmers' names nothing is sent again
  std::optional<ServerStatus> status_to_repeat_;
  Clock::time_point last_status_{}, last_sign_{Clock::now()};

  // The mailbox: no locks, since a thread that holds one may lose its core to the very thread that waits for it.
  std::atomic<Snapshot*> waiting_{nullptr};
  std::array<std::atomic<Snapshot*>, kMostSpareSnapshots> spare_{};
  std::atomic<bool> stop_{false};
  std::atomic<std::uint64_t> submitted_{0};
  std::atomic<std::uint64_t> dropped_{0};
  std::atomic<double> handover_us_{0.0};  // sum
  std::atomic<double> handover_us_peak_{0.0};

  mutable std::mutex mutex_;  // guards what follows; submit() and acquire() do without
  std::optional<ServerStatus> waiting_status_;
  std::deque<Event> events_;
  std::optional<WaveField> waiting_sea_;
  std::optional<SchedulePiece> waiting_schedule_;
  double particle_spacing_ = 0.0;
  PublisherCounters counters_;
  double pack_ms_ = 0.0;  // sums of what counters() gives the mean of
  double frame_ms_ = 0.0;

  std::thread thread_;
};

FramePublisher::FramePublisher(std::shared_ptr<DdsParticipant> participant, const std::optional<SceneInfo>& info,
                               const PublisherSettings& settings, DdsLog log)
    : implementation_(std::make_unique<Implementation>(std::move(participant), info, settings, std::move(log))) {}
FramePublisher::~FramePublisher() = default;

std::unique_ptr<Snapshot> FramePublisher::acquire() { return implementation_->acquire(); }
void FramePublisher::submit(std::unique_ptr<Snapshot> snapshot) { implementation_->submit(std::move(snapshot)); }
void FramePublisher::submit_status(const ServerStatus& status) { implementation_->submit_status(status); }
void FramePublisher::publish_event(const Event& event) { implementation_->publish_event(event); }
void FramePublisher::publish_scene_info(const SceneInfo& info) { implementation_->publish_scene_info(info); }
void FramePublisher::publish_sea(const WaveField& sea) { implementation_->publish_sea(sea); }
void FramePublisher::publish_schedule(const SchedulePiece& piece) { implementation_->publish_schedule(piece); }
std::uint64_t FramePublisher::source() const { return implementation_->source(); }
PublisherCounters FramePublisher::counters() const { return implementation_->counters(); }
std::uint32_t FramePublisher::viewers() const { return implementation_->viewers(); }

}  // namespace pelagos
