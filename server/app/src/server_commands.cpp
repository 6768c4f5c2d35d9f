// How commands reach the world: from stations, the scene's events, the governor or a replay; announced and logged.

#include <fmt/format.h>

#include <stdexcept>

#include "describe_command.hpp"
#include "machine.hpp"
#include "monotonic_clock.hpp"
#include "server.hpp"
#include "server_log.hpp"
#include "version/version.hpp"

namespace pelagos {

namespace {

constexpr std::int64_t kFlushIntervalNs = 1'000'000'000;

}  // namespace

void Server::open_command_log() {
  const Scene& scene = options_.scene;
  const CommandLogHeader header{kVersion, describe_machine().instruction_set, scene.name, scene.seed,
                                world_->fluid().particles.count};
  if (options_.replay) {
    replay_.emplace(*options_.replay);
    if (const std::string fault = replay_->mismatch(header); !fault.empty()) throw std::invalid_argument(fault);
    if (const std::string doubt = replay_->doubt(header); !doubt.empty()) log_warning(doubt);
    log_info(fmt::format("replay: {} commands; the scene's events, its governor and stations' commands do not act",
                         replay_->log().commands.size()));
    if (!replay_->log().end) log_warning("replay: the logged run was cut off; this one goes on until it is stopped");
  }
  if (options_.command_log.empty()) return;
  command_log_.emplace(options_.command_log, header);
  const CommandLogState log = command_log_->state();
  if (!log.fault.empty())
    throw std::invalid_argument("cannot write the command log " + log.file + ": " + log.fault +
                                "; check the folder and the space left");
  if (log.file != options_.command_log)
    log_warning("command log: " + options_.command_log +
                " is the record of another run and stays as it is; this run's is " + log.file);
}

/// A full disk does not stop the sea: it is told at once, what could not be written waits, and is tried each second.
void Server::watch_command_log() {
  if (!command_log_) return;
  if (log_fault_told_) command_log_->flush();
  next_flush_ns_ = monotonic_ns() + kFlushIntervalNs;
  const CommandLogState log = command_log_->state();
  if (log.fault.empty() != log_fault_told_) return;  // nothing new
  log_fault_told_ = !log.fault.empty();
  const std::string name = "the command log " + log.file;
  const std::string text = log_fault_told_ ? name + " cannot be written: " + log.fault +
                                                 "; the sea goes on, and what is missing is written when there is room"
                                           : name + " is written again; nothing is missing from it";
  log_fault_told_ ? log_error(text) : log_info(text);
  announce("command_log", "server", text);
}

void Server::close_command_log() {
  const CommandLogEnd end{world_->step(), state_hash(world_->fluid().particles)};
  if (replay_ended()) {
    const bool same = end.state_hash == replay_->log().end->state_hash;
    const std::string what = fmt::format("replay: {} steps, state {:016x}, that of the logged run {:016x}: ", end.step,
                                         end.state_hash, replay_->log().end->state_hash);
    same ? log_info(what + "the same bits") : log_warning(what + "not the same bits");
  }
  if (const std::size_t waiting = commands_.scheduled_count(); waiting > 0)
    log_info(fmt::format("{} commands were not due before the end", waiting));
  if (!command_log_) return;
  command_log_->write(end);
  if (poses_->counters().accepted > 0)
    log_warning("command log: poses moved bodies, and poses are not in it: a replay will not have the same bits");
  const CommandLogState log = command_log_->state();
  if (!log.fault.empty())
    log_error(fmt::format("the command log {} could not be written to its end: {}; {} lines are missing", log.file,
                          log.fault, log.waiting + log.lost));
}

std::optional<std::string> Server::refuse_in_replay(const Command& command) const {
  if (!options_.replay || !changes_water(command)) return std::nullopt;
  return "a replay takes its commands from the log; allowed: pause, resume, step";
}

ScheduleAnswer Server::schedule(const Command& command, double at, const std::string& source) {
  using Outcome = ScheduleAnswer::Outcome;
  if (options_.replay) return {Outcome::kRefused, 0, 0.0, "a replay takes its commands from the log"};
  const CommandQueue::Scheduled answer = commands_.schedule(command, at, source);
  if (answer.past) return {Outcome::kPast, 0, answer.present_time, {}};
  if (answer.id == 0) return {Outcome::kRefused, 0, answer.present_time, answer.refusal};
  return {Outcome::kTaken, answer.id, answer.present_time, {}};
}

void Server::announce_schedule() {
  commands_.take_changes(schedule_changes_);
  for (const ScheduleChange& change : schedule_changes_) {
    const ScheduledCommand& c = change.command;
    announce("schedule", change.by,
             fmt::format("{} command {} for {:g} s: {}", change.cancelled ? "cancelled" : "scheduled", c.id, c.at,
                         describe_command(c.command).text));
  }
}

/// Bridges ask for probes over DDS; from here on it is a command like any other.
void Server::take_probe_requests() {
  probe_requests_->take(taken_requests_);
  for (const ProbeRequest& request : taken_requests_) {
    const std::string source = "bridge " + std::to_string(request.sender);
    std::optional<std::string> refusal = refuse_in_replay(request.command);
    if (!refusal && !request.fault.empty()) refusal = request.fault;
    if (!refusal) refusal = commands_.submit(request.command, source);
    if (refusal) announce("refused", source, describe_command(request.command).text + ": " + *refusal);
  }
  watch_dropped_requests();
}

void Server::apply_commands() {
  announce_schedule();
  commands_.take(world_->time(), taken_commands_);
  if (replay_) replay_->take(world_->step(), taken_commands_);
  for (const QueuedCommand& queued : taken_commands_) apply(queued);
  if (!taken_commands_.empty()) tell_names();
}

/// So that commands can be held against what is there.
void Server::tell_names() {
  GivenNames given;
  for (const std::uint32_t id : world_->probe_ids()) given.probes.insert(id);
  if (world_->spill()) {
    for (const std::string& name : world_->spill()->sources()) given.sources.insert(name);
    for (const auto& [name, skimmer] : world_->spill()->film().skimmers) given.skimmers.insert(name);
    for (const auto& [name, boom] : world_->spill()->film().booms) {
      given.booms.insert(name);
      given.boom_points[name] = boom.boom.line.size();
    }
  }
  commands_.set_names(given);
}

void Server::apply(const QueuedCommand& queued) {
  if (!changes_water(queued.command) && !apply_to_clock(queued.command)) return;
  if (const auto refusal = world_->apply(queued.command)) {
    announce("refused", queued.source, describe_command(queued.command).text + ": " + *refusal);
    return;
  }
  if (std::holds_alternative<SetEffort>(queued.command)) ++effort_changes_;
  const CommandNews news = describe_command(queued.command);
  announce(news.kind, queued.source, news.text);
  if (std::holds_alternative<SetCurrent>(queued.command)) notice_closed_axes();
  if (!command_log_) return;
  command_log_->write({world_->step(), world_->time(), queued.source, queued.command});
  watch_command_log();
}

/// @return whether it changed anything
bool Server::apply_to_clock(const Command& command) {
  if (std::holds_alternative<PauseSimulation>(command)) {
    if (paused_) return false;
    paused_ = true;
  } else if (std::holds_alternative<ResumeSimulation>(command)) {
    if (!paused_) return false;
    paused_ = false;
    steps_to_make_ = 0;
  } else if (const auto* step = std::get_if<StepSimulation>(&command)) {
    steps_to_make_ += step->steps;
  }
  return true;
}

/// Once: along which axes a current cannot move the water.
void Server::notice_closed_axes() {
  const Eigen::Vector3d& velocity = world_->current_field()->target().velocity;
  std::string axes;
  for (int axis = 0; axis < 2; ++axis)
    if (velocity[axis] != 0.0 && !world_->current_moves_water()[static_cast<std::size_t>(axis)])
      axes += (axes.empty() ? "" : " and ") + std::string(1, static_cast<char>('x' + axis));
  if (axes.empty() || closed_axes_noticed_) return;
  closed_axes_noticed_ = true;
  log_info("notice: the tank is closed along " + axes +
           ": there the current carries only what drifts, the water stays (tank_edges PERIODIC lets it flow)");
}

}  // namespace pelagos
