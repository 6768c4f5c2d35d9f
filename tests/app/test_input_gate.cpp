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

/// What a gate answers before its first boundary: "" where the command waits.
std::string answer_of(InputGate& gate, const Command& command) {
  std::optional<CommandAnswer> news;
  if (auto refusal = gate.submit(command, "a", [&](const CommandAnswer& answer) { news = answer; }))
    return to_string(*refusal);
  if (!news) return "no answer";
  return news->refusal ? to_string(*news->refusal) : "";
}

TEST(InputGate, RefusesAtOnceToRemoveWhatWillNotBeThereAtTheFirstBoundary) {
  Scene scene = pool_of_water();
  scene.oil.emplace().model = OilModel::kSlick;
  scene.probes.push_back({});
  scene.probes.back().id = 4;
  scene.events.push_back({0.0, OilCommand{SetBoom{"north", {{1, 1}, {3, 3}}}}});
  scene.events.push_back({5.0, OilCommand{SetBoom{"later", {{1, 1}, {3, 3}}}}});
  InputGate gate(scene, std::nullopt);
  EXPECT_EQ(answer_of(gate, OilCommand{RemoveBoom{"nrth"}}),
            "name: there is no boom \"nrth\"; did you mean \"north\"? allowed: \"north\"");
  EXPECT_EQ(answer_of(gate, OilCommand{RemoveBoom{"later"}}), "name: there is no boom \"later\"; allowed: \"north\"");
  EXPECT_EQ(answer_of(gate, OilCommand{RemoveSkimmer{"rig"}}), "name: there is no skimmer \"rig\", nor any other");
  EXPECT_EQ(answer_of(gate, OilCommand{StopRelease{"hose"}}), "name: there is no source \"hose\", nor any other");
  EXPECT_EQ(answer_of(gate, RemoveProbe{1}), "id: there is no probe 1; allowed: 4");
  EXPECT_EQ(gate.scheduled_count(), 2u) << "the scene's own";
  EXPECT_EQ(answer_of(gate, RemoveProbe{4}), "");
  EXPECT_EQ(answer_of(gate, RemoveProbe{4}), "id: there is no probe 4, nor any other") << "it will be gone by then";
  EXPECT_EQ(answer_of(gate, OilCommand{RemoveBoom{"north"}}), "");
  EXPECT_EQ(answer_of(gate, OilCommand{SetSkimmer{"rig", {2, 2}, 1.0, 10.0}}), "");
  EXPECT_EQ(answer_of(gate, OilCommand{RemoveSkimmer{"rig"}}), "") << "it waits for the same boundary";
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
