#include <cmath>
#include <numbers>

#include "graphics_fixture.hpp"
#include "renderer/fluid.hpp"
#include "renderer/renderer.hpp"

namespace pelagos {
namespace {

constexpr int kWidth = 160, kHeight = 96, kGuard = 16;

RenderSettings settings() { return {kWidth, kHeight, kGuard, Quality::kHigh, true}; }

/// Looks north-east and a little down from high above the world's origin, far out so that floats would suffer.
Camera test_camera() {
  Channel channel;
  channel.mount.eye = {20'000.0, -35'000.0, 12.0};
  channel.mount.heading_deg = 37.0;
  channel.mount.tilt_deg = -9.0;
  channel.horizontal_fov_deg = 50.0;
  channel.guard_px = kGuard;
  return camera_for(channel, {}, kWidth, kHeight).value();
}

/// Linear depth of the nearest ellipsoid along a ray of unit depth, in double precision; 0 if none is hit.
double depth_by_hand(const Eigen::Vector3d& ray, const std::vector<SurfaceParticle>& particles,
                     const Eigen::Vector3d& origin, const Eigen::Vector3d& eye) {
  double nearest = 0.0;
  for (const SurfaceParticle& p : particles) {
    const Eigen::Matrix3d inverse = p.semi_axes.cast<double>().cwiseInverse().asDiagonal() *
                                    p.orientation.cast<double>().toRotationMatrix().transpose();
    const Eigen::Vector3d a = inverse * ray, b = inverse * (p.position.cast<double>() + origin - eye);
    const double discriminant = a.dot(b) * a.dot(b) - a.squaredNorm() * (b.squaredNorm() - 1.0);
    if (discriminant <= 0.0) continue;
    const double t = (a.dot(b) - std::sqrt(discriminant)) / a.squaredNorm();
    if (t > 0.0 && (nearest == 0.0 || t < nearest)) nearest = t;
  }
  return nearest;
}

struct Comparison {
  double largest_error = 0.0;  // relative
  int hits = 0;                // both see a surface
  int disagreements = 0;       // only one does: silhouettes
};

Comparison compare(const std::vector<SurfaceParticle>& particles) {
  const Camera camera = test_camera();
  SeaMoment moment;
  moment.origin = camera.eye;
  moment.particles = particles;
  Renderer renderer(settings());
  const std::vector<float> drawn = renderer.draw_particle_depth(camera, moment);
  const FluidSize size = fluid_size_of(camera, 1.0);
  Comparison result;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const double u = (2.0 * (x + 0.5) / size.width - 1.0) * size.tan_half_x / camera.tan_half_x;
      const double v = (2.0 * (y + 0.5) / size.height - 1.0) * size.tan_half_y / camera.tan_half_y;
      const double expected = depth_by_hand(camera.ray(u, v), particles, moment.origin, camera.eye);
      const double found = static_cast<double>(drawn[static_cast<std::size_t>(y * size.width + x)]);
      if ((expected > 0.0) != (found > 0.0)) {
        ++result.disagreements;
      } else if (expected > 0.0) {
        ++result.hits;
        result.largest_error = std::max(result.largest_error, std::abs(found / expected - 1.0));
      }
    }
  return result;
}

/// A particle `depth` metres ahead, shifted right and up.
SurfaceParticle ahead(double depth, double right, double up, float radius) {
  const Camera camera = test_camera();
  SurfaceParticle particle;
  particle.position = (camera.view_from_world.transpose() * Eigen::Vector3d(right, up, depth)).cast<float>();
  particle.semi_axes.setConstant(radius);
  return particle;
}

TEST_F(Graphics, SpheresLieAtTheirLinearDepth) {
  const std::vector<SurfaceParticle> spheres = {ahead(10, 0, 0, 1.0F), ahead(12, 0.8, 0.3, 1.5F),
                                                ahead(40, -6, 4, 3.0F), ahead(200, 60, 20, 12.0F)};
  const Comparison result = compare(spheres);
  EXPECT_GT(result.hits, 1500);
  // float: the discriminant loses up to (distance / radius)^2 of 6e-8 near the silhouette
  EXPECT_LT(result.largest_error, 2e-4);
  EXPECT_LE(result.disagreements, 4) << "pixels whose centre is within rounding of a silhouette";
}

TEST_F(Graphics, EllipsoidsKeepTheirOrientation) {
  std::vector<SurfaceParticle> ellipsoids;
  for (int k = 0; k < 4; ++k) {
    SurfaceParticle particle = ahead(15.0 + k, 3.0 * (k - 1.5), 1.0 - 0.5 * k, 1.0F);
    particle.semi_axes = {2.0F, 0.9F, 0.3F};
    particle.orientation = Eigen::Quaternionf(Eigen::AngleAxisf(
        0.4F + 0.7F * static_cast<float>(k), Eigen::Vector3f(1.0F, -0.5F, 0.3F * static_cast<float>(k)).normalized()));
    ellipsoids.push_back(particle);
  }
  const Comparison result = compare(ellipsoids);
  EXPECT_GT(result.hits, 800);
  EXPECT_LT(result.largest_error, 2e-4);
  EXPECT_LE(result.disagreements, 4);
}

TEST_F(Graphics, ParticlesBehindOrAroundTheEyeAreLeftOut) {
  std::vector<SurfaceParticle> particles = {ahead(-10, 0, 0, 1.0F), ahead(0.1, 0, 0, 1.0F)};
  const Camera camera = test_camera();
  SeaMoment moment;
  moment.origin = camera.eye;
  moment.particles = particles;
  Renderer renderer(settings());
  for (const float depth : renderer.draw_particle_depth(camera, moment)) ASSERT_EQ(depth, 0.0F);
}

TEST_F(Graphics, ParticlesGoOnWithTheirVelocity) {
  std::vector<SurfaceParticle> particles = {ahead(20, 0, 0, 1.0F)};
  const Camera camera = test_camera();
  particles[0].velocity = -10.0F * particles[0].position.normalized();  // towards the eye
  SeaMoment moment;
  moment.origin = camera.eye;
  moment.particles = particles;
  moment.ahead = 0.2;
  Renderer renderer(settings());
  const std::vector<float> depth = renderer.draw_particle_depth(camera, moment);
  const FluidSize size = fluid_size_of(camera, 1.0);
  // 20 - 2 - 1 (radius); the pixel's centre is half a pixel off the middle, 5 cm on the sphere, which costs 2.5 mm
  EXPECT_NEAR(depth[static_cast<std::size_t>((size.height / 2) * size.width + size.width / 2)], 17.0F, 4e-3F);
}

}  // namespace
}  // namespace pelagos
