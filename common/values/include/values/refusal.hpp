#pragma once

#include <string>

namespace pelagos {

/// Why something from outside is not taken: a command that does not fit, a release of oil, a state file.
struct Refusal {
  std::string field;  ///< that is wrong, e.g. "from" of a command's message; empty: the whole
  std::string what;   ///< the value and what is allowed
};

/// On one line: field and what.
[[nodiscard]] inline std::string to_string(const Refusal& refusal) {
  return refusal.field.empty() ? refusal.what : refusal.field + ": " + refusal.what;
}

}  // namespace pelagos
