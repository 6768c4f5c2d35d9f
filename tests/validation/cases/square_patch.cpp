#include <algorithm>
#include <cmath>

#include "harness.hpp"
#include "measures.hpp"

namespace pelagos::validation {

namespace {

constexpr double kLength = 1.0;  // m
/// 1/s: the speed of the corners is then about sqrt(g L), so that what scales with sqrt(g / d) in the solver stands to
/// the flow as it does in water under gravity.
const double kRotation = std::sqrt(9.81 / kLength);
constexpr int kSlice = 4;                      // spacings
constexpr double kTank = 12.0, kMiddle = 6.0;  // m: nothing reaches its faces
constexpr double kEnd = 8.0;                   // of w t

Start make_patch(const FluidParameters& parameters) {
  const double d = parameters.spacing;
  Start start = fill_block(parameters, {kLength, kSlice * d, kLength});
  for (Float4& p : start.positions) {
    const double x = static_cast<double>(p.x) - 0.5 * kLength, z = static_cast<double>(p.z) - 0.5 * kLength;
    start.velocities.push_back({static_cast<float>(kRotation * z), 0.0F, static_cast<float>(-kRotation * x), 0.0F});
    p.x = static_cast<float>(kMiddle + x);
    p.z = static_cast<float>(kMiddle + z);
  }
  return start;
}

/// About the middle, per mass, m^2/s.
double angular_momentum(const FluidParticles& particles) {
  double sum = 0.0;
  for (std::size_t i = 0; i < particles.count; ++i) {
    const Float4 &x = particles.position[i], &v = particles.velocity[i];
    sum += (static_cast<double>(x.z) - kMiddle) * static_cast<double>(v.x) -
           (static_cast<double>(x.x) - kMiddle) * static_cast<double>(v.z);
  }
  return sum;
}

std::span<const Float4> positions_of(const WaterRun& run) {
  return {run.state().particles.position.data(), run.state().particles.count};
}

void write_snapshot(Session& session, const Subject& subject, const WaterRun& run, int turn) {
  Series series = session.series(subject, "snapshot" + std::to_string(turn), "x,z,density");
  const FluidParticles& p = run.state().particles;
  for (std::size_t i = 0; i < p.count; ++i) {
    if (p.position[i].y >= static_cast<float>(subject.spacing)) continue;  // one layer
    series.add({static_cast<double>(p.position[i].x) - kMiddle, static_cast<double>(p.position[i].z) - kMiddle,
                static_cast<double>(p.density[i])});
  }
}

struct Level {
  double energy = 0, momentum = 0, hull = 0, covered = 0;
};

Level measure(WaterRun& run) {
  return {run.measure().kinetic_energy, angular_momentum(run.state().particles), hull_area(positions_of(run)),
          covered_area(positions_of(run), run.state().parameters.spacing)};
}

void add_results(Session& session, const Subject& subject, const WaterRun& run, int turn, const Level& now,
                 const Level& first, bool last) {
  const std::string at = " at wt = " + std::to_string(turn);
  // Bounds: what is left when a tenth of the energy or of the momentum has gone.
  session.add(subject, {"kinetic energy" + at, now.energy / first.energy, "of the start", "1; a peer 0.9958 at wt = 8",
                        last ? at_least(0.99, 0.9) : Goal{}});
  session.add(subject, {"angular momentum" + at, now.momentum / first.momentum, "of the start", "1",
                        last ? at_least(0.99, 0.9) : Goal{}});
  session.add(subject, {"covered area" + at, now.covered / first.covered, "of the start", "1"});
  // Energy and momentum are kept by particles that fly apart as well: the area tells. Bound: twice the area.
  if (last)
    session.add(subject, {"covered area error" + at, 100.0 * (now.covered / first.covered - 1.0), "%", "0",
                          at_most(5.0, 100.0)});
  session.add(subject, {"area of the convex hull" + at, now.hull / first.hull, "of the start", "-"});
  session.add(subject, {"smallest pair distance" + at, smallest_distance(run.state()) / subject.spacing, "d", "1"});
}

void run_one(Session& session, const Subject& subject) {
  const double d = subject.spacing;
  FluidParameters parameters =
      patch_parameters({kTank, kSlice * d, kTank}, d, {Edge::kMirror, Edge::kPeriodic, Edge::kMirror});
  parameters.gravity = 0.0;
  parameters.viscosity = 0.0;
  WaterRun run(session.options().threads, parameters, {subject.solver}, make_patch(parameters));
  const double closed = parameters.rest_density * kRotation * kRotation * std::pow(kLength, 4) / 12.0 * kSlice * d;
  const Level first = measure(run);
  session.add(subject,
              {"kinetic energy at the start error", 100.0 * (first.energy / closed - 1.0), "%", "rho w^2 L^4 / 12"});
  Series series = session.series(subject, "series", "wt,energy,momentum,hull,covered");
  for (int k = 0; k <= 40; ++k) {
    const double turn = kEnd * k / 40;
    run.advance_to(turn / kRotation, [&] { session.progress(subject, run.time() * kRotation / kEnd); });
    const Level now = measure(run);
    series.add({turn, now.energy / first.energy, now.momentum / first.momentum, now.hull / first.hull,
                now.covered / first.covered});
    if (k != 10 && k != 20 && k != 40) continue;
    write_snapshot(session, subject, run, k / 5);
    add_results(session, subject, run, k / 5, now, first, k == 40);
  }
  session.add_cost(subject, run.cost());
}

}  // namespace

void run_square_patch(Session& session) {
  for (const int particles : {50, 100}) {
    if (session.quick() && particles > 50) continue;
    std::vector<std::string> own{"corrected"};
    if (!session.quick() && particles == 50) own = {"corrected", "hybrid", "dfsph", "pbf"};
    for (const std::string& solver : session.solvers(own)) {
      const Subject subject{"square_patch", "L/d " + std::to_string(particles), solver, kLength / particles};
      session.attempt(subject, [&] { run_one(session, subject); });
    }
  }
}

}  // namespace pelagos::validation
