#include <gtest/gtest.h>

#include "water_scene.hpp"

namespace pelagos::test {
namespace {

/// The hash after settling and after each step. More particles than one block of any loop holds (2048).
std::vector<std::uint64_t> history(int threads, SolveMethod method, int steps) {
  WaterScene water = small_dam_break(threads, {13, 10, 17});
  EXPECT_GT(water.state.particles.count, 2048U);
  water.state.parameters.density.method = water.state.parameters.divergence.method = method;
  settle_fluid(water.pool, water.state, 5);
  std::vector<std::uint64_t> hashes = {state_hash(water.state.particles)};
  for (int n = 0; n < steps; ++n) {
    static_cast<void>(water.step(water.largest_step()));
    hashes.push_back(state_hash(water.state.particles));
  }
  return hashes;
}

void expect_same_bits(SolveMethod method, int steps) {
  const std::vector<std::uint64_t> one = history(1, method, steps);
  for (std::size_t n = 1; n < one.size(); ++n) ASSERT_NE(one[n], one[n - 1]) << "nothing moves in step " << n;
  for (const int threads : {2, 7}) {
    const std::vector<std::uint64_t> other = history(threads, method, steps);
    for (std::size_t n = 0; n < one.size(); ++n)
      ASSERT_EQ(other[n], one[n]) << threads << " threads differ from one, first after step " << n
                                  << " (0: after settling)";
  }
}

TEST(Determinism, SameBitsForOneTwoAndSevenThreads) { expect_same_bits(SolveMethod::kConjugateGradient, 50); }

TEST(Determinism, SameBitsForOneTwoAndSevenThreadsWithJacobi) { expect_same_bits(SolveMethod::kJacobi, 3); }

TEST(Determinism, TheSameRunTwice) {
  EXPECT_EQ(history(2, SolveMethod::kConjugateGradient, 5), history(2, SolveMethod::kConjugateGradient, 5));
}

TEST(StateHash, SeesEveryBitOfPositionAndVelocity) {
  FluidParticles p;
  p.count = 2;
  p.position.assign(padded_count(2), {1, 2, 3, 0});
  p.velocity.assign(padded_count(2), {});
  const std::uint64_t base = state_hash(p);
  p.position[1].z = std::nextafter(3.0F, 4.0F);
  EXPECT_NE(state_hash(p), base);
  p.position[1].z = 3.0F;
  EXPECT_EQ(state_hash(p), base);
  p.velocity[0].x = -0.0F;  // another bit pattern, though an equal number
  EXPECT_NE(state_hash(p), base);
  p.velocity[0].x = 0.0F;
  p.position[2].x = 7;  // padding does not count
  EXPECT_EQ(state_hash(p), base);
}

}  // namespace
}  // namespace pelagos::test
