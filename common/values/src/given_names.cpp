#include "values/given_names.hpp"

#include <algorithm>
#include <vector>

#include "text/nearest_name.hpp"
#include "values/oil_limits.hpp"

namespace pelagos {

namespace {

constexpr std::size_t kMostListed = 8;

std::optional<Refusal> find_unknown(const char* what, const std::string& name, const std::set<std::string>& given) {
  if (given.contains(name)) return {};
  std::string text = std::string("there is no ") + what + " \"" + name + "\"";
  if (given.empty()) return Refusal{"name", text + ", nor any other"};
  const std::string nearest = nearest_name(name, {given.begin(), given.end()});
  if (!nearest.empty()) text += "; did you mean \"" + nearest + "\"?";
  text += nearest.empty() ? "; allowed:" : " allowed:";
  std::size_t listed = 0;
  for (const std::string& known : given) {
    if (++listed > kMostListed)
      return Refusal{"name", text + " and " + std::to_string(given.size() - kMostListed) + " more"};
    text += std::string(listed > 1 ? "," : "") + " \"" + known + "\"";
  }
  return Refusal{"name", text};
}

struct Follower {
  GivenNames& given;

  void operator()(const ReleaseOil& c) const { given.sources.insert(c.name); }
  void operator()(const StopRelease& c) const { given.sources.erase(c.name); }
  void operator()(const SpillOil&) const {}
  void operator()(const SetBoom& c) const {
    given.booms.insert(c.name);
    given.boom_points[c.name] = c.line.size();
  }
  void operator()(const RemoveBoom& c) const {
    given.booms.erase(c.name);
    given.boom_points.erase(c.name);
  }
  void operator()(const SetSkimmer& c) const { given.skimmers.insert(c.name); }
  void operator()(const RemoveSkimmer& c) const { given.skimmers.erase(c.name); }
};

struct Checker {
  const GivenNames& given;

  std::optional<Refusal> operator()(const StopRelease& c) const {
    return find_unknown("source", c.name, given.sources);
  }
  std::optional<Refusal> operator()(const RemoveBoom& c) const { return find_unknown("boom", c.name, given.booms); }
  std::optional<Refusal> operator()(const RemoveSkimmer& c) const {
    return find_unknown("skimmer", c.name, given.skimmers);
  }
  std::optional<Refusal> operator()(const auto&) const { return {}; }
};

std::optional<Refusal> find_unknown_probe(std::uint32_t id, const std::set<std::uint32_t>& given) {
  if (given.contains(id)) return {};
  std::string text = "there is no probe " + std::to_string(id) + (given.empty() ? ", nor any other" : "; allowed:");
  std::size_t listed = 0;
  for (const std::uint32_t known : given) {
    if (++listed > kMostListed) break;
    text += (listed > 1 ? ", " : " ") + std::to_string(known);
  }
  if (given.size() > kMostListed) text += " and " + std::to_string(given.size() - kMostListed) + " more";
  return Refusal{"id", text};
}

std::optional<Refusal> one_too_many(const char* what, std::size_t present, std::size_t most) {
  return Refusal{"", "there are " + std::to_string(present) + " " + what + "; allowed: at most " +
                         std::to_string(most) + "; remove one first"};
}

std::optional<Refusal> find_no_room_for(const SetBoom& c, const GivenNames& given) {
  if (!given.booms.contains(c.name) && given.booms.size() >= kMostBooms)
    return one_too_many("booms", given.booms.size(), kMostBooms);
  std::size_t others = 0;
  for (const auto& [name, points] : given.boom_points) others += name == c.name ? 0 : points;
  if (others + c.line.size() <= kMostBoomPoints) return {};
  return Refusal{"point", "has " + std::to_string(c.line.size()) + " points; allowed: at most " +
                              std::to_string(kMostBoomPoints - std::min(others, kMostBoomPoints)) +
                              ", as all booms together have at most " + std::to_string(kMostBoomPoints) +
                              " and the others have " + std::to_string(others)};
}

std::optional<Refusal> find_no_room_for(const SetSkimmer& c, const GivenNames& given) {
  if (given.skimmers.contains(c.name) || given.skimmers.size() < kMostSkimmers) return {};
  return one_too_many("skimmers", given.skimmers.size(), kMostSkimmers);
}

std::optional<Refusal> find_no_room_for(const auto&, const GivenNames&) { return {}; }

}  // namespace

std::optional<Refusal> find_no_room(const Command& command, const GivenNames& given) {
  if (const auto* set = std::get_if<SetProbe>(&command))
    if (!given.probes.contains(set->probe.id) && given.probes.size() >= kMostProbes)
      return one_too_many("probes", given.probes.size(), kMostProbes);
  const auto* oil = std::get_if<OilCommand>(&command);
  if (oil == nullptr) return {};
  return std::visit([&](const auto& c) { return find_no_room_for(c, given); }, *oil);
}

void GivenNames::follow(const Command& command) {
  if (const auto* oil = std::get_if<OilCommand>(&command)) std::visit(Follower{*this}, *oil);
  if (const auto* set = std::get_if<SetProbe>(&command)) probes.insert(set->probe.id);
  if (const auto* remove = std::get_if<RemoveProbe>(&command)) probes.erase(remove->id);
}

std::optional<Refusal> find_unknown_name(const Command& command, const GivenNames& given) {
  if (const auto* remove = std::get_if<RemoveProbe>(&command)) return find_unknown_probe(remove->id, given.probes);
  const auto* oil = std::get_if<OilCommand>(&command);
  return oil == nullptr ? std::nullopt : std::visit(Checker{given}, *oil);
}

}  // namespace pelagos
