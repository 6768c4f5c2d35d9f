#pragma once

#include <cstddef>
#include <vector>

#include "physics/task_pool.hpp"

namespace pelagos {

/// Particles in one block of pointwise work.
inline constexpr std::size_t kPointBlock = 2048;

/// Calls f(i) for i = 0 .. count - 1.
template <class F>
void for_each_entry(TaskPool& pool, std::size_t count, F&& f) {
  pool.for_each_range(count, kPointBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) f(i);
  });
}

/// Sum of f(begin, end) over blocks, added in their order: the same bits for any number of threads.
template <class F>
auto sum_blocks(TaskPool& pool, std::size_t count, F&& f) {
  using Sum = decltype(f(count, count));
  std::vector<Sum> partial((count + kPointBlock - 1) / kPointBlock);
  pool.for_each_range(count, kPointBlock,
                      [&](std::size_t begin, std::size_t end) { partial[begin / kPointBlock] = f(begin, end); });
  Sum total{};
  for (const Sum& sum : partial) total += sum;
  return total;
}

}  // namespace pelagos
