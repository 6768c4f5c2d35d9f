#include "server.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "control/endpoint.hpp"
#include "monotonic_clock.hpp"
#include "pacer.hpp"
#include "pelagos_dds/log_sink.hpp"
#include "server_log.hpp"

namespace pelagos {

namespace {

constexpr std::int64_t kLogIntervalNs = 5'000'000'000;
constexpr std::chrono::milliseconds kPausedSleep{5};

std::vector<std::uint32_t> driven_bodies(const Scene& scene) {
  std::vector<std::uint32_t> ids;
  for (const BodySettings& body : scene.bodies)
    if (is_led(body.drive)) ids.push_back(body.id);
  return ids;
}

/// The paper's own pulse is such a one; other laws refuse it.
void warn_of_endless_pulse(const WindSettings& wind) {
  if (!wind.pulse || wind.law != WindLaw::kPaper || !never_closes(*wind.pulse)) return;
  log_warning(
      fmt::format("wind: its pulse blows {:g} steps of every {:g}: it never closes, the wind blows all the time",
                  wind.pulse->width, wind.pulse->period));
}

const char* describe_health(PoseHealth health) {
  switch (health) {
    case PoseHealth::kNone:
      return "no pose yet: the body holds where the scene put it";
    case PoseHealth::kFresh:
      return "poses are fresh";
    case PoseHealth::kCoasting:
      return "poses are stale: the body coasts";
    case PoseHealth::kHolding:
      return "poses are stale: the body is brought to rest and holds";
  }
  return "";
}

}  // namespace

Server::Server(const ServerOptions& options, const std::atomic<bool>& stop)
    : options_(options),
      stop_(stop),
      commands_(options.replay ? std::vector<SceneEvent>{} : options.scene.events, options.scene.wind),
      window_(monotonic_ns()) {
  status_.scene = options_.scene.name;
  open_links();
  open_command_log();
}

Server::~Server() {
  control_.reset();  // first: its hooks use everything else
  poses_.reset();
  probe_requests_.reset();
  publisher_.reset();
  install_dds_log({});
}

ControlHooks Server::control_hooks() {
  ControlHooks hooks;
  hooks.submit = [this](const Command& c, const std::string& source) {
    const auto refusal = refuse_in_replay(c);
    return refusal ? refusal : commands_.submit(c, source);
  };
  hooks.schedule = [this](const Command& c, double at, const std::string& source) { return schedule(c, at, source); };
  hooks.cancel = [this](std::uint64_t id, const std::string& source) { return commands_.cancel(id, source); };
  hooks.scheduled = [this] { return commands_.scheduled(); };
  hooks.wind_before = [this](std::optional<double> at) { return commands_.wind_before(at); };
  hooks.find_misfit = [this, site = command_site(options_.scene)](const Command& c, std::optional<double> at) {
    if (auto misfit = find_misfit(c, site)) return misfit;
    const GivenNames given = commands_.names_before(at);
    auto misfit = find_unknown_name(c, given);
    return misfit ? misfit : find_no_room(c, given);
  };
  hooks.status = [this] { return current_status(); };
  hooks.read_air = [this](const std::vector<Eigen::Vector3d>& position) { return read_air(position); };
  hooks.log = [](LogLevel level, std::string_view text) {
    level == LogLevel::kInfo ? log_info(text) : level == LogLevel::kWarning ? log_warning(text) : log_error(text);
  };
  return hooks;
}

void Server::open_links() {
  control_ = std::make_unique<ControlServer>(options_.control, control_hooks());
  log_info("control: listening on " + to_string(Endpoint{options_.control.host, control_->port()}));

  install_dds_log([](std::string_view line) { log_warning(line); });
  DdsSettings dds;
  dds.domain = options_.domain;
  dds.config_file = options_.dds_config;
  dds.log = [](std::string_view line) { log_warning(line); };
  const auto participant = join_dds(dds);
  tell_open_links(*participant, dds);
  PublisherSettings settings;
  settings.bodies_in_ned = options_.bodies_in_ned;
  publisher_ = std::make_unique<FramePublisher>(participant, std::nullopt, settings, dds.log);
  publisher_->submit_status(status_);  // viewers see that a server starts
  open_world();
  publisher_->publish_scene_info(world_->describe());
  PoseLimits limits;
  limits.spacing = options_.scene.particle_spacing;
  poses_ = std::make_unique<PoseReceiver>(participant, driven_bodies(options_.scene), options_.scene.origin, dds.log,
                                          limits);
  probe_requests_ = std::make_unique<ProbeReceiver>(participant);
}

void Server::open_world() {
  WorldOptions world;
  world.threads = options_.threads;
  world.clock = monotonic_ns;
  world.progress = [this](double) { return !stop_.load(); };
  log_info(fmt::format("scene {}: placing and settling the water", options_.scene.name));
  world_ = std::make_unique<World>(options_.scene, world);
  for (const std::string& note : world_->bodies().mesh_notes()) log_info(note);
  tell_names();
  for (const std::string& note : world_->start_notes()) log_warning("start: " + note);
  {
    const std::scoped_lock lock(status_mutex_);
    status_.start_notes = world_->start_notes();
  }
  if (options_.scene.governor.on && !options_.replay) {
    governor_.emplace(options_.scene, world_->effort());
    log_info(fmt::format("governor: a frame may take {:.1f} ms", governor_->budget() * 1e3));
  }
  log_info(
      fmt::format("scene {}: {} particles of {:g} m, {} boundary samples ({} on bodies), {} threads; DDS domain {}",
                  options_.scene.name, world_->fluid().particles.count, options_.scene.particle_spacing,
                  world_->fluid().static_walls + world_->bodies().moving_sample_count(),
                  world_->bodies().sample_count(), options_.threads, options_.domain));
}

ServerSummary Server::run() {
  start_ns_ = monotonic_ns();
  next_log_ns_ = start_ns_ + kLogIntervalNs;
  window_ = StatusWindow(start_ns_);
  announce("start", "server", "scene " + options_.scene.name + " started");
  if (options_.scene.wind) warn_of_endless_pulse(*options_.scene.wind);
  Pacer pacer(world_->time());
  if (world_->current()) notice_closed_axes();
  while (!stop_.load() && !out_of_time() && !replay_ended() && !broken_) {
    take_probe_requests();
    apply_commands();
    take_poses();
    if (paused_ && steps_to_make_ == 0) {
      wait_paused();
      pacer.restart(world_->time());
      continue;
    }
    const std::uint64_t frame = world_->frame();
    advance();
    if (paused_) {
      --steps_to_make_;
    } else if (options_.paced && world_->frame() != frame) {
      pacer.wait_for(world_->time());
    }
    refresh_status();
  }
  announce("stop", "server", broken_ ? "stopped: values are not finite" : "stopped");
  close_command_log();
  return summarize();
}

ServerSummary Server::summarize() {
  ServerSummary summary;
  summary.end = broken_          ? ServerEnd::kNumericalFault
                : stop_.load()   ? ServerEnd::kStopped
                : replay_ended() ? ServerEnd::kReplayEnded
                                 : ServerEnd::kDurationReached;
  summary.status = current_status();
  summary.run = window_.whole_run(monotonic_ns());
  summary.lowest_real_time_factor = window_.lowest_real_time_factor();
  summary.surface_ms_mean = frames_filled_ > 0 ? surface_s_ * 1e3 / static_cast<double>(frames_filled_) : 0.0;
  summary.publisher = publisher_->counters();
  summary.poses = poses_->counters();
  summary.control = control_->statistics();
  summary.effort_changes = effort_changes_;
  summary.frame_budget = governor_ ? governor_->budget() : 0.0;
  summary.hull_samples = world_->bodies().sample_count();
  summary.threads = options_.threads;
  summary.state_hash = state_hash(world_->fluid().particles);
  summary.log_failed = command_log_ && command_log_->failed();
  return summary;
}

bool Server::out_of_time() const {
  if (options_.duration <= 0.0) return false;
  const double passed = options_.paced ? static_cast<double>(monotonic_ns() - start_ns_) * 1e-9 : world_->time();
  return passed >= options_.duration - 1e-9;
}

void Server::take_poses() {
  poses_->take_newest(taken_poses_);
  for (const ReceivedPose& received : taken_poses_) world_->accept_pose(received.pose);
}

void Server::advance() {
  const std::int64_t begin = monotonic_ns();
  WorldStep step = world_->advance();
  if (step.frame_reached) publish_frame(step.report);
  const double busy = static_cast<double>(monotonic_ns() - begin) * 1e-9;
  frame_busy_s_ += busy;
  if (step.fault != StepFault::kNone) report_fault(step);
  if (step.fault == StepFault::kRestored) return;  // its figures are those of water that is gone
  window_.add(step.report, busy);
  convergence_.add(step.report, world_->effort());
  last_report_ = step.report;
  if (!step.frame_reached) return;
  if (governor_) govern(frame_busy_s_);
  frame_busy_s_ = 0.0;
}

void Server::report_fault(const WorldStep& step) {
  const bool fatal = step.fault == StepFault::kFatal;
  const std::string what = step.report.not_finite > 0
                               ? fmt::format("{} particles have values that are not finite", step.report.not_finite)
                               : "a free body has values that are not finite";
  if (fatal) {
    broken_ = true;
    log_error(fmt::format("step {}: {}; stopping. Lower time_step.max_step or time_step.cfl in the scene",
                          world_->step(), what));
  } else {
    ++recoveries_;
    log_warning(fmt::format("step {}: {}; the last good state is back, at {:.3f} s, and smaller steps follow",
                            world_->step(), what, world_->time()));
  }
  announce("numerical_fault", "server", what + (fatal ? "; stopping" : "; the last good state is back"));
}

/// The governor sees how long a frame took; what it decides waits in the queue for the step boundary like any command.
void Server::govern(double frame_seconds) {
  const bool was_over = governor_->over_budget();
  const Effort before = governor_->effort();
  const std::optional<Effort> next = governor_->observe(frame_seconds);
  const std::string cost =
      fmt::format("a frame took {:.1f} ms of {:.1f} ms at a density error of {:.2g} %",
                  governor_->frame_seconds() * 1e3, governor_->budget() * 1e3, last_report_.density_error * 1e2);
  if (next) {
    const bool coarser = next->max_step > before.max_step || next->density_tolerance > before.density_tolerance;
    const auto refused = commands_.submit(SetEffort{*next, (coarser ? "coarser, " : "finer, ") + cost}, "governor");
    if (refused) log_warning("governor: " + *refused);
  }
  if (governor_->over_budget() == was_over) return;
  if (was_over) {
    announce("governor", "governor", "within the budget again: " + cost);
    return;
  }
  const auto interval = options_.paced ? std::optional(options_.scene.frame_interval) : std::nullopt;
  log_warning("governor: at the scene's bounds, and " + cost + "; " + governor_->advice(interval));
  announce("governor", "governor", "at the scene's bounds and over the budget: " + cost);
}

void Server::publish_frame(StepReport& report) {
  std::unique_ptr<Snapshot> snapshot = publisher_->acquire();
  const std::int64_t begin = monotonic_ns();
  world_->fill_snapshot(*snapshot, report);
  surface_s_ += static_cast<double>(monotonic_ns() - begin) * 1e-9;
  ++frames_filled_;
  snapshot->wall_time_ns = wall_ns();
  {
    const std::scoped_lock lock(status_mutex_);
    status_.published_particles = static_cast<std::uint32_t>(snapshot->particles.size());
    snapshot->status = status_;
  }
  watch_poses(snapshot->bodies);
  watch_places(snapshot->bodies);
  for (const std::string& news : hold_watch_.look(world_->bodies().holds())) announce("hold", "server", news);
  if (snapshot->oil) watch_oil(snapshot->oil->budget);
  publisher_->submit(std::move(snapshot));
}

void Server::wait_paused() {
  window_.skip_to(monotonic_ns());
  if (frames_filled_ == 0) publish_first_frame();
  const std::uint64_t second = static_cast<std::uint64_t>(monotonic_ns() / 1'000'000'000);
  std::this_thread::sleep_for(kPausedSleep);
  const bool told = status_.paused;  // only this thread writes it
  refresh_status();
  if (!told || static_cast<std::uint64_t>(monotonic_ns() / 1'000'000'000) != second)
    publisher_->submit_status(current_status());
}

/// The water at rest, for viewers of a sea that is paused before its first frame.
void Server::publish_first_frame() {
  StepReport report = last_report_;
  publish_frame(report);
}

void Server::refresh_status() {
  const std::int64_t now = monotonic_ns();
  if (log_fault_told_ && now >= next_flush_ns_) watch_command_log();
  const PublisherCounters sent = publisher_->counters();
  ServerStatus status;
  {
    const std::scoped_lock lock(status_mutex_);
    window_.roll(now, status_);
    status_.step = world_->step();
    status_.frame = world_->frame();
    status_.simulation_time = world_->time();
    status_.paused = paused_;
    status_.particles = static_cast<std::uint32_t>(world_->fluid().particles.count);
    status_.boundary_particles = static_cast<std::uint32_t>(world_->fluid().walls.count);
    status_.kinetic_energy = last_report_.kinetic_energy;
    status_.largest_speed = last_report_.largest_speed;
    status_.frames_published = sent.published;
    status_.frames_dropped = sent.dropped;
    fill_pose_counts(status_);
    status_.wind = world_->wind();
    status_.current = world_->current();
    status_.moves_water = world_->current_moves_water();
    status_.scheduled = static_cast<std::uint32_t>(commands_.scheduled_count());
    air_ = world_->air();
    status_.bodies = world_->bodies().states();
    status_.holds = world_->bodies().holds();
    if (world_->spill()) status_.oil = world_->spill()->budget();
    status_.effort = world_->effort();
    status_.recoveries = recoveries_;
    status_.governed = governor_.has_value();
    status_.over_budget = governor_ && governor_->over_budget();
    if (command_log_) status_.command_log = command_log_->state();
    if (paused_) status_.real_time_factor = 0.0;
    status = status_;
  }
  watch_refusals();
  if (now < next_log_ns_) return;
  next_log_ns_ = now + kLogIntervalNs;
  log_status(status);
}

void Server::log_status(const ServerStatus& status) {
  std::string line = fmt::format(
      "t {:.1f} s: real-time factor {:.2f} (could reach {:.1f}), step {:.1f} ms, density error {:.3f} %, {} steps not "
      "converged, {} of {} particles sent, {} frames, {} dropped, {} readers{}",
      status.simulation_time, status.real_time_factor, status.achievable_real_time_factor, status.step_ms,
      status.density_error * 100.0, status.unconverged_steps, status.published_particles, status.particles,
      status.frames_published, status.frames_dropped, publisher_->viewers(), paused_ ? ", paused" : "");
  if (status.governed)
    line += fmt::format(", governed: steps up to {:.2f} ms, tolerances {:.2g} and {:.2g}", status.effort.max_step * 1e3,
                        status.effort.density_tolerance, status.effort.divergence_tolerance);
  // Below real time through lack of speed, not because of a pause or a start.
  const bool too_slow = options_.paced && !paused_ && status.achievable_real_time_factor > 0.0 &&
                        status.achievable_real_time_factor < 1.0;
  if (too_slow) {
    log_warning(line + "; this machine cannot keep up: give it more threads, fewer other tasks or a larger spacing");
  } else {
    log_info(line);
  }
  const std::string missed = convergence_.take();
  if (!missed.empty()) log_warning(missed);
}

void Server::watch_poses(const std::vector<BodyState>& states) {
  pose_health_.resize(states.size(), PoseHealth::kNone);
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i].health == pose_health_[i]) continue;
    pose_health_[i] = states[i].health;
    const std::string text = "body " + std::to_string(states[i].body) + ": " + describe_health(states[i].health);
    announce(states[i].health == PoseHealth::kFresh ? "pose_fresh" : "pose_stale", "server", text);
  }
}

void Server::watch_places(const std::vector<BodyState>& states) {
  const Box& tank = world_->scene().tank;
  outside_.resize(states.size(), false);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Eigen::Vector3d& x = states[i].position;
    const bool outside = (x.array() < tank.min.array()).any() || (x.array() > tank.max.array()).any();
    if (outside == outside_[i]) continue;
    outside_[i] = outside;
    const std::string where =
        fmt::format("body {} at ({:.1f}, {:.1f}, {:.1f}) m ", states[i].body, x.x(), x.y(), x.z());
    if (outside) log_warning(where + "has left the tank: it meets no water there");
    announce(outside ? "body_outside" : "body_inside", "server",
             where + (outside ? "has left the tank" : "is inside the tank again"));
  }
}

void Server::watch_oil(const OilBudget& oil) {
  const std::vector<CommandNews> all = spill_watch_.observe(oil, world_->time());
  if (!all.empty()) tell_names();  // a source may have run out
  for (const CommandNews& news : all) {
    if (news.kind == "release_waits" || news.kind == "skimmer_dry") log_warning(news.text);
    announce(news.kind, "server", news.text);
  }
}

void Server::announce(const std::string& kind, const std::string& source, const std::string& text) {
  Event event;
  event.sequence = ++events_;
  event.step = world_->step();
  event.simulation_time = world_->time();
  event.kind = kind;
  event.source = source;
  event.text = text;
  log_event(event);
  control_->broadcast(event);
  publisher_->publish_event(event);
}

ServerStatus Server::current_status() const {
  const std::scoped_lock lock(status_mutex_);
  return status_;
}

AirReading Server::read_air(const std::vector<Eigen::Vector3d>& position) const {
  AirReading reading;
  std::optional<Air> air;
  {
    const std::scoped_lock lock(status_mutex_);
    reading.simulation_time = status_.simulation_time;
    air = air_;
  }
  reading.velocity.assign(position.size(), Eigen::Vector3d::Zero());
  if (!air) return reading;
  for (std::size_t i = 0; i < position.size(); ++i)
    reading.velocity[i] = air->velocity_at(position[i], reading.simulation_time);
  return reading;
}

}  // namespace pelagos
