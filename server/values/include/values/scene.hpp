#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "values/wind.hpp"

namespace pelagos {

// A scene that has passed validation: SI units, world frame ENU (x east, y north, z up), right-handed.
// Whoever receives a Scene may trust every value in it; proto/scene.proto states the ranges.

/// Axis-aligned box, metres. For a tank: closed on all six sides.
struct Box {
  Eigen::Vector3d min = Eigen::Vector3d::Zero();
  Eigen::Vector3d max = Eigen::Vector3d::Zero();
  [[nodiscard]] Eigen::Vector3d size() const { return max - min; }
};

/// Which pressure scheme advances the water. More follow behind the same choice.
enum class SolverKind { kHybrid };

/// How the linear complementarity problem of each constraint is solved.
enum class PressureMethod {
  kConjugateGradient,  ///< projected conjugate gradients, filtered warm start (default)
  kJacobi,             ///< damped Jacobi, clamped accumulated pressure, warm start
};

/// Stop rule and bounds of one constraint. Tolerances are fractions of the rest density.
struct ConstraintSettings {
  double tolerance = 3e-4;
  int min_iterations = 2;
  int max_iterations = 100;
};

struct SolverSettings {
  SolverKind kind = SolverKind::kHybrid;
  PressureMethod method = PressureMethod::kConjugateGradient;
  ConstraintSettings density;
  ConstraintSettings divergence{3e-4, 1, 100};
};

/// dt = min(max_step, cfl d / max|v + dt_prev a|), shortened to land on frame times.
/// max_step <= 0 means 0.07 sqrt(d / g).
struct TimeStepSettings {
  double cfl = 0.4;
  double max_step = 0.0;
};

struct FluidSettings {
  double rest_density = 1000.0;       ///< kg/m^3
  double kinematic_viscosity = -1.0;  ///< m^2/s; negative means 0.01 (d / 0.05 m)^1.5, the least that stays stable
  std::vector<Box> blocks;            ///< particles at d, 2d, ... from the min corner: size/d - 1 along each axis
  int settle_steps = 0;               ///< position-only relaxation steps before time zero
};

enum class BodyDrive {
  kStatic,  ///< stays where the scene puts it
  kPose,    ///< follows poses received from outside; holds its first pose until one arrives
};

/// A rigid body whose surface is sampled with boundary particles.
struct BodySettings {
  std::uint32_t id = 0;  ///< unique, >= 1; own ship is 1 by convention
  std::string name;
  std::string mesh_file;  ///< absolute path; body axes x forward, y port, z up (see docs), metres
  double mesh_scale = 1.0;
  double sample_inset = 0.6;  ///< samples lie this many spacings inside the surface
  BodyDrive drive = BodyDrive::kPose;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();               ///< m, world frame, of the body's origin
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< body to world
};

/// The sea outside the simulated patch: visual only. Heights by Beaufort number, direction waves run TOWARDS.
struct FarSeaSettings {
  int beaufort = 0;
  double wave_to_deg = 0.0;  ///< clockwise from north
  std::uint32_t components = 24;
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
  double particle_spacing = 0.05;  ///< d, metres
  double gravity = 9.81;           ///< m/s^2, along -z; 0 allowed
  Box tank;
  bool tank_walls_visible = false;
  FluidSettings water;
  SolverSettings solver;
  TimeStepSettings time_step;
  std::optional<WindSettings> wind;
  std::vector<BodySettings> bodies;
  FarSeaSettings far_sea;
  GeodeticOrigin origin;
  SurfaceSettings surface;
  double frame_interval = 1.0 / 30.0;  ///< s
};

}  // namespace pelagos
