#include "moving_walls.hpp"

#include <algorithm>
#include <cassert>

#include "fluid_stages.hpp"
#include "sample_images.hpp"

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
  assert(state.moving_velocity.size() == state.moving_position.size());
  state.walls_move = false;
  if (state.moving_position.empty()) return;
  const FluidParameters& q = state.parameters;
  const std::vector<PlacedSample> placed = place_with_images(q.patch, q.edges, static_cast<float>(q.support_radius),
                                                             static_cast<float>(q.spacing), state.moving_position);
  const std::size_t moving = placed.size();
  std::vector<Float4> positions(moving);
  for (std::size_t k = 0; k < moving; ++k) positions[k] = placed[k].position;
  state.moving_grid.sort(pool, positions, state.order);
  walls.count = state.static_walls + moving;
  walls.position.resize(padded_count(walls.count));
  walls.velocity.resize(padded_count(walls.count));
  std::vector<BodySample>& samples = state.coupling.samples;
  samples.resize(moving);
  for (std::size_t k = 0; k < moving; ++k) {
    const PlacedSample& sample = placed[state.order[k]];
    samples[k] = {body_of_sample(state.coupling, sample.source), sample.source, sample.sign};
    walls.position[state.static_walls + k] = sample.position;
    Float4& velocity = walls.velocity[state.static_walls + k];
    velocity = {};
    if (samples[k].body >= 0) continue;
    const Float4& v = state.moving_velocity[sample.source];
    velocity = {sample.sign.x * v.x, sample.sign.y * v.y, sample.sign.z * v.z, 0.0F};
    state.walls_move = true;
  }
  for (std::size_t k = walls.count; k < walls.position.size(); ++k) walls.position[k] = kFarRecord;
  for (std::size_t k = walls.count; k < walls.velocity.size(); ++k) walls.velocity[k] = {};
}

}  // namespace pelagos
