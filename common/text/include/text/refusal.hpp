#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace pelagos {

/// Why something from outside is not taken. The one type for it: commands, scenes, samples of DDS, meshes, rigs, state
/// files, oil that cannot be released.
struct Refusal {
  std::string field;  ///< that is wrong: the path of a field, the line of a file, the kind of a mesh's fault; or empty
  std::string what;   ///< the value and what is allowed

  friend bool operator==(const Refusal&, const Refusal&) = default;
};
using Refusals = std::vector<Refusal>;

/// On one line: field and what.
[[nodiscard]] inline std::string to_string(const Refusal& refusal) {
  return refusal.field.empty() ? refusal.what : refusal.field + ": " + refusal.what;
}

inline std::ostream& operator<<(std::ostream& out, const Refusal& refusal) { return out << to_string(refusal); }

/// The same, of something inside a file or a message: its field behind the path that leads there.
[[nodiscard]] inline Refusal put_behind(const std::string& path, const char* separator, const Refusal& refusal) {
  return {refusal.field.empty() ? path : path + separator + refusal.field, refusal.what};
}

}  // namespace pelagos
