#include <algorithm>
#include <cmath>

#include "../../support/places.hpp"
#include "harness.hpp"
#include "measures.hpp"
#include "simulation/world.hpp"
#include "wind/air.hpp"
#include "wind/drag.hpp"
#include "wind/perlin_noise.hpp"

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

std::string data_file(const std::string& name) { return test::source_path("tests/validation/data/" + name); }

/// Against published numbers: the noise at 15 places, the drag from 4 to 25 m/s.
void compare_with_tables(Session& session, const Subject& subject) {
  const auto noise = read_columns(data_file("../../wind/data/perlin_improved_noise_values.csv"));
  double worst = 0.0;
  for (std::size_t n = 0; n < noise.at(0).size(); ++n)
    worst = std::max(worst, std::abs(perlin_noise(noise[0][n], noise[1][n], noise[2][n]) - noise[3][n]));
  session.add(subject,
              {"noise: largest difference from the reference values", worst, "", "Perlin 2002", at_most(1e-12, 1e-9)});
  const auto drag = read_columns(data_file("wind_drag.csv"));
  worst = 0.0;
  for (std::size_t n = 0; n < drag.at(0).size(); ++n)
    worst = std::max(worst, std::abs(1e3 * sea_drag_coefficient(drag[0][n]) / drag[1][n] - 1.0));
  session.add(subject, {"drag coefficient: largest difference from the table", 100.0 * worst, "%",
                        "Large and Pond 1981", at_most(1e-3, 0.1)});
}

/// What is plotted: the profile over two roughnesses, and a minute of gusts at a mast.
void write_series(Session& session, const Subject& subject) {
  WindSettings wind = steady(WindLaw::kGust, 10.0);
  const Air sea(AirSurroundings{}, wind);
  wind.roughness = 0.01;
  const Air rough(AirSurroundings{}, wind);
  Series profile = session.series(subject, "profile", "height,sea,rough");
  for (int n = -50; n <= 24; ++n) {
    const double height = std::pow(10.0, 0.08 * n);
    profile.add({height, sea.velocity_at({0, 0, height}, 0.0).x(), rough.velocity_at({0, 0, height}, 0.0).x()});
  }
  wind.amplitude = 3.0;
  wind.length = 20.0;
  const Air gusty(AirSurroundings{}, wind);
  Series mast = session.series(subject, "mast", "t,u");
  for (int n = 0; n < 4096; ++n) mast.add({n / 16.0, gusty.velocity_at({0, 0, 10.0}, n / 16.0).x()});
}

void measure_air(Session& session) {
  const Subject subject{"wind", "air", kDefaultSolver, 0.0};
  compare_with_tables(session, subject);
  write_series(session, subject);
  WindSettings wind = steady(WindLaw::kGust, 10.0);
  AirSurroundings around;
  const double gain = Air(around, wind).velocity_at({0, 0, 50.0}, 0.0).x() / 10.0;
  session.add(subject, {"wind at 50 m over the wind at 10 m, z0 = 0.2 mm", gain, "", "ln(50/z0)/ln(10/z0) = 1.1488"});
  wind.amplitude = 3.0;
  double sum = 0.0, squares = 0.0;
  constexpr int kSeeds = 40, kPlaces = 5000, kCount = kSeeds * kPlaces;  // one seed's sea is one plane of the noise
  for (int seed = 0; seed < kSeeds; ++seed) {
    around.seed = static_cast<std::uint64_t>(seed);
    const Air air(around, wind);
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
  scene.patch = {{0, 0, 0}, {2, 1, 2}};
  scene.patch_edges = {PatchEdge::kPeriodic, PatchEdge::kPeriodic, PatchEdge::kMirror};
  scene.water.blocks = {{{0, 0, 0}, {2, 1, 0.5}}};
  scene.time_step.max_step = step;
  scene.wind = wind;
  return scene;
}

/// J of the mean flow after two seconds, one where it has to be quick; what single particles move besides is the
/// method's noise and no gain.
double energy_gained(Session& session, const Subject& subject, const WindSettings& wind, double step) {
  World world(channel(wind, step), {session.options().threads, nullptr, {}});
  const double end = session.quick() ? 1.0 : 2.0;
  while (world.time() < end - 1e-9) {
    world.advance();
    session.progress(subject, world.time() / end);
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

}  // namespace

void run_wind(Session& session) {
  measure_air(session);
  measure_step_independence(session);
}

}  // namespace pelagos::validation
