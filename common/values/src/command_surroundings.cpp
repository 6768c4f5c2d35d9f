#include "values/command_surroundings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "values/sea_request.hpp"

namespace pelagos {

namespace {

using Fault = std::optional<Refusal>;

Fault find_wrong_body(std::uint32_t body, const CommandSurroundings& around) {
  if (std::find(around.bodies.begin(), around.bodies.end(), body) != around.bodies.end()) return {};
  std::string allowed;
  for (const std::uint32_t id : around.bodies) allowed += (allowed.empty() ? "" : ", ") + std::to_string(id);
  return Refusal{"body", fmt::format("the scene has no body {}; allowed: {}", body,
                                     allowed.empty() ? "none, it has no bodies" : allowed)};
}

Fault find_place_outside(const char* field, const Eigen::Vector2d& place, const Box& patch) {
  const auto x = place.array();
  if ((x >= patch.min.head<2>().array()).all() && (x <= patch.max.head<2>().array()).all()) return {};
  return Refusal{field, fmt::format("({:g}, {:g}) m is outside the patch; allowed: ({:g}, {:g}) to ({:g}, {:g}) m",
                                    place.x(), place.y(), patch.min.x(), patch.min.y(), patch.max.x(), patch.max.y())};
}

Fault find_place_outside(const char* field, const Eigen::Vector3d& place, const Box& patch) {
  if ((place.array() >= patch.min.array()).all() && (place.array() <= patch.max.array()).all()) return {};
  return Refusal{field, fmt::format("({:g}, {:g}, {:g}) m is outside the patch; allowed: ({:g}, {:g}, {:g}) to "
                                    "({:g}, {:g}, {:g}) m",
                                    place.x(), place.y(), place.z(), patch.min.x(), patch.min.y(), patch.min.z(),
                                    patch.max.x(), patch.max.y(), patch.max.z())};
}

/// Whether a piece of the line from a to b lies over the patch: the part of it within both pairs of faces.
bool crosses(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Box& patch) {
  double first = 0.0, last = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    const double way = b[axis] - a[axis], to_min = patch.min[axis] - a[axis], to_max = patch.max[axis] - a[axis];
    if (way == 0.0) {
      if (to_min > 0.0 || to_max < 0.0) return false;
      continue;
    }
    first = std::max(first, std::min(to_min / way, to_max / way));
    last = std::min(last, std::max(to_min / way, to_max / way));
  }
  return first <= last;
}

/// A boom may be moored beyond the patch, but not miss it.
Fault find_boom_outside(const std::vector<Eigen::Vector2d>& line, const Box& patch) {
  for (std::size_t i = 1; i < line.size(); ++i)
    if (crosses(line[i - 1], line[i], patch)) return {};
  return Refusal{"point",
                 fmt::format("all of the boom is outside the patch; allowed: some of it within ({:g}, {:g}) to "
                             "({:g}, {:g}) m",
                             patch.min.x(), patch.min.y(), patch.max.x(), patch.max.y())};
}

/// What works on the film alone.
Fault find_missing_film(const char* what, const CommandSurroundings& around) {
  if (around.oil != OilModel::kParticles) return {};
  return Refusal{"", fmt::format("{} works on the slick layer; allowed with oil.model SLICK or BOTH in the scene, and "
                                 "here it is PARTICLES",
                                 what)};
}

struct OilChecker {
  const CommandSurroundings& around;

  Fault operator()(const ReleaseOil& c) const {
    if (c.body != 0) return find_wrong_body(c.body, around);
    if (auto fault = find_place_outside("from", c.from, around.patch)) return fault;
    return find_place_outside("to", c.to, around.patch);
  }
  Fault operator()(const SpillOil& c) const {
    if (auto fault = find_missing_film("an instant slick", around)) return fault;
    return find_place_outside("position", c.position, around.patch);
  }
  Fault operator()(const SetBoom& c) const {
    if (auto fault = find_missing_film("a boom", around)) return fault;
    return find_boom_outside(c.line, around.patch);
  }
  Fault operator()(const SetSkimmer& c) const {
    if (auto fault = find_missing_film("a skimmer", around)) return fault;
    return find_place_outside("position", c.position, around.patch);
  }
  Fault operator()(const StopRelease&) const { return {}; }
  Fault operator()(const RemoveBoom&) const { return {}; }
  Fault operator()(const RemoveSkimmer&) const { return {}; }
};

Fault find_wrong_probe(const ProbeSettings& probe, const CommandSurroundings& around) {
  if (probe.body != 0) return find_wrong_body(probe.body, around);
  return find_place_outside("position", Eigen::Vector2d(probe.position.head<2>()), around.patch);
}

}  // namespace

CommandSurroundings command_surroundings(const Scene& scene) {
  CommandSurroundings around;
  around.patch = scene.patch;
  for (const BodySettings& body : scene.bodies) around.bodies.push_back(body.id);
  if (scene.oil) around.oil = scene.oil->model;
  if (scene.gravity > 0.0) around.gravity = scene.gravity;
  return around;
}

std::optional<Refusal> find_refusal(const Command& command, const CommandSurroundings& around) {
  if (const auto* set = std::get_if<SetProbe>(&command)) return find_wrong_probe(set->probe, around);
  if (const auto* set = std::get_if<SetWaves>(&command)) return find_wave_refusal(set->waves, around.gravity);
  if (const auto* set = std::get_if<SetSea>(&command)) return find_sea_refusal(set->sea, around.gravity);
  const auto* oil = std::get_if<OilCommand>(&command);
  if (oil == nullptr) return {};
  if (!around.oil) return Refusal{"", "the scene has no oil; needed there: oil { } with its type and model"};
  return std::visit(OilChecker{around}, *oil);
}

}  // namespace pelagos
