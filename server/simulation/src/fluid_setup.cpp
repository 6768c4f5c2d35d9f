#include "simulation/fluid_setup.hpp"

#include <algorithm>
#include <cmath>

#include "scales/scales.hpp"
#include "simulation/deep_water.hpp"
#include "values/lattice.hpp"

namespace pelagos {

namespace {

/// Spacings outside a hull within which the rim of an open sea has no particle.
constexpr double kHullClearance = 0.4;

SolveMethod solve_method(PressureMethod method) {
  switch (method) {
    case PressureMethod::kConjugateGradient:
      return SolveMethod::kConjugateGradient;
    case PressureMethod::kJacobi:
      return SolveMethod::kJacobi;
    case PressureMethod::kPaper:
      return SolveMethod::kPaper;
  }
  return SolveMethod::kConjugateGradient;
}

Scheme scheme_of(SolverKind kind) {
  switch (kind) {
    case SolverKind::kHybrid:
      return Scheme::kHybrid;
    case SolverKind::kDfsph:
      return Scheme::kDfsph;
    case SolverKind::kPbf:
      return Scheme::kPbf;
    case SolverKind::kCorrected:
      return Scheme::kCorrected;
  }
  return Scheme::kHybrid;
}

Edge edge_of(PatchEdge edge) {
  switch (edge) {
    case PatchEdge::kWall:
      return Edge::kWall;
    case PatchEdge::kMirror:
      return Edge::kMirror;
    case PatchEdge::kPeriodic:
      return Edge::kPeriodic;
    case PatchEdge::kOpen:
      return Edge::kOpen;
  }
  return Edge::kWall;
}

SolveSettings solve_settings(const ConstraintSettings& constraint, const SolverSettings& solver) {
  SolveSettings settings;
  settings.method = solve_method(solver.method);
  settings.jacobi_damping = solver.relaxation;
  settings.warm_start = solver.warm_start;
  settings.tolerance = constraint.tolerance;
  settings.min_iterations = constraint.min_iterations;
  settings.max_iterations = constraint.max_iterations;
  return settings;
}

/// Oil's particles have to be kept calm like the water's: where the solver needs a kinematic viscosity for that, oil
/// has at least the same.
PhaseParameters phase_parameters(const OilProperties& oil, double water_viscosity) {
  return {oil.density, std::max(oil.viscosity, oil.density * water_viscosity)};
}

/// Whether no particle starts at a point (m, world).
bool starts_empty(const Bodies& bodies, const Eigen::Vector3d& x, double spacing) {
  return bodies.leaves_no_room(x, spacing) || bodies.keeps_dry(x);
}

/// Adds the local positions of a block's particles, those inside hulls left out.
void fill_block(const Scene& scene, const Box& block, const Bodies& bodies, const PatchFrame& frame,
                std::vector<Float4>& positions) {
  const double d = scene.particle_spacing;
  const PatchEdges edges = water_edges(scene);
  const auto counts = lattice_counts(block, d, edges);
  const Eigen::Vector3d first =
      block.min + d * Eigen::Vector3d(lattice_offset(edges[0]), lattice_offset(edges[1]), lattice_offset(edges[2]));
  for (std::int64_t k = 0; k < counts[2]; ++k)
    for (std::int64_t j = 0; j < counts[1]; ++j)
      for (std::int64_t i = 0; i < counts[0]; ++i) {
        const Eigen::Vector3d x =
            first + d * Eigen::Vector3d(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
        if (starts_empty(bodies, x, d)) continue;
        const Eigen::Vector3f local = frame.to_local(x).cast<float>();
        positions.push_back({local.x(), local.y(), local.z(), 0.0F});
      }
}

}  // namespace

bool is_in_hull(const Bodies& bodies, const Eigen::Vector3d& x, double spacing) {
  return !bodies.empty() && (bodies.covers(x, kHullClearance * spacing) || bodies.keeps_dry(x));
}

FluidParameters fluid_parameters(const Scene& scene, const PatchFrame& frame) {
  const Box box = frame.local_box();
  FluidParameters p;
  p.spacing = scene.particle_spacing;
  p.support_radius = scene.support_radius * p.spacing;
  p.rest_density = scene.water.rest_density;
  p.viscosity = scene.water.kinematic_viscosity >= 0.0 ? scene.water.kinematic_viscosity
                                                       : default_viscosity(scene.solver.kind, p.spacing);
  if (scene.oil && scene.oil->model != OilModel::kSlick) p.oil = phase_parameters(scene.oil->properties, p.viscosity);
  p.gravity = scene.gravity;
  for (int axis = 0; axis < 3; ++axis) {
    p.patch.min[axis] = static_cast<float>(box.min[axis]);
    p.patch.max[axis] = static_cast<float>(box.max[axis]);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) p.edges[axis] = edge_of(water_edges(scene)[axis]);
  if (is_open(scene.patch_edges)) p.edges[2] = Edge::kOpen;  // the floor is FluidState::floor
  apply_solver(scene.solver, p);
  p.filter *= depth_measures(p.scheme, depth_in_spacings(scene)).filter_factor;
  return p;
}

void apply_solver(const SolverSettings& solver, FluidParameters& parameters) {
  parameters.scheme = scheme_of(solver.kind);
  parameters.filter = solver.filter;
  parameters.density = solve_settings(solver.density, solver);
  parameters.divergence = solve_settings(solver.divergence, solver);
}

double largest_time_step(const Scene& scene) {
  if (scene.time_step.max_step > 0.0) return scene.time_step.max_step;
  const double usual = usual_step(scene.particle_spacing, scale_gravity(scene.gravity));
  return usual * depth_measures(scheme_of(scene.solver.kind), depth_in_spacings(scene)).step_factor;
}

StartingParticles place_blocks(const Scene& scene, const Bodies& bodies, const PatchFrame& frame) {
  StartingParticles start;
  for (const Box& block : scene.water.blocks) fill_block(scene, block, bodies, frame, start.position);
  if (!scene.oil || scene.oil->model == OilModel::kSlick) return start;
  start.phase.assign(start.position.size(), kWaterPhase);
  for (const Box& block : scene.oil->blocks) fill_block(scene, block, bodies, frame, start.position);
  start.phase.resize(start.position.size(), kOilPhase);
  return start;
}

StartingParticles place_open_sea(const OpenSeaWater& water, double spacing, const Bodies& bodies,
                                 const PatchFrame& frame) {
  StartingParticles start;
  for (std::size_t i = 0; i < water.position.size(); ++i) {
    const Float4& local = water.position[i];
    const Eigen::Vector3d x = frame.to_world(Eigen::Vector3d(vector_of(local).cast<double>()));
    if (water.label[i].w != kHeld && starts_empty(bodies, x, spacing)) continue;
    start.position.push_back(local);
    start.velocity.push_back(water.velocity[i]);
    start.label.push_back(water.label[i]);
  }
  return start;
}

}  // namespace pelagos
