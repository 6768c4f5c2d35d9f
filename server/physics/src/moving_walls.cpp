#include "moving_walls.hpp"

#include <algorithm>
#include <cassert>

#include "fluid_stages.hpp"

namespace pelagos {

namespace {

/// The body that a moving sample belongs to; -1: none.
std::int32_t body_of_sample(const BodyCoupling& coupling, std::size_t sample) {
  for (std::size_t k = 0; k < coupling.bodies.size(); ++k) {
    const CoupledBody& body = coupling.bodies[k];
    if (sample >= body.first_sample && sample - body.first_sample < body.sample_count)
      return static_cast<std::int32_t>(k);
  }
  return -1;
}

}  // namespace

void sort_moving_walls(TaskPool& pool, FluidState& state) {
  BoundaryParticles& walls = state.walls;
  const std::size_t moving = state.moving_position.size();
  assert(state.moving_velocity.size() == moving);
  state.walls_move = false;
  if (moving == 0) return;
  state.moving_grid.sort(pool, state.moving_position, state.order);
  walls.count = state.static_walls + moving;
  walls.position.resize(padded_count(walls.count));
  walls.velocity.resize(padded_count(walls.count));
  std::vector<std::int32_t>& owner = state.coupling.sample_body;
  owner.resize(moving);
  for (std::size_t k = 0; k < moving; ++k) {
    const std::size_t sample = state.order[k];
    owner[k] = body_of_sample(state.coupling, sample);
    walls.position[state.static_walls + k] = state.moving_position[sample];
    walls.velocity[state.static_walls + k] = owner[k] < 0 ? state.moving_velocity[sample] : Float4{};
    state.walls_move = state.walls_move || owner[k] < 0;
  }
  for (std::size_t k = walls.count; k < walls.position.size(); ++k) walls.position[k] = kFarRecord;
  for (std::size_t k = walls.count; k < walls.velocity.size(); ++k) walls.velocity[k] = {};
}

}  // namespace pelagos
