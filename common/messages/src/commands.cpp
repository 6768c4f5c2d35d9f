#include "messages/commands.hpp"

#include <array>
#include <string_view>

#include "commands.pb.h"
#include "messages/enums_out.hpp"
#include "messages/limits.hpp"
#include "messages/read_current.hpp"
#include "messages/read_sea.hpp"
#include "messages/read_waves.hpp"
#include "messages/read_wind.hpp"
#include "messages/sea_out.hpp"
#include "oil_commands.hpp"
#include "probe_commands.hpp"

namespace pelagos {
namespace {

void write_vector(const Eigen::Vector3d& from, proto::v1::Vector& to) {
  to.set_x(from.x());
  to.set_y(from.y());
  to.set_z(from.z());
}

// ---- each command: out of its message, and back

Command read_set_wind(const FieldReader& reader) {
  SetWind command;
  const FieldReader wind = reader.child("wind");
  command.wind = read_wind_change(wind);
  reader.read("clear_pulse", command.wind.clear_pulse);
  if (command.wind.clear_pulse && wind.has("pulse"))
    reader.fault("clear_pulse", "is true beside wind.pulse; allowed: one of them");
  reader.read("ramp", limits::kRamp, command.ramp_seconds);
  return command;
}

void write(const SetWind& command, proto::v1::TimedCommand& message) {
  const WindChange& change = command.wind;
  proto::v1::SetWind& out = *message.mutable_set_wind();
  proto::v1::Wind& wind = *out.mutable_wind();
  if (change.velocity) write_vector(*change.velocity, *wind.mutable_velocity());
  if (change.speed) wind.set_speed(*change.speed);
  if (change.from_deg) wind.set_from_deg(*change.from_deg);
  if (change.amplitude) wind.set_amplitude(*change.amplitude);
  if (change.length) wind.set_length(*change.length);
  if (change.beta) wind.set_beta(*change.beta);
  if (change.law) wind.set_law(law_of(*change.law));
  if (change.roughness) wind.set_roughness(*change.roughness);
  if (change.pulse) {
    wind.mutable_pulse()->set_period(change.pulse->period);
    wind.mutable_pulse()->set_width(change.pulse->width);
  }
  if (change.clear_pulse) out.set_clear_pulse(true);
  out.set_ramp(command.ramp_seconds);
}

Command read_clear_wind(const FieldReader&) { return ClearWind{}; }
void write(const ClearWind&, proto::v1::TimedCommand& message) { message.mutable_clear_wind(); }

Command read_set_current(const FieldReader& reader) {
  SetCurrent command;
  reader.require("current");
  if (reader.has("current")) command.current = read_current(reader.child("current"));
  reader.read("ramp", limits::kRamp, command.ramp_seconds);
  return command;
}

void write(const SetCurrent& command, proto::v1::TimedCommand& message) {
  proto::v1::SetCurrent& out = *message.mutable_set_current();
  proto::v1::Current& current = *out.mutable_current();
  write_vector(command.current.velocity, *current.mutable_velocity());
  current.set_shear(shear_of(command.current.shear));
  if (command.current.shear != CurrentShear::kNone) current.set_depth(command.current.depth);
  current.set_relaxation(command.current.relaxation);
  out.set_ramp(command.ramp_seconds);
}

Command read_clear_current(const FieldReader&) { return ClearCurrent{}; }
void write(const ClearCurrent&, proto::v1::TimedCommand& message) { message.mutable_clear_current(); }

Command read_set_waves(const FieldReader& reader) {
  SetWaves command;
  bool flat = false;
  reader.read("flat", flat);
  if (flat && reader.has("wave")) reader.fault("flat", "is true beside waves; allowed: one of them");
  if (!flat && !reader.has("wave")) reader.fault("wave", "is missing; allowed: 1 to 512 waves, or flat: true");
  command.waves = read_waves(reader);
  reader.read("blend", limits::kBlend, command.blend_seconds);
  return command;
}

void write(const SetWaves& command, proto::v1::TimedCommand& message) {
  proto::v1::SetWaves& out = *message.mutable_set_waves();
  for (const WaveSettings& from : command.waves) {
    proto::v1::Wave& wave = *out.add_wave();
    wave.set_amplitude(from.amplitude);
    if (from.length > 0.0) wave.set_length(from.length);
    if (from.period > 0.0) wave.set_period(from.period);
    wave.set_to_deg(from.to_deg);
    if (from.phase_deg != 0.0) wave.set_phase_deg(from.phase_deg);
  }
  if (command.waves.empty()) out.set_flat(true);
  out.set_blend(command.blend_seconds);
}

Command read_set_sea(const FieldReader& reader) {
  SetSea command;
  if (!reader.has("system") && !reader.has("wind_sea"))
    reader.fault("system",
                 "is missing; allowed: 1 to 8 systems, or wind_sea, and for a flat sea set_waves { flat: true }");
  command.sea = read_sea(reader);
  reader.read("blend", limits::kBlend, command.blend_seconds);
  return command;
}

void write(const SetSea& command, proto::v1::TimedCommand& message) {
  proto::v1::SetSea& out = *message.mutable_set_sea();
  for (const WaveSystem& system : command.sea.systems) write_wave_system(system, *out.add_system());
  out.set_components(command.sea.components);
  if (command.sea.seed) out.set_seed(*command.sea.seed);
  if (command.sea.shortest_length > 0.0) out.set_shortest_length(command.sea.shortest_length);
  if (command.sea.wind_sea) write_wind_sea(*command.sea.wind_sea, *out.mutable_wind_sea());
  out.set_blend(command.blend_seconds);
}

Command read_pause(const FieldReader&) { return PauseSimulation{}; }
void write(const PauseSimulation&, proto::v1::TimedCommand& message) { message.mutable_pause(); }

Command read_resume(const FieldReader&) { return ResumeSimulation{}; }
void write(const ResumeSimulation&, proto::v1::TimedCommand& message) { message.mutable_resume(); }

Command read_step(const FieldReader& reader) {
  StepSimulation command;
  reader.read("steps", {1.0, 10000.0}, command.steps);
  return command;
}

void write(const StepSimulation& command, proto::v1::TimedCommand& message) {
  message.mutable_step()->set_steps(command.steps);
}

Command read_set_effort(const FieldReader& reader) {
  SetEffort command;
  for (const char* field : {"max_step", "density_tolerance", "divergence_tolerance"}) reader.require(field);
  reader.read("max_step", {1e-6, 10.0, "s"}, command.effort.max_step);
  reader.read("density_tolerance", {1e-6, 0.05}, command.effort.density_tolerance);
  reader.read("divergence_tolerance", {1e-6, 0.05}, command.effort.divergence_tolerance);
  reader.read("reason", 1000, command.reason);
  return command;
}

void write(const SetEffort& command, proto::v1::TimedCommand& message) {
  proto::v1::SetEffort& out = *message.mutable_set_effort();
  out.set_max_step(command.effort.max_step);
  out.set_density_tolerance(command.effort.density_tolerance);
  out.set_divergence_tolerance(command.effort.divergence_tolerance);
  if (!command.reason.empty()) out.set_reason(command.reason);
}

void write(const SetProbe& command, proto::v1::TimedCommand& message) { write_probe(command, message); }
void write(const RemoveProbe& command, proto::v1::TimedCommand& message) { write_probe(command, message); }

/// Commands of a type of their own.
template <auto read>
Command read_as_command(const FieldReader& reader) {
  return read(reader);
}
void write(const OilCommand& command, proto::v1::TimedCommand& message) { write_oil(command, message); }

// ---- the commands by the field that holds them

enum class Allowed { kEverywhere, kNotTimed, kLogOnly };

struct CommandField {
  std::string_view name;
  Command (*read)(const FieldReader& reader);
  Allowed allowed = Allowed::kEverywhere;
};

/// The one list of them: what stands here can be given over the control link, in a scene and in a command log.
constexpr std::array kCommandFields{
    CommandField{"set_wind", read_set_wind},
    CommandField{"clear_wind", read_clear_wind},
    CommandField{"set_current", read_set_current},
    CommandField{"clear_current", read_clear_current},
    CommandField{"set_waves", read_set_waves},
    CommandField{"set_sea", read_set_sea},
    CommandField{"pause", read_pause},
    CommandField{"release_oil", read_as_command<read_release_oil>},
    CommandField{"stop_release", read_as_command<read_stop_release>},
    CommandField{"spill_oil", read_as_command<read_spill_oil>},
    CommandField{"set_boom", read_as_command<read_set_boom>},
    CommandField{"remove_boom", read_as_command<read_remove_boom>},
    CommandField{"set_skimmer", read_as_command<read_set_skimmer>},
    CommandField{"remove_skimmer", read_as_command<read_remove_skimmer>},
    CommandField{"set_probe", read_as_command<read_set_probe>},
    CommandField{"remove_probe", read_as_command<read_remove_probe>},
    CommandField{"resume", read_resume, Allowed::kNotTimed},
    CommandField{"step", read_step, Allowed::kNotTimed},
    CommandField{"set_effort", read_set_effort, Allowed::kLogOnly},
};

const CommandField* find_field(const std::string& name) {
  for (const CommandField& field : kCommandFields)
    if (field.name == name) return &field;
  return nullptr;
}

/// Whether it may stand there; a fault if not.
bool check_place(const FieldReader& reader, const CommandField& field, CommandPlace place) {
  const std::string name(field.name);
  if (field.allowed == Allowed::kLogOnly && place != CommandPlace::kLog) {
    reader.fault(name.c_str(), "is the server's own; allowed in command logs only");
    return false;
  }
  if (field.allowed == Allowed::kNotTimed && place == CommandPlace::kTimed) {
    reader.fault(name.c_str(), "needs a paused simulation, in which no time comes; allowed: without a time");
    return false;
  }
  return true;
}

}  // namespace

bool is_command(const std::string& field) { return find_field(field) != nullptr; }

std::optional<Command> read_command(const FieldReader& reader, const char* oneof, CommandPlace place) {
  const std::string name = reader.which(oneof);
  const CommandField* field = find_field(name);
  if (field == nullptr || !check_place(reader, *field, place)) return std::nullopt;
  return field->read(reader.child(name.c_str()));
}

void write_command(const Command& command, proto::v1::TimedCommand& message) {
  std::visit([&](const auto& c) { write(c, message); }, command);
}

}  // namespace pelagos
