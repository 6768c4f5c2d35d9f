#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <vector>

#include "physics/task_pool.hpp"

namespace pelagos::test {
namespace {

class TaskPoolThreads : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Counts, TaskPoolThreads, testing::Values(1, 2, 7));

TEST_P(TaskPoolThreads, RunsEveryBlockOnce) {
  TaskPool pool(GetParam());
  EXPECT_EQ(pool.thread_count(), GetParam());
  for (const std::size_t blocks : {0U, 1U, 2U, 3U, 6U, 7U, 8U, 1000U}) {
    std::vector<std::atomic<int>> runs(blocks);
    pool.for_each_block(blocks, [&](std::size_t block) { ++runs[block]; });
    for (std::size_t block = 0; block < blocks; ++block) ASSERT_EQ(runs[block], 1) << block << " of " << blocks;
  }
}

TEST_P(TaskPoolThreads, RangesCoverTheCountWithoutOverlap) {
  TaskPool pool(GetParam());
  for (const std::size_t count : {0U, 1U, 15U, 16U, 17U, 1000U}) {
    std::vector<int> touched(count, 0);  // each entry belongs to one block: no atomics needed, which is the point
    pool.for_each_range(count, 16, [&](std::size_t begin, std::size_t end) {
      ASSERT_LE(end, count);
      ASSERT_EQ(begin % 16, 0U);
      for (std::size_t i = begin; i < end; ++i) ++touched[i];
    });
    for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(touched[i], 1) << i << " of " << count;
  }
}

TEST_P(TaskPoolThreads, ResultsOfALoopAreVisibleToTheNext) {
  TaskPool pool(GetParam());
  // Many small loops, each reading what its neighbours wrote in the one before: a lost wake-up hangs here (and meets
  // the test's time limit), a missing barrier gives a wrong sum.
  constexpr std::size_t kBlocks = 8;
  std::vector<std::uint64_t> from(kBlocks, 1), to(kBlocks, 0);
  for (int loop = 0; loop < 1000; ++loop) {
    pool.for_each_block(kBlocks, [&](std::size_t b) { to[b] = from[(b + 1) % kBlocks] + 1; });
    from.swap(to);
  }
  for (const std::uint64_t value : from) ASSERT_EQ(value, 1001U);
}

TEST_P(TaskPoolThreads, StartsAndStopsWithoutWork) {
  for (int round = 0; round < 50; ++round) TaskPool pool(GetParam());
}

}  // namespace
}  // namespace pelagos::test
