#include "box_tree.hpp"

#include <algorithm>
#include <numeric>

namespace pelagos {

namespace {

constexpr std::uint32_t kLeaf = 4;

}  // namespace

BoxTree::BoxTree(std::span<const Eigen::AlignedBox3d> boxes) : numbers_(boxes.size()) {
  std::iota(numbers_.begin(), numbers_.end(), 0u);
  nodes_.emplace_back();
  build(0, 0, static_cast<std::uint32_t>(boxes.size()), boxes);
}

void BoxTree::build(std::uint32_t node, std::uint32_t begin, std::uint32_t end,
                    std::span<const Eigen::AlignedBox3d> boxes) {
  Eigen::AlignedBox3d box, centres;
  for (std::uint32_t n = begin; n < end; ++n) {
    box.extend(boxes[numbers_[n]]);
    centres.extend(boxes[numbers_[n]].center());
  }
  nodes_[node].box = box;
  if (end - begin <= kLeaf) {
    nodes_[node].first = begin;
    nodes_[node].count = end - begin;
    return;
  }
  Eigen::Index axis = 0;
  centres.sizes().maxCoeff(&axis);
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(numbers_.begin() + begin, numbers_.begin() + middle, numbers_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double za = boxes[a].center()[axis], zb = boxes[b].center()[axis];
                     return za != zb ? za < zb : a < b;
                   });
  const auto child = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].first = child;
  nodes_.resize(nodes_.size() + 2);
  build(child, begin, middle, boxes);
  build(child + 1, middle, end, boxes);
}

}  // namespace pelagos
