#include "flat_triangles.hpp"

#include <Eigen/Geometry>
#include <unordered_map>

namespace pelagos {

namespace {

using Corners = std::array<std::uint32_t, 3>;

/// A way along an edge, as one number.
std::uint64_t way(std::uint32_t from, std::uint32_t to) { return static_cast<std::uint64_t>(from) << 32 | to; }

/// The triangle with its longest edge first, so that the third corner lies between the others.
Corners with_longest_first(const TriangleMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  const auto length = [&](std::uint32_t p, std::uint32_t q) {
    return (mesh.vertices[p] - mesh.vertices[q]).squaredNorm();
  };
  if (length(b, c) >= length(a, b) && length(b, c) >= length(c, a)) return {b, c, a};
  if (length(c, a) >= length(a, b)) return {c, a, b};
  return {a, b, c};
}

class Mender {
 public:
  Mender(TriangleMesh& mesh, MeshOrigin& origin) : mesh_(mesh), origin_(origin) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& vertex : mesh.vertices) box.extend(vertex);
    least_ = kLeastArea * box.sizes().squaredNorm();
  }

  void run() {
    constexpr int kPasses = 16;  // a row of vertices on one edge takes several
    for (int pass = 0; pass < kPasses; ++pass) {
      const std::vector<std::uint32_t> flat = find_flat();
      if (flat.empty()) return;
      find_neighbors(flat);
      bool mended = false;
      for (const std::uint32_t t : flat) mended = mend(t) || mended;
      if (!mended) return;
    }
  }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0}, kSeveral = kNone - 1;

  [[nodiscard]] std::vector<std::uint32_t> find_flat() const {
    std::vector<std::uint32_t> flat;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      if (!(mesh_.area_vector(t).norm() > least_)) flat.push_back(t);
    return flat;
  }

  /// Which triangle runs back along the longest edge of each flat one.
  void find_neighbors(const std::vector<std::uint32_t>& flat) {
    neighbor_.clear();
    for (const std::uint32_t t : flat) {
      const auto [a, b, between] = with_longest_first(mesh_, t);
      neighbor_.emplace(way(b, a), kNone);
    }
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      for (std::size_t c = 0; c < 3; ++c) {
        const auto found = neighbor_.find(way(mesh_.triangles[t][c], mesh_.triangles[t][(c + 1) % 3]));
        if (found != neighbor_.end()) found->second = found->second == kNone ? t : kSeveral;
      }
  }

  /// Turns the edge that a flat triangle shares with its neighbour, so that it leads to the corner between.
  bool mend(std::uint32_t t) {
    if (mesh_.area_vector(t).norm() > least_) return false;  // mended with another
    const auto [a, b, between] = with_longest_first(mesh_, t);
    const auto known = neighbor_.find(way(b, a));
    if (known == neighbor_.end() || known->second >= kSeveral || known->second == t) return false;
    Corners& other = mesh_.triangles[known->second];
    std::size_t c = 0;
    while (c < 3 && !(other[c] == b && other[(c + 1) % 3] == a)) ++c;
    if (c == 3) return false;  // changed in this pass: seen again in the next
    const std::uint32_t across = other[(c + 2) % 3];
    if (across == between) return false;
    other = {between, a, across};
    mesh_.triangles[t] = {between, across, b};
    if (t < origin_.part.size()) {
      origin_.part[t] = origin_.part[known->second];
      origin_.place[t] = origin_.place[known->second];
    }
    return true;
  }

  TriangleMesh& mesh_;
  MeshOrigin& origin_;
  double least_ = 0.0;
  std::unordered_map<std::uint64_t, std::uint32_t> neighbor_;
};

}  // namespace

void mend_flat_triangles(TriangleMesh& mesh, MeshOrigin& origin) { Mender(mesh, origin).run(); }

}  // namespace pelagos
