#pragma once

#include <string>

#include "messages/field_reader.hpp"

namespace pelagos {

/// An option's help with the limits that the server holds it to: "At the surface, m/s (0 to 10)".
/// @param otherwise  what holds where it is left out, e.g. "0.5"; empty: nothing
[[nodiscard]] inline std::string help_with(const std::string& text, const Range& range,
                                           const std::string& otherwise = "") {
  return text + " (" + format_number(range.min) + " to " + format_number(range.max) +
         (otherwise.empty() ? "" : "; else " + otherwise) + ")";
}

}  // namespace pelagos
