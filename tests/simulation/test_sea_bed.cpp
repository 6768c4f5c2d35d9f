// Water over a sea bed that is not level.

#include <gtest/gtest.h>

#include <cmath>

#include "simulation/world.hpp"

namespace pelagos {
namespace {

/// m above the level bottom: a mound whose slopes are up to 0.43.
double mound(double x, double y) { return 3.0 * std::exp(-(x * x + y * y) / 36.0); }

/// A calm open sea of 60 x 60 x 6 m over a mound.
Scene calm_scene() {
  Scene scene;
  scene.name = "mound";
  scene.particle_spacing = 1.0;
  scene.patch = {{-30.0, -30.0, -6.0}, {30.0, 30.0, 6.0}};
  scene.patch_edges = {PatchEdge::kOpen, PatchEdge::kOpen, PatchEdge::kWall};
  scene.water.blocks = {{scene.patch.min, {30.0, 30.0, 0.0}}};
  scene.open_sea.zone_width = 6.0;
  scene.open_sea.depth = 6.0;
  scene.water.settle_steps = 100;
  HeightGrid grid{-30.0, -30.0, 1.0, 61, 61, {}};
  grid.height.resize(61 * 61);
  for (std::size_t node = 0; node < grid.height.size(); ++node)
    grid.height[node] = static_cast<float>(mound(grid.node_x(node), grid.node_y(node)) - 6.0);
  scene.open_sea.bed = {grid, 6.0};
  return scene;
}

/// Centres of the cells of 1 m that lie between the bed and the still water.
std::size_t places_in_water() {
  std::size_t count = 0;
  for (int k = 0; k < 6; ++k)
    for (int j = 0; j < 60; ++j)
      for (int i = 0; i < 60; ++i) count += mound(i - 29.5, j - 29.5) < k + 0.5 ? 1 : 0;
  return count;
}

TEST(SeaBed, HoldsWaterAtRest) {
  World world(calm_scene(), {});
  const std::size_t start = world.fluid().particles.count;
  // Cells whose centres lie on the bed by chance come in rings of eight.
  EXPECT_NEAR(static_cast<double>(start), static_cast<double>(places_in_water()), 8.0);
  while (world.time() < 6.0) (void)world.advance({});
  const FluidParticles& p = world.fluid().particles;
  EXPECT_LT(std::abs(static_cast<double>(p.count) - static_cast<double>(start)), 30.0);
  double squares = 0.0;
  for (std::size_t i = 0; i < p.count; ++i) {
    const Float4 &x = p.position[i], &v = p.velocity[i];
    const Eigen::Vector3d place = world.patch().to_world(Eigen::Vector3d(x.x, x.y, x.z));
    EXPECT_GT(place.z(), mound(place.x(), place.y()) - 6.0 - 0.1);
    EXPECT_LT(place.z(), 0.6);
    squares += static_cast<double>(v.x * v.x + v.y * v.y + v.z * v.z);
  }
  EXPECT_LT(std::sqrt(squares / static_cast<double>(p.count)), 0.12);
}

TEST(SeaBed, GivesTheSameBitsForAnyNumberOfThreads) {
  const auto hash = [](int threads) {
    WorldOptions options;
    options.threads = threads;
    Scene scene = calm_scene();
    scene.water.settle_steps = 5;
    World world(scene, options);
    for (int step = 0; step < 8; ++step) (void)world.advance({});
    return state_hash(world.fluid().particles);
  };
  EXPECT_EQ(hash(1), hash(3));
}

}  // namespace
}  // namespace pelagos
