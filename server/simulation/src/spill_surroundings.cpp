#include "spill_surroundings.hpp"

#include <cmath>

namespace pelagos {

namespace {

constexpr double kRoom = 1.0;  ///< spacings: how far hulls are looked for around oil

}  // namespace

void SpillSurroundings::sample(std::span<const Eigen::Vector2d> positions, std::span<SurfaceState> states) const {
  if (positions.empty()) return;
  std::optional<Air::Moment> moment;
  if (sea_.air != nullptr) moment = sea_.air->at(sea_.time);
  std::optional<Eigen::Vector2d> driven;
  if (moment && moment->wind.law != WindLaw::kStress) driven = mean_velocity(sea_.surface).head<2>();
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
  const Eigen::Vector2d local = frame_.to_local(position);
  const auto surface = sample_at(sea_.surface, local);
  state.water = surface.has_value();
  state.height = surface ? frame_.world_height(surface->height) : level_;
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

OpenWater SpillSurroundings::water_at(double height) const {
  const bool sunken = height < level_ - 0.5 * spacing_;
  return {sea_.bodies, patch_, {height, sunken ? level_ : height}, spacing_};
}

void SpillSurroundings::find_way_out(const Eigen::Vector2d& position, SurfaceState& state) const {
  const OpenWater water = water_at(state.height);
  const double distance = water.distance(position, kRoom * spacing_);
  state.covered = distance < 0.0;
  if (!state.covered) {
    state.room = distance >= kRoom * spacing_ ? 0.5 * distance : 0.0;
    return;
  }
  if (!state.water) return;  // it lies dry, and stays
  const auto is_wet = [&](const Eigen::Vector2d& place) {
    return sample_at(sea_.surface, frame_.to_local(place)).has_value();
  };
  if (const auto way = water.way_out(position, state.water_velocity, is_wet)) state.way_out = *way;
}

Eigen::Vector2d SpillSurroundings::go(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                                      const SurfaceState& state) const {
  return water_at(state.height).go(from, to);
}

}  // namespace pelagos
