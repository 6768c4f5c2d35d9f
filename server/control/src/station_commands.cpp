// What a station does with commands: at once, with a time, and taken back.

#include <boost/asio/post.hpp>

#include "messages/commands.hpp"
#include "messages_out.hpp"
#include "station.hpp"

namespace pelagos {

using proto::v1::Error;
using proto::v1::Request;
using proto::v1::ServerMessage;

void Station::answer_command(const Request& request) {
  TextRefusals faults;
  const FieldReader entry = FieldReader(request, faults).child("command");
  for (const char* field : {"before_step", "source"})
    if (entry.has(field)) entry.fault(field, "is the server's to tell; allowed in command logs only");
  double time = 0.0;
  const bool timed = entry.has("at");
  entry.read("at", kCommandTimes, time);
  const auto place = timed ? CommandPlace::kTimed : CommandPlace::kNow;
  const std::optional<Command> command = read_command(entry, "command", place);
  if (!command && faults.empty()) entry.fault("", "holds no command that this server knows");
  if (command && timed && faults.empty())
    if (const auto refusal = context_.hooks.find_refusal(*command))
      entry.child(entry.which("command").c_str()).fault(*refusal);
  if (!faults.empty()) return refuse_values(request.id(), faults);
  if (timed) return schedule(request.id(), *command, time);
  submit(request.id(), "command." + entry.which("command"), *command);
}

void Station::answer_schedule(const Request& request) {
  ServerMessage reply;
  reply.mutable_response()->set_id(request.id());
  proto::v1::Schedule& schedule = *reply.mutable_response()->mutable_schedule();
  for (const ScheduledCommand& waiting : context_.hooks.scheduled()) fill(waiting, *schedule.add_command());
  send(reply);
}

void Station::answer_cancel(const Request& request) {
  TextRefusals faults;
  const FieldReader reader = FieldReader(request, faults).child("cancel_scheduled");
  std::uint64_t id = 0;
  reader.require("id");
  if (reader.read("id", id) && !context_.hooks.cancel(id, name_))
    reader.fault("id", std::to_string(id) + " is not waiting; get_schedule lists what is");
  if (!faults.empty()) return refuse_values(request.id(), faults);
  accept(request.id());
}

namespace {

ServerMessage reply_to(std::uint64_t id, const std::string& path, const CommandAnswer& answer) {
  ServerMessage reply;
  if (!answer.refusal) {
    reply.mutable_response()->set_id(id);
    auto& accepted = *reply.mutable_response()->mutable_accepted();
    answer.scheduled_id > 0 ? accepted.set_scheduled_id(answer.scheduled_id) : accepted.set_step(answer.step);
    return reply;
  }
  if (answer.refusal->field.empty()) return error_message(id, Error::REFUSED, answer.refusal->what);
  const std::string field = path + "." + answer.refusal->field;
  return error_message(id, Error::INVALID_VALUE, field + ": " + answer.refusal->what, field);
}

}  // namespace

std::function<void(ServerMessage, bool)> Station::reply_later(const Reply& reply) {
  return [weak = weak_from_this(), executor = socket_.get_executor(), reply](ServerMessage message, bool refused) {
    boost::asio::post(executor, [weak, reply, refused, message = std::move(message)] {
      const auto self = weak.lock();
      if (!self) return;
      if (refused) ++self->context_.counters.invalid;
      self->settle(reply, message);
    });
  };
}

void Station::submit(std::uint64_t id, const std::string& path, const Command& command) {
  const Reply reply = expect_reply();
  std::optional<Refusal> refusal;
  try {
    refusal = context_.hooks.submit(command, name_, [give = reply_later(reply), id, path](const CommandAnswer& news) {
      give(reply_to(id, path, news), news.refusal.has_value());
    });
  } catch (...) {
    replies_.pop_back();
    throw;
  }
  if (refusal) settle(reply, error_message(id, Error::REFUSED, to_string(*refusal)));
}

void Station::schedule(std::uint64_t id, const Command& command, double at) {
  const ScheduleAnswer answer = context_.hooks.schedule(command, at, name_);
  switch (answer.outcome) {
    case ScheduleAnswer::Outcome::kTaken:
      return accept(id, answer.id);
    case ScheduleAnswer::Outcome::kRefused:
      return send(error_message(id, Error::REFUSED, to_string(answer.refusal)));
    case ScheduleAnswer::Outcome::kPast:
      return refuse_values(id,
                           {{0,
                             0,
                             {"command.at", format_number(at) + " s has passed; the present simulated time is " +
                                                format_number(answer.present_time) + " s; allowed: that or later"}}});
  }
}

void Station::refuse_values(std::uint64_t id, const TextRefusals& faults) {
  ++context_.counters.invalid;
  valid_ = false;
  std::string text;
  for (const TextRefusal& fault : faults) text += (text.empty() ? "" : "; and ") + to_string(fault.refusal);
  send(error_message(id, Error::INVALID_VALUE, text, faults.empty() ? "" : faults.front().refusal.field));
}

void Station::accept(std::uint64_t id, std::uint64_t scheduled_id) {
  ServerMessage reply;
  reply.mutable_response()->set_id(id);
  auto& accepted = *reply.mutable_response()->mutable_accepted();
  if (scheduled_id > 0) accepted.set_scheduled_id(scheduled_id);
  send(reply);
}

}  // namespace pelagos
