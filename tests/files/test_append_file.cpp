#include <gmock/gmock.h>

#include "files/append_file.hpp"
#include "folder.hpp"

namespace pelagos {
namespace {

using testing::HasSubstr;

TEST(AppendFile, WritesEachLineAtOnce) {
  const test::Folder folder;
  AppendFile file(folder / "a.log");
  file.append("one");
  EXPECT_EQ(test::read_all_of(folder / "a.log"), "one\n");
  file.append("two");
  EXPECT_EQ(test::read_all_of(folder / "a.log"), "one\ntwo\n");
  EXPECT_EQ(file.fault(), "");
}

TEST(AppendFile, NeverTouchesAFileThatHoldsSomething) {
  const test::Folder folder;
  for (int k = 0; k < 3; ++k) AppendFile(folder / "a.log").append("run " + std::to_string(k));
  EXPECT_EQ(test::read_all_of(folder / "a.log"), "run 0\n");
  EXPECT_EQ(test::read_all_of(folder / "a.log.1"), "run 1\n");
  EXPECT_EQ(test::read_all_of(folder / "a.log.2"), "run 2\n");
  EXPECT_EQ(AppendFile(folder / "a.log").file(), folder / "a.log.3");
}

TEST(AppendFile, TakesAnEmptyFileThatIsNobodys) {
  const test::Folder folder;
  test::write_all_of(folder / "a.log", "");
  AppendFile first(folder / "a.log");
  EXPECT_EQ(first.file(), folder / "a.log");
  const AppendFile second(folder / "a.log");  // the first has written nothing yet
  EXPECT_EQ(second.file(), folder / "a.log.1");
}

TEST(AppendFile, KeepsWhatTheDiskHasNoRoomFor) {
  const test::Folder folder;
  AppendFile file(folder / "a.log");
  {
    const test::FullDisk full(6);
    file.append("one");
    EXPECT_EQ(file.fault(), "");
    file.append("two");
    EXPECT_THAT(file.fault(), HasSubstr("File too large"));
    file.append("three");
    EXPECT_EQ(file.waiting_lines(), 2u);
    file.flush();
    EXPECT_EQ(file.waiting_lines(), 2u);
  }
  file.flush();
  EXPECT_EQ(file.fault(), "");
  EXPECT_EQ(file.waiting_lines(), 0u);
  file.append("four");
  EXPECT_EQ(test::read_all_of(folder / "a.log"), "one\ntwo\nthree\nfour\n");
}

TEST(AppendFile, EndsWhereMemoryEnds) {
  const test::Folder folder;
  AppendFile file(folder / "a.log");
  {
    const test::FullDisk full(0);
    for (int k = 0; k < 3; ++k) file.append(std::string(std::size_t{9} << 20, 'x'));
    EXPECT_EQ(file.lost_lines(), 2u);
  }
  file.append("more");
  EXPECT_EQ(file.lost_lines(), 3u);
  EXPECT_NE(file.fault(), "");
  EXPECT_EQ(std::filesystem::file_size(folder / "a.log"), (std::size_t{9} << 20) + 1);
}

TEST(AppendFile, SaysWhatFailed) {
  EXPECT_THAT(AppendFile("/nowhere/a.log").fault(), HasSubstr("No such file"));
  AppendFile full("/dev/full");
  EXPECT_EQ(full.fault(), "");
  full.append("one");
  EXPECT_THAT(full.fault(), HasSubstr("No space left on device"));
}

}  // namespace
}  // namespace pelagos
