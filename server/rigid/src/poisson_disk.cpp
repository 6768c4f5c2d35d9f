#include "poisson_disk.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "physics/boundary.hpp"
#include "waves/splitmix.hpp"

namespace pelagos {

namespace {

constexpr std::uint64_t kSeed = 2010;

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

/// A random order of so many points; the same one each time.
std::vector<std::uint32_t> shuffle(std::size_t count) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(count);
  SplitMix64 random(kSeed);
  for (std::size_t p = 0; p < count; ++p) keys[p] = {random.next(), static_cast<std::uint32_t>(p)};
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> order(count);
  std::transform(keys.begin(), keys.end(), order.begin(), [](const auto& key) { return key.second; });
  return order;
}

}  // namespace

std::vector<std::size_t> select_poisson_disk(std::span<const Eigen::Vector3d> points,
                                             std::span<const Eigen::Vector3d> sides, double least_distance) {
  std::vector<std::size_t> chosen;
  if (points.empty()) return chosen;
  const PointGrid grid(points, least_distance);
  std::vector<std::uint8_t> covered(points.size(), 0);
  const double least_squared = least_distance * least_distance;
  for (const std::uint32_t next : shuffle(points.size())) {
    if (covered[next] != 0) continue;
    chosen.push_back(next);
    grid.for_each_near(points[next], least_distance, [&](std::size_t p) {
      if ((points[p] - points[next]).squaredNorm() < least_squared && !are_opposed(sides[p], sides[next]))
        covered[p] = 1;
    });
  }
  return chosen;
}

}  // namespace pelagos
