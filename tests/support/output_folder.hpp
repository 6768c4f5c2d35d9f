#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace pelagos::test {

/// Makes the folder that --out names. Throws std::runtime_error, naming the option, where that is not possible.
inline void make_output_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw std::runtime_error("--out " + folder.string() + ": the folder cannot be made: " + error.message() +
                             "; name one that may be written");
}

}  // namespace pelagos::test
