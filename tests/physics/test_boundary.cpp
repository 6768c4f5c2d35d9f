#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <vector>

#include "pair_scene.hpp"
#include "physics/boundary.hpp"
#include "physics/kernel.hpp"

namespace pelagos::test {
namespace {

TEST(SampleBox, CoversTheSixFacesOnce) {
  const Region box{{-0.5F, 0.25F, 1}, {0.5F, 1, 1.5F}};
  const double spacing = 0.05;
  const std::vector<Float4> samples = sample_box(box, spacing);
  // 20 x 15 x 10 intervals: all lattice points less the inner ones.
  EXPECT_EQ(samples.size(), 21U * 16U * 11U - 19U * 14U * 9U);
  std::set<std::array<float, 3>> seen;
  for (const Float4& p : samples) {
    EXPECT_TRUE(seen.insert({p.x, p.y, p.z}).second) << "twice at " << p.x << ' ' << p.y << ' ' << p.z;
    const bool on_face = p.x == box.min[0] || p.x == box.max[0] || p.y == box.min[1] || p.y == box.max[1] ||
                         p.z == box.min[2] || p.z == box.max[2];
    EXPECT_TRUE(on_face);
    EXPECT_TRUE(p.x >= box.min[0] && p.x <= box.max[0] && p.y >= box.min[1] && p.y <= box.max[1] && p.z >= box.min[2] &&
                p.z <= box.max[2]);
  }
}

TEST(SampleBox, SpacingThatDoesNotDivideTheBoxIsRoundedToIntervals) {
  const std::vector<Float4> samples = sample_box({{0, 0, 0}, {1, 1, 1}}, 0.3);  // 3 intervals of 1/3
  EXPECT_EQ(samples.size(), 64U - 8U);
}

TEST(SampleBox, ABoxThinnerThanTheSpacingHasItsCorners) {
  EXPECT_EQ(sample_box({{0, 0, 0}, {0.01F, 0.01F, 0.01F}}, 0.05).size(), 8U);
  EXPECT_EQ(sample_box({{0, 0, 0}, {0.1F, 0.1F, 0.1F}}, 0.05).size(), 27U - 1U);
}

TEST(BoundaryVolumes, OfAPlaneAreOneOverTheKernelSum) {
  TaskPool pool(2);
  const double d = 0.05, radius = 2.0 * d;
  std::vector<Float4> plane = lattice({11, 11, 1}, d, {3, -2, 1});
  assign_boundary_volumes(pool, radius, plane);
  const ReferenceSpline reference{radius};
  for (const Float4& sample : plane) {
    double sum = 0.0;
    for (const Float4& other : plane) {
      const Double3 x = minus(as_double(sample), as_double(other));
      sum += reference.value(std::sqrt(dot(x, x)));
    }
    // Coordinates of size 3 hold 2e-7 m, 2e-6 of the radius, in single precision.
    EXPECT_NEAR(static_cast<double>(sample.w) * sum, 1.0, 2e-5);
  }
  // The same closed form inside the plane: itself, 4 at d, 4 at sqrt(2) d.
  const double inner = reference.value(0) + 4.0 * reference.value(d) + 4.0 * reference.value(std::sqrt(2.0) * d);
  EXPECT_NEAR(static_cast<double>(plane[60].w) * inner, 1.0, 2e-5);
  EXPECT_GT(plane[0].w, plane[60].w);  // a corner stands for more: fewer samples share its space
}

TEST(BoundaryVolumes, OfNoneOneAndTwoSamples) {
  TaskPool pool(2);
  std::vector<Float4> none;
  assign_boundary_volumes(pool, 0.1, none);
  std::vector<Float4> one = {{1, 2, 3, 0}};
  assign_boundary_volumes(pool, 0.1, one);
  const double alone = 1.0 / ReferenceSpline{0.1}.value(0.0);
  EXPECT_NEAR(static_cast<double>(one[0].w), alone, 1e-6 * alone);
  std::vector<Float4> same = {{1, 2, 3, 0}, {1, 2, 3, 0}};
  assign_boundary_volumes(pool, 0.1, same);
  for (const Float4& sample : same) EXPECT_NEAR(static_cast<double>(sample.w), 0.5 * alone, 1e-6 * alone);
}

/// What samples make of the kernel, times their volumes, above the middle of a layer at z = 0.
double felt_above(std::span<const Float4> samples, double height, double radius) {
  const ReferenceSpline reference{radius};
  double sum = 0.0;
  for (const Float4& sample : samples) {
    const Double3 x = minus(as_double(sample), Double3{0.0, 0.0, height});
    sum += static_cast<double>(sample.w) * reference.value(std::sqrt(dot(x, x)));
  }
  return sum;
}

TEST(BoundaryVolumes, OfAPlateOfTwoLayersAreFeltAsOneLayerIs) {
  TaskPool pool(2);
  const double d = 0.05, radius = 2.0 * d;
  std::vector<Float4> single = lattice({11, 11, 1}, d, {-5 * d, -5 * d, 0});
  assign_boundary_volumes(pool, radius, single);
  const double right = felt_above(single, d, radius);
  for (const double apart : {0.0, 0.1, 0.4, 0.8, 1.5}) {
    std::vector<Float4> plate = lattice({11, 11, 1}, d, {-5 * d, -5 * d, 0});
    std::vector<Eigen::Vector3f> inward(plate.size(), -Eigen::Vector3f::UnitZ());
    const std::vector<Float4> far = lattice({11, 11, 1}, d, {-5 * d, -5 * d, -apart * d});
    plate.insert(plate.end(), far.begin(), far.end());
    inward.resize(plate.size(), Eigen::Vector3f::UnitZ());
    assign_boundary_volumes(pool, radius, inward, d, plate);
    EXPECT_NEAR(felt_above(plate, d, radius) / right, 1.0, 0.05) << apart;
  }
}

constexpr double kPatchSpacing = 0.05, kPatchSupport = 0.1;
const Region kPatch{{0, 0, 0}, {0.5F, 0.4F, 0.3F}};
constexpr Edge kWall = Edge::kWall, kMirror = Edge::kMirror, kPeriodic = Edge::kPeriodic;

TEST(SamplePatchWalls, WithWallsAllAroundIsTheSampledBox) {
  TaskPool pool(2);
  std::vector<Float4> box = sample_box(kPatch, kPatchSpacing);
  assign_boundary_volumes(pool, kPatchSupport, box);
  const std::vector<Float4> samples =
      sample_patch_walls(pool, kPatch, {kWall, kWall, kWall}, kPatchSpacing, kPatchSupport);
  ASSERT_EQ(samples.size(), box.size());
  for (std::size_t k = 0; k < box.size(); ++k) {
    const Double3 off = minus(as_double(samples[k]), as_double(box[k]));
    ASSERT_EQ(dot(off, off), 0.0) << k;
    ASSERT_EQ(samples[k].w, box[k].w) << k;
  }
}

TEST(SamplePatchWalls, WithoutWallsIsEmpty) {
  TaskPool pool(2);
  EXPECT_TRUE(sample_patch_walls(pool, kPatch, {kMirror, kPeriodic, kMirror}, kPatchSpacing, kPatchSupport).empty());
}

TEST(SamplePatchWalls, AFloorGoesOnBeyondMirroredAndPeriodicFaces) {
  TaskPool pool(2);
  const std::vector<Float4> samples =
      sample_patch_walls(pool, kPatch, {kMirror, kPeriodic, kWall}, kPatchSpacing, kPatchSupport);
  // Floor and lid, two intervals (one support radius) beyond each side: (10 + 1 + 4) x (8 + 1 + 4) samples each.
  EXPECT_EQ(samples.size(), 2U * 15U * 13U);
  for (const Float4& p : samples) {
    EXPECT_TRUE(p.z == kPatch.min[2] || p.z == kPatch.max[2]);
    EXPECT_GE(p.x, -0.101F);
    EXPECT_LE(p.x, 0.601F);
    // All have the same surroundings: the volume of an endless plane's sample.
    ASSERT_NEAR(static_cast<double>(p.w / samples[0].w), 1.0, 2e-5);  // single precision coordinates
  }
}

TEST(SamplePatchWalls, AChannelIsTheSameAllAlong) {
  TaskPool pool(2);
  // Periodic along x: floor, lid and two side walls; volumes depend on y and z only.
  const std::vector<Float4> samples =
      sample_patch_walls(pool, kPatch, {kPeriodic, kWall, kWall}, kPatchSpacing, kPatchSupport);
  std::map<std::array<int, 2>, std::vector<float>> rows;
  for (const Float4& p : samples)
    rows[{static_cast<int>(std::lround(p.y / 0.05F)), static_cast<int>(std::lround(p.z / 0.05F))}].push_back(p.w);
  EXPECT_EQ(rows.size(), 2U * (9U + 7U) - 4U);  // the rim of 9 x 7 rows
  for (const auto& [row, volumes] : rows) {
    ASSERT_EQ(volumes.size(), 15U);
    for (const float v : volumes) ASSERT_NEAR(static_cast<double>(v / volumes[0]), 1.0, 2e-5);
  }
  // A period on, the samples repeat: what a particle sees at one face, its image sees at the other.
  for (const Float4& p : samples) {
    if (p.x > 0.101F) continue;
    const bool repeated = std::any_of(samples.begin(), samples.end(), [&](const Float4& q) {
      return std::abs(q.x - p.x - 0.5F) < 1e-6F && q.y == p.y && q.z == p.z;
    });
    ASSERT_TRUE(repeated) << p.x << ' ' << p.y << ' ' << p.z;
  }
}

TEST(BlockParticles, CountsOfThePaper) {
  // Dam break column of L = 1: 1.6 x 1.5 x 2.0 at a spacing of 0.05 holds 31 x 29 x 39 particles.
  EXPECT_EQ(block_particles({1.6, 1.5, 2.0}, 0.05), (std::array<std::size_t, 3>{31, 29, 39}));
  EXPECT_EQ(block_particles({0.05, 0.01, 1.0}, 0.05), (std::array<std::size_t, 3>{0, 0, 19}));
}

}  // namespace
}  // namespace pelagos::test
