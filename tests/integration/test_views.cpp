// The sheet of views, deploy/views. The whole of it takes minutes: here its arguments and how the pictures are put
// together.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stb/stb_image.h>

#include "../support/places.hpp"
#include "running_program.hpp"

namespace pelagos {
namespace {

using std::chrono::seconds;
using testing::HasSubstr;

TEST(Views, RefusesWrongArguments) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"--size", "63x36"}, "--size is 63x36; allowed: WIDTHxHEIGHT, 64x36 to 1920x1080"},
      {{"--size", "640"}, "--size is 640; allowed"},
      {{"--quality", "best"}, "--quality is best; allowed: low, medium, high"},
      {{"--sise", "640x360"}, "unknown argument --sise; did you mean --size?"},
      {{"--out"}, "--out needs a value"},
  };
  for (const auto& [arguments, words] : wrong) {
    std::vector<std::string> command = {test::source_path("deploy/views")};
    command.insert(command.end(), arguments.begin(), arguments.end());
    RunningProgram run(command);
    EXPECT_EQ(run.wait(seconds(20)), 2);
    EXPECT_THAT(run.errors(), HasSubstr(words));
  }
}

TEST(Views, PutsPicturesIntoOneSheet) {
  const TemporaryFolder folder;
  const std::string sheet = (folder.path() / "sheet.png").string();
  const std::string picture = test::source_path("docs/images/under_way.png");
  const std::string tool = test::source_path("deploy/lib/contact_sheet.py");
  RunningProgram run({tool, sheet, "2", "64", "36", "first=" + picture, "second=" + picture, "night: left out="});
  ASSERT_EQ(run.wait(seconds(20)), 0) << run.errors();
  int width = 0, height = 0, channels = 0;
  unsigned char* rgb = stbi_load(sheet.c_str(), &width, &height, &channels, 3);
  ASSERT_NE(rgb, nullptr);
  EXPECT_EQ(width, 2 * 64);
  EXPECT_EQ(height, 2 * (36 + 16)) << "two rows, each with its caption";
  const auto at = [&](int x, int y) { return rgb + 3 * (y * width + x); };
  for (int x = 0; x < 64; ++x)
    for (int k = 0; k < 3; ++k) ASSERT_EQ(at(x, 10)[k], at(x + 64, 10)[k]) << "both tiles are the same picture";
  EXPECT_EQ(at(10, 60)[0], 110) << "what is left out is grey";
  stbi_image_free(rgb);

  RunningProgram missing({tool, sheet, "2", "64", "36", "first=no_such.png"});
  EXPECT_EQ(missing.wait(seconds(20)), 1);
  EXPECT_THAT(missing.errors(), HasSubstr("no_such.png"));
}

}  // namespace
}  // namespace pelagos
