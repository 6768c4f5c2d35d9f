#include <gtest/gtest.h>

#include <cmath>

#include "renderer/loose_water.hpp"

namespace pelagos {
namespace {

SurfaceParticle at(double x, double y, double z) {
  SurfaceParticle particle;
  particle.position = Eigen::Vector3d(x, y, z).cast<float>();
  return particle;
}

/// A sheet of water of side * side particles, one metre apart.
std::vector<SurfaceParticle> sheet(int side) {
  std::vector<SurfaceParticle> particles;
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y) particles.push_back(at(x, y, 0.0));
  return particles;
}

std::size_t count_loose(const std::vector<SurfaceParticle>& particles, double spacing = 1.0) {
  std::size_t count = 0;
  for (const std::uint8_t loose : find_loose_water(particles, spacing)) count += loose;
  return count;
}

TEST(LooseWater, IsWhatTouchesNothingLarge) {
  std::vector<SurfaceParticle> particles = sheet(20);
  EXPECT_EQ(count_loose(particles), 0U);
  particles.push_back(at(4.0, 4.0, 3.0));                                                // a drop
  for (int i = 0; i < 10; ++i) particles.push_back(at(12.0 + i % 3, 9.0 + i / 3, 4.0));  // a clump
  particles.push_back(at(7.0, 7.0, 1.2));                                                // touches the sheet
  const std::vector<std::uint8_t> loose = find_loose_water(particles, 1.0);
  for (std::size_t i = 0; i < 400; ++i) ASSERT_EQ(loose[i], 0) << i;
  for (std::size_t i = 400; i < 411; ++i) EXPECT_EQ(loose[i], 1) << i;
  EXPECT_EQ(loose.back(), 0);
}

TEST(LooseWater, LeavesTwoBodiesOfWaterAlone) {
  std::vector<SurfaceParticle> particles = sheet(10);
  for (const SurfaceParticle& particle : sheet(9))
    particles.push_back(at(static_cast<double>(particle.position.x()) + 500.0, particle.position.y(), -40.0));
  EXPECT_EQ(count_loose(particles), 0U);
}

TEST(LooseWater, TakesTheLargestClumpForWater) {
  EXPECT_EQ(count_loose({at(0, 0, 0), at(1, 0, 0), at(50, 0, 0)}), 1U);
  EXPECT_EQ(count_loose({at(3, 3, 3)}), 0U);
  EXPECT_EQ(count_loose({}), 0U);
}

TEST(LooseWater, FindsNeighborsAcrossAllSidesOfItsCells) {
  // Chains in all thirteen directions, about the origin, where the cells' numbers change their sign
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const Eigen::Vector3d step = 0.099 * Eigen::Vector3d(x, y, z).normalized();
        std::vector<SurfaceParticle> chain;
        for (int i = -50; i < 50; ++i) chain.push_back(at(i * step.x(), i * step.y(), i * step.z()));
        EXPECT_EQ(count_loose(chain, 0.1), 0U) << x << y << z;
      }
}

TEST(LooseWater, BearsPlacesFarAway) {
  EXPECT_EQ(count_loose({at(0, 0, 0), at(1, 0, 0), at(1e30, -1e30, 1e9), at(-3e9, 0, 0)}), 2U);
}

}  // namespace
}  // namespace pelagos
