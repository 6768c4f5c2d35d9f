#include "app/presentation.hpp"

#include <algorithm>
#include <cstdio>

#include "renderer/loose_water.hpp"

namespace pelagos {
namespace {

constexpr double kLongestExtrapolation = 0.2;  // s
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
                           std::filesystem::path mesh_folder)
    : source_(source),
      channel_(std::move(channel)),
      settings_(settings),
      loader_(std::move(mesh_folder)),
      renderer_(std::make_unique<Renderer>(settings)) {}

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

bool Presentation::update() {
  take_scene();
  take_meshes();
  std::unique_ptr<OceanFrame> newest = source_.take_newest();
  if (!newest) return false;
  source_.recycle(std::move(frame_));
  frame_ = std::move(newest);
  loose_ = find_loose_water(frame_->particles, scene_.particle_spacing > 0.0 ? scene_.particle_spacing : 1.0);
  return true;
}

double Presentation::time_since_frame() const {
  const std::optional<ServerStatus> status = source_.status();
  if (status && status->paused) return 0.0;
  const double since_received =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - frame_->received).count();
  const double since_made = 1e-9 * (static_cast<double>(system_time_ns()) - static_cast<double>(frame_->wall_time_ns));
  // Clocks of two machines may differ: then only the time since it came is known.
  const bool clocks_agree = since_made >= since_received && since_made < since_received + 1.0;
  const double rate = status ? std::clamp(status->real_time_factor, 0.0, 1.0) : 1.0;
  return rate * std::clamp(clocks_agree ? since_made : since_received, 0.0, kLongestExtrapolation);
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

void Presentation::draw() {
  const double ahead = time_since_frame();
  std::vector<BodyState> bodies;
  for (const BodyState& body : frame_->bodies) bodies.push_back(extrapolate(body, ahead));
  SeaMoment moment;
  moment.time = frame_->simulation_time + ahead;
  moment.ahead = ahead;
  moment.origin = frame_->origin;
  moment.particles = frame_->particles;
  moment.loose = loose_;
  moment.bodies = bodies;
  const std::shared_ptr<const OceanSlick> slick = source_.slick();
  if (slick) moment.slick = {slick->discs, slick->origin};
  if (const std::optional<WindSettings> wind = source_.wind()) moment.wind = wind->velocity.head<2>();
  renderer_->draw(camera_or_stand_in(bodies), moment);
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
