#include "messages/describe_faults.hpp"

#include <algorithm>

namespace pelagos {
namespace {

std::string describe(const TextRefusal& fault, const std::string& source_name) {
  std::string text = source_name;
  if (fault.line > 0) text += ":" + std::to_string(fault.line);
  if (fault.column > 0) text += ":" + std::to_string(fault.column);
  return text + ": " + to_string(fault.refusal);
}

}  // namespace

std::vector<std::string> describe_faults(TextRefusals faults, const std::string& source_name) {
  std::stable_sort(faults.begin(), faults.end(),
                   [](const TextRefusal& a, const TextRefusal& b) { return a.line < b.line; });
  std::vector<std::string> lines;
  for (const TextRefusal& fault : faults) {
    std::string line = describe(fault, source_name);
    if (lines.empty() || lines.back() != line) lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace pelagos
