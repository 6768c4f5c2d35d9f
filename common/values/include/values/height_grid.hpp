#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pelagos {

/// Heights at the nodes of an even grid over an area of the world.
struct HeightGrid {
  double x = 0.0, y = 0.0;    ///< m, world: of the first node
  double cell = 1.0;          ///< m, between nodes
  int columns = 0, rows = 0;  ///< nodes along x, along y
  std::vector<float> height;  ///< m, world z; [y][x]

  [[nodiscard]] bool empty() const { return height.empty(); }
  [[nodiscard]] double node_x(std::size_t index) const {
    return x + cell * static_cast<double>(index % static_cast<std::size_t>(columns));
  }
  [[nodiscard]] double node_y(std::size_t index) const {
    return y + cell * static_cast<double>(index / static_cast<std::size_t>(columns));
  }
  /// m, bilinear between nodes; beyond them as at the nearest place of the grid.
  [[nodiscard]] double at(double place_x, double place_y) const {
    const auto step = [this](double way, int nodes, std::size_t& node) {
      const double part = std::clamp(way / cell, 0.0, static_cast<double>(nodes - 1));
      node = std::min(static_cast<std::size_t>(part), static_cast<std::size_t>(std::max(nodes - 2, 0)));
      return part - static_cast<double>(node);
    };
    std::size_t i = 0, j = 0;
    const double a = step(place_x - x, columns, i), b = step(place_y - y, rows, j);
    const auto node = [&](std::size_t right, std::size_t up) {
      const std::size_t column = std::min(i + right, static_cast<std::size_t>(columns - 1));
      const std::size_t row = std::min(j + up, static_cast<std::size_t>(rows - 1));
      return static_cast<double>(height[row * static_cast<std::size_t>(columns) + column]);
    };
    return (1.0 - b) * ((1.0 - a) * node(0, 0) + a * node(1, 0)) + b * ((1.0 - a) * node(0, 1) + a * node(1, 1));
  }
};

}  // namespace pelagos
