#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "harness.hpp"
#include "rigid/distance_field.hpp"
#include "solver_names.hpp"
#include "travelling_wave.hpp"
#include "waves.hpp"
#include "world_run.hpp"

namespace pelagos::validation {

namespace {

constexpr int kBedSettling = 100;  ///< relaxation steps, for the lattice cut by the bed
constexpr double kWaterDensity = 1000.0, kGravity = 9.81;

/// A sea bed, a sine along x.
struct Bed {
  double amplitude = 0.0, length = 1.0;  ///< m

  [[nodiscard]] double height(double x) const { return amplitude * std::sin(2.0 * M_PI * x / length); }
};

/// The bed's surface over [-margin, length + margin] x [-margin, width + margin].
TriangleMesh bed_mesh(const Bed& bed, double length, double width, double margin, double step) {
  TriangleMesh mesh;
  const int columns = static_cast<int>(std::ceil((length + 2.0 * margin) / step));
  for (int i = 0; i <= columns; ++i)
    for (const double y : {-margin, width + margin}) {
      const double x = -margin + i * step;
      mesh.vertices.emplace_back(x, y, bed.height(x));
    }
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(columns); ++i) {
    const std::uint32_t a = 2 * i, b = a + 1, c = a + 2, d = a + 3;
    mesh.triangles.push_back({a, c, d});
    mesh.triangles.push_back({a, d, b});
  }
  return mesh;
}

/// Water over the bed: what of a lattice stands above it. The lattice has a layer at d/2 above the flat bed.
Start fill_over(const Bed& bed, const TravellingWave& wave, const FluidParameters& parameters) {
  const double d = wave.spacing, below = std::ceil(bed.amplitude / d) * d;
  FluidParameters flat = parameters;
  flat.patch.min[2] = static_cast<float>(-below);
  Start start = fill_block(flat, {wave.length, wave.slice * d, wave.depth + below});
  std::erase_if(start.positions, [&](const Float4& p) {
    const double x = static_cast<double>(p.x), slope = 2.0 * M_PI * bed.amplitude / bed.length;
    const double steepness = slope * std::cos(2.0 * M_PI * x / bed.length);
    return (static_cast<double>(p.z) - bed.height(x)) / std::hypot(1.0, steepness) < 0.4 * d;
  });
  return start;
}

WaterRun start_over(int threads, const Bed& bed, const TravellingWave& wave, const std::string& solver) {
  const double d = wave.spacing, width = wave.slice * d;
  FluidParameters parameters = patch_parameters({wave.length, width, 1.5 * wave.depth + 4.0 * wave.amplitude}, d,
                                                {Edge::kPeriodic, Edge::kPeriodic, Edge::kMirror});
  parameters.patch.min[2] = static_cast<float>(-bed.amplitude - 6.0 * d);
  Start start = fill_over(bed, wave, parameters);
  const LinearWave linear{2.0 * M_PI / wave.length, wave.depth, parameters.gravity};
  start.velocities = start_wave(linear, wave.amplitude, false, start.positions);
  WaterRun run(threads, parameters, {solver}, start);
  const BodyShape shape =
      make_body_shape(bed_mesh(bed, wave.length, width, 6.0 * d, 0.5 * d), d, std::nullopt, MeshKind::kOpen);
  if (!shape.faults.empty()) throw std::runtime_error(to_string(shape.faults[0]));
  const Eigen::AlignedBox3d all(Eigen::Vector3d::Constant(-1e6), Eigen::Vector3d::Constant(1e6));
  for (const auto& field : make_distance_fields(run.pool(), shape, {d, 2.0 * d, all})) {
    Solid solid;
    solid.field = field;
    run.state().solids.push_back(solid);
  }
  if (bed.amplitude > 0.0) run.settle(kBedSettling);
  return run;
}

void run_wave(Session& session, const Subject& subject, const Bed& bed, double aim) {
  const TravellingWave wave{60, 10, 1, subject.spacing, 6};
  WaterRun run = start_over(session.options().threads, bed, wave, subject.solver);
  Series series = session.series(subject, "amplitude", "periods,amplitude");
  series.add({0, 1});
  const int periods = session.quick() ? 3 : 10;
  const TravellingResult result = run_travelling(
      run, wave, periods,
      [&](int n, const TravellingResult& r) {
        series.add({static_cast<double>(n), r.amplitude});
      },
      [&](double share) { session.progress(subject, share); });
  session.add(subject, {fmt::format("loss a period over {} periods", periods), 100.0 * result.loss, "%",
                        "0; between mirrors 0.2", at_most(aim, 3.0 * aim)});
  session.add_cost(subject, run.cost());
}

/// Water between mirrors with a body held in its middle.
Scene tank_with(const Subject& subject, const Primitive& shape, double side, double depth) {
  Scene scene;
  scene.name = subject.setup;
  scene.particle_spacing = subject.spacing;
  scene.patch = {Eigen::Vector3d::Zero(), {side, side, 1.4 * depth}};
  scene.water.blocks = {{Eigen::Vector3d::Zero(), {side, side, depth}}};
  scene.water.settle_steps = 200;
  if (!choose_solver(subject.solver, scene.solver)) throw std::invalid_argument("no solver " + subject.solver);
  BodySettings body;
  body.id = 1;
  body.name = "body";
  body.primitive = shape;
  body.position = {0.5 * side, 0.5 * side, 0.5 * depth};
  body.drive = BodyDrive::kPose;
  scene.bodies = {body};
  return scene;
}

/// A body held under water: its mean upward force from 2 to 5 s over that of the water it displaces.
void run_submerged(Session& session, const Subject& subject, const Primitive& shape, double volume, double side,
                   std::optional<double> aim) {
  WorldRun run(session.options().threads, tank_with(subject, shape, side, side));
  double force = 0.0, time = 0.0;
  run.advance_to(5.0, [&](const StepReport& step) {
    session.progress(subject, run.world().time() / 5.0);
    if (run.world().time() < 2.0) return;
    force += run.world().fluid().coupling.bodies[0].impulse.z();
    time += step.dt;
  });
  const double weight = kWaterDensity * kGravity * volume;
  Metric error{"buoyant force error", 100.0 * (force / time / weight - 1.0), "%", "Archimedes"};
  if (aim) error.goal = at_most(*aim, 5.0 * *aim);
  session.add(subject, error);
  session.add_cost(subject, run.cost());
}

/// Water 6 m deep at rest between mirrors; a smooth mound, a part of a sphere of 20 m, rises 2 m from the floor.
Scene mound_scene(const Subject& subject) {
  constexpr double kRadius = 20.0, kHeight = 2.0, kDepth = 6.0;  // m
  Scene scene;
  scene.name = subject.setup;
  scene.particle_spacing = subject.spacing;
  scene.patch = {{-20.0, -20.0, 0.0}, {20.0, 20.0, 2.0 * kDepth}};
  scene.patch_edges = {PatchEdge::kMirror, PatchEdge::kMirror, PatchEdge::kMirror};
  scene.water.blocks = {{scene.patch.min, {20.0, 20.0, kDepth}}};
  scene.water.settle_steps = kBedSettling;
  if (!choose_solver(subject.solver, scene.solver)) throw std::invalid_argument("no solver " + subject.solver);
  BodySettings mound;
  mound.id = 1;
  mound.name = "mound";
  mound.primitive = SphereShape{kRadius};
  mound.position = {0.0, 0.0, kHeight - kRadius};
  mound.drive = BodyDrive::kStatic;
  scene.bodies = {mound};
  return scene;
}

double rms_speed(const FluidParticles& p) {
  double squares = 0.0;
  for (std::size_t i = 0; i < p.count; ++i) {
    const Float4& v = p.velocity[i];
    squares += static_cast<double>(v.x * v.x + v.y * v.y + v.z * v.z);
  }
  return std::sqrt(squares / static_cast<double>(p.count));
}

/// How fast water at rest becomes over a mound: mean from 8 to 10 s.
void run_mound(Session& session, const Subject& subject) {
  WorldRun run(session.options().threads, mound_scene(subject));
  double sum = 0.0, time = 0.0;
  run.advance_to(10.0, [&](const StepReport& step) {
    session.progress(subject, run.world().time() / 10.0);
    if (run.world().time() < 8.0) return;
    sum += step.dt * rms_speed(run.world().fluid().particles);
    time += step.dt;
  });
  const double least = std::sqrt(kGravity * subject.spacing);
  session.add(subject, {"rms speed after 10 s over sqrt(g d)", sum / time / least, "", "0", at_most(0.03, 0.12)});
  session.add_cost(subject, run.cost());
}

}  // namespace

void run_solid_surfaces(Session& session) {
  const auto attempt = [&](const std::string& setup, double spacing, auto&& run) {
    for (const std::string& solver : session.solvers({"corrected"})) {
      const Subject subject{"solid_surfaces", setup, solver, spacing};
      session.attempt(subject, [&] { run(subject); });
    }
  };
  for (const double spacing : {1.0, 0.5}) {
    if (spacing < 1.0 && session.quick()) continue;
    const std::string at = fmt::format(", d {:g}", spacing);
    attempt("wave of 60 m over a flat bed" + at, spacing,
            [&](const Subject& subject) { run_wave(session, subject, {}, 0.5); });
    attempt("wave of 60 m over a wavy bed" + at, spacing, [&](const Subject& subject) {
      run_wave(session, subject, {0.7, 20.0}, 1.0);
    });
  }
  attempt("calm water over a mound", 1.0, [&](const Subject& subject) { run_mound(session, subject); });
  const std::pair<int, double> spheres[] = {{3, 2.0}, {5, 1.0}, {8, 1.0}};
  for (const auto& [radius, aim] : spheres) {
    if (session.quick() && radius > 3) continue;
    const double r = radius * 0.1;
    attempt(fmt::format("sphere of radius {} d under water", radius), 0.1, [&, r, aim](const Subject& subject) {
      run_submerged(session, subject, SphereShape{r}, 4.0 / 3.0 * M_PI * r * r * r, 4.0 * r + 0.4, aim);
    });
  }
  attempt("box of 12 x 8 x 6 d under water", 0.1, [&](const Subject& subject) {
    run_submerged(session, subject, BoxShape{{1.2, 0.8, 0.6}}, 1.2 * 0.8 * 0.6, 2.4, 1.0);
  });
  if (!session.quick())
    attempt("plate 1 d thick, sampled, under water", 0.1, [&](const Subject& subject) {
      run_submerged(session, subject, BoxShape{{1.2, 1.2, 0.1}}, 1.2 * 1.2 * 0.1, 2.4, std::nullopt);
    });
}

}  // namespace pelagos::validation
