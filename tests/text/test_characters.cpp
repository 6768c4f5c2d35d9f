#include <gmock/gmock.h>

#include "text/characters.hpp"

namespace pelagos {
namespace {

using namespace std::string_literals;

Character first_of(const std::string& text) { return character_at(text, 0); }

TEST(Characters, AreReadAsUtf8) {
  EXPECT_EQ(first_of("a").code, U'a');
  EXPECT_EQ(first_of("ä").code, U'ä');
  EXPECT_EQ(first_of("ä").bytes, 2u);
  EXPECT_EQ(first_of("“").code, U'“');
  EXPECT_EQ(first_of("\xF0\x9F\x9A\xA2").code, U'\U0001F6A2');
  EXPECT_EQ(first_of("\xF0\x9F\x9A\xA2").bytes, 4u);
}

TEST(Characters, RefuseWhatIsNotUtf8) {
  for (const std::string text :
       {"\xE4", "\xC3", "\xC0\x80", "\xE0\x80\x80", "\xED\xA0\x80", "\xF5\x80\x80\x80", "\x80"}) {
    EXPECT_FALSE(first_of(text).valid) << testing::PrintToString(text);
    EXPECT_EQ(first_of(text).bytes, 1u);
  }
}

TEST(Characters, AreDescribedForPeople) {
  EXPECT_EQ(describe_character(first_of("−")), "\"−\" (minus sign, U+2212)");
  EXPECT_EQ(describe_character(first_of("\u00A0")), "no-break space (U+00A0)");
  EXPECT_EQ(describe_character(first_of("\xE4")), "byte 0xE4, which is not UTF-8");
  EXPECT_EQ(describe_character(first_of("ж")), "\"ж\" (U+0436)");
  EXPECT_EQ(describe_character(first_of("\x1B")), "control character (U+001B)");
}

TEST(Characters, OfOtherKeyboardsStandForAscii) {
  EXPECT_EQ(ascii_for(U'–'), "-");
  EXPECT_EQ(ascii_for(U'„'), "\"");
  EXPECT_EQ(ascii_for(U'’'), "'");
  EXPECT_EQ(ascii_for(U'５'), "5");
  EXPECT_EQ(ascii_for(U'\u2009'), " ");
  EXPECT_EQ(ascii_for(U'ä'), "");
}

TEST(Encodings, AreToldByMarksAndZeroBytes) {
  EXPECT_EQ(foreign_encoding("plain text, and “quotes”"), "");
  EXPECT_EQ(foreign_encoding(""), "");
  EXPECT_EQ(foreign_encoding("\xEF\xBB\xBFtext"), "");
  EXPECT_EQ(foreign_encoding("\xFF\xFEt\0"s), "UTF-16 (little-endian)");
  EXPECT_EQ(foreign_encoding("t\0e\0x\0t\0"s), "UTF-16 (little-endian)");
  EXPECT_EQ(foreign_encoding("\0t\0e\0x\0t"s), "UTF-16 (big-endian)");
  EXPECT_EQ(foreign_encoding("t\0\0\0e\0\0\0"s), "UTF-32 (little-endian)");
  EXPECT_EQ(foreign_encoding("text with one \0 byte"s), "");
}

}  // namespace
}  // namespace pelagos
