#include "mesh_builder.hpp"

#include <algorithm>
#include <bit>

#include "import_fault.hpp"
#include "polygon.hpp"

namespace pelagos {

namespace {

constexpr std::uint64_t kMostWork = 40'000'000;  ///< comparisons, about half a second
constexpr std::uint32_t kNone = ~std::uint32_t{0};
constexpr std::array<float, 3> kGrey{0.5F, 0.5F, 0.5F};

std::size_t hash_of(const Eigen::Vector3d& point) {
  std::uint64_t hash = 1469598103934665603u;
  for (const double c : {point.x(), point.y(), point.z()}) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(c + 0.0)) * 0x9e3779b97f4a7c15u;  // -0 is 0
    hash ^= hash >> 32;
  }
  return hash;
}

void check(std::size_t count, std::size_t most, const std::string& what) {
  if (count > most)
    throw ImportFault("more than " + std::to_string(most) + " " + what + "; reduce the mesh in the modelling program");
}

}  // namespace

void check_triangles(std::size_t count) { check(count, MeshLimits::kTriangles, "triangles"); }
void check_vertices(std::size_t count) { check(count, MeshLimits::kVertices, "vertices"); }

void check_corners(std::size_t count, const std::string& name) {
  if (count > MeshLimits::kCorners)
    throw ImportFault(name + " has " + std::to_string(count) + " corners; allowed: up to " +
                      std::to_string(MeshLimits::kCorners) + ". Cut it into triangles in the modelling program");
}

MeshBuilder::MeshBuilder() { mesh_.materials.push_back({"", kGrey}); }

std::uint32_t MeshBuilder::part(const std::string& name, const std::string& place) {
  const auto [known, is_new] = parts_.try_emplace(name, static_cast<std::uint32_t>(mesh_.parts.size()));
  if (is_new) {
    mesh_.parts.push_back({name, place});
    check(mesh_.parts.size(), MeshLimits::kParts, "objects, groups or solids with triangles");
  }
  return known->second;
}

std::uint32_t MeshBuilder::material(const std::string& name) {
  const auto [known, is_new] = materials_.try_emplace(name, static_cast<std::uint32_t>(mesh_.materials.size()));
  if (is_new) {
    mesh_.materials.push_back({name, kGrey});
    check(mesh_.materials.size(), MeshLimits::kMaterials, "materials");
  }
  return known->second;
}

ImportedMaterial* MeshBuilder::find_material(const std::string& name) {
  const auto known = materials_.find(name);
  return known == materials_.end() ? nullptr : &mesh_.materials[known->second];
}

void MeshBuilder::add_vertex(const Eigen::Vector3d& vertex) {
  check_vertices(mesh_.vertices.size() + 1);
  mesh_.vertices.push_back(vertex);
}

std::size_t MeshBuilder::place_of(const Eigen::Vector3d& vertex) const {
  std::size_t place = hash_of(vertex) & (shared_.size() - 1);
  while (shared_[place] != kNone && mesh_.vertices[shared_[place]] != vertex)
    place = (place + 1) & (shared_.size() - 1);
  return place;
}

std::uint32_t MeshBuilder::shared_vertex(const Eigen::Vector3d& vertex) {
  if (2 * (shared_count_ + 1) > shared_.size()) {
    std::vector<std::uint32_t> old(std::max<std::size_t>(2 * shared_.size(), 1024), kNone);
    old.swap(shared_);
    for (const std::uint32_t known : old)
      if (known != kNone) shared_[place_of(mesh_.vertices[known])] = known;
  }
  std::uint32_t& place = shared_[place_of(vertex)];
  if (place == kNone) {
    place = static_cast<std::uint32_t>(mesh_.vertices.size());
    add_vertex(vertex);
    ++shared_count_;
  }
  return place;
}

void MeshBuilder::expect(std::size_t vertices, std::size_t triangles) {
  check_vertices(mesh_.vertices.size() + vertices);
  check_triangles(mesh_.triangles.size() + triangles);
  if (mesh_.vertices.empty()) mesh_.vertices.reserve(vertices);
  if (mesh_.triangles.empty()) mesh_.triangles.reserve(triangles);
}

void MeshBuilder::add_triangle(const std::array<std::uint32_t, 3>& corners, const TriangleTags& tags) {
  const auto& [a, b, c] = corners;
  if (a == b || b == c || c == a) return;
  check_triangles(mesh_.triangles.size() + 1);
  mesh_.triangles.push_back({corners, tags.part, tags.place, tags.material});
}

void MeshBuilder::make_ring(std::span<const std::uint32_t> corners) {
  const auto same = [this](std::uint32_t a, std::uint32_t b) { return mesh_.vertices[a] == mesh_.vertices[b]; };
  ring_.clear();
  for (const std::uint32_t corner : corners) {
    if (!ring_.empty() && same(ring_.back(), corner)) continue;
    if (ring_.size() > 1 && same(ring_[ring_.size() - 2], corner))
      ring_.pop_back();  // there and back again
    else
      ring_.push_back(corner);
  }
  std::size_t start = 0, end = ring_.size();  // the same where it closes
  while (end - start > 1) {
    if (same(ring_[start], ring_[end - 1])) {
      --end;
    } else if (end - start > 2 && same(ring_[start + 1], ring_[end - 1])) {
      ++start;
    } else if (end - start > 2 && same(ring_[start], ring_[end - 2])) {
      --end;
    } else {
      break;
    }
  }
  ring_.resize(end);
  ring_.erase(ring_.begin(), ring_.begin() + static_cast<std::ptrdiff_t>(start));
}

void MeshBuilder::add_polygon(std::span<const std::uint32_t> corners, const TriangleTags& tags,
                              const std::string& name) {
  check_corners(corners.size(), name);
  make_ring(corners);
  if (ring_.size() < 3) return;
  points_.clear();
  for (const std::uint32_t corner : ring_) points_.push_back(mesh_.vertices[corner]);
  cut_.clear();
  if (!cut_polygon(points_, cut_, work_))
    throw ImportFault(name + " crosses itself as seen from its front; cut it into triangles in the modelling program");
  if (work_ > kMostWork)
    throw ImportFault("its polygons have too many concave corners to be cut into triangles here, up to " + name +
                      "; cut them in the modelling program");
  for (const auto& [a, b, c] : cut_) add_triangle({ring_[a], ring_[b], ring_[c]}, tags);
}

}  // namespace pelagos
