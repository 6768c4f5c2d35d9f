#include "input_gate.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace pelagos {
namespace {

Scene pool_of_water() {
  Scene scene;
  scene.patch = {{0, 0, 0}, {4, 4, 2}};
  return scene;
}

TEST(InputGate, SchedulesForTheFirstBoundaryWhatComesBeforeIt) {
  InputGate gate(pool_of_water(), std::nullopt);
  std::vector<CommandAnswer> answers;
  const auto note = [&](const CommandAnswer& answer) { answers.push_back(answer); };
  EXPECT_FALSE(gate.submit(PauseSimulation{}, "a", note));
  ASSERT_EQ(answers.size(), 1u) << "answered at once";
  EXPECT_EQ(answers[0].scheduled_id, 1u);
  EXPECT_FALSE(answers[0].refusal);
  EXPECT_EQ(gate.scheduled().at(0).at, 0.0);
  InputGate::Batch batch;
  gate.collect(0, 0.0, batch);
  ASSERT_EQ(batch.inputs.commands.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<PauseSimulation>(batch.inputs.commands[0].command));
  EXPECT_EQ(batch.inputs.commands[0].source, "a");
  EXPECT_FALSE(batch.answers[0]) << "it has its answer";
  EXPECT_FALSE(gate.submit(ResumeSimulation{}, "a", note));
  EXPECT_EQ(answers.size(), 1u) << "from now on answers come from the boundary";
  gate.collect(0, 0.0, batch);
  ASSERT_EQ(batch.answers.size(), 1u);
  EXPECT_TRUE(batch.answers[0]);
}

TEST(InputGate, RefusesAtOnceWhatDoesNotFitTheSceneBeforeTheFirstBoundary) {
  InputGate gate(pool_of_water(), std::nullopt);
  ProbeSettings probe;
  probe.id = 1;
  probe.position = {9, 1, 0};
  std::vector<CommandAnswer> answers;
  EXPECT_FALSE(gate.submit(SetProbe{probe}, "a", [&](const CommandAnswer& answer) { answers.push_back(answer); }));
  ASSERT_EQ(answers.size(), 1u);
  ASSERT_TRUE(answers[0].refusal);
  EXPECT_EQ(answers[0].refusal->field, "position");
  EXPECT_EQ(gate.scheduled_count(), 0u);
}

TEST(InputGate, IsBoundedBeforeTheFirstBoundary) {
  InputGate gate(pool_of_water(), std::nullopt);
  std::size_t taken = 0;
  while (taken < 100000 && !gate.submit(PauseSimulation{}, "flood")) ++taken;
  EXPECT_EQ(taken, CommandQueue::kMostScheduled);
  ASSERT_TRUE(gate.submit(PauseSimulation{}, "flood"));
}

}  // namespace
}  // namespace pelagos
