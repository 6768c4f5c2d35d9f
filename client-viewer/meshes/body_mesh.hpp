#pragma once

#include <filesystem>
#include <string>

#include "meshes/mesh_data.hpp"
#include "values/scene_info.hpp"

namespace pelagos {

/// What is drawn for a body.
struct BodyMesh {
  MeshData data;
  std::string note;  ///< one line for people: why it is not the file that they may expect; empty if it is
};

/// The mesh to draw for a body of a scene, in this order:
///  - its primitive;
///  - a file of `folder` with the name of the body's mesh file, if it is the same file as the server's (by its digest,
///    BodySurface): with its colours, and for `X_hull.obj` the file `X.obj` beside it, if there is one;
///  - the surface that the server sent, in grey;
///  - where the server sent none since it is too large, a box of its size;
///  - where the server tells nothing of shapes (before body_shape_v1), the file by its name alone.
/// Only regular files of `folder` itself are opened, links only if they lead to such.
/// @throws MeshError where there is nothing to draw
[[nodiscard]] BodyMesh load_body_mesh(const std::filesystem::path& folder, const BodyInfo& body);

/// The file of that name in `folder`; empty if there is none. Folders in the name are cut off.
[[nodiscard]] std::filesystem::path find_mesh_file(const std::filesystem::path& folder, const std::string& name);

/// The file to draw in place of a mesh file: `X.obj` beside `X_hull.obj`, else the file itself.
[[nodiscard]] std::filesystem::path outfitted_file(const std::filesystem::path& file);

}  // namespace pelagos
