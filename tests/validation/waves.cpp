#include "waves.hpp"

#include <cmath>

namespace pelagos::validation {

double LinearWave::frequency() const { return std::sqrt(gravity * wavenumber * std::tanh(wavenumber * depth)); }
double LinearWave::period() const { return 2.0 * M_PI / frequency(); }
double LinearWave::horizontal(double z) const { return std::cosh(wavenumber * z) / std::sinh(wavenumber * depth); }
double LinearWave::vertical(double z) const { return std::sinh(wavenumber * z) / std::sinh(wavenumber * depth); }

double standing_frequency_ratio(const LinearWave& wave, double amplitude) {
  const double steepness = wave.wavenumber * amplitude;
  const double omega = std::sqrt(std::tanh(wave.wavenumber * wave.depth));
  const double second =
      (9.0 * std::pow(omega, -7) - 12.0 * std::pow(omega, -3) - 3.0 * omega - 2.0 * std::pow(omega, 5)) / 32.0;
  return 1.0 + 0.5 * steepness * steepness * second / omega;
}

std::vector<Float4> start_wave(const LinearWave& wave, double amplitude, bool standing, std::span<Float4> positions) {
  std::vector<Float4> velocities;
  velocities.reserve(positions.size());
  const double k = wave.wavenumber, speed = standing ? 0.0 : amplitude * wave.frequency();
  for (Float4& p : positions) {
    const auto x = static_cast<double>(p.x), z = static_cast<double>(p.z);
    const double c = wave.horizontal(z), s = wave.vertical(z);
    p.x = static_cast<float>(x - amplitude * c * std::sin(k * x));
    p.z = static_cast<float>(z + amplitude * s * std::cos(k * x));
    velocities.push_back(
        {static_cast<float>(speed * c * std::cos(k * x)), 0.0F, static_cast<float>(speed * s * std::sin(k * x)), 0.0F});
  }
  return velocities;
}

std::complex<double> surface_mode(const FluidParticles& particles, double volume, double wavenumber, double length,
                                  double width) {
  std::complex<double> sum = 0.0;
  for (std::size_t i = 0; i < particles.count; ++i)
    sum += std::polar(1.0, -wavenumber * static_cast<double>(particles.position[i].x));
  return 2.0 * volume / (length * width) * sum;
}

// With two real unknowns A and B, least squares:
//   u = omega C (A cos kx + B sin kx),   w = omega S (A sin kx - B cos kx).
VelocityFit fit_velocity(const LinearWave& wave, const FluidParticles& particles) {
  const double k = wave.wavenumber, omega = wave.frequency();
  double along_a = 0.0, along_b = 0.0, aa = 0.0, ab = 0.0, bb = 0.0;
  const auto each = [&](auto&& f) {
    for (std::size_t i = 0; i < particles.count; ++i) {
      const auto x = static_cast<double>(particles.position[i].x), z = static_cast<double>(particles.position[i].z);
      f(particles.velocity[i], omega * wave.horizontal(z), omega * wave.vertical(z), std::cos(k * x), std::sin(k * x));
    }
  };
  each([&](const Float4& v, double c, double s, double cosine, double sine) {
    const auto u = static_cast<double>(v.x), w = static_cast<double>(v.z);
    along_a += c * cosine * u + s * sine * w;
    along_b += c * sine * u - s * cosine * w;
    aa += c * c * cosine * cosine + s * s * sine * sine;
    bb += c * c * sine * sine + s * s * cosine * cosine;
    ab += (c * c - s * s) * sine * cosine;
  });
  const double determinant = aa * bb - ab * ab;
  const double a = (bb * along_a - ab * along_b) / determinant, b = (aa * along_b - ab * along_a) / determinant;
  double left = 0.0, fitted = 0.0;
  each([&](const Float4& v, double c, double s, double cosine, double sine) {
    const double u = c * (a * cosine + b * sine), w = s * (a * sine - b * cosine);
    const double du = static_cast<double>(v.x) - u, dv = static_cast<double>(v.y), dw = static_cast<double>(v.z) - w;
    left += du * du + dv * dv + dw * dw;
    fitted += u * u + w * w;
  });
  return {{a, b}, std::sqrt(left / fitted)};
}

}  // namespace pelagos::validation
