#include <gtest/gtest.h>

#include <array>
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
    add_slots(&fluid.position[group * kLanes], fluid.position.data(), list.slots.data(), list.groups[group], radius,
              sums);
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

TEST(NeighborhoodKernel, ALaneDoesNotDependOnItsGroup) {
  FluidParticles fluid = random_fluid(64);
  const auto list = test::find_neighbors_brute_force(fluid.position, 64, fluid.position, 64, 0.5f);
  // the same particle, alone in another lane of another group
  const std::vector<Float4> alone(kLanes, fluid.position[21]);
  std::vector<std::int32_t> slots;
  for_each_neighbor(list, 21, [&](std::size_t j) { slots.insert(slots.end(), kLanes, static_cast<std::int32_t>(j)); });
  GroupSums group{}, lone{};
  add_slots(&fluid.position[16], fluid.position.data(), list.slots.data(), list.groups[1], 0.5f, group);
  add_slots(alone.data(), fluid.position.data(), slots.data(), {0, list.pair_count[21]}, 0.5f, lone);
  EXPECT_EQ(group.weight[5], lone.weight[10]);
  EXPECT_EQ(group.x[5], lone.x[10]);
  EXPECT_EQ(group.z[5], lone.z[10]);
}

TEST(NeighborhoodKernel, NeighborsThatAreNoNumbersAddNothing) {
  FluidParticles fluid = test::make_fluid({{0, 0, 0, 0}, {0.1f, 0, 0, 0}});
  const auto list = test::find_neighbors_brute_force(fluid.position, 2, fluid.position, 2, 0.3f);
  fluid.position[1].y = std::numeric_limits<float>::quiet_NaN();
  GroupSums sums{};
  add_slots(fluid.position.data(), fluid.position.data(), list.slots.data(), list.groups[0], 0.3f, sums);
  EXPECT_EQ(sums.weight[0], 1.0f);
  EXPECT_EQ(sums.x[0], 0.0f);
  EXPECT_EQ(sums.weight[1], 0.0f);
}

/// Of the bits of all members, which are floats.
template <class Sums>
std::uint64_t hash_of(const Sums& sums, std::uint64_t hash) {
  std::array<std::uint32_t, sizeof(Sums) / sizeof(std::uint32_t)> words;
  std::memcpy(words.data(), &sums, sizeof sums);
  for (const std::uint32_t word : words) hash = (hash ^ word) * 1099511628211ULL;
  return hash;
}

TEST(NeighborhoodKernel, HasTheSameBitsOnEveryInstructionSet) {
  FluidParticles fluid = random_fluid(500);
  for (std::size_t i = 0; i < 500; ++i) fluid.velocity[i] = fluid.position[(7 * i + 3) % 500];
  const auto list = test::find_neighbors_brute_force(fluid.position, 500, fluid.position, 500, 0.3f);
  std::uint64_t slots = 14695981039346656037ULL, neighbors = slots;
  for (std::size_t group = 0; group < list.groups.size(); ++group) {
    GroupSums sums{};
    add_slots(&fluid.position[group * kLanes], fluid.position.data(), list.slots.data(), list.groups[group], 0.25f,
              sums);
    slots = hash_of(sums, slots);
  }
  for (std::size_t i = 0; i < 500; ++i) {
    ParticleSums sums;
    add_neighbors(fluid.position[i], fluid.velocity[i], fluid.position.data(), fluid.velocity.data(), list, i, 0.25f,
                  sums);
    neighbors = hash_of(sums, neighbors);
  }
  // Every operation is rounded as IEEE 754 says and the order is fixed: these are the bits of any machine.
  EXPECT_EQ(slots, 12425259530136122922U);
  EXPECT_EQ(neighbors, 2931859683276169404U);
}

}  // namespace
}  // namespace pelagos
