#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "../support/places.hpp"
#include "channels/rig.hpp"

namespace pelagos {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::string refusal_of(const std::string& text) {
  try {
    (void)parse_rig(text, "rig.json");
  } catch (const RigError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Rig, ShippedRigHasTheBridgeChannels) {
  const Rig rig = load_rig(test::source_path("assets/rigs/ship_bridge.json"));
  for (const char* name : {"port", "centre", "starboard", "quarter", "above"})
    EXPECT_NE(rig.find(name), nullptr) << name;
  // neighbouring screens must meet
  EXPECT_DOUBLE_EQ(rig.find("port")->yaw_deg + 0.5 * rig.find("port")->horizontal_fov_deg,
                   rig.find("centre")->yaw_deg - 0.5 * rig.find("centre")->horizontal_fov_deg);
  EXPECT_EQ(rig.find("port")->mount.body, 1u);
  EXPECT_EQ(rig.find("aft"), nullptr);
}

TEST(Rig, ShippedRigHasTheViewsOfTheSheet) {
  const Rig rig = load_rig(test::source_path("assets/rigs/views.json"));
  for (const char* name : {"bridge", "low", "bird", "quarter", "bow", "astern", "towards_sun", "rim", "night", "fog",
                           "lighthouse", "harbour"})
    EXPECT_NE(rig.find(name), nullptr) << name;
  EXPECT_EQ(rig.find("harbour")->mount.body, 0U) << "a camera on shore";
}

TEST(Rig, ReadsAllFieldsAndComments) {
  const Rig rig = parse_rig(R"({
    // a lighthouse
    "name": "tower",
    "mount": {"body": 0, "eye": [1, 2, 30], "heading_deg": 45, "tilt_deg": -3},
    "channels": [{"name": "sea", "yaw_deg": 10, "pitch_deg": -2, "horizontal_fov_deg": 60, "guard_px": 12},
                 {"name": "deck", "mount": {"body": 7, "attitude": "heading"}}]})",
                            "rig.json");
  ASSERT_EQ(rig.channels.size(), 2u);
  EXPECT_EQ(rig.channel_names(), "sea, deck");
  EXPECT_DOUBLE_EQ(rig.channels[0].mount.eye.z(), 30.0);
  EXPECT_DOUBLE_EQ(rig.channels[0].mount.heading_deg, 45.0);
  EXPECT_DOUBLE_EQ(rig.channels[0].mount.tilt_deg, -3.0);
  EXPECT_EQ(rig.channels[0].guard_px, 12);
  EXPECT_EQ(rig.channels[1].mount.body, 7u);
  EXPECT_EQ(rig.channels[1].mount.attitude, MountAttitude::kHeading);
}

TEST(Rig, ReportsEveryFaultAtOnce) {
  const std::string report = refusal_of(R"({
    "mount": {"body": -1, "eye": [1, 2], "attitude": "sideways"},
    "channels": [{"name": "a b", "horizontal_fov_deg": 180, "fov": 3}, {"yaw_deg": "left", "guard_px": 1.5},
                 {"name": "x"}, {"name": "x"}],
    "colour": 1})");
  for (const char* fault :
       {"rig.json: mount.body: is -1; allowed: a whole number from 0 to 1000000", "mount.eye: is [1,2]; allowed: three",
        "mount.attitude: is \"sideways\"; allowed: \"full\", \"heading\", \"none\"", "channels[0].name: is \"a b\"",
        "channels[0].horizontal_fov_deg: is 180; allowed: a number from 1 to 120",
        "channels[0].fov: is not a field here", "channels[1].name: is missing", "channels[1].yaw_deg: is \"left\"",
        "channels[1].guard_px: is 1.5", "channels[3].name: is \"x\", which an earlier channel has",
        "colour: is not a field here; allowed: channels, mount, name"})
    EXPECT_THAT(report, HasSubstr(fault));
}

TEST(Rig, RefusesWhatIsNoRig) {
  EXPECT_THAT(refusal_of("{\"channels\": ["),
              StartsWith("rig.json:1: not JSON: the file ends too early; allowed: JSON with mount and channels"));
  EXPECT_THAT(refusal_of("{\n  \"name\": \"a\",\n  channels: []\n}"),
              StartsWith("rig.json:3: not JSON at \"channels: []\"; allowed:"));
  EXPECT_THAT(refusal_of("mount = 3"), StartsWith("rig.json:1: not JSON at \"mount = 3\""));
  for (const char* text : {"", "\n", "\n\n", "{", "{\n", "}\n{", "\"", "\n\"a\n"})
    EXPECT_THAT(refusal_of(text), Not(HasSubstr("parse_error"))) << text;
  EXPECT_THAT(refusal_of("[]"), HasSubstr("one object"));
  EXPECT_THAT(refusal_of("{}"), HasSubstr("channels: is missing"));
  EXPECT_THAT(refusal_of("{\"channels\": []}"), HasSubstr("a list of 1 to 64 channels"));
  EXPECT_THAT(refusal_of("{\"channels\": [3]}"), HasSubstr("channels[0]: is 3"));
  EXPECT_THAT(refusal_of("{\"channels\": [{\"name\": \"a\", \"guard_px\": 99999999999999999999}]}"),
              HasSubstr("guard_px"));
  EXPECT_THAT(refusal_of("{\"channels\": [{\"name\": \"a\", \"yaw_deg\": 1e999}]}"),
              HasSubstr("a number that is too large"));
}

TEST(Rig, RefusesFilesItCannotUse) {
  EXPECT_THROW((void)load_rig("no/such/rig.json"), RigError);
  EXPECT_THROW((void)load_rig(std::filesystem::temp_directory_path()), RigError);
  const std::filesystem::path large = std::filesystem::path(testing::TempDir()) / "large_rig.json";
  std::ofstream(large) << std::string(2 << 20, ' ');
  EXPECT_THROW((void)load_rig(large), RigError);
  std::filesystem::remove(large);
}

std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += text;
  return result;
}

TEST(Rig, DeepNestingIsRefusedByItsKey) {
  for (const int depth : {9, 1000, 200'000}) {
    EXPECT_THAT(refusal_of(R"({"mount": )" + repeated("[", depth) + repeated("]", depth) + "}"),
                HasSubstr("mount: has brackets more than 8 deep"));
    EXPECT_THAT(refusal_of(R"({"channels": [{"name": "a", "colour": )" + repeated(R"({"x":)", depth)),
                HasSubstr("channels: has brackets more than 8 deep"));
  }
  EXPECT_THAT(refusal_of(repeated("[", 300'000)), HasSubstr("has brackets more than 8 deep"));
  EXPECT_THAT(refusal_of(R"({"mount": [[[[1]]]]})"), HasSubstr("mount: is [[[[1]]]]")) << "shallow ones are quoted";
}

TEST(Rig, MessagesAboutLongAndOddValuesAreShortAndPrintable) {
  const std::string report = refusal_of("{\"name\": \"" + std::string(500'000, 'x') + "\", \"a\x1b[31m\": \"\xff\"" +
                                        ", \"channels\": [{\"name\": \"a\"}]}");
  EXPECT_LT(report.size(), 1000U);
  EXPECT_EQ(report.find('\x1b'), std::string::npos);
  const std::string key = refusal_of("{\"a\\u001b[31m\": 1, \"channels\": [{\"name\": \"a\"}]}");
  EXPECT_THAT(key, HasSubstr("a\\x1b[31m: is not a field here"));
  std::string many = "{";
  for (int i = 0; i < 5000; ++i) many += "\"k" + std::to_string(i) + "\": 0, ";
  EXPECT_THAT(refusal_of(many + "\"channels\": [{\"name\": \"a\"}]}"), HasSubstr("and 4980 more faults"));
}

TEST(Rig, WhatIsNoFileIsRefused) {
  EXPECT_THROW((void)load_rig(testing::TempDir()), RigError);
  EXPECT_THROW((void)load_rig("/dev/zero"), RigError);
  EXPECT_THROW((void)load_rig(std::string(5000, 'a')), RigError);
}

}  // namespace
}  // namespace pelagos
