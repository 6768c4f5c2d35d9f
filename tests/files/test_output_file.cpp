#include <gmock/gmock.h>
#include <unistd.h>

#include "files/output_file.hpp"
#include "folder.hpp"

namespace pelagos {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator{}));
}

TEST(OutputFile, IsTriedWithoutTouchingWhatIsThere) {
  const test::Folder folder;
  EXPECT_EQ(fault_of_output_file(folder / "new.json"), "");
  EXPECT_EQ(files_in(folder.path), 0u);
  test::write_all_of(folder / "old.json", "old");
  EXPECT_EQ(fault_of_output_file(folder / "old.json"), "");
  EXPECT_EQ(test::read_all_of(folder / "old.json"), "old");
  EXPECT_EQ(fault_of_output_file("/dev/null"), "");
}

TEST(OutputFile, SaysWhyItCouldNotBeWritten) {
  const test::Folder folder;
  EXPECT_THAT(fault_of_output_file(folder / "missing/a.json"), HasSubstr("missing; make it first"));
  EXPECT_THAT(fault_of_output_file(folder.path), HasSubstr("is a folder"));
  test::write_all_of(folder / "file", "x");
  EXPECT_THAT(fault_of_output_file(folder / "file/a.json"), HasSubstr("is no folder"));
  EXPECT_THAT(fault_of_output_file(""), HasSubstr("is empty"));
  const test::FullDisk full(100);
  EXPECT_THAT(fault_of_output_file(folder / "a.json"), HasSubstr("cannot be written: File too large; make room"));
  EXPECT_EQ(files_in(folder.path), 1u);
}

TEST(OutputFile, IsRefusedInAFolderThatMayNotBeWritten) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  const test::Folder folder;
  fs::permissions(folder.path, fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THAT(fault_of_output_file(folder / "a.json"), HasSubstr("Permission denied"));
  fs::permissions(folder.path, fs::perms::owner_all);
}

TEST(OutputFolder, IsMadeAndTried) {
  const test::Folder folder;
  EXPECT_EQ(fault_of_output_folder(folder / "a/b"), "");
  EXPECT_TRUE(fs::is_directory(folder / "a/b"));
  EXPECT_EQ(files_in(folder / "a/b"), 0u);
  test::write_all_of(folder / "file", "x");
  EXPECT_THAT(fault_of_output_folder(folder / "file"), HasSubstr("is a file"));
  EXPECT_THAT(fault_of_output_folder("/proc/a"), HasSubstr("cannot be made"));
}

TEST(WholeFile, ReplacesTheOldOneOrLeavesIt) {
  const test::Folder folder;
  const fs::path file = folder / "a.json";
  EXPECT_EQ(write_whole_file(file, "first"), "");
  EXPECT_EQ(write_whole_file(file, "second"), "");
  EXPECT_EQ(test::read_all_of(file), "second");
  {
    const test::FullDisk full(100);
    EXPECT_THAT(write_whole_file(file, std::string(1000, 'x')), HasSubstr("a.json: File too large"));
  }
  EXPECT_EQ(test::read_all_of(file), "second");
  EXPECT_EQ(files_in(folder.path), 1u);
}

TEST(WholeFile, WritesDevicesAndLinksWhereTheyAre) {
  const test::Folder folder;
  EXPECT_EQ(write_whole_file("/dev/null", "x"), "");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_THAT(write_whole_file("/dev/full", "x"), HasSubstr("No space left on device"));
  test::write_all_of(folder / "real", "old");
  fs::create_symlink(folder / "real", folder / "link");
  EXPECT_EQ(write_whole_file(folder / "link", "new"), "");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(test::read_all_of(folder / "real"), "new");
}

}  // namespace
}  // namespace pelagos
