#include <algorithm>
#include <cmath>

#include "harness.hpp"
#include "monotonic_clock.hpp"
#include "simulation/world.hpp"
#include "wind/air.hpp"

namespace pelagos::validation {

namespace {

constexpr double kSpacing = 0.05;  // m

WindSettings steady(WindLaw law, double speed) {
  WindSettings wind;
  wind.law = law;
  wind.roughness = default_roughness(law);
  wind.velocity = {speed, 0.0, 0.0};
  return wind;
}

// ---- the air

void measure_air(Session& session) {
  const Subject subject{"wind", "air", kDefaultSolver, 0.0};
  WindSettings wind = steady(WindLaw::kGust, 10.0);
  AirSite site;
  const double gain = Air(site, wind).velocity_at({0, 0, 50.0}, 0.0).x() / 10.0;
  session.add(subject, {"wind at 50 m over the wind at 10 m, z0 = 0.2 mm", gain, "", "ln(50/z0)/ln(10/z0) = 1.1488"});
  wind.amplitude = 3.0;
  double sum = 0.0, squares = 0.0;
  constexpr int kSeeds = 40, kPlaces = 5000, kCount = kSeeds * kPlaces;  // one seed's sea is one plane of the noise
  for (int seed = 0; seed < kSeeds; ++seed) {
    site.seed = static_cast<std::uint64_t>(seed);
    const Air air(site, wind);
    for (int n = 0; n < kPlaces; ++n) {
      const double u = air.velocity_at({6.131 * n, 2.917 * n, 10.0}, 0.0).x() - 10.0;
      sum += u;
      squares += u * u;
    }
  }
  const double mean = sum / kCount;
  session.add(subject, {"mean of the gusts", 100.0 * mean / 3.0, "% of the amplitude", "0", at_most(1.0, 3.0)});
  session.add(subject, {"rms gust, its distance from 0.27 of the amplitude",
                        std::sqrt(squares / kCount - mean * mean) / 3.0 - 0.27, "of the amplitude",
                        "Perlin 2002, one octave", at_most(0.01, 0.03)});
}

// ---- energy that the sea takes from the wind, and the time step

/// A channel without ends, 2 x 1 x 0.5 m, over a mirror.
Scene channel(const WindSettings& wind, double step) {
  Scene scene;
  scene.name = "channel";
  scene.particle_spacing = kSpacing;
  scene.tank = {{0, 0, 0}, {2, 1, 2}};
  scene.tank_edges = {TankEdge::kPeriodic, TankEdge::kPeriodic, TankEdge::kMirror};
  scene.water.blocks = {{{0, 0, 0}, {2, 1, 0.5}}};
  scene.time_step.max_step = step;
  scene.wind = wind;
  return scene;
}

/// J of the mean flow after two seconds; what single particles move besides is the method's noise and no gain.
double energy_gained(Session& session, const Subject& subject, const WindSettings& wind, double step) {
  World world(channel(wind, step), {session.options().threads, nullptr, {}});
  while (world.time() < 2.0 - 1e-9) {
    world.advance();
    session.progress(subject, world.time() / 2.0);
  }
  const FluidParticles& p = world.fluid().particles;
  double sum = 0.0;
  for (std::size_t i = 0; i < p.count; ++i) sum += static_cast<double>(p.velocity[i].x);
  const FluidParameters& parameters = world.fluid().parameters;
  return 0.5 * parameters.rest_density * parameters.volume() * sum * sum / static_cast<double>(p.count);
}

void measure_step_independence(Session& session) {
  const struct {
    const char* name;
    WindLaw law;
    double speed;
    Goal goal;
  } laws[] = {{"gust", WindLaw::kGust, 6.0, at_most(5.0, 5.0)},
              {"stress", WindLaw::kStress, 40.0, at_most(5.0, 5.0)},
              {"paper", WindLaw::kPaper, 6.0, Goal{}}};
  for (const auto& law : laws) {
    const Subject subject{"wind", std::string("law ") + law.name, kDefaultSolver, kSpacing};
    session.attempt(subject, [&] {
      const WindSettings wind = steady(law.law, law.speed);
      const double whole = energy_gained(session, subject, wind, 0.004);
      const double half = energy_gained(session, subject, wind, 0.002);
      session.add(subject, {"energy gained with 4 ms steps", whole, "J", "-"});
      session.add(subject, {"change of the energy gained with half the step", 100.0 * (half / whole - 1.0), "%",
                            law.law == WindLaw::kPaper ? "the paper's law adds a velocity a step" : "0", law.goal});
    });
  }
}

// ---- the paper's wind scene

/// Paper, section VI.B with L = 1 m: 34,749 particles, its wind and its numbers as printed.
Scene paper_scene(bool quick) {
  Scene scene;
  scene.name = "paper_wind";
  scene.particle_spacing = quick ? 2.0 * kSpacing : kSpacing;
  scene.tank = {{0, 0, 0}, {5, 2, 3}};
  scene.water.blocks = {{{0, 0, 0}, {5, 2, 0.5}}};
  scene.water.settle_steps = 50;
  scene.solver = default_solver(SolverKind::kHybrid);
  scene.wind = steady(WindLaw::kPaper, 0.0);
  scene.wind->velocity = {-18.0, -0.5, 0.0};
  scene.wind->amplitude = 3.0;
  scene.wind->length = 1.0;
  scene.wind->pulse = WindPulse{10.0, 100.0};
  return scene;
}

void write_snapshot(const World& world, Series series) {
  const FluidParticles& p = world.fluid().particles;
  for (std::size_t i = 0; i < p.count; ++i) {
    const Float4 &x = p.position[i], &v = p.velocity[i];
    if (std::abs(x.y) > 0.15F) continue;  // a slab around the middle
    series.add({static_cast<double>(x.x) + world.origin().x(), static_cast<double>(x.z) + world.origin().z(),
                static_cast<double>(std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z))});
  }
}

void redraw_paper_scene(Session& session) {
  const Scene scene = paper_scene(session.quick());
  const Subject subject{"wind", session.quick() ? "paper's scene, d = 0.1 m" : "paper's scene", "hybrid",
                        scene.particle_spacing};
  session.attempt(subject, [&] {
    World world(scene, {session.options().threads, nullptr, {}});
    const double end = session.quick() ? 2.0 : 6.0;
    double highest = 0.0, fastest = 0.0;
    RunCost cost;
    cost.particles = world.fluid().particles.count;
    int snapshot = 0;
    const std::int64_t begin = monotonic_ns();
    while (world.time() < end - 1e-9) {
      const WorldStep step = world.advance();
      ++cost.steps;
      cost.density_error += step.report.density_error;
      cost.density_error_peak = std::max(cost.density_error_peak, step.report.density_error);
      cost.largest_density = std::max(cost.largest_density, step.report.largest_density);
      fastest = std::max(fastest, step.report.largest_speed);
      session.progress(subject, world.time() / end);
      if (world.time() >= end * (snapshot + 1) / 4.0 - 1e-9)
        write_snapshot(world, session.series(subject, "snapshot" + std::to_string(++snapshot), "x,z,speed"));
      for (std::size_t i = 0; i < world.fluid().particles.count; ++i)
        highest = std::max(highest, static_cast<double>(world.fluid().particles.position[i].z));
    }
    cost.simulated_s = world.time();
    cost.wall_s = 1e-9 * static_cast<double>(monotonic_ns() - begin);
    cost.density_error /= static_cast<double>(cost.steps);
    session.add(subject, {"highest water", highest, "m", "the wind piles it up from 0.5 m"});
    session.add(subject, {"largest speed", fastest, "m/s", "-"});
    session.add_cost(subject, cost);
  });
}

}  // namespace

void run_wind(Session& session) {
  measure_air(session);
  measure_step_independence(session);
  redraw_paper_scene(session);
}

}  // namespace pelagos::validation
