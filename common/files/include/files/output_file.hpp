#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace pelagos {

/// Why a file could not be written later, with what to do; empty if it could. It leaves what is there as it is: a block
/// is written beside it and taken away again. To be asked before long work whose result goes there.
[[nodiscard]] std::string fault_of_output_file(const std::filesystem::path& file);

/// Why nothing could be written into a folder, which is made where it is missing; empty if it could.
[[nodiscard]] std::string fault_of_output_folder(const std::filesystem::path& folder);

/// Writes a whole file: first under another name beside it, then renamed, so that a crash never leaves half of it and a
/// reader never sees one. Devices and pipes are written directly. Empty on success, else why not.
[[nodiscard]] std::string write_whole_file(const std::filesystem::path& file, std::string_view bytes);

}  // namespace pelagos
