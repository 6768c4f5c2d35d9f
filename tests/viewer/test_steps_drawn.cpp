// The rim of the patch and the horizon in pictures: neither may be a line.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "graphics_fixture.hpp"
#include "source/frame_source.hpp"
#include "waves/sea_state.hpp"
#include "waves/wave_moment.hpp"

namespace pelagos {
namespace {

constexpr int kWidth = 480, kHeight = 270, kGuard = 48;
// s: a line lies in all of them, crests of waves do not
constexpr std::array<double, 4> kTimes = {12.0, 14.3, 17.1, 19.9};
constexpr double kMostStep = 2.0;    // 1/255, of the rows' mean luminance above the steps beside it
constexpr double kLongWaves = 10.0;  // spacings: longer ones are the simulation's own inside the patch

SceneInfo sea_of_force(int beaufort) {
  SceneInfo scene = synthetic_scene();
  scene.bodies.clear();
  scene.patch = {{-45.0, -35.0, -6.0}, {45.0, 35.0, 18.0}};
  scene.sea =
      WaveField(make_wave_components({.beaufort = beaufort, .wave_to_deg = 65.0, .components = 60, .seed = 21}), 0.0);
  return scene;
}

/// Particles whose surface is that of the long waves around, moved up by `raised` m.
std::vector<SurfaceParticle> water_of(const SceneInfo& scene, double time, double raised) {
  std::vector<WaveComponent> longer;
  for (const WaveComponent& wave : scene.sea.components())
    if (2.0 * std::numbers::pi / static_cast<double>(wave.wavenumber) > kLongWaves * scene.particle_spacing)
      longer.push_back(wave);
  const WaveMoment waves = WaveField(longer, 0.0).at(time, {0, 0});
  std::vector<float> x, y;
  for (double east = -44.5; east < 45.0; east += 1.0)
    for (double north = -34.5; north < 35.0; north += 1.0) {
      x.push_back(static_cast<float>(east));
      y.push_back(static_cast<float>(north));
    }
  std::vector<float> values[6];
  for (auto& one : values) one.resize(x.size());
  evaluate_displaced_surface(waves, x, y, {values[0], values[1], values[2], values[3], values[4], values[5]});
  std::vector<SurfaceParticle> particles;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (int layer = 0; layer < 2; ++layer) {
      SurfaceParticle particle;
      particle.position = {x[i], y[i], values[0][i] + static_cast<float>(raised) - 0.62F - static_cast<float>(layer)};
      particle.orientation = Eigen::Quaternionf::FromTwoVectors(
          Eigen::Vector3f::UnitZ(), Eigen::Vector3f(-values[1][i], -values[2][i], 1.0F).normalized());
      particle.semi_axes = {0.95F, 0.88F, 0.68F};
      particles.push_back(particle);
    }
  return particles;
}

using RowMeans = std::array<double, kHeight>;  // luminance in 1/255, first row on top

void add_row_means(const Picture& picture, double share, RowMeans& means) {
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const std::uint8_t* c = picture.at(x, y);
      means[static_cast<std::size_t>(y)] += share * (0.299 * c[0] + 0.587 * c[1] + 0.114 * c[2]) / kWidth;
    }
}

/// Of the sea and a patch in it that stands `raised` m too high.
RowMeans draw(const SceneInfo& scene, double raised) {
  Renderer renderer({kWidth, kHeight, kGuard, Quality::kMedium, true, {}});
  renderer.set_scene(scene);
  Channel channel;  // as the view `rim`: 14 m from the middle, to the north
  channel.mount.eye = {0.0, 14.0, 6.0};
  channel.yaw_deg = -90.0;
  channel.pitch_deg = -8.0;
  channel.horizontal_fov_deg = 60.0;
  channel.guard_px = kGuard;
  RowMeans means{};
  for (const double time : kTimes) {
    const std::vector<SurfaceParticle> particles = water_of(scene, time, raised);
    SeaMoment moment;
    moment.time = time;
    moment.particles = particles;
    renderer.draw(camera_for(channel, {}, kWidth, kHeight).value(), moment);
    add_row_means(renderer.read_picture(), 1.0 / kTimes.size(), means);
  }
  return means;
}

/// By how much the rows' mean luminance steps more than at the two pairs of rows above and below, at most.
double worst_step(const RowMeans& mean, int first, int last) {
  const auto step = [&](int y) {
    return std::abs(mean[static_cast<std::size_t>(y + 1)] - mean[static_cast<std::size_t>(y)]);
  };
  double worst = 0.0;
  for (int y = first; y < last; ++y)
    worst = std::max(worst, step(y) - std::max({step(y - 2), step(y - 1), step(y + 1), step(y + 2)}));
  return worst;
}

constexpr int kHorizon = 77;                                // row: 8 degrees above the middle
constexpr int kFirstOfRim = 185, kLastOfRim = kHeight - 4;  // the edge of the patch is seen in row 193

class Steps : public Graphics, public testing::WithParamInterface<int> {};

TEST_P(Steps, RimAndHorizonAreNoLines) {
  if (IsSkipped()) return;
  const SceneInfo scene = sea_of_force(GetParam());
  const RowMeans joined = draw(scene, 0.0);
  EXPECT_LE(worst_step(joined, kHorizon - 9, kHorizon + 9), kMostStep) << "horizon";
  EXPECT_LE(worst_step(joined, kFirstOfRim, kLastOfRim), kMostStep) << "rim";
  // Waves inside may differ from those around.
  EXPECT_LE(worst_step(draw(scene, 0.3), kFirstOfRim, kLastOfRim), kMostStep) << "raised by 0.3 m";
}

INSTANTIATE_TEST_SUITE_P(Forces, Steps, testing::Values(2, 5, 8));

/// The measure itself.
TEST(StepsMeasure, FindsALine) {
  RowMeans means{};
  for (std::size_t y = 0; y < means.size(); ++y) means[y] = 0.3 * static_cast<double>(y);
  EXPECT_NEAR(worst_step(means, 5, 200), 0.0, 1e-9) << "an even slope is no line";
  for (std::size_t y = 100; y < means.size(); ++y) means[y] += 5.0;
  EXPECT_NEAR(worst_step(means, 5, 200), 5.0, 1e-9);
}

}  // namespace
}  // namespace pelagos
