#include "waves.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "harness.hpp"

namespace pelagos::validation {
namespace {

constexpr double kLength = 60.0, kDepth = 10.0, kWidth = 4.0;
const LinearWave kWave{2.0 * M_PI / kLength, kDepth, 9.81};

FluidParticles lattice() {
  const FluidParameters parameters =
      patch_parameters({kLength, kWidth, 20.0}, 1.0, {Edge::kPeriodic, Edge::kPeriodic, Edge::kMirror});
  FluidParticles particles;
  particles.position = fill_block(parameters, {kLength, kWidth, kDepth}).positions;
  particles.count = particles.position.size();
  return particles;
}

TEST(LinearWave, PeriodOfTheClosedForm) {
  // A wave 2 m long over 1 m: 1.13392 s, six digits, from an independent evaluation with g = 9.81.
  EXPECT_NEAR((LinearWave{M_PI, 1.0, 9.81}.period()), 1.13392, 1e-5);
}

TEST(LinearWave, HighStandingWavesAreSlower) {
  // Deep water: 1 - (ka)^2 / 8 (Rayleigh 1915); at k h = 8 the depth plays no part to 1e-6.
  EXPECT_NEAR(standing_frequency_ratio({8.0, 1.0, 9.81}, 0.3 / 8.0), 1.0 - 0.09 / 8.0, 1e-6);
}

TEST(WaveMode, IsTheAmplitudeAndPhaseOfASmallWave) {
  FluidParticles particles = lattice();
  // Columns of a lattice displaced by a: the mode of a small wave, exact to a's third order, here 3e-6 of it, and to
  // single precision of positions, 2e-6 m.
  const double amplitude = 0.05;
  (void)start_wave(kWave, amplitude, false, particles.position);
  const auto mode = surface_mode(particles, 1.0, kWave.wavenumber, kLength, kWidth);
  // Displaced by sinh(k z)/sinh(k h) of a at mid-columns, the sum over layers is the midpoint rule for its integral:
  // (k d)^2 / 24 = 5e-4 too large or small.
  EXPECT_NEAR(std::abs(mode) / amplitude, 1.0, 1e-3);
  EXPECT_NEAR(std::arg(mode), 0.0, 1e-3);
}

TEST(WaveMode, FollowsACrestThatMoves) {
  FluidParticles particles = lattice();
  (void)start_wave(kWave, 0.05, false, particles.position);
  for (std::size_t i = 0; i < particles.count; ++i) particles.position[i].x += 7.0F;
  const auto mode = surface_mode(particles, 1.0, kWave.wavenumber, kLength, kWidth);
  EXPECT_NEAR(std::arg(mode), -kWave.wavenumber * 7.0, 1e-3);
}

TEST(VelocityFit, RecoversAnExactField) {
  FluidParticles particles = lattice();
  const double a = 0.8, b = -0.3, omega = kWave.frequency();
  for (const Float4& p : particles.position) {
    const auto x = static_cast<double>(p.x), z = static_cast<double>(p.z);
    const double k = kWave.wavenumber;
    particles.velocity.push_back(
        {static_cast<float>(omega * kWave.horizontal(z) * (a * std::cos(k * x) + b * std::sin(k * x))), 0.0F,
         static_cast<float>(omega * kWave.vertical(z) * (a * std::sin(k * x) - b * std::cos(k * x))), 0.0F});
  }
  const VelocityFit fit = fit_velocity(kWave, particles);
  // Single precision of the velocities.
  EXPECT_NEAR(fit.amplitude.real(), a, 1e-6);
  EXPECT_NEAR(fit.amplitude.imag(), b, 1e-6);
  EXPECT_LT(fit.noise, 1e-6);
}

TEST(VelocityFit, CallsNoiseWhatIsNotTheWave) {
  FluidParticles particles = lattice();
  particles.velocity = start_wave(kWave, 0.05, false, particles.position);
  double squares = 0.0;
  for (const Float4& v : particles.velocity) squares += static_cast<double>(v.x * v.x + v.z * v.z);
  const auto across = static_cast<float>(0.5 * std::sqrt(squares / static_cast<double>(particles.count)));
  for (Float4& v : particles.velocity) v.y = across;
  // Half the wave's rms speed, all of it across; the wave's own misfit by its height is of the order k a = 0.5 %.
  EXPECT_NEAR(fit_velocity(kWave, particles).noise, 0.5, 0.005);
}

}  // namespace
}  // namespace pelagos::validation
