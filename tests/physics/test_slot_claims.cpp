#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "physics/task_pool.hpp"
#include "slot_claims.hpp"

namespace pelagos {
namespace {

struct Range {
  std::uint64_t first, count;
};

TEST(SlotClaims, NeverOverlap) {
  TaskPool pool(4);
  SlotClaims claims(3, 100000);
  std::vector<Range> ranges(5000);
  pool.for_each_range(ranges.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint64_t count = 1 + k % 70;
      ranges[k] = {claims.claim(k % 3, count), count};
    }
  });
  std::sort(ranges.begin(), ranges.end(), [](const Range& a, const Range& b) { return a.first < b.first; });
  for (std::size_t k = 1; k < ranges.size(); ++k)
    ASSERT_LE(ranges[k - 1].first + ranges[k - 1].count, ranges[k].first) << k;
  EXPECT_LE(ranges.back().first + ranges.back().count, claims.claimed());
}

TEST(SlotClaims, OfOneShareLieTogether) {
  SlotClaims claims(2, 64000);
  std::uint64_t next = claims.claim(0, 40);
  for (int k = 0; k < 10; ++k) {
    EXPECT_EQ(claims.claim(0, 40), next + 40);
    next += 40;
    static_cast<void>(claims.claim(1, 44));
  }
}

TEST(SlotClaims, TakeMoreThanAPieceAtOnce) {
  SlotClaims claims(1, 0);
  const std::uint64_t first = claims.claim(0, 100000);
  EXPECT_GE(claims.claim(0, 1), first + 100000);
  EXPECT_GE(claims.claimed(), first + 100001);
}

TEST(SlotClaims, LeaveLittleUnused) {
  constexpr std::uint64_t kSlots = 200000;
  SlotClaims claims(2, kSlots);
  std::uint64_t used = 0;
  for (std::size_t k = 0; used < kSlots; ++k, used += 44) static_cast<void>(claims.claim(k % 2, 44));
  EXPECT_LT(claims.claimed(), used + used / 8);
}

}  // namespace
}  // namespace pelagos
