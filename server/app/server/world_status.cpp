#include "world_status.hpp"

#include <algorithm>

#include "simulation/fluid_setup.hpp"

namespace pelagos {

namespace {

double highest_block(const Scene& scene) {
  double level = scene.patch.min.z();
  for (const Box& block : scene.water.blocks) level = std::max(level, block.max.z());
  return level;
}

BodyState starting_state(const BodySettings& body) {
  BodyState state;
  state.body = body.id;
  state.position = body.position;
  state.orientation = body.orientation;
  state.velocity = body.velocity;
  state.pose_age = -1.0;
  return state;
}

}  // namespace

ServerStatus starting_status(const Scene& scene, const SceneSea& sea) {
  ServerStatus status;
  status.scene = scene.name;
  status.starting = true;
  status.wind = scene.wind;
  status.current = scene.current;
  for (std::size_t axis = 0; axis < 2; ++axis)
    status.moves_water[axis] = scene.patch_edges[axis] == PatchEdge::kPeriodic;
  status.sea = sea_status(sea.at_level(highest_block(scene)), 0.0, sea.request);
  status.effort = {largest_time_step(scene), scene.solver.density.tolerance, scene.solver.divergence.tolerance};
  for (const BodySettings& body : scene.bodies) status.bodies.push_back(starting_state(body));
  if (scene.oil) status.oil.emplace();
  return status;
}

std::optional<Air> starting_air(const Scene& scene) {
  if (!scene.wind) return std::nullopt;
  return Air({patch_frame(scene), highest_block(scene), scene.seed}, *scene.wind);
}

void fill_from(const World& world, ServerStatus& status) {
  status.step = world.step();
  status.frame = world.frame();
  status.simulation_time = world.time();
  status.particles = static_cast<std::uint32_t>(world.fluid().particles.count);
  status.boundary_particles = static_cast<std::uint32_t>(world.fluid().walls.count);
  status.wind = world.wind();
  status.current = world.current();
  status.moves_water = world.current_moves_water();
  status.sea = sea_status(world.sea(), world.time(), world.sea_request());
  status.edges = world.edge_quality();
  status.bodies = world.bodies().states();
  status.holds = world.bodies().holds();
  status.effort = world.effort();
  status.recoveries = world.restored_faults();
}

}  // namespace pelagos
