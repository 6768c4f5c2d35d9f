#include "spill_surroundings.hpp"

#include <cmath>

namespace pelagos {

namespace {

constexpr int kDirections = 8, kRings = 16;  // of the search for open water beside a hull
constexpr double kFirstRing = 0.5;           // spacings; each ring is half as far again

}  // namespace

void SpillSurroundings::sample(std::span<const Eigen::Vector2d> positions, std::span<SurfaceState> states) const {
  if (positions.empty()) return;
  std::optional<Air::Moment> moment;
  if (sea_.air != nullptr) moment = sea_.air->at(sea_.time);
  std::optional<Eigen::Vector2d> driven;
  if (moment && moment->wind.law != WindLaw::kStress) driven = surface_.mean_velocity().head<2>();
  for (std::size_t i = 0; i < positions.size(); ++i) {
    states[i] = at(positions[i], moment ? &*moment : nullptr);
    if (driven) states[i].water_velocity += current_in_water(positions[i], states[i].height) - *driven;
  }
}

/// The part of the current that the water itself moves with.
Eigen::Vector2d SpillSurroundings::current_in_water(const Eigen::Vector2d& position, double height) const {
  if (sea_.current == nullptr) return Eigen::Vector2d::Zero();
  const Eigen::Vector3d place(position.x(), position.y(), height);
  return (sea_.current->velocity_at(place, sea_.time) - sea_.current->unresolved_velocity_at(place, sea_.time))
      .head<2>();
}

SurfaceState SpillSurroundings::at(const Eigen::Vector2d& position, const Air::Moment* moment) const {
  SurfaceState state;
  const Eigen::Vector2d local = position - origin_.head<2>();
  const auto surface = surface_.at(local);
  state.water = surface.has_value();
  state.height = (surface ? surface->height : 0.0) + origin_.z();
  if (surface) state.water_velocity = surface->velocity.head<2>();
  if (sea_.current != nullptr)
    state.water_velocity +=
        sea_.current->unresolved_velocity_at({position.x(), position.y(), state.height}, sea_.time).head<2>();
  if (moment != nullptr) {
    state.wind = sea_.air->reference(*moment, {local.x(), local.y(), sea_.air->local_level()}).head<2>();
  }
  if (!sea_.bodies.empty()) find_way_out(position, state);
  return state;
}

void SpillSurroundings::find_way_out(const Eigen::Vector2d& position, SurfaceState& state) const {
  const auto covered = [&](const Eigen::Vector2d& place) {
    return sea_.bodies.covers({place.x(), place.y(), state.height}, 0.25 * spacing_);
  };
  state.covered = covered(position);
  if (!state.covered) return;
  double distance = kFirstRing * spacing_;
  for (int ring = 0; ring < kRings; ++ring, distance *= 1.5)
    for (int k = 0; k < kDirections; ++k) {
      const double angle = 2.0 * M_PI * k / kDirections;
      const Eigen::Vector2d way = distance * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      if (covered(position + way)) continue;
      state.way_out = way;
      return;
    }
}

}  // namespace pelagos
