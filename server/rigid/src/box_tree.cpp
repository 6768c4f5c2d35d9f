#include "box_tree.hpp"

namespace pelagos {

BoxTree::BoxTree(std::span<const Eigen::AlignedBox3d> boxes) {
  std::vector<Eigen::Vector3d> centres;
  centres.reserve(boxes.size());
  for (const Eigen::AlignedBox3d& box : boxes) centres.emplace_back(box.center());
  nodes_ = build_box_nodes(boxes, centres, numbers_);
}

}  // namespace pelagos
