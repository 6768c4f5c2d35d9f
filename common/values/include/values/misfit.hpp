#pragma once

#include <string>

namespace pelagos {

/// Why a command, well-formed by itself, does not fit where it is given.
struct Misfit {
  std::string field;  ///< of the command's message, e.g. "from"; empty: the command as a whole
  std::string what;   ///< the value and what is allowed
};

/// On one line: field and what.
[[nodiscard]] std::string to_string(const Misfit& misfit);

}  // namespace pelagos
