#include "simulation/oil_particles.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace pelagos {
namespace {

/// Water and some oil at random places in a cube of 4 m, sorted by cells of 0.5 m.
struct Cloud {
  explicit Cloud(std::size_t count) : cells({{0, 0, 0}, {4, 4, 4}}, 0.5) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> place(0.0F, 4.0F);
    for (std::size_t i = 0; i < count; ++i) {
      position.push_back({place(random), place(random), place(random), 0.0F});
      phase.push_back(i % 7 == 0 ? kOilPhase : kWaterPhase);
    }
    TaskPool pool(1);
    std::vector<std::uint32_t> order;
    cells.sort(pool, position, order);
    const std::vector<Float4> before = position;
    for (std::size_t i = 0; i < count; ++i) position[i] = before[order[i]];
  }
  [[nodiscard]] ParticlePhases view() const { return {position, phase}; }
  std::vector<Float4> position;
  std::vector<std::uint8_t> phase;
  CellGrid cells;
};

/// Of all particles, by a loop over them.
std::optional<std::size_t> nearest_of_all(const Cloud& cloud, const Eigen::Vector3f& place, float reach) {
  std::optional<std::size_t> found;
  float nearest = reach * reach;
  for (std::size_t i = 0; i < cloud.position.size(); ++i) {
    const Float4& x = cloud.position[i];
    const float distance = (Eigen::Vector3f(x.x, x.y, x.z) - place).squaredNorm();
    if (cloud.phase[i] != kWaterPhase || !(distance < nearest)) continue;
    nearest = distance;
    found = i;
  }
  return found;
}

Eigen::AlignedBox3f box_around(const Eigen::Vector3f& place, float reach) {
  return {place - Eigen::Vector3f::Constant(reach), place + Eigen::Vector3f::Constant(reach)};
}

TEST(OilParticles, NearestWaterInABoxIsTheNearestOfAllOneAfterTheOther) {
  Cloud cloud(2000);
  const float reach = 0.6F;
  const std::vector<Eigen::Vector3f> places{{1, 1, 1}, {1.3F, 1, 1}, {3.9F, 0.1F, 2}};
  std::vector<Eigen::AlignedBox3f> boxes;
  for (const Eigen::Vector3f& place : places) boxes.push_back(box_around(place, reach));
  const auto water = collect_water(cloud.view(), cloud.cells, 0.0F, boxes);
  for (int turn = 0; turn < 60; ++turn)  // until some have no water left
    for (std::size_t k = 0; k < places.size(); ++k) {
      const auto wanted = nearest_of_all(cloud, places[k], reach);
      ASSERT_EQ(nearest_water(cloud.view(), water[k], places[k], reach), wanted) << turn;
      if (wanted) cloud.phase[*wanted] = kOilPhase;
    }
  EXPECT_FALSE(nearest_of_all(cloud, places[2], reach)) << "the test has seen a place run dry";
}

TEST(OilParticles, WaterThatHasMovedSinceTheSortIsFound) {
  Cloud cloud(3000);
  std::mt19937 random(6);
  std::uniform_real_distribution<float> way(-0.2F, 0.2F);
  for (Float4& p : cloud.position) p.x += way(random), p.y += way(random), p.z += way(random);
  const std::vector<Eigen::AlignedBox3f> boxes{box_around({2, 2, 2}, 0.4F), box_around({0.1F, 4.1F, 2}, 0.3F)};
  const auto water = collect_water(cloud.view(), cloud.cells, 0.2F, boxes);
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    std::vector<std::uint32_t> wanted;
    for (std::uint32_t i = 0; i < cloud.position.size(); ++i)
      if (cloud.phase[i] == kWaterPhase && boxes[k].contains(vector_of(cloud.position[i]))) wanted.push_back(i);
    EXPECT_FALSE(wanted.empty());
    EXPECT_EQ(water[k], wanted) << "in their order";
  }
}

TEST(OilParticles, NothingIsFoundInAnEmptyBoxOrOutOfReach) {
  const Cloud cloud(100);
  const std::vector<Eigen::AlignedBox3f> boxes{Eigen::AlignedBox3f(), box_around({9, 9, 9}, 1.0F)};
  const auto water = collect_water(cloud.view(), cloud.cells, 0.0F, boxes);
  EXPECT_TRUE(water[0].empty());
  EXPECT_TRUE(water[1].empty());
  EXPECT_FALSE(nearest_water(cloud.view(), water[1], {9, 9, 9}, 1.0F));
  EXPECT_TRUE(collect_water({}, CellGrid(), 0.0F, {}).empty());
}

TEST(OilParticles, ThinOilIsWhatHasLittleOilInTheColumnsAround) {
  ColumnGrid grid;
  grid.columns = grid.rows = 5;
  Cloud cloud(0);
  const auto add = [&](float x, float y, int count, std::uint8_t phase) {
    for (int n = 0; n < count; ++n) {
      cloud.position.push_back({x, y, 0.1F * static_cast<float>(n), 0.0F});
      cloud.phase.push_back(phase);
    }
  };
  add(0.5F, 0.5F, 1, kOilPhase);                                     // 0: alone
  add(0.5F, 0.5F, 9, kWaterPhase);                                   // 1 to 9
  add(4.5F, 4.5F, 2, kOilPhase);                                     // 10, 11: two in a column
  add(2.5F, 2.5F, 1, kOilPhase);                                     // 12: alone in its column, four more beside it
  add(3.5F, 2.5F, 4, kOilPhase);                                     // 13 to 16
  add(std::numeric_limits<float>::quiet_NaN(), 0.5F, 1, kOilPhase);  // 17: no place
  const std::vector<int> oil = count_oil(cloud.view(), grid);
  EXPECT_EQ(oil[grid.index(0, 0)], 1);
  EXPECT_EQ(oil[grid.index(3, 2)], 4);
  EXPECT_EQ(find_thin_oil(cloud.view(), grid, oil, 2, 5), (std::vector<std::size_t>{0}));
  EXPECT_EQ(find_thin_oil(cloud.view(), grid, oil, 3, 6), (std::vector<std::size_t>{0, 10, 11, 12}));
}

}  // namespace
}  // namespace pelagos
