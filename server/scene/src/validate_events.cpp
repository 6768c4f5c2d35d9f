// What happens when: the scene's timed commands.

#include <algorithm>
#include <numeric>

#include "messages/commands.hpp"
#include "validate_scene.hpp"
#include "values/given_names.hpp"

namespace pelagos {
namespace {

constexpr std::size_t kMostEvents = 1000;

/// Order in which events fall due: by time, then as written. Those without a sound time come first.
std::vector<std::size_t> order_by_time(const std::vector<SceneEvent>& events) {
  std::vector<std::size_t> order(events.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return events[a].at < events[b].at; });
  return order;
}

void read_time(const FieldReader& entry, SceneEvent& event) {
  entry.require("at");
  entry.read("at", kCommandTimes, event.at);
  for (const char* field : {"before_step", "source"})
    if (entry.has(field)) entry.fault(field, "is for command logs; allowed in a scene: at and a command");
}

/// What the scene and its events alone will have set.
struct Foreseen {
  std::optional<WindSettings> wind;
  GivenNames names;
};

std::optional<Refusal> follow_wind(const Command& command, std::optional<WindSettings>& wind) {
  if (std::holds_alternative<ClearWind>(command)) wind.reset();
  const auto* set = std::get_if<SetWind>(&command);
  if (set == nullptr) return {};
  WindSettings merged;
  auto refusal = merge_wind(*set, wind, merged);
  if (!refusal) wind = merged;
  return refusal;
}

/// Whether the command fits what the scene has, and what the events before it have set. Stations may change that while
/// the scene runs; this finds the mistakes of the scene's author.
void check_fit(const FieldReader& entry, const std::optional<CommandSurroundings>& commands, const Command& command,
               Foreseen& foreseen) {
  GivenNames& given = foreseen.names;
  std::optional<Refusal> refusal = follow_wind(command, foreseen.wind);
  if (!refusal && commands) refusal = find_refusal(command, *commands);
  if (!refusal) refusal = find_unknown_name(command, given);
  if (!refusal) refusal = find_no_room(command, given);
  if (refusal) entry.child(entry.which("command").c_str()).fault(*refusal);
  given.follow(command);
}

void read_event(const FieldReader& entry, const EventSurroundings& around, Foreseen& foreseen, SceneEvent& event) {
  if (entry.which("command").empty())
    return entry.fault("", "says when but not what; allowed: one command beside `at`, e.g. set_wind { ... }");
  const std::size_t faults = entry.fault_count();
  const std::optional<Command> command = read_command(entry, "command", CommandPlace::kTimed);
  if (!command) return;
  event.command = *command;
  if (entry.fault_count() == faults) check_fit(entry, around.commands, *command, foreseen);
  if (std::holds_alternative<SetWind>(event.command) && around.weightless)
    entry.fault("set_wind", "blows without gravity; allowed: gravity above 0 (the push scales with sqrt(d/g))");
}

}  // namespace

std::vector<SceneEvent> validate_events(const FieldReader& scene_reader, const EventSurroundings& around) {
  const std::vector<FieldReader> entries = scene_reader.children("event");
  if (entries.size() > kMostEvents) {
    scene_reader.fault("event", "has " + format_count(static_cast<double>(entries.size())) +
                                    " entries; allowed: at most " + format_count(kMostEvents));
    return {};
  }
  std::vector<SceneEvent> events(entries.size());
  for (std::size_t i = 0; i < entries.size(); ++i) read_time(entries[i], events[i]);
  Foreseen foreseen{around.wind, {}};
  for (const std::uint32_t id : around.probes) foreseen.names.probes.insert(id);
  for (const std::size_t i : order_by_time(events)) read_event(entries[i], around, foreseen, events[i]);
  return events;
}

}  // namespace pelagos
