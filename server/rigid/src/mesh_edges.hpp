#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shapes/triangle_mesh.hpp"

namespace pelagos {

/// One triangle's use of an edge: from its lower to its higher vertex (along), or back.
struct EdgeUse {
  std::uint32_t low = 0, high = 0, triangle = 0;
  bool along = true;
};

/// The uses of all edges, sorted by edge and then by triangle. Triangles that have a vertex twice have no edges here:
/// their neighbours meet where they are.
[[nodiscard]] std::vector<EdgeUse> collect_edges(const TriangleMesh& mesh);

/// Calls visit(span of EdgeUse) once for each edge, with all its uses.
template <class Visit>
void for_each_edge(std::span<const EdgeUse> uses, Visit&& visit) {
  for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
    while (end < uses.size() && uses[end].low == uses[begin].low && uses[end].high == uses[begin].high) ++end;
    visit(uses.subspan(begin, end - begin));
  }
}

/// How many of the uses run along the edge; the others run back.
[[nodiscard]] std::size_t count_along(std::span<const EdgeUse> uses);

/// Two triangles that go on into each other at an edge.
struct EdgePair {
  std::uint32_t a = 0, b = 0;
  bool agree = true;  ///< they face the same way
};

/// Which triangles are joined at edges. Where an edge has two triangles, they are. Where it has more, as where parts
/// touch that were merged, as many along as back, each along is joined to one back. Any choice makes closed parts; this
/// one makes parts whose own edges have two triangles: in the order of the mesh, which keeps parts apart that stand one
/// after another; if some part then still has an edge with more, by the angles round the edge, where each triangle at
/// which the solid begins is joined to one at which it ends. Other edges join nothing.
[[nodiscard]] std::vector<EdgePair> pair_triangles(const TriangleMesh& mesh, std::span<const EdgeUse> uses);

/// The connected parts of a mesh, numbered in the order of their first triangles.
struct MeshShells {
  std::vector<std::uint32_t> of;     ///< [triangles] number of its shell
  std::vector<std::uint32_t> first;  ///< [shells] first triangle
};
[[nodiscard]] MeshShells find_shells(std::size_t triangles, std::span<const EdgePair> pairs);

}  // namespace pelagos
