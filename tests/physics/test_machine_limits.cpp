#include "physics/machine_limits.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace pelagos::test {
namespace {

TEST(MachineLimits, ReadsEveryValueOnce) {
  TaskPool pool(2);
  for (const std::size_t count : {0U, 1U, 77U, 65536U, 200001U})
    EXPECT_EQ(read_all(pool, std::vector<float>(count, 1.0F)), static_cast<float>(count));
}

TEST(MachineLimits, GathersTheRecordOfEverySlot) {
  constexpr std::uint32_t kGroups = 40, kSlots = 3;
  NeighborList list;
  for (std::uint32_t g = 0; g < kGroups; ++g) list.groups.push_back({g * kSlots, (g + 1) * kSlots});
  std::vector<Float4> records;
  for (int k = 0; k < 8; ++k) records.push_back({1, 2, 3, static_cast<float>(k)});
  float expected = 0.0F;
  for (std::size_t s = 0; s < kGroups * kSlots * kLanes; ++s) {
    const auto k = static_cast<std::int32_t>(s * 5 % 8);
    list.slots.push_back(k);
    expected += 6.0F + static_cast<float>(k);
  }
  TaskPool pool(2);
  EXPECT_EQ(gather_all(pool, list, records.data()), expected);
}

TEST(MachineLimits, CountsItsMultiplyAdds) {
  TaskPool pool(2);
  const double one = multiply_add_operations(1, 1);
  EXPECT_GE(one, 32.0);  // 16 chains of one lane at least, two operations each
  EXPECT_EQ(multiply_add_operations(3, 7), 21.0 * one);
  // x <- x / 2 + t tends to 2 t in every lane of the 16 chains; t = 1e-3 in block 0.
  EXPECT_NEAR(multiply_add(pool, 1, 100), 2e-3F * static_cast<float>(one / 2.0), 1e-4F);
}

}  // namespace
}  // namespace pelagos::test
