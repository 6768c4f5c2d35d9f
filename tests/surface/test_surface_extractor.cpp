#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>

#include "../support/brute_force_neighbors.hpp"
#include "surface/surface_extractor.hpp"
#include "waves/splitmix.hpp"

namespace pelagos {
namespace {

constexpr float kSpacing = 0.1f;
const SurfaceScales kScales{.spacing = 0.1, .support_radius = 0.2, .gravity = 9.81};

/// Everything an extractor reads, built by brute force.
struct World {
  FluidParticles fluid;
  BoundaryParticles boundary;
  NeighborList fluid_neighbors, boundary_neighbors;

  explicit World(const std::vector<Float4>& water, const std::vector<Float4>& walls = {})
      : fluid(test::make_fluid(water)), boundary(test::make_boundary(walls)) {
    search();
  }
  void search() {
    fluid_neighbors = test::find_neighbors_brute_force(fluid.position, fluid.count, fluid.position, fluid.count, 0.2f);
    if (boundary.count > 0)
      boundary_neighbors =
          test::find_neighbors_brute_force(fluid.position, fluid.count, boundary.position, boundary.count, 0.2f);
  }
  [[nodiscard]] SurfaceInput input(double time = 0) const {
    return {fluid, boundary, fluid_neighbors, boundary_neighbors, time};
  }
};

struct Result {
  std::vector<SurfaceParticle> particles;
  std::vector<std::uint32_t> indices;
  SurfaceCounts counts;
};

Result extract(SurfaceExtractor& extractor, const World& world, double time = 0, int threads = 1) {
  TaskPool pool(threads);
  Result result;
  extractor.detect(world.input(time), pool);
  extractor.shape(world.input(time), pool, result.particles);
  result.indices.assign(extractor.indices().begin(), extractor.indices().end());
  result.counts = extractor.counts();
  return result;
}

Result extract(const World& world, const SurfaceSettings& settings = {}, int threads = 1) {
  SurfaceExtractor extractor(settings, kScales);
  return extract(extractor, world, 0, threads);
}

/// A block of n x n x layers particles; jitter in spacings.
std::vector<Float4> make_block(int n, int layers, float jitter = 0, std::uint64_t seed = 1) {
  SplitMix64 random(seed);
  std::vector<Float4> position;
  const auto offset = [&] { return jitter * (2.0f * static_cast<float>(random.next_unit()) - 1.0f); };
  for (int k = 1; k <= layers; ++k)
    for (int j = 1; j <= n; ++j)
      for (int i = 1; i <= n; ++i)
        position.push_back({kSpacing * (static_cast<float>(i) + offset()),
                            kSpacing * (static_cast<float>(j) + offset()),
                            kSpacing * (static_cast<float>(k) + offset()), 0});
  return position;
}

/// Floor and walls of the tank that the block fills: a layer of samples at distance one spacing.
std::vector<Float4> make_tank(int n, int height) {
  std::vector<Float4> walls;
  const int end = n + 1;
  for (int k = 0; k <= height; ++k)
    for (int j = 0; j <= end; ++j)
      for (int i = 0; i <= end; ++i)
        if (k == 0 || i == 0 || j == 0 || i == end || j == end)
          walls.push_back({kSpacing * static_cast<float>(i), kSpacing * static_cast<float>(j),
                           kSpacing * static_cast<float>(k), 0});
  return walls;
}

int layer_of(const World& world, std::uint32_t index) {
  return static_cast<int>(std::lround(world.fluid.position[index].z / kSpacing));
}

TEST(SurfaceExtractor, TakesTheTopOfASlabAndNothingAtWallsAndFloor) {
  const World world(make_block(12, 8), make_tank(12, 10));
  SurfaceSettings settings;
  settings.halo = 0;
  const Result bare = extract(world, settings);
  EXPECT_EQ(bare.indices.size(), 140u);  // not the four corner columns, which walls hold on two sides
  for (const std::uint32_t i : bare.indices) EXPECT_EQ(layer_of(world, i), 8);

  settings.halo = 1.2;
  const Result with_halo = extract(world, settings);
  EXPECT_EQ(with_halo.indices.size(), 144u + 140u);
  for (const std::uint32_t i : with_halo.indices) EXPECT_GE(layer_of(world, i), 7);
  EXPECT_EQ(with_halo.counts.surface, 140u);
  EXPECT_EQ(with_halo.counts.halo, 144u);
}

TEST(SurfaceExtractor, TakesNothingAtTheSurfaceOfASolid) {
  // Water over a bed that has a distance field and no samples: half a spacing above it.
  const World world(make_block(8, 6));
  SolidPlanes bed;
  const std::size_t padded = padded_count(world.fluid.count);
  for (std::vector<Float4>& planes : bed.plane) planes.assign(padded, Float4{0, 0, 0, -SolidPlanes::kNone});
  for (std::size_t i = 0; i < world.fluid.count; ++i) bed.plane[1][i] = {0, 0, 1, 0.5f * kSpacing};
  bed.group.assign(padded / kLanes, 2);
  SurfaceInput input = world.input();
  TaskPool pool(2);
  SurfaceExtractor extractor({}, kScales);
  const auto in_the_middle_of_the_bottom = [&] {
    extractor.detect(input, pool);
    std::size_t count = 0;
    for (const std::uint32_t i : extractor.indices()) {
      const Float4& p = world.fluid.position[i];
      if (p.z < 1.5f * kSpacing && p.x > 0.25f && p.x < 0.65f && p.y > 0.25f && p.y < 0.65f) ++count;
    }
    return count;
  };
  EXPECT_EQ(in_the_middle_of_the_bottom(), 16u) << "without the bed it is a surface";
  input.solids = &bed;
  EXPECT_EQ(in_the_middle_of_the_bottom(), 0u);
  EXPECT_GT(extractor.counts().surface, 60u) << "the top is still one";
}

TEST(SurfaceExtractor, DisorderedWaterKeepsItsSurfaceToo) {
  const World world(make_block(12, 8, 0.2f), make_tank(12, 10));
  const Result result = extract(world);
  const std::set<std::uint32_t> taken(result.indices.begin(), result.indices.end());
  std::size_t top = 0, deep = 0;
  for (std::uint32_t i = 0; i < world.fluid.count; ++i) {
    const int layer = static_cast<int>(i / 144) + 1;
    top += layer == 8 && taken.contains(i);
    deep += layer <= 5 && taken.contains(i);
  }
  EXPECT_GE(top, 143u);
  EXPECT_LE(deep, 36u);  // of 720: noise of the mean position rarely passes the threshold
}

TEST(SurfaceExtractor, PublishAllTakesEverything) {
  SurfaceSettings settings;
  settings.publish_all = true;
  const World world(make_block(6, 6), make_tank(6, 7));
  const Result result = extract(world, settings);
  ASSERT_EQ(result.indices.size(), 216u);
  for (std::uint32_t i = 0; i < 216; ++i) EXPECT_EQ(result.indices[i], i);
}

TEST(SurfaceExtractor, DrawnSurfaceLiesHalfASpacingAboveTheParticles) {
  // Height of the highest ellipsoid over points of the slab's middle, against the water's level: the top layer's mean
  // plus half a spacing. In order, and in disorder as a solver leaves it.
  for (const float jitter : {0.0f, 0.15f}) {
    const World world(make_block(16, 6, jitter), make_tank(16, 8));
    const Result result = extract(world);
    SplitMix64 random(4);
    double sum = 0;
    const int rays = 2000;
    int holes = 0;
    for (int n = 0; n < rays; ++n) {
      const Eigen::Vector3d eye(0.4 + 0.9 * random.next_unit(), 0.4 + 0.9 * random.next_unit(), 0);
      double highest = -1e9;
      for (const SurfaceParticle& particle : result.particles) {
        // the quadric |diag(1/s) R^T (x - c)| = 1 along the vertical
        const Eigen::Matrix3d inverse = particle.semi_axes.cast<double>().cwiseInverse().asDiagonal() *
                                        particle.orientation.cast<double>().toRotationMatrix().transpose();
        const Eigen::Vector3d a = inverse.col(2), b = inverse * (eye - particle.position.cast<double>());
        const double root = std::pow(a.dot(b), 2) - a.squaredNorm() * (b.squaredNorm() - 1);
        if (root > 0) highest = std::max(highest, (-a.dot(b) + std::sqrt(root)) / a.squaredNorm());
      }
      holes += highest < 0.55;  // nothing of the top layer is met
      sum += highest;
    }
    EXPECT_EQ(holes, 0) << "jitter " << jitter;  // the ellipsoids close the surface
    const double bias = (sum / rays - 0.65) / static_cast<double>(kSpacing);
    EXPECT_NEAR(bias, 0.0, 0.05) << "jitter " << jitter;  // a tenth of the push; rays leave an error of 0.005
    RecordProperty("bias_" + std::to_string(jitter), std::to_string(bias));
  }
}

TEST(SurfaceExtractor, IsolatedAndCoincidentParticlesAreDrawn) {
  auto water = make_block(6, 4);
  water.push_back({0.35f, 0.35f, 2.0f, 0});                              // a drop in the air
  for (int n = 0; n < 5; ++n) water.push_back({0.35f, 0.35f, 3.0f, 0});  // five at one place
  const World world(water, make_tank(6, 6));
  const Result result = extract(world);
  int drops = 0;
  for (std::size_t n = 0; n < result.indices.size(); ++n) {
    const SurfaceParticle& particle = result.particles[n];
    EXPECT_TRUE(particle.position.allFinite() && particle.semi_axes.allFinite());
    EXPECT_GT(particle.semi_axes.minCoeff(), 0.0f);
    EXPECT_NEAR(particle.orientation.norm(), 1.0f, 1e-5f);
    if (result.indices[n] < 144) {
      EXPECT_EQ(particle.spray, 0) << n;
    } else {
      ++drops;
      EXPECT_NEAR(particle.position.z(), world.fluid.position[result.indices[n]].z, 1e-6f);
    }
    if (result.indices[n] == 144) {
      EXPECT_EQ(particle.spray, 255);
      EXPECT_FLOAT_EQ(particle.semi_axes[0], 0.35f * 0.95f * kSpacing);
    }
  }
  EXPECT_EQ(drops, 6);
}

TEST(SurfaceExtractor, ThinSheetsAndThreadsAreTaken) {
  std::vector<Float4> water;
  for (int i = 0; i < 10; ++i)
    for (int j = 0; j < 10; ++j)
      water.push_back({kSpacing * static_cast<float>(i), kSpacing * static_cast<float>(j), 0, 0});
  for (int i = 0; i < 10; ++i) water.push_back({kSpacing * static_cast<float>(i), 0, 2, 0});
  EXPECT_EQ(extract(World(water)).indices.size(), 110u);
}

TEST(SurfaceExtractor, LeavesOutAndCountsWhatIsNoNumber) {
  World world(make_block(8, 5), make_tank(8, 7));
  world.fluid.position[300].y = std::numeric_limits<float>::quiet_NaN();
  world.fluid.velocity[301].x = std::numeric_limits<float>::infinity();
  const Result result = extract(world);
  EXPECT_EQ(result.counts.not_finite, 2u);
  for (std::size_t n = 0; n < result.indices.size(); ++n) {
    EXPECT_NE(result.indices[n], 300u);
    EXPECT_NE(result.indices[n], 301u);
    EXPECT_TRUE(result.particles[n].position.allFinite() && result.particles[n].velocity.allFinite());
    EXPECT_TRUE(result.particles[n].semi_axes.allFinite());
  }
}

TEST(SurfaceExtractor, SameBitsForAnyNumberOfThreads) {
  World world(make_block(14, 10, 0.25f), make_tank(14, 12));
  SplitMix64 random(6);
  for (Float4& v : world.fluid.velocity) v.x = static_cast<float>(random.next_unit());
  const Result one = extract(world, {}, 1);
  for (const int threads : {2, 7}) {
    const Result many = extract(world, {}, threads);
    ASSERT_EQ(one.indices, many.indices);
    for (std::size_t n = 0; n < one.particles.size(); ++n) {
      const SurfaceParticle &a = one.particles[n], &b = many.particles[n];
      ASSERT_EQ(a.position, b.position);
      ASSERT_EQ(a.semi_axes, b.semi_axes);
      ASSERT_EQ(a.orientation.coeffs(), b.orientation.coeffs());
      ASSERT_EQ(a.foam, b.foam);
    }
  }
}

TEST(SurfaceExtractor, FoamArisesWhereWaterCollidesAndDies) {
  World world(make_block(10, 6), make_tank(10, 8));
  SurfaceExtractor extractor({}, kScales);
  const Result calm = extract(extractor, world, 0.0);
  for (const auto& particle : calm.particles) EXPECT_EQ(particle.foam, 0);

  // Steady motion makes none: what counts is the motion of neighbours towards each other.
  for (Float4& v : world.fluid.velocity) v = {5, 1, 0, 0};
  for (const auto& particle : extract(extractor, world, 0.1).particles) EXPECT_EQ(particle.foam, 0);

  // Two halves run into each other at 2 x 1.5 m/s = 3 sqrt(g d).
  for (std::size_t i = 0; i < world.fluid.count; ++i)
    world.fluid.velocity[i] = {world.fluid.position[i].x < 0.55f ? 1.5f : -1.5f, 0, 0, 0};
  const Result crash = extract(extractor, world, 0.2);
  int white = 0, dark = 0;
  for (std::size_t n = 0; n < crash.indices.size(); ++n) {
    const float x = world.fluid.position[crash.indices[n]].x;
    if (std::abs(x - 0.55f) < 0.06f) white += crash.particles[n].foam > 128;
    if (std::abs(x - 0.55f) > 0.26f) dark += crash.particles[n].foam > 0;
  }
  EXPECT_GT(white, 10);
  EXPECT_EQ(dark, 0);

  // It outlives its cause by 8 sqrt(d/g) = 0.81 s (1/e).
  for (Float4& v : world.fluid.velocity) v = {};
  const Result after = extract(extractor, world, 0.2 + 0.8077);
  for (std::size_t n = 0; n < after.indices.size(); ++n)
    EXPECT_NEAR(after.particles[n].foam, crash.particles[n].foam * std::exp(-1.0), 1.01);  // two roundings to bytes
}

/// Water that flows in has new ids for ever: what is remembered is bounded by what foams, not by the ids.
TEST(SurfaceExtractor, FoamIsKeptForParticlesOfAnyIdAndForgotten) {
  World world(make_block(10, 6), make_tank(10, 8));
  SurfaceExtractor extractor({}, kScales);
  for (std::size_t i = 0; i < world.fluid.count; ++i) {
    world.fluid.id[i] = 4'000'000'000U - static_cast<std::uint32_t>(i);
    world.fluid.velocity[i] = {world.fluid.position[i].x < 0.55f ? 1.5f : -1.5f, 0, 0, 0};
  }
  const Result crash = extract(extractor, world, 0.2);
  EXPECT_GT(extractor.foam().size(), 10U);
  EXPECT_LE(extractor.foam().size(), crash.particles.size());
  for (Float4& v : world.fluid.velocity) v = {};
  const Result after = extract(extractor, world, 0.2 + 0.8077);
  for (std::size_t n = 0; n < after.indices.size(); ++n)
    EXPECT_NEAR(after.particles[n].foam, crash.particles[n].foam * std::exp(-1.0), 1.01);
  for (std::size_t i = 0; i < world.fluid.count; ++i) world.fluid.id[i] = static_cast<std::uint32_t>(i);
  for (const auto& particle : extract(extractor, world, 1.1).particles) EXPECT_EQ(particle.foam, 0) << "others' foam";
  static_cast<void>(extract(extractor, world, 20.0));
  EXPECT_TRUE(extractor.foam().empty());
}

TEST(SurfaceExtractor, CopesWithNoWater) {
  const World world({});
  const Result result = extract(world);
  EXPECT_TRUE(result.indices.empty());
  EXPECT_TRUE(result.particles.empty());
}

TEST(SurfaceExtractor, TakesAllOilWithItsPhase) {
  std::vector<Float4> water;
  for (int k = 0; k < 9; ++k)
    for (int j = 0; j < 9; ++j)
      for (int i = 0; i < 9; ++i)
        water.push_back({0.1f * static_cast<float>(i), 0.1f * static_cast<float>(j), 0.1f * static_cast<float>(k), 0});
  World world(water);
  const std::size_t middle = 4 * 81 + 4 * 9 + 4;
  const Result plain = extract(world);
  ASSERT_FALSE(std::binary_search(plain.indices.begin(), plain.indices.end(), middle)) << "deep inside";
  for (const SurfaceParticle& particle : plain.particles) ASSERT_EQ(particle.phase, kWaterPhase);
  world.fluid.phase.assign(padded_count(world.fluid.count), kWaterPhase);
  world.fluid.phase[middle] = world.fluid.phase[0] = kOilPhase;  // and one at the surface
  const Result result = extract(world);
  ASSERT_EQ(result.particles.size(), plain.particles.size() + 1);
  EXPECT_EQ(result.counts.oil, 1u);
  EXPECT_EQ(result.counts.surface, plain.counts.surface);
  for (std::size_t n = 0; n < result.indices.size(); ++n)
    EXPECT_EQ(result.particles[n].phase, world.fluid.phase[result.indices[n]]);
}

}  // namespace
}  // namespace pelagos
