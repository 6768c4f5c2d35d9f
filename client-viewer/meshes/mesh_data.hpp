#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "shapes/mesh_name.hpp"
#include "shapes/triangle_mesh.hpp"

namespace pelagos {

/// Triangles of a body in its own axes (x forward, y port, z up; metres), a colour at each vertex.
struct MeshData {
  struct Vertex {
    float position[3];
    float normal[3];
    float colour[3];  ///< linear
  };
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  Eigen::Vector3f low = Eigen::Vector3f::Zero(), high = Eigen::Vector3f::Zero();

  [[nodiscard]] std::size_t triangle_count() const { return indices.size() / 3; }
};

/// A mesh that cannot be drawn; the text names the file and says why.
class MeshError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

using Colour = std::array<float, 3>;  ///< linear

/// Gives each corner of each triangle a normal: that of its vertex, but edges sharper than 35 degrees stay sharp.
/// @param colour  of each triangle; or one for all
[[nodiscard]] MeshData shade(const TriangleMesh& mesh, std::span<const Colour> colour);

/// Reads a mesh with the colours of its materials and turns it into body axes. Bounded in time and memory
/// (mesh_import/import_mesh.hpp). @throws MeshError
[[nodiscard]] MeshData load_mesh(const std::filesystem::path& file, double scale,
                                 MeshAxes axes = MeshAxes::kXForwardZUp);

/// A long box as a quay (meshes/quay.hpp); any other primitive in one colour: a buoy's yellow, or concrete where it is
/// larger than ten metres.
[[nodiscard]] MeshData draw_primitive(const Primitive& primitive);

/// A box in grey, in place of a mesh that cannot be drawn.
[[nodiscard]] MeshData draw_box(const Eigen::Vector3d& low, const Eigen::Vector3d& high);

}  // namespace pelagos
