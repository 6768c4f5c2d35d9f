// The whole chain, as deploy/demo runs it: server, bridge, three channels, instructor.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stb/stb_image.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>

#include "../support/places.hpp"
#include "running_program.hpp"

namespace pelagos {
namespace {

using nlohmann::json;
using std::chrono::seconds;
using testing::AnyOf;
using testing::HasSubstr;

/// The script with the programs of the build under test.
class Demo : public testing::Test {
 protected:
  Demo() { setenv("PELAGOS_BIN", test::build_path("bin").c_str(), 1); }
  const std::string demo_ = test::source_path("deploy/demo");
};

/// A finished demo takes its seconds, the start of the server and the last pictures; this is for a machine with other
/// work.
constexpr seconds kPatience{240};

struct Pixels {
  int width = 0, height = 0;
  std::map<std::uint32_t, int> colours;  ///< how many pixels have each
};

/// Decodes the whole file; a size of 0 if it is not a picture.
Pixels decode(const std::filesystem::path& file) {
  Pixels pixels;
  int channels = 0;
  unsigned char* data = stbi_load(file.c_str(), &pixels.width, &pixels.height, &channels, 3);
  if (data == nullptr) return {};
  for (int i = 0; i < pixels.width * pixels.height; ++i) {
    const unsigned char* p = data + 3 * i;
    ++pixels.colours[std::uint32_t{p[0]} << 16 | std::uint32_t{p[1]} << 8 | p[2]];
  }
  stbi_image_free(data);
  return pixels;
}

/// Sky, sea and ship make thousands of colours; a picture that failed is of one, or nearly.
void expect_a_view(const std::filesystem::path& file, int width, int height) {
  SCOPED_TRACE(file.string());
  const Pixels pixels = decode(file);
  ASSERT_EQ(pixels.width, width);
  ASSERT_EQ(pixels.height, height);
  int commonest = 0;
  for (const auto& [colour, count] : pixels.colours) commonest = std::max(commonest, count);
  EXPECT_GT(pixels.colours.size(), 500U);
  EXPECT_LT(commonest, width * height / 2);
}

void expect_positive(const json& object, const char* place) {
  const json::json_pointer pointer(place);
  ASSERT_TRUE(object.contains(pointer)) << place;
  ASSERT_TRUE(object.at(pointer).is_number()) << place;
  EXPECT_GT(object.at(pointer).get<double>(), 0.0) << place;
}

void check_server(const json& summary) {
  for (const char* place :
       {"/particles", "/speed/real_time_factor", "/speed/achievable_real_time_factor", "/speed/step_ms_mean",
        "/error/density_error_mean", "/error/density_error_peak", "/transport/frames_published",
        "/transport/published_particles_last_frame", "/transport/handover_us_mean", "/transport/poses_accepted"}) {
    expect_positive(summary.at("server"), place);
  }
  EXPECT_EQ(summary.at("server").at("boundary_particles"), 0) << "the demo's ship has a distance field";
  const json& transport = summary.at("server").at("transport");
  EXPECT_TRUE(transport.contains("frames_dropped"));
  EXPECT_EQ(transport.at("poses_refused"), 0);
  EXPECT_THAT(transport.at("bytes_per_particle").get<double>(), testing::AllOf(testing::Ge(16.0), testing::Le(20.5)));
  // A step whose density is off by more than a tenth has lost the water.
  EXPECT_LT(summary.at("server").at("error").at("density_error_peak").get<double>(), 0.1);
}

void check_viewers(const json& summary) {
  ASSERT_EQ(summary.at("viewers").size(), 4U);  // the three channels and the camera at the quarter
  for (const json& viewer : summary.at("viewers")) {
    SCOPED_TRACE(viewer.at("channel").get<std::string>());
    EXPECT_EQ(viewer.at("scene"), "open_sea");
    for (const char* place : {"/frames_drawn", "/frame_ms_mean", "/pictures_written"}) expect_positive(viewer, place);
    // Without a number where every frame took longer than 2 s, as on a machine that gives an idle channel no time.
    ASSERT_TRUE(viewer.contains("latency_ms"));
    if (!viewer.at("latency_ms").is_null()) expect_positive(viewer, "/latency_ms/mean");
    EXPECT_TRUE(viewer.contains("gaps"));
    EXPECT_EQ(viewer.at("frames_refused"), 0);
    EXPECT_EQ(viewer.at("errors").size(), 0U);
  }
}

void check_control(const json& control) {
  const double before = control.at("wind_before").at("speed");
  const double after = control.at("wind_after").at("speed");
  EXPECT_GT(after, before + 1.0);  // Beaufort 5 is about 9 m/s, 7 about 16
  EXPECT_GT(control.at("status_after").at("frame"), control.at("status_before").at("frame"));
}

TEST_F(Demo, LeavesPicturesOfAllChannelsAndASummary) {
  const TemporaryFolder folder;
  RunningProgram demo({demo_, "--no-build", "--seconds", "6", "--out", folder.path().string()});
  ASSERT_EQ(demo.wait(kPatience), 0) << demo.output() << demo.errors();

  const json summary = json::parse(read_text(folder.path() / "summary.json"));
  EXPECT_EQ(summary.at("scene"), "open_sea");
  // A machine with other work may be too slow for the sea or lose frames: nothing else may be wrong.
  for (const std::string fault : summary.at("faults"))
    EXPECT_THAT(fault, AnyOf(HasSubstr("of real time"), HasSubstr("frames")));
  expect_positive(summary, "/machine/cores");
  check_server(summary);
  check_viewers(summary);
  check_control(summary.at("control"));
  expect_positive(summary, "/bridge/poses_sent");
  EXPECT_EQ(summary.at("pictures").size(), 4U);
  for (const char* name : {"port.png", "centre.png", "starboard.png"}) expect_a_view(folder.path() / name, 640, 360);
  expect_a_view(folder.path() / "quarter.png", 1280, 720);
  EXPECT_THAT(demo.output(), HasSubstr("summary.json"));
}

TEST_F(Demo, SaysThatTheSceneIsMissing) {
  const TemporaryFolder folder;
  RunningProgram demo({demo_, "--no-build", "--scene", "/nowhere/a.scene", "--out", folder.path().string()});
  EXPECT_EQ(demo.wait(kPatience), 1);
  EXPECT_THAT(demo.errors(), HasSubstr("/nowhere/a.scene"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "summary.json"));
}

TEST_F(Demo, SaysWhichProgramFailedAndWhy) {
  const TemporaryFolder folder;
  const std::filesystem::path scene = folder.path() / "broken.scene";
  std::ofstream(scene) << "name: \"broken\"\nparticle_spacing: -1\n";
  RunningProgram demo({demo_, "--no-build", "--scene", scene.string(), "--out", folder.path().string()});
  EXPECT_EQ(demo.wait(kPatience), 1);
  EXPECT_THAT(demo.errors(), HasSubstr("particle_spacing"));  // the server's own words
  EXPECT_THAT(demo.errors(), HasSubstr("server failed with exit code"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "summary.json"));
}

TEST_F(Demo, SaysThatTheResultsCannotBeWritten) {
  RunningProgram demo({demo_, "--no-build", "--out", "/proc/pelagos"});  // takes no folders, from root neither
  EXPECT_EQ(demo.wait(kPatience), 1);
  EXPECT_THAT(demo.errors(), HasSubstr("/proc/pelagos"));
}

TEST_F(Demo, RefusesWrongArguments) {
  for (const std::vector<std::string>& wrong : std::vector<std::vector<std::string>>{
           {"--seconds", "0"}, {"--seconds", "-5"}, {"--seconds", "soon"}, {"--seconds"}, {"--unknown"}}) {
    std::vector<std::string> arguments = {demo_, "--no-build"};
    arguments.insert(arguments.end(), wrong.begin(), wrong.end());
    RunningProgram demo(arguments);
    EXPECT_EQ(demo.wait(kPatience), 2) << wrong.back();
    EXPECT_THAT(demo.errors(), HasSubstr(wrong.back()));
  }
}

}  // namespace
}  // namespace pelagos
