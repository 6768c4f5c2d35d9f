#include <algorithm>
#include <cassert>

#include "fluid_stages.hpp"

namespace pelagos {

namespace {

double harmonic_mean(double a, double b) { return a + b > 0.0 ? 2.0 * a * b / (a + b) : 0.0; }

bool oil_is_lighter(const FluidParameters& parameters) {
  return parameters.oil->rest_density < parameters.rest_density;
}

/// Mobilities and viscosities relative to the water's density.
void set_constants(const FluidParameters& parameters, PhasePair& pair) {
  const PhaseParameters& oil = *parameters.oil;
  const double water_viscosity = parameters.viscosity, oil_viscosity = oil.viscosity / parameters.rest_density;
  const bool oil_light = oil_is_lighter(parameters);
  const auto oil_mobility = static_cast<float>(parameters.rest_density / oil.rest_density);
  pair.light_mobility = oil_light ? oil_mobility : 1.0F;
  pair.heavy_mobility = oil_light ? 1.0F : oil_mobility;
  pair.light_viscosity = static_cast<float>(oil_light ? oil_viscosity : water_viscosity);
  pair.heavy_viscosity = static_cast<float>(oil_light ? water_viscosity : oil_viscosity);
  pair.mixed_viscosity = static_cast<float>(harmonic_mean(water_viscosity, oil_viscosity));
}

/// position.w = 1 for the particles of the lighter phase, else 0, and the mobility of each.
void mark_light(TaskPool& pool, std::span<const std::uint8_t> phase, std::uint8_t light, PhasePair& pair,
                std::span<Float4> position) {
  for_each_entry(pool, phase.size(), [&](std::size_t i) {
    const bool is_light = phase[i] == light;
    position[i].w = is_light ? 1.0F : 0.0F;
    pair.mobility[i] = is_light ? pair.light_mobility : pair.heavy_mobility;
  });
}

}  // namespace

void mark_phases(TaskPool& pool, FluidState& state) {
  FluidParticles& p = state.particles;
  if (p.phase.empty()) return;
  assert(state.parameters.oil);
  permute(pool, state.order, p.phase, state.sorted_phase);
  state.oil_count = static_cast<std::size_t>(
      std::count(p.phase.begin(), p.phase.begin() + static_cast<std::ptrdiff_t>(p.count), kOilPhase));
  if (state.oil_count == 0) return;
  PhasePair& pair = state.phases;
  set_constants(state.parameters, pair);
  pair.mobility.resize(padded_count(p.count));
  const std::uint8_t light = oil_is_lighter(state.parameters) ? kOilPhase : kWaterPhase;
  mark_light(pool, of_particles(state, p.phase), light, pair, p.position);
}

}  // namespace pelagos
