// What may be asked of the oil, and what it tells.

#include "simulation/oil_spill.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scales/scales.hpp"
#include "values/oil_limits.hpp"

namespace pelagos {

namespace {

/// The fields of the layer are not those of the commands.
std::optional<Refusal> as_whole(const std::optional<Refusal>& refusal) {
  return refusal ? std::optional(Refusal{"", to_string(*refusal)}) : std::nullopt;
}

SlickSettings film_settings(const Scene& scene) {
  const OilSettings& oil = *scene.oil;
  const double d = scene.particle_spacing;
  SlickSettings settings;
  settings.oil = oil.properties;
  settings.oil.viscosity = std::max(oil.properties.viscosity, 1e-6);
  // An oil of particles alone may be heavier than water; its film stays empty.
  settings.water_density = std::max(scene.water.rest_density, 1.001 * oil.properties.density);
  settings.water_temperature = oil.water_temperature;
  settings.gravity = scale_gravity(scene.gravity);
  settings.evaporation = oil.evaporation;
  settings.emulsification = oil.emulsification;
  settings.patch = SlickPatch{scene.patch.min.head<2>(), scene.patch.max.head<2>()};
  for (std::size_t axis = 0; axis < 2; ++axis)
    settings.patch->closed[axis] = scene.patch_edges[axis] != PatchEdge::kPeriodic;
  if (oil.model == OilModel::kBoth)
    settings.exchange = ParticleExchange{1.5 * d, to_kilograms(to_milligrams(oil.properties.density * d * d * d))};
  return settings;
}

}  // namespace

OilSpill::OilSpill(const Scene& scene, const FluidState& fluid, const PatchFrame& frame, double water_level)
    : model_(scene.oil->model),
      frame_(frame),
      spacing_(scene.particle_spacing),
      oil_density_(scene.oil->properties.density),
      water_density_(scene.water.rest_density),
      most_particles_(scene.oil->most_particles),
      layer_(film_settings(scene)),
      fallback_level_(frame.local_height(water_level)) {
  const auto& phase = fluid.particles.phase;
  const auto end = phase.begin() + static_cast<std::ptrdiff_t>(std::min(phase.size(), fluid.particles.count));
  particles_ = static_cast<std::uint32_t>(std::count(phase.begin(), end, kOilPhase));
  if (most_particles_ == 0) most_particles_ = static_cast<std::uint32_t>(fluid.particles.count / 4);
  if (particles_ > 0) static_cast<void>(layer_.release_submerged(particles_ * particle_mass()));
}

double OilSpill::particle_mass() const {
  return to_kilograms(to_milligrams(oil_density_ * spacing_ * spacing_ * spacing_));
}

std::optional<Refusal> OilSpill::apply(const ReleaseOil& c, const Bodies& hulls) {
  for (const auto& [field, place] : {std::pair{"from", c.from}, {"to", c.to}})
    if (c.body == 0 && !hulls.empty() && hulls.covers(place, 0.0))
      return Refusal{field,
                     fmt::format("({:g}, {:g}, {:g}) m is inside a hull; allowed: in the water, or fixed to the body",
                                 place.x(), place.y(), place.z())};
  const double volume = c.rate / 3600.0 * c.duration,
               room = (most_particles_ - std::min(most_particles_, particles_)) * spacing_ * spacing_ * spacing_;
  if (model_ == OilModel::kParticles && std::isfinite(volume) && volume > room)
    return Refusal{"rate",
                   fmt::format("{:g} m^3/h for {:g} s are {:g} m^3, but there is room for {:g} m^3 in particles "
                               "(oil.most_particles {}); allowed: less, a higher bound, or oil.model SLICK or BOTH",
                               c.rate, c.duration, volume, room, most_particles_)};
  if (!sources_.contains(c.name) && sources_.size() >= kMostReleases)
    return Refusal{"",
                   fmt::format("{} sources are running; allowed: at most {}; stop one, or wait until one has run out",
                               sources_.size(), kMostReleases)};
  Source& source = sources_[c.name];
  source.settings = c;
  source.left = c.duration;
  source.status = {c.name};
  return std::nullopt;
}

/// It ends in the next step, which brings out what has flowed so far.
std::optional<Refusal> OilSpill::apply(const StopRelease& c) {
  const auto source = sources_.find(c.name);
  if (source == sources_.end() || source->second.left <= 0.0)
    return Refusal{"name", "no source \"" + c.name + "\" is running; it may have run out"};
  source->second.left = 0.0;
  return std::nullopt;
}

std::optional<Refusal> OilSpill::apply(const SpillOil& c) {
  return as_whole(layer_.release(c.volume * oil_density_, c.position, c.radius));
}

std::optional<Refusal> OilSpill::apply(const SetBoom& c) {
  Boom boom;
  boom.line = c.line;
  boom.draft = c.draft;
  boom.critical_speed = c.critical_speed;
  return as_whole(layer_.set_boom(c.name, boom));
}

std::optional<Refusal> OilSpill::apply(const RemoveBoom& c) {
  layer_.remove_boom(c.name);
  return std::nullopt;
}

std::optional<Refusal> OilSpill::apply(const SetSkimmer& c) {
  return as_whole(layer_.set_skimmer(c.name, Skimmer{c.position, c.radius, c.rate}));
}

std::optional<Refusal> OilSpill::apply(const RemoveSkimmer& c) {
  layer_.remove_skimmer(c.name);
  return std::nullopt;
}

OilBudget OilSpill::budget() const {
  OilBudget budget;
  budget.ledger = layer_.ledger();
  budget.particles = particles_;
  budget.elements = static_cast<std::uint32_t>(layer_.elements().size());
  if (budget.elements > 0) {
    const SlickStatistics film = layer_.statistics();
    budget.area = film.area;
    budget.mean_thickness = film.mean_thickness;
    budget.largest_thickness = film.largest_thickness;
    budget.emulsion_water = film.emulsion_water;
  }
  budget.displaced_water = static_cast<double>(displaced_) * water_density_ * spacing_ * spacing_ * spacing_;
  budget.held_back = held_back_;
  for (const auto& [name, source] : sources_) budget.sources.push_back(source.status);
  for (const auto& [name, boom] : layer_.state().booms) budget.booms.push_back(name);
  for (const auto& [name, skimmer] : layer_.state().skimmers)
    budget.skimmers.push_back({name, skimmer.report.recovered, skimmer.report.present_rate, skimmer.report.dry});
  return budget;
}

std::vector<std::string> OilSpill::sources() const {
  std::vector<std::string> names;
  for (const auto& [name, source] : sources_) names.push_back(name);
  return names;
}

OilSpillState OilSpill::state() const {
  return {layer_.state(), sources_, particles_, displaced_, held_back_, since_exchange_, since_film_};
}

void OilSpill::restore(const OilSpillState& state) {
  layer_.restore(state.layer);
  sources_ = state.sources;
  particles_ = state.particles;
  displaced_ = state.displaced;
  held_back_ = state.held_back;
  since_exchange_ = state.since_exchange;
  since_film_ = state.since_film;
}

}  // namespace pelagos
