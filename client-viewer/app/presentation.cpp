#include "app/presentation.hpp"

#include <algorithm>
#include <cstdio>

#include "renderer/loose_water.hpp"

namespace pelagos {
namespace {

constexpr int kMostTaken = 32;  // frames in one update
constexpr std::int64_t kTellNs = 1'000'000'000;
constexpr std::chrono::milliseconds kSurfaceWait{1000};

bool has_all_surfaces(const SceneInfo& scene) {
  return std::all_of(scene.bodies.begin(), scene.bodies.end(),
                     [](const BodyInfo& body) { return body.surface || parse_wire_name(body.mesh_file).primitive; });
}

}  // namespace

std::int64_t system_time_ns() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

Presentation::Presentation(FrameSource& source, Channel channel, const RenderSettings& settings,
                           std::filesystem::path mesh_folder, double delay)
    : source_(source),
      channel_(std::move(channel)),
      settings_(settings),
      delay_ns_(static_cast<std::int64_t>(1e9 * delay)),
      loader_(std::move(mesh_folder)),
      renderer_(std::make_unique<Renderer>(settings)),
      frames_([this](std::unique_ptr<OceanFrame> frame) { source_.recycle(std::move(frame)); }) {}

void Presentation::take_scene() {
  const std::uint64_t revision = source_.scene_revision();
  if (revision == scene_revision_) return;
  const std::optional<SceneInfo> scene = source_.scene_info();
  if (!scene) return;
  scene_ = *scene;
  if (scene_revision_ == 0 || meshes_wanted_) scene_came_ = std::chrono::steady_clock::now();
  scene_revision_ = revision;
  meshes_wanted_ = false;
  renderer_->set_scene(scene_);
}

void Presentation::take_meshes() {
  // The bodies' surfaces come one by one, mostly before the scene; old servers send none.
  const bool waited = std::chrono::steady_clock::now() - scene_came_ > kSurfaceWait;
  if (scene_revision_ != 0 && !meshes_wanted_ && (waited || has_all_surfaces(scene_))) {
    loader_.want(scene_.bodies);
    meshes_wanted_ = true;
  }
  for (const std::string& note : loader_.take_notes()) std::fprintf(stderr, "pelagos-viewer: %s\n", note.c_str());
  const std::uint64_t revision = loader_.revision();
  if (revision == mesh_revision_) return;
  mesh_revision_ = revision;
  renderer_->set_meshes(loader_.meshes());
}

void Presentation::update() {
  take_scene();
  take_meshes();
  for (int i = 0; i < kMostTaken; ++i) {
    std::unique_ptr<OceanFrame> frame = source_.take_next();
    if (!frame) return;
    frames_.add(std::move(frame));
    drawn_.before = drawn_.after = drawn_.nearer = nullptr;
  }
}

void Presentation::find_loose(const OceanFrame& frame) {
  fresh_ = pictures_ == 0 || frame.frame != drawn_frame_ || frame.source != drawn_source_;
  drawn_frame_ = frame.frame;
  drawn_source_ = frame.source;
  if (fresh_ || loose_.size() != frame.particles.size())
    loose_ = find_loose_water(frame.particles, scene_.particle_spacing > 0.0 ? scene_.particle_spacing : 1.0);
}

Camera Presentation::camera_or_stand_in(std::span<const BodyState> bodies) {
  if (const auto camera = camera_for(channel_, bodies, settings_.width, settings_.height)) return *camera;
  if (!warned_about_mount_)
    std::fprintf(stderr, "pelagos-viewer: channel %s rides on body %u, which no frame holds; it waits at the origin\n",
                 channel_.name.c_str(), channel_.mount.body);
  warned_about_mount_ = true;
  BodyState stand_in;
  stand_in.body = channel_.mount.body;
  stand_in.position.z() = scene_.water_level;
  return camera_for(channel_, std::span(&stand_in, 1), settings_.width, settings_.height).value();
}

void Presentation::draw(std::int64_t shown_at_ns) {
  drawn_ = frames_.show(source_.due_at(shown_at_ns - delay_ns_));
  const OceanFrame& frame = *drawn_.nearer;
  find_loose(frame);
  const std::vector<BodyState> bodies = bodies_at(drawn_);
  SeaMoment moment;
  moment.time = drawn_.time;
  moment.ahead = drawn_.time - frame.simulation_time;
  moment.origin = frame.origin;
  moment.particles = frame.particles;
  moment.loose = loose_;
  moment.bodies = bodies;
  const std::shared_ptr<const OceanSlick> slick = source_.slick_at(drawn_.time);
  if (slick) moment.slick = {slick->discs, slick->origin};
  if (const std::optional<WindSettings> wind = source_.wind()) moment.wind = wind->velocity.head<2>();
  renderer_->draw(camera_or_stand_in(bodies), moment);
}

void Presentation::shown(std::int64_t shown_at_ns) {
  ++pictures_;
  if (drawn_.held) ++held_;
  const std::optional<DueInstant> due = source_.due_at(shown_at_ns - delay_ns_);
  if (!due) return;
  last_skew_ = drawn_.time - due->scheduled.time;
  skew_.add(shown_at_ns, last_skew_);
  if (shown_at_ns - told_ns_ < kTellNs) return;
  told_ns_ = shown_at_ns;
  ViewerStatus status;
  status.channel = channel_.name;
  status.pictures = pictures_;
  status.simulation_time = drawn_.time;
  status.delay = delay();
  status.skew_median = skew_.recent(0.5);
  status.skew_99 = skew_.recent(0.99);
  source_.tell(status);
}

void Presentation::resize(int width, int height) {
  if (width == settings_.width && height == settings_.height) return;
  settings_.width = width;
  settings_.height = height;
  auto renderer = std::make_unique<Renderer>(settings_);
  renderer->keep_foam_of(*renderer_);
  renderer_ = std::move(renderer);
  renderer_->set_scene(scene_);
  renderer_->set_meshes(loader_.meshes());
}

}  // namespace pelagos
