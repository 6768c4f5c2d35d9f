#include "read_command.hpp"

#include "messages/read_wind.hpp"

namespace pelagos {
namespace {

SetWind read_set_wind(const FieldReader& reader, const std::optional<WindSettings>& present) {
  SetWind command;
  std::optional<WindSettings> basis = present;
  bool clear_pulse = false;
  reader.read("clear_pulse", clear_pulse);
  if (clear_pulse && basis) basis->pulse.reset();
  const FieldReader wind = reader.child("wind");
  if (clear_pulse && wind.has("pulse")) reader.fault("clear_pulse", "is true beside wind.pulse; allowed: one of them");
  command.wind = read_wind(wind, basis);
  reader.read("ramp", {0.0, 3600.0, "s"}, command.ramp_seconds);
  return command;
}

StepSimulation read_step(const FieldReader& reader) {
  StepSimulation command;
  reader.read("steps", {1.0, 10000.0}, command.steps);
  return command;
}

}  // namespace

std::optional<Command> read_command(const proto::v1::Request& request, const std::optional<WindSettings>& present_wind,
                                    FieldFaults& faults) {
  const FieldReader reader(request, faults);
  std::optional<Command> command;
  switch (request.body_case()) {
    case proto::v1::Request::kSetWind:
      command = read_set_wind(reader.child("set_wind"), present_wind);
      break;
    case proto::v1::Request::kClearWind:
      command = ClearWind{};
      break;
    case proto::v1::Request::kPause:
      command = PauseSimulation{};
      break;
    case proto::v1::Request::kResume:
      command = ResumeSimulation{};
      break;
    case proto::v1::Request::kStep:
      command = read_step(reader.child("step"));
      break;
    default:
      break;
  }
  if (!faults.empty()) return std::nullopt;
  return command;
}

}  // namespace pelagos
