#include <algorithm>
#include <cmath>

#include "../support/places.hpp"
#include "graphics_fixture.hpp"
#include "renderer/renderer.hpp"
#include "source/frame_source.hpp"

namespace pelagos {
namespace {

const std::filesystem::path kAssets = test::source_path("assets");
constexpr int kWidth = 320, kHeight = 180;

struct Drawn {
  Picture picture{1, 1};
  std::vector<float> depth;
};

class SyntheticSea {
 public:
  explicit SyntheticSea(int guard, const Weather& weather = {})
      : renderer_({kWidth, kHeight, guard, Quality::kMedium, true, weather}), guard_(guard) {
    set_scene(renderer_, synthetic_scene(), kAssets / "meshes");
    fill_synthetic_frame(12.0, frame_);
  }
  OceanFrame& frame() { return frame_; }

  Drawn draw(const std::string& name) {
    Channel channel = *load_rig(kAssets / "rigs/ship_bridge.json").find(name);
    channel.guard_px = guard_;
    SeaMoment moment;
    moment.time = frame_.simulation_time;
    moment.origin = frame_.origin;
    moment.particles = frame_.particles;
    moment.bodies = frame_.bodies;
    renderer_.draw(camera_for(channel, frame_.bodies, kWidth, kHeight).value(), moment);
    return {renderer_.read_picture(), renderer_.read_depth()};
  }

 private:
  Renderer renderer_;
  int guard_;
  OceanFrame frame_;
};

double mean_colour(const Picture& picture, int channel, int first_row, int last_row) {
  double sum = 0.0;
  for (int y = first_row; y < last_row; ++y)
    for (int x = 0; x < picture.width; ++x) sum += picture.at(x, y)[channel];
  return sum / (picture.width * (last_row - first_row));
}

/// Mean absolute difference of two columns, of colours in 1/255.
double colour_step(const Picture& a, int column_a, const Picture& b, int column_b) {
  double sum = 0.0;
  for (int y = 0; y < a.height; ++y)
    for (int k = 0; k < 3; ++k) sum += std::abs(a.at(column_a, y)[k] - b.at(column_b, y)[k]);
  return sum / (3 * a.height);
}

/// Median over rows of the relative difference in depth, where both see something.
double depth_step(const std::vector<float>& a, int column_a, const std::vector<float>& b, int column_b) {
  std::vector<double> steps;
  for (int y = 0; y < kHeight; ++y) {
    const float za = a[static_cast<std::size_t>(y * kWidth + column_a)],
                zb = b[static_cast<std::size_t>(y * kWidth + column_b)];
    if (za > 0.0F && zb > 0.0F) steps.push_back(std::abs(static_cast<double>(za / zb) - 1.0));
  }
  std::sort(steps.begin(), steps.end());
  return steps.empty() ? 1.0 : steps[steps.size() / 2];
}

TEST_F(Graphics, SeaIsBelowSkyAndDarker) {
  SyntheticSea sea(64);
  const Drawn port = sea.draw("port");
  EXPECT_GT(mean_colour(port.picture, 0, 0, 40), mean_colour(port.picture, 0, 120, 180) + 30.0);
  EXPECT_GT(mean_colour(port.picture, 2, 120, 180), mean_colour(port.picture, 0, 120, 180)) << "water is blue";
  // every pixel of the lower half is water or ship: the far sea has no hole
  for (int y = 0; y < kHeight / 2; ++y)
    for (int x = 0; x < kWidth; ++x)
      ASSERT_GT(port.depth[static_cast<std::size_t>(y * kWidth + x)], 0.0F) << x << " " << y;
}

TEST_F(Graphics, OilIsBrownWhereItLies) {
  SyntheticSea sea(64);
  const Drawn clean = sea.draw("port");
  for (SurfaceParticle& particle : sea.frame().particles) particle.phase = 1;
  const Drawn oily = sea.draw("port");
  int changed = 0, brown = 0, blue = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const std::uint8_t *before = clean.picture.at(x, y), *after = oily.picture.at(x, y);
      if (std::abs(before[2] - after[2]) < 8) continue;
      ++changed;
      brown += after[0] - after[2] > before[0] - before[2] ? 1 : 0;
      blue += after[0] - after[2] < before[0] - before[2] ? 1 : 0;
    }
  EXPECT_GT(changed, kWidth * kHeight / 50);
  EXPECT_GT(brown, 10 * blue);
}

TEST_F(Graphics, ChannelsMeetWithoutASeam) {
  SyntheticSea sea(64);
  const Drawn port = sea.draw("port"), centre = sea.draw("centre");
  const int last = kWidth - 1;
  // Neighbouring columns of one channel are the yardstick: the border between two channels may differ no more than
  // 1.5 times that, for it is measured on one pair of columns only.
  const double inside = 0.5 * (colour_step(port.picture, last - 1, port.picture, last) +
                               colour_step(centre.picture, 0, centre.picture, 1));
  EXPECT_LT(colour_step(port.picture, last, centre.picture, 0), 1.5 * inside + 0.5);
  const double inside_depth =
      0.5 * (depth_step(port.depth, last - 1, port.depth, last) + depth_step(centre.depth, 0, centre.depth, 1));
  // depths are along each channel's own axis; at their common border these axes are mirror images, so they agree
  EXPECT_LT(depth_step(port.depth, last, centre.depth, 0), 1.5 * inside_depth + 1e-3);
}

TEST_F(Graphics, ShipStandsInTheQuarterView) {
  SyntheticSea sea(32);
  const Drawn with_ship = sea.draw("quarter");
  const OceanFrame frame = sea.frame();
  // the funnel: an orange pixel is neither sky, sea nor foam
  int orange = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const std::uint8_t* c = with_ship.picture.at(x, y);
      orange += c[0] > 120 && c[0] > 2 * c[2];
    }
  EXPECT_GT(orange, 20);
}

/// Pixels that are nearly white in the lower part of a picture.
int white_pixels(const Picture& picture) {
  int white = 0;
  for (int y = picture.height / 3; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) white += picture.at(x, y)[0] > 170 && picture.at(x, y)[2] > 170;
  return white;
}

/// A sea with a ship that goes at that speed over ground, in water that flows against her.
int white_about_a_ship(double speed, double flow_against) {
  SyntheticSea sea(32);
  BodyState& ship = sea.frame().bodies.front();
  const Eigen::Vector3d way = ship.velocity.normalized();
  ship.velocity = speed * way;
  for (SurfaceParticle& particle : sea.frame().particles) {
    particle.foam = 0;
    particle.velocity = (-flow_against * way).cast<float>();
  }
  return white_pixels(sea.draw("above").picture);
}

TEST_F(Graphics, AHullLeavesAWakeByItsSpeedThroughTheWater) {
  const int at_rest = white_about_a_ship(0.0, 0.0), slow = white_about_a_ship(3.0, 0.0),
            fast = white_about_a_ship(7.2, 0.0);
  EXPECT_GT(slow, at_rest + 50);
  EXPECT_GT(fast, slow + 200) << "the wash tells the speed";
  // The same ship held against a current
  EXPECT_NEAR(white_about_a_ship(0.0, 7.2), fast, 0.1 * fast);
}

/// Where the patch stands apart from the waves around, its rim must not be drawn as a wall between the two.
TEST_F(Graphics, APatchApartFromTheSeaAroundMakesNoWall) {
  SyntheticSea sea(32);
  sea.frame().bodies.front().position.z() = 4.0;
  const Drawn level = sea.draw("starboard");
  for (SurfaceParticle& particle : sea.frame().particles) particle.position.z() -= 2.0F;
  const Drawn low = sea.draw("starboard");
  // Going up a column the depth grows; on a wall it would stand still.
  const auto standing = [](const Drawn& drawn) {
    int count = 0;
    for (int x = 0; x < kWidth; ++x)
      for (int y = 1; y < kHeight / 2; ++y) {
        const auto at = static_cast<std::size_t>(y * kWidth + x);
        const float here = drawn.depth[at], below = drawn.depth[at - kWidth];
        count += here > 15.0F && here < 60.0F && std::abs(here - below) < 1e-3F * here;
      }
    return count;
  };
  EXPECT_LE(standing(low), standing(level) + kWidth * kHeight / 400);
}

/// A roof over the water: its shadow lies where the sun's rays say, and is gone where clouds hide the sun.
TEST_F(Graphics, BodiesShadeTheWater) {
  const auto brightness = [](double cloud_oktas, bool roof) {
    Renderer renderer({kWidth, kHeight, 32, Quality::kMedium, true, {.cloud_oktas = cloud_oktas}});
    SceneInfo scene = synthetic_scene();
    scene.sea = WaveField({}, 0.0);
    renderer.set_scene(scene);
    renderer.set_meshes({{1, std::make_shared<const MeshData>(draw_box({-10, -10, 0}, {10, 10, 1}))}});
    // The sun is at 38 degrees over the west-south-west: from 20 m up the shadow falls 25.3 m to the north-east.
    BodyState body;
    body.body = 1;
    const Eigen::Vector3d place(20.0, 15.5, 0.0), sun = sky_at({}, {}, 0.0).sun;
    body.position = place + 20.0 / sun.z() * sun;
    Channel channel;
    channel.mount.eye = place + Eigen::Vector3d(0, -16, 12);
    channel.yaw_deg = -90;  // to the north
    channel.pitch_deg = -36.9;
    channel.horizontal_fov_deg = 20.0;
    SeaMoment moment;
    moment.bodies = std::span(&body, roof ? 1 : 0);
    renderer.draw(camera_for(channel, {}, kWidth, kHeight).value(), moment);
    return mean_colour(renderer.read_picture(), 1, kHeight / 3, 2 * kHeight / 3);
  };
  EXPECT_LT(brightness(0.0, true), 0.93 * brightness(0.0, false));
  EXPECT_NEAR(brightness(8.0, true), brightness(8.0, false), 1.0);
}

/// A white slanted plate before the water: pixels on its edge have colours between.
TEST_F(Graphics, EdgesOfBodiesAreSmooth) {
  const auto between = [](Quality quality) {
    Renderer renderer({kWidth, kHeight, 32, quality, true, {}});
    SceneInfo scene = synthetic_scene();
    scene.sea = WaveField({}, 0.0);
    renderer.set_scene(scene);
    MeshData plate = draw_box({-0.1, -3, -3}, {0.1, 3, 3});
    for (MeshData::Vertex& vertex : plate.vertices)
      for (float& part : vertex.colour) part = 1.0F;
    renderer.set_meshes({{1, std::make_shared<const MeshData>(plate)}});
    BodyState body;
    body.body = 1;
    body.position = {30.0, 0.0, 4.0};
    body.orientation = Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitX());
    Channel channel;
    channel.mount.eye = {0.0, 0.0, 20.0};
    channel.pitch_deg = -28.0;
    channel.horizontal_fov_deg = 30.0;
    channel.guard_px = 32;
    SeaMoment moment;
    moment.bodies = std::span(&body, 1);
    renderer.draw(camera_for(channel, {}, kWidth, kHeight).value(), moment);
    const Picture picture = renderer.read_picture();
    const int inside = picture.at(kWidth / 2, kHeight / 2)[0], water = picture.at(10, 10)[0];
    EXPECT_GT(inside, water + 60);
    int count = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const int red = picture.at(x, y)[0];
        count += red > water + (inside - water) / 4 && red < inside - (inside - water) / 4;
      }
    return count;
  };
  // Its edges are some 400 pixels long.
  EXPECT_GT(between(Quality::kHigh), 100);
  EXPECT_LT(between(Quality::kLow), 60);
}

/// A tank of 5 m by 3 m with half a metre of water, from the corner.
Drawn draw_tank_of_water(bool walls_visible, bool water) {
  Renderer renderer({kWidth, kHeight, 32, Quality::kMedium, true, {}});
  SceneInfo scene = synthetic_scene();
  scene.bodies.clear();
  scene.particle_spacing = 0.1;
  scene.patch = {{0, 0, 0}, {5, 3, 2}};
  scene.water_level = 0.5;
  scene.sea = WaveField({}, 0.5);
  scene.tank_walls_visible = walls_visible;
  renderer.set_scene(scene);
  OceanFrame frame;
  for (double x = 0.05; x < 5.0; x += 0.1)
    for (double y = 0.05; water && y < 3.0; y += 0.1) {
      SurfaceParticle particle;
      particle.position = Eigen::Vector3d(x - 2.5, y - 1.5, 0.45).cast<float>();
      particle.semi_axes = {0.095F, 0.095F, 0.07F};
      frame.particles.push_back(particle);
    }
  Channel channel;
  channel.mount.eye = {-2.5, -2.5, 3.0};
  channel.yaw_deg = -45.0;
  channel.pitch_deg = -22.0;
  channel.horizontal_fov_deg = 70.0;
  channel.guard_px = 32;
  SeaMoment moment;
  moment.origin = {2.5, 1.5, 0.0};
  moment.particles = frame.particles;
  renderer.draw(camera_for(channel, {}, kWidth, kHeight).value(), moment);
  return {renderer.read_picture(), renderer.read_depth()};
}

TEST_F(Graphics, WallsThatAreVisibleStandOnTheGround) {
  const Drawn full = draw_tank_of_water(true, true), empty = draw_tank_of_water(true, false),
              sea = draw_tank_of_water(false, true);
  const auto blueness = [](const Picture& picture, int x, int y) { return picture.at(x, y)[2] - picture.at(x, y)[0]; };
  EXPECT_GT(blueness(sea.picture, 20, kHeight - 10), 20) << "a sea lies around a patch without walls";
  EXPECT_LT(blueness(full.picture, 20, kHeight - 10), 15) << "ground lies around a tank";
  int changed = 0, wet = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const auto at = static_cast<std::size_t>((kHeight - 1 - y) * kWidth + x);
      changed += full.depth[at] > 0.0F && std::abs(full.depth[at] / std::max(empty.depth[at], 1e-6F) - 1.0F) > 0.02F;
      wet += blueness(full.picture, x, y) > blueness(empty.picture, x, y) + 4;
    }
  EXPECT_GT(changed, 2000) << "the water covers the floor, up to the walls";
  EXPECT_GT(wet, changed / 3);
}

TEST_F(Graphics, NightIsDarkAndFogHidesTheHorizon) {
  const Picture day = SyntheticSea(32).draw("port").picture;
  // 23:00 at the origin of the synthetic scene, latitude and longitude 0
  const Picture night = SyntheticSea(32, {.utc = 1'790'031'600.0}).draw("port").picture;
  const Picture fog = SyntheticSea(32, {.visibility = 300.0}).draw("port").picture;
  EXPECT_LT(mean_colour(night, 1, 0, kHeight), 0.35 * mean_colour(day, 1, 0, kHeight));
  EXPECT_GT(mean_colour(night, 1, 0, kHeight), 3.0) << "not black";
  // Rows above and below the horizon, which lies at a third of the height
  const auto step = [](const Picture& picture) {
    return std::abs(mean_colour(picture, 0, 30, 36) - mean_colour(picture, 0, 62, 68));
  };
  EXPECT_GT(step(day), 20.0);
  EXPECT_LT(step(fog), 0.3 * step(day));
}

TEST_F(Graphics, SameFrameGivesTheSamePicture) {
  SyntheticSea sea(32);
  const Drawn first = sea.draw("starboard");
  (void)sea.draw("port");
  EXPECT_EQ(first.picture.rgb, sea.draw("starboard").picture.rgb);
}

TEST_F(Graphics, DrawsWithoutParticlesBodiesOrWaves) {
  Renderer renderer({kWidth, kHeight, 32, Quality::kLow, true});
  SceneInfo flat = synthetic_scene();
  flat.sea = WaveField({}, flat.water_level);
  flat.bodies = {{4, "unknown", "no_such.obj", 1.0}};
  set_scene(renderer, flat, kAssets / "meshes");
  Channel channel;
  channel.mount.eye = {0, 0, 10};
  channel.mount.tilt_deg = -5;
  renderer.draw(camera_for(channel, {}, kWidth, kHeight).value(), {});
  const std::vector<float> depth = renderer.read_depth();
  // A flat sea 10 m below: depth of the lowest row's middle is 10 m over the downward part of its ray (unit depth).
  const Camera camera = camera_for(channel, {}, kWidth, kHeight).value();
  const Eigen::Vector3d ray = camera.ray(1.0 / kWidth, -1.0 + 1.0 / kHeight);
  EXPECT_NEAR(depth[kWidth / 2], -10.0 / ray.z(), 1e-3 * -10.0 / ray.z()) << "interpolation in single precision";
}

TEST_F(Graphics, AFrameOfHugeEllipsoidsIsDrawnInTime) {
  constexpr float kSize = 8.0F;  // m: nearly fills the picture, the eye is outside
  SyntheticSea sea(32);
  for (SurfaceParticle& particle : sea.frame().particles) particle.semi_axes.setConstant(kSize);
  for (std::size_t i = 0; sea.frame().particles.size() < 1'500'000; ++i)
    sea.frame().particles.push_back(SurfaceParticle(sea.frame().particles[i]));
  const auto start = std::chrono::steady_clock::now();
  (void)sea.draw("starboard");
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30)) << "without a bound it takes a minute";
}

}  // namespace
}  // namespace pelagos
