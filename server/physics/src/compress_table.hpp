#pragma once

#include <array>
#include <cstdint>

namespace pelagos {

/// For each mask of eight lanes, the lanes that are set, in order, then the rest: a permutation that packs them.
/// (The library's own table is rebuilt on the stack at every call by this compiler: 20 times slower.)
constexpr std::array<std::array<std::int32_t, 8>, 256> make_compress_table() {
  std::array<std::array<std::int32_t, 8>, 256> table{};
  for (unsigned mask = 0; mask < 256; ++mask) {
    std::size_t next = 0;
    for (int lane = 0; lane < 8; ++lane)
      if ((mask >> lane & 1U) != 0) table[mask][next++] = lane;
    for (int lane = 0; lane < 8; ++lane)
      if ((mask >> lane & 1U) == 0) table[mask][next++] = lane;
  }
  return table;
}
alignas(64) inline constexpr std::array<std::array<std::int32_t, 8>, 256> kCompressTable = make_compress_table();

}  // namespace pelagos
