#include "rigid/added_mass.hpp"

#include <cmath>

namespace pelagos {

namespace {

constexpr int kPlaces = 2000;    ///< of the integrals' midpoint rule
constexpr double kRound = 1e-6;  ///< relative difference of two axes below which nothing turns water
constexpr double kRange = 18.0;  ///< e-folds of l on both sides of the middle axis' square

/// a0, b0, c0; their sum is 2. With l = e^t the integrand decays on both sides.
Eigen::Vector3d shape_integrals(const Eigen::Vector3d& semi_axes) {
  const Eigen::Vector3d squares = semi_axes.cwiseAbs2();
  const double middle = std::cbrt(squares.prod()), step = 2.0 * kRange / kPlaces;
  Eigen::Vector3d sums = Eigen::Vector3d::Zero();
  for (int k = 0; k < kPlaces; ++k) {
    const double l = middle * std::exp(-kRange + (k + 0.5) * step);
    const Eigen::Vector3d at = squares.array() + l;
    sums += step * l / std::sqrt(at.prod()) * at.cwiseInverse();
  }
  sums *= semi_axes.prod();
  return 2.0 / sums.sum() * sums;
}

}  // namespace

AddedMass ellipsoid_added_mass(const Eigen::Vector3d& semi_axes) {
  const Eigen::Vector3d integrals = shape_integrals(semi_axes), squares = semi_axes.cwiseAbs2();
  AddedMass added;
  for (int axis = 0; axis < 3; ++axis) {
    added.along[axis] = integrals[axis] / (2.0 - integrals[axis]);
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    const double difference = squares[b] - squares[c], sum = squares[b] + squares[c];
    if (std::abs(difference) < kRound * sum) continue;
    const double below = 2.0 * difference + sum * (integrals[b] - integrals[c]);
    added.about[axis] = difference * difference * (integrals[c] - integrals[b]) / (5.0 * below);
  }
  return added;
}

}  // namespace pelagos
