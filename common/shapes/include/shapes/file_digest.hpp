#pragma once

#include <cstdint>
#include <filesystem>

namespace pelagos {

/// A number that tells files of different content apart: the 64 bit hash FNV-1a of the bytes (Fowler, Noll, Vo). Not
/// against those who forge. 0 if the file is no regular file, cannot be read, or has more than 128 MB. Never throws.
[[nodiscard]] std::uint64_t file_digest(const std::filesystem::path& file) noexcept;

}  // namespace pelagos
