#include "text/printable.hpp"

#include <gtest/gtest.h>

namespace pelagos {
namespace {

TEST(Printable, LettersOfAllScriptsStay) {
  for (const char* text : {"quay", "Schlüßel 3 m³", "Ærøskøbing", "Πειραιάς", "横浜 港", "🚢"})
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, ControlCharactersAreShown) {
  EXPECT_EQ(printable("a\x1b[31mred\x07"), "a\\x1b[31mred\\x07");
  EXPECT_EQ(printable("one\ntwo\r\t"), "one\\ntwo\\r\\t");
  EXPECT_EQ(printable(std::string("nul\0end", 7)), "nul\\x00end");
  EXPECT_EQ(printable("\x7f"), "\\x7f");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\u009b31m")
      << "the control sequence of eight bits";
  EXPECT_EQ(printable("abc\xe2\x80\xae"
                      "cba"),
            "abc\\u202ecba")
      << "turns the direction of writing";
  EXPECT_EQ(printable("\xf3\xa0\x81\x81"), "\\U000e0041") << "a tag, which is invisible";
}

TEST(Printable, BytesThatAreNoTextAreShown) {
  EXPECT_EQ(printable("\xff\xfe"), "\\xff\\xfe");
  EXPECT_EQ(printable("\xc0\xaf"), "\\xc0\\xaf") << "an overlong slash";
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "half a surrogate pair";
  EXPECT_EQ(printable("a\xe2\x82"), "a\\xe2\\x82") << "cut off";
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80") << "beyond the last character";
}

TEST(Printable, LongTextIsCut) {
  EXPECT_EQ(printable("abcdef", 6), "abcdef");
  EXPECT_EQ(printable("abcdefg", 6), "abc...");
  EXPECT_LE(printable(std::string(5000, '\x1b'), 100).size(), 100U);
  EXPECT_EQ(printable("ääää", 7), "ää...") << "between characters";
}

TEST(Printable, LinesStayWhereAsked) { EXPECT_EQ(printable_lines("one\ntwo\x1b"), "one\ntwo\\x1b"); }

}  // namespace
}  // namespace pelagos
