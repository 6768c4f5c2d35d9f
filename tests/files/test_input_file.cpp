#include <gmock/gmock.h>

#include "files/input_file.hpp"
#include "folder.hpp"

namespace pelagos {
namespace {

TEST(InputFile, HoldsAllBytes) {
  const test::Folder folder;
  const std::string bytes("a\0b\n\xff", 5);
  test::write_all_of(folder / "a.state", bytes);
  const InputFile file = read_input_file(folder / "a.state", "state", 5);
  EXPECT_EQ(file.bytes, bytes);
  EXPECT_EQ(file.fault, "");
}

TEST(InputFile, OfMoreThanIsAllowedGivesOneByteMore) {
  const test::Folder folder;
  test::write_all_of(folder / "a.scene", std::string(200'000, 'x'));
  EXPECT_EQ(read_input_file(folder / "a.scene", "scene", 100'000).bytes.size(), 100'001U);
}

TEST(InputFile, SaysWhyThereIsNone) {
  const test::Folder folder;
  EXPECT_EQ(read_input_file(folder / "none", "scene", 10).fault, "no such scene file");
  EXPECT_EQ(read_input_file(folder / "", "command log", 10).fault, "is a folder; a command log file is needed");
}

}  // namespace
}  // namespace pelagos
