#include "text/characters.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>

namespace pelagos {
namespace {

using namespace std::string_view_literals;

/// A character that people meet in place of one of ASCII.
struct LookAlike {
  char32_t code;
  const char* name;
  const char* ascii;
};
constexpr std::array kLookAlikes = {
    LookAlike{0x00A0, "no-break space", " "},
    LookAlike{0x00AB, "guillemet", "\""},
    LookAlike{0x00AD, "soft hyphen", "-"},
    LookAlike{0x00B0, "degree sign", ""},
    LookAlike{0x00B4, "acute accent", "'"},
    LookAlike{0x00BB, "guillemet", "\""},
    LookAlike{0x00D7, "multiplication sign", "x"},
    LookAlike{0x2010, "hyphen", "-"},
    LookAlike{0x2011, "no-break hyphen", "-"},
    LookAlike{0x2012, "figure dash", "-"},
    LookAlike{0x2013, "en dash", "-"},
    LookAlike{0x2014, "em dash", "-"},
    LookAlike{0x2015, "horizontal bar", "-"},
    LookAlike{0x2018, "typographic quote", "'"},
    LookAlike{0x2019, "typographic quote", "'"},
    LookAlike{0x201A, "typographic quote", "'"},
    LookAlike{0x201B, "typographic quote", "'"},
    LookAlike{0x201C, "typographic quote", "\""},
    LookAlike{0x201D, "typographic quote", "\""},
    LookAlike{0x201E, "typographic quote", "\""},
    LookAlike{0x201F, "typographic quote", "\""},
    LookAlike{0x2028, "line separator", " "},
    LookAlike{0x2029, "paragraph separator", " "},
    LookAlike{0x202F, "narrow no-break space", " "},
    LookAlike{0x2032, "prime", "'"},
    LookAlike{0x2033, "double prime", "\""},
    LookAlike{0x2039, "guillemet", "'"},
    LookAlike{0x203A, "guillemet", "'"},
    LookAlike{0x2060, "word joiner", " "},
    LookAlike{0x2212, "minus sign", "-"},
    LookAlike{0x3000, "ideographic space", " "},
    LookAlike{0x3001, "ideographic comma", ","},
    LookAlike{0xFE63, "small hyphen-minus", "-"},
    LookAlike{0xFEFF, "byte order mark", " "},
};

const LookAlike* find_look_alike(char32_t code) {
  const auto* found =
      std::find_if(kLookAlikes.begin(), kLookAlikes.end(), [code](const LookAlike& one) { return one.code == code; });
  return found == kLookAlikes.end() ? nullptr : found;
}

bool is_wide_space(char32_t code) { return code >= 0x2000 && code <= 0x200B; }
bool is_full_width(char32_t code) { return code >= 0xFF01 && code <= 0xFF5E; }
bool is_invisible(char32_t code) {
  return code < 0x20 || (code >= 0x7F && code <= 0xA0) || code == 0xAD || is_wide_space(code) ||
         (code >= 0x200C && code <= 0x200F) || (code >= 0x2028 && code <= 0x202F) || code == 0x2060 || code == 0x3000 ||
         code == 0xFEFF;
}

std::string name_of(char32_t code) {
  if (const LookAlike* known = find_look_alike(code)) return known->name;
  if (code == 0x200B) return "zero-width space";
  if (is_wide_space(code)) return "typographic space";
  if (is_full_width(code)) return code >= 0xFF10 && code <= 0xFF19 ? "full-width digit" : "full-width character";
  if (code == 0) return "zero byte";
  if (code == '\r') return "carriage return";
  if (code == '\t') return "tab";
  if (code < 0x20 || code == 0x7F) return "control character";
  return "";
}

std::string number_of(char32_t code) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "U+%04X", static_cast<unsigned>(code));
  return text.data();
}

std::string encode(char32_t code) {
  const auto tail = [&](int shift) { return static_cast<char>(0x80 | ((code >> shift) & 0x3F)); };
  if (code < 0x80) return {static_cast<char>(code)};
  if (code < 0x800) return {static_cast<char>(0xC0 | (code >> 6)), tail(0)};
  if (code < 0x10000) return {static_cast<char>(0xE0 | (code >> 12)), tail(6), tail(0)};
  return {static_cast<char>(0xF0 | (code >> 18)), tail(12), tail(6), tail(0)};
}

/// Bytes of a character by its first one; 0 if none begins so.
std::size_t length_of(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return 2;
  if (first >= 0xE0 && first <= 0xEF) return 3;
  if (first >= 0xF0 && first <= 0xF4) return 4;
  return 0;
}

/// Zero bytes among the first ones whose place, modulo four, is `place`.
std::size_t zeros_at(std::string_view head, std::size_t place) {
  std::size_t count = 0;
  for (std::size_t i = place; i < head.size(); i += 4) count += head[i] == '\0' ? 1 : 0;
  return count;
}

}  // namespace

Character character_at(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::size_t length = length_of(byte(at));
  const Character invalid{byte(at), 1, false};
  if (length == 0 || at + length > text.size()) return invalid;
  if (length == 1) return {byte(at), 1, true};
  char32_t code = byte(at) & (0xFFu >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(at + i) & 0xC0u) != 0x80u) return invalid;
    code = (code << 6) | (byte(at + i) & 0x3Fu);
  }
  constexpr std::array<char32_t, 5> kLeast{0, 0, 0x80, 0x800, 0x10000};
  if (code < kLeast[length] || code > 0x10FFFF || (code >= 0xD800 && code <= 0xDFFF)) return invalid;
  return {code, length, true};
}

std::string describe_character(const Character& character) {
  if (!character.valid) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "byte 0x%02X, which is not UTF-8", static_cast<unsigned>(character.code));
    return text.data();
  }
  const std::string name = name_of(character.code);
  const std::string number = number_of(character.code);
  if (is_invisible(character.code)) return (name.empty() ? "invisible character" : name) + " (" + number + ")";
  return "\"" + encode(character.code) + "\" (" + (name.empty() ? "" : name + ", ") + number + ")";
}

std::string ascii_for(char32_t code) {
  if (const LookAlike* known = find_look_alike(code)) return known->ascii;
  if (is_wide_space(code)) return " ";
  if (is_full_width(code)) return {static_cast<char>(code - 0xFF01 + '!')};
  return "";
}

std::string advice_for(const Character& character) {
  if (!character.valid) return "save the file as UTF-8";
  const std::string ascii = ascii_for(character.code);
  if (ascii == " ") return "write an ordinary space, or nothing";
  if (!ascii.empty()) return "write " + ascii + " instead";
  return "take it out";
}

std::string foreign_encoding(std::string_view text) {
  if (text.starts_with("\xFF\xFE\0\0"sv)) return "UTF-32 (little-endian)";
  if (text.starts_with("\0\0\xFE\xFF"sv)) return "UTF-32 (big-endian)";
  if (text.starts_with("\xFF\xFE"sv)) return "UTF-16 (little-endian)";
  if (text.starts_with("\xFE\xFF"sv)) return "UTF-16 (big-endian)";
  const std::string_view head = text.substr(0, 256);
  const std::size_t quarter = head.size() / 4;
  if (quarter == 0) return "";
  std::array<std::size_t, 4> zeros{};
  for (std::size_t place = 0; place < 4; ++place) zeros[place] = zeros_at(head, place);
  const auto most = [&](std::size_t place) { return 2 * zeros[place] > quarter; };
  if (most(1) && most(2) && most(3) && !most(0)) return "UTF-32 (little-endian)";
  if (most(0) && most(1) && most(2) && !most(3)) return "UTF-32 (big-endian)";
  if (most(1) && most(3) && !most(0) && !most(2)) return "UTF-16 (little-endian)";
  if (most(0) && most(2) && !most(1) && !most(3)) return "UTF-16 (big-endian)";
  return "";
}

std::string_view without_byte_order_mark(std::string_view text) {
  return text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text;
}

}  // namespace pelagos
