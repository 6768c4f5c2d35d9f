#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

namespace pelagos {

/// A node of a tree of bounding boxes. A leaf where count > 0: items first .. first + count - 1 of the tree's order;
/// else children first and first + 1.
struct BoxNode {
  Eigen::AlignedBox3d box;
  std::uint32_t first = 0, count = 0;
};

/// A tree over items with a box and a centre each (any point, by which they are halved along the axis on which the
/// centres spread most). The root is node 0; leaves hold at most four items. The same items give the same tree.
/// @param order  out, [items] the items as the leaves number them
[[nodiscard]] std::vector<BoxNode> build_box_nodes(std::span<const Eigen::AlignedBox3d> boxes,
                                                   std::span<const Eigen::Vector3d> centres,
                                                   std::vector<std::uint32_t>& order);

}  // namespace pelagos
