#include "surface/anisotropy.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace pelagos {

namespace {

struct PrincipalAxes {
  Eigen::Vector3d eigenvalues;  ///< descending
  Eigen::Matrix3d axes;         ///< columns, right-handed
};

/// eq. 47. The closed form is fast and good to rounding where eigenvalues are apart; its axes are checked, and the
/// iterative solver takes over where they are not orthogonal.
bool find_principal_axes(const Eigen::Matrix3d& matrix, PrincipalAxes& result) {
  constexpr double kOrthogonal = 1e-5;
  const auto take = [&](const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>& solver) {
    result.eigenvalues = solver.eigenvalues().reverse();
    result.axes = solver.eigenvectors().rowwise().reverse();
    if (result.axes.determinant() < 0.0) result.axes.col(2) *= -1.0;
    const Eigen::Matrix3d excess = result.axes.transpose() * result.axes - Eigen::Matrix3d::Identity();
    return result.eigenvalues.allFinite() && excess.cwiseAbs().maxCoeff() < kOrthogonal;
  };
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(matrix);
  if (take(solver)) return true;
  solver.compute(matrix);
  return solver.info() == Eigen::Success && take(solver);
}

}  // namespace

float smooth_neighbor_count(float weight) {
  // The 26 neighbours of the lattice at 1, sqrt 2 and sqrt 3 spacings weigh 6 (7/8) + 12 (1 - 2^1.5/8)
  // + 8 (1 - 3^1.5/8) = 15.81 with support_radius = 2 spacings.
  constexpr float kNeighborsPerWeight = 26.0f / 15.8112f;
  return kNeighborsPerWeight * std::max(weight - 1.0f, 0.0f);
}

Ellipsoid fit_ellipsoid(const Neighborhood& neighborhood, float spacing, float support_radius,
                        const AnisotropySettings& settings) {
  Ellipsoid ellipsoid;
  ellipsoid.semi_axes.setConstant(settings.least_scale * settings.radius * spacing);
  PrincipalAxes principal;
  const double unit = 1.0 / (static_cast<double>(support_radius) * static_cast<double>(support_radius));
  const Eigen::Matrix3d covariance = unit * neighborhood.covariance.cast<double>();  // in support radii
  if (!covariance.allFinite() || !neighborhood.mean.allFinite() || !find_principal_axes(covariance, principal))
    return ellipsoid;

  const float count = smooth_neighbor_count(neighborhood.weight);
  const float gamma =
      std::clamp((count - settings.few_neighbors) / (settings.enough_neighbors - settings.few_neighbors), 0.0f, 1.0f);
  const auto largest = static_cast<float>(std::max(principal.eigenvalues[0], 0.0));
  for (int axis = 0; axis < 3; ++axis) {
    const float sigma = std::max(static_cast<float>(principal.eigenvalues[axis]), largest / settings.largest_ratio);
    const float bulk = sigma / settings.full_eigenvalue;         // eq. 49, first line
    const float sparse = std::min(settings.sparse_scale, bulk);  // eq. 51
    const float scale = (1.0f - gamma) * sparse + gamma * bulk;  // in place of eq. 50
    ellipsoid.semi_axes[axis] = std::max(scale, settings.least_scale) * settings.radius * spacing;
  }
  ellipsoid.orientation = Eigen::Quaternionf(principal.axes.cast<float>().eval()).normalized();

  const float distance = neighborhood.mean.norm();
  ellipsoid.shift = settings.smoothing * neighborhood.mean;  // eq. 53
  if (distance > 1e-6f * support_radius) {
    const float push = std::min(distance / (settings.push_full * support_radius), 1.0f);
    ellipsoid.shift -= settings.push_back * spacing * push / distance * neighborhood.mean;
  }
  return ellipsoid;
}

}  // namespace pelagos
