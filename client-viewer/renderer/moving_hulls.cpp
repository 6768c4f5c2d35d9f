#include "renderer/moving_hulls.hpp"

#include <algorithm>
#include <cmath>

#include "channels/camera.hpp"

namespace pelagos {
namespace {

constexpr double kWaveRider = 5.0;       // m, half length: shorter hulls go to and fro with the waves
constexpr double kMostCurvature = 0.02;  // 1/m

MovingHull hull_of(const BodyState& body, const HullBox& box, const WaveMoment& waves, const Eigen::Vector2d& anchor,
                   double level, const Eigen::Vector2d& flow) {
  MovingHull hull;
  hull.body = body.body;
  hull.place = body.position.head<2>();
  const Eigen::Vector3d half = 0.5 * (box.high - box.low);
  const double heading = heading_of(body.orientation);
  hull.way = {std::cos(heading), std::sin(heading)};
  hull.half_length = std::max(half.x(), 0.1);
  hull.half_beam = std::max(half.y(), 0.1);
  const Eigen::Vector2f at = (hull.place - anchor).cast<float>();
  const Eigen::Vector2d orbit =
      motion_at(waves, {at.x(), at.y(), 0.0F}, Stretching::kWheeler).velocity.head<2>().cast<double>();
  const Eigen::Vector2d through = body.velocity.head<2>() - flow - std::min(kWaveRider / hull.half_length, 1.0) * orbit;
  const bool astern = through.dot(hull.way) < 0.0;  // the stern is her bow
  if (astern) hull.way = -hull.way;
  hull.speed = through.dot(hull.way);
  hull.curvature = std::clamp(body.angular_velocity.z() / std::max(hull.speed, 0.1), -kMostCurvature, kMostCurvature);

  const Eigen::Vector3d bow = body.orientation * Eigen::Vector3d(astern ? box.low.x() : box.high.x(), 0.0, 0.0);
  const Eigen::Vector3d stem = body.position + bow;
  const Eigen::Vector2f before = (stem.head<2>() - anchor).cast<float>();
  const WavePoint water = surface_at(waves, before.x(), before.y());
  const Eigen::Vector2d slope = Eigen::Vector2f(water.slope_x, water.slope_y).cast<double>();
  const double climbs = static_cast<double>(water.rate) + hull.speed * hull.way.dot(slope);
  const double sinks = -(body.velocity + body.angular_velocity.cross(bow)).z();
  // How far the stem is in the water: a bow that stands clear of it, or is deep in it, does not strike it.
  const double depth = level + static_cast<double>(water.elevation) - stem.z();
  const double struck = std::clamp((depth + 1.5) / 1.5, 0.0, 1.0) * std::clamp((4.0 - depth) / 2.0, 0.0, 1.0);
  hull.bow_water = static_cast<double>(water.elevation);
  hull.slam = struck * (climbs + sinks);
  return hull;
}

}  // namespace

Eigen::Vector2d flow_of(std::span<const SurfaceParticle> particles, std::span<const MomentWave> waves) {
  if (particles.empty()) return Eigen::Vector2d::Zero();
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const SurfaceParticle& particle : particles) sum += particle.velocity.head<2>().cast<double>();
  double orbital = 0.04;  // (m/s)^2
  for (const MomentWave& wave : waves) orbital += 0.5 * std::pow(static_cast<double>(wave.amplitude * wave.omega), 2);
  const Eigen::Vector2d mean = sum / static_cast<double>(particles.size());
  return std::clamp(mean.norm() / std::sqrt(orbital) - 1.0, 0.0, 1.0) * mean;
}

std::vector<MovingHull> moving_hulls(std::span<const BodyState> bodies, const std::map<std::uint32_t, HullBox>& boxes,
                                     const WaveMoment& waves, const Eigen::Vector2d& anchor, double level,
                                     const Eigen::Vector2d& flow) {
  std::vector<MovingHull> hulls;
  for (const BodyState& body : bodies) {
    const auto box = boxes.find(body.body);
    if (box == boxes.end()) continue;
    const double reach = 0.5 * (box->second.high - box->second.low).z() + 3.0;  // m; waves may stand so high
    const double middle = body.position.z() + 0.5 * (box->second.high + box->second.low).z();
    if (std::abs(middle - level) > reach) continue;
    hulls.push_back(hull_of(body, box->second, waves, anchor, level, flow));
  }
  return hulls;
}

}  // namespace pelagos
