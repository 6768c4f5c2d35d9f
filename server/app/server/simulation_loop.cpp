#include "simulation_loop.hpp"

#include <fmt/format.h>

#include <chrono>
#include <thread>

#include "describe_command.hpp"
#include "fields/field_hash.hpp"
#include "monotonic_clock.hpp"
#include "pacer.hpp"
#include "server_log.hpp"
#include "world_status.hpp"

namespace pelagos {

namespace {

constexpr std::int64_t kLogIntervalNs = 5'000'000'000;
constexpr std::int64_t kStatusIntervalNs = 100'000'000;
constexpr std::chrono::milliseconds kPausedSleep{5};

/// The paper's own pulse is such a one; other laws refuse it.
void warn_of_endless_pulse(const WindSettings& wind) {
  if (!wind.pulse || wind.law != WindLaw::kPaper || !never_closes(*wind.pulse)) return;
  log_warning(
      fmt::format("wind: its pulse blows {:g} steps of every {:g}: it never closes, the wind blows all the time",
                  wind.pulse->width, wind.pulse->period));
}

ClockStamp stamp_now() { return {monotonic_ns(), wall_ns()}; }

std::uint64_t second_of(std::int64_t ns) { return static_cast<std::uint64_t>(ns / 1'000'000'000); }

}  // namespace

SimulationLoop::SimulationLoop(const LoopParts& parts, const LoopOptions& options, ServerStatus status)
    : parts_(parts), options_(options), window_(monotonic_ns()), status_(std::move(status)) {
  const Scene& scene = parts_.world.scene();
  if (!scene.governor.on || parts_.gate.replay()) return;
  governor_.emplace(scene, parts_.world.effort());
  log_info(fmt::format("governor: a frame may take {:.1f} ms", governor_->budget() * 1e3));
}

ServerEnd SimulationLoop::run(const std::atomic<bool>& stop) {
  World& world = parts_.world;
  start_ns_ = monotonic_ns();
  status_.starting = false;
  next_log_ns_ = start_ns_ + kLogIntervalNs;
  window_ = StatusWindow(start_ns_);
  parts_.announcer.announce("start", "server", "scene " + world.scene().name + " started");
  if (world.scene().wind) warn_of_endless_pulse(*world.scene().wind);
  watches_.look_at_current(world);
  parts_.recorder.check(world);
  check_replay();
  Pacer pacer(world.time());
  while (!ended(stop)) {
    take_inputs();
    parts_.desk.serve(world);
    if (clock_.state() == RunClock::State::kPaused) {
      stand_still();
      pacer.restart(world.time());
      continue;
    }
    const std::uint64_t frame = world.frame();
    make_step();
    clock_.count_step();
    refresh_status();
    if (!clock_.paused() && options_.paced && world.frame() != frame) pacer.wait_for(world.time());
  }
  if (options_.saves_state && !broken_) take_inputs();  // what is due now is part of the state, and not given again
  parts_.announcer.announce("stop", "server", broken_ ? "stopped: values are not finite" : "stopped");
  put_up_status();
  return *ended(stop);
}

std::optional<ServerEnd> SimulationLoop::ended(const std::atomic<bool>& stop) const {
  const World& world = parts_.world;
  if (broken_) return ServerEnd::kNumericalFault;
  if (stop.load()) return ServerEnd::kStopped;
  if (parts_.gate.replay() && parts_.gate.replay()->ended(world.step())) return ServerEnd::kReplayEnded;
  if (options_.duration <= 0.0) return std::nullopt;
  const double passed = options_.paced ? static_cast<double>(monotonic_ns() - start_ns_) * 1e-9 : world.time();
  if (passed < options_.duration - 1e-9) return std::nullopt;
  return ServerEnd::kDurationReached;
}

/// All that is due at this boundary: into the world, answered, told and logged.
void SimulationLoop::take_inputs() {
  World& world = parts_.world;
  parts_.announcer.set_moment(world.step(), world.time());
  parts_.gate.collect(world.step(), world.time(), batch_);
  for (const ScheduleChange& change : batch_.schedule) {
    const ScheduledCommand& c = change.command;
    parts_.announcer.announce("schedule", change.by,
                              fmt::format("{} command {} for {:g} s: {}", change.cancelled ? "cancelled" : "scheduled",
                                          c.id, c.at, describe_command(c.command).text));
  }
  for (const InputGate::Refused& refused : batch_.refused)
    tell_refusal(refused.given.source, describe_command(refused.given.command).text + ": " + to_string(refused.why));
  watches_.look_at_requests(parts_.gate.dropped_requests(), parts_.announcer);
  if (batch_.inputs.empty()) return;
  std::vector<CommandOutcome> outcomes = world.take(batch_.inputs);
  std::vector<bool> done(outcomes.size());
  for (std::size_t k = 0; k < outcomes.size(); ++k) {
    bool changed = true;
    if (steers_clock(outcomes[k].done)) {
      const RunClock::Outcome clock = clock_.apply(outcomes[k].done);
      outcomes[k].refusal = clock.refusal;
      changed = clock.changed;
      tell_schedule(clock_.paused() ? schedule_.pause() : schedule_.resume(stamp_now()));
    }
    done[k] = changed && !outcomes[k].refusal;
    answer(k, outcomes[k], changed);
  }
  parts_.recorder.record(world, batch_.inputs, done, parts_.announcer);
  if (!outcomes.empty()) put_up_status();
}

void SimulationLoop::answer(std::size_t index, const CommandOutcome& outcome, bool changed) {
  if (batch_.answers[index]) batch_.answers[index]({parts_.world.step(), outcome.refusal});
  const std::string& source = batch_.inputs.commands[index].source;
  const CommandNews news = describe_command(outcome.done);
  if (outcome.refusal) return tell_refusal(source, news.text + ": " + to_string(*outcome.refusal));
  if (!changed) return;
  if (std::holds_alternative<SetEffort>(outcome.done)) ++effort_changes_;
  parts_.announcer.announce(news.kind, source, news.text);
  if (std::holds_alternative<SetWaves>(outcome.done) || std::holds_alternative<SetSea>(outcome.done))
    parts_.publisher.publish_sea(parts_.world.sea());
  if (std::holds_alternative<SetCurrent>(outcome.done)) watches_.look_at_current(parts_.world);
}

void SimulationLoop::tell_refusal(const std::string& source, const std::string& text) {
  ++status_.commands_refused;
  status_.last_refusal = fmt::format("{:.3f} s, {}: {}", parts_.world.time(), source, text);
  parts_.announcer.announce("refused", source, text);
}

void SimulationLoop::stand_still() {
  window_.skip_to(monotonic_ns());
  if (frames_filled_ == 0) publish_first_frame();
  const std::uint64_t second = second_of(monotonic_ns());
  std::this_thread::sleep_for(kPausedSleep);
  const bool told = status_.paused;
  refresh_status();
  if (!told || second_of(monotonic_ns()) != second) {
    put_up_status();
    parts_.publisher.submit_status(*parts_.board.status());
  }
}

void SimulationLoop::make_step() {
  const std::int64_t begin = monotonic_ns();
  WorldStep step = parts_.world.advance();
  if (step.sea_renewed) parts_.publisher.publish_sea(parts_.world.sea());
  parts_.announcer.set_moment(parts_.world.step(), parts_.world.time());
  if (step.frame_reached) publish_frame(step.report);
  const double busy = static_cast<double>(monotonic_ns() - begin) * 1e-9;
  frame_busy_s_ += busy;
  if (step.fault != StepFault::kNone) report_fault(step);
  if (step.fault == StepFault::kRestored) return;  // its figures are those of water that is gone
  parts_.recorder.check(parts_.world);
  check_replay();
  window_.add(step.report, busy);
  convergence_.add(step.report, parts_.world.effort());
  last_report_ = step.report;
  if (!step.frame_reached) return;
  if (governor_) govern(frame_busy_s_);
  frame_busy_s_ = 0.0;
}

void SimulationLoop::check_replay() {
  if (!parts_.gate.replay()) return;
  const std::string difference = parts_.gate.check_replay(parts_.world);
  if (difference.empty()) return;
  log_warning("replay: " + difference);
  parts_.announcer.announce("replay", "server", difference);
}

void SimulationLoop::report_fault(const WorldStep& step) {
  const World& world = parts_.world;
  const bool fatal = step.fault == StepFault::kFatal;
  const std::string what = step.report.not_finite > 0
                               ? fmt::format("particles with values that are not finite: {}", step.report.not_finite)
                               : "a free body has values that are not finite";
  if (fatal) {
    broken_ = true;
    log_error(fmt::format("step {}: {}; stopping. Lower time_step.max_step or time_step.cfl in the scene", world.step(),
                          what));
  } else {
    log_warning(fmt::format("step {}: {}; the last good state is back, at {:.3f} s, and smaller steps follow",
                            world.step(), what, world.time()));
  }
  parts_.announcer.announce("numerical_fault", "server",
                            what + (fatal ? "; stopping" : "; the last good state is back"));
}

/// The governor sees how long a frame took; what it decides waits in the queue for the step boundary like any command.
void SimulationLoop::govern(double frame_seconds) {
  const bool was_over = governor_->over_budget();
  const Effort before = governor_->effort();
  const std::optional<Effort> next = governor_->observe(frame_seconds);
  const std::string cost =
      fmt::format("a frame took {:.1f} ms of {:.1f} ms at a density error of {:.2g} %",
                  governor_->frame_seconds() * 1e3, governor_->budget() * 1e3, last_report_.density_error * 1e2);
  if (next) {
    const bool coarser = next->max_step > before.max_step || next->density_tolerance > before.density_tolerance;
    const auto refused = parts_.gate.submit(SetEffort{*next, (coarser ? "coarser, " : "finer, ") + cost}, "governor");
    if (refused) log_warning("governor: " + to_string(*refused));
  }
  if (governor_->over_budget() == was_over) return;
  if (was_over) {
    parts_.announcer.announce("governor", "governor", "within the budget again: " + cost);
    return;
  }
  const auto interval = options_.paced ? std::optional(parts_.world.scene().frame_interval) : std::nullopt;
  log_warning("governor: at the scene's bounds, and " + cost + "; " + governor_->advice(interval));
  parts_.announcer.announce("governor", "governor", "at the scene's bounds and over the budget: " + cost);
}

void SimulationLoop::publish_frame(StepReport& report) {
  std::unique_ptr<Snapshot> snapshot = parts_.publisher.acquire();
  const std::int64_t begin = monotonic_ns();
  parts_.world.take_frame(*snapshot, report);
  surface_s_ += static_cast<double>(monotonic_ns() - begin) * 1e-9;
  submit_frame(std::move(snapshot));
}

/// The water at rest, for viewers of a sea that is paused before its first frame. To look at it changes nothing.
void SimulationLoop::publish_first_frame() {
  std::unique_ptr<Snapshot> snapshot = parts_.publisher.acquire();
  parts_.world.look(*snapshot);
  submit_frame(std::move(snapshot));
}

void SimulationLoop::submit_frame(std::unique_ptr<Snapshot> snapshot) {
  ++frames_filled_;
  const ClockStamp now = stamp_now();
  snapshot->wall_time_ns = now.utc_ns;
  snapshot->schedule = schedule_.add_frame(now, snapshot->simulation_time);
  status_.published_particles = static_cast<std::uint32_t>(snapshot->particles.size());
  if (snapshot->oil) status_.oil = snapshot->oil->budget;
  snapshot->status = status_;
  watches_.look(parts_.world, *snapshot, parts_.announcer);
  parts_.publisher.submit(std::move(snapshot));
}

void SimulationLoop::tell_schedule(const std::optional<SchedulePiece>& piece) {
  if (piece) parts_.publisher.publish_schedule(*piece);
}

void SimulationLoop::refresh_status() {
  const std::int64_t now = monotonic_ns();
  parts_.recorder.flush(parts_.announcer);
  const bool rolled = window_.roll(now, status_);
  const bool news = parts_.announcer.count() != announced_;  // whoever hears of it may ask
  if (rolled || news || now >= next_status_ns_) put_up_status();
  watches_.look_at_poses(parts_.gate.pose_counters(), parts_.announcer);
  if (now < next_log_ns_) return;
  next_log_ns_ = now + kLogIntervalNs;
  put_up_status();
  log_status();
}

void SimulationLoop::put_up_status() {
  const World& world = parts_.world;
  next_status_ns_ = monotonic_ns() + kStatusIntervalNs;
  announced_ = parts_.announcer.count();
  const PublisherCounters sent = parts_.publisher.counters();
  fill_from(world, status_);
  status_.paused = clock_.paused();
  status_.kinetic_energy = last_report_.kinetic_energy;
  status_.largest_speed = last_report_.largest_speed;
  status_.frames_published = sent.published;
  status_.frames_dropped = sent.dropped;
  fill_pose_counts();
  // Between frames only what commands change about the oil is looked at anew.
  if (world.spill() && (!status_.oil || !batch_.inputs.commands.empty())) status_.oil = world.spill()->budget();
  status_.governed = governor_.has_value();
  status_.over_budget = governor_ && governor_->over_budget();
  if (auto log = parts_.recorder.state()) status_.command_log = std::move(*log);
  if (status_.paused) status_.real_time_factor = 0.0;
  parts_.board.put_up(status_, world.air());
}

void SimulationLoop::fill_pose_counts() {
  const PoseCounters poses = parts_.gate.pose_counters();
  status_.poses_accepted = poses.accepted;
  status_.poses_refused = poses.refused_in_all();
  status_.poses_corrected = poses.corrected;
  status_.pose_refusals.clear();
  for (std::size_t k = 0; k < poses.refused.size(); ++k)
    if (poses.refused[k] > 0) status_.pose_refusals.push_back({describe(static_cast<PoseFault>(k)), poses.refused[k]});
}

void SimulationLoop::log_status() {
  const ServerStatus& status = status_;
  std::string line = fmt::format(
      "t {:.1f} s: real-time factor {:.2f} (could reach {:.1f}), step {:.1f} ms, density error {:.3f} %, steps "
      "not converged: {}, particles sent: {} of {}, frames: {}, dropped: {}, readers: {}{}",
      status.simulation_time, status.real_time_factor, status.achievable_real_time_factor, status.step_ms,
      status.density_error * 100.0, status.unconverged_steps, status.published_particles, status.particles,
      status.frames_published, status.frames_dropped, parts_.publisher.viewers(), status.paused ? ", paused" : "");
  if (status.governed)
    line += fmt::format(", governed: steps up to {:.2f} ms, tolerances {:.2g} and {:.2g}", status.effort.max_step * 1e3,
                        status.effort.density_tolerance, status.effort.divergence_tolerance);
  // Below real time through lack of speed, not because of a pause or a start.
  const bool too_slow = options_.paced && !status.paused && status.achievable_real_time_factor > 0.0 &&
                        status.achievable_real_time_factor < 1.0;
  if (too_slow) {
    log_warning(line + "; this machine cannot keep up: give it more threads, fewer other tasks or a larger spacing");
  } else {
    log_info(line);
  }
  const std::string missed = convergence_.take();
  if (!missed.empty()) log_warning(missed);
}

RunningMeans SimulationLoop::whole_run() const { return window_.whole_run(monotonic_ns()); }

double SimulationLoop::mean_surface_ms() const {
  return frames_filled_ > 0 ? surface_s_ * 1e3 / static_cast<double>(frames_filled_) : 0.0;
}

}  // namespace pelagos
