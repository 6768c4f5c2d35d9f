#pragma once

#include <Eigen/Core>
#include <span>

#include "surface/water_columns.hpp"
#include "values/current.hpp"
#include "values/patch_frame.hpp"
#include "waves/patch_blend.hpp"
#include "waves/wave_field.hpp"

namespace pelagos {

/// What the surface is made of, besides the particles.
struct SurfaceSurroundings {
  PatchFrame frame;
  Region patch;  ///< m, local
  /// Over which the wave field passes into the particles. Walls part the two: no blend, a step at the wall.
  PatchBlend blend;
};

// How the particles' surface and the wave field's become one. No particles are needed, so it may be done on any thread.

/// The particles' share of the surface, 0..1; 0 for places that are not finite.
[[nodiscard]] double particle_share(const SurfaceSurroundings& around, const Eigen::Vector2d& local);

/// The wave field's surface at places, all of them finite: `readings` has one for each. Far places are read about
/// anchors of their own, so that single precision tells them from each other as well as near ones: within 0.4 mm.
void read_waves(const SurfaceSurroundings& around, const WaveField& sea, double time,
                std::span<const SurfacePlace> places, std::span<SurfaceReading> readings);

/// Completes readings of the particles by the wave field's share. A place that is dry by the particles stays dry where
/// they alone count, and is the wave field's elsewhere. Places that are not finite stay as they are.
/// @param readings  of the particles, where they have a share
void mix_with_waves(const SurfaceSurroundings& around, const WaveField& sea, double time,
                    std::span<const SurfacePlace> places, std::span<SurfaceReading> readings);

/// m/s: what a reading at `position` (m, world) lacks of a current. The wave field makes none of it, the particles the
/// part along periodic axes.
[[nodiscard]] Eigen::Vector3d missing_current(const SurfaceReading& reading, const Current& current,
                                              const Eigen::Vector3d& position, double time);

}  // namespace pelagos
