// Patches with open edges.

#include <gmock/gmock.h>

#include "scene_text.hpp"

namespace pelagos {
namespace {

using testing::HasSubstr;

/// A patch of 48 x 40 x 5 m with open edges, `more` after it, pieces replaced.
SceneResult read_open(const std::string& more, const std::string& what = "", const std::string& by = "") {
  std::string text =
      "name: \"open\"\n"
      "particle_spacing: 1\n"
      "patch { min { x: -24 y: -20 z: -5 } max { x: 24 y: 20 z: 9 } }\n"
      "patch_edges { x: OPEN y: OPEN }\n"
      "water { block { min { x: -24 y: -20 z: -5 } max { x: 24 y: 20 z: 0 } } }\n"
      "open_sea { zone_width: 8 }\n";
  if (!what.empty()) {
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    text.replace(at, what.size(), by);
  }
  SceneReadOptions options;
  options.check_meshes = false;
  return read_scene_text(text + more, "open.scene", options);
}

TEST(SceneOpenSea, IsRead) {
  const SceneResult result =
      read_open("", "zone_width: 8", "zone_width: 7.5 depth: 40 follow { track { speed: 5 course_deg: 90 } }");
  ASSERT_TRUE(result) << result.report();
  EXPECT_TRUE(is_open(result.scene->patch_edges));
  EXPECT_EQ(result.scene->open_sea.zone_width, 7.5);
  EXPECT_EQ(result.scene->open_sea.depth, 40.0);
  EXPECT_NEAR(result.scene->open_sea.follow_velocity.x(), 5.0, 1e-12);
  EXPECT_NEAR(result.scene->open_sea.follow_velocity.y(), 0.0, 1e-12);
}

TEST(SceneOpenSea, HasZonesOfFifteenSpacings) {
  const SceneResult result =
      read_open("", "x: -24 y: -20 z: -5 } max { x: 24 y: 20 z: 9", "x: -24 y: -24 z: -5 } max { x: 24 y: 24 z: 9");
  EXPECT_THAT(result.report(), HasSubstr("water.block: does not fill the patch"));
  EXPECT_THAT(read_open("", "open_sea { zone_width: 8 }\n", "").report(),
              HasSubstr("open_sea.zone_width: of 15 m leaves no room: the patch's side along y is 40 m; allowed: sides "
                        "of at least 46 m with such zones"));
}

TEST(SceneOpenSea, MovesAcrossOpenEdgesOnly) {
  const auto with = [](const char* course) {
    std::string scene =
        "name: \"flume\" particle_spacing: 1\n"
        "patch { min { x: -24 y: -2 z: -5 } max { x: 24 y: 2 z: 9 } }\n"
        "patch_edges { x: OPEN y: PERIODIC }\n"
        "water { block { min { x: -24 y: -2 z: -5 } max { x: 24 y: 2 z: 0 } } }\n"
        "open_sea { zone_width: 8 follow { track { speed: 4 course_deg: ";
    return read_scene_text(scene + course + " } } }", "flume.scene");
  };
  EXPECT_TRUE(with("90")) << with("90").report();
  EXPECT_TRUE(with("270"));
  EXPECT_THAT(with("30").report(),
              HasSubstr("open_sea.follow: moves the patch along y; allowed: where patch_edges are OPEN"));
}

TEST(SceneOpenSea, TakesBodiesThatMoveBeyondItsEdges) {
  const auto body = [](const char* rest) {
    return std::string("body { id: 1 shape { sphere { radius: 1 } } ") + rest + " }";
  };
  for (const char* rest :
       {"drive: FREE mass { kg: 900 } position { x: 90 y: -400 z: 1 }", "drive: POSE position { x: 90 y: 0 z: 1 }",
        "drive: POSE_HORIZONTAL mass { kg: 900 } position { x: 90 y: 0 z: 1 }"}) {
    const SceneResult result = read_open(body(rest));
    EXPECT_TRUE(result) << result.report();
  }
  const char* allowed = "allowed: within its sides, or beyond OPEN ones with drive FREE, POSE or POSE_HORIZONTAL";
  EXPECT_THAT(read_open(body("drive: STATIC position { x: 90 y: 0 z: 1 }")).report(),
              testing::AllOf(HasSubstr("body[0].position: (90, 0, 1) is outside the patch"), HasSubstr(allowed)));
  EXPECT_THAT(read_open(body("drive: POSE position { x: 90 y: 0 z: 30 }")).report(), HasSubstr(allowed));
  EXPECT_THAT(read_open(body("drive: POSE position { x: 90 y: 0 z: 1 }"), "y: OPEN", "y: MIRROR").report(), "");
  EXPECT_THAT(read_open(body("drive: POSE position { x: 0 y: 90 z: 1 }"), "y: OPEN", "y: MIRROR").report(),
              HasSubstr("(0, 90, 1) is outside the patch"));
}

/// A faulty field in the scene of an open sea, where part of its text is replaced.
struct OpenSeaFault {
  test::FaultCase fault;
  const char* what = "";
  const char* by = "";
};
void PrintTo(const OpenSeaFault& fault, std::ostream* out) { *out << fault.fault.name; }

class SceneOpenSeaFault : public testing::TestWithParam<OpenSeaFault> {};
TEST_P(SceneOpenSeaFault, NamesFieldAndWhatIsAllowed) {
  const auto& [fault, what, by] = GetParam();
  const SceneResult result = read_open(fault.text, what, by);
  EXPECT_FALSE(result);
  EXPECT_THAT(result.faults, testing::Contains(testing::AllOf(HasSubstr(std::string(": ") + fault.field + ": "),
                                                              HasSubstr(fault.says))));
}

INSTANTIATE_TEST_SUITE_P(
    Fields, SceneOpenSeaFault,
    testing::Values(
        OpenSeaFault{{"WithoutOpenEdges", "", "open_sea", "needs patch_edges that are OPEN along x or y"},
                     "patch_edges { x: OPEN y: OPEN }\n",
                     ""},
        OpenSeaFault{{"OpenBelow", "", "patch_edges.z", "is OPEN; allowed for x and y"},
                     "x: OPEN y: OPEN",
                     "x: OPEN y: OPEN z: OPEN"},
        OpenSeaFault{{"PeriodicBelow", "", "patch_edges.z", "is PERIODIC; allowed"},
                     "x: OPEN y: OPEN",
                     "x: OPEN y: OPEN z: PERIODIC"},
        OpenSeaFault{
            {"OddSide", "", "patch_edges.x", "is OPEN, but the patch's side of 48.5 m is no whole number of spacings"},
            "max { x: 24 y: 20 z: 9",
            "max { x: 24.5 y: 20 z: 9"},
        OpenSeaFault{
            {"Hybrid", "solver { kind: HYBRID }", "patch_edges", "are OPEN; allowed with the solver CORRECTED only"}},
        OpenSeaFault{{"Support", "support_radius: 1.9", "support_radius", "is 1.9; allowed with OPEN edges: 2"}},
        OpenSeaFault{{"TwoBlocks", "", "water.block", "there are 2; allowed with OPEN edges: one"},
                     "water { block",
                     "water { block { min { x: 0 y: 0 z: 1 } max { x: 4 y: 4 z: 4 } } block"},
        OpenSeaFault{{"SmallBlock", "", "water.block", "does not fill the patch"},
                     "max { x: 24 y: 20 z: 0",
                     "max { x: 23 y: 20 z: 0"},
        OpenSeaFault{{"OddDepth", "", "water.block",
                      "is 5.5 spacings deep; allowed with OPEN edges: a whole number, at least 4"},
                     "max { x: 24 y: 20 z: 0",
                     "max { x: 24 y: 20 z: 0.5"},
        OpenSeaFault{{"Oil", "oil { }", "oil", "is in a patch with OPEN edges"}},
        OpenSeaFault{{"WideZones", "", "open_sea.zone_width", "leaves no room: the patch's side along y is 40 m"},
                     "zone_width: 8",
                     "zone_width: 12.5"},
        OpenSeaFault{{"NarrowZones", "", "open_sea.zone_width", "3 is out of range; allowed: 4 to 100 m"},
                     "zone_width: 8",
                     "zone_width: 3"},
        OpenSeaFault{{"Shallow", "", "open_sea.depth", "4.5 is out of range; allowed: 5 to 12000 m"},
                     "zone_width: 8",
                     "zone_width: 8 depth: 4.5"},
        OpenSeaFault{{"FollowsNothing", "", "open_sea.follow", "has neither a body nor a track; allowed: exactly one"},
                     "zone_width: 8",
                     "zone_width: 8 follow { }"},
        OpenSeaFault{{"FollowsBoth", "", "open_sea.follow", "has a body and a track; allowed: exactly one"},
                     "zone_width: 8",
                     "zone_width: 8 follow { body: 1 track { speed: 1 course_deg: 0 } }"},
        OpenSeaFault{{"FollowsNobody", "", "open_sea.follow.body", "7 is no body of the scene; allowed: the id of one"},
                     "zone_width: 8",
                     "zone_width: 8 follow { body: 7 }"},
        OpenSeaFault{{"TooFast", "", "open_sea.follow.track.speed", "31 is out of range; allowed: 0 to 30 m/s"},
                     "zone_width: 8",
                     "zone_width: 8 follow { track { speed: 31 course_deg: 0 } }"},
        OpenSeaFault{{"WithoutCourse", "", "open_sea.follow.track.course_deg", "is missing"},
                     "zone_width: 8",
                     "zone_width: 8 follow { track { speed: 3 } }"}),
    [](const auto& entry) { return entry.param.fault.name; });

}  // namespace
}  // namespace pelagos
