// What happens when: the scene's timed commands.

#include <algorithm>
#include <numeric>

#include "messages/commands.hpp"
#include "messages/given_names.hpp"
#include "validate_scene.hpp"

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

/// Whether the command fits what the scene has, and what the events before it have set.
void check_fit(const FieldReader& entry, const std::optional<CommandSite>& site, const Command& command,
               GivenNames& given) {
  std::optional<Misfit> misfit;
  if (site) misfit = find_misfit(command, *site);
  if (!misfit) misfit = find_unknown_name(command, given);
  if (!misfit) misfit = find_no_room(command, given);
  if (misfit) entry.child(entry.which("command").c_str()).fault(misfit->field.c_str(), misfit->what);
  given.follow(command);
}

void read_event(const FieldReader& entry, const EventSurroundings& around, CommandBasis& last, GivenNames& given,
                SceneEvent& event) {
  if (entry.which("command").empty())
    return entry.fault("", "says when but not what; allowed: one command beside `at`, e.g. set_wind { ... }");
  const std::size_t faults = entry.fault_count();
  const std::optional<Command> command = read_command(entry, "command", CommandPlace::kTimed, last);
  if (!command) return;
  event.command = *command;
  if (entry.fault_count() == faults) check_fit(entry, around.site, *command, given);
  if (const auto* set = std::get_if<SetWind>(&event.command)) {
    last.wind = set->wind;
    if (around.weightless)
      entry.fault("set_wind", "blows without gravity; allowed: gravity above 0 (the push scales with sqrt(d/g))");
  }
  if (std::holds_alternative<ClearWind>(event.command)) last.wind.reset();
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
  CommandBasis last{around.wind};
  GivenNames given;
  for (const std::uint32_t id : around.probes) given.probes.insert(id);
  for (const std::size_t i : order_by_time(events)) read_event(entries[i], around, last, given, events[i]);
  return events;
}

}  // namespace pelagos
