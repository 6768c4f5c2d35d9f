#include "rigid/box_nodes.hpp"

#include <algorithm>
#include <numeric>

namespace pelagos {

namespace {

constexpr std::uint32_t kLeaf = 4;

class Builder {
 public:
  Builder(std::span<const Eigen::AlignedBox3d> boxes, std::span<const Eigen::Vector3d> centres,
          std::vector<std::uint32_t>& order)
      : boxes_(boxes), centres_(centres), order_(order) {}

  std::vector<BoxNode> build() {
    nodes_.emplace_back();
    build(0, 0, static_cast<std::uint32_t>(order_.size()));
    return std::move(nodes_);
  }

 private:
  void build(std::uint32_t node, std::uint32_t begin, std::uint32_t end) {
    Eigen::AlignedBox3d box, centres;
    for (std::uint32_t n = begin; n < end; ++n) {
      box.extend(boxes_[order_[n]]);
      centres.extend(centres_[order_[n]]);
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
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) {
                       const double za = centres_[a][axis], zb = centres_[b][axis];
                       return za != zb ? za < zb : a < b;
                     });
    const auto child = static_cast<std::uint32_t>(nodes_.size());
    nodes_[node].first = child;
    nodes_.resize(nodes_.size() + 2);
    build(child, begin, middle);
    build(child + 1, middle, end);
  }

  std::span<const Eigen::AlignedBox3d> boxes_;
  std::span<const Eigen::Vector3d> centres_;
  std::vector<std::uint32_t>& order_;
  std::vector<BoxNode> nodes_;
};

}  // namespace

std::vector<BoxNode> build_box_nodes(std::span<const Eigen::AlignedBox3d> boxes,
                                     std::span<const Eigen::Vector3d> centres, std::vector<std::uint32_t>& order) {
  order.resize(boxes.size());
  std::iota(order.begin(), order.end(), 0u);
  return Builder(boxes, centres, order).build();
}

}  // namespace pelagos
