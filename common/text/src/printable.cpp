#include "text/printable.hpp"

#include <array>
#include <cstdint>
#include <cstdio>

#include "text/characters.hpp"

namespace pelagos {
namespace {

bool is_hidden(char32_t code) {
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0xAD || code == 0x61C ||
         (code >= 0x200B && code <= 0x200F) || (code >= 0x2028 && code <= 0x202E) ||
         (code >= 0x2060 && code <= 0x206F) || code == 0xFEFF || (code >= 0xFFF9 && code <= 0xFFFB) || code >= 0xE0000;
}

std::string escape(char32_t code) {
  if (code == '\n') return "\\n";
  if (code == '\r') return "\\r";
  if (code == '\t') return "\\t";
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(),
                code < 0x80     ? "\\x%02x"
                : code > 0xFFFF ? "\\U%08x"
                                : "\\u%04x",
                static_cast<unsigned>(code));
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
    const Character next = character_at(text, 0);
    const bool kept = next.valid && (!is_hidden(next.code) || (keep_lines && next.code == '\n'));
    const std::size_t bytes = next.valid ? next.bytes : 1;
    if (kept) {
      result += text.substr(0, bytes);
    } else {
      result += !next.valid ? escape_byte(text.front()) : escape(next.code);
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
