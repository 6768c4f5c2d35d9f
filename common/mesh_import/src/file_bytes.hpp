#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace pelagos {

/// The files of one mesh: itself and what it refers to, MeshLimits::kBytes in all.
class MeshFolder {
 public:
  explicit MeshFolder(const std::filesystem::path& mesh_file);

  [[nodiscard]] const std::filesystem::path& mesh_file() const { return mesh_file_; }
  /// Path of a file that the mesh refers to. @throws ImportFault if it lies neither in the mesh's folder nor below
  [[nodiscard]] std::filesystem::path find(const std::string& reference) const;
  /// Takes bytes from what may be read. @throws ImportFault if there are not as many left
  void take(std::size_t bytes, const std::filesystem::path& file);

 private:
  std::filesystem::path mesh_file_, folder_;  ///< canonical
  std::size_t left_;
};

/// A regular file, open to be read from its start; what it grows to while it is read is not seen.
class OpenFile {
 public:
  /// @throws ImportFault if it cannot be opened, is no regular file or is too large
  OpenFile(MeshFolder& folder, const std::filesystem::path& file);
  ~OpenFile();
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  [[nodiscard]] std::size_t size() const { return size_; }
  /// Reads on; fewer bytes than the span's only at the end. @throws ImportFault if the reading fails
  [[nodiscard]] std::size_t read(std::span<char> bytes);
  void rewind();

 private:
  int descriptor_ = -1;
  std::size_t size_ = 0, left_ = 0;
};

/// All bytes of a file. @throws ImportFault as OpenFile does
[[nodiscard]] std::string read_all(MeshFolder& folder, const std::filesystem::path& file);

/// A number of the file, the least significant byte first. `bytes` has at least as many as the number.
[[nodiscard]] std::uint32_t little_endian(std::span<const char> bytes, std::size_t offset, std::size_t count = 4);
[[nodiscard]] float little_endian_float(std::span<const char> bytes, std::size_t offset);

}  // namespace pelagos
