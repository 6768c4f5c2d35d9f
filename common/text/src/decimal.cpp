#include "text/decimal.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "text/characters.hpp"

namespace pelagos {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_sign(char c) { return c == '-' || c == '+'; }

std::size_t skip_digits(std::string_view text, std::size_t at) {
  while (at < text.size() && is_digit(text[at])) ++at;
  return at;
}

/// Where a number that begins at the start of the text ends: sign, digits, point, exponent; 0 if none begins there.
std::size_t end_of_number(std::string_view text) {
  const std::size_t first = !text.empty() && is_sign(text[0]) ? 1 : 0;
  std::size_t at = skip_digits(text, first);
  std::size_t digits = at - first;
  if (at < text.size() && text[at] == '.') {
    const std::size_t end = skip_digits(text, at + 1);
    digits += end - at - 1;
    if (digits > 0) at = end;
  }
  if (digits == 0) return 0;
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    const std::size_t sign = at + 1 < text.size() && is_sign(text[at + 1]) ? 1 : 0;
    const std::size_t end = skip_digits(text, at + 1 + sign);
    if (end > at + 1 + sign) at = end;
  }
  return at;
}

bool is_hexadecimal(std::string_view text) {
  if (!text.empty() && is_sign(text[0])) text.remove_prefix(1);
  return text.size() > 2 && text[0] == '0' && (text[1] == 'x' || text[1] == 'X');
}

bool is_no_number(std::string_view text) {
  if (!text.empty() && is_sign(text[0])) text.remove_prefix(1);
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](char c) { return is_letter(c) ? char(c | 0x20) : c; });
  return lower == "nan" || lower == "inf" || lower == "infinity";
}

std::string with_point(std::string_view text) {
  std::string point(text);
  std::replace(point.begin(), point.end(), ',', '.');
  return point;
}

/// The first character that is not of ASCII, told with what to write instead; empty if there is none.
std::string foreign_character(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const Character character = character_at(text, i);
    if (character.code >= 0x20 && character.code < 0x7F && character.valid) continue;
    return "the character " + describe_character(character) + "; " + advice_for(character);
  }
  return "";
}

/// What is wrong with what follows the number.
std::string fault_of_rest(std::string_view text, std::size_t end, NumberKind kind) {
  const std::string number(text.substr(0, end)), rest(text.substr(end));
  if (rest[0] == ',' && rest.size() > 1 && std::all_of(rest.begin() + 1, rest.end(), is_digit))
    return kind == NumberKind::kReal ? "a decimal comma; write " + with_point(text) : "not a whole number";
  return "\"" + rest + "\" follows the number; write " + number;
}

}  // namespace

std::string fault_of_number(std::string_view text, NumberKind kind) {
  if (text.empty()) return "empty";
  if (is_no_number(text)) return "not finite";
  if (is_hexadecimal(text)) return "hexadecimal";
  if (std::string fault = foreign_character(text); !fault.empty()) return fault;
  const std::size_t end = end_of_number(text);
  if (end == 0) return "no number";
  if (end < text.size()) return fault_of_rest(text, end, kind);
  if (kind != NumberKind::kReal && text.find_first_of(".eE") != std::string_view::npos) return "not a whole number";
  if (kind == NumberKind::kNotNegative && text[0] == '-' && text.find_first_of("123456789") != std::string_view::npos)
    return "negative";
  return "";
}

std::string without_leading_zeros(std::string_view text) {
  std::string sign;
  if (!text.empty() && is_sign(text[0])) {
    if (text[0] == '-') sign = "-";
    text.remove_prefix(1);
  }
  while (text.size() > 1 && text[0] == '0' && is_digit(text[1])) text.remove_prefix(1);
  return sign + std::string(text);
}

std::optional<double> read_decimal(std::string_view text) {
  if (!fault_of_number(text, NumberKind::kReal).empty()) return std::nullopt;
  if (text[0] == '+') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range && text.find('-', 1) != std::string_view::npos) return 0.0;  // 1e-999
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace pelagos
