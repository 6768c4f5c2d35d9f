#include "simulation/bodies.hpp"

#include <algorithm>

#include "body_faults.hpp"
#include "physics/boundary.hpp"

namespace pelagos {

namespace {

Eigen::Vector3d to_body(const BodyState& state, const Eigen::Vector3d& world) {
  return state.orientation.conjugate() * (world - state.position);
}

Eigen::Vector3d to_world(const BodyState& state, const Eigen::Vector3d& body) {
  return state.orientation * body + state.position;
}

/// The body's shape from its file or primitive.
BodyShape shape_of(const BodySettings& settings, double spacing) {
  const MeshKind kind = settings.open ? MeshKind::kOpen : MeshKind::kClosed;
  if (settings.primitive) return make_body_shape(make_mesh(*settings.primitive), spacing, settings.sample_inset, kind);
  return load_body_shape(settings.mesh_file, {settings.mesh_scale, settings.mesh_axes, kind}, spacing,
                         settings.sample_inset);
}

/// A jump may land on water that stands where the body was before: mapped again, at most so many times.
constexpr int kRelocations = 8;

}  // namespace

Bodies::Bodies(TaskPool& pool, const Scene& scene, double support_radius, std::vector<std::string>& faults) {
  for (const BodySettings& settings : scene.bodies) {
    Body body;
    body.settings = settings;
    body.shape = shape_of(settings, scene.particle_spacing);
    body.state.body = settings.id;
    body.state.position = settings.position;
    body.state.orientation = settings.orientation;
    body.state.pose_age = -1.0;
    if (settings.drive == BodyDrive::kPose) body.driven.emplace(body.state, scene.particle_spacing, body.shape.reach);
    add_samples(pool, scene, support_radius, body);
    bodies_.push_back(std::move(body));
  }
  std::vector<PlacedShape> placed;
  for (const Body& body : bodies_) placed.push_back({&body.settings, &body.shape});
  faults = body_faults(scene, support_radius, placed);
}

void Bodies::add_samples(TaskPool& pool, const Scene& scene, double support_radius, Body& body) {
  body.first_sample = volumes_.size();
  std::vector<Float4> samples;
  for (const Eigen::Vector3f& sample : body.shape.samples) samples.push_back({sample.x(), sample.y(), sample.z(), 0});
  assign_boundary_volumes(pool, support_radius, samples);
  for (const Float4& sample : samples) {
    if (body.driven) {
      volumes_.push_back(sample.w);
      continue;
    }
    const Eigen::Vector3d x = to_world(body.state, {sample.x, sample.y, sample.z});
    if (is_within_reach(scene.tank, x, support_radius)) static_.push_back({x, sample.w});
  }
}

std::vector<Float4> Bodies::static_samples(const Eigen::Vector3d& origin) const {
  std::vector<Float4> samples;
  samples.reserve(static_.size());
  for (const StaticSample& sample : static_) {
    const Eigen::Vector3f local = (sample.position - origin).cast<float>();
    samples.push_back({local.x(), local.y(), local.z(), sample.volume});
  }
  return samples;
}

bool Bodies::covers(const Eigen::Vector3d& point, double clearance) const {
  return std::any_of(bodies_.begin(), bodies_.end(), [&](const Body& body) {
    return body.shape.signed_distance(to_body(body.state, point), 2.0 * clearance) < clearance;
  });
}

bool Bodies::accept(const BodyPose& pose, double now) {
  for (Body& body : bodies_)
    if (body.settings.id == pose.body && body.driven) return body.driven->accept(pose, now);
  return false;
}

void Bodies::advance(double now, double dt, const Eigen::Vector3d& origin, FluidState& fluid) {
  for (Body& body : bodies_) {
    if (!body.driven) continue;
    const BodyState before = body.state;
    const std::uint64_t jumps = body.driven->jumps();
    body.state = body.driven->advance(dt, now);
    if (body.driven->jumps() != jumps) relocate_water(body, before, origin, fluid);
  }
  place(origin, fluid);
}

void Bodies::place(const Eigen::Vector3d& origin, FluidState& fluid) const {
  fluid.moving_position.resize(volumes_.size());
  fluid.moving_velocity.resize(volumes_.size());
  for (const Body& body : bodies_) {
    if (!body.driven) continue;
    const std::size_t count = body.shape.samples.size();
    place_samples(body.shape, body.state, origin, std::span(fluid.moving_position).subspan(body.first_sample, count),
                  std::span(fluid.moving_velocity).subspan(body.first_sample, count));
  }
  for (std::size_t k = 0; k < volumes_.size(); ++k) fluid.moving_position[k].w = volumes_[k];
}

double Bodies::largest_speed() const {
  double largest = 0.0;
  for (const Body& body : bodies_)
    largest = std::max(largest, body.state.velocity.norm() + body.state.angular_velocity.norm() * body.shape.reach);
  return largest;
}

std::vector<BodyState> Bodies::states() const {
  std::vector<BodyState> states;
  for (const Body& body : bodies_) states.push_back(body.state);
  return states;
}

void Bodies::relocate_water(const Body& body, const BodyState& before, const Eigen::Vector3d& origin,
                            FluidState& fluid) const {
  FluidParticles& p = fluid.particles;
  for (std::size_t i = 0; i < p.count; ++i) {
    Eigen::Vector3d x = Eigen::Vector3d(p.position[i].x, p.position[i].y, p.position[i].z) + origin;
    bool moved = false;
    for (int k = 0; k < kRelocations && body.shape.inside(to_body(body.state, x)); ++k, moved = true)
      x = to_world(before, to_body(body.state, x));
    if (!moved) continue;
    const Eigen::Vector3f local = (x - origin).cast<float>();
    p.position[i] = {local.x(), local.y(), local.z(), 0.0F};
    p.velocity[i] = p.acceleration[i] = {};
    p.density_pressure[i] = p.divergence_pressure[i] = 0.0F;
  }
}

std::vector<Bodies::Motion> Bodies::motions() const {
  std::vector<Motion> motions;
  motions.reserve(bodies_.size());
  for (const Body& body : bodies_) motions.push_back({body.state, body.driven});
  return motions;
}

void Bodies::restore(const std::vector<Motion>& motions, const Eigen::Vector3d& origin, FluidState& fluid) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    bodies_[i].state = motions[i].state;
    bodies_[i].driven = motions[i].driven;
  }
  if (!bodies_.empty()) place(origin, fluid);
}

}  // namespace pelagos
