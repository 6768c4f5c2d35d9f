#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "element_grid.hpp"
#include "oil/slick_element.hpp"

namespace pelagos {

class Barriers;

// The film, and how it spreads. SlickLayer's header says what law this is; here is the arithmetic.
//
// Two elements of sizes s_i, s_j overlap by a bell of radius R_ij = sqrt(s_i^2 + s_j^2), Wendland's C2 function in the
// plane, of integral 1 (the convolution of their own bells, up to its exact shape):
//   Phi_ij = 7 / (pi R_ij^2) (1 - q)^4 (1 + 4 q) ,   q = |x_i - x_j| / R_ij < 1
// The film at an element is H_i = sum_j V_j Phi_ij. The film's energy is E = 1/2 sum_i V_i H_i, and elements move and
// grow down its slope:
//   dx_i / dt = -kappa_i sum_j V_j grad_i Phi_ij
//   ds_i / dt = -kappa_i / mu (sum_{j != i} V_j dPhi_ij / ds_i + 1/2 V_i dPhi_ii / ds_i)
// with mu = <r^2> / s^2 = 5/36 of one bell. This is the gradient flow of E over films made of bells, so that one bell
// spreads by its own weight as hundreds do that push each other: for kappa = c t it follows the similarity solution of
// dh/dt = div(kappa h grad h) exactly in both limits, up to the profile's shape.

inline constexpr double kReachPerSize = 1.4142135623730951;  ///< R_ii / s_i
inline constexpr double kBellMoment = 5.0 / 36.0;            ///< mu

struct FilmSample {
  double height = 0.0;                        ///< H_i, m
  double gradient_x = 0.0, gradient_y = 0.0;  ///< of H at i
  double growth = 0.0;                        ///< -(the bracket of ds_i / dt), m^0: >= 0 makes the element grow
};

using ElementPair = std::pair<std::uint32_t, std::uint32_t>;

struct Film {
  std::vector<FilmSample> sample;     ///< of each element
  std::vector<double> volume;         ///< V_i, m^3
  std::vector<ElementPair> covering;  ///< pairs so close that they should merge
  std::vector<ElementPair> touching;  ///< pairs whose discs overlap; only where there are barriers
};

/// Elements closer than this share of the smaller one's size cover each other.
inline constexpr double kCoveringDistance = 0.4;

/// Measures the film at every element and sets SlickElement::film: the film's thickness, by H_i, and for a lone
/// element its volume over its disc (H_i counts a lone bell's peak).
/// @param barriers  pairs that it separates do not see each other; may be null
void measure_film(std::span<SlickElement> elements, double oil_density, const ElementGrid& grid,
                  const Barriers* barriers, Film& film);

struct SpreadLaw {
  double reduced_gravity;     ///< g (rho_w - rho_o) / rho_w, m/s^2
  double water_viscosity;     ///< m^2/s
  double inertial, viscous;   ///< c_I and c_V of the two mobilities, no unit
  double terminal_thickness;  ///< m
};

/// c_I and c_V from Fay's constants.
[[nodiscard]] SpreadLaw make_spread_law(double reduced_gravity, double water_viscosity, double fay_inertial,
                                        double fay_viscous, double terminal_thickness);

/// Lets one element spread over dt: grows and ages it and returns how far it is pushed, m.
[[nodiscard]] Eigen::Vector2d spread(const SpreadLaw& law, const FilmSample& sample, double volume, double dt,
                                     SlickElement& element);

}  // namespace pelagos
