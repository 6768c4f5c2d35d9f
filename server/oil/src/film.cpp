#include "film.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "booms.hpp"

namespace pelagos {

namespace {

constexpr double kBellFactor = 7.0 / std::numbers::pi;  ///< Phi at q = 0, times R^2

/// s^2 H / V, without the own share of H, up to which elements may grow into each other: at about two sizes a spacing.
/// Beyond it only pushing apart helps.
constexpr double kMostOverlap = 3.0;

/// Contained elements that overlap more than that are squeezed: they shrink at this time constant, s, so that a pile is
/// as sharp as its elements are many.
constexpr double kSqueezeTime = 5.0;
constexpr double kLeastSize = 0.02;  ///< m; they shrink no further

/// An element moves at most this share of its size in a step.
constexpr double kMostPush = 0.5;

/// Ratio of a lone element's mean thickness, V / (pi r^2), to its H = 7 V / (2 pi s^2).
constexpr double kLoneFilm = 2.0 / (7.0 * kDiscPerSize * kDiscPerSize);

/// Share of a bell's own height that counts in the viscous mobility. With 1 a slick of hundreds of elements covers 15 %
/// less than a lone element, with 0.4 one of five elements 30 % more; this evens them out.
constexpr double kOwnMobility = 0.7;

double own_height(double volume, double size) { return kBellFactor * volume / (2.0 * size * size); }

}  // namespace

void measure_film(std::span<SlickElement> elements, double oil_density, const ElementGrid& grid,
                  const Barriers* barriers, Film& film) {
  film.covering.clear();
  film.touching.clear();
  film.volume.resize(elements.size());
  film.sample.resize(elements.size());
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const SlickElement& e = elements[i];
    film.volume[i] = film_volume(e, oil_density);
    const double own = own_height(film.volume[i], e.size);
    film.sample[i] = {own, 0.0, 0.0, own / e.size};  // 1/2 |dPhi_ii / ds_i| = Phi_ii / s_i
  }

  // Each pair is found once, from its larger element, so that a few large ones do not widen everybody's search.
  for (const ElementGrid::Entry& a : grid.entries()) {
    const std::uint32_t i = a.element;
    FilmSample sum = film.sample[i];
    const double volume_i = film.volume[i], size_i_squared = a.size * a.size;
    grid.for_each_near(a.x, a.y, kReachPerSize * a.size, [&](const ElementGrid::Entry& b) {
      const std::uint32_t j = b.element;
      if (b.size > a.size || (b.size == a.size && j >= i)) return;
      const double dx = a.x - b.x, dy = a.y - b.y;
      const double reach_squared = size_i_squared + b.size * b.size, distance_squared = dx * dx + dy * dy;
      if (distance_squared >= reach_squared) return;
      if (barriers != nullptr && barriers->separates(i, j, {a.x, a.y}, {b.x, b.y})) return;

      const double inverse_squared = 1.0 / reach_squared;
      const double q = std::sqrt(distance_squared * inverse_squared), near = 1.0 - q;
      const double near_cubed = near * near * near, factor = kBellFactor * inverse_squared;
      const double bell = factor * near_cubed * near * (1.0 + 4.0 * q);
      const double slope = -20.0 * factor * inverse_squared * near_cubed;  // (dPhi / dr) / r
      const double shrink = 2.0 * bell * inverse_squared + slope * q * q;  // -(dPhi / dR) / R
      const double volume_j = film.volume[j];
      sum.height += volume_j * bell;
      sum.gradient_x += volume_j * slope * dx;
      sum.gradient_y += volume_j * slope * dy;
      sum.growth += volume_j * shrink * a.size;
      FilmSample& other = film.sample[j];
      other.height += volume_i * bell;
      other.gradient_x -= volume_i * slope * dx;
      other.gradient_y -= volume_i * slope * dy;
      other.growth += volume_i * shrink * b.size;

      if (distance_squared < kCoveringDistance * kCoveringDistance * b.size * b.size)
        film.covering.emplace_back(std::min(i, j), std::max(i, j));
      if (barriers != nullptr && distance_squared < kDiscPerSize * kDiscPerSize * (a.size + b.size) * (a.size + b.size))
        film.touching.emplace_back(i, j);
    });
    film.sample[i] = sum;
  }

  for (std::size_t i = 0; i < elements.size(); ++i) {
    const double height = film.sample[i].height;
    elements[i].film = height - (1.0 - kLoneFilm) * own_height(film.volume[i], elements[i].size);
  }
}

SpreadLaw make_spread_law(double reduced_gravity, double water_viscosity, double fay_inertial, double fay_viscous,
                          double terminal_thickness) {
  // A lone element: d(s^4) / dt = 4 kappa 7 V / (2 pi mu), and r = eta s. With kappa = c_I g' t, r^4 = k_1^4 g' V t^2;
  // with kappa = c_V g' sqrt(t / nu) H', r^6 = k_nu^6 g' V^2 t^(3/2) / sqrt(nu).
  const double eta = kDiscPerSize, bell = kBellFactor / 2.0;
  const double inertial = std::pow(fay_inertial / eta, 4) * kBellMoment / (2.0 * bell);
  const double viscous = std::pow(fay_viscous / eta, 6) * kBellMoment / (4.0 * bell * bell * kOwnMobility);
  return {reduced_gravity, water_viscosity, inertial, viscous, terminal_thickness};
}

Eigen::Vector2d spread(const SpreadLaw& law, const FilmSample& sample, double volume, double dt,
                       SlickElement& element) {
  const double begin = element.age, end = begin + dt;
  element.age = end;
  if (element.film <= law.terminal_thickness) return Eigen::Vector2d::Zero();

  // Mobilities integrated over the step, m s: the smaller one rules (thin oil is held by the water's boundary layer).
  const double gravity = law.reduced_gravity * (1.0 - element.water);
  const double inertial = law.inertial * gravity * 0.5 * (end * end - begin * begin);
  const double thickness = sample.height - (1.0 - kOwnMobility) * own_height(volume, element.size);
  const double viscous = law.viscous * gravity * thickness * (2.0 / 3.0) *
                         (end * std::sqrt(end) - begin * std::sqrt(begin)) / std::sqrt(law.water_viscosity);
  const bool held_by_water = viscous < inertial;
  const double mobility = held_by_water ? viscous : inertial;

  // A lone element's s^4 (s^6) grows linearly in the integrated mobility: exact for any step. The push is cut alike.
  const double growth = mobility * std::max(sample.growth, 0.0) / (kBellMoment * element.size);
  const double power = held_by_water ? 6.0 : 4.0;
  const double factor = std::pow(1.0 + power * growth, 1.0 / power);
  const double cut = growth > 1e-9 ? (factor - 1.0) / growth : 1.0;
  const double others = std::max(sample.height - own_height(volume, element.size), 1e-300);
  const double most = std::sqrt(kMostOverlap * volume / others);
  const double squeezed = std::max(element.size * std::exp(-dt / kSqueezeTime), std::min(kLeastSize, element.size));
  const double least = element.contained ? squeezed : element.size;
  element.size = std::max(least, std::min(element.size * factor, most));

  Eigen::Vector2d push = -mobility * cut * Eigen::Vector2d(sample.gradient_x, sample.gradient_y);
  double limit = kMostPush * element.size;
  if (element.contained) limit = std::min(limit, std::sqrt(gravity * sample.height) * dt);
  const double length = push.norm();
  if (length > limit) push *= limit / length;
  return push;
}

}  // namespace pelagos
