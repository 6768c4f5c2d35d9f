// Patches of an open sea.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "scene.pb.h"
#include "validate_scene.hpp"
#include "values/open_edges.hpp"

namespace pelagos {

namespace {

constexpr double kLeastZone = 4.0, kMostZone = 100.0, kLeastInside = 10.0, kLeastLayers = 4.0;  // spacings
constexpr double kDefaultZone = 15.0;
constexpr double kDeepest = 12000.0;  // m
constexpr const char* kSides[] = {"x", "y"};

bool is_whole(double count) { return std::fabs(count - std::round(count)) <= 1e-6; }

/// One block from side to side and from the lower side of the patch up.
void check_water(const FieldReader& reader, const Scene& scene) {
  const FieldReader water = reader.child("water");
  const std::vector<Box>& blocks = scene.water.blocks;
  if (blocks.size() != 1) {
    if (!blocks.empty())
      water.fault("block", "there are " + std::to_string(blocks.size()) + "; allowed with OPEN edges: one");
    return;
  }
  const Box& block = blocks[0];
  const double near = 1e-6 * scene.particle_spacing;
  const bool fills = (block.min - scene.patch.min).cwiseAbs().maxCoeff() <= near &&
                     (block.max - scene.patch.max).head<2>().cwiseAbs().maxCoeff() <= near;
  if (!fills)
    water.fault("block",
                "does not fill the patch; allowed with OPEN edges: from the patch's min corner to its max x "
                "and y");
  const double layers = block.size().z() / scene.particle_spacing;
  if (!is_whole(layers) || layers < kLeastLayers - 1e-6)
    water.fault("block", "is " + format_number(layers) +
                             " spacings deep; allowed with OPEN edges: a whole number, at "
                             "least " +
                             format_number(kLeastLayers));
}

void check_solver(const FieldReader& reader, const Scene& scene) {
  if (scene.solver.kind != SolverKind::kCorrected)
    reader.child("patch_edges").fault("", "are OPEN; allowed with the solver CORRECTED only");
  if (scene.support_radius != 2.0)
    reader.fault("support_radius", "is " + format_number(scene.support_radius) + "; allowed with OPEN edges: 2");
  if (!(scene.gravity > 0.0)) reader.fault("gravity", "is 0; allowed with OPEN edges: above 0");
  if (scene.oil)
    reader.fault("oil", "is in a patch with OPEN edges, where it would be lost; allowed: WALL, MIRROR, PERIODIC");
}

double read_zone(const FieldReader& entry, const Scene& scene) {
  const double d = scene.particle_spacing;
  double zone = kDefaultZone * d;
  entry.read("zone_width", {kLeastZone * d, kMostZone * d, "m", "4 to 100 spacings"}, zone);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    if (scene.patch_edges[axis] != PatchEdge::kOpen) continue;
    const double side = scene.patch.size()[static_cast<int>(axis)],
                 least = 2.0 * (zone + kRimColumns * d) + kLeastInside * d;
    if (side >= least - 1e-6 * d) continue;
    entry.fault("zone_width", "of " + format_number(zone) + " m leaves no room: the patch's side along " +
                                  kSides[axis] + " is " + format_number(side) + " m; allowed: sides of at least " +
                                  format_number(least) + " m with such zones");
  }
  return zone;
}

void read_track(const FieldReader& track, OpenSeaSettings& open) {
  double speed = 0.0, course = 0.0;
  track.require("speed");
  track.require("course_deg");
  track.read("speed", {0.0, 30.0, "m/s"}, speed);
  track.read("course_deg", {0.0, 360.0, "degrees clockwise from north"}, course);
  const double angle = course * std::numbers::pi / 180.0;
  open.follow_velocity = speed * Eigen::Vector2d(std::sin(angle), std::cos(angle));
  for (double& part : open.follow_velocity)  // a course of 90 degrees does not go north
    if (std::abs(part) < 1e-9 * speed) part = 0.0;
}

/// The patch moves across open edges only.
void check_ways(const FieldReader& follow, const Scene& scene) {
  for (int axis = 0; axis < 2; ++axis) {
    const bool moves = scene.open_sea.follow_body != 0 || scene.open_sea.follow_velocity[axis] != 0.0;
    if (moves && scene.patch_edges[static_cast<std::size_t>(axis)] != PatchEdge::kOpen)
      follow.fault("", std::string("moves the patch along ") + kSides[axis] + "; allowed: where patch_edges are OPEN");
  }
}

void read_follow(const FieldReader& entry, Scene& scene) {
  if (!entry.has("follow")) return;
  const FieldReader follow = entry.child("follow");
  if (follow.has("body") == follow.has("track")) {
    follow.fault("", "has " + std::string(follow.has("body") ? "a body and a track" : "neither a body nor a track") +
                         "; allowed: exactly one");
    return;
  }
  const auto fixed = std::find_if(scene.bodies.begin(), scene.bodies.end(),
                                  [](const BodySettings& body) { return body.drive == BodyDrive::kStatic; });
  if (fixed != scene.bodies.end())
    follow.fault("", "moves the patch away from body " + std::to_string(fixed->id) +
                         ", which is STATIC; allowed with follow: bodies that move");
  if (follow.has("track")) {
    read_track(follow.child("track"), scene.open_sea);
    return check_ways(follow, scene);
  }
  follow.read("body", {1, 4294967295.0}, scene.open_sea.follow_body);
  const bool known = std::any_of(scene.bodies.begin(), scene.bodies.end(),
                                 [&](const BodySettings& body) { return body.id == scene.open_sea.follow_body; });
  if (!known)
    follow.fault("body",
                 std::to_string(scene.open_sea.follow_body) + " is no body of the scene; allowed: the id of one");
  check_ways(follow, scene);
}

}  // namespace

void validate_open_sea(const FieldReader& reader, const SceneSource& source, Scene& scene) {
  const bool open = is_open(scene.patch_edges);
  if (scene.patch_edges[2] == PatchEdge::kOpen)
    reader.child("patch_edges").fault("z", "is OPEN; allowed for x and y; with them the floor gives way by itself");
  if (open && scene.patch_edges[2] == PatchEdge::kPeriodic)
    reader.child("patch_edges").fault("z", "is PERIODIC; allowed with OPEN edges: leave it out");
  if (!open && reader.has("open_sea")) reader.fault("open_sea", "needs patch_edges that are OPEN along x or y");
  if (open) {
    check_solver(reader, scene);
    check_water(reader, scene);
  }
  const FieldReader entry = reader.child("open_sea");
  scene.open_sea.zone_width = read_zone(entry, scene);
  const double simulated = scene.water.blocks.empty() ? 0.0 : scene.water.blocks[0].size().z();
  entry.read("depth", {simulated, kDeepest, "m", "at least the depth of the block of water"}, scene.open_sea.depth);
  read_follow(entry, scene);
  if (entry.has("bed")) read_sea_bed(entry.child("bed"), source, scene);
}

}  // namespace pelagos
