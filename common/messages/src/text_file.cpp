#include "messages/text_file.hpp"

#include <algorithm>
#include <fstream>

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

TextFile read_text_file(const std::filesystem::path& path, const std::string& kind, std::size_t largest) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) return {"", "no such " + kind + " file"};
  if (std::filesystem::is_directory(status)) return {"", "is a folder; a " + kind + " file is needed"};
  std::ifstream file(path, std::ios::binary);
  if (!file) return {"", "cannot be opened; may this user read it?"};
  std::string text;
  std::vector<char> chunk(std::size_t{1} << 16);
  while (text.size() <= largest && file.read(chunk.data(), static_cast<std::streamsize>(chunk.size())).gcount() > 0)
    text.append(chunk.data(), static_cast<std::size_t>(file.gcount()));
  if (file.bad()) return {"", "cannot be read to its end"};
  if (text.size() > largest) text.resize(largest + 1);
  return {std::move(text), ""};
}

}  // namespace pelagos
