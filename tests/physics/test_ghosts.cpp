#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "patch_scene.hpp"

namespace pelagos::test {
namespace {

constexpr double kReach = 0.1;
const Region kPatch{{-0.2F, 0.1F, 0}, {0.3F, 0.5F, 0.35F}};
constexpr Edge kWall = Edge::kWall, kMirror = Edge::kMirror, kPeriodic = Edge::kPeriodic;

std::vector<Float4> cloud(std::size_t count, std::uint32_t seed) {
  Random random(seed);
  std::vector<Float4> points(count);
  for (Float4& p : points) {
    p.x = static_cast<float>(random.uniform(-0.2, 0.3));
    p.y = static_cast<float>(random.uniform(0.1, 0.5));
    p.z = static_cast<float>(random.uniform(0.0, 0.35));
  }
  return points;
}

/// Coordinates that a point has beyond the faces across one axis, itself first, within two periods: more than needed.
std::vector<double> repeats(Edge edge, double low, double high, double x) {
  std::vector<double> all = {x};
  if (edge == kWall) return all;
  const double period = high - low;
  for (int k = -2; k <= 2; ++k) {
    if (edge == kPeriodic && k != 0) all.push_back(x + k * period);
    if (edge == kMirror) {
      all.push_back(2.0 * low - x + 2.0 * k * period);
      if (k != 0) all.push_back(x + 2.0 * k * period);
    }
  }
  return all;
}

double distance_to_patch(const Double3& p) {
  double squared = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double off = std::max(
        {static_cast<double>(kPatch.min[axis]) - p[axis], p[axis] - static_cast<double>(kPatch.max[axis]), 0.0});
    squared += off * off;
  }
  return std::sqrt(squared);
}

/// All images of a particle, from first principles.
std::vector<Double3> all_images(const std::array<Edge, 3>& edges, const Float4& point) {
  const Double3 p = as_double(point);
  std::array<std::vector<double>, 3> axes;
  for (std::size_t a = 0; a < 3; ++a)
    axes[a] = repeats(edges[a], static_cast<double>(kPatch.min[a]), static_cast<double>(kPatch.max[a]), p[a]);
  std::vector<Double3> images;
  for (std::size_t i = 0; i < axes[0].size(); ++i)
    for (std::size_t j = 0; j < axes[1].size(); ++j)
      for (std::size_t k = 0; k < axes[2].size(); ++k)
        if (i + j + k > 0) images.push_back({axes[0][i], axes[1][j], axes[2][k]});
  return images;
}

struct Case {
  const char* name;
  std::array<Edge, 3> edges;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }
class GhostImages : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Edges, GhostImages,
                         testing::Values(Case{"MirrorX", {kMirror, kWall, kWall}},
                                         Case{"PeriodicY", {kWall, kPeriodic, kWall}},
                                         Case{"MirrorZ", {kWall, kWall, kMirror}},
                                         Case{"MirrorXPeriodicY", {kMirror, kPeriodic, kWall}},
                                         Case{"AllMirrors", {kMirror, kMirror, kMirror}},
                                         Case{"AllPeriodic", {kPeriodic, kPeriodic, kPeriodic}},
                                         Case{"PeriodicXYMirrorZ", {kPeriodic, kPeriodic, kMirror}}),
                         [](const testing::TestParamInfo<Case>& c) { return c.param.name; });

TEST_P(GhostImages, EveryImageWithinReachIsThereOnce) {
  TaskPool pool(2);
  std::vector<Float4> position = cloud(300, 21);
  position.push_back({-0.2F, 0.1F, 0, 0});  // a corner of the patch
  position.push_back({0.3F, 0.5F, 0.35F, 0});
  const std::size_t count = position.size();
  position.resize(padded_count(count));
  Ghosts ghosts;
  ghosts.grid = CellGrid(widened(kPatch, kReach), kReach);
  make_ghosts(pool, kPatch, GetParam().edges, static_cast<float>(kReach), count, position, ghosts);
  ASSERT_GT(ghosts.count, 0U);
  ASSERT_EQ(ghosts.begin, padded_count(count));
  ASSERT_GE(position.size(), extended_count(count, ghosts));
  std::vector<std::vector<Double3>> made(count);
  for (std::size_t k = 0; k < ghosts.count; ++k) {
    ASSERT_LT(ghosts.source[k], count);
    made[ghosts.source[k]].push_back(as_double(position[ghosts.begin + k]));
  }
  std::size_t wanted_images = 0;
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<int> times(made[i].size(), 0);
    for (const Double3& want : all_images(GetParam().edges, position[i])) {
      int found = 0;
      for (std::size_t k = 0; k < made[i].size(); ++k) {
        const Double3 off = minus(made[i][k], want);
        // Coordinates of half a metre hold 3e-8 m; twice that after one sum.
        if (std::sqrt(dot(off, off)) < 1e-6) {
          ++found;
          ++times[k];
        }
      }
      // At the cut-off either is right. A corner's image may be there though it is farther than the reach.
      if (distance_to_patch(want) < kReach * (1.0 - 1e-5)) {
        ++wanted_images;
        // A particle on a mirror is its own image: several of its repeats are in one place.
        ASSERT_GE(found, 1) << "particle " << i << " lacks the image at " << want[0] << ' ' << want[1] << ' '
                            << want[2];
      }
    }
    for (const int t : times) ASSERT_GE(t, 1) << "particle " << i << " has an image that it should not have";
    std::set<std::array<double, 3>> places(made[i].begin(), made[i].end());
    if (i < 300) {
      ASSERT_EQ(places.size(), made[i].size()) << "an image twice, of particle " << i;
    }
  }
  EXPECT_GT(wanted_images, 100U);
}

TEST_P(GhostImages, OfVelocitiesAndScalarsBelongToTheirPositions) {
  TaskPool pool(2);
  std::vector<Float4> position = cloud(300, 22);
  const std::size_t count = position.size();
  position.resize(padded_count(count));
  Ghosts ghosts;
  ghosts.grid = CellGrid(widened(kPatch, kReach), kReach);
  make_ghosts(pool, kPatch, GetParam().edges, static_cast<float>(kReach), count, position, ghosts);
  // A small motion of the originals moves the images as their velocities say.
  std::vector<Float4> velocity = random_vectors(count, 1.0, 23);
  velocity.resize(extended_count(count, ghosts));
  extend_vectors(pool, ghosts, velocity);
  const float dt = 0.0078125F;
  std::vector<Float4> moved = position;
  for (std::size_t i = 0; i < count; ++i) {
    moved[i].x += dt * velocity[i].x;
    moved[i].y += dt * velocity[i].y;
    moved[i].z += dt * velocity[i].z;
  }
  extend_positions(pool, ghosts, moved);
  std::vector<float> scalar(extended_count(count, ghosts));
  for (std::size_t i = 0; i < count; ++i) scalar[i] = static_cast<float>(i);
  extend_scalars(pool, ghosts, scalar);
  for (std::size_t k = 0; k < ghosts.count; ++k) {
    const std::size_t at = ghosts.begin + k;
    const Double3 step = minus(as_double(moved[at]), as_double(position[at])), v = as_double(velocity[at]);
    // Three roundings of coordinates up to one metre.
    for (std::size_t c = 0; c < 3; ++c) ASSERT_NEAR(step[c], static_cast<double>(dt) * v[c], 2e-7);
    ASSERT_EQ(scalar[at], static_cast<float>(ghosts.source[k]));
  }
}

TEST(Ghosts, AreTheSameForAnyNumberOfThreads) {
  const std::array<Edge, 3> edges{kPeriodic, kMirror, kPeriodic};
  std::vector<std::vector<std::uint32_t>> sources;
  for (const int threads : {1, 2, 7}) {
    TaskPool pool(threads);
    std::vector<Float4> position = cloud(5000, 24);  // several blocks of work
    position.resize(padded_count(5000));
    Ghosts ghosts;
    ghosts.grid = CellGrid(widened(kPatch, kReach), kReach);
    make_ghosts(pool, kPatch, edges, static_cast<float>(kReach), 5000, position, ghosts);
    sources.push_back(ghosts.source);
  }
  EXPECT_EQ(sources[0], sources[1]);
  EXPECT_EQ(sources[0], sources[2]);
}

TEST(Ghosts, OfNoParticlesAndOfNoneNearAFace) {
  TaskPool pool(2);
  for (const std::size_t count : {0U, 1U}) {
    std::vector<Float4> position(count, Float4{0.05F, 0.3F, 0.17F, 0});  // farther than the reach from all faces
    position.resize(padded_count(count));
    Ghosts ghosts;
    ghosts.grid = CellGrid(widened(kPatch, kReach), kReach);
    make_ghosts(pool, kPatch, {kPeriodic, kMirror, kPeriodic}, static_cast<float>(kReach), count, position, ghosts);
    EXPECT_TRUE(ghosts.empty());
    EXPECT_EQ(extended_count(count, ghosts), padded_count(count));
  }
}

TEST(Ghosts, PositionsThatAreNotFiniteDoNoHarm) {
  TaskPool pool(2);
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  std::vector<Float4> position = {{nan, 0.11F, 0.01F, 0},    {-0.19F, infinity, 0.01F, 0}, {nan, nan, nan, 0},
                                  {-infinity, 0.2F, nan, 0}, {1e30F, -1e30F, 0, 0},        {-0.19F, 0.2F, 0.1F, 0}};
  const std::size_t count = position.size();
  position.resize(padded_count(count));
  std::vector<Float4> velocity(position.size());
  const std::array<Edge, 3> edges{kPeriodic, kMirror, kPeriodic};
  wrap_particles(pool, kPatch, edges, count, position, velocity);
  EXPECT_EQ(position[5].x, -0.19F);  // the sound one is left alone
  Ghosts ghosts;
  ghosts.grid = CellGrid(widened(kPatch, kReach), kReach);
  make_ghosts(pool, kPatch, edges, static_cast<float>(kReach), count, position, ghosts);
  std::size_t of_the_sound_one = 0;
  for (std::size_t k = 0; k < ghosts.count; ++k) of_the_sound_one += ghosts.source[k] == 5 ? 1 : 0;
  EXPECT_EQ(of_the_sound_one, 1U);  // near the lower face across x only
}

TEST(WrapParticles, BringsBackWhatHasCrossedAFace) {
  TaskPool pool(2);
  const std::array<Edge, 3> edges{kPeriodic, kMirror, kWall};
  struct Crossing {
    Float4 position, velocity, wrapped, turned;
  };
  const Crossing crossings[] = {
      {{-0.21F, 0.2F, 0.1F, 0}, {-1, 2, 3, 0}, {0.29F, 0.2F, 0.1F, 0}, {-1, 2, 3, 0}},   // out through low x
      {{0.32F, 0.2F, 0.1F, 0}, {1, 2, 3, 0}, {-0.18F, 0.2F, 0.1F, 0}, {1, 2, 3, 0}},     // out through high x
      {{0.1F, 0.07F, 0.1F, 0}, {1, -2, 3, 0}, {0.1F, 0.13F, 0.1F, 0}, {1, 2, 3, 0}},     // reflected at low y
      {{0.1F, 0.51F, 0.1F, 0}, {1, 2, 3, 0}, {0.1F, 0.49F, 0.1F, 0}, {1, -2, 3, 0}},     // reflected at high y
      {{0.35F, 0.51F, 0.1F, 0}, {1, 2, 3, 0}, {-0.15F, 0.49F, 0.1F, 0}, {1, -2, 3, 0}},  // both
      {{0.1F, 0.2F, -0.1F, 0}, {1, 2, -3, 0}, {0.1F, 0.2F, -0.1F, 0}, {1, 2, -3, 0}},    // a wall does not wrap
      {{0.1F, 0.5F, 0.1F, 0}, {1, 2, 3, 0}, {0.1F, 0.5F, 0.1F, 0}, {1, 2, 3, 0}},        // on the mirror itself
      {{0.3F, 0.2F, 0.1F, 0}, {1, 2, 3, 0}, {-0.2F, 0.2F, 0.1F, 0}, {1, 2, 3, 0}},       // on the upper periodic face
  };
  for (const Crossing& c : crossings) {
    std::vector<Float4> position = {c.position}, velocity = {c.velocity};
    wrap_particles(pool, kPatch, edges, 1, position, velocity);
    const Double3 off = minus(as_double(position[0]), as_double(c.wrapped)),
                  turn = minus(as_double(velocity[0]), as_double(c.turned));
    EXPECT_LT(std::sqrt(dot(off, off)), 2e-7) << c.position.x << ' ' << c.position.y;  // coordinates of half a metre
    EXPECT_EQ(dot(turn, turn), 0.0) << c.position.x << ' ' << c.position.y;
  }
}

}  // namespace
}  // namespace pelagos::test
