#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "gltf_accessor.hpp"
#include "import_fault.hpp"
#include "readers.hpp"
#include "text_lines.hpp"

namespace pelagos {

namespace {

using Json = nlohmann::json;

/// Numbers of a list. @throws ImportFault if there are not `count`
std::vector<double> numbers_of(const Json& object, const char* key, std::size_t count, const std::string& where) {
  const Json& list = list_of(object, key, where);
  std::vector<double> numbers;
  for (const Json& entry : list)
    if (entry.is_number()) numbers.push_back(entry.get<double>());
  if (numbers.size() != count || list.size() != count)
    throw ImportFault(where + "." + key + " must be a list of " + std::to_string(count) + " numbers");
  return numbers;
}

/// A node's own transform: a matrix in columns, or scale, then rotation, then translation.
Eigen::Affine3d transform_of(const Json& node, const std::string& where) {
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  if (node.contains("matrix")) {
    const auto m = numbers_of(node, "matrix", 16, where);
    for (Eigen::Index column = 0; column < 4; ++column)
      for (Eigen::Index row = 0; row < 3; ++row)
        transform.matrix()(row, column) = m[static_cast<std::size_t>(4 * column + row)];
    return transform;
  }
  if (node.contains("translation")) {
    const auto t = numbers_of(node, "translation", 3, where);
    transform.translate(Eigen::Vector3d(t[0], t[1], t[2]));
  }
  if (node.contains("rotation")) {
    const auto r = numbers_of(node, "rotation", 4, where);
    Eigen::Quaterniond turn(r[3], r[0], r[1], r[2]);
    if (!(turn.norm() > 1e-6)) throw ImportFault(where + ".rotation is no rotation: all its numbers are 0");
    transform.rotate(turn.normalized());
  }
  if (node.contains("scale")) {
    const auto s = numbers_of(node, "scale", 3, where);
    transform.scale(Eigen::Vector3d(s[0], s[1], s[2]));
  }
  return transform;
}

/// `node "deck"`, or `node 3` as the file counts where it has no name.
std::string name_of(const char* kind, const Json& object, std::size_t index) {
  const auto name = object.find("name");
  const bool named = name != object.end() && name->is_string() && !name->get_ref<const std::string&>().empty();
  return std::string(kind) + " " + (named ? in_quotes(name->get_ref<const std::string&>()) : std::to_string(index));
}

/// How the indices of a primitive make triangles (section 3.7.2.1).
enum Mode : std::size_t { kTriangles = 4, kStrip = 5, kFan = 6 };

std::size_t triangles_in(std::size_t mode, std::size_t indices) {
  if (mode == kTriangles) return indices / 3;
  return indices < 3 ? 0 : indices - 2;
}

std::array<std::size_t, 3> triangle_at(std::size_t mode, std::size_t n) {
  if (mode == kTriangles) return {3 * n, 3 * n + 1, 3 * n + 2};
  if (mode == kStrip) return {n, n + 1 + n % 2, n + 2 - n % 2};
  return {n + 1, n + 2, 0};
}

class GltfReader {
 public:
  GltfReader(MeshFolder& folder, const ImportOptions& options, MeshBuilder& mesh)
      : document_(folder), with_materials_(options.materials), mesh_(mesh) {}

  void read() {
    if (document_.uses("EXT_mesh_gpu_instancing"))
      mesh_.add_note("the copies that EXT_mesh_gpu_instancing makes are not read; save the mesh without instancing");
    std::vector<Waiting> waiting;
    for (const std::size_t root : roots()) waiting.push_back({root, 1, Eigen::Affine3d::Identity()});
    std::reverse(waiting.begin(), waiting.end());
    std::vector<char> seen(document_.count("nodes"), 0);
    while (!waiting.empty()) {  // no recursion: the depth is the file's
      const Waiting next = waiting.back();
      waiting.pop_back();
      const Json& node = document_.item("nodes", next.node);
      const std::string name = name_of("node", node, next.node);
      if (seen[next.node]++ != 0)
        throw ImportFault(name +
                          " has several parents or is its own; allowed in glTF: one parent for each node. Copy it");
      if (next.depth > MeshLimits::kNodeDepth)
        throw ImportFault(name + " lies below more than " + std::to_string(MeshLimits::kNodeDepth) + " others");
      const Eigen::Affine3d placed = next.above * transform_of(node, place_of("nodes", next.node));
      if (const auto mesh = index_of(node, "mesh", place_of("nodes", next.node))) add_mesh(*mesh, name, placed);
      const Json& children = list_of(node, "children", place_of("nodes", next.node));
      for (auto child = children.rbegin(); child != children.rend(); ++child)
        waiting.push_back({node_number(*child, place_of("nodes", next.node) + ".children"), next.depth + 1, placed});
    }
  }

 private:
  struct Waiting {
    std::size_t node, depth;
    Eigen::Affine3d above;
  };

  [[nodiscard]] std::size_t node_number(const Json& entry, const std::string& where) const {
    const std::size_t nodes = document_.count("nodes");
    if (!entry.is_number_unsigned() || entry.get<std::uint64_t>() >= nodes)
      throw ImportFault(where + " names node " + shown(entry.dump()) + ", but the file has " + std::to_string(nodes));
    return entry.get<std::size_t>();
  }

  /// The nodes at the top of the scene that the file shows; without any scene, all that are below no other.
  [[nodiscard]] std::vector<std::size_t> roots() const {
    std::vector<std::size_t> list;
    const std::size_t nodes = document_.count("nodes");
    if (document_.count("scenes") > 0) {
      const std::size_t scene = whole_number(document_.root(), "scene", "the file", 0);
      const std::string where = place_of("scenes", scene);
      for (const Json& node : list_of(document_.item("scenes", scene), "nodes", where))
        list.push_back(node_number(node, where + ".nodes"));
      return list;
    }
    std::vector<char> is_child(nodes, 0);
    for (std::size_t n = 0; n < nodes; ++n)
      for (const Json& child : list_of(document_.item("nodes", n), "children", place_of("nodes", n)))
        is_child[node_number(child, place_of("nodes", n) + ".children")] = 1;
    for (std::size_t n = 0; n < nodes; ++n)
      if (is_child[n] == 0) list.push_back(n);
    return list;
  }

  void add_mesh(std::size_t index, const std::string& node, const Eigen::Affine3d& placed) {
    const Json& mesh = document_.item("meshes", index);
    const std::string where = place_of("meshes", index);
    const Json& primitives = list_of(mesh, "primitives", where);
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      const std::string primitive_where = where + "." + place_of("primitives", p);
      if (!primitives[p].is_object()) throw ImportFault(primitive_where + " is no object");
      std::string name = name_of("mesh", mesh, index) + " at " + node;
      if (primitives.size() > 1) name += ", primitive " + std::to_string(p);
      add_primitive(primitives[p], primitive_where, name, node, placed);
    }
  }

  void add_primitive(const Json& primitive, const std::string& where, const std::string& name, const std::string& node,
                     const Eigen::Affine3d& placed) {
    const std::size_t mode = whole_number(primitive, "mode", where, kTriangles);
    if (mode < kTriangles) return;  // points and lines
    if (mode > kFan) throw ImportFault(where + ".mode is " + std::to_string(mode) + "; allowed: 0 to 6");
    const auto attributes = primitive.find("attributes");
    if (attributes == primitive.end() || !attributes->is_object()) throw ImportFault(where + ".attributes is missing");
    const GltfAccessor positions(document_, whole_number(*attributes, "POSITION", where + ".attributes"), "VEC3");
    const double determinant = placed.linear().determinant();
    if (!placed.matrix().allFinite() || determinant == 0.0)
      throw ImportFault(node + " has a scale of 0 or a transform that is not finite: its triangles have no area");
    const std::vector<std::uint32_t> indices = indices_of(primitive, where, mode, positions.count());
    if (triangles_in(mode, indices.size()) == 0) return;
    const std::vector<std::uint32_t> renamed = add_vertices(positions, indices, where, placed);
    TriangleTags tags{mesh_.part(name, "triangle"), 0, material_of(primitive, where)};
    for (std::size_t t = 0; t < triangles_in(mode, indices.size()); ++t) {
      const auto [a, b, c] = triangle_at(mode, t);
      tags.place = static_cast<std::uint32_t>(t + 1);
      if (determinant < 0.0)  // a mirror image has its corners the other way round
        mesh_.add_triangle({renamed[a], renamed[c], renamed[b]}, tags);
      else
        mesh_.add_triangle({renamed[a], renamed[b], renamed[c]}, tags);
    }
  }

  /// Its indices, or those that it has without: each vertex once.
  std::vector<std::uint32_t> indices_of(const Json& primitive, const std::string& where, std::size_t mode,
                                        std::size_t vertices) {
    const auto accessor = index_of(primitive, "indices", where);
    if (!accessor) {
      mesh_.expect(0, triangles_in(mode, vertices));
      std::vector<std::uint32_t> indices(vertices);
      std::iota(indices.begin(), indices.end(), 0u);
      return indices;
    }
    const GltfAccessor given(document_, *accessor, "SCALAR");
    if (!given.is_whole()) throw ImportFault(where + ".indices are no whole numbers");
    mesh_.expect(0, triangles_in(mode, given.count()));
    std::vector<std::uint32_t> indices(given.count());
    for (std::size_t n = 0; n < indices.size(); ++n) {
      const double index = given.number(n, 0);
      if (!(index >= 0.0) || !(index < static_cast<double>(vertices)))
        throw ImportFault(where + ".indices name vertex " + std::to_string(static_cast<long long>(index)) + " of " +
                          std::to_string(vertices));
      indices[n] = static_cast<std::uint32_t>(index);
    }
    return indices;
  }

  /// Adds the vertices that the indices name, and no others: many primitives may share one long list.
  /// @return the vertex of each index
  std::vector<std::uint32_t> add_vertices(const GltfAccessor& positions, const std::vector<std::uint32_t>& indices,
                                          const std::string& where, const Eigen::Affine3d& placed) {
    std::vector<std::uint32_t> used = indices;
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    const auto first = static_cast<std::uint32_t>(mesh_.vertices());
    mesh_.expect(used.size(), 0);
    for (const std::uint32_t v : used) {
      const Eigen::Vector3d point =
          placed * Eigen::Vector3d(positions.number(v, 0), positions.number(v, 1), positions.number(v, 2));
      if (!point.allFinite()) throw ImportFault(where + ": vertex " + std::to_string(v) + " is not at a finite place");
      mesh_.add_vertex(point);
    }
    std::vector<std::uint32_t> renamed;
    renamed.reserve(indices.size());
    for (const std::uint32_t index : indices)
      renamed.push_back(first +
                        static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), index) - used.begin()));
    return renamed;
  }

  [[nodiscard]] std::uint32_t material_of(const Json& primitive, const std::string& where) {
    const auto index = with_materials_ ? index_of(primitive, "material", where) : std::nullopt;
    if (!index) return 0;
    const Json& material = document_.item("materials", *index);
    const std::string name = name_of("material", material, *index) + " " + std::to_string(*index);
    const std::uint32_t number = mesh_.material(name);
    std::array<float, 3> colour{1.0F, 1.0F, 1.0F};
    const auto surface = material.find("pbrMetallicRoughness");
    if (surface != material.end() && surface->is_object() && surface->contains("baseColorFactor")) {
      const auto given = numbers_of(*surface, "baseColorFactor", 4, place_of("materials", *index));
      for (std::size_t c = 0; c < 3; ++c) colour[c] = static_cast<float>(given[c]);
    }
    mesh_.find_material(name)->colour = colour;
    return number;
  }

  GltfDocument document_;
  bool with_materials_;
  MeshBuilder& mesh_;
};

}  // namespace

void read_gltf(MeshFolder& folder, const ImportOptions& options, MeshBuilder& mesh) {
  GltfReader(folder, options, mesh).read();
}

}  // namespace pelagos
