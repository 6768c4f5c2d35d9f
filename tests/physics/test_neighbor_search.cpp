#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <string>

#include "pair_scene.hpp"

namespace pelagos::test {
namespace {

constexpr double kRadius = 0.1;
const Region kRegion{{0, 0, 0}, {1, 0.8F, 0.6F}};

struct Source {
  CellGrid grid{kRegion, kRadius};
  std::vector<Float4> position;
  std::size_t count = 0;

  Source(TaskPool& pool, std::span<const Float4> points) : count(points.size()) {
    std::vector<std::uint32_t> order;
    grid.sort(pool, points, order);
    // The search may read past the last point: fill with what would be noticed.
    position.assign(padded_count(count), Float4{0.5F, 0.4F, 0.3F, 0});
    for (std::size_t k = 0; k < count; ++k) position[k] = points[order[k]];
  }
};

struct Found {
  NeighborList list;
  SearchReport report;
};

Found search(TaskPool& pool, const Source& query, std::span<const SearchSource> sources, std::int32_t dummy) {
  Found found;
  found.report = find_neighbors(pool, query.grid, {query.position.data(), query.count}, sources,
                                static_cast<float>(kRadius), dummy, found.list);
  return found;
}
Found search_self(TaskPool& pool, const Source& points) {
  const SearchSource source{&points.grid, points.position.data(), 0};
  return search(pool, points, {&source, 1}, static_cast<std::int32_t>(points.count));
}

std::vector<std::size_t> row(const NeighborList& list, std::size_t i) {
  std::vector<std::size_t> indices;
  for_each_neighbor(list, i, [&](std::size_t j) { indices.push_back(j); });
  return indices;
}

/// The shape of the list: padding is the dummy, the counts add up, rows of one group do not run into another's.
void expect_well_formed(const Found& found, std::size_t count) {
  const NeighborList& list = found.list;
  ASSERT_EQ(list.groups.size() * kLanes, padded_count(count));
  ASSERT_EQ(list.pair_count.size(), padded_count(count));
  std::uint64_t pairs = 0;
  std::set<std::uint32_t> taken;
  for (std::size_t g = 0; g < list.groups.size(); ++g) {
    const auto [begin, end] = list.groups[g];
    ASSERT_LE(begin, end);
    ASSERT_LE(std::size_t{end} * kLanes, list.slots.size());
    for (std::uint32_t s = begin; s < end; ++s) {
      ASSERT_TRUE(taken.insert(s).second) << "slot " << s << " belongs to two groups";
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        if (s - begin >= list.pair_count[g * kLanes + lane]) {
          ASSERT_EQ(list.slots[s * kLanes + lane], list.dummy) << "group " << g << " lane " << lane;
        }
    }
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      ASSERT_LE(list.pair_count[g * kLanes + lane], end - begin);
      if (g * kLanes + lane >= count) {
        ASSERT_EQ(list.pair_count[g * kLanes + lane], 0U);
      }
      pairs += list.pair_count[g * kLanes + lane];
    }
  }
  ASSERT_EQ(found.report.pairs, pairs);
  ASSERT_GE(found.report.slots * kLanes, pairs);
}

/// Against all pairs in double precision. Within 1e-5 of the cut-off either answer is right: W there is below 1e-14 of
/// its value at zero, and single precision coordinates are no better than that.
void expect_matches_brute_force(const Found& found, const Source& query, const Source& source, std::size_t offset) {
  expect_well_formed(found, query.count);
  for (std::size_t i = 0; i < query.count; ++i) {
    const std::vector<std::size_t> indices = row(found.list, i);
    std::vector<int> times(source.count, 0);
    for (const std::size_t j : indices) {
      if (j < offset || j >= offset + source.count) continue;
      ++times[j - offset];
    }
    for (std::size_t j = 0; j < source.count; ++j) {
      const Double3 x = minus(as_double(query.position[i]), as_double(source.position[j]));
      const double distance = std::sqrt(dot(x, x));
      if (std::abs(distance - kRadius) < 1e-5 * kRadius) {
        ASSERT_LE(times[j], 1);
      } else {
        ASSERT_EQ(times[j], distance < kRadius ? 1 : 0) << "query " << i << ", point " << j << " at " << distance;
      }
    }
  }
}

void expect_symmetric(const Found& found, const Source& points) {
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < points.count; ++i)
    for (const std::size_t j : row(found.list, i)) pairs.insert({i, j});
  for (const auto& [i, j] : pairs) {
    const Double3 x = minus(as_double(points.position[i]), as_double(points.position[j]));
    if (std::sqrt(dot(x, x)) < (1.0 - 1e-5) * kRadius) {
      ASSERT_TRUE(pairs.contains({j, i})) << i << " sees " << j << " but not the other way round";
    }
  }
}

void check(std::span<const Float4> cloud, bool wants_long_rows = false) {
  TaskPool pool(2);
  const Source points(pool, cloud);
  const Found found = search_self(pool, points);
  expect_matches_brute_force(found, points, points, 0);
  if (testing::Test::HasFatalFailure()) return;
  expect_symmetric(found, points);
  if (wants_long_rows) {
    EXPECT_GT(found.report.long_rows, 0U);
  } else {
    EXPECT_EQ(found.report.long_rows, 0U);
  }
}

std::vector<Float4> cloud(std::size_t count, std::uint32_t seed) {
  Random random(seed);
  std::vector<Float4> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = random.uniform(0, 1), y = random.uniform(0, 0.8), z = random.uniform(0, 0.6);
    points.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), 0});
  }
  return points;
}

TEST(NeighborSearch, FindsWhatBruteForceFindsInARandomCloud) { check(cloud(1500, 1)); }

TEST(NeighborSearch, FindsWhatBruteForceFindsInALattice) {
  std::vector<Float4> points = lattice({10, 9, 8}, 0.05, {0.05, 0.05, 0.05});
  check(points);
  jitter(points, 0.012, 2);
  check(points);
}

TEST(NeighborSearch, WorksForAnySmallNumberOfPoints) {
  for (const std::size_t count : {0U, 1U, 2U, 3U, 15U, 16U, 17U, 31U, 32U, 33U}) {
    SCOPED_TRACE(count);
    std::vector<Float4> points = cloud(count, 3);
    check(points);
    for (Float4& p : points) p = {0.3F + 0.2F * p.x, 0.3F + 0.1F * p.y, 0.3F, 0};  // the same, close together
    check(points);
  }
}

TEST(NeighborSearch, TakesTheExactPathForLongRows) {
  Random random(4);
  std::vector<Float4> points = cloud(200, 5);
  for (int i = 0; i < 250; ++i) {  // a knot of more points than a row of the fast path holds
    const Float4 v = random.vector(0.03);
    points.push_back({0.52F + v.x, 0.41F + v.y, 0.29F + v.z, 0});
  }
  check(points, true);
}

TEST(NeighborSearch, RowsAtTheCapacityOfTheFastPath) {
  for (const std::size_t count : {95U, 96U}) {
    SCOPED_TRACE(count);
    check(std::vector<Float4>(count, Float4{0.31F, 0.27F, 0.33F, 0}));
  }
  check(std::vector<Float4>(97, Float4{0.31F, 0.27F, 0.33F, 0}), true);
}

TEST(NeighborSearch, AllPointsInOnePlace) {
  TaskPool pool(2);
  const Source points(pool, std::vector<Float4>(300, Float4{0.5F, 0.4F, 0.3F, 0}));
  const Found found = search_self(pool, points);
  expect_well_formed(found, points.count);
  EXPECT_EQ(found.report.pairs, 300U * 300U);
  EXPECT_EQ(found.report.long_rows, 300U);
}

TEST(NeighborSearch, PointsOnALine) {
  std::vector<Float4> points;
  for (int i = 0; i < 100; ++i) points.push_back({0.01F * static_cast<float>(i), 0.4F, 0.3F, 0});
  check(points);
}

TEST(NeighborSearch, PointsOnAndBeyondTheEdgeOfTheRegion) {
  std::vector<Float4> points = lattice({21, 2, 13}, 0.05);  // from the corner to the far edges
  for (const Float4& p : cloud(300, 6)) {
    points.push_back({-0.15F * p.x, p.y, p.z, 0});       // beyond the lower face
    points.push_back({1.0F + 0.2F * p.x, p.y, p.z, 0});  // the upper face
    points.push_back({p.x, 0.8F + 0.1F * p.y, p.z, 0});  // a side
    points.push_back({p.x, p.y, -0.2F * p.z, 0});        // the bottom
  }
  check(points);
}

TEST(NeighborSearch, PointsThatAreNotFiniteHaveNoNeighbors) {
  TaskPool pool(2);
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  std::vector<Float4> points = cloud(200, 7);
  points[17] = {nan, 0.1F, 0.1F, 0};
  points[33] = {nan, nan, nan, 0};
  points[64] = {infinity, 0.2F, -infinity, 0};
  points[65] = {0.1F, infinity, 0.1F, 0};
  const Source sorted(pool, points);
  const Found found = search_self(pool, sorted);
  expect_well_formed(found, sorted.count);
  const auto finite = [](const Float4& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); };
  int faulty = 0;
  for (std::size_t i = 0; i < sorted.count; ++i) {
    if (!finite(sorted.position[i])) {
      ++faulty;
      EXPECT_EQ(found.list.pair_count[i], 0U);
    }
    for (const std::size_t j : row(found.list, i)) EXPECT_TRUE(finite(sorted.position[j])) << i << " sees " << j;
  }
  EXPECT_EQ(faulty, 4);
}

TEST(NeighborSearch, TwoSourcesKeepTheirOffsets) {
  TaskPool pool(2);
  const Source query(pool, cloud(300, 8)), first(pool, cloud(500, 9)), second(pool, cloud(70, 10));
  // As the walls are kept: one array, the second source behind the first.
  std::vector<Float4> both(padded_count(first.count + second.count));
  std::copy_n(first.position.begin(), first.count, both.begin());
  std::copy_n(second.position.begin(), second.count, both.begin() + static_cast<std::ptrdiff_t>(first.count));
  const SearchSource sources[2] = {{&first.grid, both.data(), 0},
                                   {&second.grid, both.data() + first.count, static_cast<std::uint32_t>(first.count)}};
  const Found found = search(pool, query, sources, static_cast<std::int32_t>(first.count + second.count));
  expect_matches_brute_force(found, query, first, 0);
  if (HasFatalFailure()) return;
  expect_matches_brute_force(found, query, second, first.count);
}

TEST(NeighborSearch, AnEmptySourceGivesEmptyRows) {
  TaskPool pool(2);
  const Source query(pool, cloud(40, 11)), none(pool, {});
  const SearchSource source{&none.grid, none.position.data(), 0};
  const Found found = search(pool, query, {&source, 1}, 0);
  expect_well_formed(found, query.count);
  EXPECT_EQ(found.report.pairs, 0U);
}

TEST(NeighborSearch, OrderDoesNotDependOnTheNumberOfThreads) {
  Random random(12);
  std::vector<Float4> points = cloud(4000, 13);
  for (int i = 0; i < 150; ++i) {
    const Float4 v = random.vector(0.02);
    points.push_back({0.5F + v.x, 0.4F + v.y, 0.3F + v.z, 0});
  }
  std::vector<std::vector<std::size_t>> first;
  for (const int threads : {1, 2, 7}) {
    TaskPool pool(threads);
    const Source sorted(pool, points);
    const Found found = search_self(pool, sorted);
    EXPECT_GT(found.report.long_rows, 0U);
    for (std::size_t i = 0; i < sorted.count; ++i) {
      std::vector<std::size_t> indices = row(found.list, i);
      if (threads == 1) {
        first.push_back(std::move(indices));
      } else {
        ASSERT_EQ(indices, first[i]) << "particle " << i << " with " << threads << " threads";
      }
    }
  }
}

TEST(NeighborSearch, ARowKeepsTheNearestOfTooManyNeighbors) {
  // Distances grow along the crowd, so the nearest of each are known.
  TaskPool pool(2);
  std::vector<Float4> crowd(800, Float4{0.52F, 0.4F, 0.3F, 0});
  for (std::size_t i = 0; i < crowd.size(); ++i) crowd[i].x += 2e-5F * static_cast<float>(i);
  const Source points(pool, crowd);
  const Found found = search_self(pool, points);
  expect_well_formed(found, points.count);
  EXPECT_EQ(found.report.long_rows, 800U);
  EXPECT_EQ(found.report.cut_rows, 800U);
  EXPECT_LE(found.report.slots * kLanes, 800U * kLongestRow);
  for (const std::size_t i : {0U, 399U, 799U}) {
    const std::vector<std::size_t> kept = row(found.list, i);
    ASSERT_EQ(kept.size(), kLongestRow);
    const std::set<std::size_t> unique(kept.begin(), kept.end());
    ASSERT_EQ(unique.size(), kLongestRow);
    ASSERT_TRUE(unique.contains(i));
    ASSERT_TRUE(std::is_sorted(kept.begin(), kept.end()));
    float farthest_kept = 0.0F, nearest_left = 1.0F;
    for (std::size_t j = 0; j < points.count; ++j) {
      const float r = std::abs(points.position[j].x - points.position[i].x);
      if (unique.contains(j)) farthest_kept = std::max(farthest_kept, r);
      if (!unique.contains(j)) nearest_left = std::min(nearest_left, r);
    }
    ASSERT_LE(farthest_kept, nearest_left);
  }
}

TEST(NeighborSearch, AListIsReusedForFewerAndMorePoints) {
  TaskPool pool(2);
  NeighborList list;
  for (const std::size_t count : {500U, 3U, 2000U, 0U, 900U}) {
    const Source points(pool, cloud(count, 14));
    const SearchSource source{&points.grid, points.position.data(), 0};
    Found found;
    found.report = find_neighbors(pool, points.grid, {points.position.data(), count}, {&source, 1},
                                  static_cast<float>(kRadius), static_cast<std::int32_t>(count), list);
    found.list = list;
    expect_matches_brute_force(found, points, points, 0);
    if (HasFatalFailure()) return;
  }
}

TEST(InstructionSet, RefusesUnknownNames) { EXPECT_FALSE(limit_instruction_set("mmx")); }

}  // namespace
}  // namespace pelagos::test
