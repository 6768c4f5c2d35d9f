#pragma once

#include <sys/stat.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <utility>

#include "mesh_import/import_mesh.hpp"

namespace pelagos::test {

/// A folder of files that goes with the test.
class MeshFiles {
 public:
  MeshFiles() {
    static int number = 0;
    folder_ = std::filesystem::temp_directory_path() /
              ("pelagos_meshes_" + std::to_string(getpid()) + "_" + std::to_string(number++));
    std::filesystem::create_directories(folder_);
  }
  ~MeshFiles() { std::filesystem::remove_all(folder_); }
  MeshFiles(const MeshFiles&) = delete;
  MeshFiles& operator=(const MeshFiles&) = delete;

  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

/// What is read of one file.
inline ImportedMesh imported(const std::string& name, const std::string& bytes, const ImportOptions& options = {}) {
  const MeshFiles files;
  return import_mesh(files.write(name, bytes), options);
}

inline std::string first_fault(const ImportedMesh& mesh) {
  return mesh.faults.empty() ? "" : to_string(mesh.faults.front());
}

/// By the divergence theorem, in the units of the file.
inline double volume_of(const ImportedMesh& mesh) {
  double volume = 0.0;
  for (const ImportedTriangle& triangle : mesh.triangles) {
    const auto& [a, b, c] = triangle.corners;
    volume += mesh.vertices[a].dot(mesh.vertices[b].cross(mesh.vertices[c])) / 6.0;
  }
  return volume;
}

/// Whether each edge, from point to point, is run along as often as back.
inline bool is_closed(const ImportedMesh& mesh) {
  using Point = std::array<double, 3>;
  std::map<std::pair<Point, Point>, int> edges;
  const auto point = [&](std::uint32_t v) {
    return Point{mesh.vertices[v].x(), mesh.vertices[v].y(), mesh.vertices[v].z()};
  };
  for (const ImportedTriangle& triangle : mesh.triangles)
    for (std::size_t c = 0; c < 3; ++c) {
      const Point from = point(triangle.corners[c]), to = point(triangle.corners[(c + 1) % 3]);
      edges[std::minmax(from, to)] += from < to ? 1 : -1;
    }
  for (const auto& [edge, sum] : edges)
    if (sum != 0) return false;
  return !edges.empty();
}

/// The smallest area of a triangle.
inline double least_area(const ImportedMesh& mesh) {
  double least = 1e300;
  for (const ImportedTriangle& triangle : mesh.triangles) {
    const auto& [a, b, c] = triangle.corners;
    const Eigen::Vector3d arm = mesh.vertices[b] - mesh.vertices[a];
    least = std::min(least, 0.5 * arm.cross(mesh.vertices[c] - mesh.vertices[a]).norm());
  }
  return least;
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

}  // namespace pelagos::test
