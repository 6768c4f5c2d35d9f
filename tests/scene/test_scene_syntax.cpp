#include <gmock/gmock.h>

#include <string>

#include "messages/field_reader.hpp"
#include "scene.pb.h"
#include "scene_text.hpp"

namespace pelagos {
namespace {

using test::kValid;
using test::read_with;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(SceneSyntax, StopsAtTheFirstErrorWithLineAndColumn) {
  EXPECT_THAT(read_with("wind { beaufort: }\nseed: -1\nbogus: 3\n").faults,
              ElementsAre(StartsWith("test.scene:7:18: ")));
  EXPECT_THAT(read_with("gravity 9.81").faults, ElementsAre(StartsWith("test.scene:7:")));
  EXPECT_THAT(read_with("wind {").faults, ElementsAre(StartsWith("test.scene:7:")));
  EXPECT_THAT(read_with("\"").faults, ElementsAre(StartsWith("test.scene:7:")));
}

TEST(SceneSyntax, StopsAtTypeErrors) {
  EXPECT_THAT(read_with("gravity: \"strong\"").faults, ElementsAre(StartsWith("test.scene:7:10: ")));
  EXPECT_THAT(read_with("seed: -1").faults, ElementsAre(StartsWith("test.scene:7:")));
  EXPECT_THAT(read_with("wind: 3").faults, ElementsAre(StartsWith("test.scene:7:")));
  EXPECT_THAT(read_with("far_sea { beaufort: 99999999999 }").faults, ElementsAre(StartsWith("test.scene:7:")));
}

TEST(SceneSyntax, RefusesAFieldGivenTwice) {
  EXPECT_THAT(read_with("particle_spacing: 0.2").faults,
              ElementsAre(AllOf(StartsWith("test.scene:7:"), HasSubstr("specified multiple times"))));
}

TEST(SceneSyntax, NamesTheChoicesOfAnEnum) {
  EXPECT_THAT(read_with("solver { method: MAGIC }").faults,
              ElementsAre(AllOf(HasSubstr("\"MAGIC\""), HasSubstr("Allowed: CONJUGATE_GRADIENT, JACOBI, PAPER"))));
}

TEST(SceneSyntax, OffersTheNearestChoiceOfAnEnum) {
  EXPECT_THAT(read_with("solver { kind: corrected }").faults, ElementsAre(HasSubstr("Did you mean CORRECTED?")));
  EXPECT_THAT(read_with("solver { method: JACOBY }").faults, ElementsAre(HasSubstr("Did you mean JACOBI?")));
  EXPECT_THAT(read_with("solver { method: MAGIC }").faults, ElementsAre(Not(HasSubstr("Did you mean"))));
}

TEST(SceneSyntax, PlacesUnknownFieldsOfEveryShape) {
  EXPECT_THAT(read_with("a: 1\n"
                        "b { c: \"}\" d { e: [1, 2] } }  # } in a comment\n"
                        "wind { velocity { x: 1 w: 2 } q: [ { r: 1 }, { r: 2 } ] }\n"
                        "water_level: 3")
                  .faults,
              ElementsAre(StartsWith("test.scene:7: a: unknown field"), StartsWith("test.scene:8: b: unknown field"),
                          StartsWith("test.scene:9: wind.velocity.w: unknown field"),
                          StartsWith("test.scene:9: wind.q: unknown field"),
                          AllOf(StartsWith("test.scene:10: water_level: unknown field"))));
}

TEST(SceneSyntax, CountsEntriesOfShortLists) {
  std::string text = kValid;
  const std::size_t at = text.find("block {");
  text.replace(at, std::string("block { min { x: 0 y: 0 z: 0 } max { x: 1 y: 1 z: 1 } }").size(),
               "block [ { min { } max { x: 1 y: 1 z: 1 } }, { min { x: 1 } max { x: 2 y: 2 z: 2 } hue: 1 } ]");
  EXPECT_THAT(read_scene_text(text, "test.scene").faults,
              ElementsAre(StartsWith("test.scene:5: water.block[1].hue: unknown field")));
}

TEST(SceneSyntax, SurvivesDeepNestingAndGarbage) {
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "a {";
  EXPECT_THAT(read_with(deep).faults, ElementsAre(HasSubstr("nested too deeply")));
  deep.clear();
  for (int i = 0; i < 100000; ++i) deep += "a: [";
  EXPECT_THAT(read_with(deep).faults, ElementsAre(HasSubstr("nested too deeply")));
  std::string garbage;
  std::uint32_t state = 1;
  for (int i = 0; i < 100000; ++i) {
    state = state * 1664525u + 1013904223u;
    garbage += static_cast<char>(state >> 24);
  }
  EXPECT_FALSE(read_scene_text(garbage, "test.scene"));
  EXPECT_THAT(read_scene_text(std::string(2 << 20, '#'), "test.scene").faults, ElementsAre(HasSubstr("1048576 bytes")));
}

/// Every shortened form of a valid scene is refused or read, never anything else.
TEST(SceneSyntax, SurvivesAnyTruncation) {
  const std::string text = kValid + "wind { velocity { x: 1 } } body { id: 1 mesh_file: \"a\" position { } }";
  for (std::size_t length = 0; length < text.size(); ++length) {
    const SceneResult result = read_scene_text(text.substr(0, length), "test.scene");
    EXPECT_EQ(result.faults.empty(), static_cast<bool>(result)) << length;
  }
}

TEST(SceneFile, SaysWhyAFileCannotBeRead) {
  EXPECT_THAT(read_scene_file("/nowhere/a.scene").faults, ElementsAre("/nowhere/a.scene: no such scene file"));
  EXPECT_THAT(read_scene_file("/").faults, ElementsAre(HasSubstr("is a folder")));
}

TEST(SceneMessage, ReadsTheSameSceneFromBytes) {
  proto::v1::Scene message;
  ASSERT_TRUE(google::protobuf::TextFormat::ParseFromString(kValid, &message));
  const SceneResult result = read_scene_message(message.SerializeAsString(), "station");
  ASSERT_TRUE(result) << result.report();
  EXPECT_EQ(result.scene->name, "small");
}

TEST(SceneMessage, NotesFieldsOfANewerSenderAndForeignEnumValues) {
  proto::v1::Scene message;
  ASSERT_TRUE(google::protobuf::TextFormat::ParseFromString(kValid, &message));
  message.mutable_water()->GetReflection()->MutableUnknownFields(message.mutable_water())->AddVarint(900, 1);
  message.mutable_solver()->set_method(static_cast<proto::v1::Solver::Method>(77));
  EXPECT_THAT(read_scene_message(message.SerializeAsString(), "station").faults,
              ElementsAre(AllOf(StartsWith("station: solver.method: 77")),
                          AllOf(StartsWith("station: water: "), HasSubstr("field number 900"))));
}

TEST(SceneMessage, RefusesBytesThatAreNoScene) {
  EXPECT_THAT(read_scene_message("\xff\xff\xff\xff", "station").faults, ElementsAre(HasSubstr("not a scene message")));
}

TEST(NearestName, FindsMisspellingsAndPartsOnly) {
  const std::vector<std::string> known{"particle_spacing", "gravity", "time_step"};
  EXPECT_EQ(nearest_name("gravty", known), "gravity");
  EXPECT_EQ(nearest_name("spacing", known), "particle_spacing");
  EXPECT_EQ(nearest_name("timestep", known), "time_step");
  EXPECT_EQ(nearest_name("colour", known), "");
  EXPECT_EQ(nearest_name(std::string(10000, 'a'), known), "");
}

TEST(FormatCount, GroupsDigitsByThree) {
  EXPECT_EQ(format_count(0), "0");
  EXPECT_EQ(format_count(999), "999");
  EXPECT_EQ(format_count(1000), "1,000");
  EXPECT_EQ(format_count(997002999), "997,002,999");
  EXPECT_EQ(format_count(-1234567), "-1,234,567");
}

}  // namespace
}  // namespace pelagos
