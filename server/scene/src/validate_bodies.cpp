#include <algorithm>
#include <cmath>
#include <map>

#include "scales/angles.hpp"
#include "scene.pb.h"
#include "validate_scene.hpp"

namespace pelagos {
namespace {

constexpr std::size_t kMostBodies = 64;

/// Body (x forward, y port, z up) to world (ENU) out of a ship's angles: heading clockwise from north, bow up positive,
/// starboard down positive, in the ship's usual order (roll first, heading last).
Eigen::Quaterniond orientation_of(double heading_deg, double pitch_deg, double roll_deg) {
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  return Eigen::Quaterniond(AngleAxisd((90.0 - heading_deg) * kRadiansPerDegree, Vector3d::UnitZ()) *
                            AngleAxisd(-pitch_deg * kRadiansPerDegree, Vector3d::UnitY()) *
                            AngleAxisd(roll_deg * kRadiansPerDegree, Vector3d::UnitX()));
}

Eigen::Quaterniond read_orientation(const FieldReader& reader) {
  double heading_deg = 0.0;
  double pitch_deg = 0.0;
  double roll_deg = 0.0;
  reader.read("heading_deg", {0.0, 360.0, "degrees clockwise from north"}, heading_deg);
  reader.read("pitch_deg", {-90.0, 90.0, "degrees, bow up positive"}, pitch_deg);
  reader.read("roll_deg", {-180.0, 180.0, "degrees, starboard down positive"}, roll_deg);
  if (!reader.has("orientation")) return orientation_of(heading_deg, pitch_deg, roll_deg);

  if (reader.has("heading_deg") || reader.has("pitch_deg") || reader.has("roll_deg")) {
    reader.fault("orientation", "is given beside an angle; allowed: the quaternion or the angles, not both");
  }
  const FieldReader entry = reader.child("orientation");
  Eigen::Vector4d wxyz = Eigen::Vector4d::Zero();
  const std::array<const char*, 4> names{"w", "x", "y", "z"};
  bool valid = true;
  for (int i = 0; i < 4; ++i) {
    const char* name = names[static_cast<std::size_t>(i)];
    if (entry.has(name)) valid = entry.read(name, {-1.01, 1.01}, wxyz[i]) && valid;
  }
  if (!valid) return Eigen::Quaterniond::Identity();
  if (std::fabs(wxyz.norm() - 1.0) > 0.01) {
    reader.fault("orientation",
                 "has length " + format_number(wxyz.norm()) + "; allowed: a unit quaternion, 0.99 to 1.01");
    return Eigen::Quaterniond::Identity();
  }
  wxyz.normalize();
  return {wxyz[0], wxyz[1], wxyz[2], wxyz[3]};
}

/// Beyond open edges the sea goes on, and carries what moves.
bool is_in_water(const Box& patch, const PatchEdges& edges, const BodySettings& body) {
  for (int axis = 0; axis < 3; ++axis) {
    const bool goes_on = edges[static_cast<std::size_t>(axis)] == PatchEdge::kOpen && body.drive != BodyDrive::kStatic;
    if (!goes_on && !(body.position[axis] >= patch.min[axis] && body.position[axis] <= patch.max[axis])) return false;
  }
  return true;
}

void read_place(const FieldReader& reader, const std::optional<Box>& patch, const PatchEdges& edges,
                BodySettings& body) {
  reader.require("position");
  if (!reader.read("position", {-1e6, 1e6, "m"}, body.position) || !patch || is_in_water(*patch, edges, body)) return;
  const bool open = is_open(edges);
  reader.fault("position",
               "(" + format_number(body.position.x()) + ", " + format_number(body.position.y()) + ", " +
                   format_number(body.position.z()) + ") is outside the patch; allowed: within its " +
                   (open ? "sides, or beyond OPEN ones with drive FREE, POSE or POSE_HORIZONTAL" : "walls"));
}

BodyDrive drive_of(int drive) {
  switch (drive) {
    case proto::v1::Body::STATIC:
      return BodyDrive::kStatic;
    case proto::v1::Body::FREE:
      return BodyDrive::kFree;
    case proto::v1::Body::POSE_HORIZONTAL:
      return BodyDrive::kPoseHorizontal;
    default:
      return BodyDrive::kPose;
  }
}

HoldStart read_hold(const FieldReader& reader, const BodySettings& body) {
  if (!reader.has("hold")) return HoldStart::kDefault;
  if (body.open) reader.fault("hold", "is given to an open mesh, which has none; allowed: with a closed mesh");
  switch (reader.read_enum("hold")) {
    case proto::v1::Body::DRY:
      return HoldStart::kDry;
    case proto::v1::Body::FLOODED:
      return HoldStart::kFlooded;
    default:
      return HoldStart::kDefault;
  }
}

/// A solid cannot have one radius of gyration so long that its square exceeds the sum of the others' squares.
void check_gyration(const FieldReader& mass, const Eigen::Vector3d& radii) {
  const Eigen::Vector3d squares = radii.cwiseAbs2();
  if (radii.minCoeff() > 0.0 && 2.0 * squares.maxCoeff() <= squares.sum() * (1.0 + 1e-9)) return;
  mass.fault("gyration", "(" + format_number(radii.x()) + ", " + format_number(radii.y()) + ", " +
                             format_number(radii.z()) +
                             ") m is no solid's; allowed: all three above 0, no square above the sum of the other two");
}

MassSettings read_mass_entry(const FieldReader& entry) {
  MassSettings mass;
  entry.read("kg", {1e-9, 1e12, "kg"}, mass.mass);
  entry.read("density", {1e-6, 1e5, "kg/m^3"}, mass.density);
  if (entry.has("kg") == entry.has("density"))
    entry.fault("kg", entry.has("kg") ? "is given beside density; allowed: one of the two"
                                      : "and density are both missing; allowed: one of the two");
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
  if (entry.has("centre") && entry.read("centre", {-1e4, 1e4, "m"}, value)) mass.centre = value;
  value.setZero();
  if (entry.has("gyration") && entry.read("gyration", {1e-6, 1e4, "m"}, value)) {
    check_gyration(entry, value);
    mass.gyration = value;
  }
  return mass;
}

/// Whether the axes of the body at the start point along x and y, where its bow points there.
bool is_square(const Eigen::Quaterniond& orientation) {
  const Eigen::Vector3d bow = orientation * Eigen::Vector3d::UnitX();
  const double across = std::min(std::abs(bow.x()), std::abs(bow.y()));
  return across <= 1e-6 * std::hypot(bow.x(), bow.y());
}

/// From motions along and about the axes of the body at the start to those of the world.
void read_freedoms(const FieldReader& reader, BodySettings& body) {
  const std::vector<int> free = reader.read_enums("free");
  if (!reader.has("free")) return;
  const auto has = [&free](int motion) { return std::find(free.begin(), free.end(), motion) != free.end(); };
  using Body = proto::v1::Body;
  if (has(Body::FREEDOM_DEFAULT))
    reader.fault("free", "FREEDOM_DEFAULT is no motion; allowed: SURGE, SWAY, HEAVE, ROLL, PITCH, YAW");
  const bool one_way = has(Body::SURGE) != has(Body::SWAY), one_tilt = has(Body::ROLL) != has(Body::PITCH);
  if ((one_way || one_tilt) && !is_square(body.orientation))
    reader.fault("free", std::string(one_way ? "SURGE and SWAY" : "ROLL and PITCH") +
                             " differ and the bow points neither along x nor along y; allowed: with heading_deg 0, 90, "
                             "180 or 270");
  const Eigen::Vector3d bow = body.orientation * Eigen::Vector3d::UnitX();
  const bool along_x = std::abs(bow.x()) > std::abs(bow.y());
  const auto flags = [along_x](bool ahead, bool aside, bool up) {
    const Eigen::Vector3d own(ahead ? 1.0 : 0.0, aside ? 1.0 : 0.0, up ? 1.0 : 0.0);
    return along_x ? own : Eigen::Vector3d(own.y(), own.x(), own.z());
  };
  body.freedoms.along = flags(has(Body::SURGE), has(Body::SWAY), has(Body::HEAVE));
  body.freedoms.about = flags(has(Body::ROLL), has(Body::PITCH), has(Body::YAW));
}

/// What only bodies have that the water pushes.
void read_freedom(const FieldReader& reader, BodySettings& body) {
  if (reader.has("mass")) body.mass = read_mass_entry(reader.child("mass"));
  reader.read("velocity", {-100.0, 100.0, "m/s"}, body.velocity);
  reader.read("free_from", {0.0, 1e6, "s"}, body.free_from);
  if (is_free(body.drive) && !reader.has("mass"))
    reader.fault("mass", "is missing; a body that the water pushes needs one, with kg or density");
  if (!is_free(body.drive) && reader.has("mass"))
    reader.fault("mass",
                 "is given to a body that the water does not push; allowed: with drive FREE or POSE_HORIZONTAL");
  read_freedoms(reader, body);
  for (const char* name : {"velocity", "free_from", "free"})
    if (body.drive != BodyDrive::kFree && reader.has(name))
      reader.fault(name, "is given to a body that is not free; allowed: with drive FREE");
}

BodySettings read_body(const FieldReader& reader, const std::optional<Box>& patch, const PatchEdges& edges,
                       const SceneSource& source) {
  BodySettings body;
  reader.require("id");
  reader.read("id", {1.0, 4294967295.0}, body.id);
  body.name = "body " + std::to_string(body.id);
  reader.read("name", 64, body.name);
  body.drive = drive_of(reader.read_enum("drive"));
  read_surface_of_body(reader, source, body);
  double inset = 0.0;
  if (reader.has("sample_inset") && reader.read("sample_inset", {0.0, 1.0, "spacings"}, inset))
    body.sample_inset = inset;
  read_place(reader, patch, edges, body);
  body.orientation = read_orientation(reader);
  body.hold = read_hold(reader, body);
  read_freedom(reader, body);
  return body;
}

}  // namespace

std::vector<BodySettings> validate_bodies(const FieldReader& scene_reader, const std::optional<Box>& patch,
                                          const PatchEdges& edges, const SceneSource& source) {
  const std::vector<FieldReader> entries = scene_reader.children("body");
  if (entries.size() > kMostBodies) {
    scene_reader.fault("body", "has " + std::to_string(entries.size()) + " entries; allowed: at most 64");
    return {};
  }
  std::vector<BodySettings> bodies;
  std::map<std::uint32_t, std::size_t> first_with;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    bodies.push_back(read_body(entries[i], patch, edges, source));
    const std::uint32_t id = bodies.back().id;
    const auto [found, fresh] = first_with.emplace(id, i);
    if (id != 0 && !fresh) {
      entries[i].fault("id", std::to_string(id) + " is taken by body[" + std::to_string(found->second) +
                                 "]; allowed: an id of its own for each body, 1 or more");
    }
  }
  return bodies;
}

}  // namespace pelagos
