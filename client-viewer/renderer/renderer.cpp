#include "renderer/renderer.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "meshes/tank.hpp"
#include "renderer/bow_spray.hpp"
#include "renderer/composite.hpp"
#include "renderer/detail_textures.hpp"
#include "renderer/far_sea.hpp"
#include "renderer/fluid.hpp"
#include "renderer/foam_layer.hpp"
#include "renderer/gl_objects.hpp"
#include "renderer/glass.hpp"
#include "renderer/loose_water.hpp"
#include "renderer/mesh.hpp"
#include "renderer/moving_hulls.hpp"
#include "renderer/opaque.hpp"
#include "renderer/shadow.hpp"
#include "renderer/short_sea.hpp"
#include "renderer/short_waves.hpp"
#include "renderer/view_block.hpp"
#include "scales/scales.hpp"
#include "waves/patch_blend.hpp"
#include "waves/wave_field.hpp"

namespace pelagos {
namespace {

constexpr GLuint kSkyUnit = 5, kShadowUnit = 12, kFoamUnit = 13;  // of textures, in opaque.frag and water.frag
constexpr double kOpenWater = 40.0;                               // m: short waves of a narrower tank are smaller
constexpr double kFreeboard = 1.5;                                // m, of a tank's concrete walls
constexpr double kLeastSpeed = 0.5;                               // m/s: slower hulls have no wake
constexpr float kSprayThreshold = 0.5F;
constexpr float kLooseSpray = 0.75F;  // strength of the spray of clumps, whose particles have neighbours
// Pixels that the particles of a picture may cover, in pictures: a frame of huge ellipsoids must not take minutes. The
// eye in the middle of the water meets some hundred.
constexpr double kMostLayers = 4000.0;

Eigen::Vector4f vector4(double x, double y, double z, double w) { return Eigen::Vector4d(x, y, z, w).cast<float>(); }
Eigen::Vector4f vector4(const Eigen::Vector3d& v, double w) { return vector4(v.x(), v.y(), v.z(), w); }

/// Main direction of the waves (unit, x east, y north); the longest waves' energy decides.
Eigen::Vector2d main_direction(std::span<const MomentWave> waves) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const MomentWave& w : waves)
    sum += static_cast<double>(w.amplitude) * w.amplitude * Eigen::Vector2f(w.along_x, w.along_y).cast<double>();
  return sum.norm() > 1e-12 ? Eigen::Vector2d(sum.normalized()) : Eigen::Vector2d::UnitX();
}

/// Wind that would raise such a sea (fully developed, Hs = 0.21 U^2 / g; Pierson & Moskowitz 1964), m/s.
double wind_of_sea(std::span<const MomentWave> waves) {
  double variance = 0.0;
  for (const MomentWave& w : waves) variance += 0.5 * static_cast<double>(w.amplitude) * w.amplitude;
  return std::sqrt(4.0 * std::sqrt(variance) * kStandardGravity / 0.21);
}

/// Standard deviation of how much the crests fold the surface.
double folding_of(const WaveMoment& waves) {
  double variance = 0.0;
  for (const MomentWave& w : waves.waves)
    variance += 0.5 * std::pow(static_cast<double>(w.amplitude) * w.wavenumber * (1.0 + w.echo) * w.bed, 2);
  return std::sqrt(variance);
}

/// m/s, towards: the wind, where it is known; else one that would raise such waves.
Eigen::Vector2d wind_over(const SeaMoment& moment, std::span<const MomentWave> waves) {
  return moment.wind.value_or(Eigen::Vector2d(wind_of_sea(waves) * main_direction(waves)));
}

/// Foam streaks along the wind, in steps: the pattern would swim far from the origin if its axes turned smoothly.
Eigen::Vector2d streak_axis(const Eigen::Vector2d& wind) {
  if (wind.norm() < 0.5) return Eigen::Vector2d::UnitX();
  const double step = std::numbers::pi / 16.0;
  const double angle = step * std::round(std::atan2(wind.y(), wind.x()) / step);
  return {std::cos(angle), std::sin(angle)};
}

/// Of a SurfaceParticle.
constexpr std::uint8_t kOilPhase = 1;

/// A drop as spray.vert reads it: the velocity stands in the place of the orientation, which drops do not have.
/// The first axis is its size, the second tells whether it is also drawn outside of the patch.
DrawnParticle as_drop(DrawnParticle drop, const Eigen::Vector3f& velocity, float size, float strength) {
  for (int axis = 0; axis < 3; ++axis) drop.orientation[axis] = velocity[axis];
  drop.semi_axes[0] = size;
  drop.semi_axes[1] = 0.0F;
  drop.spray = strength;
  return drop;
}

DrawnParticle as_drop(const SprayCluster& cluster, const Eigen::Vector3d& eye) {
  const Eigen::Vector3f at = (cluster.place - eye).cast<float>();
  DrawnParticle drop = as_drop({{at.x(), at.y(), at.z()}, 0, {}, {}, 0}, cluster.velocity.cast<float>(),
                               static_cast<float>(cluster.size), static_cast<float>(cluster.strength));
  drop.semi_axes[1] = 1.0F;
  return drop;
}

DrawnParticle drawn(const SurfaceParticle& particle, const Eigen::Vector3f& offset, float ahead) {
  const Eigen::Vector3f centre = particle.position + ahead * particle.velocity + offset;
  const Eigen::Quaternionf& q = particle.orientation;
  return {{centre.x(), centre.y(), centre.z()},
          particle.phase == kOilPhase ? -1.0F : static_cast<float>(particle.foam) / 255.0F,
          {q.x(), q.y(), q.z(), q.w()},
          {particle.semi_axes.x(), particle.semi_axes.y(), particle.semi_axes.z()},
          static_cast<float>(particle.spray) / 255.0F};
}

/// Whether a sphere may touch the guarded picture.
class Frustum {
 public:
  Frustum(const Camera& camera, const FluidSize& size)
      : axes_(camera.view_from_world.cast<float>()),
        tan_x_(static_cast<float>(size.tan_half_x)),
        tan_y_(static_cast<float>(size.tan_half_y)),
        slack_x_(std::sqrt(1.0F + tan_x_ * tan_x_)),
        slack_y_(std::sqrt(1.0F + tan_y_ * tan_y_)),
        focal_(static_cast<float>(size.focal_pixels)) {}
  [[nodiscard]] bool may_see(const float* centre, float radius) const {
    const Eigen::Vector3f c = axes_ * Eigen::Vector3f(centre[0], centre[1], centre[2]);
    return c.z() > -radius && std::abs(c.x()) < tan_x_ * c.z() + radius * slack_x_ &&
           std::abs(c.y()) < tan_y_ * c.z() + radius * slack_y_;
  }
  /// Pixels that a sphere covers at most, up to `all`.
  [[nodiscard]] double covered(const float* centre, float radius, double all) const {
    const float depth = axes_.row(2).dot(Eigen::Vector3f(centre[0], centre[1], centre[2])) - radius;
    if (depth <= 0.0F) return all;
    const double on_screen = static_cast<double>(focal_ * radius / depth);
    return std::min(all, std::numbers::pi * on_screen * on_screen);
  }

 private:
  Eigen::Matrix3f axes_;
  float tan_x_, tan_y_, slack_x_, slack_y_, focal_;
};

}  // namespace

double fluid_scale(Quality quality) {
  switch (quality) {
    case Quality::kLow:
      return 1.0 / 3.0;
    case Quality::kMedium:
      return 0.5;
    case Quality::kHigh:
      return 1.0;
  }
  return 0.5;
}

int shadow_texels(Quality quality) { return quality == Quality::kLow ? 256 : 1024; }

/// What several parts of a frame need, found once.
struct FrameMoment {
  WaveMoment waves;
  Eigen::Vector2d wind = Eigen::Vector2d::Zero();  ///< m/s
  SkyMoment light;
  std::vector<PlacedMesh> bodies;
  Eigen::Vector2d flow = Eigen::Vector2d::Zero();  ///< m/s, of the water as a whole
  std::vector<MovingHull> hulls;
};

struct Renderer::State {
  explicit State(const RenderSettings& s)
      : settings(s),
        size(size_for(s)),
        opaque(s.width, s.height, s.quality == Quality::kLow ? 4 : 2, s.quality == Quality::kLow ? 1 : 4),
        shadow(shadow_texels(s.quality)),
        far_sea(s.width, s.height,
                s.quality == Quality::kLow    ? 2.0
                : s.quality == Quality::kHigh ? 0.7
                                              : 1.0),
        fluid(size.width, size.height),
        composite(s.width, s.height, s.quality != Quality::kLow) {}

  static FluidSize size_for(const RenderSettings& s) {
    Camera camera;
    camera.width = s.width;
    camera.height = s.height;
    camera.guard = s.guard;
    return fluid_size_of(camera, fluid_scale(s.quality));
  }

  void gather(const Camera& camera, const SeaMoment& moment, const FrameMoment& frame);
  [[nodiscard]] std::vector<PlacedMesh> place_bodies(const Camera& camera, const SeaMoment& moment) const;
  void draw_slick(const Slick& slick);
  [[nodiscard]] FrameMoment frame_at(const Camera& camera, const SeaMoment& moment) const;
  [[nodiscard]] ViewBlock view_block(const Camera& camera, const SeaMoment& moment, const FrameMoment& frame) const;
  void lay_foam(const Camera& camera, const SeaMoment& moment, const FrameMoment& frame);
  void upload_view(const ViewBlock& block) {
    view.upload(&block, sizeof block);
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, view.id());
  }

  RenderSettings settings;
  FluidSize size;
  Buffer view;
  OpaquePass opaque;
  ShadowPass shadow;
  FarSeaPass far_sea;
  FluidPass fluid;
  CompositePass composite;
  void renew_sky(const SkyMoment& light);
  DetailTextures detail;
  std::optional<SkyMoment> sky_shown;
  ShortWaves short_waves{0};
  ShortSea short_sea;
  FoamMap foam;
  FoamLayer foam_layer;
  BowSpray bow_spray;
  std::unique_ptr<Mesh> tank;  ///< null: its walls are not visible
  std::unique_ptr<GlassPass> glass;
  std::unique_ptr<SlickMap> slick_map;  ///< from the first slick on
  SlickPlace slick_place;               ///< of the map as drawn
  SceneInfo scene;
  WaveField sea;
  std::map<std::shared_ptr<const MeshData>, std::unique_ptr<Mesh>> uploaded;
  std::map<std::uint32_t, const Mesh*> meshes;  ///< by body, of `uploaded`
  std::map<std::uint32_t, HullBox> boxes;       ///< of these meshes
  std::vector<DrawnParticle> water, drops;
  PassTimes times = {};
};

void Renderer::State::gather(const Camera& camera, const SeaMoment& moment, const FrameMoment& frame) {
  water.clear();
  drops.clear();
  const FluidSize guarded = fluid_size_of(camera, fluid_scale(settings.quality));
  const Frustum frustum(camera, guarded);
  const double all = static_cast<double>(guarded.width) * guarded.height;
  double to_cover = kMostLayers * all;
  const Eigen::Vector3f offset = (moment.origin - camera.eye).cast<float>();
  const auto ahead = static_cast<float>(moment.ahead);
  const auto spacing = static_cast<float>(scene.particle_spacing > 0.0 ? scene.particle_spacing : 1.0);
  std::vector<std::uint8_t> found;
  std::span<const std::uint8_t> loose = moment.loose;
  if (loose.size() != moment.particles.size()) {
    found = find_loose_water(moment.particles, scene.particle_spacing > 0.0 ? scene.particle_spacing : 1.0);
    loose = found;
  }
  for (const SprayCluster& cluster : bow_spray.clusters(moment.time, scene.water_level, frame.wind)) {
    const DrawnParticle drop = as_drop(cluster, camera.eye);
    if (frustum.may_see(drop.centre, 2.0F * drop.semi_axes[0])) drops.push_back(drop);
  }
  for (std::size_t i = 0; i < moment.particles.size(); ++i) {
    const SurfaceParticle& particle = moment.particles[i];
    const DrawnParticle one = drawn(particle, offset, ahead);
    const float reach = 1.5F * std::max({one.semi_axes[0], one.semi_axes[1], one.semi_axes[2]});
    if (!frustum.may_see(one.centre, reach)) continue;
    to_cover -= frustum.covered(one.centre, reach, all);
    if (to_cover < 0.0) break;
    if (loose[i] != 0 || one.spray > kSprayThreshold)
      drops.push_back(as_drop(one, particle.velocity, spacing, std::max(one.spray, kLooseSpray)));
    else
      water.push_back(one);
  }
}

/// The view block must be bound.
void Renderer::State::renew_sky(const SkyMoment& light) {
  if (sky_shown && light.looks_like(*sky_shown)) return;
  detail.draw_sky();
  sky_shown = light;
}

void Renderer::State::draw_slick(const Slick& slick) {
  const int texels = settings.quality == Quality::kHigh ? 1024 : 512;
  slick_place = place_of(slick, texels);
  if (slick_place.length <= 0.0) return;
  if (!slick_map) slick_map = std::make_unique<SlickMap>(texels);
  slick_map->draw(slick, slick_place);
}

std::vector<PlacedMesh> Renderer::State::place_bodies(const Camera& camera, const SeaMoment& moment) const {
  std::vector<PlacedMesh> placed;
  for (const BodyState& body : moment.bodies) {
    const auto mesh = meshes.find(body.body);
    if (mesh == meshes.end()) continue;
    placed.push_back(
        {mesh->second, (body.position - camera.eye).cast<float>(), body.orientation.toRotationMatrix().cast<float>()});
  }
  if (tank) placed.push_back({tank.get(), (scene.patch.min - camera.eye).cast<float>(), Eigen::Matrix3f::Identity()});
  return placed;
}

/// The nearest hulls that move leave the foam and the waves of wake.glsl.
void fill_hulls(ViewBlock& block, const Eigen::Vector2d& eye, std::span<const MovingHull> hulls) {
  std::vector<MovingHull> moving;
  for (const MovingHull& hull : hulls)
    if (hull.speed >= kLeastSpeed) moving.push_back(hull);
  const std::size_t count = std::min(moving.size(), block.hull.size());
  std::partial_sort(moving.begin(), moving.begin() + static_cast<std::ptrdiff_t>(count), moving.end(),
                    [&](const MovingHull& a, const MovingHull& b) {
                      return (a.place - eye).squaredNorm() < (b.place - eye).squaredNorm();
                    });
  for (std::size_t i = 0; i < count; ++i) {
    const MovingHull& hull = moving[i];
    const Eigen::Vector2d offset = hull.place - eye;
    block.hull[i] = vector4(offset.x(), offset.y(), hull.way.x(), hull.way.y());
    block.hull_size[i] = vector4(hull.half_length, hull.half_beam, hull.speed, hull.curvature);
  }
  block.fluid.z() = static_cast<float>(count);
}

/// Where the foam map's levels lie about the eye.
void fill_foam(ViewBlock& block, const Eigen::Vector2d& eye, double time, const FoamMap& foam) {
  const Eigen::Vector2d left = foam.faded(time);
  block.foam_left = vector4(left.x(), left.y(), foam.present() ? 1.0 : 0.0, 0.0);
  for (std::size_t i = 0; i < kFoamLevels; ++i) {
    const FoamLevel& level = foam.levels()[i];
    const double side = FoamLevel::kSide * level.texel;
    const Eigen::Vector2d turns = (eye - foam.drift()) / side;
    const Eigen::Vector2d middle =
        level.texel *
            (Eigen::Vector2d(static_cast<double>(level.first[0]), static_cast<double>(level.first[1])).array() +
             0.5 * FoamLevel::kSide)
                .matrix() +
        foam.drift() - eye;
    block.foam_map[i] = vector4(turns.x() - std::floor(turns.x()), turns.y() - std::floor(turns.y()), 1.0 / side, 0.0);
    block.foam_window[i] = vector4(middle.x(), middle.y(), 0.5 * side - 4.0 * level.texel, level.texel);
  }
}

FrameMoment Renderer::State::frame_at(const Camera& camera, const SeaMoment& moment) const {
  FrameMoment frame;
  frame.waves = sea.at(moment.time, camera.eye.head<2>());
  frame.wind = wind_over(moment, frame.waves.waves);
  frame.light = sky_at(settings.weather, scene.origin, moment.time);
  frame.bodies = place_bodies(camera, moment);
  frame.flow = flow_of(moment.particles, frame.waves.waves);
  frame.hulls = moving_hulls(moment.bodies, boxes, frame.waves, camera.eye.head<2>(), scene.water_level, frame.flow);
  return frame;
}

void Renderer::State::lay_foam(const Camera& camera, const SeaMoment& moment, const FrameMoment& frame) {
  const double spacing = scene.particle_spacing > 0.0 ? scene.particle_spacing : 1.0;
  const Eigen::Vector2d half = 0.5 * scene.patch.size().head<2>();
  foam.advance(
      moment.time, camera.eye.head<2>(), frame.flow, frame.hulls,
      {moment.particles, moment.loose, moment.origin, spacing, half, rim_blend(spacing, 2.0 * half.minCoeff())});
  foam_layer.upload(foam);
  foam_layer.bind(kFoamUnit);
}

ViewBlock Renderer::State::view_block(const Camera& camera, const SeaMoment& moment, const FrameMoment& frame) const {
  const WaveMoment& waves = frame.waves;
  const Eigen::Vector2d& wind = frame.wind;
  const SkyMoment& light = frame.light;
  const FluidSize guarded = fluid_size_of(camera, fluid_scale(settings.quality));
  ViewBlock block = {};
  block.right = vector4(camera.view_from_world.row(0), camera.tan_half_x);
  block.up = vector4(camera.view_from_world.row(1), camera.tan_half_y);
  block.forward = vector4(camera.view_from_world.row(2), camera.focal_pixels());
  block.size = vector4(camera.width, camera.height, 1.0 / camera.width, 1.0 / camera.height);
  block.fluid_size = vector4(guarded.width, guarded.height, guarded.tan_half_x, guarded.tan_half_y);
  const double spacing = scene.particle_spacing > 0.0 ? scene.particle_spacing : 1.0;
  block.fluid = vector4(guarded.focal_pixels, spacing, 0, 0);
  block.level = vector4(scene.water_level - camera.eye.z(), std::fmod(moment.time, 3600.0), light.visibility / 3.0,
                        breaking_envelope(wind.norm()));
  // The origin of the particles is the middle of the patch, also where the patch follows a ship.
  const Eigen::Vector2d middle_of_patch = (moment.origin - camera.eye).head<2>();
  const Eigen::Vector2d half = 0.5 * scene.patch.size().head<2>(), low = middle_of_patch - half,
                        high = middle_of_patch + half;
  block.patch_box = vector4(low.x(), low.y(), high.x(), high.y());
  const double narrow = scene.patch.size().head<2>().minCoeff();
  const bool present = !moment.particles.empty() && narrow > 0.0;
  const PatchBlend blend = rim_blend(spacing, narrow);
  // Up to walls that are visible the water is all the particles'.
  const double start = tank ? -2e4 : blend.start, full = tank ? -1e4 : blend.full;
  block.patch_blend = vector4(present ? 1 : 0, start, full, std::max(folding_of(waves), 1e-6));
  block.sun = vector4(light.sun, light.sun_strength);
  block.sunlight = vector4(light.sun_colour, light.daylight);
  const ShadowPlace shade = shadow_place(frame.bodies, light.sun, shadow_texels(settings.quality));
  block.shadow = {shade.u.cast<float>(), shade.v.cast<float>(), vector4(shade.bias, shade.middle, shade.scale, 0)};
  const double ripples = tank ? std::clamp(narrow / kOpenWater, 0.05, 1.0) : 1.0;
  block.weather = vector4(light.clouds, light.visibility, ripples, 0);
  const Eigen::Vector2d axis = main_direction(waves.waves);
  block.wave_axis = vector4(axis.x(), axis.y(), mean_square_slope(wind.norm()), wind.norm());
  const Eigen::Vector2d streaks = streak_axis(wind), across(-streaks.y(), streaks.x()), eye = camera.eye.head<2>();
  block.pattern = vector4(streaks.x(), streaks.y(), std::fmod(streaks.dot(eye), kDetailPeriod),
                          std::fmod(across.dot(eye), kDetailPeriod));
  const Eigen::Vector3d grid = far_sea.grid_for(camera.eye.z() - scene.water_level);
  block.sea_grid = vector4(grid, short_waves.variance_below());
  const double longest_own = std::min(short_waves.shortest_component(), 1e6);
  for (std::size_t t = 0; t < kShortWaveTiles; ++t) {
    const ShortWaveTile& tile = short_waves.tiles()[t];
    const Eigen::Vector2d turns = eye / tile.length;
    block.tile[t] =
        vector4(turns.x() - std::floor(turns.x()), turns.y() - std::floor(turns.y()), 1.0 / tile.length, longest_own);
  }
  const bool oily = slick_place.length > 0.0;
  const Eigen::Vector2d map = slick_place.corner - eye, middle = slick_place.centre - eye;
  block.slick_map = vector4(map.x(), map.y(), oily ? 1.0 / slick_place.length : 0.0, oily ? 1.0 : 0.0);
  block.slick_centre = vector4(middle.x(), middle.y(), slick_place.reach, 0);
  fill_hulls(block, eye, frame.hulls);
  fill_foam(block, eye, moment.time, foam);
  return block;
}

Renderer::Renderer(const RenderSettings& settings) {
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  state_ = std::make_unique<State>(settings);
  check_graphics("the start of the renderer");
}

Renderer::~Renderer() = default;

void Renderer::set_scene(const SceneInfo& scene) {
  if (scene.seed != state_->scene.seed) state_->short_waves = ShortWaves(scene.seed);
  state_->scene = scene;
  state_->sea = scene.sea;
  const Eigen::Vector3d size = scene.patch.size();
  const bool walls = scene.tank_walls_visible && (size.array() > 0.0).all();
  const double wall = std::min(size.z(), scene.water_level - scene.patch.min.z() + kFreeboard);
  state_->tank = walls ? std::make_unique<Mesh>(draw_tank(size, wall)) : nullptr;
  state_->glass = walls && has_glass_walls(size) ? std::make_unique<GlassPass>() : nullptr;
}

void Renderer::set_meshes(const BodyMeshes& meshes) {
  std::map<std::shared_ptr<const MeshData>, std::unique_ptr<Mesh>> uploaded;
  state_->meshes.clear();
  state_->boxes.clear();
  for (const auto& [body, data] : meshes) {
    std::unique_ptr<Mesh>& mesh = uploaded[data];
    if (!mesh) {
      const auto known = state_->uploaded.find(data);
      mesh = known != state_->uploaded.end() ? std::move(known->second) : std::make_unique<Mesh>(*data);
    }
    state_->meshes[body] = mesh.get();
    state_->boxes[body] = {mesh->low().cast<double>(), mesh->high().cast<double>()};
  }
  state_->uploaded = std::move(uploaded);
}

void Renderer::keep_foam_of(Renderer& other) { state_->foam = std::move(other.state_->foam); }

void Renderer::draw(const Camera& camera, const SeaMoment& moment) {
  State& s = *state_;
  const auto now = [] { return std::chrono::steady_clock::now(); };
  auto last = now();
  std::size_t pass = 0;
  const auto pass_done = [&] {
    if (s.settings.measure_passes) glFinish();
    const auto time = now();
    s.times[pass++] = std::chrono::duration<double, std::milli>(time - last).count();
    last = time;
  };
  s.draw_slick(moment.slick);
  pass_done();
  const FrameMoment frame = s.frame_at(camera, moment);
  s.short_waves.set_sea(frame.waves.waves, frame.wind);
  s.lay_foam(camera, moment, frame);
  const ViewBlock block = s.view_block(camera, moment, frame);
  s.upload_view(block);
  s.renew_sky(frame.light);
  s.shadow.draw(frame.bodies);
  s.shadow.map().bind(kShadowUnit);
  s.detail.sky().bind(kSkyUnit);
  s.opaque.draw(frame.bodies);
  pass_done();
  s.short_waves.evaluate(moment.time);
  s.short_sea.upload(s.short_waves);
  const double height = camera.eye.z() - s.scene.water_level;
  if (s.tank)
    s.far_sea.leave_out();
  else
    s.far_sea.draw(camera, height, frame.waves, kShortestParticleWave * s.scene.particle_spacing);
  pass_done();
  s.bow_spray.advance(moment.time, frame.hulls);
  s.gather(camera, moment, frame);
  s.fluid.draw_particles(s.water);
  pass_done();
  s.fluid.smooth();
  pass_done();
  s.composite.compose(s.opaque, s.far_sea, s.short_sea, s.fluid, s.detail, s.slick_map.get(),
                      s.foam.present() || block.fluid.z() > 0.0F);
  pass_done();
  s.composite.draw_spray(s.drops, s.detail);
  if (s.glass) {
    const Eigen::Vector3f low = (s.scene.patch.min - camera.eye).cast<float>(),
                          high = (s.scene.patch.max - camera.eye).cast<float>();
    s.glass->draw(low, high, s.composite.unfinished(), s.composite.inverse_depth());
  }
  s.composite.finish();
  pass_done();
  check_graphics("a frame");
}

std::vector<float> Renderer::draw_particle_depth(const Camera& camera, const SeaMoment& moment) {
  State& s = *state_;
  const FrameMoment frame = s.frame_at(camera, moment);
  s.upload_view(s.view_block(camera, moment, frame));
  s.gather(camera, moment, frame);
  s.fluid.draw_particles(s.water);
  std::vector<float> depth = read_texture(s.fluid.inverse_depth(), 1);
  for (float& value : depth) value = value > 0.0F ? 1.0F / value : 0.0F;
  return depth;
}

const PassTimes& Renderer::pass_times() const { return state_->times; }

Picture Renderer::read_picture() const {
  const Texture& texture = state_->composite.picture();
  Picture picture(texture.width(), texture.height());
  std::vector<std::uint8_t> rgba(static_cast<std::size_t>(texture.width() * texture.height()) * 4);
  glGetTextureImage(texture.id(), 0, GL_RGBA, GL_UNSIGNED_BYTE, static_cast<GLsizei>(rgba.size()), rgba.data());
  for (int y = 0; y < picture.height; ++y)  // OpenGL's first row is the lowest
    for (int x = 0; x < picture.width; ++x)
      for (int k = 0; k < 3; ++k)
        picture.at(x, picture.height - 1 - y)[k] = rgba[static_cast<std::size_t>((y * picture.width + x) * 4 + k)];
  return picture;
}

std::vector<float> Renderer::read_depth() const {
  std::vector<float> depth = read_texture(state_->composite.inverse_depth(), 1);
  for (float& value : depth) value = value > 0.0F ? 1.0F / value : 0.0F;
  return depth;
}

unsigned Renderer::picture_framebuffer() const { return state_->composite.picture_framebuffer(); }

}  // namespace pelagos
