#pragma once

#include <Eigen/Core>
#include <vector>

#include "physics/fluid.hpp"
#include "simulation/bodies.hpp"
#include "simulation/open_sea.hpp"
#include "values/patch_frame.hpp"
#include "values/scene.hpp"

namespace pelagos {

/// The scene's numbers as physics takes them, defaults filled in. @param frame  of the patch
[[nodiscard]] FluidParameters fluid_parameters(const Scene& scene, const PatchFrame& frame);

/// Sets scheme, methods and tolerances.
void apply_solver(const SolverSettings& solver, FluidParameters& parameters);

/// Largest time step: the scene's, or 0.07 sqrt(d / g), less in deep water (see deep_water.hpp). Without gravity
/// that of standard gravity.
[[nodiscard]] double largest_time_step(const Scene& scene);

/// Particles at the start.
struct StartingParticles {
  std::vector<Float4> position;     ///< m, local
  std::vector<std::uint8_t> phase;  ///< one a particle; empty in a scene without oil
  std::vector<Float4> velocity;     ///< m/s; empty: at rest
  std::vector<Float4> label;        ///< see FluidParticles; empty where no edge is open
};

/// The particles of all blocks, those inside hulls left out: the water's, then the oil's.
[[nodiscard]] StartingParticles place_blocks(const Scene& scene, const Bodies& bodies, const PatchFrame& frame);

/// Whether a point (m, world) lies in a hull or so near to it that no particle of the rim stands there, or in a dry
/// hold.
[[nodiscard]] bool is_in_hull(const Bodies& bodies, const Eigen::Vector3d& x, double spacing);

/// The particles of an open sea in its waves, those inside hulls left out, but for the rim's (rim_gaps.hpp).
[[nodiscard]] StartingParticles place_open_sea(const OpenSeaWater& water, double spacing, const Bodies& bodies,
                                               const PatchFrame& frame);

}  // namespace pelagos
