#pragma once

#include <assimp/DefaultIOSystem.h>

#include <cstdint>
#include <filesystem>
#include <string>

namespace pelagos {

/// The files that the importer of a mesh may open: the mesh itself and what lies in its folder or below, read-only, a
/// bounded number of bytes in all. What else the mesh asks for is refused, and the first refusal is kept for the user.
class GuardedFiles : public Assimp::DefaultIOSystem {
 public:
  /// @param mesh_file    the file that is imported
  /// @param most_bytes   of all files together
  GuardedFiles(const std::filesystem::path& mesh_file, std::uintmax_t most_bytes);

  [[nodiscard]] bool Exists(const char* file) const override;
  Assimp::IOStream* Open(const char* file, const char* mode) override;

  /// Why a file was not opened; empty if all were.
  [[nodiscard]] const std::string& refusal() const { return refusal_; }

 private:
  [[nodiscard]] bool is_allowed(const char* file) const;

  std::filesystem::path folder_;  ///< canonical
  std::uintmax_t bytes_left_;
  std::uintmax_t most_bytes_;
  mutable std::string refusal_;
};

}  // namespace pelagos
