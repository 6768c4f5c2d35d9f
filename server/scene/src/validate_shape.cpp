#include <vector>

#include "scene.pb.h"
#include "validate_scene.hpp"

namespace pelagos {
namespace {

constexpr Range kSize{0.001, 10000.0, "m"};

std::string find_mesh(const FieldReader& reader, const std::string& written, const SceneSource& source) {
  if (is_reserved(std::filesystem::path(written).filename().string())) {
    reader.fault("mesh_file", "\"" + written +
                                  "\" begins with a word that means something else to viewers; allowed: "
                                  "names of files without \"primitive:\" or \"y-up:\" in front");
    return written;
  }
  return find_asset(reader, "mesh_file", written, source);
}

/// A length that is required.
double read_length(const FieldReader& reader, const char* name) {
  double value = 1.0;
  reader.require(name);
  reader.read(name, kSize, value);
  return value;
}

BoxShape read_box_shape(const FieldReader& reader) {
  BoxShape box;
  if (!reader.require("size")) return box;
  for (const char* axis : {"x", "y", "z"}) reader.child("size").require(axis);
  reader.read("size", kSize, box.size);
  return box;
}

CapsuleShape read_capsule(const FieldReader& reader) {
  const CapsuleShape capsule{read_length(reader, "radius"), read_length(reader, "length")};
  if (capsule.length < 2.0 * capsule.radius)
    reader.fault("length", format_number(capsule.length) +
                               " m is shorter than the two half spheres; allowed: at least " +
                               format_number(2.0 * capsule.radius) + " m, twice the radius");
  return capsule;
}

std::optional<Primitive> read_primitive(const FieldReader& reader) {
  std::vector<Primitive> given;
  if (reader.has("box")) given.emplace_back(read_box_shape(reader.child("box")));
  if (reader.has("sphere")) given.emplace_back(SphereShape{read_length(reader.child("sphere"), "radius")});
  if (reader.has("cylinder")) {
    const FieldReader cylinder = reader.child("cylinder");
    given.emplace_back(CylinderShape{read_length(cylinder, "radius"), read_length(cylinder, "length")});
  }
  if (reader.has("capsule")) given.emplace_back(read_capsule(reader.child("capsule")));
  if (given.size() == 1) return given[0];
  reader.fault(
      "", "has " + std::to_string(given.size()) + " entries; allowed: exactly one of box, sphere, cylinder, capsule");
  return std::nullopt;
}

void refuse_fields_of_files(const FieldReader& reader) {
  for (const char* name : {"mesh_scale", "mesh_axes", "open"})
    if (reader.has(name)) reader.fault(name, "goes with a mesh_file, and this body has a shape; leave it out");
}

}  // namespace

void read_surface_of_body(const FieldReader& reader, const SceneSource& source, BodySettings& body) {
  reader.read("mesh_scale", {0.001, 1000.0}, body.mesh_scale);
  if (reader.has("shape")) {
    if (reader.has("mesh_file")) reader.fault("shape", "is given beside a mesh_file; allowed: one of the two");
    refuse_fields_of_files(reader);
    body.primitive = read_primitive(reader.child("shape"));
    return;
  }
  std::string written;
  if (!reader.has("mesh_file")) {
    reader.fault("mesh_file", "is missing; a body needs a mesh_file or a shape { box, sphere, cylinder or capsule }");
  } else if (reader.read("mesh_file", 1024, written)) {
    body.mesh_file = find_mesh(reader, written, source);
  }
  if (reader.read_enum("mesh_axes") == proto::v1::Body::Z_FORWARD_Y_UP) body.mesh_axes = MeshAxes::kZForwardYUp;
  reader.read("open", body.open);
  if (body.open && body.drive != BodyDrive::kStatic)
    reader.fault("open",
                 "is true, but the body moves; allowed with drive: STATIC only, for an open mesh has no inside");
}

}  // namespace pelagos
