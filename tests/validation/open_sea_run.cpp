#include "open_sea_run.hpp"

#include <cmath>
#include <complex>

#include "simulation/water_surface.hpp"
#include "waves/splitmix.hpp"
#include "waves/wave_moment.hpp"

namespace pelagos::validation {

namespace {

constexpr double kTurn = 2.0 * M_PI;

/// JONSWAP over omega / omega_p, without its scale.
double jonswap(double ratio) {
  const double sigma = ratio <= 1.0 ? 0.07 : 0.09, off = (ratio - 1.0) / sigma;
  return std::pow(ratio, -5.0) * std::exp(-1.25 * std::pow(ratio, -4.0)) * std::pow(3.3, std::exp(-0.5 * off * off));
}

/// Amplitudes of cos p, sin p of the wave that runs along +x and of the one that comes back.
struct TwoWays {
  std::complex<double> out, back;
};
TwoWays two_ways(const std::vector<SurfaceSample>& samples, double wavenumber, double omega, bool theory) {
  Eigen::Matrix<double, 7, 7> matrix = Eigen::Matrix<double, 7, 7>::Zero();
  Eigen::Matrix<double, 7, 1> right = Eigen::Matrix<double, 7, 1>::Zero();
  for (const SurfaceSample& s : samples) {
    const double p = wavenumber * s.x - omega * s.time, q = wavenumber * s.x + omega * s.time;
    Eigen::Matrix<double, 7, 1> row;
    row << 1.0, std::cos(p), std::sin(p), std::cos(2.0 * p), std::sin(2.0 * p), std::cos(q), std::sin(q);
    matrix += row * row.transpose();
    right += (theory ? s.theory : s.measured) * row;
  }
  const Eigen::Matrix<double, 7, 1> fit = matrix.ldlt().solve(right);
  return {{fit[1], -fit[2]}, {fit[5], -fit[6]}};
}

}  // namespace

Scene open_sea_scene(const SeaPatch& patch) {
  Scene scene;
  scene.name = "open_sea";
  scene.particle_spacing = patch.spacing;
  const double x = 0.5 * patch.length, y = 0.5 * patch.width;
  scene.patch = {{-x, -y, -patch.depth}, {x, y, 14.0 * patch.spacing}};
  scene.patch_edges = {PatchEdge::kOpen, patch.slice ? PatchEdge::kPeriodic : PatchEdge::kOpen, PatchEdge::kWall};
  scene.water.blocks = {{scene.patch.min, {x, y, 0.0}}};
  scene.open_sea.zone_width = patch.zone;
  scene.open_sea.follow_velocity = patch.velocity;
  return scene;
}

std::vector<WaveSettings> jonswap_waves(double height, double peak_period, double to_deg, double spread_deg,
                                        std::uint64_t seed, int count) {
  SplitMix64 random(seed);
  const double low = 0.6, high = 2.2, band = (high - low) / count;
  double energy = 0.0;
  for (int i = 0; i < count; ++i) energy += jonswap(low + (i + 0.5) * band) * band;
  std::vector<WaveSettings> waves;
  for (int i = 0; i < count; ++i) {
    const double share = jonswap(low + (i + 0.5) * band) * band / energy;
    WaveSettings wave;
    wave.amplitude = std::sqrt(2.0 * share / 16.0) * height;
    wave.period = peak_period / (low + (i + 0.1 + 0.8 * random.next_unit()) * band);
    wave.to_deg = to_deg + spread_deg * (2.0 * random.next_unit() - 1.0);
    wave.phase_deg = 360.0 * random.next_unit();
    waves.push_back(wave);
  }
  return waves;
}

std::vector<Eigen::Vector2d> gauge_grid(double half_x, int columns, double half_y, int rows) {
  const auto at = [](double half, int k, int count) { return count > 1 ? half * (2.0 * k / (count - 1) - 1.0) : 0.0; };
  std::vector<Eigen::Vector2d> places;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) places.emplace_back(at(half_x, i, columns), at(half_y, j, rows));
  return places;
}

void SurfaceGauges::read(World& world) {
  const PatchFrame& patch = world.patch();
  WaterSurface surface(pool_, {patch, world.fluid().parameters.patch, {}});
  std::vector<SurfacePlace> at;
  std::vector<float> x, y;
  for (const Eigen::Vector2d& place : places_) {
    at.push_back({place, {}});
    x.push_back(static_cast<float>(place.x()));
    y.push_back(static_cast<float>(place.y()));
  }
  const std::vector<SurfaceReading> readings = surface.read_particles(world.fluid(), at);
  const WaveMoment waves = world.sea().at(world.time(), patch.to_world(Eigen::Vector2d(0.0, 0.0)));
  std::vector<float> height(x.size()), a(x.size()), b(x.size()), u(x.size()), v(x.size()), w(x.size());
  evaluate_displaced_surface(waves, x, y, {height, a, b, u, v, w});
  for (std::size_t k = 0; k < places_.size(); ++k)
    if (readings[k].wet)
      samples_.push_back({world.time(), patch.to_world(places_[k]).x(),
                          patch.world_height(readings[k].height) - world.water_level(),
                          static_cast<double>(height[k])});
}

void record(Session& session, const Subject& subject, WorldRun& run, SurfaceGauges& gauges, double from, double every,
            double end) {
  double next = from;
  run.advance_to(end, [&](const StepReport&) {
    session.progress(subject, run.world().time() / end);
    if (run.world().time() < next) return;
    gauges.read(run.world());
    next += every;
  });
}

SeaAgreement agreement(const std::vector<SurfaceSample>& samples) {
  const auto count = static_cast<double>(samples.size());
  double measured = 0.0, theory = 0.0;
  for (const SurfaceSample& s : samples) measured += s.measured, theory += s.theory;
  measured /= count, theory /= count;
  double mm = 0.0, mt = 0.0, tt = 0.0, dd = 0.0;
  for (const SurfaceSample& s : samples) {
    const double m = s.measured - measured, t = s.theory - theory;
    mm += m * m, mt += m * t, tt += t * t, dd += (m - t) * (m - t);
  }
  return {mt / tt, mt / std::sqrt(mm * tt), measured - theory, std::sqrt(dd / count)};
}

RegularFit fit_regular(const std::vector<SurfaceSample>& samples, double wavenumber, double omega) {
  const TwoWays water = two_ways(samples, wavenumber, omega, false),
                theory = two_ways(samples, wavenumber, omega, true);
  const std::complex<double> ratio = water.out / theory.out;
  return {std::abs(ratio), std::arg(ratio) * 360.0 / kTurn, std::abs(water.back - theory.back) / std::abs(theory.out)};
}

WayAmplitudes fit_ways(const std::vector<SurfaceSample>& samples, double wavenumber, double omega) {
  const TwoWays water = two_ways(samples, wavenumber, omega, false);
  return {std::abs(water.out), std::abs(water.back)};
}

}  // namespace pelagos::validation
