#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace pelagos {

/// Decimal numbers as people write them: sign, digits, point, exponent. Zeros in front change nothing: 010 is ten.
enum class NumberKind { kWhole, kNotNegative, kReal };  ///< 5 and -5; 5; 5, -5, 0.5, 5e-1

/// Why a text is no number of that kind, and what to write instead; empty if it is one. A few words to stand in
/// brackets behind the text, e.g.: 0,5 (a decimal comma; write 0.5).
[[nodiscard]] std::string fault_of_number(std::string_view text, NumberKind kind);

/// The same number without zeros in front, for readers that take those as octal. @param text  without a fault
[[nodiscard]] std::string without_leading_zeros(std::string_view text);

/// The value of a decimal number; nothing if the text is none, or is too large for a double.
[[nodiscard]] std::optional<double> read_decimal(std::string_view text);

}  // namespace pelagos
