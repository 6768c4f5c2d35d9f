#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "physics/constraint_solve.hpp"
#include "physics/coupling.hpp"
#include "physics/floor.hpp"
#include "physics/ghosts.hpp"
#include "physics/grid.hpp"
#include "physics/held_water.hpp"
#include "physics/neighbor_search.hpp"
#include "physics/neighbors.hpp"
#include "physics/pair_passes.hpp"
#include "physics/particles.hpp"
#include "physics/phases.hpp"
#include "physics/solids.hpp"
#include "physics/step_report.hpp"
#include "physics/task_pool.hpp"
#include "scales/scales.hpp"

namespace pelagos {

/// Which pressure scheme advances the water. Each is a free function in a file of its own behind advance_fluid.
enum class Scheme {
  kHybrid,     ///< the paper's: position-based density constraint, then divergence-free velocity
  kDfsph,      ///< Bender and Koschier 2015: density constraint on velocities at the old positions, then divergence
  kPbf,        ///< Macklin and Mueller 2013: the position-based density constraint alone
  kCorrected,  ///< repair of positions, then one velocity solve with corrected gradients and their exact adjoint
};

/// sqrt(g/d): the corrected scheme's filter takes slower rotation for noise, see VelocityGradients. Eddies of calm
/// water turn with some 0.03; so water 15 layers deep came from a growing 0.04 to 0.012 sqrt(g d). All rotation,
/// however fast, would give 0.010, but cost a spinning patch 1.5 % of its energy in place of 0.2 and Taylor-Green
/// vortices half as much again of their rate.
inline constexpr double kWeakRotation = 0.05;

struct FluidParameters {
  double spacing = 0.05;                                             ///< d, m
  double support_radius = 0.1;                                       ///< m, 2 d
  double rest_density = kUsualWaterDensity;                          ///< kg/m^3
  double viscosity = 0.01;                                           ///< m^2/s, of the water
  std::optional<PhaseParameters> oil;                                ///< none: no particle is oil
  double gravity = kStandardGravity;                                 ///< m/s^2, along -z
  Region patch;                                                      ///< m, local
  std::array<Edge, 3> edges{Edge::kWall, Edge::kWall, Edge::kWall};  ///< how the faces across x, y, z close the patch
  Scheme scheme = Scheme::kHybrid;
  double filter = 3.0;                   ///< corrected scheme: strength of the velocity filter, no unit
  double weak_rotation = kWeakRotation;  ///< sqrt(g/d); 0: all rotation is kept
  SolveSettings density;
  SolveSettings divergence;

  [[nodiscard]] double volume() const { return spacing * spacing * spacing; }  ///< of a particle, m^3
};

/// Arrays of the implicit viscosity, kept between steps.
struct ViscositySolve {
  std::vector<Float4> residual, direction, image;  ///< m/s
};

/// What the water carries from step to step; everything else of a step can be computed again from it.
struct WaterState {
  FluidParticles particles;
  double last_dt = 0.0;       ///< s; 0 before the first step
  std::uint32_t next_id = 0;  ///< of the next particle that is added

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("particles", self.particles);
    visit("last_dt", self.last_dt);
    visit("next_id", self.next_id);
  }
};

/// The water and its walls, with everything that a step reuses. Local coordinates: metres from the world's origin.
struct FluidState : WaterState {
  FluidParameters parameters;
  BoundaryParticles walls;       ///< static samples first (cell order), moving ones after them (cell order)
  std::size_t static_walls = 0;  ///< how many of `walls` never move
  std::vector<Float4> moving_position, moving_velocity;  ///< as placed by whoever moves the bodies; V_b in w
  bool walls_move = false;  ///< some moving sample belongs to no body of `coupling`: its velocity counts by itself
  BodyCoupling coupling;    ///< rigid bodies, by their moving samples or by the solids that they are
  /// Solid surfaces that particles know by their distance, as placed by whoever moves the bodies; corrected scheme
  /// only. The first `face_count` of them are faces of the patch, which stay.
  std::vector<Solid> solids;
  std::size_t face_count = 0;
  Floor floor;     ///< as it is at the end of the step; corrected scheme only
  HeldWater held;  ///< corrected scheme only
  SolidPlanes solid_planes;
  bool gradients_present = false;  ///< lists and gradients belong to the present positions (dfsph needs them)
  bool density_present = false;    ///< the densities do; else start_acceleration computes them

  NeighborList fluid_list, wall_list;
  CellGrid fluid_grid, static_grid, moving_grid;
  Ghosts ghosts;
  Gradients gradients;
  Corrections corrections;               ///< corrected scheme only
  VelocityGradients velocity_gradients;  ///< corrected scheme only
  FilterChange filter_change;            ///< corrected scheme only
  PhasePair phases;                      ///< of the present order; scenes with oil only
  std::size_t oil_count = 0;             ///< oil particles at the last sort; 0: no pass knows of phases
  ViscositySolve viscosity;              ///< implicit viscosity only
  std::vector<float> source;
  SolveWorkspace work;
  std::vector<std::uint32_t> order;
  std::vector<Float4> sorted_record;
  std::vector<float> sorted_scalar;
  std::vector<std::uint32_t> sorted_id;
  std::vector<std::uint8_t> sorted_phase;
};

/// Whether the water meets surfaces that it knows by their distance.
[[nodiscard]] inline bool meets_surfaces(const FluidState& state) {
  return !state.solids.empty() || !state.floor.empty();
}

/// Builds the state: particles at the given local positions, at rest; walls of the patch sampled and sorted.
/// @param phase  of each particle; empty: all are water. Oil needs parameters.oil
[[nodiscard]] FluidState make_fluid(TaskPool& pool, const FluidParameters& parameters,
                                    std::span<const Float4> positions, std::span<const std::uint8_t> phase = {});

// Particles come and go between steps only: neighbour lists, densities' gradients and pressures belong to the particles
// before until the next step has been made.

/// Adds particles at the given local positions (w is ignored) and velocities, behind those that are there, in this
/// order. They get ids that no particle had before, no pressure, density 1 and gravity as acceleration.
/// @param velocities  m/s, as many as positions
/// @param phase       of all of them; kOilPhase needs parameters.oil
/// @param labels      as many as positions, in seas whose particles have them; else empty
void add_particles(FluidState& state, std::span<const Float4> positions, std::span<const Float4> velocities,
                   std::uint8_t phase, std::span<const Float4> labels = {});

/// Takes out every particle for whose index `unwanted` is true; the others keep their order and ids. Calls may come
/// from several threads. Returns how many were taken out.
std::size_t remove_particles(TaskPool& pool, FluidState& state, const std::function<bool(std::size_t)>& unwanted);

/// Lists the particles that are held, after labels have changed and after particles have come or gone.
void find_held(FluidState& state);

/// Puts the water into a state that it, or water of the same parameters, was in. The next step makes the same bits as
/// it made then. The samples of moving bodies are placed by whoever moves them.
void restore_water(FluidState& state, const WaterState& water);

/// Adds samples that never move (scenery) to the walls of the tank; V_b in w. Before the first step, without moving
/// walls. They are sorted once, here: where no water is near they cost nothing, elsewhere as much as a wall.
void add_static_walls(TaskPool& pool, FluidState& state, std::span<const Float4> samples);

/// Advances the water by dt with the chosen scheme: predict, sort, search, constraints. The accelerations of the last
/// step act (gravity in the first one). Successive steps should be of like size: a repair u of the density, about
/// tolerance times spacing, becomes the velocity u / dt, so a step of a hundredth of the last one adds energy. Moving
/// walls are read from moving_position / moving_velocity, which hold their state at the end of the step; for samples of
/// a body of `coupling` the body's own velocities count instead. Bodies answer in the solves that push the water: in
/// all but the corrected scheme's repair of positions, which is no force, and the literal iteration of pbf.
void advance_fluid(TaskPool& pool, FluidState& state, double dt, Clock clock, StepReport& report);

/// Gravity and viscosity into particles.acceleration, and the densities at the final positions where the scheme has
/// left them open; other forces are added by their own layers afterwards.
/// With oil, viscosity is explicit up to nu dt / d^2 = 0.1 (it fails at 0.2) for the larger kinematic viscosity nu and
/// the usual longest step 0.07 sqrt(d / g). Beyond that the velocities are changed at once instead: (1 - dt L) v =
/// v_old by conjugate gradients, where L v is the viscous acceleration and dt the step just made.
void start_acceleration(TaskPool& pool, FluidState& state, StepReport& report);

/// Errors, energies, largest speed of the present state into the report. `dt` is the step just made.
void measure_fluid(TaskPool& pool, const FluidState& state, double dt, StepReport& report);

/// Sorts the particles and finds neighbours and densities at their present positions. Each step does so by itself; what
/// looks at the water before the first step needs it.
void refresh_neighbors(TaskPool& pool, FluidState& state, StepReport& report);

/// Position-only relaxation: moves particles until the density constraint holds, without giving them velocity. Removes
/// the jump that a fresh lattice against sampled walls (6 % too dense) would make in its first step. The accelerations
/// are gravity and viscosity afterwards.
void settle_fluid(TaskPool& pool, FluidState& state, int steps);

/// The largest admissible time step for the coming step: min(max_step, cfl d / max|v + dt a|).
[[nodiscard]] double admissible_time_step(const FluidParameters& parameters, double cfl, double max_step,
                                          double largest_speed);

/// FNV-1a over the bits of positions and velocities in particle order: equal states have equal hashes.
[[nodiscard]] std::uint64_t state_hash(const FluidParticles& particles);

}  // namespace pelagos
