#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "rigid/box_nodes.hpp"

namespace pelagos {

/// A tree of bounding boxes over numbered boxes, to find those that meet something.
class BoxTree {
 public:
  explicit BoxTree(std::span<const Eigen::AlignedBox3d> boxes);

  /// Calls visit(number) for the boxes that may meet what is asked for; the order is fixed.
  /// @param meets  of a box: whether it may meet it. Boxes are asked from the largest to the smallest
  template <class Meets, class Visit>
  void for_each(Meets&& meets, Visit&& visit) const {
    std::vector<std::uint32_t> stack;
    if (!numbers_.empty()) stack.push_back(0);
    while (!stack.empty()) {
      const BoxNode& node = nodes_[stack.back()];
      stack.pop_back();
      if (!meets(node.box)) continue;
      for (std::uint32_t n = node.first; n < node.first + node.count; ++n) visit(numbers_[n]);
      if (node.count > 0) continue;
      stack.push_back(node.first + 1);
      stack.push_back(node.first);
    }
  }

 private:
  std::vector<BoxNode> nodes_;
  std::vector<std::uint32_t> numbers_;
};

}  // namespace pelagos
