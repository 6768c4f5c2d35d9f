// What a station does with commands: at once, with a time, and taken back.

#include "messages/commands.hpp"
#include "messages_out.hpp"
#include "station.hpp"

namespace pelagos {

using proto::v1::Error;
using proto::v1::Request;
using proto::v1::ServerMessage;

void Station::answer_command(const Request& request) {
  FieldFaults faults;
  const FieldReader reader(request, faults);
  const CommandBasis basis{context_.hooks.wind_before(std::nullopt)};
  const std::optional<Command> command = read_command(reader, "body", CommandPlace::kNow, basis);
  if (!faults.empty() || !command) return refuse_values(request.id(), faults);
  submit(request.id(), *command);
}

void Station::answer_timed_command(const Request& request) {
  FieldFaults faults;
  const FieldReader entry = FieldReader(request, faults).child("command");
  for (const char* field : {"before_step", "source"})
    if (entry.has(field)) entry.fault(field, "is the server's to tell; allowed in command logs only");
  double time = 0.0;
  const bool timed = entry.has("at");
  entry.read("at", kCommandTimes, time);
  const auto at = timed ? std::optional<double>(time) : std::nullopt;
  const CommandBasis basis{context_.hooks.wind_before(at)};
  const auto place = timed ? CommandPlace::kTimed : CommandPlace::kNow;
  const std::optional<Command> command = read_command(entry, "command", place, basis);
  if (!command && faults.empty()) entry.fault("", "holds no command that this server knows");
  if (command && faults.empty())
    if (const auto misfit = context_.hooks.find_misfit(*command, at))
      entry.child(entry.which("command").c_str()).fault(misfit->field.c_str(), misfit->what);
  if (!faults.empty()) return refuse_values(request.id(), faults);
  if (timed) return schedule(request.id(), *command, time);
  submit(request.id(), *command);
}

void Station::answer_schedule(const Request& request) {
  ServerMessage reply;
  reply.mutable_response()->set_id(request.id());
  proto::v1::Schedule& schedule = *reply.mutable_response()->mutable_schedule();
  for (const ScheduledCommand& waiting : context_.hooks.scheduled()) fill(waiting, *schedule.add_command());
  send(reply);
}

void Station::answer_cancel(const Request& request) {
  FieldFaults faults;
  const FieldReader reader = FieldReader(request, faults).child("cancel_scheduled");
  std::uint64_t id = 0;
  reader.require("id");
  if (reader.read("id", id) && !context_.hooks.cancel(id, name_))
    reader.fault("id", std::to_string(id) + " is not waiting; get_schedule lists what is");
  if (!faults.empty()) return refuse_values(request.id(), faults);
  accept(request.id());
}

void Station::submit(std::uint64_t id, const Command& command) {
  if (const auto refusal = context_.hooks.submit(command, name_))
    return send(error_message(id, Error::REFUSED, *refusal));
  accept(id);
}

void Station::schedule(std::uint64_t id, const Command& command, double at) {
  const ScheduleAnswer answer = context_.hooks.schedule(command, at, name_);
  switch (answer.outcome) {
    case ScheduleAnswer::Outcome::kTaken:
      return accept(id, answer.id);
    case ScheduleAnswer::Outcome::kRefused:
      return send(error_message(id, Error::REFUSED, answer.reason));
    case ScheduleAnswer::Outcome::kPast:
      return refuse_values(id, {{0, 0, "command.at",
                                 format_number(at) + " s has passed; the present simulated time is " +
                                     format_number(answer.present_time) + " s; allowed: that or later"}});
  }
}

void Station::refuse_values(std::uint64_t id, const FieldFaults& faults) {
  ++context_.counters.invalid;
  valid_ = false;
  std::string text;
  for (const FieldFault& fault : faults) text += (text.empty() ? "" : "; and ") + fault.field + ": " + fault.what;
  send(error_message(id, Error::INVALID_VALUE, text, faults.empty() ? "" : faults.front().field));
}

void Station::accept(std::uint64_t id, std::uint64_t scheduled_id) {
  ServerMessage reply;
  reply.mutable_response()->set_id(id);
  auto& accepted = *reply.mutable_response()->mutable_accepted();
  if (scheduled_id > 0) accepted.set_scheduled_id(scheduled_id);
  send(reply);
}

}  // namespace pelagos
