#include <cmath>

#include "harness.hpp"
#include "measures.hpp"

namespace pelagos::validation {

namespace {

constexpr double kLength = 1.0, kSpeed = 1.0, kReynolds = 100.0;  // m, m/s
constexpr int kSlice = 4;                                         // spacings
constexpr double kEnd = 1.5;                                      // s: the energy has fallen to e^-2.4
constexpr double kFitFrom = 0.1;                                  // s: after the lattice has broken up

/// u = -U cos(2 pi x / L) sin(2 pi z / L),   w = U sin(2 pi x / L) cos(2 pi z / L)
Float4 vortex(const Float4& p) {
  const double x = 2.0 * M_PI * static_cast<double>(p.x) / kLength, z = 2.0 * M_PI * static_cast<double>(p.z) / kLength;
  return {static_cast<float>(-kSpeed * std::cos(x) * std::sin(z)), 0.0F,
          static_cast<float>(kSpeed * std::sin(x) * std::cos(z)), 0.0F};
}

/// Rms over particles of the distance to the exact velocity, over the exact rms.
double velocity_error(const FluidParticles& particles, double decay) {
  double error = 0.0, size = 0.0;
  for (std::size_t i = 0; i < particles.count; ++i) {
    const Float4 exact = vortex(particles.position[i]);
    const Float4& v = particles.velocity[i];
    const double du = static_cast<double>(v.x) - decay * static_cast<double>(exact.x);
    const double dw = static_cast<double>(v.z) - decay * static_cast<double>(exact.z);
    const auto dv = static_cast<double>(v.y);
    error += du * du + dv * dv + dw * dw;
    size += decay * decay * static_cast<double>(exact.x * exact.x + exact.z * exact.z);
  }
  return std::sqrt(error / size);
}

/// Share of particles that see less than 0.9 of the rest density: beside a void.
double thin_share(const FluidParticles& particles) {
  std::size_t thin = 0;
  for (std::size_t i = 0; i < particles.count; ++i) thin += particles.density[i] < 0.9F ? 1 : 0;
  return static_cast<double>(thin) / static_cast<double>(particles.count);
}

void run_one(Session& session, const Goal& goal, const Subject& subject) {
  const double d = subject.spacing;
  FluidParameters parameters =
      patch_parameters({kLength, kSlice * d, kLength}, d, {Edge::kPeriodic, Edge::kPeriodic, Edge::kPeriodic});
  parameters.gravity = 0.0;
  parameters.viscosity = kLength * kSpeed / kReynolds;
  Start start = fill_block(parameters, {kLength, kSlice * d, kLength});
  for (const Float4& p : start.positions) start.velocities.push_back(vortex(p));
  WaterRun run(session.options().threads, parameters, {subject.solver}, start);
  const double rate = 16.0 * M_PI * M_PI / kReynolds * kSpeed / kLength;
  const double first = run.measure().kinetic_energy;
  LineFit fit;
  Series series = session.series(subject, "energy", "t,energy,exact,velocity_error,thin_share");
  constexpr int kSamples = 150;
  double largest_thin = 0.0, error = 0.0;
  for (int k = 0; k <= kSamples; ++k) {
    const double t = kEnd * k / kSamples;
    run.advance_to(t);
    const double energy = run.measure().kinetic_energy / first;
    error = velocity_error(run.state().particles, std::exp(-0.5 * rate * t));
    const double thin = k == 0 ? 0.0 : thin_share(run.state().particles);
    largest_thin = std::max(largest_thin, thin);
    if (t >= kFitFrom) fit.add(t, std::log(energy));
    series.add({t, energy, std::exp(-rate * t), error, thin});
    session.progress(subject, t / kEnd);
  }
  session.add(subject, {"decay rate error", 100.0 * (-fit.slope() / rate - 1.0), "%", "16 pi^2 U / (L Re)", goal});
  session.add(subject, {"velocity error at the end", 100.0 * error, "%", "exact field"});
  session.add(subject, {"particles beside voids at most", 100.0 * largest_thin, "%", "0"});
  session.add_cost(subject, run.cost());
}

}  // namespace

void run_taylor_green(Session& session) {
  struct Setup {
    const char* name;
    int particles;
    bool quick;
    Goal goal;
  };
  const Setup setups[] = {
      {"L/d 25", 25, true, {}}, {"L/d 50", 50, true, at_most(2.0, 20.0)}, {"L/d 100", 100, false, at_most(2.0, 20.0)}};
  for (const Setup& setup : setups) {
    if (session.quick() && !setup.quick) continue;
    std::vector<std::string> own{"corrected"};
    if (!session.quick() && setup.particles <= 50) own = {"corrected", "hybrid", "dfsph", "pbf"};
    for (const std::string& solver : session.solvers(own)) {
      const Subject subject{"taylor_green", setup.name, solver, kLength / setup.particles};
      session.attempt(subject, [&] { run_one(session, setup.goal, subject); });
    }
  }
}

}  // namespace pelagos::validation
