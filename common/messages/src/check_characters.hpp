#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "messages/field_reader.hpp"

namespace pelagos {

/// A text in Protobuf's text format as its parser is to see it.
struct CheckedText {
  std::string text;                  ///< as many lines and columns as the original, numbers without zeros in front
  std::optional<TextRefusal> fault;  ///< the first thing that the parser would read otherwise than it was meant
};

/// Walks a text outside of its comments and strings. Protobuf takes 010 as octal: here zeros in front are taken out, so
/// that it is ten. What people of other keyboards, languages and editors write is refused where it stands, with the
/// character and what to write instead: foreign encodings, typographic quotes and dashes, invisible spaces, decimal
/// commas, units behind numbers. Protobuf's own messages blame what follows, often on the next line.
[[nodiscard]] CheckedText check_characters(std::string_view text);

}  // namespace pelagos
