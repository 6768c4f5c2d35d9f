#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "physics/particles.hpp"

namespace pelagos {

// The parts of a stable counting sort of points by cell, each for one chunk of points or one block of cells.

/// What a cell's number follows from: cells run fastest along x, then y; points outside count to the nearest edge cell,
/// NaN counts to the first.
struct CellFrame {
  float origin[3];  ///< m
  float inverse_cell_size;
  int dims[3];
};

/// Cells [first, last).
struct CellRange {
  std::size_t first = 0, last = 0;
};

/// Cells of one block of the prefix sum.
inline constexpr std::size_t kCellBlock = 2048;

/// Points [first, last) of the sort.
struct SortChunk {
  std::size_t first = 0, last = 0;
  CellRange cells;                     ///< that the points lie in: few where the points are nearly sorted
  std::uint32_t* histogram = nullptr;  ///< [all cells] of use in `cells`: points a cell, then where the next one goes
};

/// key[i] = cell of points[i] for the chunk's points; sets chunk.cells.
void find_cells(const CellFrame& frame, std::span<const Float4> points, SortChunk& chunk, std::span<std::uint32_t> key);

/// Fills the chunk's histogram.
void count_points(std::span<const std::uint32_t> key, const SortChunk& chunk);

/// count[cell] = points of all chunks in each cell of `block`. Returns their sum.
std::uint32_t add_histograms(std::span<const SortChunk> chunks, const CellRange& block, std::span<std::uint32_t> count);

/// Turns counts into where each cell of `block` begins, the first at `begin_of_block`, and each chunk's counts into
/// where its first point of a cell goes: behind those of the chunks before it.
/// @param block  at most kCellBlock cells
void place_cells(std::span<const SortChunk> chunks, const CellRange& block, std::uint32_t begin_of_block,
                 std::span<std::uint32_t> begin);

/// order[place] = i for the chunk's points.
void write_order(std::span<const std::uint32_t> key, const SortChunk& chunk, std::span<std::uint32_t> order);

}  // namespace pelagos
