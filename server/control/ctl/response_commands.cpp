#include "response_commands.hpp"

#include "help_text.hpp"
#include "messages/limits.hpp"

namespace pelagos {
namespace {

constexpr int kMostNumbers = static_cast<int>(2 * limits::kMostPoints);

bool given(const CLI::App& command, const char* option) { return command.count(option) > 0; }

void fill_vector(const std::vector<double>& from, proto::v1::Vector& to) {
  to.set_x(from.at(0));
  to.set_y(from.at(1));
  if (from.size() > 2) to.set_z(from.at(2));
}

std::string help_of(const CLI::App& command) { return "; see pelagos-ctl " + command.get_name() + " --help"; }

/// --stop and --remove go with the name alone.
std::string fault_of_end(const CLI::App& command, const char* end) {
  std::size_t options = 0;
  for (const CLI::Option* option : command.get_options())
    if (option->count() > 0 && option->get_name() != "--at") ++options;
  if (options <= 2) return "";  // what it is about, and the end itself
  return command.get_name() + ": " + end + " stands alone" + help_of(command);
}

std::string fault_of_numbers(const CLI::App& command, std::size_t count, bool right, const char* allowed) {
  if (right) return "";
  return command.get_name() + ": " + std::to_string(count) + " numbers are given; allowed: " + allowed +
         help_of(command);
}

}  // namespace

void ResponseCommands::add_to(CLI::App& app) {
  add_release(app);
  add_spill(app);
  add_boom(app);
  add_skimmer(app);
  add_probe(app);
}

void ResponseCommands::add_release(CLI::App& app) {
  release = app.add_subcommand("release", "Let oil flow out of a source; one of the same name is replaced");
  release->add_option("name", name, "Of the source (1 to " + std::to_string(limits::kLongestName) + " bytes)")
      ->required();
  release->add_option("--from", from, "X Y Z where it flows out, m, world frame; with --body in the body's axes")
      ->expected(3);
  release->add_option("--to", to, "X Y Z, the other end of a line along which it flows out evenly, m")->expected(3);
  release->add_option("--body", body, "Id of the body that it moves with, e.g. a breached hull");
  release->add_option("--rate", rate, help_with("m^3/h", limits::kReleaseRate));
  release->add_option("--duration", duration,
                      help_with("Ends after so many seconds of simulated time", limits::kReleaseDuration));
  release->add_flag("--stop", end, "The source ends");
}

void ResponseCommands::add_spill(CLI::App& app) {
  spill = app.add_subcommand("spill", "Oil that is there at once, as a round slick");
  spill->add_option("place", places, "X Y of its middle, m, world frame")->required()->expected(2);
  spill->add_option("--volume", volume, help_with("m^3", limits::kSpillVolume))->required();
  spill->add_option("--radius", radius, help_with("m", limits::kSpillRadius, "1"));
}

void ResponseCommands::add_boom(CLI::App& app) {
  boom = app.add_subcommand("boom", "Moor a floating barrier; one of the same name is replaced");
  boom->add_option("name", name, "Of the boom (1 to " + std::to_string(limits::kLongestName) + " bytes)")->required();
  boom->add_option("points", places,
                   "X Y of each point along it, m, world frame (" + std::to_string(limits::kFewestPoints) + " to " +
                       std::to_string(limits::kMostPoints) + " points)")
      ->expected(0, kMostNumbers);
  boom->add_option("--draft", draft, help_with("Depth of its skirt, m", limits::kBoomDraft, "0.5"));
  boom->add_option("--critical-speed", critical_speed,
                   help_with("Of water across it, above which it leaks, m/s", limits::kCriticalSpeed, "0.36"));
  boom->add_flag("--remove", end, "Take it out of the water");
}

void ResponseCommands::add_skimmer(CLI::App& app) {
  skimmer = app.add_subcommand("skimmer", "Take oil from the water at a place; one of the same name is replaced");
  skimmer->add_option("name", name, "Of the skimmer (1 to " + std::to_string(limits::kLongestName) + " bytes)")
      ->required();
  skimmer->add_option("place", places, "X Y of its middle, m, world frame")->expected(0, kMostNumbers);
  skimmer->add_option("--radius", radius, help_with("Of its reach, m", limits::kSkimmerRadius, "2"));
  skimmer->add_option("--rate", rate, help_with("Of oil and emulsion, m^3/h, 0 is off", limits::kSkimmerRate, "20"));
  skimmer->add_flag("--remove", end, "Take it out of the water");
}

void ResponseCommands::add_probe(CLI::App& app) {
  probe = app.add_subcommand("probe", "Measure the water at a place each frame; one of the same id is replaced");
  probe->add_option("id", id, "1 or more")->required();
  probe->add_option("place", places, "X Y [Z], m, world frame; with --body in the body's axes")
      ->expected(0, kMostNumbers);
  probe->add_option("--body", body, "Id of the body that carries it");
  probe->add_flag("--remove", end, "Measure there no more");
}

std::string ResponseCommands::usage_fault() const {
  const std::size_t count = places.size();
  if (release->parsed() && end) return fault_of_end(*release, "--stop");
  if (release->parsed() && (from.empty() || !given(*release, "--rate")))
    return "release: say where and how much, e.g. --from 12 20 8 --rate 60, or --stop" + help_of(*release);
  if (release->parsed() || spill->parsed()) return "";
  for (const CLI::App* command : {boom, skimmer, probe})
    if (command->parsed() && end) return fault_of_end(*command, "--remove");
  if (boom->parsed())
    return fault_of_numbers(*boom, count, count >= 4 && count % 2 == 0, "X Y of each of 2 points or more, or --remove");
  if (skimmer->parsed()) return fault_of_numbers(*skimmer, count, count == 2, "X Y, or --remove");
  if (probe->parsed()) return fault_of_numbers(*probe, count, count == 2 || count == 3, "X Y [Z], or --remove");
  return "";
}

void ResponseCommands::fill(proto::v1::TimedCommand& command) const {
  if (release->parsed()) fill_release(command);
  if (spill->parsed()) fill_spill(*command.mutable_spill_oil());
  if (boom->parsed()) fill_boom(command);
  if (skimmer->parsed()) fill_skimmer(command);
  if (probe->parsed()) fill_probe(command);
}

void ResponseCommands::fill_release(proto::v1::TimedCommand& command) const {
  if (end) return command.mutable_stop_release()->set_name(name);
  proto::v1::ReleaseOil& out = *command.mutable_release_oil();
  out.set_name(name);
  fill_vector(from, *out.mutable_from());
  if (!to.empty()) fill_vector(to, *out.mutable_to());
  if (given(*release, "--body")) out.set_body(body);
  out.set_rate(rate);
  if (given(*release, "--duration")) out.set_duration(duration);
}

void ResponseCommands::fill_spill(proto::v1::SpillOil& out) const {
  fill_vector(places, *out.mutable_position());
  out.set_volume(volume);
  if (given(*spill, "--radius")) out.set_radius(radius);
}

void ResponseCommands::fill_boom(proto::v1::TimedCommand& command) const {
  if (end) return command.mutable_remove_boom()->set_name(name);
  proto::v1::SetBoom& out = *command.mutable_set_boom();
  out.set_name(name);
  for (std::size_t i = 0; i + 1 < places.size(); i += 2) fill_vector({places[i], places[i + 1]}, *out.add_point());
  if (given(*boom, "--draft")) out.set_draft(draft);
  if (given(*boom, "--critical-speed")) out.set_critical_speed(critical_speed);
}

void ResponseCommands::fill_skimmer(proto::v1::TimedCommand& command) const {
  if (end) return command.mutable_remove_skimmer()->set_name(name);
  proto::v1::SetSkimmer& out = *command.mutable_set_skimmer();
  out.set_name(name);
  fill_vector(places, *out.mutable_position());
  if (given(*skimmer, "--radius")) out.set_radius(radius);
  if (given(*skimmer, "--rate")) out.set_rate(rate);
}

void ResponseCommands::fill_probe(proto::v1::TimedCommand& command) const {
  if (end) return command.mutable_remove_probe()->set_id(id);
  proto::v1::SetProbe& out = *command.mutable_set_probe();
  out.set_id(id);
  fill_vector(places, *out.mutable_position());
  if (given(*probe, "--body")) out.set_body(body);
}

}  // namespace pelagos
