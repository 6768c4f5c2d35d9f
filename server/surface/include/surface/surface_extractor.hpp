#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "packing/surface_particle.hpp"
#include "physics/neighbors.hpp"
#include "physics/particles.hpp"
#include "physics/solids.hpp"
#include "physics/task_pool.hpp"
#include "scales/scales.hpp"
#include "surface/anisotropy.hpp"
#include "values/scene.hpp"

namespace pelagos {

/// What the surface is made from: the particles at the end of a step and the neighbour lists of that step. The lists
/// may have been built at slightly different positions; weights use the present ones.
struct SurfaceInput {
  const FluidParticles& fluid;
  const BoundaryParticles& boundary;
  const NeighborList& fluid_neighbors;
  const NeighborList& boundary_neighbors;  ///< boundary samples around fluid particles; may be empty
  double time = 0.0;                       ///< s, simulation time; for the decay of foam
  const SolidPlanes* solids = nullptr;     ///< of that step; null without
};

/// Scales that do not change during a run.
struct SurfaceScales {
  double spacing = 0.05;              ///< d, m, > 0
  double support_radius = 0.1;        ///< m, > 0
  double gravity = kStandardGravity;  ///< m/s^2; sets the speeds at which foam arises; the standard one where it is 0
};

/// Foam that a particle carries on.
struct FoamOfParticle {
  std::uint32_t id = 0;  ///< of the particle
  float amount = 0.0F;   ///< 0..1 at `time`
  float time = 0.0F;     ///< s, simulated

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("id", self.id);
    visit("amount", self.amount);
    visit("time", self.time);
  }
};

/// How many particles were taken, and why.
struct SurfaceCounts {
  std::uint32_t surface = 0;     ///< off-centre in their neighbourhood, or with few neighbours
  std::uint32_t halo = 0;        ///< near one of those
  std::uint32_t oil = 0;         ///< oil elsewhere: seen through clear water
  std::uint32_t not_finite = 0;  ///< left out: position or velocity is no number
};

/// Finds the particles that viewers need and shapes them. Owns its buffers; one extractor a simulation.
/// The result does not depend on the number of threads: each particle's values are computed by itself, in the order of
/// its neighbour list, and the set is in particle order.
class SurfaceExtractor {
 public:
  SurfaceExtractor(const SurfaceSettings& settings, const SurfaceScales& scales);

  /// First stage: which particles travel. A particle is taken where |mean neighbour position - position| / support
  /// radius exceeds the threshold (Yu & Turk's weights, paper eq. 44 and 45, boundary samples counted as neighbours, so
  /// that layers at walls, floor and hulls are not taken; what lies behind a solid's surface counts as full), or where
  /// it lies within `halo` spacings of one that is. All oil is taken, at any depth: there is little of it, and it is
  /// seen through the water. Drops, threads and sheets one particle thin, whose neighbours may surround them evenly,
  /// are taken by their number.
  void detect(const SurfaceInput& input, TaskPool& pool);

  /// Second stage: ellipsoid, velocity, foam and spray of the particles found by detect(), which must have been called
  /// with the same input. `particles` is overwritten and keeps its capacity.
  void shape(const SurfaceInput& input, TaskPool& pool, std::vector<SurfaceParticle>& particles);

  /// Indices of the set into the fluid, ascending; valid until the next detect().
  [[nodiscard]] std::span<const std::uint32_t> indices() const { return indices_; }
  [[nodiscard]] const SurfaceCounts& counts() const { return counts_; }

  /// By id: foam outlives its cause. What is too little to be seen is dropped, so there is never more of it than of
  /// particles that foamed in the last seconds, whatever flows in and out.
  [[nodiscard]] const std::vector<FoamOfParticle>& foam() const { return foam_; }
  void restore_foam(const std::vector<FoamOfParticle>& foam) { foam_ = foam; }

 private:
  void mark_halo(const SurfaceInput& input, TaskPool& pool);
  void collect(std::size_t count);
  [[nodiscard]] SurfaceParticle shape_particle(const SurfaceInput& input, std::size_t i, float& foam) const;

  SurfaceSettings settings_;
  SurfaceScales scales_;
  AnisotropySettings anisotropy_;
  std::vector<std::uint8_t> mark_;  ///< per particle: inside, surface, halo, oil, not finite
  std::vector<std::uint32_t> indices_;
  SurfaceCounts counts_;
  [[nodiscard]] float foam_left(std::uint32_t id, double time) const;
  [[nodiscard]] float faded(const FoamOfParticle& foam, double time) const;
  void remember_foam(const SurfaceInput& input);

  std::vector<FoamOfParticle> foam_, fresh_foam_;
  std::vector<float> foam_now_;  ///< of the particles found by detect()
};

}  // namespace pelagos
