#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "text/decimal.hpp"

namespace pelagos {

/// Decimal numbers with commas between them; nothing where one of them is no number.
[[nodiscard]] inline std::optional<std::vector<double>> read_numbers(const std::string& text) {
  std::vector<double> numbers;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t comma = std::min(text.find(',', from), text.size());
    const std::optional<double> number = read_decimal(text.substr(from, comma - from));
    if (!number) return std::nullopt;
    numbers.push_back(*number);
    from = comma + 1;
  }
  return numbers;
}

}  // namespace pelagos
