#include "waves/wave_components.hpp"

#include <cmath>

namespace pelagos {

namespace {

struct WaveAngle {
  double cosine, sine;      ///< of the phase theta
  double along_x, along_y;  ///< unit vector of propagation
};

WaveAngle angle_at(const WaveComponent& wave, double x, double y, double t) {
  const double along_x = std::cos(static_cast<double>(wave.direction));
  const double along_y = std::sin(static_cast<double>(wave.direction));
  const double theta = static_cast<double>(wave.wavenumber) * (along_x * x + along_y * y) -
                       static_cast<double>(wave.omega) * t + static_cast<double>(wave.phase);
  return {std::cos(theta), std::sin(theta), along_x, along_y};
}

}  // namespace

double wave_elevation(std::span<const WaveComponent> components, double x, double y, double t) {
  double elevation = 0.0;
  for (const WaveComponent& wave : components)
    elevation += static_cast<double>(wave.amplitude) * angle_at(wave, x, y, t).cosine;
  return elevation;
}

WaveSurface wave_surface(std::span<const WaveComponent> components, double x, double y, double t) {
  WaveSurface surface;
  for (const WaveComponent& wave : components) {
    const WaveAngle angle = angle_at(wave, x, y, t);
    const double amplitude = wave.amplitude;
    const double steepness = amplitude * static_cast<double>(wave.wavenumber);
    surface.elevation += amplitude * angle.cosine;
    surface.slope -= steepness * angle.sine * Eigen::Vector2d(angle.along_x, angle.along_y);
    surface.rate += amplitude * static_cast<double>(wave.omega) * angle.sine;
  }
  return surface;
}

Eigen::Vector3d wave_displacement(std::span<const WaveComponent> components, double x, double y, double t) {
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();
  for (const WaveComponent& wave : components) {
    const WaveAngle angle = angle_at(wave, x, y, t);
    const double amplitude = wave.amplitude;
    displacement.x() -= amplitude * angle.along_x * angle.sine;
    displacement.y() -= amplitude * angle.along_y * angle.sine;
    displacement.z() += amplitude * angle.cosine + 0.5 * static_cast<double>(wave.wavenumber) * amplitude * amplitude;
  }
  return displacement;
}

double wave_variance(std::span<const WaveComponent> components) {
  double variance = 0.0;
  for (const WaveComponent& wave : components) {
    const double amplitude = wave.amplitude;
    variance += 0.5 * amplitude * amplitude;
  }
  return variance;
}

}  // namespace pelagos
