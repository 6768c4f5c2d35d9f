#include <gtest/gtest.h>

#include <cmath>

#include "give.hpp"
#include "simulation/world.hpp"
#include "small_patch.hpp"

namespace pelagos {
namespace {

using test::small_patch;

/// Gusts of 20 spacings: what the sea samples on its grid and an anemometer at its place then agree within 1 %.
Scene gusty_patch() {
  Scene scene = small_patch();
  scene.water.settle_steps = 0;
  scene.wind.emplace();
  scene.wind->velocity = {9, 4, 0};
  scene.wind->amplitude = 6;
  scene.wind->length = 5;
  return scene;
}

TEST(WorldWind, AnAnemometerReadsTheAirThatPushesTheSea) {
  const Scene scene = gusty_patch();
  World world(scene, {1, nullptr, {}});
  for (int step = 0; step < 20; ++step) world.advance();
  ASSERT_TRUE(world.air());
  const Air air = *world.air();
  const double full = 1.5 * 1.293 / 1000.0 / (0.07 * std::sqrt(scene.particle_spacing / 9.81));
  const FluidParticles& p = world.fluid().particles;
  int compared = 0;
  for (std::size_t i = 0; i < p.count; ++i) {
    const Eigen::Vector3d place =
        world.patch().origin + Eigen::Vector3f(p.position[i].x, p.position[i].y, p.position[i].z).cast<double>();
    if (place.z() < 0.9) continue;  // the top layer
    const Eigen::Vector3d wind = air.velocity_at({place.x(), place.y(), world.water_level() + 10.0}, world.time());
    // All along the air's velocity (the pressures' part of the acceleration is nil: the corrected solver puts them into
    // velocities), by a factor between that of the surface and that of a particle a spacing down.
    const Eigen::Vector2d push(static_cast<double>(p.acceleration[i].x), static_cast<double>(p.acceleration[i].y));
    const double factor = push.dot(wind.head<2>()) / wind.head<2>().squaredNorm() / full;
    EXPECT_LT((push - factor * full * wind.head<2>()).norm(), 0.04 * push.norm()) << place.transpose();
    EXPECT_GT(factor, 0.78);
    EXPECT_LT(factor, 1.03);
    ++compared;
  }
  EXPECT_GT(compared, 200);
}

TEST(WorldWind, TheAirIsACopyThatGoesOnByItself) {
  World world(gusty_patch(), {1, nullptr, {}});
  const Air before = *world.air();
  const Eigen::Vector3d mast(1, 2, world.water_level() + 10.0);
  const Eigen::Vector3d expected = before.velocity_at(mast, 0.3);
  while (world.time() < 0.3) world.advance();
  EXPECT_LT((world.air()->velocity_at(mast, 0.3) - expected).norm(), 1e-12) << "the same wind, asked ahead";
  static_cast<void>(test::give(world, ClearWind{}));
  EXPECT_FALSE(world.air());
  EXPECT_EQ(before.velocity_at(mast, 0.3), expected);
}

TEST(WorldWind, ChangesItsLawWhileItBlows) {
  World world(gusty_patch(), {1, nullptr, {}});
  for (const WindLaw law : {WindLaw::kPaper, WindLaw::kStress, WindLaw::kGust}) {
    WindSettings wind = *world.scene().wind;
    wind.law = law;
    wind.roughness = default_roughness(law);
    static_cast<void>(test::give(world, SetWind{wind, 0.0}));
    for (int step = 0; step < 5; ++step) {
      const WorldStep made = world.advance();
      ASSERT_EQ(made.report.not_finite, 0u);
    }
    EXPECT_EQ(world.wind()->law, law);
  }
}

}  // namespace
}  // namespace pelagos
