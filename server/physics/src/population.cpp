#include <algorithm>
#include <cassert>

#include "fluid_stages.hpp"

namespace pelagos {

// Particles that come and go between steps.

namespace {

/// Sizes the array for `count` particles: entries from `first` on get `value`, those behind `count` get `padding`.
template <class T>
void extend_to(std::vector<T>& values, std::size_t first, std::size_t count, T value, T padding) {
  values.resize(padded_count(count));
  std::fill(values.begin() + static_cast<std::ptrdiff_t>(first), values.begin() + static_cast<std::ptrdiff_t>(count),
            value);
  std::fill(values.begin() + static_cast<std::ptrdiff_t>(count), values.end(), padding);
}

/// The present particles are not those of the last step's lists, images and solves.
void forget_step(FluidState& state) {
  state.gradients_present = false;
  state.ghosts.count = 0;
  state.work.pressure.clear();
  if (state.source.size() < padded_count(state.particles.count))
    state.source.resize(padded_count(state.particles.count), 0.0F);
}

/// values[k] = values[kept[k]], then dummies.
template <class T>
void keep_only(std::span<const std::uint32_t> kept, T padding, std::vector<T>& values) {
  for (std::size_t k = 0; k < kept.size(); ++k) values[k] = values[kept[k]];
  extend_to(values, kept.size(), kept.size(), padding, padding);
}

}  // namespace

void add_particles(FluidState& state, std::span<const Float4> positions, std::span<const Float4> velocities,
                   std::uint8_t phase, std::span<const Float4> labels) {
  assert(velocities.size() == positions.size());
  assert(labels.size() == (state.particles.label.empty() ? 0 : positions.size()));
  assert(phase == kWaterPhase || state.parameters.oil);
  if (positions.empty()) return;
  FluidParticles& p = state.particles;
  const std::size_t first = p.count, count = first + positions.size();
  const Float4 gravity{0.0F, 0.0F, static_cast<float>(-state.parameters.gravity), 0.0F};
  extend_to(p.position, first, count, Float4{}, kFarRecord);
  extend_to(p.velocity, first, count, Float4{}, Float4{});
  extend_to(p.acceleration, first, count, gravity, Float4{});
  extend_to(p.density, first, count, 1.0F, 0.0F);
  extend_to(p.density_pressure, first, count, 0.0F, 0.0F);
  extend_to(p.divergence_pressure, first, count, 0.0F, 0.0F);
  extend_to(p.id, first, count, 0U, 0U);
  if (state.parameters.oil) extend_to(p.phase, first, count, phase, kWaterPhase);
  if (!labels.empty()) {
    extend_to(p.label, first, count, Float4{}, Float4{});
    std::copy(labels.begin(), labels.end(), p.label.begin() + static_cast<std::ptrdiff_t>(first));
  }
  for (std::size_t k = 0; k < positions.size(); ++k) {
    p.position[first + k] = {positions[k].x, positions[k].y, positions[k].z, 0.0F};
    p.velocity[first + k] = {velocities[k].x, velocities[k].y, velocities[k].z, 0.0F};
    p.id[first + k] = state.next_id++;
  }
  p.count = count;
  forget_step(state);
}

std::size_t remove_particles(TaskPool& pool, FluidState& state, const std::function<bool(std::size_t)>& unwanted) {
  FluidParticles& p = state.particles;
  std::vector<std::uint8_t> gone(p.count);
  for_each_entry(pool, p.count, [&](std::size_t i) { gone[i] = unwanted(i) ? 1 : 0; });
  std::vector<std::uint32_t> kept;
  kept.reserve(p.count);
  for (std::size_t i = 0; i < p.count; ++i)
    if (gone[i] == 0) kept.push_back(static_cast<std::uint32_t>(i));
  const std::size_t removed = p.count - kept.size();
  if (removed == 0) return 0;
  keep_only(kept, kFarRecord, p.position);
  for (std::vector<Float4>* values : {&p.velocity, &p.acceleration}) keep_only(kept, Float4{}, *values);
  for (std::vector<float>* values : {&p.density, &p.density_pressure, &p.divergence_pressure})
    keep_only(kept, 0.0F, *values);
  keep_only(kept, 0U, p.id);
  if (!p.phase.empty()) keep_only(kept, kWaterPhase, p.phase);
  if (!p.label.empty()) keep_only(kept, Float4{}, p.label);
  p.count = kept.size();
  forget_step(state);
  return removed;
}

void restore_water(FluidState& state, const WaterState& water) {
  static_cast<WaterState&>(state) = water;
  forget_step(state);
  state.coupling.contacts.clear();
  find_held(state);
}

}  // namespace pelagos
