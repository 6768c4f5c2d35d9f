#include <algorithm>
#include <cmath>
#include <vector>

#include "harness.hpp"
#include "measures.hpp"
#include "waves.hpp"

namespace pelagos::validation {

namespace {

// Half a wavelength between mirrors: length and depth 1 m, so that k h = pi.
constexpr double kDepth = 1.0, kLength = 1.0;  // m
constexpr int kSlice = 6;                      // spacings; thinner ones are more restless
constexpr double kPeriods = 8.6;               // after which the amplitude is read

struct Setup {
  const char* name;
  int layers;
  double amplitude;  ///< m
  bool quick;
  bool others;  ///< other solvers than the default one as well
  Goal period, left;
};

/// Largest |eta| within a quarter of a period around each half period: peaks 1, 2, ... at T/2, T, ...
class Envelope {
 public:
  explicit Envelope(double period) : half_(0.5 * period) {}
  void add(double t, double eta) {
    const auto n = static_cast<std::size_t>(std::lround(t / half_));
    if (peaks_.size() <= n) peaks_.resize(n + 1, 0.0);
    peaks_[n] = std::max(peaks_[n], std::abs(eta));
  }
  [[nodiscard]] double peak(std::size_t n) const { return peaks_.at(n); }
  /// Geometric interpolation between the peaks around `periods`.
  [[nodiscard]] double at(double periods) const {
    const auto n = static_cast<std::size_t>(std::floor(2.0 * periods));
    return peak(n) * std::pow(peak(n + 1) / peak(n), 2.0 * periods - static_cast<double>(n));
  }

 private:
  double half_;
  std::vector<double> peaks_;
};

/// Mean period from the zeros of a series, linear between samples.
double mean_period(const Curve& curve) {
  std::vector<double> zeros;
  for (std::size_t k = 1; k < curve.value.size(); ++k) {
    const double a = curve.value[k - 1], b = curve.value[k];
    if ((a > 0.0) != (b > 0.0)) zeros.push_back(curve.time[k - 1] + (curve.time[k] - curve.time[k - 1]) * a / (a - b));
  }
  if (zeros.size() < 2) return NAN;
  return 2.0 * (zeros.back() - zeros.front()) / static_cast<double>(zeros.size() - 1);
}

void run_one(Session& session, const Setup& setup, const Subject& subject) {
  const double d = subject.spacing, width = kSlice * d;
  const FluidParameters parameters =
      patch_parameters({kLength, width, 1.5 * kDepth}, d, {Edge::kMirror, Edge::kPeriodic, Edge::kMirror});
  const LinearWave wave{M_PI / kLength, kDepth, parameters.gravity};
  Start start = fill_block(parameters, {kLength, width, kDepth});
  start.velocities = start_wave(wave, setup.amplitude, true, start.positions);
  WaterRun run(session.options().threads, parameters, {subject.solver}, start);
  const double period = wave.period(), end = (kPeriods + 0.7) * period;
  Envelope envelope(period);
  Curve curve;
  const double energy = mechanical_energy(run);
  Series series = session.series(subject, "surface", "periods,eta");
  const auto sample = [&] {
    const double eta = surface_mode(run.state().particles, parameters.volume(), wave.wavenumber, kLength, width).real();
    envelope.add(run.time(), eta);
    curve.add(run.time(), eta);
    series.add({run.time() / period, eta / curve.value.front()});
    session.progress(subject, run.time() / end);
  };
  sample();
  run.advance_to(end, sample);
  const double expected = period / standing_frequency_ratio(wave, setup.amplitude);
  session.add(subject, {"period error", 100.0 * (mean_period(curve) / expected - 1.0), "%",
                        "Tadjbakhsh and Keller 1960", setup.period});
  session.add(subject, {"period error against linear theory", 100.0 * (mean_period(curve) / period - 1.0), "%",
                        "w^2 = g k tanh(k h)"});
  session.add(subject, {"amplitude left after 8.6 periods", envelope.at(kPeriods) / curve.value.front(), "",
                        "1; the best peer 0.86", setup.left});
  const double wave_energy =
      0.25 * parameters.rest_density * parameters.gravity * setup.amplitude * setup.amplitude * kLength * width;
  const double gained = mechanical_energy(run) - energy;
  session.add(subject, {"mechanical energy gained in all", gained / wave_energy, "of the wave's", "0"});
  session.add(subject, energy_rise(gained, 0.5 * parameters.rest_density * parameters.gravity * kDepth * kDepth *
                                               kLength * width));
  session.add_cost(subject, run.cost());
}

}  // namespace

void run_standing_wave(Session& session) {
  // Bounds: periods three times the aim; amplitudes guard against getting worse, the best peer keeps 0.86 at h/d 50.
  const Setup setups[] = {
      {"a/h 0.1, h/d 25", 25, 0.1, true, true, at_most(0.5, 1.5), at_least(0.95, 0.75)},
      {"a/h 0.1, h/d 50", 50, 0.1, false, true, at_most(0.5, 1.5), at_least(0.95, 0.5)},
      {"a/h 0.02, h/d 50", 50, 0.02, false, false, at_most(0.5, 1.5), at_least(0.95, 0.75)},
  };
  for (const Setup& setup : setups) {
    if (session.quick() && !setup.quick) continue;
    std::vector<std::string> own{"corrected"};
    if (setup.others && !session.quick()) own = {"corrected", "hybrid", "dfsph", "pbf"};
    for (const std::string& solver : session.solvers(own)) {
      const Subject subject{"standing_wave", setup.name, solver, kDepth / setup.layers};
      session.attempt(subject, [&] { run_one(session, setup, subject); });
    }
  }
}

}  // namespace pelagos::validation
