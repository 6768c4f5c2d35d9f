#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace pelagos {

/// The discrete Fourier sum of a square grid, without a factor:
///   out[y][x] = sum over v, u of in[v][u] exp(2 pi i (u x + v y) / side)
class FourierSquare {
 public:
  /// @param side  of the grid: a power of two, at least 2
  explicit FourierSquare(std::size_t side);

  /// In place. `grid` holds side * side values, row by row.
  void sum(std::span<std::complex<float>> grid);

 private:
  void sum_columns();
  void transpose();

  std::size_t side_;
  std::vector<std::size_t> reversed_;       ///< row numbers with their bits reversed
  std::vector<std::complex<float>> turns_;  ///< exp(2 pi i k / side), k < side / 2
  std::vector<float> real_, imaginary_;     ///< side * side
};

}  // namespace pelagos
