#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace pelagos {

/// Weighted moments of a particle's neighbourhood, relative to the particle itself (paper eq. 44 to 46).
struct Neighborhood {
  float weight = 0;                                      ///< sum of w_ij, the particle itself (w = 1) included
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();        ///< m, x^w_i - x_i
  Eigen::Matrix3f covariance = Eigen::Matrix3f::Zero();  ///< m^2, about x^w_i
};

/// How a particle is drawn: an ellipsoid about a place near the particle.
struct Ellipsoid {
  Eigen::Vector3f shift = Eigen::Vector3f::Zero();  ///< m, from the particle to the ellipsoid's centre
  Eigen::Quaternionf orientation = Eigen::Quaternionf::Identity();
  Eigen::Vector3f semi_axes = Eigen::Vector3f::Zero();  ///< m, descending
};

/// Constants of the paper's section V and of its scale-free reading.
struct AnisotropySettings {
  float largest_ratio = 5.0f;      ///< k_r, eq. 48: between the largest and the smallest eigenvalue
  float full_eigenvalue = 0.15f;   ///< of the covariance / support_radius^2 in a full neighbourhood: k_s = 1/(0.15 h^2)
  float sparse_scale = 0.5f;       ///< k_n, eq. 50 and 51
  float least_scale = 0.35f;       ///< floor of all scales: without it an isolated particle has no size
  float few_neighbors = 5.0f;      ///< N_t
  float enough_neighbors = 20.0f;  ///< N_epsilon
  float smoothing = 0.9f;          ///< tau, eq. 53
  float radius = 0.95f;            ///< semi-axis of a particle with a full neighbourhood, spacings
  float push_back = 0.53f;         ///< along the outward normal, spacings, at the surface
  float push_full = 0.18f;         ///< |mean| / support_radius from which on the whole push applies
};

/// Number of neighbours as a continuous function of the weights: 26 for the interior of a cubic lattice at
/// support_radius = 2 spacings, 18 at its flat surface (where 17 are counted).
[[nodiscard]] float smooth_neighbor_count(float weight);

/// Ellipsoid of a particle (paper eq. 47 to 53), with these differences from the paper:
/// - k_s is scale-free, 1/(0.15 support_radius^2); 560 is its value at support_radius = 0.109 m.
/// - sigma is scaled before (50) and (51), so that it is of order one there.
/// - gamma is no constant but ramps from 0 at N_t to 1 at N_epsilon neighbours, between (51) and k_s sigma, and
///   neighbours are counted by their weights: shapes do not jump when a neighbour comes or goes.
/// - all scales have a floor.
/// - smoothing and flattening sink the drawn surface below the water's; the particle is pushed back along its outward
///   normal -mean. The push is set so that the ellipsoids of a flat surface end half a spacing above its particles.
/// Semi-axes are scale x 0.95 spacings: tangentially above 0.71, half the diagonal between neighbours, so that the
/// ellipsoids close the surface. Never fails: anything not finite gives the sphere of an isolated particle.
[[nodiscard]] Ellipsoid fit_ellipsoid(const Neighborhood& neighborhood, float spacing, float support_radius,
                                      const AnisotropySettings& settings = {});

}  // namespace pelagos
