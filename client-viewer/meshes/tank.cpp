#include "meshes/tank.hpp"

#include <algorithm>
#include <cmath>

#include "meshes/coloured_parts.hpp"

namespace pelagos {
namespace {

constexpr double kLargestGlass = 20.0;         // m, longer side
constexpr double kPlinth = 0.8, kSlab = 0.12;  // m
constexpr double kPane = 2.5;                  // m, between two posts
constexpr int kMostPanes = 40;                 // of a side
constexpr double kConcreteWall = 0.6;          // m
constexpr Colour kFloor = {0.40F, 0.45F, 0.47F}, kConcrete = {0.36F, 0.35F, 0.32F}, kGround = {0.20F, 0.20F, 0.19F},
                 kSteel = {0.16F, 0.17F, 0.18F};

void add_ground(const Eigen::Vector3d& size, double rim, ColouredParts& parts) {
  const double reach = std::max(60.0, 8.0 * size.head<2>().maxCoeff());
  parts.add_box({-reach, -reach, -kPlinth - 0.2}, {size.x() + reach, size.y() + reach, -kPlinth}, kGround);
  parts.add_box({-rim, -rim, -kPlinth}, {size.x() + rim, size.y() + rim, -kSlab}, kConcrete);
  parts.add_box({-rim, -rim, -kSlab}, {size.x() + rim, size.y() + rim, 0.0}, kFloor);
}

/// Posts along the sides that run along `axis`, and the bar above them.
void add_frame(const Eigen::Vector3d& size, double bar, int axis, ColouredParts& parts) {
  const int other = 1 - axis, panes = std::clamp(static_cast<int>(std::ceil(size[axis] / kPane)), 1, kMostPanes);
  for (const double across : {-bar, size[other]}) {
    Eigen::Vector3d low(0, 0, size.z() - bar), high(0, 0, size.z());
    low[axis] = -bar;
    high[axis] = size[axis] + bar;
    low[other] = across;
    high[other] = across + bar;
    parts.add_box(low, high, kSteel);
    for (int i = 0; i <= panes; ++i) {
      const double at = -bar + i * (size[axis] + bar) / panes;
      low[axis] = at;
      high[axis] = at + bar;
      low.z() = 0.0;
      high.z() = size.z() - bar;
      parts.add_box(low, high, kSteel);
    }
  }
}

void add_walls(const Eigen::Vector3d& size, double wall, ColouredParts& parts) {
  const double t = kConcreteWall;
  parts.add_box({-t, -t, 0}, {0, size.y() + t, wall}, kConcrete);
  parts.add_box({size.x(), -t, 0}, {size.x() + t, size.y() + t, wall}, kConcrete);
  parts.add_box({0, -t, 0}, {size.x(), 0, wall}, kConcrete);
  parts.add_box({0, size.y(), 0}, {size.x(), size.y() + t, wall}, kConcrete);
}

}  // namespace

bool has_glass_walls(const Eigen::Vector3d& size) { return size.head<2>().maxCoeff() <= kLargestGlass; }

MeshData draw_tank(const Eigen::Vector3d& size, double wall) {
  ColouredParts parts;
  if (has_glass_walls(size)) {
    const double bar = std::clamp(0.012 * size.maxCoeff(), 0.01, 0.12);
    add_ground(size, 4.0 * bar, parts);
    for (const int axis : {0, 1}) add_frame(size, bar, axis, parts);
  } else {
    add_ground(size, 2.0 * kConcreteWall, parts);
    add_walls(size, wall, parts);
  }
  return parts.done();
}

}  // namespace pelagos
