// The foam map in pictures.

#include <cmath>

#include "../support/places.hpp"
#include "graphics_fixture.hpp"
#include "source/frame_source.hpp"

namespace pelagos {
namespace {

constexpr int kWidth = 320, kHeight = 180;

/// A calm sea without a patch, and a ship that goes east at fourteen knots until `stops`.
class Voyage {
 public:
  explicit Voyage(Quality quality = Quality::kMedium) : renderer_({kWidth, kHeight, 32, quality, true}) {
    SceneInfo scene = synthetic_scene();
    scene.sea = WaveField({}, 0.0);
    set_scene(renderer_, scene, test::source_path("assets/meshes"));
    ship_.body = 1;
  }

  /// Looks from above at a place that is fixed in the world.
  [[nodiscard]] Picture draw(double time, double stops, const Eigen::Vector2d& over, double yaw_deg = 0.0) {
    ship_.velocity.x() = time < stops ? 7.2 : 0.0;
    ship_.position.x() = 7.2 * std::min(time, stops);
    Channel channel;
    channel.mount.eye = {over.y() - 40.0, -over.x(), 30.0};  // north, west, up
    channel.mount.heading_deg = 0.0;                         // to the north
    channel.yaw_deg = yaw_deg;
    channel.mount.tilt_deg = -36.0;
    channel.horizontal_fov_deg = 40.0;
    SeaMoment moment;
    moment.time = time;
    moment.bodies = std::span(&ship_, 1);
    renderer_.draw(camera_for(channel, {}, kWidth, kHeight).value(), moment);
    return renderer_.read_picture();
  }

 private:
  Renderer renderer_;
  BodyState ship_;
};

double mean_green(const Picture& picture) {
  double sum = 0.0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) sum += picture.at(x, y)[1];
  return sum / (picture.width * picture.height);
}

TEST_F(Graphics, AShipThatStopsKeepsHerWakeBehindHer) {
  const Eigen::Vector2d astern(7.2 * 20.0 - 18.0 - 30.0, 0.0);
  Voyage voyage;
  for (double time = 0.0; time < 30.0; time += 0.5) (void)voyage.draw(time, 20.0, astern);
  const double soon = mean_green(voyage.draw(30.0, 20.0, astern));
  Voyage resting;  // the same ship, never under way
  const double clear = mean_green(resting.draw(30.0, 0.0, astern));
  EXPECT_GT(soon, clear + 8.0);
  for (double time = 34.0; time < 400.0; time += 4.0) (void)voyage.draw(time, 20.0, astern);
  EXPECT_NEAR(mean_green(voyage.draw(400.0, 20.0, astern)), clear, 2.0) << "it has faded";
}

/// Two channels that turn about one eye show the same foam where they meet.
TEST_F(Graphics, FoamCrossesTheBorderOfTwoChannels) {
  const Eigen::Vector2d over(10.0, 0.0);  // at the end the stern is 15 m ahead of it
  Voyage left, right;
  for (double time = 0.0; time < 6.0; time += 0.1) (void)left.draw(time, 20.0, over, -20.0);
  for (double time = 0.0; time < 6.0; time += 0.27) (void)right.draw(time, 20.0, over, 20.0);
  const Picture a = left.draw(6.0, 20.0, over, -20.0), b = right.draw(6.0, 20.0, over, 20.0);
  const auto step = [&](const Picture& one, int x, const Picture& other, int to) {
    double sum = 0.0;
    for (int y = 0; y < kHeight; ++y) sum += std::abs(one.at(x, y)[1] - other.at(to, y)[1]);
    return sum / kHeight;
  };
  const double inside = 0.5 * (step(a, kWidth - 2, a, kWidth - 1) + step(b, 0, b, 1));
  EXPECT_LT(step(a, kWidth - 1, b, 0), 1.5 * inside + 0.5) << "neighbouring columns differ by " << inside;
}

}  // namespace
}  // namespace pelagos
