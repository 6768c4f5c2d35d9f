#include <algorithm>
#include <cmath>

#include "../support/places.hpp"
#include "graphics_fixture.hpp"
#include "renderer/renderer.hpp"
#include "source/frame_source.hpp"

namespace pelagos {
namespace {

constexpr int kWidth = 320, kHeight = 180;
const Eigen::Vector3d kMiddle(20'000.0, -35'000.0, 0.0);  // m, world: far out, so that floats would suffer

/// An element of 10 kg at a place relative to kMiddle.
SlickDisc disc(double x, double y, float radius, float thickness, float water = 0.0F) {
  return {static_cast<float>(x), static_cast<float>(y), 0.0F, radius, thickness, 10.0F, water, {}, false};
}

/// Looks down at kMiddle at an angle, from 40 m south of it and 30 m above a flat sea, or a part of that.
Camera oblique_camera(double yaw_deg = 0.0, double part = 1.0) {
  Channel channel;
  channel.mount.eye = {kMiddle.y() - 40.0 * part, -kMiddle.x(), 30.0 * part};  // axes of the mount: north, west, up
  channel.mount.heading_deg = 0.0;
  channel.mount.tilt_deg = -36.0;
  channel.yaw_deg = yaw_deg;
  channel.horizontal_fov_deg = 50.0;
  return camera_for(channel, {}, kWidth, kHeight).value();
}

/// A flat sea without wind, so that whatever differs is the oil.
class FlatSea {
 public:
  explicit FlatSea(Quality quality = Quality::kMedium) : renderer_({kWidth, kHeight, 32, quality, true}) {
    SceneInfo scene;
    scene.particle_spacing = 1.0;
    renderer_.set_scene(scene);
  }
  Picture draw(const std::vector<SlickDisc>& discs, const Camera& camera = oblique_camera()) {
    SeaMoment moment;
    moment.slick = {discs, kMiddle};
    moment.wind = Eigen::Vector2d(3.0, 0.0);
    renderer_.draw(camera, moment);
    return renderer_.read_picture();
  }

 private:
  Renderer renderer_;
};

/// Distance of the place on the flat sea that a pixel shows from kMiddle, m; huge for sky.
double distance_shown(const Camera& camera, int x, int y) {
  const Eigen::Vector3d ray = camera.ray(2.0 * (x + 0.5) / kWidth - 1.0, 1.0 - 2.0 * (y + 0.5) / kHeight);
  if (ray.z() >= 0.0) return 1e9;
  return (camera.eye - kMiddle - ray * (camera.eye.z() / ray.z())).head<2>().norm();
}

double brightness(const std::uint8_t* c) { return (c[0] + c[1] + c[2]) / 3.0; }
int redness(const std::uint8_t* c) { return c[0] - c[2]; }
int difference(const std::uint8_t* a, const std::uint8_t* b) {
  return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

/// Mean of a property of the pixels that show the sea within `radius` of kMiddle.
template <class Property>
double mean_within(const Picture& picture, double radius, Property&& property) {
  double sum = 0.0;
  int count = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      if (distance_shown(oblique_camera(), x, y) > radius) continue;
      sum += property(picture.at(x, y));
      ++count;
    }
  EXPECT_GT(count, 100);
  return sum / count;
}

int largest_difference(const Picture& a, const Picture& b) {
  int largest = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) largest = std::max(largest, difference(a.at(x, y), b.at(x, y)));
  return largest;
}

double mean_difference(const Picture& a, const Picture& b) {
  double sum = 0.0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) sum += difference(a.at(x, y), b.at(x, y));
  return sum / (kWidth * kHeight);
}

TEST_F(Graphics, SlickIsDarkWhereItLiesAndNowhereElse) {
  FlatSea sea;
  const float radius = 5.0F;
  const Picture clean = sea.draw({});
  const Picture oily = sea.draw({disc(0.0, 0.0, radius, 2e-3F)});
  int inside = 0, darker = 0, browner = 0, beyond = 0, changed = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double away = distance_shown(oblique_camera(), x, y);
      if (away < 0.7 * radius) {
        ++inside;
        darker += brightness(oily.at(x, y)) < brightness(clean.at(x, y)) - 3.0;
        browner += redness(oily.at(x, y)) > redness(clean.at(x, y)) + 20.0;
      } else if (away > 5.0 * radius) {  // the fringe of sheen ends at four radii, and edges are ragged
        ++beyond;
        changed += difference(oily.at(x, y), clean.at(x, y)) > 0;
      }
    }
  EXPECT_GT(inside, 300);
  EXPECT_GT(darker, 0.95 * inside);
  EXPECT_EQ(browner, inside);
  EXPECT_GT(beyond, kWidth * kHeight / 5);
  EXPECT_EQ(changed, 0);
}

TEST_F(Graphics, SlickLooksAsItsThicknessSays) {
  FlatSea sea;
  const auto seen = [&](float thickness, float water = 0.0F) {
    return sea.draw({disc(0.0, 0.0, 8.0F, thickness, water)});
  };
  const Picture clean = sea.draw({});
  EXPECT_LE(largest_difference(clean, seen(0.1e-9F)), 1) << "thinner than anybody sees";
  EXPECT_EQ(largest_difference(clean, seen(0.0F)), 0);
  const double water = mean_within(clean, 4.0, brightness);
  EXPECT_GT(mean_within(seen(0.09e-6F), 4.0, brightness), water + 3.0) << "sheen is silvery";
  EXPECT_LT(mean_within(seen(0.5e-3F), 4.0, brightness), water - 5.0) << "true colour is dark";
  EXPECT_GT(mean_within(seen(0.5e-3F), 4.0, redness), mean_within(clean, 4.0, redness) + 10.0) << "brown, not blue";
  EXPECT_GT(mean_within(seen(5e-3F, 0.7F), 4.0, redness), mean_within(seen(5e-3F), 4.0, redness) + 10.0)
      << "an emulsion is reddish";
}

TEST_F(Graphics, RainbowFilmsAreColourfulAndMetallicOnesAreNot) {
  FlatSea sea;
  const Camera near = oblique_camera(0.0, 0.15);
  // How much pixels differ in hue, as standard deviation of red less blue, 1/255.
  const auto variety = [&](float thickness) {
    const Picture picture = sea.draw({disc(0.0, 0.0, 20.0F, thickness)}, near);
    double sum = 0.0, squares = 0.0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        sum += redness(picture.at(x, y));
        squares += std::pow(redness(picture.at(x, y)), 2);
      }
    const double mean = sum / (kWidth * kHeight);
    return std::sqrt(squares / (kWidth * kHeight) - mean * mean);
  };
  EXPECT_GT(variety(0.7e-6F), variety(15e-6F) + 2.0);
}

TEST_F(Graphics, OverlappingElementsAreAMeanNotASum) {
  FlatSea sea;
  const Picture one = sea.draw({disc(0.0, 0.0, 6.0F, 40e-6F)});
  const Picture many = sea.draw(std::vector<SlickDisc>(20, disc(0.0, 0.0, 6.0F, 40e-6F)));
  EXPECT_LE(largest_difference(one, many), 1);
  EXPECT_GT(largest_difference(one, sea.draw({disc(0.0, 0.0, 6.0F, 800e-6F)})), 10) << "their sum would show";
}

TEST_F(Graphics, OilHeldByABoomHasNoWideFringe) {
  FlatSea sea;
  const float radius = 5.0F;
  const auto changed_beyond = [&](bool contained) {
    SlickDisc held = disc(0.0, 0.0, radius, 2e-3F);
    held.contained = contained;
    const Picture clean = sea.draw({}), oily = sea.draw({held});
    int changed = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        changed +=
            distance_shown(oblique_camera(), x, y) > 2.5 * radius && difference(clean.at(x, y), oily.at(x, y)) > 0;
    return changed;
  };
  EXPECT_EQ(changed_beyond(true), 0);
  EXPECT_GT(changed_beyond(false), 100);
}

TEST_F(Graphics, SlickHasNoHardEdge) {
  FlatSea sea(Quality::kHigh);
  const Picture clean = sea.draw({});
  const Picture oily = sea.draw({disc(0.0, 0.0, 8.0F, 1e-6F)});
  // Along a row the picture of a thin film may not step by more than half of what the film changes at all.
  int largest_step = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 1; x < kWidth; ++x) {
      const double here = brightness(oily.at(x, y)) - brightness(clean.at(x, y));
      const double before = brightness(oily.at(x - 1, y)) - brightness(clean.at(x - 1, y));
      largest_step = std::max(largest_step, static_cast<int>(std::abs(here - before)));
    }
  EXPECT_LT(largest_step, largest_difference(oily, clean) / 2);
}

TEST_F(Graphics, SlickDoesNotJumpWhenItsMapGrows) {
  const auto slick = [](float radius) {
    return std::vector<SlickDisc>{disc(-6.0, 0.0, radius, 3e-6F), disc(5.0, 3.0, 0.7F * radius, 1e-3F)};
  };
  const auto length = [&](float radius) {
    const std::vector<SlickDisc> discs = slick(radius);
    return place_of({discs, kMiddle}, 512).length;
  };
  float below = 3.0F, above = 6.0F;
  ASSERT_LT(length(below), length(above));
  while (above - below > 1e-4F)
    (length(0.5F * (below + above)) > length(below) ? above : below) = 0.5F * (below + above);
  FlatSea sea;
  const Picture fine = sea.draw(slick(below)), coarse = sea.draw(slick(above)), grown = sea.draw(slick(1.1F * above));
  EXPECT_LT(mean_difference(fine, coarse), 0.05 * mean_difference(coarse, grown));
  EXPECT_LE(largest_difference(fine, coarse), 12) << "the steep edge of thick oil differs most";
}

TEST_F(Graphics, SlickThatDriftsDoesNotFlicker) {
  FlatSea sea;
  const auto drifted = [&](double by) {
    return sea.draw({disc(by - 6.0, 0.0, 4.0F, 3e-6F), disc(by + 5.0, 3.0, 3.0F, 1e-3F)});
  };
  const Picture before = drifted(0.0);
  double most = 0.0;  // a frame's drift at a time, over more than a texel of the map
  for (int frame = 1; frame <= 20; ++frame)
    most = std::max(most, mean_difference(drifted(0.01 * (frame - 1)), drifted(0.01 * frame)));
  EXPECT_LT(most, 0.1 * mean_difference(before, drifted(0.5)));
}

TEST_F(Graphics, SlickThatIsGoneLeavesNoTrace) {
  FlatSea sea;
  const Picture clean = sea.draw({});
  const Picture oily = sea.draw({disc(0.0, 0.0, 5.0F, 2e-3F)});
  EXPECT_GT(largest_difference(oily, clean), 10);
  EXPECT_EQ(largest_difference(sea.draw({}), clean), 0);
}

TEST_F(Graphics, SlickMeetsWithoutASeamBetweenChannels) {
  FlatSea sea;
  std::vector<SlickDisc> discs;
  for (int i = 0; i < 40; ++i)
    discs.push_back(disc(1.5 * i - 30.0, 4.0 * std::sin(0.7 * i), 4.0F, 1e-6F * (1 << i % 11)));
  const Picture left = sea.draw(discs, oblique_camera(-25.0)), right = sea.draw(discs, oblique_camera(25.0));
  const auto step = [](const Picture& a, int column_a, const Picture& b, int column_b) {
    double sum = 0.0;
    for (int y = 0; y < kHeight; ++y) sum += difference(a.at(column_a, y), b.at(column_b, y));
    return sum / kHeight;
  };
  // Neighbouring columns of one channel are the yardstick.
  const double inside = 0.5 * (step(left, kWidth - 2, left, kWidth - 1) + step(right, 0, right, 1));
  EXPECT_LT(step(left, kWidth - 1, right, 0), 1.5 * inside + 0.5);
  EXPECT_GT(step(left, kWidth - 1, sea.draw({}, oblique_camera(25.0)), 0), 1.5 * inside + 0.5) << "it lies there";
}

TEST_F(Graphics, HullHidesTheSlick) {
  Renderer renderer({kWidth, kHeight, 32, Quality::kLow, true});
  const std::filesystem::path assets = test::source_path("assets");
  set_scene(renderer, synthetic_scene(), assets / "meshes");
  OceanFrame frame;
  fill_synthetic_frame(12.0, frame);
  const Channel channel = *load_rig(assets / "rigs/ship_bridge.json").find("quarter");
  SeaMoment moment;
  moment.time = 12.0;
  moment.particles = frame.particles;
  moment.bodies = frame.bodies;
  const Camera camera = camera_for(channel, frame.bodies, kWidth, kHeight).value();
  renderer.draw(camera, moment);
  const Picture clean = renderer.read_picture();
  const std::vector<SlickDisc> discs{disc(0.0, 0.0, 100.0F, 2e-3F)};
  moment.slick = {discs, Eigen::Vector3d::Zero()};
  renderer.draw(camera, moment);
  const Picture oily = renderer.read_picture();
  int funnel = 0, changed = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const std::uint8_t* c = clean.at(x, y);
      if (c[0] > 120 && c[0] > 2 * c[2]) {  // orange: neither sky, sea nor foam
        ++funnel;
        EXPECT_EQ(difference(c, oily.at(x, y)), 0);
      } else {
        changed += difference(c, oily.at(x, y)) > 8;
      }
    }
  EXPECT_GT(funnel, 20);
  EXPECT_GT(changed, kWidth * kHeight / 10);
}

TEST(SlickPlace, HoldsTheDiscsOnAGridOfTheWorld) {
  const std::vector<SlickDisc> discs{disc(-30.0, 4.0, 2.0F, 1e-3F), disc(25.0, -11.0, 3.0F, 1e-3F)};
  const Eigen::Vector3d origin(1234.5, -77.7, 0.0);
  const SlickPlace place = place_of({discs, origin}, 512);
  const double texel = place.length / 512;
  for (int axis = 0; axis < 2; ++axis) {
    const double texels = place.corner[axis] / texel;
    EXPECT_NEAR(texels, std::round(texels), 1e-6);
  }
  EXPECT_LT(place.corner.x(), origin.x() - 30.0 - 2.0);
  EXPECT_LT(place.corner.y(), origin.y() - 11.0 - 3.0);
  EXPECT_GT(place.corner.x() + place.length, origin.x() + 25.0 + 3.0);
  EXPECT_GT(place.corner.y() + place.length, origin.y() + 4.0 + 2.0);
  EXPECT_LT(texel, 0.2 * 2.0 / kDiscPerSize) << "too coarse for the bell of the smaller disc";
  EXPECT_TRUE(place.centre.isApprox(origin.head<2>() + Eigen::Vector2d(-2.5, -3.5), 1e-9));  // equal masses

  std::vector<SlickDisc> drifted = discs;
  for (SlickDisc& d : drifted) d.x += 0.01F;
  EXPECT_EQ(place_of({drifted, origin}, 512).length, place.length);
}

TEST(SlickPlace, IsNowhereWithoutDiscs) { EXPECT_EQ(place_of({}, 512).length, 0.0); }

TEST(SlickPlace, BoundsWhatThereIsToDraw) {
  const std::vector<SlickDisc> huge(100'000, disc(0.0, 0.0, 1e5F, 1e-3F));
  const SlickPlace place = place_of({huge, kMiddle}, 512);
  const double side = 512.0 * 2.0 * 1e5 / place.length;  // of a disc's square without its fringe, pixels
  EXPECT_LT(side * side * 1e5, 16e6);
  const std::vector<SlickDisc> usual(4000, disc(0.0, 0.0, 2.0F, 1e-3F));
  EXPECT_LT(place_of({usual, kMiddle}, 512).length / 512, 0.2 * 2.0 / kDiscPerSize);
}

TEST(SlickPlace, TakesExtremeDiscs) {
  for (const float radius : {1e-30F, 1e5F})
    for (const float mass : {0.0F, 1e12F}) {
      SlickDisc extreme = disc(1e6, -1e6, radius, 0.0F);
      extreme.mass = mass;
      const SlickPlace place = place_of({std::span(&extreme, 1), kMiddle}, 512);
      EXPECT_TRUE(place.corner.allFinite() && place.centre.allFinite());
      EXPECT_GT(place.length, 0.0);
      EXPECT_TRUE(std::isfinite(1.0F / static_cast<float>(place.length)));
    }
}

}  // namespace
}  // namespace pelagos
