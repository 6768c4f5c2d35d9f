#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pelagos {

/// Hands out the slots of a neighbour list to threads. Each share of the work has a piece of consecutive slots of its
/// own and takes the next piece when that is used up. So what one thread writes and later reads lies together: lists in
/// which two threads take turns every few kilobytes are read at half the speed.
class SlotClaims {
 public:
  /// @param shares    parts of the work, as many as threads
  /// @param capacity  slots that the list has; pieces are a small part of it
  SlotClaims(std::size_t shares, std::uint64_t capacity)
      : pieces_(shares), piece_size_(std::clamp<std::uint64_t>(capacity / (16 * shares), kSmallest, kLargest)) {}

  /// The first of `count` consecutive slots. Calls may come from any thread.
  std::uint64_t claim(std::size_t share, std::uint64_t count) {
    std::atomic<std::uint64_t>& piece = pieces_[share].range;
    std::uint64_t range = piece.load(std::memory_order_relaxed);
    while (next_of(range) + count <= end_of(range))
      if (piece.compare_exchange_weak(range, range + count, std::memory_order_relaxed)) return next_of(range);
    const std::uint64_t first = claim_apart(std::max(count, piece_size_));
    // Where another thread has renewed the piece meanwhile, the rest of this one stays unused.
    piece.compare_exchange_strong(range, pack(first + count, first + std::max(count, piece_size_)),
                                  std::memory_order_relaxed);
    return first;
  }
  /// The same, from no share's piece.
  std::uint64_t claim_apart(std::uint64_t count) { return next_.fetch_add(count, std::memory_order_relaxed); }

  /// Slots up to the end of the last piece.
  [[nodiscard]] std::uint64_t claimed() const { return next_.load(); }

 private:
  static constexpr std::uint64_t kSmallest = 512, kLargest = 16384;
  static constexpr int kHalf = 32;

  struct alignas(64) Piece {
    std::atomic<std::uint64_t> range{0};  ///< the piece's end and the next free slot, 32 bits each
  };
  static std::uint64_t next_of(std::uint64_t range) { return range & 0xFFFFFFFFU; }
  static std::uint64_t end_of(std::uint64_t range) { return range >> kHalf; }
  static std::uint64_t pack(std::uint64_t next, std::uint64_t end) { return (end << kHalf) | next; }

  std::vector<Piece> pieces_;
  std::uint64_t piece_size_;
  std::atomic<std::uint64_t> next_{0};
};

}  // namespace pelagos
