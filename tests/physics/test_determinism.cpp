#include <gtest/gtest.h>

#include "water_scene.hpp"

namespace pelagos::test {
namespace {

constexpr Edge kWall = Edge::kWall, kMirror = Edge::kMirror, kPeriodic = Edge::kPeriodic;

struct Case {
  const char* name;
  Scheme scheme;
  SolveMethod method;
  std::array<Edge, 3> edges;
  int steps;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

/// The hash after settling and after each step. More particles than one block of any loop holds (2048).
std::vector<std::uint64_t> history(int threads, const Case& c) {
  const double d = 0.05;
  const std::array<int, 3> n{13, 10, 17};
  FluidParameters parameters = patch_parameters({3.0 * (n[0] + 1) * d, (n[1] + 1) * d, 2.0 * (n[2] + 1) * d}, d);
  parameters.scheme = c.scheme;
  parameters.edges = c.edges;
  parameters.density.method = parameters.divergence.method = c.method;
  WaterScene water(threads, parameters, lattice(n, d, {d, d, d}));
  EXPECT_GT(water.state.particles.count, 2048U);
  settle_fluid(water.pool, water.state, 5);
  std::vector<std::uint64_t> hashes = {state_hash(water.state.particles)};
  for (int step = 0; step < c.steps; ++step) {
    static_cast<void>(water.step(water.largest_step()));
    hashes.push_back(state_hash(water.state.particles));
  }
  return hashes;
}

class Determinism : public testing::TestWithParam<Case> {};

constexpr SolveMethod kGradients = SolveMethod::kConjugateGradient, kJacobi = SolveMethod::kJacobi,
                      kPaper = SolveMethod::kPaper;
constexpr std::array<Edge, 3> kWalls{kWall, kWall, kWall}, kPeriodicX{kPeriodic, kWall, kWall},
    kMirrorX{kMirror, kWall, kWall}, kMixed{kPeriodic, kMirror, kWall};

INSTANTIATE_TEST_SUITE_P(
    Schemes, Determinism,
    testing::Values(Case{"Hybrid", Scheme::kHybrid, kGradients, kWalls, 40},
                    Case{"Dfsph", Scheme::kDfsph, kGradients, kWalls, 20},
                    Case{"Pbf", Scheme::kPbf, kGradients, kWalls, 20},
                    Case{"Corrected", Scheme::kCorrected, kGradients, kWalls, 20},
                    Case{"HybridJacobi", Scheme::kHybrid, kJacobi, kWalls, 3},
                    Case{"CorrectedJacobi", Scheme::kCorrected, kJacobi, kWalls, 3},
                    Case{"HybridPaper", Scheme::kHybrid, kPaper, kWalls, 3},
                    Case{"DfsphPaper", Scheme::kDfsph, kPaper, kWalls, 3},
                    Case{"PbfPaper", Scheme::kPbf, kPaper, kWalls, 3},
                    Case{"HybridPeriodic", Scheme::kHybrid, kGradients, kPeriodicX, 15},
                    Case{"HybridMirrored", Scheme::kHybrid, kGradients, kMirrorX, 15},
                    Case{"DfsphMixed", Scheme::kDfsph, kGradients, kMixed, 15},
                    Case{"PbfMixed", Scheme::kPbf, kGradients, kMixed, 15},
                    Case{"CorrectedPeriodic", Scheme::kCorrected, kGradients, kPeriodicX, 15},
                    Case{"CorrectedMixed", Scheme::kCorrected, kGradients, kMixed, 15},
                    Case{"CorrectedMirrors", Scheme::kCorrected, kGradients, {kMirror, kMirror, kMirror}, 15}),
    [](const testing::TestParamInfo<Case>& c) { return c.param.name; });

TEST_P(Determinism, SameBitsForOneTwoAndSevenThreads) {
  const std::vector<std::uint64_t> one = history(1, GetParam());
  for (std::size_t n = 1; n < one.size(); ++n) ASSERT_NE(one[n], one[n - 1]) << "nothing moves in step " << n;
  for (const int threads : {2, 7}) {
    const std::vector<std::uint64_t> other = history(threads, GetParam());
    for (std::size_t n = 0; n < one.size(); ++n)
      ASSERT_EQ(other[n], one[n]) << threads << " threads differ from one, first after step " << n
                                  << " (0: after settling)";
  }
}

TEST(DeterminismAlone, TheSameRunTwice) {
  const Case c{"", Scheme::kCorrected, kGradients, kMixed, 5};
  EXPECT_EQ(history(2, c), history(2, c));
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
