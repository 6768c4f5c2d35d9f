#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scales/scales.hpp"
#include "shapes/mesh_name.hpp"
#include "values/command.hpp"
#include "values/current.hpp"
#include "values/frame_times.hpp"
#include "values/freedoms.hpp"
#include "values/height_grid.hpp"
#include "values/oil.hpp"
#include "values/probe.hpp"
#include "values/wave_settings.hpp"
#include "values/wind.hpp"

namespace pelagos {

// A scene that has passed validation: SI units, world frame ENU (x east, y north, z up), right-handed.
// Whoever receives a Scene may trust every value in it; proto/scene.proto states the ranges.

/// Axis-aligned box, metres.
struct Box {
  Eigen::Vector3d min = Eigen::Vector3d::Zero();
  Eigen::Vector3d max = Eigen::Vector3d::Zero();
  [[nodiscard]] Eigen::Vector3d size() const { return max - min; }
};

/// How the two faces of a patch across one axis close it.
enum class PatchEdge {
  kWall,      ///< bodies stop there. The corrected solver's water meets a mirror, that of the others boundary samples
  kMirror,    ///< a smooth plane: the water beyond is the mirror image
  kPeriodic,  ///< what leaves through one face enters through the other
  kOpen,      ///< the sea goes on: waves of the wave field run in and out. Across x and y; the floor then gives way too
};

/// For the axes x, y, z.
using PatchEdges = std::array<PatchEdge, 3>;
inline constexpr PatchEdges kWallsAround{PatchEdge::kWall, PatchEdge::kWall, PatchEdge::kWall};

/// Which pressure scheme advances the water.
enum class SolverKind {
  kHybrid,     ///< the paper's: position-based density constraint, then a divergence-free velocity
  kDfsph,      ///< Bender and Koschier 2015: both constraints on velocities
  kPbf,        ///< Macklin and Mueller 2013: positions only
  kCorrected,  ///< both constraints with corrected gradients and their exact adjoint: waves live
};

/// How the linear complementarity problem of each constraint is solved.
enum class PressureMethod {
  kConjugateGradient,  ///< projected conjugate gradients, filtered warm start (default)
  kJacobi,             ///< damped Jacobi, clamped accumulated pressure, warm start
  kPaper,              ///< literal: damped Jacobi, clamped increments, cold start; for the paper's figures
};

/// Stop rule and bounds of one constraint. Tolerances are fractions of the rest density.
struct ConstraintSettings {
  double tolerance = 3e-4;
  int min_iterations = 2;
  int max_iterations = 100;
};

struct SolverSettings {
  SolverKind kind = SolverKind::kCorrected;
  PressureMethod method = PressureMethod::kConjugateGradient;
  ConstraintSettings density{3e-4, 0, 100};     ///< corrected: the repair of positions
  ConstraintSettings divergence{3e-4, 2, 100};  ///< corrected: the velocity solve
  double relaxation = 0.5;                      ///< damping of the Jacobi methods, 0 to 0.9
  double warm_start = 1.0;  ///< share of the last pressure that a solve starts from, 0 to 1; not by the paper's method
  double filter = 3.0;      ///< corrected: strength of the velocity filter, no unit
};

/// The settings of a solver where a scene says nothing else. The corrected scheme repairs positions only when it must.
/// It takes at least two iterations for the velocity: over many periods a wave loses 2 % of its height a period with
/// one iteration and 0.2 % with two.
[[nodiscard]] inline SolverSettings default_solver(SolverKind kind) {
  SolverSettings solver;
  solver.kind = kind;
  if (kind == SolverKind::kCorrected) return solver;
  solver.density.min_iterations = 2;
  solver.divergence.min_iterations = 1;
  return solver;
}

/// m^2/s, for a particle spacing in m: none where the solver filters the particles' noise itself, else
/// 0.01 (d / 0.05 m)^1.5, the least that keeps them calm; far more than real water's 1e-6.
[[nodiscard]] inline double default_viscosity(SolverKind kind, double spacing) {
  return kind == SolverKind::kCorrected ? 0.0 : 0.01 * std::pow(spacing / 0.05, 1.5);
}

/// Keeps a frame rate by paying with accuracy, within these bounds. Off: the scene's own step and tolerances hold.
struct GovernorSettings {
  bool on = false;
  double frame_budget = 0.0;        ///< s of wall time that computing a frame may take; <= 0: 0.8 of the frame interval
  double largest_tolerance = 1e-2;  ///< no tolerance is raised above this
  double largest_step = 0.0;        ///< s, no time step is raised above this; <= 0: the scene's own max_step
};

/// What happens when a value stops being finite.
enum class FaultPolicy {
  kStop,     ///< the run ends cleanly, with a report
  kRestore,  ///< the last good state comes back and is tried again with smaller steps; three times in a row, then stop
};

/// dt = min(max_step, cfl d / max|v + dt_prev a|), shortened to land on frame times.
/// max_step <= 0 means 0.07 sqrt(d / g).
struct TimeStepSettings {
  double cfl = 0.4;
  double max_step = 0.0;
};

struct FluidSettings {
  double rest_density = kUsualWaterDensity;  ///< kg/m^3
  double kinematic_viscosity = -1.0;         ///< m^2/s; negative means default_viscosity
  std::vector<Box> blocks;                   ///< full of particles, see lattice_counts
  int settle_steps = 0;                      ///< position-only relaxation steps before time zero
};

/// What a scene's oil is made of.
enum class OilModel {
  kParticles,  ///< a second phase of particles: thick oil, its weight and its breaking up
  kSlick,      ///< a film on the water: thin oil, at hardly any cost; no particle is oil
  kBoth,       ///< both, and oil goes from one to the other by its thickness
};

/// The second liquid: one oil a scene.
struct OilSettings {
  OilProperties properties;
  std::vector<Box> blocks{};  ///< full of oil at the start; may be none
  OilModel model = OilModel::kParticles;
  std::uint32_t most_particles = 0;  ///< of oil; sources bring no more. 0: a quarter of the particles at the start
  double water_temperature = 15.0;   ///< degrees C
  bool evaporation = false;
  bool emulsification = false;
};

enum class BodyDrive {
  kStatic,          ///< stays where the scene puts it
  kPose,            ///< follows poses received from outside; holds its first pose until one arrives
  kFree,            ///< moves as the water and its weight push it
  kPoseHorizontal,  ///< place and heading follow poses; heave, roll and pitch are free
};

/// Whether a body goes where the water pushes it, at least in part.
[[nodiscard]] inline bool is_free(BodyDrive drive) {
  return drive == BodyDrive::kFree || drive == BodyDrive::kPoseHorizontal;
}
/// Whether it takes poses.
[[nodiscard]] inline bool is_led(BodyDrive drive) {
  return drive == BodyDrive::kPose || drive == BodyDrive::kPoseHorizontal;
}

/// Whether the hold of a body, room in it that water reaches over a rim only, starts with water in it where a block of
/// water goes through it.
enum class HoldStart {
  kDefault,  ///< dry; for STATIC bodies flooded
  kDry,
  kFlooded,
};

/// What a free body weighs: one of mass and density.
struct MassSettings {
  double mass = 0.0;                        ///< kg; 0: from the density
  double density = 0.0;                     ///< kg/m^3 of the volume that its mesh encloses; 0: the mass is given
  std::optional<Eigen::Vector3d> centre;    ///< m, body axes, of mass; none: of the volume
  std::optional<Eigen::Vector3d> gyration;  ///< m, radii about the axes through it; none: those of a solid
};

/// A rigid body whose surface is sampled with boundary particles.
struct BodySettings {
  std::uint32_t id = 0;  ///< unique, >= 1; own ship is 1 by convention
  std::string name;
  std::string mesh_file;               ///< absolute path; empty where there is a primitive
  std::optional<Primitive> primitive;  ///< in place of a mesh file
  double mesh_scale = 1.0;             ///< m per unit of the file
  MeshAxes mesh_axes = MeshAxes::kXForwardZUp;
  bool open = false;  ///< the mesh is one side of something larger; static bodies only
  /// Samples lie this many spacings inside the surface; nothing: by the mesh.
  std::optional<double> sample_inset;
  BodyDrive drive = BodyDrive::kPose;
  HoldStart hold = HoldStart::kDefault;
  MassSettings mass;                                                ///< of free bodies
  Freedoms freedoms;                                                ///< of bodies that the water pushes
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();               ///< m/s, world, at the start; of free bodies
  double free_from = 0.0;                                           ///< s, simulated: they hold their place until then
  Eigen::Vector3d position = Eigen::Vector3d::Zero();               ///< m, world frame, of the body's origin
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< body to world
};

/// The sea outside the simulated patch: visual only. Heights by Beaufort number, direction waves run TOWARDS.
struct FarSeaSettings {
  int beaufort = 0;
  double wave_to_deg = 0.0;  ///< clockwise from north
  std::uint32_t components = 24;
  std::vector<WaveSettings> waves = {};  ///< in place of the three above; none: by them
  std::optional<SeaSettings> sea = {};   ///< in place of all above
};

/// The bottom of an open sea where it is not level.
struct SeaBedSettings {
  HeightGrid heights;        ///< over the patch and a margin; empty: the bottom is level
  double blend_width = 0.0;  ///< m, from the zones inwards, over which the level bottom becomes this one
};

/// How a patch with open edges goes over into the sea around it.
struct OpenSeaSettings {
  double zone_width = 0.0;  ///< m, in which the water is drawn to the wave field; 0: 15 spacings
  double depth = 0.0;       ///< m, of the sea; 0: deeper than any wave reaches
  SeaBedSettings bed;
  std::uint32_t follow_body = 0;                              ///< its id: the patch stays around it; 0: none
  Eigen::Vector2d follow_velocity = Eigen::Vector2d::Zero();  ///< m/s: without a body the patch moves like this
  [[nodiscard]] bool follows() const { return follow_body != 0 || !follow_velocity.isZero(0.0); }
};

/// World origin on the WGS84 ellipsoid, degrees and metres.
struct GeodeticOrigin {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double height = 0.0;
};

struct SurfaceSettings {
  bool publish_all = false;           ///< true: every particle travels, not only the surface set
  double detection_threshold = 0.12;  ///< |mean neighbour position - position| / support radius
  double halo = 1.2;                  ///< neighbours within this many spacings of a kept particle are kept too
};

struct Scene {
  std::string name;
  std::uint64_t seed = 1;
  double particle_spacing = 0.05;     ///< d, metres
  double support_radius = 2.0;        ///< of the kernel, in spacings, 1.4 to 2.5
  double gravity = kStandardGravity;  ///< m/s^2, along -z; 0 allowed
  Box patch;                          ///< in which water is simulated
  PatchEdges patch_edges = kWallsAround;
  OpenSeaSettings open_sea;  ///< where edges are open
  bool tank_walls_visible = false;
  FluidSettings water;
  std::optional<OilSettings> oil;
  SolverSettings solver;
  TimeStepSettings time_step;
  GovernorSettings governor;
  FaultPolicy on_fault = FaultPolicy::kStop;
  std::optional<WindSettings> wind;
  std::optional<CurrentSettings> current;  ///< that the water starts with, along periodic axes
  std::vector<SceneEvent> events;          ///< in the order of the file
  std::vector<BodySettings> bodies;
  std::vector<ProbeSettings> probes;
  FarSeaSettings far_sea;
  GeodeticOrigin origin;
  SurfaceSettings surface;
  double frame_interval = 1.0 / 30.0;  ///< s
  FrameTimes frame_times = FrameTimes::kEven;
};

/// Whether the patch is a part of an open sea.
[[nodiscard]] inline bool is_open(const PatchEdges& edges) {
  return edges[0] == PatchEdge::kOpen || edges[1] == PatchEdge::kOpen;
}

}  // namespace pelagos
