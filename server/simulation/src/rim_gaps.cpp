#include "simulation/rim_gaps.hpp"

#include <algorithm>
#include <cmath>

#include "labelled_waves.hpp"

namespace pelagos {

namespace {

/// Spacings to the next particle where one comes back: less would be a clash, much more a hole that never closes.
constexpr float kRoom = 0.7F;

bool has_room(const FluidParticles& particles, const Eigen::Vector3f& place, float spacing) {
  const float least = kRoom * spacing * kRoom * spacing;
  for (std::size_t i = 0; i < particles.count; ++i)
    if ((vector_of(particles.position[i]) - place).squaredNorm() < least) return false;
  return true;
}

float& component(Float4& record, std::size_t axis) { return axis == 0 ? record.x : record.y; }

}  // namespace

bool RimGaps::open(TaskPool& pool, const OpenSea& sea, const PatchFrame& frame, const HullsAtRim& hulls,
                   FluidState& fluid) {
  const FluidParticles& p = fluid.particles;
  std::vector<Eigen::AlignedBox3f> boxes;
  const auto margin = static_cast<float>(sea.shape().spacing);
  for (const Eigen::AlignedBox3d& box : hulls.boxes) {
    const Eigen::Vector3f low = frame.to_local(box.min()).cast<float>(), high = frame.to_local(box.max()).cast<float>();
    boxes.emplace_back(low.array() - margin, high.array() + margin);
  }
  std::vector<std::uint8_t> gone(p.count, 0);
  const std::size_t before = labels_.size();
  for (const std::uint32_t i : fluid.held.rows) {
    const Eigen::Vector3f x = vector_of(p.position[i]);
    const bool near = std::any_of(boxes.begin(), boxes.end(), [&](const auto& box) { return box.contains(x); });
    if (!near || !hulls.covers(x)) continue;
    gone[i] = 1;
    labels_.push_back(p.label[i]);
  }
  if (labels_.size() == before) return false;
  (void)remove_particles(pool, fluid, [&](std::size_t i) { return gone[i] != 0; });
  find_held(fluid);
  return true;
}

bool RimGaps::close(const OpenSea& sea, const HullsAtRim& hulls, const RimMotion& motion, FluidState& fluid) {
  std::vector<Float4> still_open, position, velocity, label;
  const auto level = static_cast<float>(sea.shape().level), spacing = static_cast<float>(sea.shape().spacing);
  LabelBatch batch;
  for (const Float4& gap : labels_) {
    batch.clear();
    batch.add(gap);
    batch.displace(motion.place);
    const Eigen::Vector3f place(gap.x + batch.a[0], gap.y + batch.b[0], gap.z + batch.c[0] + level);
    if (hulls.covers(place) || !has_room(fluid.particles, place, spacing)) {
      still_open.push_back(gap);
      continue;
    }
    batch.move(motion.velocity);
    position.push_back({place.x(), place.y(), place.z(), 0.0F});
    velocity.push_back({batch.a[0], batch.b[0], batch.c[0], 0.0F});
    label.push_back(gap);
  }
  labels_ = std::move(still_open);
  if (label.empty()) return false;
  add_particles(fluid, position, velocity, kWaterPhase, label);
  find_held(fluid);
  return true;
}

bool RimGaps::renew(TaskPool& pool, const OpenSea& sea, const PatchFrame& frame, const HullsAtRim& hulls,
                    const RimMotion& motion, FluidState& fluid) {
  const bool closed = !labels_.empty() && close(sea, hulls, motion, fluid);
  const bool opened = !hulls.boxes.empty() && open(pool, sea, frame, hulls, fluid);
  return closed || opened;
}

void RimGaps::shift(const OpenSea& sea, std::size_t axis, int way) {
  std::erase_if(labels_, [&](Float4& label) {
    component(label, axis) -= static_cast<float>(way * sea.shape().spacing);
    return sea.inside_of(axis, -way, component(label, axis)) < 0.0 ||
           sea.inside(static_cast<double>(label.x), static_cast<double>(label.y)) > sea.rim();
  });
}

}  // namespace pelagos
