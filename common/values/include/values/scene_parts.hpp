#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace pelagos {

/// Hashes of what a run is made of, each by the name that people are told: "patch", "walls", "bodies".
using SceneParts = std::map<std::string, std::uint64_t>;

/// The names of the parts that are not the same in both, "patch, walls"; empty if all are.
[[nodiscard]] inline std::string other_parts(const SceneParts& a, const SceneParts& b) {
  std::string names;
  const auto add = [&names](const std::string& name) { names += (names.empty() ? "" : ", ") + name; };
  for (const auto& [name, hash] : a)
    if (const auto found = b.find(name); found == b.end() || found->second != hash) add(name);
  for (const auto& [name, hash] : b)
    if (!a.contains(name)) add(name);
  return names;
}

}  // namespace pelagos
