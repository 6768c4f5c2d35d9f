#include <algorithm>
#include <cmath>
#include <exception>

#include "flat_triangles.hpp"
#include "mesh_import/import_mesh.hpp"
#include "rigid/triangle_mesh.hpp"
#include "rim_points.hpp"

namespace pelagos {

namespace {

constexpr double kWeldPart = 1e-6;    ///< of the mesh's size
constexpr double kOnEdgePart = 1e-5;  ///< of the mesh's size: what rounding to four or five digits leaves

/// The farthest that a corner lies from the first one, along an axis. Vertices without a triangle do not count.
double largest_coordinate(const TriangleMesh& mesh) {
  double largest = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c)
      largest = std::max(largest, (mesh.corner(t, c) - mesh.corner(0, 0)).cwiseAbs().maxCoeff());
  return std::isfinite(largest) ? largest : 0.0;
}

void take_triangles(const ImportedMesh& imported, MeshFile& file) {
  for (const ImportedPart& part : imported.parts) {
    file.origin.parts.push_back(part.name);
    file.origin.place_name.push_back(part.place);
  }
  for (const ImportedTriangle& triangle : imported.triangles) {
    file.mesh.triangles.push_back(triangle.corners);
    file.origin.part.push_back(triangle.part);
    file.origin.place.push_back(triangle.place);
  }
}

/// Leaves out the triangles of which two corners have become one vertex: their neighbours meet where they were.
void drop_collapsed(MeshFile& file) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < file.mesh.triangles.size(); ++t) {
    const auto [a, b, c] = file.mesh.triangles[t];
    if (a == b || b == c || c == a) continue;
    file.mesh.triangles[kept] = {a, b, c};
    file.origin.part[kept] = file.origin.part[t];
    file.origin.place[kept++] = file.origin.place[t];
  }
  file.mesh.triangles.resize(kept);
  file.origin.part.resize(kept);
  file.origin.place.resize(kept);
}

MeshFile read_checked(const std::string& path, const MeshOptions& options) {
  MeshFile file;
  if (!(options.scale > 0.0) || !std::isfinite(options.scale)) {
    file.faults.push_back({"scale", std::to_string(options.scale) + "; allowed: a finite number above 0"});
  } else {
    ImportedMesh imported = import_mesh(path);
    file.faults = std::move(imported.faults);
    file.notes = std::move(imported.notes);
    take_triangles(imported, file);
    file.mesh.vertices = std::move(imported.vertices);
  }
  if (file.faults.empty()) {
    const Eigen::Matrix3d turn = body_from_file(options.axes);
    for (Eigen::Vector3d& vertex : file.mesh.vertices) vertex = turn * (options.scale * vertex);
    const double size = largest_coordinate(file.mesh);
    file.mesh = weld_parts(file.mesh, file.origin.part, kWeldPart * size);
    drop_collapsed(file);
    mend_flat_triangles(file.mesh, file.origin);
    if (options.kind == MeshKind::kClosed) divide_at_rim_points(file.mesh, file.origin, kOnEdgePart * size);
    file.faults = find_mesh_faults(file.mesh, options.kind, file.origin);
    if (!file.faults.empty())
      for (const std::string& note : file.notes) file.faults.push_back({"", note});
  }
  for (Refusal& fault : file.faults) fault = put_behind(path, ": ", fault);
  return file;
}

}  // namespace

MeshFile read_mesh(const std::string& path, const MeshOptions& options) {
  try {
    return read_checked(path, options);
  } catch (const std::exception& error) {
    return {{}, {{path, error.what()}}};
  }
}

}  // namespace pelagos
