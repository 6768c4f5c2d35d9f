#include "text/printable.hpp"

#include <array>
#include <cstdint>
#include <cstdio>

namespace pelagos {
namespace {

/// One character of UTF-8 at the start of a text.
struct Character {
  std::uint32_t code = 0;
  std::size_t bytes = 0;  ///< 0: no valid UTF-8
};

/// Well-formed sequences only (Unicode 15, table 3-7): no overlong ones, no surrogates, at most U+10FFFF.
Character read_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint8_t first = byte(0);
  if (first < 0x80) return {first, 1};
  const std::size_t bytes = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < bytes) return {};
  std::uint32_t code = first & (0x7Fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0u) != 0x80u) return {};
    code = code << 6 | (byte(i) & 0x3Fu);
  }
  constexpr std::array<std::uint32_t, 5> kLeast = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  return code < kLeast[bytes] || surrogate || code > 0x10FFFF ? Character{} : Character{code, bytes};
}

bool is_hidden(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0xAD || code == 0x61C ||
         (code >= 0x200B && code <= 0x200F) || (code >= 0x2028 && code <= 0x202E) ||
         (code >= 0x2060 && code <= 0x206F) || code == 0xFEFF || (code >= 0xFFF9 && code <= 0xFFFB) || code >= 0xE0000;
}

std::string escape(std::uint32_t code) {
  if (code == '\n') return "\\n";
  if (code == '\r') return "\\r";
  if (code == '\t') return "\\t";
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), code < 0x80 ? "\\x%02x" : code > 0xFFFF ? "\\U%08x" : "\\u%04x", code);
  return text.data();
}

std::string escape_byte(char byte) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "\\x%02x", static_cast<unsigned>(static_cast<std::uint8_t>(byte)));
  return text.data();
}

std::string show(std::string_view text, std::size_t most, bool keep_lines) {
  constexpr std::string_view kCut = "...";
  std::string result;
  std::size_t with_cut = 0;  // so much of the result leaves room for the dots
  while (!text.empty()) {
    const Character next = read_character(text);
    const bool kept = next.bytes > 0 && (!is_hidden(next.code) || (keep_lines && next.code == '\n'));
    const std::size_t bytes = next.bytes > 0 ? next.bytes : 1;
    if (kept) {
      result += text.substr(0, bytes);
    } else {
      result += next.bytes == 0 ? escape_byte(text.front()) : escape(next.code);
    }
    if (result.size() > most) return result.substr(0, with_cut) + std::string(kCut.substr(0, most - with_cut));
    if (result.size() + kCut.size() <= most) with_cut = result.size();
    text.remove_prefix(bytes);
  }
  return result;
}

}  // namespace

std::string printable(std::string_view text, std::size_t most) { return show(text, most, false); }
std::string printable_lines(std::string_view text, std::size_t most) { return show(text, most, true); }

}  // namespace pelagos
