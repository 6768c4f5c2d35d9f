#include <gtest/gtest.h>

#include <limits>

#include "pair_scene.hpp"

namespace pelagos::test {
namespace {

std::vector<Float4> some_points(std::size_t count, std::uint32_t seed) {
  Random random(seed);
  std::vector<Float4> points;
  for (std::size_t i = 0; i < count; ++i) {
    const Float4 v = random.vector(0.7);  // some lie outside of the region
    points.push_back({v.x + 0.5F, v.y + 0.5F, v.z + 0.5F, 0});
  }
  return points;
}

const Region kUnit{{0, 0, 0}, {1, 1, 1}};

/// Complete: a permutation. Sorted: cells ascend and match begin(). Stable: old indices ascend within a cell.
void expect_sorted(const CellGrid& grid, std::span<const Float4> points, std::span<const std::uint32_t> order) {
  ASSERT_EQ(order.size(), points.size());
  std::vector<int> seen(points.size(), 0);
  for (const std::uint32_t i : order) {
    ASSERT_LT(i, points.size());
    ++seen[i];
  }
  for (const int times : seen) ASSERT_EQ(times, 1);
  const std::span<const std::uint32_t> begin = grid.begin();
  ASSERT_EQ(begin.size(), grid.cell_count() + 1);
  ASSERT_EQ(begin.front(), 0U);
  ASSERT_EQ(begin.back(), points.size());
  for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
    ASSERT_LE(begin[cell], begin[cell + 1]);
    for (std::uint32_t k = begin[cell]; k < begin[cell + 1]; ++k) {
      ASSERT_EQ(grid.cell_of(points[order[k]]), cell);
      if (k > begin[cell]) {
        ASSERT_LT(order[k - 1], order[k]) << "not stable in cell " << cell;
      }
    }
  }
}

TEST(CellGrid, SortsStablyForAnyNumberOfPointsAndThreads) {
  for (const std::size_t count : {0U, 1U, 2U, 3U, 4U, 5U, 15U, 16U, 17U, 5000U}) {
    const std::vector<Float4> points = some_points(count, 3);
    std::vector<std::uint32_t> first;
    for (const int threads : {1, 2, 7}) {
      TaskPool pool(threads);
      CellGrid grid(kUnit, 0.11);
      std::vector<std::uint32_t> order;
      grid.sort(pool, points, order);
      expect_sorted(grid, points, order);
      if (threads == 1) first = order;
      ASSERT_EQ(order, first) << threads << " threads, " << count << " points";
    }
  }
}

TEST(CellGrid, SortsAlikeInAnyNumberOfChunks) {
  std::vector<Float4> points = some_points(9000, 11);
  points[17].x = points[8000].z = std::numeric_limits<float>::quiet_NaN();
  points[18].y = std::numeric_limits<float>::infinity();
  points[19].z = -1e30F;
  TaskPool pool(3);
  CellGrid grid(kUnit, 0.05);
  std::vector<std::uint32_t> first, order;
  for (int round = 0; round < 2; ++round) {  // first in no order, then nearly sorted
    for (const std::size_t chunks : {1U, 2U, 3U, 4U, 8U, 16U, 64U, 0U}) {
      grid.sort(pool, points, order, chunks);
      expect_sorted(grid, points, order);
      if (chunks == 1) first = order;
      ASSERT_EQ(order, first) << chunks << " chunks";
    }
    std::vector<Float4> sorted;
    for (const std::uint32_t i : order) sorted.push_back({points[i].x, points[i].y, points[i].z + 0.02F, 0});
    points = sorted;
  }
}

TEST(CellGrid, SortsAgainWithOtherCounts) {
  TaskPool pool(2);
  CellGrid grid(kUnit, 0.3);
  std::vector<std::uint32_t> order;
  for (const std::size_t count : {700U, 0U, 3U, 900U}) {
    const std::vector<Float4> points = some_points(count, 5);
    grid.sort(pool, points, order);
    expect_sorted(grid, points, order);
  }
}

TEST(CellGrid, ManyCellsGoOverSeveralBlocks) {
  TaskPool pool(2);
  CellGrid grid(kUnit, 0.03);  // 34^3 cells: more than one block of the prefix sum
  ASSERT_GT(grid.cell_count(), 16384U);
  const std::vector<Float4> points = some_points(2000, 7);
  std::vector<std::uint32_t> order;
  grid.sort(pool, points, order);
  expect_sorted(grid, points, order);
}

TEST(CellGrid, PointsOutsideCountToTheNearestEdgeCell) {
  const CellGrid grid(kUnit, 0.25);
  ASSERT_EQ(grid.cells_x(), 4);
  const float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(grid.cell_of({-5, 0.5F, 0.5F, 0}), grid.cell_index(0, 2, 2));
  EXPECT_EQ(grid.cell_of({5, 0.5F, 0.5F, 0}), grid.cell_index(3, 2, 2));
  EXPECT_EQ(grid.cell_of({0.5F, 1, 0.5F, 0}), grid.cell_index(2, 3, 2));
  EXPECT_EQ(grid.cell_of({1e30F, -1e30F, 1e30F, 0}), grid.cell_index(3, 0, 3));
  EXPECT_EQ(grid.cell_of({infinity, -infinity, 0, 0}), grid.cell_index(3, 0, 0));
  EXPECT_EQ(grid.cell_of({nan, nan, nan, 0}), 0U);
  TaskPool pool(2);
  CellGrid sorted(kUnit, 0.25);
  const std::vector<Float4> points = {
      {nan, 0, 0, 0}, {2, 2, 2, 0}, {0.1F, 0.1F, 0.1F, 0}, {-infinity, infinity, nan, 0}};
  std::vector<std::uint32_t> order;
  sorted.sort(pool, points, order);
  expect_sorted(sorted, points, order);
}

TEST(CellGrid, AFlatOrEmptyRegionHasOneCell) {
  EXPECT_EQ(CellGrid(Region{{1, 1, 1}, {1, 1, 1}}, 0.5).cell_count(), 1U);
  EXPECT_EQ(CellGrid(Region{{0, 0, 0}, {1, 0, 1}}, 0.5).cell_count(), 4U);
}

}  // namespace
}  // namespace pelagos::test
