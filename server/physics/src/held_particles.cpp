#include "held_particles.hpp"

#include <algorithm>
#include <cassert>

namespace pelagos {

namespace {

void set_place(const Float4& from, Float4& to) { to = {from.x, from.y, from.z, to.w}; }

}  // namespace

void find_held(FluidState& state) {
  const FluidParticles& p = state.particles;
  state.held.rows.clear();
  if (p.label.empty()) return;
  for (std::size_t i = 0; i < p.count; ++i)
    if (p.label[i].w == kHeld) state.held.rows.push_back(static_cast<std::uint32_t>(i));
}

void place_held(FluidState& state) {
  const HeldWater& held = state.held;
  assert(held.position.size() >= held.rows.size() && held.velocity.size() >= held.rows.size());
  for (std::size_t k = 0; k < held.rows.size(); ++k) {
    set_place(held.position[k], state.particles.position[held.rows[k]]);
    set_place(held.velocity[k], state.particles.velocity[held.rows[k]]);
  }
}

void leave_held_out(FluidState& state) {
  for (const std::uint32_t i : state.held.rows) {
    state.gradients.alpha[i] = 0.0F;
    state.particles.density[i] = std::min(state.particles.density[i], 1.0F);
  }
}

std::span<const float> held_pressures(FluidState& state, double dt) {
  const auto weight = static_cast<float>(state.parameters.gravity * dt * dt);
  HeldWater& held = state.held;
  held.pressure.resize(held.rows.size());
  for (std::size_t k = 0; k < held.rows.size(); ++k)
    held.pressure[k] = weight * std::max(0.0F, -state.particles.label[held.rows[k]].z);
  return held.pressure;
}

void keep_held_velocities(FluidState& state) {
  for (const std::uint32_t i : state.held.rows) state.filter_change.all[i] = {};
}

}  // namespace pelagos
