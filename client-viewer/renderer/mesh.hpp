#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "renderer/gl_objects.hpp"
#include "shapes/mesh_name.hpp"

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
};

/// Reads a mesh with the colours of its materials and turns it into body axes; edges sharper than 35 degrees stay
/// sharp.
/// @throws GraphicsError naming the file
[[nodiscard]] MeshData load_mesh(const std::filesystem::path& file, double scale,
                                 MeshAxes axes = MeshAxes::kXForwardZUp);

/// A primitive in one colour: a buoy's yellow, or concrete where it is larger than ten metres; edges sharper than 35
/// degrees stay sharp.
[[nodiscard]] MeshData draw_primitive(const Primitive& primitive);

/// What to draw for a body: its primitive, or the file that drawn_mesh_file finds.
/// @param mesh_file  as on the wire (shapes/mesh_name.hpp)
/// @throws GraphicsError saying what is missing or cannot be read
[[nodiscard]] MeshData load_body_mesh(const std::filesystem::path& folder, const std::string& mesh_file, double scale);

/// The file to draw for a body's mesh: `X.obj` in place of `X_hull.obj` if that exists, looked for in `folder`.
/// Empty if there is neither. Only the last part of `mesh_file` counts, wherever the server keeps it.
[[nodiscard]] std::filesystem::path drawn_mesh_file(const std::filesystem::path& folder, const std::string& mesh_file);

/// A mesh on the graphics card.
class Mesh {
 public:
  explicit Mesh(const MeshData& data);
  void draw() const;
  [[nodiscard]] const Eigen::Vector3f& low() const { return low_; }
  [[nodiscard]] const Eigen::Vector3f& high() const { return high_; }

 private:
  Buffer vertices_, indices_;
  VertexArray array_;
  GLsizei count_;
  Eigen::Vector3f low_, high_;
};

}  // namespace pelagos
