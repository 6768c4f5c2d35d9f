#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "../support/places.hpp"
#include "channels/rig.hpp"

namespace pelagos {
namespace {

using testing::HasSubstr;

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
  EXPECT_THAT(refusal_of("{\"channels\": ["), HasSubstr("rig.json: not JSON"));
  EXPECT_THAT(refusal_of("[]"), HasSubstr("one object"));
  EXPECT_THAT(refusal_of("{}"), HasSubstr("channels: is missing"));
  EXPECT_THAT(refusal_of("{\"channels\": []}"), HasSubstr("a list of 1 to 64 channels"));
  EXPECT_THAT(refusal_of("{\"channels\": [3]}"), HasSubstr("channels[0]: is 3"));
  EXPECT_THAT(refusal_of("{\"channels\": [{\"name\": \"a\", \"guard_px\": 99999999999999999999}]}"),
              HasSubstr("guard_px"));
  EXPECT_THAT(refusal_of("{\"channels\": [{\"name\": \"a\", \"yaw_deg\": 1e999}]}"), HasSubstr("not JSON"));
}

TEST(Rig, RefusesFilesItCannotUse) {
  EXPECT_THROW((void)load_rig("no/such/rig.json"), RigError);
  EXPECT_THROW((void)load_rig(std::filesystem::temp_directory_path()), RigError);
  const std::filesystem::path large = std::filesystem::path(testing::TempDir()) / "large_rig.json";
  std::ofstream(large) << std::string(2 << 20, ' ');
  EXPECT_THROW((void)load_rig(large), RigError);
  std::filesystem::remove(large);
}

}  // namespace
}  // namespace pelagos
