#include "meshes/mesh_data.hpp"

#include "meshes/quay.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesh_import/import_mesh.hpp"
#include "scales/angles.hpp"
#include "text/printable.hpp"

namespace pelagos {

namespace {

constexpr double kCreaseDegrees = 35.0;
// What is as large as a quay or a pier is built of concrete, what is smaller is a buoy or a crate.
constexpr Colour kMarkYellow{0.75F, 0.45F, 0.03F}, kConcrete{0.33F, 0.32F, 0.29F}, kGrey{0.5F, 0.5F, 0.5F};
constexpr double kLargestMark = 10.0;  // m

/// The triangles around each vertex, as one list for all.
struct Fans {
  std::vector<std::uint32_t> first;  ///< [vertices + 1]
  std::vector<std::uint32_t> triangle;
};

Fans fans_of(const TriangleMesh& mesh) {
  Fans fans;
  fans.first.assign(mesh.vertices.size() + 1, 0);
  for (const auto& corners : mesh.triangles)
    for (const std::uint32_t v : corners) ++fans.first[v + 1];
  std::partial_sum(fans.first.begin(), fans.first.end(), fans.first.begin());
  std::vector<std::uint32_t> next(fans.first.begin(), fans.first.end() - 1);
  fans.triangle.resize(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t]) fans.triangle[next[v]++] = static_cast<std::uint32_t>(t);
  return fans;
}

/// The mean normal of those around a vertex that make no sharp edge with one's own. A vertex of very many triangles, as
/// the middle of a fan, has the own one: comparing all with all takes too long.
Eigen::Vector3f normal_at(std::uint32_t vertex, const Eigen::Vector3d& own, const Fans& fans,
                          const std::vector<Eigen::Vector3d>& areas) {
  constexpr std::uint32_t kMostAround = 256;
  static const double least_cosine = std::cos(kCreaseDegrees * kRadiansPerDegree);
  const std::uint32_t begin = fans.first[vertex], end = fans.first[vertex + 1];
  if (end - begin > kMostAround) return own.cast<float>();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::uint32_t i = begin; i < end; ++i) {
    const Eigen::Vector3d& area = areas[fans.triangle[i]];
    if (own.dot(area) >= least_cosine * area.norm()) normal += area;
  }
  return normal.normalized().cast<float>();
}

/// Makes vertices at the same place one, so that normals run across the parts of a file.
void merge_equal(TriangleMesh& mesh) {
  std::vector<std::uint32_t> order(mesh.vertices.size()), same(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto place = [&](std::uint32_t v) {
    const Eigen::Vector3d& x = mesh.vertices[v];
    return std::array{x.x(), x.y(), x.z()};
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); });
  for (std::size_t i = 0; i < order.size(); ++i)
    same[order[i]] = i > 0 && place(order[i - 1]) == place(order[i]) ? same[order[i - 1]] : order[i];
  for (auto& corners : mesh.triangles)
    for (std::uint32_t& v : corners) v = same[v];
}

}  // namespace

MeshData shade(const TriangleMesh& mesh, std::span<const Colour> colour) {
  const Fans fans = fans_of(mesh);
  std::vector<Eigen::Vector3d> areas(mesh.triangles.size());
  for (std::size_t t = 0; t < areas.size(); ++t) areas[t] = mesh.area_vector(t);
  MeshData data;
  data.low.setConstant(std::numeric_limits<float>::max());
  data.high.setConstant(std::numeric_limits<float>::lowest());
  data.vertices.reserve(3 * areas.size());
  for (std::size_t t = 0; t < areas.size(); ++t) {
    const Eigen::Vector3d own = areas[t].normalized();
    const auto& [red, green, blue] = colour[colour.size() == 1 ? 0 : t];
    for (const std::uint32_t v : mesh.triangles[t]) {
      const Eigen::Vector3f p = mesh.vertices[v].cast<float>(), n = normal_at(v, own, fans, areas);
      data.vertices.push_back({{p.x(), p.y(), p.z()}, {n.x(), n.y(), n.z()}, {red, green, blue}});
      data.low = data.low.cwiseMin(p);
      data.high = data.high.cwiseMax(p);
    }
  }
  data.indices.resize(data.vertices.size());
  std::iota(data.indices.begin(), data.indices.end(), 0U);
  return data;
}

MeshData load_mesh(const std::filesystem::path& file, double scale, MeshAxes axes) {
  ImportOptions options;
  options.materials = true;
  ImportedMesh imported = import_mesh(file, options);
  const std::string name = "mesh " + printable(file.string());
  if (!imported.faults.empty()) throw MeshError(name + ": " + printable(to_string(imported.faults.front())));
  if (imported.triangles.empty()) throw MeshError(name + ": holds no triangles");
  TriangleMesh mesh;
  const Eigen::Matrix3d turn = scale * body_from_file(axes);
  mesh.vertices = std::move(imported.vertices);
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex = turn * vertex;
  std::vector<Colour> colours;
  for (const ImportedTriangle& triangle : imported.triangles) {
    mesh.triangles.push_back(triangle.corners);
    colours.push_back(imported.materials[triangle.material].colour);
  }
  merge_equal(mesh);
  return shade(mesh, colours);
}

MeshData draw_primitive(const Primitive& primitive) {
  if (const auto* box = std::get_if<BoxShape>(&primitive); box != nullptr && looks_like_quay(*box))
    return draw_quay(*box);
  const TriangleMesh mesh = make_mesh(primitive);
  double reach = 0.0;
  for (const Eigen::Vector3d& v : mesh.vertices) reach = std::max(reach, v.cwiseAbs().maxCoeff());
  const Colour colour = 2.0 * reach > kLargestMark ? kConcrete : kMarkYellow;
  return shade(mesh, std::span(&colour, 1));
}

MeshData draw_box(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  TriangleMesh mesh = make_mesh(BoxShape{(high - low).cwiseMax(1e-6)});
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex += 0.5 * (low + high);
  return shade(mesh, std::span(&kGrey, 1));
}

}  // namespace pelagos
