#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "../support/places.hpp"
#include "physics/boundary.hpp"
#include "rigid/body_shape.hpp"
#include "rigid/sample_inset.hpp"
#include "shapes/primitive.hpp"
#include "test_meshes.hpp"
#include "waves/splitmix.hpp"

namespace pelagos {
namespace {

using test::joined;
using test::make_box;
using test::make_sphere;

/// Between samples of one side.
double least_distance(const BodyShape& shape) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < shape.samples.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (!are_opposed(shape.inward[i], shape.inward[j]))
        least = std::min(least, static_cast<double>((shape.samples[i] - shape.samples[j]).norm()));
  return least;
}

double distance_to_samples(const BodyShape& shape, const Eigen::Vector3d& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& sample : shape.samples) least = std::min(least, (sample.cast<double>() - point).norm());
  return least;
}

TEST(BodyShape, SphereIsSampledEvenlyOnTheInsetSphere) {
  const double d = 0.2, radius = 1.5, inset = 0.6;
  const BodyShape shape = make_body_shape(make_sphere(radius, 36), d, inset);
  ASSERT_TRUE(shape.faults.empty()) << shape.faults.front();
  EXPECT_NEAR(shape.solid.volume, 4.0 / 3 * std::numbers::pi * std::pow(radius, 3), 0.01 * shape.solid.volume);
  for (const auto& sample : shape.samples)
    EXPECT_NEAR(sample.norm(), radius - inset * d, 0.008);  // facets: r (1 - cos(pi/36)) = 0.006, and 2 % of the inset
  EXPECT_GE(least_distance(shape), 0.8 * d - 1e-6);
  const double area = 4 * std::numbers::pi * std::pow(radius - inset * d, 2);
  // about one sample per d^2: the selection leaves between 0.9 and 1.15 on large smooth surfaces
  EXPECT_NEAR(static_cast<double>(shape.samples.size()) * d * d / area, 1.0, 0.12);
  SplitMix64 random(1);
  for (int n = 0; n < 500; ++n) {
    Eigen::Vector3d direction(random.next_unit() - 0.5, random.next_unit() - 0.5, random.next_unit() - 0.5);
    // no hole wider than the least distance plus the candidates' own spacing
    EXPECT_LT(distance_to_samples(shape, direction.normalized() * (radius - inset * d)), (0.8 + 0.2) * d);
  }
}

TEST(BodyShape, BoxKeepsItsSharpCornersInside) {
  const double d = 0.25, inset = 0.6;
  const BodyShape shape = make_body_shape(make_box({-2, -1, -0.5}, {2, 1, 1.5}), d, inset);
  ASSERT_TRUE(shape.faults.empty());
  EXPECT_NEAR(shape.solid.volume, 16.0, 1e-9);
  const Eigen::Vector3d half(2 - inset * d, 1 - inset * d, 1 - inset * d);
  for (const auto& sample : shape.samples) {
    const Eigen::Vector3d from_edge = half - (sample.cast<double>() - Eigen::Vector3d(0, 0, 0.5)).cwiseAbs();
    EXPECT_NEAR(from_edge.minCoeff(), 0.0, 0.03 * d);  // on the inner box: 2 % of the inset, single precision
    EXPECT_LT(shape.signed_distance(sample.cast<double>(), 1.0), -0.97 * inset * d);
  }
  // corners of the inner box are covered
  EXPECT_LT(distance_to_samples(shape, Eigen::Vector3d(half.x(), half.y(), half.z() + 0.5)), 1.0 * d);
  const double area = 8 * (half.x() * half.y() + half.y() * half.z() + half.z() * half.x());
  EXPECT_NEAR(static_cast<double>(shape.samples.size()) * d * d / area, 1.0, 0.2);  // edges attract samples
}

TEST(BodyShape, ThinPlateIsSampledInItsMiddle) {
  const double d = 0.25;
  const BodyShape shape = make_body_shape(make_box({-2, -1, 0}, {2, 1, 0.1}), d, 0.6);
  ASSERT_TRUE(shape.faults.empty());
  ASSERT_GT(shape.samples.size(), 100u);
  for (const auto& sample : shape.samples) {
    EXPECT_NEAR(sample.z(), 0.05f, 1e-3);
    EXPECT_TRUE(shape.inside(sample.cast<double>()));
  }
}

TEST(BodyShape, APlateHasAWholeLayerOnEachSide) {
  const double d = 0.25;
  for (const double thickness : {1.3, 1.6, 2.0}) {
    const BodyShape shape = make_body_shape(make_box({-4, -4, 0}, {4, 4, thickness * d}), d, 0.6);
    ASSERT_EQ(shape.inward.size(), shape.samples.size());
    std::size_t low = 0;
    for (std::size_t k = 0; k < shape.samples.size(); ++k) {
      if (shape.samples[k].head<2>().cwiseAbs().maxCoeff() > 3.0F) continue;  // the edges
      EXPECT_NEAR(std::abs(shape.inward[k].z()), 1.0F, 1e-5F);
      low += shape.inward[k].z() > 0.0F ? 1 : 0;
    }
    EXPECT_GT(static_cast<double>(low) * d * d / 36.0, 0.8) << thickness;
  }
}

TEST(SampleInset, IsLessForFlatFacesThanForCurvedOnes) {
  EXPECT_EQ(default_sample_inset(make_mesh(BoxShape{{2, 1, 0.5}})), 0.53);
  EXPECT_EQ(default_sample_inset(joined({make_box({0, 0, 0}, {3, 1, 1}), make_box({0, 1, 0}, {1, 3, 1})})), 0.53);
  EXPECT_EQ(default_sample_inset(make_sphere(1.0, 24)), 0.61);
  EXPECT_EQ(default_sample_inset(make_mesh(CylinderShape{0.5, 2.0})), 0.61);
}

/// The parts that a wall of 3 x 0.8 x 2 m may come in.
std::vector<TriangleMesh> walls_of_parts() {
  const auto lower = make_box({-1.5, -0.4, -1}, {1.5, 0.4, 0.3}), upper = make_box({-1.5, -0.4, -0.2}, {1.5, 0.4, 1});
  const auto left = make_box({-1.5, -0.4, -1}, {0.17, 0.4, 1}), right = make_box({0.17, -0.4, -1}, {1.5, 0.4, 1});
  const auto whole = make_box({-1.5, -0.4, -1}, {1.5, 0.4, 1}), inner = make_box({-1, -0.3, -0.9}, {0, 0.3, 0.9});
  return {whole, joined({lower, upper}), joined({left, right}), joined({whole, inner}), joined({whole, whole})};
}

TEST(BodyShape, PartsAreSampledAsTheirUnion) {
  const double d = 0.2, inset = 0.6 * d;
  std::size_t of_one = 0;
  for (const TriangleMesh& wall : walls_of_parts()) {
    const BodyShape shape = make_body_shape(wall, d, 0.6);
    ASSERT_TRUE(shape.faults.empty()) << shape.faults.front();
    EXPECT_NEAR(shape.solid.volume, 4.8, 1e-9);
    if (of_one == 0) of_one = shape.samples.size();
    EXPECT_NEAR(static_cast<double>(shape.samples.size()) / static_cast<double>(of_one), 1.0, 0.06);
    for (const auto& sample : shape.samples) {  // 2 % of the inset, single precision
      const Eigen::Vector3d depth = Eigen::Vector3d(1.5, 0.4, 1.0) - sample.cast<double>().cwiseAbs();
      EXPECT_NEAR(depth.minCoeff(), inset, 0.03 * d) << "a sample inside the wall, or out of it";
    }
    SplitMix64 random(2);
    for (int n = 0; n < 300; ++n) {  // no hole on the inner faces of the long sides
      const Eigen::Vector3d place((2 * random.next_unit() - 1) * (1.5 - inset), n % 2 == 0 ? 0.4 - inset : inset - 0.4,
                                  (2 * random.next_unit() - 1) * (1.0 - inset));
      EXPECT_LT(distance_to_samples(shape, place), (0.8 + 0.2) * d) << place.transpose();
    }
    EXPECT_NEAR(shape.signed_distance({0.1, 0, 0}, 10.0), -0.4, 1e-9) << "to the outside, not to a face within";
    EXPECT_TRUE(shape.rim.empty());
  }
}

TEST(BodyShape, ASealedCavityIsDryAndDisplacesWater) {
  TriangleMesh hold = make_box({-1, -0.5, -0.5}, {1, 0.5, 0.5});
  for (auto& triangle : hold.triangles) std::swap(triangle[0], triangle[1]);
  const auto hull = make_box({-2, -1, -1}, {2, 1, 1});
  const BodyShape tank = make_body_shape(joined({hull, hold}), 0.25, 0.6), solid = make_body_shape(hull, 0.25, 0.6);
  ASSERT_TRUE(tank.faults.empty()) << tank.faults.front();
  EXPECT_NEAR(tank.solid.volume, 14.0, 1e-12);
  EXPECT_NEAR(tank.displacement, 16.0, 1e-12);
  EXPECT_TRUE(tank.inside({0, 0, 0})) << "no water may start there";
  EXPECT_EQ(tank.samples, solid.samples) << "none where no water comes";
  EXPECT_EQ(tank.notes.size(), 1u);
}

TEST(BodyShape, IsTheSameEachTime) {
  const auto mesh = make_sphere(1.0, 12);
  const BodyShape a = make_body_shape(mesh, 0.4, 0.6), b = make_body_shape(mesh, 0.4, 0.6);
  ASSERT_EQ(a.samples.size(), b.samples.size());
  for (std::size_t n = 0; n < a.samples.size(); ++n) EXPECT_EQ(a.samples[n], b.samples[n]);
}

TEST(BodyShape, RefusesWhatItCannotSample) {
  auto open = make_box({0, 0, 0}, {1, 1, 1});
  open.triangles.pop_back();
  EXPECT_FALSE(make_body_shape(open, 0.1, 0.6).faults.empty());
  const BodyShape huge = make_body_shape(make_box({0, 0, 0}, {1e5, 1e5, 10}), 0.1, 0.6);
  ASSERT_EQ(huge.faults.size(), 1u);
  EXPECT_THAT(to_string(huge.faults[0]), ::testing::HasSubstr("particle_spacing"));
  EXPECT_FALSE(load_body_shape("/nowhere.obj", {}, 1, 0.6).faults.empty());
}

TEST(BodyShape, OpenSurfaceIsSampledBehindItsFaces) {
  // A slope of 1 in 4 that faces up, 4 x 4 m.
  TriangleMesh slope;
  slope.vertices = {{-2, -2, -0.5}, {2, -2, 0.5}, {2, 2, 0.5}, {-2, 2, -0.5}};
  slope.triangles = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_FALSE(make_body_shape(slope, 0.25, 0.6).faults.empty()) << "a closed body has no rim";
  const BodyShape shape = make_body_shape(slope, 0.25, 0.6, MeshKind::kOpen);
  ASSERT_TRUE(shape.faults.empty()) << shape.faults.front();
  const Eigen::Vector3d up = Eigen::Vector3d(-0.25, 0, 1).normalized();
  for (const auto& sample : shape.samples) EXPECT_NEAR(up.dot(sample.cast<double>()), -0.6 * 0.25, 1e-6);  // floats
  // about one a spacing^2; a rim attracts samples: 0.9 to 1.2 on 16 x 16 spacings
  EXPECT_NEAR(static_cast<double>(shape.samples.size()) * 0.0625 / mesh_area(slope), 1.05, 0.15);
  EXPECT_TRUE(shape.inside({1, 1, 0}));
  EXPECT_FALSE(shape.inside({1, 1, 0.5}));
  EXPECT_TRUE(shape.inside({0, 0, -100})) << "however deep";
  EXPECT_TRUE(shape.inside({5, 0, 1})) << "past the rim the slope goes on";
  EXPECT_FALSE(shape.inside({5, 0, 1.5}));
  EXPECT_NEAR(shape.signed_distance({0, 0, -1}, 10.0), -up.z(), 1e-12);
  EXPECT_NEAR(shape.signed_distance({0, 0, 1}, 0.1), 0.1, 1e-12);
}

TEST(BodyShape, WithoutInsetSamplesLieOnTheSurface) {
  const BodyShape shape = make_body_shape(make_sphere(1.0, 24), 0.3, 0.0);
  for (const auto& sample : shape.samples) EXPECT_NEAR(sample.norm(), 1.0, 0.01);  // facets
}

TEST(BodyShape, LongThinTrianglesAreNoBurden) {
  // A bar of 400 m whose side triangles are 1600 times as long as high: 2.4e5 points where squares of the longest edge
  // would be 6e7.
  const BodyShape shape = make_body_shape(make_box({-200, -2, -0.125}, {200, 2, 0.125}), 1.0, 0.6);
  ASSERT_TRUE(shape.faults.empty()) << shape.faults.front();
  EXPECT_NEAR(static_cast<double>(shape.samples.size()), 1600.0,
              500.0);  // one layer: 0.7 to 1.3 per m^2 with its edges
}

TEST(PlaceSamples, MovesAsARigidBody) {
  const BodyShape shape = make_body_shape(make_box({-1, -1, -1}, {1, 1, 1}), 0.5, 0.6);
  BodyState state;
  state.position = {1000, 2000, 3};
  state.orientation = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized());
  state.velocity = {1, 2, 3};
  state.angular_velocity = {0.1, -0.2, 0.3};
  const PatchFrame patch{{990, 2000, 0}, {}, kWallsAround};
  std::vector<Float4> position(shape.samples.size(), {0, 0, 0, 7}), velocity(shape.samples.size());
  place_samples(shape, state, patch, position, velocity);
  BodyState later = state;
  const double dt = 1e-3;
  later.position += dt * state.velocity;
  later.orientation =
      Eigen::AngleAxisd(state.angular_velocity.norm() * dt, state.angular_velocity.normalized()) * state.orientation;
  std::vector<Float4> moved = position, ignored = velocity;
  place_samples(shape, later, patch, moved, ignored);
  for (std::size_t n = 0; n < position.size(); ++n) {
    EXPECT_EQ(position[n].w, 7.0f);
    // positions near 10 m in single precision: 1e-6 / dt
    EXPECT_NEAR((moved[n].x - position[n].x) / dt, velocity[n].x, 3e-3);
    EXPECT_NEAR((moved[n].y - position[n].y) / dt, velocity[n].y, 3e-3);
    EXPECT_NEAR((moved[n].z - position[n].z) / dt, velocity[n].z, 3e-3);
  }
}

TEST(BodyShape, LargeHullHasAboutOneSampleForEachSpacingSquaredAndNoHole) {
  // 13,000 samples. Points of the inner sphere stand for its surface; candidates lie a quarter of a spacing apart, so a
  // point between them may be 0.18 farther from a sample than any of them.
  const double d = 0.25, radius = 8.0, inner = radius - 0.6 * d;
  const BodyShape shape = make_body_shape(make_mesh(SphereShape{radius}), d, 0.6);
  ASSERT_TRUE(shape.faults.empty());
  // Random sequential packing leaves 0.70 / r^2 a unit of area, and where triangles meet candidates are denser.
  EXPECT_NEAR(static_cast<double>(shape.samples.size()) * d * d / (4 * std::numbers::pi * inner * inner), 1.0, 0.1);
  SplitMix64 random(5);
  for (int n = 0; n < 300; ++n) {
    const Eigen::Vector3d direction(random.next_unit() - 0.5, random.next_unit() - 0.5, random.next_unit() - 0.5);
    EXPECT_LT(distance_to_samples(shape, direction.normalized() * inner), (0.8 + 0.2) * d);
  }
}

TEST(Coaster, IsWatertightAndSampledAtOneMetre) {
  const std::string path = test::source_path("assets/meshes/coaster_hull.obj");
  ASSERT_TRUE(std::filesystem::exists(path));
  const BodyShape shape = load_body_shape(path, {}, 1.0, 0.6);
  ASSERT_TRUE(shape.faults.empty()) << shape.faults.front();
  EXPECT_GT(shape.solid.volume,
            0.3 * shape.bounding_box.volume());  // block coefficients of full hulls with superstructure
  EXPECT_LT(shape.solid.volume, shape.bounding_box.volume());
  for (const auto& sample : shape.samples) EXPECT_TRUE(shape.inside(sample.cast<double>()));
  EXPECT_GE(least_distance(shape), 0.8 - 1e-5);
  RecordProperty("samples", static_cast<int>(shape.samples.size()));
  RecordProperty("volume", std::to_string(shape.solid.volume));
}

}  // namespace
}  // namespace pelagos
