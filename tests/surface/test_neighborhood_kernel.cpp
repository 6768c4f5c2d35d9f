#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "../support/brute_force_neighbors.hpp"
#include "neighborhood_kernel.hpp"
#include "waves/splitmix.hpp"

namespace pelagos {
namespace {

FluidParticles random_fluid(std::size_t count) {
  SplitMix64 random(8);
  const auto next = [&] { return static_cast<float>(random.next_unit()); };
  std::vector<Float4> position;
  for (std::size_t i = 0; i < count; ++i) position.push_back({next(), next(), next(), 0});
  return test::make_fluid(position);
}

TEST(NeighborhoodKernel, AgreesWithAPlainSum) {
  const float radius = 0.25f;
  const FluidParticles fluid = random_fluid(500);
  // lists built with a larger radius, as if the particles had moved since
  const auto list = test::find_neighbors_brute_force(fluid.position, 500, fluid.position, 500, 0.3f);
  for (std::size_t group = 0; group < list.groups.size(); ++group) {
    GroupSums sums{};
    select_group_kernel()(&fluid.position[group * kLanes], fluid.position.data(), list.slots.data(), list.groups[group],
                          radius, sums);
    for (std::size_t lane = 0; lane < kLanes && group * kLanes + lane < 500; ++lane) {
      double weight = 0, x = 0;
      const Float4& p = fluid.position[group * kLanes + lane];
      for (std::size_t j = 0; j < 500; ++j) {
        const Float4& q = fluid.position[j];
        const double r = std::hypot(q.x - p.x, q.y - p.y, q.z - p.z);
        if (r >= static_cast<double>(radius)) continue;
        const double w = 1 - std::pow(r / static_cast<double>(radius), 3);
        weight += w;
        x += w * static_cast<double>(q.x - p.x);
      }
      // sums of about 40 terms below 1 in single precision
      EXPECT_NEAR(static_cast<double>(sums.weight[lane]), weight, 2e-5);
      EXPECT_NEAR(static_cast<double>(sums.x[lane]), x, 1e-5);
    }
  }
}

TEST(NeighborhoodKernel, AllInstructionSetsGiveTheSameBits) {
  FluidParticles fluid = random_fluid(400);
  fluid.position[17].x = std::numeric_limits<float>::quiet_NaN();
  const auto list = test::find_neighbors_brute_force(fluid.position, 400, fluid.position, 400, 0.3f);
  int compared = 0;
  for (const char* name : {"avx2", "avx512"}) {
    const GroupKernel kernel = group_kernel(name);
    if (kernel == nullptr) continue;
    for (std::size_t group = 0; group < list.groups.size(); ++group) {
      GroupSums wide{}, plain{};
      const Float4* query = &fluid.position[group * kLanes];
      kernel(query, fluid.position.data(), list.slots.data(), list.groups[group], 0.25f, wide);
      group_kernel("baseline")(query, fluid.position.data(), list.slots.data(), list.groups[group], 0.25f, plain);
      ASSERT_EQ(std::memcmp(&wide, &plain, sizeof wide), 0) << name << " group " << group;
      ++compared;
    }
  }
  if (compared == 0) GTEST_SKIP() << "only the baseline on this machine";
}

TEST(NeighborhoodKernel, NeighborsThatAreNoNumbersAddNothing) {
  FluidParticles fluid = test::make_fluid({{0, 0, 0, 0}, {0.1f, 0, 0, 0}});
  const auto list = test::find_neighbors_brute_force(fluid.position, 2, fluid.position, 2, 0.3f);
  fluid.position[1].y = std::numeric_limits<float>::quiet_NaN();
  GroupSums sums{};
  select_group_kernel()(fluid.position.data(), fluid.position.data(), list.slots.data(), list.groups[0], 0.3f, sums);
  EXPECT_EQ(sums.weight[0], 1.0f);
  EXPECT_EQ(sums.x[0], 0.0f);
  EXPECT_EQ(sums.weight[1], 0.0f);
}

}  // namespace
}  // namespace pelagos
