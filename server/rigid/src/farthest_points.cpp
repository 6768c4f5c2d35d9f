#include "farthest_points.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>

namespace pelagos {

namespace {

/// Points sorted into cells, so that those near a place are found without looking at all.
class PointGrid {
 public:
  PointGrid(std::span<const Eigen::Vector3d> points, double cell) : points_(points) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& point : points) box.extend(point);
    low_ = box.min();
    // Not many more cells than points, however thin the cloud.
    const double fewest = std::cbrt(box.volume() / (4.0 * static_cast<double>(points.size()) + 64.0));
    const double longest = box.sizes().maxCoeff() / 2000.0;
    cell_ = std::max({cell, fewest, longest});
    std::size_t cells = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      count_[axis] = static_cast<std::size_t>(box.sizes()[static_cast<Eigen::Index>(axis)] / cell_) + 1;
      cells *= count_[axis];
    }
    begin_.assign(cells + 1, 0);
    for (const Eigen::Vector3d& point : points) ++begin_[index_of(cell_of(point)) + 1];
    for (std::size_t c = 0; c < cells; ++c) begin_[c + 1] += begin_[c];
    member_.resize(points.size());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t p = 0; p < points.size(); ++p) member_[next[index_of(cell_of(points[p]))]++] = p;
  }

  template <class Visit>
  void for_each_near(const Eigen::Vector3d& place, double radius, Visit&& visit) const {
    const auto low = cell_of(place.array() - radius), high = cell_of(place.array() + radius);
    for (std::size_t z = low[2]; z <= high[2]; ++z)
      for (std::size_t y = low[1]; y <= high[1]; ++y) {
        const std::size_t first = begin_[index_of({low[0], y, z})], last = begin_[index_of({high[0], y, z}) + 1];
        for (std::size_t m = first; m < last; ++m) visit(member_[m]);
      }
  }

 private:
  using Cell = std::array<std::size_t, 3>;
  [[nodiscard]] Cell cell_of(const Eigen::Vector3d& point) const {
    Cell cell{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<Eigen::Index>(axis);
      cell[axis] = static_cast<std::size_t>(
          std::clamp((point[a] - low_[a]) / cell_, 0.0, static_cast<double>(count_[axis] - 1)));
    }
    return cell;
  }
  [[nodiscard]] std::size_t index_of(const Cell& cell) const {
    return (cell[2] * count_[1] + cell[1]) * count_[0] + cell[0];
  }

  std::span<const Eigen::Vector3d> points_;
  Eigen::Vector3d low_;
  double cell_ = 1.0;
  Cell count_{};
  std::vector<std::size_t> begin_, member_;
};

struct Entry {
  double squared_distance;
  std::size_t point;
  bool operator<(const Entry& other) const {
    return squared_distance != other.squared_distance ? squared_distance < other.squared_distance : point > other.point;
  }
};

}  // namespace

std::vector<std::size_t> select_farthest_points(std::span<const Eigen::Vector3d> points, double least_distance) {
  std::vector<std::size_t> chosen;
  if (points.empty()) return chosen;
  const PointGrid grid(points, least_distance);
  std::vector<double> nearest(points.size(), std::numeric_limits<double>::infinity());  // squared, to the chosen ones
  std::priority_queue<Entry> queue;  // an entry that no longer agrees with `nearest` is out of date
  const double least_squared = least_distance * least_distance;

  std::size_t next = 0;
  double radius = std::numeric_limits<double>::infinity();  // nothing farther away can change
  for (;;) {
    chosen.push_back(next);
    const Eigen::Vector3d place = points[next];
    const auto update = [&](std::size_t p) {
      const double squared = (points[p] - place).squaredNorm();
      if (!(squared < nearest[p])) return;
      nearest[p] = squared;
      if (squared >= least_squared) queue.push({squared, p});
    };
    if (std::isinf(radius)) {
      for (std::size_t p = 0; p < points.size(); ++p) update(p);
    } else {
      grid.for_each_near(place, radius, update);
    }
    while (!queue.empty() && queue.top().squared_distance != nearest[queue.top().point]) queue.pop();
    if (queue.empty()) return chosen;
    next = queue.top().point;
    radius = std::sqrt(queue.top().squared_distance);
    queue.pop();
  }
}

}  // namespace pelagos
