#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "harness.hpp"
#include "measures.hpp"
#include "two_liquids.hpp"

namespace pelagos::validation {

namespace {

// Two layers of half a wavelength each, oil of 800 and water of 1000 kg/m^3, over a mirror. Two spacings of room are
// left above: in a full box, particles that leave the lattice cannot but be compressed.
constexpr double kLength = 1.0, kOil = 800.0, kWater = 1000.0;  // m
constexpr double kWaveNumber = 2.0 * M_PI / kLength;
constexpr double kFirst = 0.03, kLast = 0.5;  // k a: where the wave starts, and where theory ends

/// Lamb 1932, art. 231 and 232: two layers of depth h each, the frequency (oil above) or growth rate (water above),
/// 1/s.
double rate() {
  const double coth = 1.0 / std::tanh(kWaveNumber * 0.5 * kLength);
  return std::sqrt(9.81 * kWaveNumber * (kWater - kOil) / ((kWater + kOil) * coth));
}

/// Still water whose interface is pushed: velocities of the wave that grows as exp(rate t) from k a = kFirst (half of
/// it in height, the rest by and by; the lattice itself is flat), or that swings.
Start pushed(const TwoLiquids& box, bool oil_above) {
  Start start = box.start([&](double, double z) { return (z > 0.5 * kLength) == oil_above; });
  const double speed = 2.0 * kFirst / kWaveNumber * rate();
  for (const Float4& p : start.positions) {
    const double k = kWaveNumber, x = k * static_cast<double>(p.x), z = static_cast<double>(p.z) - 0.5 * kLength;
    const double rest = k * (0.5 * kLength - std::abs(z)), scale = speed / std::sinh(k * 0.5 * kLength);
    const double across = (z > 0.0 ? 1.0 : -1.0) * scale * std::cosh(rest) * std::sin(x);
    start.velocities.push_back(
        {static_cast<float>(across), 0.0F, static_cast<float>(scale * std::sinh(rest) * std::cos(x)), 0.0F});
  }
  return start;
}

struct Wave {
  LineFit growth;         ///< log |k a| over time, k a from 2 kFirst to kLast
  double highest = 0.0;   ///< of |k a|
  double intruder = 0.0;  ///< m, at the end
};

Wave run_wave(Session& session, const Subject& subject, const char* name, bool oil_above, double end) {
  const TwoLiquids box{kLength, kLength + 2.0 * subject.spacing, kLength, subject.spacing, kOil, true};
  WaterRun run(session.options().threads, box.parameters(), {subject.solver}, pushed(box, oil_above));
  Series series = session.series(subject, name, "t,ka");
  const double before = oil_mode(run.state(), kWaveNumber, kLength);
  Wave wave;
  run.advance_to(end, [&] {
    session.progress(subject, run.time() / end);
    const double ka = kWaveNumber * std::abs(oil_mode(run.state(), kWaveNumber, kLength) - before);
    series.add({run.time(), ka});
    wave.highest = std::max(wave.highest, ka);
    if (wave.highest == ka && ka > 2.0 * kFirst && ka < kLast) wave.growth.add(run.time(), std::log(ka));
  });
  wave.intruder = deepest_intruder(run.state(), oil_above);
  session.add_cost(subject, run.cost());
  return wave;
}

void run_unstable(Session& session, const Subject& subject) {
  const Wave wave = run_wave(session, subject, "growth", false, 1.6);
  const double slope = wave.growth.count() > 2 ? wave.growth.slope() : NAN;
  session.add(subject, {"growth rate error", 100.0 * (slope / rate() - 1.0), "%",
                        "linear theory of two layers, k a from 0.06 to 0.5", at_most(15.0, 60.0)});
}

/// The same wave with the oil above: it swings and nothing mixes.
void run_stable(Session& session, const Subject& subject) {
  const Wave wave = run_wave(session, subject, "swing", true, 3.0);
  session.add(subject,
              {"highest wave over the first", wave.highest / (2.0 * kFirst), "", "at most 1", at_most(1.05, 1.5)});
  session.add(subject, {"deepest particle in the other liquid", wave.intruder / subject.spacing, "d", "nothing mixes",
                        at_most(1.5, 3.0)});
}

}  // namespace

void run_rayleigh_taylor(Session& session) {
  for (const std::string& solver : session.solvers({"corrected", "hybrid"}))
    for (const int cells : {30, 60}) {
      if (session.quick() && cells != 30) continue;
      const Subject unstable{"rayleigh_taylor", fmt::format("water above, length {} d", cells), solver,
                             kLength / cells};
      session.attempt(unstable, [&] { run_unstable(session, unstable); });
      const Subject stable{"rayleigh_taylor", fmt::format("oil above, length {} d", cells), solver, kLength / cells};
      session.attempt(stable, [&] { run_stable(session, stable); });
    }
}

}  // namespace pelagos::validation
