#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace pelagos {

/// What a file holds.
struct InputFile {
  std::string bytes;
  std::string fault;  ///< why there are none; empty if there are
};

/// Reads a whole file, at most `largest` bytes and one more: a file that is too large gives more than `largest`.
/// @param kind  what the file is to be, e.g. "scene"
[[nodiscard]] InputFile read_input_file(const std::filesystem::path& path, const std::string& kind,
                                        std::size_t largest);

}  // namespace pelagos
