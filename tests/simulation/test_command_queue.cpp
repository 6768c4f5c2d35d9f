#include "command_queue.hpp"

#include <gtest/gtest.h>

namespace pelagos {
namespace {

TEST(CommandQueue, KeepsTheOrderOfArrival) {
  CommandQueue queue;
  EXPECT_FALSE(queue.submit(PauseSimulation{}, "a"));
  EXPECT_FALSE(queue.submit(StepSimulation{3}, "b"));
  EXPECT_FALSE(queue.submit(ResumeSimulation{}, "c"));
  std::vector<QueuedCommand> taken;
  queue.take(0.0, taken);
  ASSERT_EQ(taken.size(), 3U);
  EXPECT_EQ(taken[0].source, "a");
  EXPECT_EQ(std::get<StepSimulation>(taken[1].command).steps, 3U);
  EXPECT_TRUE(std::holds_alternative<ResumeSimulation>(taken[2].command));
  queue.take(0.0, taken);
  EXPECT_TRUE(taken.empty());
}

TEST(CommandQueue, RefusesSingleStepsWhileRunning) {
  CommandQueue queue;
  EXPECT_TRUE(queue.submit(StepSimulation{}, "a"));
  EXPECT_FALSE(queue.submit(PauseSimulation{}, "a"));
  EXPECT_FALSE(queue.submit(StepSimulation{}, "a"));  // the pause waits in the queue before it
  EXPECT_FALSE(queue.submit(ResumeSimulation{}, "a"));
  EXPECT_TRUE(queue.submit(StepSimulation{}, "a"));
}

TEST(CommandQueue, IsBounded) {
  CommandQueue queue;
  int accepted = 0;
  while (accepted < 100000 && !queue.submit(PauseSimulation{}, "flood")) ++accepted;
  EXPECT_LE(accepted, 1000);
}

}  // namespace
}  // namespace pelagos
