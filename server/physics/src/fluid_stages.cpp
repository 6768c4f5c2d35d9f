#include "fluid_stages.hpp"

#include <algorithm>
#include <cassert>

#include "solve_passes.hpp"

namespace pelagos {

namespace {

/// values[k] = values[order[k]], the padding left as it is.
template <class T>
void permute(TaskPool& pool, std::span<const std::uint32_t> order, std::vector<T>& values, std::vector<T>& scratch) {
  scratch.resize(values.size());
  pool.for_each_range(order.size(), kPointBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) scratch[k] = values[order[k]];
  });
  std::copy(values.begin() + static_cast<std::ptrdiff_t>(order.size()), values.end(),
            scratch.begin() + static_cast<std::ptrdiff_t>(order.size()));
  values.swap(scratch);
}

void sort_moving_walls(TaskPool& pool, FluidState& state) {
  BoundaryParticles& walls = state.walls;
  const std::size_t moving = state.moving_position.size();
  assert(state.moving_velocity.size() == moving);
  if (moving == 0) return;
  state.moving_grid.sort(pool, state.moving_position, state.order);
  walls.count = state.static_walls + moving;
  walls.position.resize(padded_count(walls.count));
  walls.velocity.resize(padded_count(walls.count));
  for (std::size_t k = 0; k < moving; ++k) {
    walls.position[state.static_walls + k] = state.moving_position[state.order[k]];
    walls.velocity[state.static_walls + k] = state.moving_velocity[state.order[k]];
  }
  for (std::size_t k = walls.count; k < walls.position.size(); ++k) walls.position[k] = kFarRecord;
  for (std::size_t k = walls.count; k < walls.velocity.size(); ++k) walls.velocity[k] = {};
}

}  // namespace

PairData pair_data(const FluidState& state) {
  PairData data;
  data.count = state.particles.count;
  data.position = state.particles.position.data();
  data.fluid = &state.fluid_list;
  data.boundary = &state.wall_list;
  data.walls = &state.walls;
  data.walls_move = !state.moving_position.empty();
  data.support_radius = static_cast<float>(state.parameters.support_radius);
  data.volume = static_cast<float>(state.parameters.volume());
  data.spacing = static_cast<float>(state.parameters.spacing);
  return data;
}

void predict(TaskPool& pool, FluidState& state, double dt) {
  FluidParticles& p = state.particles;
  pool.for_each_range(p.count, kPointBlock, [&](std::size_t begin, std::size_t end) {
    predict_motion(begin, end, static_cast<float>(dt), p.acceleration.data(), p.velocity.data(), p.position.data());
  });
}

void sort_particles(TaskPool& pool, FluidState& state) {
  FluidParticles& p = state.particles;
  sort_moving_walls(pool, state);
  state.fluid_grid.sort(pool, {p.position.data(), p.count}, state.order);
  permute(pool, state.order, p.position, state.sorted_record);
  permute(pool, state.order, p.velocity, state.sorted_record);
  permute(pool, state.order, p.density_pressure, state.sorted_scalar);
  permute(pool, state.order, p.id, state.sorted_id);
}

void search_neighbors(TaskPool& pool, FluidState& state, StepReport& report) {
  const FluidParticles& p = state.particles;
  const std::span<const Float4> query{p.position.data(), p.count};
  const auto radius = static_cast<float>(state.parameters.support_radius);
  const SearchSource fluid{&state.fluid_grid, p.position.data(), 0};
  const SearchReport found = find_neighbors(pool, state.fluid_grid, query, {&fluid, 1}, radius,
                                            static_cast<std::int32_t>(p.count), state.fluid_list);
  report.pairs = found.pairs;
  const SearchSource walls[2] = {{&state.static_grid, state.walls.position.data(), 0},
                                 {&state.moving_grid, state.walls.position.data() + state.static_walls,
                                  static_cast<std::uint32_t>(state.static_walls)}};
  const std::size_t sources = state.moving_position.empty() ? 1 : 2;
  const SearchReport near_walls = find_neighbors(pool, state.fluid_grid, query, {walls, sources}, radius,
                                                 static_cast<std::int32_t>(state.walls.count), state.wall_list);
  report.long_rows = found.long_rows + near_walls.long_rows;
}

void refresh_density(TaskPool& pool, FluidState& state, StepReport& report) {
  compute_density(pool, pair_data(state), state.particles.density, state.alpha, state.wall_gradient, state.gradients);
  ++report.pair_passes;
}

}  // namespace pelagos
