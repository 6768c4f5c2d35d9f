#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "oil/slick_element.hpp"

namespace pelagos {

/// Elements hashed by cells of the plane, for finding those near a place. Memory goes with the elements, not with the
/// area, so that slicks far apart cost nothing. Cells are as wide as a typical element's reach.
class ElementGrid {
 public:
  struct Entry {
    double x, y, size;
    std::int32_t cell_x, cell_y;
    std::uint32_t element;
  };

  /// Positions must be finite and within 1e8 m of the origin.
  void build(std::span<const SlickElement> elements);

  /// Calls visit(entry) for every element within the square of half-width `reach` around the place, and for some
  /// outside; each once, in an order that depends on the elements alone.
  template <typename Visit>
  void for_each_near(double x, double y, double reach, const Visit& visit) const {
    const std::int32_t x0 = cell_of(x - reach), x1 = cell_of(x + reach);
    const std::int32_t y0 = cell_of(y - reach), y1 = cell_of(y + reach);
    const auto cells = (static_cast<double>(x1) - x0 + 1.0) * (static_cast<double>(y1) - y0 + 1.0);
    if (cells > static_cast<double>(entries_.size())) {
      for (const Entry& entry : entries_) visit(entry);
      return;
    }
    for (std::int32_t cy = y0; cy <= y1; ++cy)
      for (std::int32_t cx = x0; cx <= x1; ++cx) {
        const std::uint32_t bucket = bucket_of(cx, cy);
        for (std::uint32_t k = start_[bucket]; k < start_[bucket + 1]; ++k)
          if (entries_[k].cell_x == cx && entries_[k].cell_y == cy) visit(entries_[k]);
      }
  }

  /// The elements in the order of the grid: close ones mostly close together.
  [[nodiscard]] std::span<const Entry> entries() const { return entries_; }

 private:
  [[nodiscard]] std::int32_t cell_of(double coordinate) const;
  [[nodiscard]] std::uint32_t bucket_of(std::int32_t cell_x, std::int32_t cell_y) const;

  double inverse_cell_ = 1.0;
  std::uint32_t mask_ = 0;
  std::vector<std::uint32_t> start_, next_;  ///< of each bucket; next_ is scratch
  std::vector<Entry> unsorted_, entries_;
};

}  // namespace pelagos
