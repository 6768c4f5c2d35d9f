#include "solid_planes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "fluid_stages.hpp"

namespace pelagos {

namespace {

constexpr Float4 kNoPlane{0.0F, 0.0F, 0.0F, -SolidPlanes::kNone};
/// Particles whose box is held against those of the solids at once: a few rows of cells.
constexpr std::size_t kPlaneBlock = 256;
/// Support radii from a surface within which particles have its plane. No particle of the water stands nearer to it
/// than the rest of the support, so no image pair is lost.
constexpr float kReach = 0.9F;
constexpr Float4 kNoBlend{1.0F, 1.0F, 0.0F, 1.0F};
/// Normals of two surfaces: less parallel than this they are square to each other, more than the second value the
/// correction has ended.
constexpr float kSquare = 0.05F, kSkew = 0.2F;

Eigen::AlignedBox3f box_of(const Solid& solid) {
  Eigen::AlignedBox3f box;
  const SolidField& field = *solid.field;
  for (int corner = 0; corner < 8; ++corner) {
    Eigen::Vector3f at;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      at[axis] = (corner >> axis & 1) != 0 ? field.end(a) : field.origin[a];
    }
    box.extend(solid.turn * at + solid.place);
  }
  return box;
}

/// Where a floor may be in reach: everywhere below its highest node.
Eigen::AlignedBox3f box_of(const Floor& floor, float reach) {
  constexpr float kAnywhere = 1e9F;
  float top = -kAnywhere;
  for (const Float4& node : floor.nodes) top = std::max(top, node.x);
  // A plane may stand higher beside the nodes than on them, and reaches farther up where it is steep.
  const float above = 2.0F * reach + floor.cell;
  return {Eigen::Vector3f::Constant(-kAnywhere), Eigen::Vector3f(kAnywhere, kAnywhere, top + above)};
}

/// The solids of a step, the floor after them, with the boxes around their fields and a slot for each.
class SolidScene {
 public:
  SolidScene(const FluidState& state, float reach) : solids_(state.solids), floor_(state.floor), reach_(reach) {
    for (const Solid& solid : solids_) boxes_.push_back(box_of(solid));
    if (!floor_.empty()) boxes_.push_back(box_of(floor_, reach));
    for (std::size_t k = 0; k < boxes_.size(); ++k) slots_.push_back(free_slot(k));
  }

  /// Calls f(solid, slot) for the solids whose fields some place in the box may be in.
  template <class F>
  void for_each_near(const Eigen::AlignedBox3f& box, F&& f) const {
    for (std::size_t k = 0; k < boxes_.size(); ++k)
      if (boxes_[k].intersects(box)) f(k, slots_[k]);
  }

  /// Normal (local axes) and distance of a solid's surface, if it is in reach.
  [[nodiscard]] std::optional<Float4> surface(std::size_t k, const Eigen::Vector3f& x) const {
    if (!boxes_[k].contains(x)) return std::nullopt;
    if (k == solids_.size()) return floor_surface(x);
    return surface_at(solids_[k], x, reach_);
  }

 private:
  [[nodiscard]] std::optional<Float4> floor_surface(const Eigen::Vector3f& x) const {
    const Float4 surface = floor_plane(floor_, {x.x(), x.y(), x.z(), 0.0F}).surface;
    if (surface.w >= reach_) return std::nullopt;
    return surface;
  }

  /// The first slot that no solid before has which some pair of particles could have in reach as well; else the last.
  [[nodiscard]] std::size_t free_slot(std::size_t k) const {
    Eigen::AlignedBox3f around = boxes_[k];
    around.min().array() -= reach_, around.max().array() += reach_;
    std::array<bool, SolidPlanes::kSlots> used{};
    for (std::size_t before = 0; before < k; ++before)
      if (boxes_[before].intersects(around)) used[slots_[before]] = true;
    const auto slot = static_cast<std::size_t>(std::find(used.begin(), used.end(), false) - used.begin());
    return std::min(slot, SolidPlanes::kSlots - 1);
  }

  const std::vector<Solid>& solids_;
  const Floor& floor_;
  float reach_;
  std::vector<Eigen::AlignedBox3f> boxes_;
  std::vector<std::size_t> slots_;
};

Eigen::AlignedBox3f box_around(std::span<const Float4> positions) {
  Float4 low = positions[0], high = low;
  for (const Float4& p : positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z), 0.0F};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z), 0.0F};
  }
  return {vector_of(low), vector_of(high)};
}

void clear_planes(std::size_t begin, std::size_t end, SolidPlanes& planes) {
  const auto fill = [&](auto& values, const auto& value) {
    const auto from = values.begin();
    std::fill(from + static_cast<std::ptrdiff_t>(begin), from + static_cast<std::ptrdiff_t>(end), value);
  };
  for (std::size_t slot = 0; slot < SolidPlanes::kSlots; ++slot) {
    fill(planes.plane[slot], kNoPlane);
    fill(planes.solid[slot], -1);
  }
  fill(planes.blend, kNoBlend);
}

/// Forgets the planes of the last step: of the groups that had some, where the number of groups is the same.
void forget_planes(std::size_t count, SolidPlanes& planes) {
  const std::size_t padded = padded_count(count);
  if (planes.group.size() != padded / kLanes) {
    for (std::size_t slot = 0; slot < SolidPlanes::kSlots; ++slot) {
      planes.plane[slot].assign(padded, kNoPlane);
      planes.solid[slot].assign(padded, -1);
      planes.speed[slot].assign(padded, 0.0F);
    }
    planes.blend.assign(padded, kNoBlend);
  } else {
    for (std::size_t group = 0; group < planes.group.size(); ++group)
      if (planes.group[group] != 0) clear_planes(group * kLanes, (group + 1) * kLanes, planes);
  }
  planes.group.assign(padded / kLanes, 0);
}

void resize_planes(const FluidState& state, SolidPlanes& planes) {
  const std::size_t gathered = extended_count(state.particles.count, state.ghosts);
  for (std::size_t slot = 0; slot < SolidPlanes::kSlots; ++slot) planes.plane[slot].resize(gathered, kNoPlane);
  planes.blend.resize(gathered, kNoBlend);
  planes.position.resize(gathered, kFarRecord);
}

float smooth_step(float t) {
  t = std::clamp(t, 0.0F, 1.0F);
  return t * t * (3.0F - 2.0F * t);
}

/// How the images in two surfaces at the distances s and with the normals' cosine c count.
Float4 blend_of(float c, float s0, float s1) {
  // The water's angle t between the surfaces, 90 degrees where c = 0. Images in both: 360/t - 3 of them fit a corner
  // up to 60 degrees; below they fade out.
  const float angle = std::acos(std::clamp(-c, -1.0F, 1.0F)) * static_cast<float>(180.0 / M_PI);
  const float both =
      angle > 60.0F ? std::max(0.0F, 360.0F / angle - 3.0F) : 3.0F * std::max(0.0F, (angle - 30.0F) / 30.0F);
  // Surfaces that go on in one direction are one surface: the nearer counts for both.
  const float alike = smooth_step((c - kSkew) / (0.9F - kSkew));
  const float a = std::max(s0, 0.0F), b = std::max(s1, 0.0F), sum = std::max(a + b, 1e-12F);
  const float smooth = std::clamp(1.0F - (std::abs(c) - kSquare) / (kSkew - kSquare), 0.0F, 1.0F);
  return {1.0F - alike * a / sum, 1.0F - alike * b / sum, both, smooth};
}

float distance(const Float4& plane, const Float4& x) { return plane.x * x.x + plane.y * x.y + plane.z * x.z - plane.w; }

void find_planes_in(std::size_t begin, std::size_t end, const SolidScene& scene, const FluidState& state,
                    SolidPlanes& planes) {
  const std::span<const Float4> positions(state.particles.position);
  std::copy(positions.begin() + static_cast<std::ptrdiff_t>(begin),
            positions.begin() + static_cast<std::ptrdiff_t>(end),
            planes.position.begin() + static_cast<std::ptrdiff_t>(begin));
  scene.for_each_near(box_around(positions.subspan(begin, end - begin)), [&](std::size_t solid, std::size_t slot) {
    for (std::size_t i = begin; i < end; ++i) {
      const Float4& x = positions[i];
      const auto found = scene.surface(solid, vector_of(x));
      Float4& plane = planes.plane[slot][i];
      if (!found || found->w >= distance(plane, x)) continue;
      plane = {found->x, found->y, found->z, found->x * x.x + found->y * x.y + found->z * x.z - found->w};
      planes.solid[slot][i] = static_cast<std::int32_t>(solid);
      planes.group[i / kLanes] |= static_cast<std::uint8_t>(1U << slot);
    }
  });
  for (std::size_t i = begin; i < end; ++i) {
    if (planes.group[i / kLanes] != 3 || planes.solid[0][i] < 0 || planes.solid[1][i] < 0) continue;
    const Float4 &a = planes.plane[0][i], &b = planes.plane[1][i];
    planes.blend[i] = blend_of(a.x * b.x + a.y * b.y + a.z * b.z, distance(a, positions[i]), distance(b, positions[i]));
  }
}

/// n' = S n and o' = o + n'.offset for images.
void extend_planes(TaskPool& pool, const FluidState& state, SolidPlanes& planes) {
  const Ghosts& ghosts = state.ghosts;
  for_each_entry(pool, ghosts.count, [&](std::size_t k) {
    const Float4 &sign = ghosts.sign[k], &offset = ghosts.offset[k];
    const std::size_t source = ghosts.source[k], image = ghosts.begin + k;
    for (std::size_t slot = 0; slot < SolidPlanes::kSlots; ++slot) {
      const Float4& p = planes.plane[slot][source];
      const Float4 n{sign.x * p.x, sign.y * p.y, sign.z * p.z, 0.0F};
      planes.plane[slot][image] = {n.x, n.y, n.z, p.w + n.x * offset.x + n.y * offset.y + n.z * offset.z};
    }
    planes.blend[image] = planes.blend[source];
    planes.position[image] = state.particles.position[image];
  });
}

/// The body of a surface, or -1; the floor comes after the solids.
std::int32_t body_of(const FluidState& state, std::size_t surface) {
  return surface < state.solids.size() ? state.solids[surface].body : -1;
}

bool floor_in_slot(const FluidState& state, std::size_t slot, std::size_t i) {
  return !state.floor.empty() && state.solid_planes.solid[slot][i] == static_cast<std::int32_t>(state.solids.size());
}

Eigen::Vector3f velocity_at(const CoupledBody& body, const Eigen::Vector3f& x) {
  return (body.velocity + body.angular_velocity.cross(x.cast<double>() - body.centre)).cast<float>();
}

/// What the water has given a body beside the solves.
struct BodyPush {
  Eigen::Vector3d impulse = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();

  void add(const Eigen::Vector3d& part, const Eigen::Vector3d& arm) {
    impulse += part;
    moment += arm.cross(part);
  }
};

/// Puts one particle back and books what that gave the body.
void put_back(const FluidState& state, std::size_t solid, const Float4& surface, Float4& position, Float4& velocity,
              std::vector<BodyPush>& pushes) {
  const std::int32_t owner = body_of(state, solid);
  const Eigen::Vector3f normal = vector_of(surface), x = vector_of(position), foot = x - surface.w * normal;
  const Eigen::Vector3f out = foot + std::min(-surface.w, 0.5F * static_cast<float>(state.parameters.spacing)) * normal;
  Eigen::Vector3f of_surface = Eigen::Vector3f::Zero();
  if (owner >= 0) of_surface = velocity_at(state.coupling.bodies[static_cast<std::size_t>(owner)], foot);
  if (solid == state.solids.size()) of_surface = floor_plane(state.floor, position).speed * normal;
  position.x = out.x(), position.y = out.y(), position.z = out.z();
  const float approach = normal.dot(vector_of(velocity) - of_surface);
  if (!(approach < 0.0F)) return;
  const Eigen::Vector3f change = -2.0F * approach * normal;
  velocity.x += change.x(), velocity.y += change.y(), velocity.z += change.z();
  if (owner < 0) return;
  const CoupledBody& body = state.coupling.bodies[static_cast<std::size_t>(owner)];
  const double mass = state.parameters.rest_density * state.parameters.volume() *
                      static_cast<double>(state.coupling.fade.share(position.x, position.y));
  pushes[static_cast<std::size_t>(owner)].add(-mass * change.cast<double>(), foot.cast<double>() - body.centre);
}

void take_pushes(const std::vector<BodyPush>& pushes, std::vector<CoupledBody>& bodies) {
  for (std::size_t k = 0; k < pushes.size(); ++k) {
    CoupledBody& body = bodies[k];
    body.impulse += pushes[k].impulse;
    body.angular_impulse += pushes[k].moment;
    body.velocity += body.inverse_mass.cwiseProduct(pushes[k].impulse);
    body.angular_velocity += body.inverse_inertia * pushes[k].moment;
  }
}

}  // namespace

std::optional<Float4> surface_at(const Solid& solid, const Eigen::Vector3f& place, float reach) {
  const Eigen::Vector3f at = solid.turn.transpose() * (place - solid.place);
  const std::optional<Float4> found = solid.field->at(at.x(), at.y(), at.z(), reach);
  if (!found) return std::nullopt;
  const Eigen::Vector3f normal = solid.turn * vector_of(*found);
  return Float4{normal.x(), normal.y(), normal.z(), found->w};
}

void find_solid_planes(TaskPool& pool, FluidState& state) {
  if (!meets_surfaces(state)) return;
  SolidPlanes& planes = state.solid_planes;
  forget_planes(state.particles.count, planes);
  resize_planes(state, planes);
  const SolidScene scene(state, kReach * static_cast<float>(state.parameters.support_radius));
  pool.for_each_range(state.particles.count, kPlaneBlock,
                      [&](std::size_t begin, std::size_t end) { find_planes_in(begin, end, scene, state, planes); });
  for (std::size_t i = state.particles.count; i < padded_count(state.particles.count); ++i)
    planes.position[i] = kFarRecord;
  if (!state.ghosts.empty()) extend_planes(pool, state, planes);
  refresh_solid_speeds(pool, state);
}

std::int32_t body_in_slot(const FluidState& state, std::size_t slot, std::size_t i) {
  const std::int32_t solid = state.solid_planes.solid[slot][i];
  return solid < 0 ? -1 : body_of(state, static_cast<std::size_t>(solid));
}

void add_floor_speeds(TaskPool& pool, const FluidState& state, std::span<float> rate) {
  if (state.floor.empty()) return;
  const SolidPlanes& planes = state.solid_planes;
  for_each_entry(pool, state.particles.count, [&](std::size_t i) {
    if (planes.group[i / kLanes] == 0) return;
    for (std::size_t slot = 0; slot < SolidPlanes::kSlots; ++slot) {
      if (!floor_in_slot(state, slot, i)) continue;
      const Eigen::Vector3f normal = vector_of(planes.plane[slot][i]);
      rate[i] -= planes.speed[slot][i] * normal.dot(vector_of(state.gradients.solid_wall[slot][i]));
    }
  });
}

void refresh_solid_speeds(TaskPool& pool, FluidState& state) {
  if (!meets_surfaces(state)) return;
  SolidPlanes& planes = state.solid_planes;
  for_each_entry(pool, state.particles.count, [&](std::size_t i) {
    if (planes.group[i / kLanes] == 0) return;
    for (std::size_t slot = 0; slot < SolidPlanes::kSlots; ++slot) {
      const std::int32_t body = body_in_slot(state, slot, i);
      float& speed = planes.speed[slot][i];
      const Float4 &plane = planes.plane[slot][i], &x = planes.position[i];
      speed = floor_in_slot(state, slot, i) ? floor_plane(state.floor, x).speed : 0.0F;
      if (body < 0) continue;
      const Eigen::Vector3f normal = vector_of(plane), foot = vector_of(x) - distance(plane, x) * normal;
      speed = normal.dot(velocity_at(state.coupling.bodies[static_cast<std::size_t>(body)], foot));
    }
  });
}

void give_filter_to_bodies(TaskPool& pool, FluidState& state, float factor) {
  if (state.solids.empty() || state.coupling.empty()) return;
  const SolidPlanes& planes = state.solid_planes;
  const std::size_t count = state.particles.count, bodies = state.coupling.bodies.size();
  const double mass = static_cast<double>(factor) * state.parameters.rest_density * state.parameters.volume();
  std::vector<std::vector<BodyPush>> parts((count + kPlaneBlock - 1) / kPlaneBlock);
  pool.for_each_range(count, kPlaneBlock, [&](std::size_t begin, std::size_t end) {
    std::vector<BodyPush>& pushes = parts[begin / kPlaneBlock];
    for (std::size_t slot = 0; slot < SolidPlanes::kSlots; ++slot)
      for (std::size_t i = begin; i < end; ++i) {
        const std::int32_t body = body_in_slot(state, slot, i);
        if (body < 0) continue;
        pushes.resize(bodies);
        const Float4 &plane = planes.plane[slot][i], &x = planes.position[i];
        const Eigen::Vector3f foot = vector_of(x) - distance(plane, x) * vector_of(plane);
        const auto k = static_cast<std::size_t>(body);
        const double counted = mass * static_cast<double>(state.coupling.fade.share(x.x, x.y));
        pushes[k].add(-counted * vector_of(state.filter_change.solid[slot][i]).cast<double>(),
                      foot.cast<double>() - state.coupling.bodies[k].centre);
      }
  });
  for (const std::vector<BodyPush>& pushes : parts) take_pushes(pushes, state.coupling.bodies);
}

void push_out_of_solids(TaskPool& pool, FluidState& state) {
  if (!meets_surfaces(state)) return;
  FluidParticles& p = state.particles;
  const SolidScene scene(state, 0.0F);
  const std::size_t bodies = state.coupling.bodies.size();
  std::vector<std::vector<BodyPush>> parts((p.count + kPlaneBlock - 1) / kPlaneBlock);
  pool.for_each_range(p.count, kPlaneBlock, [&](std::size_t begin, std::size_t end) {
    std::vector<BodyPush>& pushes = parts[begin / kPlaneBlock];
    scene.for_each_near(box_around(std::span(p.position).subspan(begin, end - begin)), [&](std::size_t k, std::size_t) {
      pushes.resize(bodies);
      for (std::size_t i = begin; i < end; ++i)
        if (const auto inside = scene.surface(k, vector_of(p.position[i])))
          put_back(state, k, *inside, p.position[i], p.velocity[i], pushes);
    });
  });
  for (const std::vector<BodyPush>& pushes : parts) take_pushes(pushes, state.coupling.bodies);
}

}  // namespace pelagos
