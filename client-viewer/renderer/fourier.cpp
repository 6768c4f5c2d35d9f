#include "renderer/fourier.hpp"

#include <bit>
#include <cassert>
#include <cmath>
#include <numbers>

namespace pelagos {

FourierSquare::FourierSquare(std::size_t side)
    : side_(side), reversed_(side, 0), turns_(side / 2), real_(side * side), imaginary_(side * side) {
  assert(side >= 2 && std::has_single_bit(side));
  for (std::size_t row = 1; row < side; ++row) reversed_[row] = reversed_[row / 2] / 2 + (row % 2) * side / 2;
  for (std::size_t k = 0; k < turns_.size(); ++k) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(side);
    turns_[k] = {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
  }
}

void FourierSquare::sum(std::span<std::complex<float>> grid) {
  assert(grid.size() == side_ * side_);
  for (std::size_t row = 0; row < side_; ++row)
    for (std::size_t column = 0; column < side_; ++column) {
      const std::complex<float>& value = grid[row * side_ + column];
      real_[reversed_[row] * side_ + column] = value.real();
      imaginary_[reversed_[row] * side_ + column] = value.imag();
    }
  sum_columns();
  transpose();
  sum_columns();
  for (std::size_t row = 0; row < side_; ++row)
    for (std::size_t column = 0; column < side_; ++column)
      grid[row * side_ + column] = {real_[column * side_ + row], imaginary_[column * side_ + row]};
}

/// Cooley and Tukey (1965), radix 2; all columns side by side, so that the inner loop runs over a row.
void FourierSquare::sum_columns() {
  for (std::size_t half = 1; half < side_; half *= 2)
    for (std::size_t first = 0; first < side_; first += 2 * half)
      for (std::size_t k = 0; k < half; ++k) {
        const std::complex<float> turn = turns_[k * (side_ / (2 * half))];
        const float c = turn.real(), s = turn.imag();
        float* const low_re = &real_[(first + k) * side_];
        float* const low_im = &imaginary_[(first + k) * side_];
        float* const high_re = &real_[(first + k + half) * side_];
        float* const high_im = &imaginary_[(first + k + half) * side_];
        for (std::size_t x = 0; x < side_; ++x) {
          const float re = c * high_re[x] - s * high_im[x], im = c * high_im[x] + s * high_re[x];
          high_re[x] = low_re[x] - re;
          high_im[x] = low_im[x] - im;
          low_re[x] += re;
          low_im[x] += im;
        }
      }
}

/// Columns become rows, in the order that sum_columns() takes them.
void FourierSquare::transpose() {
  std::vector<float> re(real_.size()), im(imaginary_.size());
  for (std::size_t row = 0; row < side_; ++row)
    for (std::size_t column = 0; column < side_; ++column) {
      re[reversed_[column] * side_ + row] = real_[row * side_ + column];
      im[reversed_[column] * side_ + row] = imaginary_[row * side_ + column];
    }
  real_.swap(re);
  imaginary_.swap(im);
}

}  // namespace pelagos
