#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace pelagos {

/// Text that came from somebody else, as it may be shown on a terminal, in a log, a window or a picture. Letters of all
/// scripts stay. Written as escapes are: control characters ("\n", "\x1b", "\u009b"), bytes that are no UTF-8 ("\xff"),
/// and the invisible characters that turn the direction of writing or join lines ("\u202e").
/// @param most  bytes of the result; longer text is cut and ends in "..."
[[nodiscard]] std::string printable(std::string_view text, std::size_t most = 1024);

/// The same, but line breaks stay: for our own messages of several lines that quote others.
[[nodiscard]] std::string printable_lines(std::string_view text, std::size_t most = 65536);

}  // namespace pelagos
