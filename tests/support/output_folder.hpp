#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "files/output_file.hpp"

namespace pelagos::test {

/// Makes the folder that --out names and tries to write there. Throws std::runtime_error, naming the option, where that
/// is not possible.
inline void make_output_folder(const std::filesystem::path& folder) {
  const std::string fault = fault_of_output_folder(folder);
  if (!fault.empty()) throw std::runtime_error("--out " + folder.string() + ": " + fault);
}

}  // namespace pelagos::test
