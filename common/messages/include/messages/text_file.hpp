#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "messages/field_reader.hpp"

namespace pelagos {

/// Faults as lines for people, in the order of the text, none twice: "file:line:column: field: what".
[[nodiscard]] std::vector<std::string> describe_faults(TextRefusals faults, const std::string& source_name);

/// A file's text, at most `largest` bytes and one more.
struct TextFile {
  std::string text;
  std::string fault;  ///< why there is none; empty if there is
};
/// @param kind  what the file is to be, e.g. "scene"
[[nodiscard]] TextFile read_text_file(const std::filesystem::path& path, const std::string& kind, std::size_t largest);

}  // namespace pelagos
