// What people write in other countries, keyboards and editors: read as it is meant, or refused where it stands.

#include <gmock/gmock.h>

#include <string>

#include "scene/command_log.hpp"
#include "scene_text.hpp"
#include "values/beaufort.hpp"

namespace pelagos {
namespace {

using namespace std::string_literals;
using test::kValid;
using test::read_with;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

/// A valid scene whose wind says that.
SceneResult read_wind_scene(const std::string& wind) { return read_with("wind { " + wind + " }"); }

TEST(SceneText, ReadsNumbersWithLeadingZerosAsDecimal) {
  const SceneResult force = read_wind_scene("beaufort: 010 from_deg: 090");
  ASSERT_TRUE(force) << force.report();
  EXPECT_NEAR(force.scene->wind->velocity.norm(), beaufort_speed(10), 1e-12);
  EXPECT_NEAR(wind_from_deg(force.scene->wind->velocity), 90.0, 1e-9);

  const SceneResult digits = read_wind_scene("speed: 007.50 from_deg:0180");
  ASSERT_TRUE(digits) << digits.report();
  EXPECT_NEAR(digits.scene->wind->velocity.norm(), 7.5, 1e-12);
}

TEST(SceneText, ReadsLeadingZerosOfEveryKind) {
  const SceneResult read = read_with(
      "seed: 0000123456789012345\n"
      "wind { velocity { x: -010 y: 00 z: 0.0 } }\n"
      "event { at: 010 set_wind { wind { speed: 08 from_deg: 09e1 } ramp: 0012 } }\n"
      "body { id: 017 position { x: 01 y: 01 z: 01.5 } shape { box { size { x: 00.5 y: 0.5 z: 0.50f } } } }\n");
  ASSERT_TRUE(read) << read.report();
  EXPECT_EQ(read.scene->seed, 123456789012345u);
  EXPECT_EQ(read.scene->wind->velocity.x(), -10.0);
  EXPECT_EQ(read.scene->wind->velocity.y(), 0.0);
  ASSERT_EQ(read.scene->events.size(), 1u);
  EXPECT_EQ(read.scene->events[0].at, 10.0);
  const auto& set = std::get<SetWind>(read.scene->events[0].command);
  EXPECT_EQ(set.wind.speed, 8.0);
  EXPECT_EQ(set.wind.from_deg, 90.0);
  EXPECT_EQ(set.ramp_seconds, 12.0);
  ASSERT_EQ(read.scene->bodies.size(), 1u);
  EXPECT_EQ(read.scene->bodies[0].id, 17u);
  EXPECT_EQ(read.scene->bodies[0].position.z(), 1.5);
}

TEST(SceneText, LeavesStringsCommentsAndHexadecimalAlone) {
  const SceneResult read = read_with(
      "body { id: 1 mesh_file: \"no 007, 0,5 m “é” – 港.obj\" position { x: 1 y: 1 z: 1 } }\n"
      "# 0,5 m, “typographic”, −3, caf\xE9\n"
      "seed: 0x10\n");
  ASSERT_TRUE(read) << read.report();
  EXPECT_THAT(read.scene->bodies.at(0).mesh_file, HasSubstr("no 007, 0,5 m “é” – 港.obj"));
  EXPECT_EQ(read.scene->seed, 16u);
}

TEST(SceneText, LeavesWhatIsLegalAlone) {
  for (const char* legal : {
           "seed: 5, gravity: 9.81; wind: < speed: 5, from_deg: 90, >",
           "wind\n{\n\tspeed\n:\n5\r\n\tfrom_deg\n: 90 }",
           "solver { kind:\n CORRECTED\n method: JACOBI }",
           "wind { velocity { x: - 3.5 y: -.5 z: 0. } }  # the end, without a line feed",
           "event [ { at: 1 pause {} }, { at: 2, pause {} } ]",
           "\v\f",
           "\r\n\r\r\n\r",
       })
    EXPECT_TRUE(read_with(legal)) << legal << "\n" << read_with(legal).report();
}

TEST(SceneText, AcceptsAByteOrderMark) {
  EXPECT_TRUE(read_scene_text("\xEF\xBB\xBF" + kValid, "test.scene"));
  EXPECT_THAT(read_scene_text("\xEF\xBB\xBFgravty: 1\n" + kValid, "test.scene").faults,
              ElementsAre(StartsWith("test.scene:1: gravty: unknown field")));
}

/// A text after the valid scene, from line 7 on, and where and what its only fault must be.
struct TextCase {
  const char* name;
  std::string text;
  const char* place;
  std::vector<const char*> says;
};
void PrintTo(const TextCase& c, std::ostream* out) { *out << c.text; }

class ForeignText : public testing::TestWithParam<TextCase> {};

TEST_P(ForeignText, IsRefusedWhereItStands) {
  const TextCase& c = GetParam();
  const SceneResult read = read_with(c.text + "\ngravity: 9.81\n");
  ASSERT_EQ(read.faults.size(), 1u) << read.report();
  EXPECT_THAT(read.faults[0], StartsWith(std::string("test.scene:") + c.place));
  for (const char* part : c.says) EXPECT_THAT(read.faults[0], HasSubstr(part));
}

INSTANTIATE_TEST_SUITE_P(
    SceneText, ForeignText,
    testing::Values(
        TextCase{"DecimalComma", "seed: 1\nwater_level: 0,5", "8:14: water_level: ", {"0,5", "write 0.5"}},
        TextCase{"DecimalCommaBeforeBrace", "wind { speed: 5,25 }", "7:15: speed: ", {"write 5.25"}},
        TextCase{"DecimalCommaInAListOfMessages", "event [ { at: 1,5 pause {} } ]", "7:15: at: ", {"write 1.5"}},
        TextCase{"GroupsOfThousands", "seed: 1,000", "7:7: seed: ", {"write 1.000, or 1000"}},
        TextCase{"GroupsByPoints", "water_level: 1.000,5", "7:14: water_level: ", {"write 1000.5"}},
        TextCase{"Apostrophes", "seed: 1'000", "7:7: seed: ", {"'", "without separators"}},
        TextCase{"Spaces", "seed: 10 000", "7:7: seed: ", {"10 and 000", "without spaces"}},
        TextCase{"Unit", "gravity: 9.81 m", "7:10: gravity: ", {"\"m\" behind the number 9.81", "alone"}},
        TextCase{"UnitWithoutSpace", "wind { speed: 12kn from_deg: 0 }", "7:15: speed: ", {"\"kn\"", "12"}},
        TextCase{"UnitBeforeBrace", "wind { speed: 12 from_deg: 5 deg }", "7:28: from_deg: ", {"\"deg\""}},
        TextCase{"UnitThatLooksLikeAnExponent", "gravity: 9em", "7:10: gravity: ", {"\"em\""}},
        TextCase{"Percent", "gravity: 9 %", "7:10: gravity: ", {"\"%\""}},
        TextCase{"DegreeSign", "wind { speed: 5 from_deg: 45° }", "7:29: from_deg: ", {"degree sign", "U+00B0"}},
        TextCase{"TypographicQuotes", "name: “a”", "7:7: name: ", {"“", "U+201C", "write \" instead"}},
        TextCase{"LowQuotes", "body { mesh_file: „a.obj“ }", "7:19: mesh_file: ", {"U+201E", "write \""}},
        TextCase{
            "ATypographicQuoteAtTheEnd", "body { mesh_file: \"a.obj” }", "7:25: mesh_file: ", {"U+201D", "write \""}},
        TextCase{"MinusSign", "wind { velocity { x: −3 } }", "7:22: x: ", {"minus sign", "U+2212", "write - instead"}},
        TextCase{"EnDash", "gravity: –9", "7:10: gravity: ", {"en dash", "U+2013", "write -"}},
        TextCase{"NoBreakSpace", "gravity:\u00A09.81", "7:9: gravity: ", {"no-break space (U+00A0)", "ordinary space"}},
        TextCase{"ZeroWidthSpace", "\u200Bseed: 1", "7:1: ", {"zero-width space (U+200B)"}},
        TextCase{"FullWidthDigits", "seed: １２", "7:7: seed: ", {"full-width digit", "write 1 instead"}},
        TextCase{"FullWidthColon", "seed： 1", "7:5: ", {"U+FF1A", "write : instead"}},
        TextCase{"ForeignLetters", "größe: 1", "7:3: ", {"ö", "U+00F6"}},
        TextCase{"Latin1",
                 "gr\xF6\xDF"
                 "e: 1",
                 "7:3: ",
                 {"byte 0xF6, which is not UTF-8", "save the file as UTF-8"}},
        TextCase{"Latin1InQuotes",
                 "body { mesh_file: \"H\xE4"
                 "fen.obj\" }",
                 "7:21: mesh_file: ",
                 {"byte 0xE4", "UTF-8"}},
        TextCase{"CarriageReturnsAlone", "seed: 1\rgravity: 3", "7:8: ", {"carriage return", "line feeds"}},
        TextCase{"CarriageReturnInAComment", "seed: 1 # one\rgravity: 3", "7:14: ", {"carriage return"}},
        TextCase{"ZeroByte", "seed: 1\0"s, "7:8: ", {"zero byte"}},
        TextCase{"ZeroByteInAComment", "seed: 1 # \0"s, "7:11: ", {"zero byte"}},
        TextCase{"ControlCharacter", "seed: 1\x01", "7:8: ", {"control character (U+0001)"}},
        TextCase{"ColumnsBehindTabs", "\tseed: 1\u00A0", "7:16: ", {"no-break space"}},
        TextCase{"NoValue", "seed\n", "7:1: ", {"has no value", "seed: VALUE"}},
        TextCase{"NoValueBehindTheColon", "seed:\n", "7:5: seed: ", {"no value behind the colon"}},
        TextCase{"OpenBrace", "wind { speed: 5\nfrom_deg: 9", "7:6: ", {"\"{\" is opened here and never closed"}}),
    [](const auto& c) { return c.param.name; });

std::string encode(const std::string& ascii, std::size_t width, bool big_endian) {
  std::string text;
  for (const char c : ascii) {
    std::string unit(width, '\0');
    unit[big_endian ? width - 1 : 0] = c;
    text += unit;
  }
  return text;
}

TEST(SceneText, NamesOtherEncodings) {
  const auto expect = [](const std::string& text, const char* name) {
    EXPECT_THAT(read_scene_text(text, "a.scene").faults,
                ElementsAre(AllOf(StartsWith("a.scene:1:1: "), HasSubstr(name), HasSubstr("save it as UTF-8"))));
  };
  expect("\xFF\xFE" + encode(kValid, 2, false), "UTF-16 (little-endian)");
  expect("\xFE\xFF" + encode(kValid, 2, true), "UTF-16 (big-endian)");
  expect(encode(kValid, 2, false), "UTF-16 (little-endian)");
  expect(encode(kValid, 2, true), "UTF-16 (big-endian)");
  expect("\xFF\xFE\0\0"s + encode(kValid, 4, false), "UTF-32 (little-endian)");
  expect("\0\0\xFE\xFF"s + encode(kValid, 4, true), "UTF-32 (big-endian)");
  expect(encode(kValid, 4, false), "UTF-32 (little-endian)");
  expect(encode(kValid, 4, true), "UTF-32 (big-endian)");
}

TEST(SceneText, CommandLogsAreReadAlike) {
  const CommandLogResult read = read_command_log_text(
      "\xEF\xBB\xBFscene: \"a\" seed: 01 particles: 0100\n"
      "command { before_step: 010 set_wind { wind { beaufort: 08 from_deg: 090 } } }\n",
      "a.log");
  ASSERT_TRUE(read.log) << read.faults.front();
  EXPECT_EQ(read.log->header.particles, 100u);
  EXPECT_EQ(read.log->commands.at(0).before_step, 10u);
  EXPECT_THAT(read_command_log_text("scene: \"a\" seed: 1 particles: 1\ncommand { before_step: −1 }\n", "a.log").faults,
              ElementsAre(AllOf(StartsWith("a.log:2:24: before_step: "), HasSubstr("minus sign"))));
  const std::string whole = "scene: \"a\" seed: 1 particles: 1\ncommand { before_step: 1 clear_wind { } }\n";
  EXPECT_THAT(read_command_log_text(whole + "end { step: 0 state_hash: \"00000000000000aa\" }\n", "a.log").faults,
              ElementsAre(AllOf(HasSubstr("command: stands at step 1, after the end"), HasSubstr("up to step 0"))));
  EXPECT_THAT(read_command_log_text("# a log\nversion: \"1\" scene: \"a", "a.log").faults.back(),
              HasSubstr("line 2 of the log, its last, is cut off"));
  for (const char* cut :
       {"c", "command", "command {", "command { before_step: 1 clear_w", "end { step: 3 state_hash: \"1"}) {
    const CommandLogResult result = read_command_log_text(whole + cut, "a.log");
    ASSERT_TRUE(result.log) << cut << ": " << result.faults.front();
    EXPECT_EQ(result.log->commands.size(), 1u);
    EXPECT_THAT(result.log->cut_off, HasSubstr("line 3 of the log, its last, is cut off after")) << cut;
  }
}

}  // namespace
}  // namespace pelagos
