#include "recorder.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "fields/field_hash.hpp"
#include "monotonic_clock.hpp"
#include "server_log.hpp"

namespace pelagos {

namespace {

constexpr std::int64_t kFlushIntervalNs = 1'000'000'000;

}  // namespace

Recorder::Recorder(const std::string& file) {
  if (file.empty()) return;
  log_.emplace(file);
  require_writable();
  if (const CommandLogState log = log_->state(); log.file != file)
    log_warning("command log: " + file + " is the record of another run and stays as it is; this run's is " + log.file);
}

void Recorder::begin(const CommandLogHeader& header) {
  if (!log_) return;
  log_->write(header);
  require_writable();
}

void Recorder::require_writable() const {
  const CommandLogState log = log_->state();
  if (!log.fault.empty())
    throw std::invalid_argument("cannot write the command log " + log.file + ": " + log.fault +
                                "; check the folder and the space left");
}

void Recorder::record(const World& world, const StepInputs& inputs, const std::vector<bool>& done,
                      Announcer& announcer) {
  if (!log_ || inputs.empty()) return;
  changed_ = world.step();
  for (const GivenPose& given : inputs.poses) log_->write({world.step(), given});
  for (std::size_t k = 0; k < inputs.commands.size(); ++k)
    if (done[k]) log_->write({world.step(), world.time(), inputs.commands[k].source, inputs.commands[k].command});
  watch(announcer);
}

void Recorder::check(const World& world) {
  if (!log_ || world.time() < next_check_) return;
  next_check_ = std::floor(world.time()) + 1.0;
  checked_ = world.step();
  log_->write(CommandLogCheck{world.step(), world.time(), hash_fields(world.state())});
}

void Recorder::end(const World& world) {
  if (!log_) return;
  // Inputs of a run that ended while it was paused have changed the state without a step: a replay does not get there.
  if (checked_ != world.step() && changed_ != world.step())
    log_->write(CommandLogCheck{world.step(), world.time(), hash_fields(world.state())});
  log_->write(CommandLogEnd{world.step(), state_hash(world.fluid().particles)});
  const CommandLogState log = log_->state();
  if (!log.fault.empty())
    log_error(fmt::format("the command log {} could not be written to its end: {}; lines that are missing: {}",
                          log.file, log.fault, log.waiting + log.lost));
}

void Recorder::flush(Announcer& announcer) {
  if (fault_told_ && monotonic_ns() >= next_flush_ns_) watch(announcer);
}

/// A full disk does not stop the sea: it is told at once, what could not be written waits, and is tried each second.
void Recorder::watch(Announcer& announcer) {
  if (fault_told_) log_->flush();
  next_flush_ns_ = monotonic_ns() + kFlushIntervalNs;
  const CommandLogState log = log_->state();
  if (log.fault.empty() != fault_told_) return;  // nothing new
  fault_told_ = !log.fault.empty();
  const std::string name = "the command log " + log.file;
  const std::string text = fault_told_ ? name + " cannot be written: " + log.fault +
                                             "; the sea goes on, and what is missing is written when there is room"
                                       : name + " is written again; nothing is missing from it";
  fault_told_ ? log_error(text) : log_info(text);
  announcer.announce("command_log", "server", text);
}

std::optional<CommandLogState> Recorder::state() const { return log_ ? std::optional(log_->state()) : std::nullopt; }

}  // namespace pelagos
