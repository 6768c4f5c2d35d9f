#include "validate_scene.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "messages/read_current.hpp"
#include "messages/read_probe.hpp"
#include "messages/read_sea.hpp"
#include "messages/read_waves.hpp"
#include "messages/read_wind.hpp"
#include "scales/scales.hpp"
#include "scene.pb.h"
#include "values/lattice.hpp"
#include "values/sea_request.hpp"

namespace pelagos {
namespace {

constexpr double kMostWallParticles = 4e6;
constexpr double kMostCells = 64e6;  // of the neighbour search, a support radius a side

bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.';
}

std::string read_name(const FieldReader& reader, const SceneSource& source) {
  std::string name = source.default_name.substr(0, 64);
  std::replace_if(name.begin(), name.end(), std::not_fn(is_name_character), '_');
  if (!reader.read("name", 64, name)) return name;
  if (!std::all_of(name.begin(), name.end(), is_name_character)) {
    reader.fault("name", "\"" + name + "\" holds other characters than allowed: A-Z a-z 0-9 _ - .");
  }
  return name;
}

Basis read_basis(const FieldReader& reader, const SceneSource& source, Scene& scene) {
  Basis basis;
  reader.require("particle_spacing");
  if (reader.read("particle_spacing", {0.001, 100.0, "m"}, scene.particle_spacing)) {
    if (source.particle_spacing) scene.particle_spacing = *source.particle_spacing;
    basis.spacing = scene.particle_spacing;
  }
  const bool gravity_given = reader.has("gravity");
  if (reader.read("gravity", {0.0, 100.0, "m/s^2"}, scene.gravity) || !gravity_given) basis.gravity = scene.gravity;
  if (basis.spacing && basis.gravity && *basis.gravity > 0.0) {
    basis.default_step = usual_step(*basis.spacing, *basis.gravity);
  }
  reader.read("support_radius", {1.4, 2.5, "spacings", "below, water explodes; above, rows of neighbours get too long"},
              scene.support_radius);
  basis.support_radius = scene.support_radius;
  return basis;
}

PatchEdge read_edge(const FieldReader& reader, const char* axis) {
  switch (reader.read_enum(axis)) {
    case proto::v1::PatchEdges::MIRROR:
      return PatchEdge::kMirror;
    case proto::v1::PatchEdges::PERIODIC:
      return PatchEdge::kPeriodic;
    case proto::v1::PatchEdges::OPEN:
      return PatchEdge::kOpen;
    default:
      return PatchEdge::kWall;
  }
}

constexpr const char* kAxes[] = {"x", "y", "z"};

const char* name_of(PatchEdge edge) { return edge == PatchEdge::kPeriodic ? "PERIODIC" : "OPEN"; }

/// A periodic side must hold a whole number of spacings, or the lattice would not meet itself; an open one moves by
/// whole spacings.
PatchEdges read_edges(const FieldReader& reader, const Basis& basis, const std::optional<Box>& patch) {
  PatchEdges edges = kWallsAround;
  if (!reader.has("patch_edges")) return edges;
  const FieldReader entry = reader.child("patch_edges");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    edges[axis] = read_edge(entry, kAxes[axis]);
    const bool whole = edges[axis] == PatchEdge::kPeriodic || edges[axis] == PatchEdge::kOpen;
    if (!whole || !patch || !basis.spacing) continue;
    const double side = patch->size()[static_cast<int>(axis)], count = side / *basis.spacing;
    if (std::fabs(count - std::round(count)) <= 1e-6) continue;
    entry.fault(kAxes[axis], std::string("is ") + name_of(edges[axis]) + ", but the patch's side of " +
                                 format_number(side) + " m is no whole number of spacings; nearest allowed: " +
                                 format_number(std::floor(count) * *basis.spacing) + " or " +
                                 format_number(std::ceil(count) * *basis.spacing) + " m");
  }
  return edges;
}

/// Of the faces that the solver samples.
void refuse_many_wall_particles(const FieldReader& reader, const Box& patch, double spacing, const PatchEdges& edges) {
  const Eigen::Vector3d sides = patch.size() / spacing;
  double walls = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (edges[axis] == PatchEdge::kWall) walls += 2.0 * sides.prod() / sides[static_cast<int>(axis)];
  if (!(walls > kMostWallParticles)) return;
  reader.child("patch").fault("", "needs about " + format_count(std::round(walls)) +
                                      " wall particles at this spacing; allowed: " + format_count(kMostWallParticles) +
                                      " (a larger particle_spacing or a smaller patch)");
}

std::optional<Box> read_patch(const FieldReader& reader, const Basis& basis) {
  if (!reader.require("patch")) return std::nullopt;
  const FieldReader patch_reader = reader.child("patch");
  const std::optional<Box> patch = read_box(patch_reader);
  if (!patch || !basis.spacing) return patch;
  const Eigen::Vector3d sides = patch->size() / *basis.spacing;
  const double least = std::max(4.0, 2.0 * basis.support_radius);
  if (sides.minCoeff() < least - 1e-6) {
    patch_reader.fault("", "is " + format_number(patch->size().minCoeff()) + " m at its narrowest; allowed: at least " +
                               format_number(least * *basis.spacing) + " m (" + format_number(least) +
                               " particle spacings: the support of a kernel)");
  }
  const double cells = sides.prod() / std::pow(basis.support_radius, 3.0);
  if (cells > kMostCells) {
    patch_reader.fault("", "needs about " + format_count(std::round(cells)) +
                               " search cells at this spacing; allowed: " + format_count(kMostCells) +
                               " (a larger particle_spacing or a smaller patch)");
  }
  return patch;
}

/// @param longest_step  s, that any step of the scene may take; 0 where it is not known
void read_viscosity(const FieldReader& water, const Basis& basis, SolverKind solver, double longest_step,
                    FluidSettings& fluid) {
  double largest = 1e4;
  if (basis.spacing && longest_step > 0.0) largest = 0.1 * *basis.spacing * *basis.spacing / longest_step;
  water.read("kinematic_viscosity", {0.0, largest, "m^2/s", "0.1 d^2 / max_step: above it a step is unstable"},
             fluid.kinematic_viscosity);
  const double default_value = default_viscosity(solver, basis.spacing.value_or(0.0));
  if (!water.has("kinematic_viscosity") && default_value > largest) {
    water.fault("kinematic_viscosity", "defaults to " + format_number(default_value) +
                                           ", too much for so long a step; give one: 0 to " + format_number(largest) +
                                           " m^2/s");
  }
}

FluidSettings read_water(const FieldReader& reader, const Basis& basis, const Scene& scene, BlockReader& blocks) {
  FluidSettings fluid;
  if (!reader.require("water")) return fluid;
  const FieldReader water = reader.child("water");
  water.read("rest_density", {500.0, 2000.0, "kg/m^3"}, fluid.rest_density);
  const double own_step = scene.time_step.max_step > 0.0 ? scene.time_step.max_step : basis.default_step.value_or(0.0);
  read_viscosity(water, basis, scene.solver.kind, std::max(own_step, scene.governor.largest_step), fluid);
  water.read("settle_steps", {0, 5000}, fluid.settle_steps);
  if (water.require("block")) fluid.blocks = blocks.read(water, "water");
  return fluid;
}

void read_wind_of_scene(const FieldReader& reader, const Basis& basis, Scene& scene) {
  if (!reader.has("wind")) return;
  scene.wind = read_wind(reader.child("wind"));
  if (basis.gravity && *basis.gravity == 0.0) {
    reader.fault("wind",
                 "blows without gravity; allowed: gravity above 0 (the push scales with sqrt(d/g)), or no wind");
  }
}

std::vector<ProbeSettings> read_probes(const FieldReader& reader, const std::optional<CommandSurroundings>& commands) {
  std::vector<ProbeSettings> probes;
  const std::vector<FieldReader> entries = reader.children("probe");
  if (entries.size() > kMostProbes) {
    reader.fault("probe",
                 "has " + std::to_string(entries.size()) + " entries; allowed: at most " + std::to_string(kMostProbes));
    return probes;
  }
  for (const FieldReader& entry : entries) {
    const std::size_t faults = entry.fault_count();
    const ProbeSettings probe = read_set_probe(entry).probe;
    const bool taken =
        std::any_of(probes.begin(), probes.end(), [&](const ProbeSettings& other) { return other.id == probe.id; });
    if (taken && probe.id != 0) entry.fault("id", std::to_string(probe.id) + " is taken by another probe");
    const auto refusal =
        commands && entry.fault_count() == faults ? find_refusal(SetProbe{probe}, *commands) : std::nullopt;
    if (refusal) entry.fault(refusal->field.c_str(), refusal->what);
    probes.push_back(probe);
  }
  return probes;
}

/// The literal iteration of PBF moves particles one constraint at a time: a body would not be part of it.
void check_bodies_against_solver(const FieldReader& reader, const Scene& scene) {
  const bool literal = scene.solver.kind == SolverKind::kPbf && scene.solver.method == PressureMethod::kPaper;
  const bool any = std::any_of(scene.bodies.begin(), scene.bodies.end(),
                               [](const BodySettings& body) { return is_free(body.drive); });
  if (literal && any)
    reader.fault("solver",
                 "is PBF with method PAPER, which cannot push bodies; allowed with drive FREE or "
                 "POSE_HORIZONTAL: any other solver, or PBF with another method");
}

/// The sea around by one way of three: waves, systems, or a Beaufort number.
void check_ways_of_far_sea(const FieldReader& entry) {
  if (entry.has("wave") && entry.has("system"))
    entry.fault("system", "is given beside waves; allowed: one or the other");
  const auto refuse_beside = [&](const char* way, const char* named, std::initializer_list<const char*> fields) {
    for (const char* field : fields)
      if (entry.has(way) && entry.has(field))
        entry.fault(field, std::string("is given beside ") + named + "; allowed: one or the other");
  };
  refuse_beside("wave", "waves", {"beaufort", "wave_to_deg", "components"});
  refuse_beside("wave", "waves", {"wind_sea"});
  refuse_beside("system", "systems", {"beaufort", "wave_to_deg"});
  refuse_beside("wind_sea", "wind_sea", {"beaufort", "wave_to_deg"});
  for (const char* field : {"seed", "shortest_length"})
    if (!entry.has("system") && !entry.has("wind_sea") && entry.has(field))
      entry.fault(field, "is of systems; allowed: with system { } or wind_sea { }");
}

void read_far_sea(const FieldReader& reader, double gravity, FarSeaSettings& far_sea) {
  const FieldReader entry = reader.child("far_sea");
  const std::size_t faults = entry.fault_count();
  check_ways_of_far_sea(entry);
  far_sea.waves = read_waves(entry);
  const bool by_systems = entry.has("system") || entry.has("wind_sea");
  if (by_systems) far_sea.sea = read_sea(entry);
  std::optional<Refusal> refusal;
  if (entry.fault_count() == faults)
    refusal = by_systems ? find_sea_refusal(*far_sea.sea, gravity) : find_wave_refusal(far_sea.waves, gravity);
  if (refusal) entry.fault(*refusal);
  entry.read("beaufort", {0, 12, "Beaufort"}, far_sea.beaufort);
  entry.read("wave_to_deg", {0.0, 360.0, "degrees clockwise from north, where the waves run to"}, far_sea.wave_to_deg);
  if (!by_systems) entry.read("components", {1, 128}, far_sea.components);
}

void read_origin(const FieldReader& reader, GeodeticOrigin& origin) {
  const FieldReader entry = reader.child("origin");
  entry.read("latitude_deg", {-89.9, 89.9, "degrees", "east and north have no meaning at the poles"},
             origin.latitude_deg);
  entry.read("longitude_deg", {-180.0, 180.0, "degrees"}, origin.longitude_deg);
  entry.read("height", {-1000.0, 10000.0, "m"}, origin.height);
}

void read_surface(const FieldReader& reader, const Basis& basis, SurfaceSettings& surface) {
  const FieldReader entry = reader.child("surface");
  entry.read("publish_all", surface.publish_all);
  entry.read("detection_threshold", {0.0, 1.0}, surface.detection_threshold);
  entry.read("halo", {0.0, basis.support_radius, "spacings", "neighbours reach no further"}, surface.halo);
}

}  // namespace

Scene validate_scene(const FieldReader& reader, const SceneSource& source) {
  Scene scene;
  scene.name = read_name(reader, source);
  reader.read("seed", scene.seed);
  reader.read("tank_walls_visible", scene.tank_walls_visible);

  const Basis basis = read_basis(reader, source, scene);
  const std::optional<Box> patch = read_patch(reader, basis);
  scene.patch = patch.value_or(Box{});
  scene.patch_edges = read_edges(reader, basis, patch);
  double frame_rate = 30.0;
  reader.read("frame_rate", {1.0, 240.0, "frames per second"}, frame_rate);
  scene.frame_interval = 1.0 / frame_rate;
  if (reader.read_enum("frame_times") == proto::v1::Scene::AT_STEPS) scene.frame_times = FrameTimes::kAtSteps;
  scene.time_step = validate_time_step(reader, basis);
  scene.solver = validate_solver(reader);
  if (patch && basis.spacing) refuse_many_wall_particles(reader, *patch, *basis.spacing, water_edges(scene));
  scene.governor = validate_governor(reader, basis, scene);
  if (reader.read_enum("on_fault") == proto::v1::Scene::RESTORE) scene.on_fault = FaultPolicy::kRestore;
  BlockReader blocks(basis, patch, water_edges(scene));
  scene.water = read_water(reader, basis, scene, blocks);
  scene.oil = validate_oil(reader, scene.water.rest_density, blocks);

  read_wind_of_scene(reader, basis, scene);
  if (reader.has("current")) scene.current = read_current(reader.child("current"));
  scene.bodies = validate_bodies(reader, patch, scene.patch_edges, source);
  check_bodies_against_solver(reader, scene);
  const auto commands = patch ? std::optional(command_surroundings(scene)) : std::nullopt;
  scene.probes = read_probes(reader, commands);
  EventSurroundings around{scene.wind, commands, {}, basis.gravity && *basis.gravity == 0.0};
  for (const ProbeSettings& probe : scene.probes) around.probes.push_back(probe.id);
  scene.events = validate_events(reader, around);
  read_far_sea(reader, command_surroundings(scene).gravity, scene.far_sea);
  read_origin(reader, scene.origin);
  if (patch && basis.spacing) validate_open_sea(reader, source, scene);
  read_surface(reader, basis, scene.surface);
  return scene;
}

}  // namespace pelagos
