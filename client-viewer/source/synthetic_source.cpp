#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "source/frame_source.hpp"
#include "waves/sea_state.hpp"
#include "waves/splitmix.hpp"

namespace pelagos {
namespace {

constexpr double kSpacing = 1.0;               // m
constexpr double kShipSpeed = 4.0;             // m/s
constexpr double kHeading = 0.45;              // rad, anticlockwise from east
constexpr double kFrameInterval = 1.0 / 30.0;  // s

/// The ship goes to and fro by a few metres only, so that it stays in the patch; its velocity says what a voyage would.
BodyState synthetic_ship(double time) {
  BodyState ship;
  ship.body = 1;
  const Eigen::Vector3d forward(std::cos(kHeading), std::sin(kHeading), 0.0);
  ship.position = 3.0 * std::sin(0.3 * time) * forward + Eigen::Vector3d(0.0, 0.0, 0.12 * std::sin(0.9 * time));
  ship.orientation = Eigen::AngleAxisd(kHeading, Eigen::Vector3d::UnitZ()) *
                     Eigen::AngleAxisd(0.02 * std::sin(0.8 * time), Eigen::Vector3d::UnitY()) *
                     Eigen::AngleAxisd(0.035 * std::sin(0.6 * time), Eigen::Vector3d::UnitX());
  ship.velocity = kShipSpeed * forward;
  ship.health = PoseHealth::kFresh;
  return ship;
}

/// What the hull does to the water at a place.
struct HullInfluence {
  bool inside = false;
  double raise = 0.0;  // m
  double foam = 0.0;   // 0..1
};

HullInfluence hull_influence(const BodyState& ship, double x, double y) {
  const double c = std::cos(kHeading), s = std::sin(kHeading);
  const double dx = x - ship.position.x(), dy = y - ship.position.y();
  const double along = c * dx + s * dy, across = std::abs(-s * dx + c * dy);
  HullInfluence hull;
  const double entry = along > 3.0 ? 1.0 - std::pow(std::clamp((along - 3.0) / 14.2, 0.0, 1.0), 1.9) : 1.0;
  hull.inside = std::abs(along) < 18.0 && across < 4.5 * entry + 0.3;
  const double aft_of_bow = 17.0 - along;
  if (aft_of_bow > -2.0) {
    const double arm = across - 0.34 * std::max(aft_of_bow, 0.0);
    hull.raise += 0.8 * std::exp(-arm * arm / 4.0) * std::exp(-std::max(aft_of_bow, 0.0) / 14.0);
    hull.foam += 0.8 * std::exp(-arm * arm / 2.0) * std::exp(-std::max(aft_of_bow, 0.0) / 9.0);
  }
  const double astern = -along - 17.0;
  if (astern > 0.0) {
    hull.raise += 0.25 * std::cos(0.6 * astern) * std::exp(-across * across / 16.0) * std::exp(-astern / 20.0);
    hull.foam += 0.6 * std::exp(-across * across / 9.0) * std::exp(-astern / 15.0);
  }
  return hull;
}

/// Surface of the patch: the longer waves of the far sea, a little lower, as a patch would damp them.
double patch_elevation(const std::vector<WaveComponent>& waves, double x, double y, double time) {
  return 0.8 * wave_elevation(waves, x, y, time);
}

class SyntheticSource final : public FrameSource {
 public:
  /// One in each round, however long it takes to make it.
  std::unique_ptr<OceanFrame> take_next() override {
    const auto frame_number = static_cast<std::int64_t>(elapsed() / kFrameInterval);
    if (frame_number <= last_ || std::exchange(given_, !given_)) return nullptr;
    auto frame = spare_ ? std::move(spare_) : std::make_unique<OceanFrame>();
    fill_synthetic_frame(static_cast<double>(frame_number) * kFrameInterval, *frame);
    frame->frame = static_cast<std::uint64_t>(frame_number);
    frame->received = std::chrono::steady_clock::now();
    frame->received_ns = now_ns();
    frame->wall_time_ns =
        std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
            .count();
    last_ = frame_number;
    ++counters_.received;
    return frame;
  }
  void recycle(std::unique_ptr<OceanFrame> frame) override { spare_ = std::move(frame); }
  std::optional<SceneInfo> scene_info() override { return synthetic_scene(); }
  std::uint64_t scene_revision() override { return 1; }
  std::optional<ServerStatus> status() override { return std::nullopt; }
  std::optional<WindSettings> wind() override { return std::nullopt; }
  std::shared_ptr<const OceanSlick> slick_at(double) override { return nullptr; }
  std::int64_t now_ns() override { return LocalClocks{}.now().clock_ns; }
  std::optional<DueInstant> due_at(std::int64_t moment_ns) override {
    using Limits = std::numeric_limits<std::int64_t>;
    const double time =
        std::chrono::duration<double>(std::chrono::nanoseconds(moment_ns) - start_.time_since_epoch()).count();
    return DueInstant{{std::max(time, 0.0), 0, Limits::min(), Limits::max()}, ViewerClock::kHost};
  }
  ClockState clock_state() override { return {ViewerClock::kHost, 0, 0.0, std::nullopt, false}; }
  void tell(const ViewerStatus&) override {}
  bool server_alive() override { return true; }
  ReceiverCounters counters() override { return counters_; }

 private:
  [[nodiscard]] double elapsed() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::int64_t last_ = -1;
  bool given_ = false;
  std::unique_ptr<OceanFrame> spare_;
  ReceiverCounters counters_;
};

}  // namespace

SceneInfo synthetic_scene() {
  SceneInfo scene;
  scene.scene = "synthetic";
  scene.build = "none";
  scene.seed = 1;
  scene.frame_interval = kFrameInterval;
  scene.particle_spacing = kSpacing;
  scene.patch = {{-48.0, -36.0, -5.0}, {48.0, 36.0, 4.0}};
  scene.sea = WaveField(make_wave_components({.beaufort = 5, .wave_to_deg = 60.0, .components = 24, .seed = 3}), 0.0);
  scene.bodies.push_back({1, "coaster", "coaster_hull.obj", 1.0});
  return scene;
}

void fill_synthetic_frame(double time, OceanFrame& frame) {
  const SceneInfo scene = synthetic_scene();
  std::vector<WaveComponent> carried;
  for (const WaveComponent& w : scene.sea.components())
    if (2.0 * std::numbers::pi / w.wavenumber > 8.0 * kSpacing) carried.push_back(w);
  frame.source = 1;
  frame.simulation_time = time;
  frame.origin = Eigen::Vector3d::Zero();
  frame.particles.clear();
  frame.bodies = {synthetic_ship(time)};
  const BodyState& ship = frame.bodies.front();
  SplitMix64 random(11);
  const auto jitter = [&] { return static_cast<float>(random.next_unit() + random.next_unit() - 1.0); };
  for (double x = scene.patch.min.x() + 0.5; x < scene.patch.max.x(); x += kSpacing)
    for (double y = scene.patch.min.y() + 0.5; y < scene.patch.max.y(); y += kSpacing) {
      const HullInfluence hull = hull_influence(ship, x, y);
      const double level = patch_elevation(carried, x, y, time) + hull.raise;
      const double tilt_x = patch_elevation(carried, x + 1.0, y, time) + hull.raise - level;
      const double tilt_y = patch_elevation(carried, x, y + 1.0, time) + hull.raise - level;
      for (int layer = 0; layer < 2; ++layer) {
        const float jx = 0.3F * jitter(), jy = 0.3F * jitter(), jz = 0.14F * jitter(), jn = 0.12F * jitter();
        if (hull.inside) continue;
        SurfaceParticle particle;
        particle.position = Eigen::Vector3f(static_cast<float>(x) + jx, static_cast<float>(y) + jy,
                                            static_cast<float>(level - 0.62 - layer * kSpacing) + jz);
        const Eigen::Vector3f normal(static_cast<float>(-tilt_x) + jn, static_cast<float>(-tilt_y) - jn, 1.0F);
        particle.orientation = Eigen::Quaternionf::FromTwoVectors(Eigen::Vector3f::UnitZ(), normal.normalized());
        particle.semi_axes = Eigen::Vector3f(0.95F, 0.88F, 0.68F);
        particle.foam = static_cast<std::uint8_t>(255.0 * std::clamp(hull.foam, 0.0, 1.0));
        frame.particles.push_back(particle);
      }
      if (random.next_unit() < 0.35 && hull.foam > 0.6) {
        SurfaceParticle drop;
        drop.position =
            Eigen::Vector3f(static_cast<float>(x), static_cast<float>(y), static_cast<float>(level) + 0.8F * jitter());
        drop.semi_axes.setConstant(0.35F);
        drop.spray = 200;
        frame.particles.push_back(drop);
      }
    }
  frame.total_particles = static_cast<std::uint32_t>(frame.particles.size());
}

std::unique_ptr<FrameSource> make_synthetic_source() { return std::make_unique<SyntheticSource>(); }

}  // namespace pelagos
