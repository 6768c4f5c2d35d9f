#include "polygon.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace pelagos {

namespace {

constexpr double kFlat = 1e-10;      ///< of the extent squared: a corner that turns by less is straight
constexpr double kTouching = 1e-12;  ///< of the extent squared: nearer to an edge than that is on it
/// Height of an ear over its longest edge: good ears first, slivers only where there is nothing else.
constexpr double kShapes[] = {1e-2, 1e-5, 0.0};

/// Newell's normal: twice the area that the polygon has as seen along each axis.
Eigen::Vector3d normal_of(std::span<const Eigen::Vector3d> corners) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t n = 0; n < corners.size(); ++n)
    normal += (corners[n] - corners[0]).cross(corners[(n + 1) % corners.size()] - corners[0]);
  return normal;
}

/// The polygon seen from its front, as a ring of corners from which ears are cut.
class Ring {
 public:
  Ring(std::span<const Eigen::Vector3d> corners, const Eigen::Vector3d& normal) {
    Eigen::Index axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    const Eigen::Index u = (axis + 1) % 3, v = (axis + 2) % 3;
    const bool turned = normal[axis] < 0.0;
    Eigen::Vector2d low(0, 0), high(0, 0);
    for (const Eigen::Vector3d& corner : corners) {
      const Eigen::Vector3d arm = corner - corners[0];
      point_.emplace_back(turned ? arm[v] : arm[u], turned ? arm[u] : arm[v]);
      low = low.cwiseMin(point_.back());
      high = high.cwiseMax(point_.back());
    }
    scale_ = (high - low).squaredNorm();
    const auto count = static_cast<std::uint32_t>(corners.size());
    for (std::uint32_t n = 0; n < count; ++n) {
      next_.push_back((n + 1) % count);
      previous_.push_back((n + count - 1) % count);
    }
    convex_.resize(count);
    for (std::uint32_t n = 0; n < count; ++n) {
      convex_[n] = turn(n) > kFlat * scale_;
      if (!convex_[n]) blocking_.push_back(n);
    }
  }

  [[nodiscard]] std::uint32_t next(std::uint32_t n) const { return next_[n]; }
  [[nodiscard]] std::uint32_t previous(std::uint32_t n) const { return previous_[n]; }
  [[nodiscard]] bool convex(std::uint32_t n) const { return convex_[n] != 0; }

  /// Whether the triangle of a corner and its neighbours can be cut off.
  [[nodiscard]] bool is_ear(std::uint32_t n, double shape, std::uint64_t& work) {
    if (!convex(n)) return false;
    const Eigen::Vector2d &a = point_[previous_[n]], &b = point_[n], &c = point_[next_[n]];
    const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    if (turn(n) <= shape * longest) return false;
    const double touching = -kTouching * scale_;
    for (std::size_t k = 0; k < blocking_.size();) {
      const std::uint32_t other = blocking_[k];
      if (other == kGone || convex(other)) {  // is blocking no more
        blocking_[k] = blocking_.back();
        blocking_.pop_back();
        continue;
      }
      ++k, ++work;
      const Eigen::Vector2d& p = point_[other];
      if (p == a || p == b || p == c) continue;
      if (cross(a, b, p) >= touching && cross(b, c, p) >= touching && cross(c, a, p) >= touching) return false;
    }
    return true;
  }

  void cut(std::uint32_t n) {
    const std::uint32_t before = previous_[n], after = next_[n];
    next_[before] = after;
    previous_[after] = before;
    convex_[n] = 1;  // blocks nothing any more
    for (const std::uint32_t corner : {before, after}) {
      const bool was = convex(corner);
      convex_[corner] = turn(corner) > kFlat * scale_;
      if (was && !convex(corner)) blocking_.push_back(corner);
    }
  }

 private:
  static constexpr std::uint32_t kGone = ~std::uint32_t{0};

  static double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
  }
  [[nodiscard]] double turn(std::uint32_t n) const { return cross(point_[previous_[n]], point_[n], point_[next_[n]]); }

  std::vector<Eigen::Vector2d> point_;
  double scale_ = 0.0;
  std::vector<std::uint32_t> next_, previous_;
  std::vector<char> convex_;
  std::vector<std::uint32_t> blocking_;  ///< concave and straight corners, and some that were
};

/// All triangles at one corner.
void fan(std::uint32_t count, std::uint32_t start, std::vector<std::array<std::uint32_t, 3>>& triangles) {
  for (std::uint32_t n = 1; n + 1 < count; ++n)
    triangles.push_back({start, (start + n) % count, (start + n + 1) % count});
}

bool cut_ears(Ring& ring, std::uint32_t count, std::vector<std::array<std::uint32_t, 3>>& triangles,
              std::uint64_t& work) {
  std::uint32_t corner = 0, left = count, tried = 0, since = 0;
  std::size_t shape = 0;
  while (left > 3) {
    if (ring.is_ear(corner, kShapes[shape], work)) {
      triangles.push_back({ring.previous(corner), corner, ring.next(corner)});
      ring.cut(corner);
      corner = ring.next(ring.next(corner));  // not the neighbour: that would make a fan of slivers
      --left;
      tried = 0;
      if (++since >= left / 2) shape = 0, since = 0;  // once round: the ring may have better ears again
    } else {
      corner = ring.next(corner);
      if (++tried < left) continue;
      tried = since = 0;
      if (++shape == std::size(kShapes)) return false;
    }
    ++work;
  }
  triangles.push_back({ring.previous(corner), corner, ring.next(corner)});
  return ring.convex(corner);
}

}  // namespace

bool cut_polygon(std::span<const Eigen::Vector3d> corners, std::vector<std::array<std::uint32_t, 3>>& triangles,
                 std::uint64_t& work) {
  const auto count = static_cast<std::uint32_t>(corners.size());
  double extent = 0.0;
  for (const Eigen::Vector3d& corner : corners) extent = std::max(extent, (corner - corners[0]).squaredNorm());
  const Eigen::Vector3d normal = normal_of(corners);
  if (count == 3 || !(normal.norm() > kFlat * extent)) {
    fan(count, 0, triangles);
    return true;
  }
  Ring ring(corners, normal);
  if (count == 4) {  // at most one corner is straight or concave, and the cut begins there
    std::uint32_t start = 0;
    while (start < 4 && ring.convex(start)) ++start;
    fan(4, start % 4, triangles);
    return true;
  }
  return cut_ears(ring, count, triangles, work);
}

}  // namespace pelagos
