#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <functional>
#include <limits>

#include "../support/csv.hpp"
#include "../support/places.hpp"
#include "surface/anisotropy.hpp"
#include "waves/splitmix.hpp"

namespace pelagos {
namespace {

/// Moments of the lattice points that `keep` lets through around the origin, spacing 1, in double precision.
Neighborhood moments_of_lattice(double support_radius, const std::function<bool(int, int, int)>& keep) {
  const int reach = static_cast<int>(std::ceil(support_radius));
  double weight = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (int i = -reach; i <= reach; ++i)
    for (int j = -reach; j <= reach; ++j)
      for (int k = -reach; k <= reach; ++k) {
        const Eigen::Vector3d way(i, j, k);
        if (!keep(i, j, k) || way.norm() >= support_radius) continue;
        const double w = 1 - std::pow(way.norm() / support_radius, 3);
        weight += w;
        first += w * way;
        second += w * way * way.transpose();
      }
  Neighborhood result;
  result.weight = static_cast<float>(weight);
  result.mean = (first / weight).cast<float>();
  result.covariance = (second / weight - first * first.transpose() / (weight * weight)).cast<float>();
  return result;
}

bool interior(int, int, int) { return true; }
bool flat_surface(int, int, int k) { return k <= 0; }
bool edge(int i, int, int k) { return i <= 0 && k <= 0; }
bool corner(int i, int j, int k) { return i <= 0 && j <= 0 && k <= 0; }

TEST(Anisotropy, EigenvaluesSetTheSemiAxes) {
  // Above N_epsilon neighbours the semi-axes are 0.95 d max(sigma, sigma_1 / 5) / (0.15 h^2), with a floor of 0.35.
  const struct {
    std::string name;
    std::function<bool(int, int, int)> keep;
  } sets[] = {{"interior", interior}, {"flat surface", flat_surface}, {"edge 90deg", edge}, {"corner", corner}};
  int compared = 0;
  for (const auto& row : test::read_csv(test::source_path("tests/surface/data/anisotropy_reference.csv")))
    for (const auto& set : sets) {
      if (row[0] != set.name) continue;
      const double support_radius = std::stod(row[1]);
      const Neighborhood moments = moments_of_lattice(support_radius, set.keep);
      EXPECT_NEAR(moments.mean.norm() / support_radius, std::stod(row[6]), 1e-6) << row[0];  // single precision
      AnisotropySettings settings;
      settings.enough_neighbors = -1;  // no ramp: the eigenvalues themselves
      settings.few_neighbors = -2;
      const Ellipsoid ellipsoid = fit_ellipsoid(moments, 1.0f, static_cast<float>(support_radius), settings);
      const double largest = std::stod(row[3]);
      for (int axis = 0; axis < 3; ++axis) {
        const double sigma = std::max(std::stod(row[3 + static_cast<std::size_t>(axis)]), largest / 5);
        EXPECT_NEAR(static_cast<double>(ellipsoid.semi_axes[axis]), 0.95 * std::max(sigma / 0.15, 0.35), 1e-5)
            << row[0] << " s = " << row[1];
        ++compared;
      }
    }
  EXPECT_EQ(compared, 48);
}

TEST(Anisotropy, AFullNeighborhoodIsNearlyTheSphere) {
  const Ellipsoid ellipsoid = fit_ellipsoid(moments_of_lattice(2.0, interior), 1.0f, 2.0f);
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(ellipsoid.semi_axes[axis], 0.95f * 0.96418f, 1e-4f);
  EXPECT_LT(ellipsoid.shift.norm(), 1e-6f);
}

TEST(Anisotropy, SurfaceEllipsoidsAreFlatAcrossTheNormalAndOverlap) {
  const Ellipsoid ellipsoid = fit_ellipsoid(moments_of_lattice(2.0, flat_surface), 1.0f, 2.0f);
  EXPECT_NEAR(std::abs((ellipsoid.orientation * Eigen::Vector3f::UnitZ()).z()), 1.0f, 1e-5f);
  EXPECT_GT(ellipsoid.semi_axes[1], 0.72f);  // half the diagonal of four neighbours is 0.707
  EXPECT_LT(ellipsoid.semi_axes[2], 0.5f);
  EXPECT_LT(ellipsoid.shift.head<2>().norm(), 1e-5f);
  EXPECT_GT(ellipsoid.shift.z(), 0.0f);  // outwards
}

TEST(Anisotropy, IsolatedAndDegenerateNeighborhoodsHaveASize) {
  Neighborhood alone;
  alone.weight = 1;
  const Ellipsoid sphere = fit_ellipsoid(alone, 1.0f, 2.0f);
  EXPECT_EQ(sphere.shift.norm(), 0.0f);
  for (int axis = 0; axis < 3; ++axis) EXPECT_FLOAT_EQ(sphere.semi_axes[axis], 0.35f * 0.95f);

  const auto line = moments_of_lattice(2.0, [](int, int j, int k) { return j == 0 && k == 0; });
  const auto sheet = moments_of_lattice(2.0, [](int, int, int k) { return k == 0; });
  for (const Neighborhood& moments : {line, sheet}) {
    const Ellipsoid ellipsoid = fit_ellipsoid(moments, 1.0f, 2.0f);
    EXPECT_TRUE(ellipsoid.semi_axes.allFinite());
    EXPECT_GE(ellipsoid.semi_axes[2], 0.33f);
    EXPECT_NEAR(ellipsoid.orientation.norm(), 1.0f, 1e-5f);
  }
  Neighborhood broken = sheet;
  broken.covariance(0, 1) = broken.covariance(1, 0) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FLOAT_EQ(fit_ellipsoid(broken, 1.0f, 2.0f).semi_axes[0], 0.35f * 0.95f);
  broken.covariance.setConstant(std::numeric_limits<float>::infinity());
  EXPECT_TRUE(fit_ellipsoid(broken, 1.0f, 2.0f).semi_axes.allFinite());
}

TEST(Anisotropy, AxesAreThoseOfTheCovariance) {
  SplitMix64 random(5);
  for (int n = 0; n < 2000; ++n) {
    Eigen::Vector3d sigma(random.next_unit(), random.next_unit(), random.next_unit());
    if (n % 4 == 0) sigma[1] = sigma[0];               // double
    if (n % 4 == 1) sigma[2] = sigma[1] * (1 + 1e-6);  // nearly double
    if (n % 16 == 3) sigma.setConstant(0.6);
    const Eigen::Quaterniond turn = Eigen::Quaterniond(random.next_unit() - .5, random.next_unit() - .5,
                                                       random.next_unit() - .5, random.next_unit() - .5)
                                        .normalized();
    const Eigen::Matrix3d axes = turn.toRotationMatrix();
    Neighborhood moments;
    moments.weight = 17;
    const Eigen::Matrix3d covariance = axes * (0.15 * sigma).asDiagonal() * axes.transpose();
    moments.covariance = (0.01 * covariance).cast<float>();  // support radius 0.1
    AnisotropySettings plain;
    plain.enough_neighbors = plain.few_neighbors = -1;
    plain.largest_ratio = 1e6f;
    plain.least_scale = 0;
    plain.radius = 1;
    plain.enough_neighbors = 0;
    const Ellipsoid ellipsoid = fit_ellipsoid(moments, 1.0f, 0.1f, plain);
    // R diag(scale) R^T rebuilds the matrix, whatever axes were chosen among equal ones
    const Eigen::Matrix3f rotation = ellipsoid.orientation.toRotationMatrix();
    const Eigen::Matrix3f rebuilt = rotation * ellipsoid.semi_axes.asDiagonal() * rotation.transpose();
    EXPECT_LT((rebuilt.cast<double>() - covariance / 0.15).cwiseAbs().maxCoeff(), 5e-6);  // single precision
    EXPECT_GE(ellipsoid.semi_axes[0], ellipsoid.semi_axes[1]);
    EXPECT_GE(ellipsoid.semi_axes[1], ellipsoid.semi_axes[2]);
  }
}

TEST(Anisotropy, ShapesChangeContinuouslyAsNeighborsLeave) {
  // A flat surface's upper layer is peeled off by moving it away: count, shape and shift must not jump.
  Ellipsoid before;
  for (int n = 0; n <= 2000; ++n) {
    const double away = 1.0 + n * 1e-3;  // the layer below sinks from 1 to 3 spacings
    double weight = 0;
    Eigen::Vector3d first = Eigen::Vector3d::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
    for (int i = -2; i <= 2; ++i)
      for (int j = -2; j <= 2; ++j)
        for (const double z : {0.0, -away}) {
          if (z == 0.0 && i > 0) continue;
          const Eigen::Vector3d way(i, j + 0.01 * i, z);
          if (way.norm() >= 2.0) continue;
          const double w = 1 - std::pow(way.norm() / 2, 3);
          weight += w;
          first += w * way;
          second += w * way * way.transpose();
        }
    Neighborhood moments;
    moments.weight = static_cast<float>(weight);
    moments.mean = (first / weight).cast<float>();
    moments.covariance = (second / weight - first * first.transpose() / (weight * weight)).cast<float>();
    const Ellipsoid now = fit_ellipsoid(moments, 1.0f, 2.0f);
    if (n > 0) {
      // a step of 0.001 spacings; the steepest ramp turns it into less than ten times as much
      EXPECT_LT((now.semi_axes - before.semi_axes).cwiseAbs().maxCoeff(), 0.01f) << away;
      EXPECT_LT((now.shift - before.shift).norm(), 0.01f) << away;
    }
    before = now;
  }
}

TEST(SmoothNeighborCount, MatchesCountsOfTheLattice) {
  EXPECT_NEAR(smooth_neighbor_count(moments_of_lattice(2.0, interior).weight), 26.0f, 1e-2f);
  EXPECT_NEAR(smooth_neighbor_count(moments_of_lattice(2.0, flat_surface).weight), 18.0f, 0.1f);
  EXPECT_EQ(smooth_neighbor_count(1.0f), 0.0f);
}

}  // namespace
}  // namespace pelagos
