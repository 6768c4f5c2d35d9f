#pragma once

#include <span>
#include <vector>

#include "physics/particles.hpp"

namespace pelagos::validation {

/// The water's surface over the length of a patch, as means over its width, in bins of two spacings.
struct SurfaceProfile {
  double bin = 0;                    ///< m
  std::vector<double> height, flow;  ///< m, of the highest particles; m/s, their mean velocity along x. NaN: no water
};

/// What a surface does that a height over the plane cannot show, and where.
struct Overhang {
  int cells = 0;   ///< columns of 2 x 2 spacings in which water stands over a gap
  double y = 0.0;  ///< m, of the slice with the most of them
};

/// Two crests that run towards each other.
struct Meeting {
  double depth = 0.0;  ///< m, of the trough between them under the lower crest; 0: there are no two such crests
};

/// Columns of 2 x 2 spacings over the plan of a patch from (x0, y0), m.
struct PlanGrid {
  double x0 = 0, y0 = 0, spacing = 0;
  int columns = 0, rows = 0;  ///< along x and y
};
[[nodiscard]] PlanGrid plan_grid(double x0, double y0, double length, double width, double spacing);

[[nodiscard]] SurfaceProfile surface_profile(const PlanGrid& grid, std::span<const Float4> position,
                                             std::span<const Float4> velocity);

/// A column overhangs where at least three particles stand over a gap of more than three spacings: more than a drop.
[[nodiscard]] Overhang find_overhang(const PlanGrid& grid, std::span<const Float4> position);

/// The deepest trough between two crests of the smoothed profile whose water moves towards each other; the three bins
/// at either end, where waves turn round at the wall, are left out.
[[nodiscard]] Meeting find_meeting(const SurfaceProfile& profile);

}  // namespace pelagos::validation
