#include "watches.hpp"

#include <fmt/format.h>

#include <cmath>

#include "monotonic_clock.hpp"
#include "server_log.hpp"

namespace pelagos {

namespace {

/// Beyond these an open sea is worth a warning: its level in spacings, and how far its waves are from those around.
constexpr double kLevelOff = 0.5, kHeightOff = 0.2;

constexpr std::int64_t kRefusalsIntervalNs = 10'000'000'000;  // between two events about poses

const char* describe_health(PoseHealth health) {
  switch (health) {
    case PoseHealth::kNone:
      return "no pose yet: the body holds where the scene put it";
    case PoseHealth::kFresh:
      return "poses are fresh";
    case PoseHealth::kCoasting:
      return "poses are stale: the body coasts";
    case PoseHealth::kHolding:
      return "poses are stale: the body is brought to rest and holds";
  }
  return "";
}

}  // namespace

void Watches::look(const World& world, const Snapshot& frame, Announcer& announcer) {
  look_at_health(frame.bodies, announcer);
  look_at_places(world.patch(), frame.bodies, announcer);
  for (const std::string& news : holds_.look(world.bodies().holds())) announcer.announce("hold", "server", news);
  look_at_edges(world, announcer);
  if (frame.oil) look_at_oil(frame.oil->budget, world.time(), announcer);
}

void Watches::look_at_health(const std::vector<BodyState>& states, Announcer& announcer) {
  health_.resize(states.size(), PoseHealth::kNone);
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i].health == health_[i]) continue;
    health_[i] = states[i].health;
    const std::string text = "body " + std::to_string(states[i].body) + ": " + describe_health(states[i].health);
    announcer.announce(states[i].health == PoseHealth::kFresh ? "pose_fresh" : "pose_stale", "server", text);
  }
}

void Watches::look_at_places(const PatchFrame& frame, const std::vector<BodyState>& states, Announcer& announcer) {
  const Box& patch = frame.box;
  const char* carries = is_open(frame.edges) ? "the waves around carry it" : "it meets no water there";
  outside_.resize(states.size(), false);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Eigen::Vector3d& x = states[i].position;
    const bool outside = (x.array() < patch.min.array()).any() || (x.array() > patch.max.array()).any();
    if (outside == outside_[i]) continue;
    outside_[i] = outside;
    const std::string where =
        fmt::format("body {} at ({:.1f}, {:.1f}, {:.1f}) m ", states[i].body, x.x(), x.y(), x.z());
    if (outside) log_warning(where + "has left the patch: " + carries);
    announcer.announce(outside ? "body_outside" : "body_inside", "server",
                       where + (outside ? "has left the patch" : "is inside the patch again"));
  }
}

void Watches::look_at_edges(const World& world, Announcer& announcer) {
  const std::optional<EdgeQuality> edges = world.edge_quality();
  if (!edges) return;
  const double spacing = world.scene().particle_spacing;
  const bool level = std::abs(edges->level) > kLevelOff * spacing;
  const bool waves = edges->height_ratio && std::abs(*edges->height_ratio - 1.0) > kHeightOff &&
                     edges->significant_height > kLevelOff * spacing;
  if ((level || waves) == edges_off_) return;
  edges_off_ = level || waves;
  const std::string figures = fmt::format("level {:+.2f} m, waves inside {:.2f} of those around", edges->level,
                                          edges->height_ratio.value_or(1.0));
  const std::string text = edges_off_ ? "the patch does not follow the open sea: " + figures +
                                            "; a larger patch, wider zones or a slower ship help"
                                      : "the patch follows the open sea again: " + figures;
  if (edges_off_) log_warning(text);
  announcer.announce("edges", "server", text);
}

void Watches::look_at_oil(const OilBudget& oil, double time, Announcer& announcer) {
  for (const CommandNews& news : spill_.observe(oil, time)) {
    if (news.kind == "release_waits" || news.kind == "skimmer_dry") log_warning(news.text);
    announcer.announce(news.kind, "server", news.text);
  }
}

/// The log has the bodies and senders.
void Watches::look_at_poses(const PoseCounters& poses, Announcer& announcer) {
  const std::int64_t now = monotonic_ns();
  const std::uint64_t in_all = poses.refused_in_all() + poses.corrected;
  if (now < next_refusals_ns_ || in_all == refusals_told_) return;
  refusals_told_ = in_all;
  next_refusals_ns_ = now + kRefusalsIntervalNs;
  std::string text =
      fmt::format("poses since the start: {} accepted, {} of them with the velocity of their places; {} refused",
                  poses.accepted, poses.corrected, poses.refused_in_all());
  for (std::size_t k = 0; k < poses.refused.size(); ++k)
    if (poses.refused[k] > 0) text += fmt::format("; {}: {}", poses.refused[k], describe(static_cast<PoseFault>(k)));
  announcer.announce("pose_refused", "server", text);
}

void Watches::look_at_requests(std::uint64_t dropped, Announcer& announcer) {
  const std::int64_t now = monotonic_ns();
  if (dropped == requests_dropped_ || now < next_dropped_ns_) return;
  next_dropped_ns_ = now + kRefusalsIntervalNs;
  announcer.announce("refused", "server",
                     fmt::format("{} requests for probes came too fast and were not taken; allowed: 20 a second of a "
                                 "bridge, 300 at once",
                                 dropped - requests_dropped_));
  requests_dropped_ = dropped;
}

void Watches::look_at_current(const World& world) {
  if (closed_axes_noticed_ || !world.current_field()) return;
  const Eigen::Vector3d& velocity = world.current_field()->target().velocity;
  std::string axes;
  for (int axis = 0; axis < 2; ++axis)
    if (velocity[axis] != 0.0 && !world.current_moves_water()[static_cast<std::size_t>(axis)])
      axes += (axes.empty() ? "" : " and ") + std::string(1, static_cast<char>('x' + axis));
  if (axes.empty()) return;
  closed_axes_noticed_ = true;
  log_info("notice: the patch is closed along " + axes +
           ": there the current carries only what drifts, the water stays (patch_edges PERIODIC lets it flow)");
}

}  // namespace pelagos
