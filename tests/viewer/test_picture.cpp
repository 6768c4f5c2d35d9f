#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>

#include "renderer/picture.hpp"

namespace pelagos {
namespace {

std::filesystem::path temporary(const char* name) { return std::filesystem::path(testing::TempDir()) / name; }

TEST(Picture, IsWrittenAsPng) {
  Picture picture(5, 3);
  picture.at(2, 1)[0] = 200;
  const auto file = temporary("picture_test.png");
  write_png(picture, file);
  std::ifstream in(file, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), {});
  ASSERT_GT(bytes.size(), 33u);
  EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(bytes.substr(16, 8), std::string("\0\0\0\5\0\0\0\3", 8)) << "width and height, big-endian";
  EXPECT_FALSE(std::filesystem::exists(file.string() + ".part"));
  std::filesystem::remove(file);
}

TEST(Picture, SaysWhyAFileCannotBeWritten) {
  const auto no_folder = temporary("picture_test_file");
  std::ofstream(no_folder) << "a file, not a folder";
  try {
    write_png(Picture(2, 2), no_folder / "a.png");
    FAIL() << "written into a file";
  } catch (const OutputError& error) {
    EXPECT_NE(std::string(error.what()).find("Not a directory"), std::string::npos) << error.what();
  }
  std::filesystem::remove(no_folder);
}

TEST(Picture, LeavesNothingBehindWhenThereIsNoRoom) {
  // a limit on the size of files stands for a full disk
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, SIG_IGN);
  const auto file = temporary("picture_no_room");
  rlimit small = before;
  small.rlim_cur = 1000;
  setrlimit(RLIMIT_FSIZE, &small);
  std::string message = "written";
  try {
    write_file(file, std::string(100'000, 'x'));
  } catch (const OutputError& error) {
    message = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, SIG_DFL);
  EXPECT_NE(message.find("cannot write"), std::string::npos) << message;
  EXPECT_FALSE(std::filesystem::exists(file));
  EXPECT_FALSE(std::filesystem::exists(file.string() + ".part"));
}

TEST(Picture, BannerDarkensTheLowerEdgeAndWrites) {
  Picture picture(200, 60);
  std::fill(picture.rgb.begin(), picture.rgb.end(), std::uint8_t{120});
  draw_banner(picture, "NO SERVER");
  EXPECT_EQ(picture.at(0, 0)[0], 120);
  EXPECT_EQ(picture.at(199, 59)[0], 30);
  int bright = 0;
  for (const std::uint8_t value : picture.rgb) bright += value > 200;
  EXPECT_GT(bright, 300);
  Picture tiny(8, 4);
  draw_banner(tiny, "much longer than the picture is wide");  // must stay inside
}

}  // namespace
}  // namespace pelagos
