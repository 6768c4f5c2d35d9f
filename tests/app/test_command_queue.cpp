#include "command_queue.hpp"

#include "run_clock.hpp"

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
  EXPECT_EQ(taken[0].given.source, "a");
  EXPECT_EQ(std::get<StepSimulation>(taken[1].given.command).steps, 3U);
  EXPECT_TRUE(std::holds_alternative<ResumeSimulation>(taken[2].given.command));
  queue.take(0.0, taken);
  EXPECT_TRUE(taken.empty());
}

TEST(CommandQueue, TellsThoseWhoWaitWhenItCloses) {
  CommandQueue queue;
  std::vector<CommandAnswer> answers;
  EXPECT_FALSE(queue.submit(PauseSimulation{}, "a", [&](const CommandAnswer& answer) { answers.push_back(answer); }));
  queue.close("the server is stopping");
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_EQ(answers[0].refusal->what, "the server is stopping");
  EXPECT_EQ(queue.submit(PauseSimulation{}, "a").value().what, "the server is stopping");
}

TEST(RunClock, StepsOnlyWhilePaused) {
  using State = RunClock::State;
  RunClock clock;
  EXPECT_EQ(clock.apply(StepSimulation{}).refusal->what, "the simulation is running; pause it before stepping");
  EXPECT_FALSE(clock.apply(ResumeSimulation{}).changed);
  EXPECT_TRUE(clock.apply(PauseSimulation{}).changed);
  EXPECT_FALSE(clock.apply(PauseSimulation{}).changed);
  EXPECT_EQ(clock.state(), State::kPaused);
  EXPECT_TRUE(clock.apply(StepSimulation{2}).changed);
  EXPECT_EQ(clock.state(), State::kStepping);
  clock.count_step();
  EXPECT_EQ(clock.state(), State::kStepping);
  clock.count_step();
  EXPECT_EQ(clock.state(), State::kPaused);
  EXPECT_FALSE(clock.apply(StepSimulation{5}).refusal);
  EXPECT_TRUE(clock.apply(ResumeSimulation{}).changed);
  clock.count_step();
  EXPECT_EQ(clock.state(), State::kRunning);
}

TEST(CommandQueue, IsBounded) {
  CommandQueue queue;
  int accepted = 0;
  while (accepted < 100000 && !queue.submit(PauseSimulation{}, "flood")) ++accepted;
  EXPECT_LE(accepted, 1000);
}

}  // namespace
}  // namespace pelagos
