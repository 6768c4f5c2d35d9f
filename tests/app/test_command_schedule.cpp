// Commands that wait for their time.

#include <gmock/gmock.h>

#include "command_queue.hpp"
#include "describe_command.hpp"
#include "replay.hpp"

namespace pelagos {
namespace {

using testing::HasSubstr;

SetWind westerly(double speed) {
  SetWind set;
  set.wind.velocity = wind_velocity(speed, 270.0);
  return set;
}

std::vector<std::string> sources(CommandQueue& queue, double now) {
  std::vector<QueuedCommand> taken;
  queue.take(now, taken);
  std::vector<std::string> names;
  for (const QueuedCommand& command : taken) names.push_back(command.given.source);
  return names;
}

TEST(CommandSchedule, AppliesAtTheFirstBoundaryAtOrAfterTheTime) {
  CommandQueue queue;
  queue.schedule(ClearWind{}, 1.0, "a");
  EXPECT_THAT(sources(queue, 0.999), testing::IsEmpty());
  EXPECT_THAT(sources(queue, 1.0), testing::ElementsAre("a"));
  EXPECT_THAT(sources(queue, 2.0), testing::IsEmpty());
  queue.schedule(ClearWind{}, 3.0, "b");
  EXPECT_THAT(sources(queue, 3.7), testing::ElementsAre("b"));
}

TEST(CommandSchedule, OrdersByTimeThenAsGivenThenWhatWasSubmitted) {
  CommandQueue queue;
  queue.schedule(ClearWind{}, 2.0, "late");
  queue.schedule(ClearWind{}, 1.0, "first of two");
  queue.schedule(ClearWind{}, 1.0, "second of two");
  queue.submit(ClearWind{}, "now");
  EXPECT_THAT(sources(queue, 2.0), testing::ElementsAre("first of two", "second of two", "late", "now"));
}

TEST(CommandSchedule, NumbersTheEventsOfASceneAsWritten) {
  CommandQueue queue({{5.0, ClearWind{}}, {0.0, PauseSimulation{}}});
  EXPECT_EQ(queue.scheduled_count(), 2U);
  EXPECT_THAT(sources(queue, 0.0), testing::ElementsAre("scene event 2"));
  EXPECT_THAT(sources(queue, 5.0), testing::ElementsAre("scene event 1"));
}

TEST(CommandSchedule, LetsGoOfEventsWhoseEffectIsInAState) {
  CommandQueue queue({{1.0, ClearWind{}}, {2.0, ClearWind{}}, {3.0, ClearWind{}}});
  queue.schedule(ClearWind{}, 1.5, "station");
  queue.drop_events_until(2.0);
  EXPECT_THAT(sources(queue, 9.0), testing::ElementsAre("station", "scene event 3"));
}

TEST(CommandSchedule, RefusesWhatHasPassed) {
  CommandQueue queue;
  sources(queue, 10.0);
  const auto refused = queue.schedule(ClearWind{}, 9.999, "a");
  EXPECT_EQ(refused.id, 0U);
  EXPECT_TRUE(refused.past);
  EXPECT_EQ(refused.present_time, 10.0);
  EXPECT_GT(queue.schedule(ClearWind{}, 10.0, "a").id, 0U);
}

TEST(CommandSchedule, IsBounded) {
  CommandQueue queue({{1.0, ClearWind{}}});  // counts too
  std::vector<ScheduleChange> changes;
  for (std::size_t i = 1; i < CommandQueue::kMostScheduled; ++i) {
    EXPECT_GT(queue.schedule(ClearWind{}, 5.0, "a").id, 0U);
    queue.take_changes(changes);
  }
  const auto refused = queue.schedule(ClearWind{}, 5.0, "a");
  EXPECT_EQ(refused.id, 0U);
  EXPECT_THAT(refused.refusal.value().what, HasSubstr("1000"));
  EXPECT_TRUE(queue.cancel(1, "b"));
  EXPECT_GT(queue.schedule(ClearWind{}, 5.0, "a").id, 0U);
}

TEST(CommandSchedule, TellsOfEveryChange) {
  CommandQueue queue;
  const auto id = queue.schedule(westerly(5.0), 5.0, "a").id;
  EXPECT_FALSE(queue.cancel(id + 1, "b"));
  EXPECT_TRUE(queue.cancel(id, "b"));
  EXPECT_FALSE(queue.cancel(id, "b"));
  std::vector<ScheduleChange> changes;
  queue.take_changes(changes);
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_FALSE(changes[0].cancelled);
  EXPECT_EQ(changes[0].by, "a");
  EXPECT_TRUE(changes[1].cancelled);
  EXPECT_EQ(changes[1].by, "b");
  EXPECT_EQ(changes[1].command.id, id);
  EXPECT_THAT(sources(queue, 6.0), testing::IsEmpty());
}

TEST(DescribeCommand, SaysWhatAndHowMuch) {
  SetCurrent current;
  current.current.velocity = current_velocity(1.5, 90.0);
  current.current.shear = CurrentShear::kLinear;
  current.current.depth = 20.0;
  current.ramp_seconds = 60.0;
  EXPECT_EQ(describe_command(current).kind, "current");
  EXPECT_EQ(describe_command(current).text,
            "current 1.50 m/s to 90 deg, falling linearly to nothing 20 m down, over 60.0 s");
  EXPECT_EQ(describe_command(ClearWind{}).kind, "wind");
  EXPECT_EQ(describe_command(PauseSimulation{}).text, "paused");
}

CommandLog small_log() {
  CommandLog log;
  log.header = {"1", "avx2", "small_patch", 7, 100};
  log.commands = {{3, 0.1, "a", westerly(5.0)}, {3, 0.1, "b", PauseSimulation{}}, {9, 0.3, "c", ClearWind{}}};
  log.end = CommandLogEnd{12, 0xabcdU};
  return log;
}

TEST(Replay, GivesInputsAtTheirStepsAndDoesNotPause) {
  CommandLog log = small_log();
  BodyPose pose;
  pose.body = 4;
  log.poses = {{3, {pose, "bridge 7"}}, {8, {pose, "bridge 9"}}};
  Replay replay(log);
  StepInputs inputs;
  replay.take(2, inputs);
  EXPECT_TRUE(inputs.empty());
  replay.take(3, inputs);
  ASSERT_EQ(inputs.commands.size(), 1U);
  EXPECT_EQ(inputs.commands[0].source, "replay of a");
  ASSERT_EQ(inputs.poses.size(), 1U);
  EXPECT_EQ(inputs.poses[0].source, "replay of bridge 7");
  EXPECT_EQ(inputs.poses[0].pose.body, 4U);
  replay.take(9, inputs);
  ASSERT_EQ(inputs.commands.size(), 2U);  // appended
  EXPECT_TRUE(std::holds_alternative<ClearWind>(inputs.commands[1].command));
  EXPECT_EQ(inputs.poses.size(), 2U);
  EXPECT_FALSE(replay.ended(11));
  EXPECT_TRUE(replay.ended(12));
}

TEST(Replay, OfALogWithoutEndEndsWithIt) {
  CommandLog log = small_log();
  log.end.reset();
  log.commands.clear();
  log.poses.clear();
  log.checks = {{0, 0.0, 5}, {17, 1.0, 6}};
  const Replay replay(log);
  EXPECT_FALSE(replay.ended(16));
  EXPECT_TRUE(replay.ended(17));
  log.checks.clear();
  EXPECT_TRUE(Replay(log).ended(0));
}

TEST(Replay, HoldsStatesAgainstTheLog) {
  CommandLog log = small_log();
  log.checks = {{0, 0.0, 5}, {10, 1.0, 6}, {20, 2.0, 7}, {30, 3.0, 8}};
  Replay replay(log);
  EXPECT_THAT(replay.checks_text(), HasSubstr("no state"));
  EXPECT_EQ(replay.check(0, 5), "");
  EXPECT_FALSE(replay.check_due(9));
  EXPECT_EQ(replay.check(9, 1), "") << "the log says nothing of that step";
  EXPECT_EQ(replay.check(10, 6), "");
  EXPECT_EQ(replay.checks_text(), "whole states compared: 2, the same bits");
  EXPECT_THAT(replay.check(20, 99), HasSubstr("after step 20, at 2.000 s, is 0000000000000063"));
  EXPECT_EQ(replay.check(30, 98), "") << "told once";
  EXPECT_EQ(replay.checks_text(), "whole states compared: 4; the first that differs is that after step 20");
}

TEST(Replay, IsOfItsOwnSceneOnly) {
  const Replay replay(small_log());
  CommandLogHeader now = small_log().header;
  EXPECT_EQ(replay.mismatch(now), "");
  EXPECT_EQ(replay.doubt(now), "");
  now.instruction_set = "avx512";
  EXPECT_EQ(replay.mismatch(now), "");
  EXPECT_THAT(replay.doubt(now), HasSubstr("bits may differ"));
  now.seed = 8;
  EXPECT_THAT(replay.mismatch(now), HasSubstr("seed 8"));
}

TEST(Replay, TellsWhichPartsOfTheSceneDiffer) {
  CommandLog log = small_log();
  log.header.parts = {{"patch", 1}, {"solver", 2}, {"wind at the start", 3}};
  const Replay replay(log);
  CommandLogHeader now = log.header;
  EXPECT_EQ(replay.mismatch(now), "");
  now.parts["patch"] = 9;
  now.parts["wind at the start"] = 8;
  EXPECT_THAT(replay.mismatch(now), HasSubstr("differs in: patch, wind at the start; allowed: the scene as it was"));
  now.instruction_set = "avx512";
  EXPECT_EQ(replay.mismatch(now), "") << "it may have other parts of the same scene: doubt tells of it";
  now = log.header;
  now.parts.clear();
  now.parts["hull"] = 1;
  EXPECT_THAT(replay.mismatch(now), HasSubstr("differs in: patch, solver, wind at the start, hull;"));
  EXPECT_EQ(Replay(small_log()).mismatch(log.header), "") << "a log that tells no parts";
}

}  // namespace
}  // namespace pelagos
