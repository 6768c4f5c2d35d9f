#include "server.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "control/endpoint.hpp"
#include "fields/field_hash.hpp"
#include "files/output_file.hpp"
#include "machine.hpp"
#include "monotonic_clock.hpp"
#include "pelagos_dds/log_sink.hpp"
#include "run_parts.hpp"
#include "server_log.hpp"
#include "simulation/state_file.hpp"
#include "version/version.hpp"
#include "world_status.hpp"

namespace pelagos {

namespace {

std::optional<Replay> replay_of(const ServerOptions& options) {
  return options.replay ? std::optional<Replay>(*options.replay) : std::nullopt;
}

}  // namespace

Server::Server(const ServerOptions& options, const std::atomic<bool>& stop)
    : options_(options), stop_(stop), gate_(options.scene, replay_of(options)) {
  SceneSea sea = make_scene_sea(options_.scene);
  status_ = starting_status(options_.scene, sea);
  status_.governed = options_.scene.governor.on && !gate_.replay();
  recorder_.emplace(options_.command_log);
  status_.command_log = recorder_->state();
  air_ = starting_air(options_.scene);
  open_links();
  open_world(std::move(sea));
  open_records();
}

Server::~Server() {
  gate_.close();  // whoever waits for an answer gets one while the link stands
  desk_.close();
  control_.reset();  // first: its hooks use everything else
  install_dds_log({});
}

ControlHooks Server::control_hooks() {
  ControlHooks hooks;
  hooks.submit = [this](const Command& c, const std::string& source, TakeAnswer answer) {
    return gate_.submit(c, source, std::move(answer));
  };
  hooks.schedule = [this](const Command& c, double at, const std::string& source) {
    return gate_.schedule(c, at, source);
  };
  hooks.cancel = [this](std::uint64_t id, const std::string& source) { return gate_.cancel(id, source); };
  hooks.scheduled = [this] { return gate_.scheduled(); };
  hooks.find_refusal = [around = command_surroundings(options_.scene)](const Command& c) {
    return find_refusal(c, around);
  };
  hooks.status = [this] { return status(); };
  hooks.read_air = [this](const std::vector<Eigen::Vector3d>& position) { return board_.read_air(position); };
  hooks.ask_surface = [this](const SurfaceQuery& query, const std::string& client, TakeSurface take) {
    return desk_.ask(query, client, std::move(take));
  };
  hooks.log = [](LogLevel level, std::string_view text) {
    level == LogLevel::kInfo ? log_info(text) : level == LogLevel::kWarning ? log_warning(text) : log_error(text);
  };
  return hooks;
}

ServerStatus Server::status() const {
  ServerStatus status = *board_.status();
  status.scheduled = static_cast<std::uint32_t>(gate_.scheduled_count());
  status.surface_queries = desk_.counts();
  return status;
}

void Server::open_links() {
  board_.put_up(status_, air_);
  control_ = std::make_unique<ControlServer>(options_.control, control_hooks());
  log_info("control: listening on " + to_string(Endpoint{options_.control.host, control_->port()}));

  install_dds_log([](std::string_view line) { log_warning(line); });
  DdsSettings dds;
  dds.domain = options_.domain;
  dds.config_file = options_.dds_config;
  dds.log = [](std::string_view line) { log_warning(line); };
  participant_ = join_dds(dds);
  status_.open_links = find_open_links(*participant_, dds);
  board_.put_up(status_, air_);
  PublisherSettings settings;
  settings.bodies_in_ned = options_.bodies_in_ned;
  publisher_ = std::make_unique<FramePublisher>(participant_, std::nullopt, settings, dds.log);
  publisher_->submit_status(status_);  // viewers see that a server starts
  clock_link_ = std::make_unique<ClockLink>(participant_, publisher_->source(), monotonic_ns, dds.log);
  announcer_ = std::make_unique<Announcer>(*control_, *publisher_);
}

void Server::open_world(SceneSea sea) {
  WorldOptions world;
  world.sea = std::move(sea);
  world.threads = options_.threads;
  world.clock = monotonic_ns;
  world.placed = [this](const World& placed) { tell_placed(placed); };
  world.progress = [this](double part) {
    status_.settled = part;
    board_.put_up(status_, air_);
    return !stop_.load();
  };
  log_info(fmt::format("scene {}: placing and settling the water", options_.scene.name));
  world_ = std::make_unique<World>(options_.scene, world);
  if (!options_.start_state.empty()) go_on_from_state();
  for (const std::string& note : world_->bodies().mesh_notes()) log_info(note);
  for (const std::string& note : world_->start_notes()) log_warning("start: " + note);
  log_info(
      fmt::format("scene {}: {} particles of {:g} m, {} distance fields of bodies, {} boundary samples ({} on bodies), "
                  "threads: {}; "
                  "DDS domain {}",
                  options_.scene.name, world_->fluid().particles.count, options_.scene.particle_spacing,
                  world_->fluid().solids.size(), world_->fluid().static_walls + world_->bodies().moving_sample_count(),
                  world_->bodies().sample_count(), options_.threads, options_.domain));
  publisher_->publish_scene_info(world_->describe());
  gate_.open(participant_, [](std::string_view line) { log_warning(line); });
  surface_link_ = std::make_unique<SurfaceLink>(
      participant_, publisher_->source(),
      [this](const SurfaceQuery& query, const std::string& client, TakeSurface take) {
        return desk_.ask(query, client, std::move(take));
      },
      [](std::string_view line) { log_warning(line); });
}

/// The world's events up to the moment of the state have had their effect, which the state holds.
void Server::go_on_from_state() {
  if (const auto refusal = load_state(std::as_bytes(std::span(options_.start_state)), *world_))
    throw std::invalid_argument("--load-state: " + to_string(*refusal));
  gate_.drop_events_until(world_->time());
  log_info(
      fmt::format("the run goes on from a saved state, after step {}, at {:.3f} s", world_->step(), world_->time()));
}

/// @return whether it could be written, or was not asked for
bool Server::save_end_state() const {
  if (options_.save_state.empty()) return true;
  const std::vector<std::byte> bytes = save_state(*world_);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::string fault = write_whole_file(options_.save_state, text);
  if (!fault.empty()) {
    log_error("the state could not be saved to " + options_.save_state + ": " + fault);
    return false;
  }
  log_info(fmt::format("state saved to {}: {:.1f} MB, after step {}, at {:.3f} s", options_.save_state,
                       static_cast<double>(bytes.size()) * 1e-6, world_->step(), world_->time()));
  return true;
}

/// While the water settles the status already holds what the world starts with.
void Server::tell_placed(const World& world) {
  fill_from(world, status_);
  if (world.spill()) status_.oil = world.spill()->budget();
  status_.start_notes = world.start_notes();
  air_ = world.air();
  board_.put_up(status_, air_);
}

void Server::open_records() {
  const Scene& scene = options_.scene;
  const CommandLogHeader header{kVersion,   describe_machine().instruction_set, scene.name,
                                scene.seed, world_->fluid().particles.count,    run_parts(*world_)};
  if (const auto& replay = gate_.replay()) {
    if (const std::string fault = replay->mismatch(header); !fault.empty()) throw std::invalid_argument(fault);
    if (const std::string doubt = replay->doubt(header); !doubt.empty()) log_warning(doubt);
    const CommandLog& log = replay->log();
    log_info(
        fmt::format("replay: commands: {}, poses: {}; the scene's events, its governor, stations' commands and "
                    "bridges' poses do not act",
                    log.commands.size(), log.poses.size()));
    if (!log.cut_off.empty()) log_warning("replay: " + log.cut_off);
    if (!log.end)
      log_warning("replay: the log has no end, as of a run that was killed; this one ends where the log does");
  }
  recorder_->begin(header);
}

ServerSummary Server::run() {
  SimulationLoop loop({*world_, gate_, desk_, *recorder_, board_, *announcer_, *publisher_},
                      {options_.duration, options_.paced, !options_.save_state.empty()}, status_);
  ServerSummary summary;
  summary.end = loop.run(stop_);
  gate_.close();
  desk_.close();
  if (summary.end == ServerEnd::kReplayEnded) summary.replay_differs = !tell_replay_end();
  if (const std::size_t waiting = gate_.scheduled_count(); waiting > 0)
    log_info(fmt::format("commands that were not due before the end: {}", waiting));
  recorder_->end(*world_);
  summary.state_failed = summary.end == ServerEnd::kNumericalFault ? !options_.save_state.empty() : !save_end_state();
  summary.status = *board_.status();
  summary.run = loop.whole_run();
  summary.lowest_real_time_factor = loop.lowest_real_time_factor();
  summary.surface_ms_mean = loop.mean_surface_ms();
  summary.publisher = publisher_->counters();
  summary.poses = gate_.pose_counters();
  summary.control = control_->statistics();
  summary.effort_changes = loop.effort_changes();
  summary.frame_budget = loop.frame_budget();
  summary.hull_samples = world_->bodies().sample_count();
  summary.threads = options_.threads;
  summary.state_hash = state_hash(world_->fluid().particles);
  summary.world_hash = hash_fields(world_->state());
  summary.log_failed = recorder_->failed();
  return summary;
}

bool Server::tell_replay_end() const {
  const Replay& replay = *gate_.replay();
  std::string what = fmt::format("replay: the log ends here, after step {}; {}", world_->step(), replay.checks_text());
  bool same = !replay.differs();
  if (const auto& end = replay.log().end) {
    const std::uint64_t now = state_hash(world_->fluid().particles);
    same = same && now == end->state_hash;
    what += fmt::format("; the water at the end {:016x}, that of the logged run {:016x}: {}", now, end->state_hash,
                        now == end->state_hash ? "the same bits" : "not the same bits");
  }
  same ? log_info(what) : log_warning(what);
  return same;
}

}  // namespace pelagos
