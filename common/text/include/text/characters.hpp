#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace pelagos {

/// One character of a text in UTF-8.
struct Character {
  char32_t code = 0;      ///< Unicode code point; the byte itself where the bytes are not UTF-8
  std::size_t bytes = 1;  ///< that it takes
  bool valid = true;      ///< false: the byte here is not the start of a character in UTF-8
};
/// The character at a byte of the text. @param at  less than text.size()
[[nodiscard]] Character character_at(std::string_view text, std::size_t at);

/// A character for people: its glyph where it has one, its name where it is a usual mistake, its number, e.g.
/// "−" (minus sign, U+2212).
[[nodiscard]] std::string describe_character(const Character& character);

/// The ASCII text that was most likely meant by a typographic, full-width or invisible character; empty if none is
/// known. A space means that it stands for a space.
[[nodiscard]] std::string ascii_for(char32_t code);

/// What to do about a character that does not belong where it stands, e.g.: write - instead.
[[nodiscard]] std::string advice_for(const Character& character);

/// The name of an encoding that the text is in instead of UTF-8, by its byte order mark or its zero bytes, e.g.
/// "UTF-16 (little-endian)"; empty if it may be UTF-8.
[[nodiscard]] std::string foreign_encoding(std::string_view text);

/// The text behind the byte order mark of UTF-8, where it has one.
[[nodiscard]] std::string_view without_byte_order_mark(std::string_view text);

}  // namespace pelagos
