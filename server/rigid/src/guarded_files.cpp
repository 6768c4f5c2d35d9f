#include "guarded_files.hpp"

#include <algorithm>
#include <cstring>

namespace pelagos {

namespace fs = std::filesystem;

GuardedFiles::GuardedFiles(const fs::path& mesh_file, std::uintmax_t most_bytes)
    : folder_(fs::weakly_canonical(fs::absolute(mesh_file)).parent_path()),
      bytes_left_(most_bytes),
      most_bytes_(most_bytes) {}

bool GuardedFiles::is_allowed(const char* file) const {
  std::error_code error;
  const fs::path path = fs::weakly_canonical(fs::absolute(file), error);  // links resolved: none leads out
  const bool below =
      !error && std::mismatch(folder_.begin(), folder_.end(), path.begin(), path.end()).first == folder_.end();
  if (!below && refusal_.empty())
    refusal_ = std::string("refers to ") + file + "; allowed: files in the mesh's own folder or below";
  return below;
}

bool GuardedFiles::Exists(const char* file) const { return is_allowed(file) && DefaultIOSystem::Exists(file); }

Assimp::IOStream* GuardedFiles::Open(const char* file, const char* mode) {
  if (!is_allowed(file) || std::strpbrk(mode, "wa+") != nullptr) return nullptr;
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return nullptr;
  const std::uintmax_t bytes = fs::file_size(file, error);
  if (error || bytes > bytes_left_) {
    if (refusal_.empty())
      refusal_ = std::string("with ") + file + " it is more than the " + std::to_string(most_bytes_ >> 20) +
                 " MB that are read";
    return nullptr;
  }
  bytes_left_ -= bytes;
  return DefaultIOSystem::Open(file, mode);
}

}  // namespace pelagos
