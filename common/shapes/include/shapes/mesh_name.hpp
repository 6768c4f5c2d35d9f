#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>

#include "shapes/primitive.hpp"

namespace pelagos {

/// Which way the axes of a mesh file point.
enum class MeshAxes {
  kXForwardZUp,  ///< the body's own: x forward, y port, z up
  kZForwardYUp,  ///< z forward, x port, y up: the convention of glTF 2.0 (section 3.4)
};

/// Rotation from the file's axes to the body's.
[[nodiscard]] Eigen::Matrix3d body_from_file(MeshAxes axes);

/// What the `mesh_file` of a body's description on the wire says; docs/wire.md, "Shapes of bodies".
struct MeshName {
  std::optional<Primitive> primitive;  ///< the shape itself; then the rest means nothing
  MeshAxes axes = MeshAxes::kXForwardZUp;
  std::string file;  ///< name without folders
};

/// "hull.obj", "y-up:hull.glb" or "primitive:...".
[[nodiscard]] std::string wire_name(const MeshName& name);

/// Never fails: what is no primitive and has no "y-up:" in front is the name of a file. Folders are cut off, so that
/// the name cannot lead out of the one that the reader keeps its meshes in.
[[nodiscard]] MeshName parse_wire_name(std::string_view text);

/// Whether a file of this name would be taken for something else on the wire.
[[nodiscard]] bool is_reserved(std::string_view file_name);

}  // namespace pelagos
