#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "oil/slick_settings.hpp"
#include "simulation/bodies.hpp"

namespace pelagos {

/// The water at one height among bodies, in the plane: how far their sides are, and how oil keeps off them. Sides are
/// met at the given heights, so a hull's flare or a sloping bed counts where the surface is.
class OpenWater {
 public:
  /// @param heights    m, world: a place is as near to a body as at the nearer of the two
  /// @param spacing    m, d: oil keeps a quarter of it away from bodies
  OpenWater(const Bodies& bodies, const SlickPatch& patch, const std::array<double, 2>& heights, double spacing)
      : bodies_(bodies), patch_(patch), heights_(heights), spacing_(spacing) {}

  /// Distance to the nearest body, m, negative inside one; no farther than +-limit.
  [[nodiscard]] double distance(const Eigen::Vector2d& place, double limit) const;

  /// Where oil ends that would go from an open place to another: at bodies and closed faces it stops, and goes on with
  /// the part of its way along them. In a corner it stays.
  [[nodiscard]] Eigen::Vector2d go(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;

  /// The shortest straight way from a place inside a body to open water, m. It goes through no body that the place is
  /// not in. Of equally short ones the one nearest to `preferred` (any length), so that the search prefers no side.
  /// Nothing where there is none.
  /// @param is_wet  whether there is water at a place
  [[nodiscard]] std::optional<Eigen::Vector2d> way_out(const Eigen::Vector2d& place, const Eigen::Vector2d& preferred,
                                                       const std::function<bool(const Eigen::Vector2d&)>& is_wet) const;

 private:
  [[nodiscard]] std::optional<Eigen::Vector2d> push_off(Eigen::Vector2d place, double clearance) const;
  /// Length of the way out in a direction, at most `most`.
  [[nodiscard]] std::optional<double> length_out(const Eigen::Vector2d& place, const Eigen::Vector2d& direction,
                                                 double most, const std::vector<std::uint8_t>& within,
                                                 const std::function<bool(const Eigen::Vector2d&)>& is_wet) const;
  void distances(const Eigen::Vector2d& place, double limit, std::vector<double>& each) const;

  const Bodies& bodies_;
  const SlickPatch& patch_;
  std::array<double, 2> heights_;
  double spacing_;
};

}  // namespace pelagos
