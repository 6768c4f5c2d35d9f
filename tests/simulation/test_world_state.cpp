// The state of a world as one value: saved, loaded into a new world, gone on with to the same bytes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>
#include <span>
#include <string_view>

#include "fields/field_hash.hpp"
#include "floating.hpp"
#include "give.hpp"
#include "oily_patch.hpp"
#include "same_run.hpp"
#include "version/version.hpp"
#include "world_access.hpp"

namespace pelagos {

namespace {

using test::expect_same_run;
using test::floating_box;
using test::kAllSolvers;
using test::oily_patch;
using test::small_patch;
using ::testing::HasSubstr;

/// Three boxes one on another, which touch from the first step on, on the floor of a shallow patch.
Scene stack_of_boxes() {
  Scene scene = floating_box(0.5);
  scene.water.blocks = {{{0, 0, 0}, {3.2, 3.2, 0.5}}};
  scene.water.settle_steps = 20;
  scene.bodies.clear();
  for (std::uint32_t k = 0; k < 3; ++k) {
    BodySettings body;
    body.id = 9 - k;
    body.name = "box " + std::to_string(k);
    body.primitive = BoxShape{{0.6, 0.6, 0.4}};
    body.drive = BodyDrive::kFree;
    body.mass.density = 2000.0;
    body.position = {1.6 + 0.1 * k, 1.6, 0.201 + 0.4 * k};
    scene.bodies.push_back(body);
  }
  return scene;
}

WindSettings breeze(double speed) {
  WindSettings wind;
  wind.velocity = {speed, 0.5 * speed, 0.0};
  wind.amplitude = 2.0;
  wind.length = 3.0;
  return wind;
}

TEST(WorldState, GoesOnFromAFile) { expect_same_run(small_patch(), 7, 20); }

TEST(WorldState, GoesOnWithEverySolver) {
  for (const SolverKind solver : kAllSolvers) {
    SCOPED_TRACE(static_cast<int>(solver));
    Scene scene = small_patch();
    scene.solver = default_solver(solver);
    expect_same_run(scene, 5, 12);
  }
}

TEST(WorldState, GoesOnWithABodyAndEverySolver) {
  for (const SolverKind solver : kAllSolvers) {
    SCOPED_TRACE(static_cast<int>(solver));
    Scene scene = floating_box(0.5, solver);
    scene.water.settle_steps = 5;
    expect_same_run(scene, 5, 12);
  }
}

TEST(WorldState, GoesOnBetweenMirroredAndPeriodicFaces) {
  Scene scene = small_patch();
  scene.patch_edges = {PatchEdge::kPeriodic, PatchEdge::kMirror, PatchEdge::kMirror};
  expect_same_run(scene, 5, 12);
}

TEST(WorldState, GoesOnWithBodiesInContact) {
  const Scene scene = stack_of_boxes();
  World world(scene, {1, nullptr, {}});
  for (int n = 0; n < 30; ++n) world.advance();
  ASSERT_GE(world.state().bodies.contacts.pairs.size(), 3U) << "they touch";
  expect_same_run(scene, 30, 60);
}

TEST(WorldState, GoesOnWithARampingWind) {
  Scene scene = small_patch();
  scene.wind = breeze(3.0);
  expect_same_run(scene, 9, 25, [](World& world, std::uint64_t step) {
    if (step == 4) static_cast<void>(test::give(world, SetWind{breeze(12.0), 0.8}));
    if (step == 18) static_cast<void>(test::give(world, ClearWind{}));
  });
}

TEST(WorldState, GoesOnWithAnOilRelease) {
  const Scene scene = oily_patch(OilModel::kBoth);
  expect_same_run(scene, 15, 40, [](World& world, std::uint64_t step) {
    ReleaseOil release;
    release.name = "leak";
    release.from = release.to = {2.5, 2.0, 0.8};
    release.rate = 600.0;
    if (step == 2) {
      ASSERT_EQ(test::give(world, OilCommand(release)), std::nullopt);
    }
    SetBoom boom;
    boom.name = "z";
    boom.line = {{1.0, 1.0}, {1.0, 3.0}};
    if (step == 4) {
      ASSERT_EQ(test::give(world, OilCommand(boom)), std::nullopt);
    }
    boom.name = "a";
    boom.line = {{3.0, 1.0}, {3.5, 3.0}};
    if (step == 5) {
      ASSERT_EQ(test::give(world, OilCommand(boom)), std::nullopt);
    }
    if (step == 6) {
      ASSERT_EQ(test::give(world, OilCommand(SetSkimmer{"s", {2.5, 2.2}, 0.5, 20.0})), std::nullopt);
    }
    if (step == 7) {
      ASSERT_EQ(test::give(world, OilCommand(SpillOil{{2.0, 2.0}, 0.01, 0.3})), std::nullopt);
    }
  });
}

TEST(WorldState, GoesOnWithACurrentThatIsSlowedDown) {
  Scene scene = small_patch();
  scene.patch_edges[0] = PatchEdge::kPeriodic;
  scene.current.emplace();
  scene.current->velocity = {0.8, 0.3, 0.0};
  scene.current->relaxation = 0.5;
  expect_same_run(scene, 12, 30, [](World& world, std::uint64_t step) {
    if (step == 8) static_cast<void>(test::give(world, ClearCurrent{}));
  });
}

TEST(WorldState, GoesOnWithAShearedCurrent) {
  Scene scene = small_patch();
  scene.patch_edges[0] = PatchEdge::kPeriodic;
  scene.current.emplace();
  scene.current->velocity = {0.8, 0.0, 0.0};
  scene.current->shear = CurrentShear::kLinear;
  scene.current->depth = 1.0;
  expect_same_run(scene, 12, 30, [](World& world, std::uint64_t step) {
    if (step == 20) static_cast<void>(test::give(world, ClearCurrent{}));
  });
}

TEST(WorldState, GoesOnWithPosesProbesAndEffort) {
  Scene scene = floating_box(0.5);
  scene.bodies[0].drive = BodyDrive::kPoseHorizontal;
  scene.wind = breeze(5.0);
  expect_same_run(scene, 12, 24, [](World& world, std::uint64_t step) {
    BodyPose pose;
    pose.body = 1;
    pose.time = 100.0 + world.time();
    pose.position = {1.6 + 0.2 * world.time(), 1.6, 1.15};
    pose.velocity = {0.2, 0.0, 0.0};
    if (step % 5 == 1) test::give(world, pose);
    ProbeSettings probe;
    probe.id = 7;
    probe.position = {1.0, 1.0, 1.2};
    if (step == 3) {
      ASSERT_EQ(test::give(world, SetProbe{probe}), std::nullopt);
    }
    Effort effort = world.effort();
    effort.density_tolerance *= 2.0;
    if (step == 6) static_cast<void>(test::give(world, SetEffort{effort, ""}));
  });
}

/// A point of recovery is the whole state: what commands did since the last step stays, what the failed step did goes.
TEST(WorldState, IsWhatARestoredFaultGoesBackTo) {
  Scene scene = small_patch();
  scene.on_fault = FaultPolicy::kRestore;
  scene.wind = breeze(3.0);
  World world(scene, {1, nullptr, {}});
  for (int n = 0; n < 5; ++n) world.advance();
  ASSERT_EQ(test::give(world, SetWind{breeze(8.0), 2.0}), std::nullopt);
  const WorldState good = world.state();
  WorldTestAccess::fluid(world).particles.velocity[200].x = std::numeric_limits<float>::quiet_NaN();
  ASSERT_EQ(world.advance().fault, StepFault::kRestored);
  WorldState restored = world.state();
  EXPECT_EQ(restored.faults.in_row, 1);
  EXPECT_EQ(restored.faults.restored, 1U);
  EXPECT_EQ(restored.step, good.step + 1);
  restored.faults = good.faults;
  restored.step = good.step;
  const auto difference = find_difference(good, restored);
  EXPECT_FALSE(difference.has_value()) << difference->field;
}

TEST(WorldState, DifferencesNameTheField) {
  World one(small_patch(), {1, nullptr, {}}), other(small_patch(), {1, nullptr, {}});
  EXPECT_EQ(test::first_difference(one, other), "");
  EXPECT_EQ(hash_fields(one.state()), hash_fields(other.state()));
  static_cast<void>(test::give(other, SetWind{breeze(3.0), 0.0}));
  EXPECT_EQ(test::first_difference(one, other), "wind.size: 0 and 1");
  EXPECT_NE(hash_fields(one.state()), hash_fields(other.state()));
}

class StateFile : public ::testing::Test {
 protected:
  StateFile() : world_(oily_patch(OilModel::kBoth), {1, nullptr, {}}) {
    for (int n = 0; n < 5; ++n) world_.advance();
    file_ = save_state(world_);
  }
  /// Expects a refusal that changes nothing.
  void expect_refused(std::span<const std::byte> file, const std::string& why) {
    const std::uint64_t before = hash_fields(world_.state());
    const auto refusal = load_state(file, world_);
    ASSERT_TRUE(refusal.has_value()) << why;
    EXPECT_THAT(to_string(*refusal), HasSubstr(why));
    EXPECT_THAT(refusal->what, HasSubstr("allowed: "));
    ASSERT_EQ(hash_fields(world_.state()), before);
  }
  World world_;
  std::vector<std::byte> file_;
};

TEST_F(StateFile, CutOffAnywhereIsRefused) {
  expect_refused({}, "it has 0 bytes");
  for (const std::size_t length : {std::size_t{1}, std::size_t{8}, std::size_t{16}, std::size_t{31}})
    expect_refused(std::span(file_).first(length), "bytes");
  std::mt19937 random(1);
  for (int n = 0; n < 60; ++n)
    expect_refused(std::span(file_).first(32 + random() % (file_.size() - 32)), "was saved with");
  expect_refused(std::span(file_).first(file_.size() - 1), "was saved with");
  std::vector<std::byte> longer = file_;
  longer.push_back(std::byte{0});
  expect_refused(longer, "was saved with");
}

TEST_F(StateFile, FlippedBitsAreRefused) {
  std::mt19937 random(2);
  for (int n = 0; n < 200; ++n) {
    std::vector<std::byte> flipped = file_;
    const std::size_t place = n < 64 ? static_cast<std::size_t>(n) : random() % file_.size();
    flipped[place] ^= std::byte{static_cast<unsigned char>(1U << (random() % 8))};
    expect_refused(flipped, "state file: ");
  }
}

TEST_F(StateFile, ForeignFilesAreRefused) {
  std::vector<std::byte> text(500, std::byte{'a'});
  expect_refused(text, "does not begin with PELAGOS");
  std::vector<std::byte> newer = file_;
  newer[7] = std::byte{4};
  expect_refused(newer, "its format is 4; allowed: format 3");
}

/// The file with the first letter of a text of its origin changed and the checksum set right, as another build saves
/// it.
std::vector<std::byte> with_other_text(std::vector<std::byte> file, std::string_view text) {
  const auto bytes = std::as_bytes(std::span(text));
  const auto found = std::search(file.begin() + 32, file.end(), bytes.begin(), bytes.end());
  EXPECT_NE(found, file.end()) << text;
  *found = std::byte{'x'};
  ByteHash hash;
  hash.add(file.data() + 24, file.size() - 24);
  const std::uint64_t value = hash.value();
  std::memcpy(file.data() + 16, &value, sizeof value);
  return file;
}

TEST_F(StateFile, StatesOfOtherBuildsAndMachinesAreRefused) {
  expect_refused(with_other_text(file_, kVersion), std::string("; allowed: version ") + kVersion);
  const std::string set = instruction_set();
  expect_refused(with_other_text(file_, set), "it is of instruction set x" + set.substr(1));
}

TEST_F(StateFile, StatesOfOtherScenesAreRefused) {
  Scene other = oily_patch(OilModel::kBoth);
  other.name = "harbour";
  expect_refused(save_state(World(other, {1, nullptr, {}})), "it is of scene harbour; allowed: scene small_patch");
  other = oily_patch(OilModel::kBoth);
  other.patch.max.x() = 6.0;
  expect_refused(save_state(World(other, {1, nullptr, {}})), "differs in: patch;");
  other = oily_patch(OilModel::kBoth);
  other.particle_spacing = 0.3;
  expect_refused(save_state(World(other, {1, nullptr, {}})), "particle spacing");
  other = oily_patch(OilModel::kBoth);
  other.oil->properties.viscosity *= 2.0;
  expect_refused(save_state(World(other, {1, nullptr, {}})), "differs in: oil;");
}

TEST(SceneParts, TellBodiesApart) {
  const Scene scene = floating_box(0.5);
  const auto part_of = [](const Scene& of) {
    for (const auto& [name, hash] : World(of, {1, nullptr, {}}).scene_parts())
      if (name == "bodies") return hash;
    return std::uint64_t{0};
  };
  const std::uint64_t usual = part_of(scene);
  EXPECT_EQ(part_of(scene), usual);
  const auto expect_other = [&](const char* what, const auto& change) {
    Scene other = scene;
    other.water.settle_steps = 0;
    change(other.bodies[0]);
    EXPECT_NE(part_of(other), usual) << what;
  };
  expect_other("shape", [](BodySettings& body) { body.primitive = BoxShape{{1.2, 1.2, 0.81}}; });
  expect_other("mass", [](BodySettings& body) { body.mass.density += 1.0; });
  expect_other("centre", [](BodySettings& body) { body.mass.centre = Eigen::Vector3d(0.01, 0.0, 0.0); });
  expect_other("start", [](BodySettings& body) { body.free_from = 3.0; });
  expect_other("freedoms", [](BodySettings& body) { body.freedoms.about.setZero(); });
  Scene quay = scene;
  quay.bodies[0].drive = BodyDrive::kStatic;
  const std::uint64_t fixed = part_of(quay);
  quay.bodies[0].position.x() += 0.1;
  EXPECT_NE(part_of(quay), fixed) << "place of a STATIC body";
}

}  // namespace

}  // namespace pelagos
