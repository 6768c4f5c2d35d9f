#include "simulation/water_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "simulation/world.hpp"
#include "small_patch.hpp"
#include "waves/sea_state.hpp"
#include "waves/splitmix.hpp"
#include "world_access.hpp"

namespace pelagos {
namespace {

/// Water of 16 x 12 x 2 m with d = 0.25 m, periodic, that has run for a second under a wind, in a far sea.
class WaterSurfaceTest : public testing::Test {
 protected:
  static Scene scene() {
    Scene scene = test::small_patch();
    scene.patch = {{0, 0, 0}, {16, 12, 4}};
    scene.water.blocks = {{{0, 0, 0}, {16, 12, 2}}};
    scene.water.settle_steps = 20;
    scene.patch_edges = {PatchEdge::kPeriodic, PatchEdge::kPeriodic, PatchEdge::kWall};
    scene.far_sea = {5, 60.0, 24};
    scene.wind.emplace();
    scene.wind->velocity = {12.0, 3.0, 0.0};
    return scene;
  }
  void SetUp() override {
    while (world_.time() < 1.0) (void)world_.advance();
    const Region& patch = world_.fluid().parameters.patch;
    min_ = {patch.min[0], patch.min[1]};
    max_ = {patch.max[0], patch.max[1]};
  }
  [[nodiscard]] SurfaceSurroundings around(const PatchBlend& blend) const {
    return {world_.patch(), world_.fluid().parameters.patch, blend};
  }
  /// Places up to 8 m outside the patch.
  [[nodiscard]] std::vector<SurfacePlace> places(std::size_t count) const {
    SplitMix64 random(3);
    std::vector<SurfacePlace> places;
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector2d part(random.next_unit(), random.next_unit());
      places.push_back({min_.array() - 8.0 + part.array() * (max_ - min_).array() + 16.0 * part.array(), {}});
    }
    return places;
  }
  TaskPool pool_{1};
  World world_{scene(), {1, nullptr, {}}};
  Eigen::Vector2d min_, max_;
};

TEST_F(WaterSurfaceTest, ProbesOilAndWindReadTheSameHeight) {
  WaterSurface surface(pool_, around({}));
  const SurfaceGrid grid = surface.grid_with_velocities(world_.fluid());
  const double d = world_.fluid().parameters.spacing;
  ASSERT_GT(grid.cells.size(), 500U);
  double square = 0.0;
  std::size_t count = 0;
  for (int j = 0; j < grid.grid.rows; ++j)
    for (int i = 0; i < grid.grid.columns; ++i) {
      const double cell = static_cast<double>(grid.grid.cell);
      const Eigen::Vector2d centre(static_cast<double>(grid.grid.origin_x) + (i + 0.5) * cell,
                                   static_cast<double>(grid.grid.origin_y) + (j + 0.5) * cell);
      if ((centre - min_).minCoeff() < 0.0 || (max_ - centre).minCoeff() < 0.0) continue;
      const std::vector<SurfacePlace> at{{centre, {}}, {centre + Eigen::Vector2d(0.5 * cell, 0.5 * cell), {}}};
      const auto read = surface.read(world_.fluid(), world_.sea(), world_.time(), at);
      const SurfaceCell& here = grid.cells[grid.grid.index(i, j)];
      ASSERT_TRUE(read[0].wet && here.wet);
      EXPECT_NEAR(static_cast<double>(here.height), read[0].height, 1e-6);
      EXPECT_LT((here.velocity.cast<double>() - read[0].velocity).norm(), 1e-6);
      const auto between = sample_at(grid, at[1].local);
      if (read[1].share < 1.0 || !between) continue;
      square += std::pow(between->height - read[1].height, 2);
      ++count;
    }
  EXPECT_LT(std::sqrt(square / static_cast<double>(count)), 0.05 * d) << "between centres the grid is linear";
}

TEST_F(WaterSurfaceTest, IsTheParticlesInsideTheWavesOutsideAndBlendedOnce) {
  const PatchBlend blend = rim_blend(0.25, 12.0);
  WaterSurface surface(pool_, around(blend));
  const WaveMoment moment = world_.sea().at(world_.time(), world_.patch().origin.head<2>());
  const std::vector<SurfacePlace> at = places(1000);
  const auto read = surface.read(world_.fluid(), world_.sea(), world_.time(), at);
  const auto water = surface.read_particles(world_.fluid(), at);
  std::size_t inside = 0, outside = 0, mixed = 0;
  for (std::size_t k = 0; k < at.size(); ++k) {
    const double share = patch_weight(blend, min_, max_, at[k].local);
    ASSERT_TRUE(read[k].wet);
    EXPECT_EQ(read[k].share, share);
    float height = 0, out[5];
    const auto x = static_cast<float>(at[k].local.x()), y = static_cast<float>(at[k].local.y());
    evaluate_displaced_surface(moment, {&x, 1}, {&y, 1},
                               {{&height, 1}, {&out[0], 1}, {&out[1], 1}, {&out[2], 1}, {&out[3], 1}, {&out[4], 1}});
    const double waves = world_.water_level() - world_.patch().origin.z() + static_cast<double>(height);
    EXPECT_NEAR(read[k].height, share * water[k].height + (1.0 - share) * waves, 1e-4);
    (share == 1.0 ? inside : share == 0.0 ? outside : mixed)++;
  }
  EXPECT_GT(inside, 40U);
  EXPECT_GT(outside, 100U);
  EXPECT_GT(mixed, 100U);
}

TEST_F(WaterSurfaceTest, IsContinuousAcrossAnOpenEdge) {
  WaterSurface surface(pool_, around(rim_blend(0.25, 12.0)));
  std::vector<SurfacePlace> line;
  constexpr double kStep = 0.005;
  for (double x = -1.0; x < 4.0; x += kStep) line.push_back({{min_.x() + x, 0.5 * (min_.y() + max_.y())}, {}});
  const auto read = surface.read(world_.fluid(), world_.sea(), world_.time(), line);
  for (std::size_t k = 1; k < read.size(); ++k)  // slopes of up to 1
    EXPECT_LT(std::abs(read[k].height - read[k - 1].height), 1.0 * kStep) << line[k].local.x();
}

TEST_F(WaterSurfaceTest, HasTheSameBitsForAnyNumberOfThreads) {
  WaterSurface first(pool_, around({}));
  const SurfaceGrid expected = first.grid_with_velocities(world_.fluid());
  for (const int threads : {2, 7}) {
    TaskPool many(threads);
    WaterSurface again(many, around({}));
    const SurfaceGrid& grid = again.grid_with_velocities(world_.fluid());
    ASSERT_EQ(grid.cells.size(), expected.cells.size());
    for (std::size_t k = 0; k < grid.cells.size(); ++k) {
      ASSERT_EQ(grid.cells[k].height, expected.cells[k].height);
      ASSERT_EQ(grid.cells[k].velocity, expected.cells[k].velocity);
    }
  }
}

TEST(WaterSurface, ProbesThatABodyCarriesOutsideThePatchReadTheFarSea) {
  const test::CubeFile cube;
  Scene scene = test::patch_with_cube(cube);
  scene.far_sea = {6, 60.0, 24};
  ProbeSettings probe;
  probe.id = 1;
  probe.name = "far";
  probe.body = 1;
  probe.position = {90.0, -40.0, 0.0};
  scene.probes = {probe, probe};
  scene.probes[1].id = 2;
  scene.probes[1].at_surface = false;
  scene.probes[1].position.z() = -200.0;
  const World world(scene, {1, nullptr, {}});
  const std::vector<ProbeReading> read = world.read_probes();
  ASSERT_TRUE(read[0].wet && read[1].wet);
  EXPECT_NE(read[0].height, world.water_level());
  EXPECT_NEAR(read[0].height, world.water_level(), 5.0);
  EXPECT_GT(read[0].velocity.norm(), 0.1);
  EXPECT_LT(read[1].velocity.norm(), 0.05) << "200 m down";
}

}  // namespace
}  // namespace pelagos
