#pragma once

#include <span>
#include <vector>

#include "rigid/body_shape.hpp"
#include "rigid/hydrostatics.hpp"
#include "simulation/hold.hpp"
#include "surface/water_columns.hpp"
#include "values/body.hpp"
#include "values/body_load.hpp"
#include "values/patch_frame.hpp"

namespace pelagos {

/// The box around a body that stands at a position, in the axes and from the origin of that position.
[[nodiscard]] Eigen::AlignedBox3d box_around(const BodyShape& shape, const Eigen::Vector3d& position,
                                             const Eigen::Quaterniond& orientation);

/// Places in a ring just outside a body, where the surface tells how the water stands around it; m, local.
/// @param frame  of the patch
[[nodiscard]] std::vector<SurfacePlace> ring_around(const BodyShape& shape, const BodyState& state,
                                                    const PatchFrame& frame);

/// The plane nearest to what was read there (dry places left out), body axes. Level at `still_level` (m, local) where
/// there is no water around the body.
[[nodiscard]] WaterPlane water_around(std::span<const SurfacePlace> ring, std::span<const SurfaceReading> readings,
                                      const BodyState& state, const PatchFrame& frame, double still_level);

/// Wetted volume and area, and what still water up to that plane would do to the body, into `load`; moments about
/// load.point. The plane is exact for waves that are long against the body, and a mean for others. Nothing for an open
/// mesh.
/// @param weight_density  N/m^3, of the water
void measure_buoyancy(const BodyShape& shape, const WaterPlane& water, double weight_density, BodyLoad& load);

/// Adds what a hold does: the air in its part below the plane bears the body like its own volume, and the water in it
/// weighs on it.
/// @param below       the part of the hold below the plane (Hold::below)
/// @param hold_water  the water in the hold now
void add_hold(const PartVolume& below, const PartVolume& hold_water, const WaterPlane& water, double weight_density,
              BodyLoad& load);

}  // namespace pelagos
