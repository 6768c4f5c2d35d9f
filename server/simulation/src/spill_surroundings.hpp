#pragma once

#include "oil/slick_surroundings.hpp"
#include "simulation/oil_spill.hpp"
#include "simulation/open_water.hpp"
#include "values/patch_frame.hpp"

namespace pelagos {

/// The slick's window on water, air and hulls at one instant.
///
/// Oil drifts with the current and 3 % of the wind. The wind laws that raise a sea within seconds (GUST, PAPER) push
/// the surface of the patch far faster than that, so under them its mean velocity is taken off and the current put in
/// its place: what waves, hulls and walls do to the water around the oil stays, and the drift is the share of the wind.
///
/// Hulls and scenery are met at the height of the surface, and where that is below a hull's keel at the level at rest
/// as well, so that no oil stays under a hull.
class SpillSurroundings : public SlickSurroundings {
 public:
  /// @param level    m, world: the water's at rest
  /// @param spacing  m, d
  SpillSurroundings(const SpillSea& sea, const PatchFrame& frame, const SlickPatch& patch, double level, double spacing)
      : sea_(sea), frame_(frame), patch_(patch), level_(level), spacing_(spacing) {}

  void sample(std::span<const Eigen::Vector2d> positions, std::span<SurfaceState> states) const override;
  [[nodiscard]] Eigen::Vector2d go(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                                   const SurfaceState& state) const override;

 private:
  [[nodiscard]] SurfaceState at(const Eigen::Vector2d& position, const Air::Moment* moment) const;
  [[nodiscard]] Eigen::Vector2d current_in_water(const Eigen::Vector2d& position, double height) const;
  [[nodiscard]] OpenWater water_at(double height) const;
  void find_way_out(const Eigen::Vector2d& position, SurfaceState& state) const;

  const SpillSea& sea_;
  const PatchFrame& frame_;
  const SlickPatch& patch_;
  double level_, spacing_;
};

}  // namespace pelagos
