#include "file_bytes.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>

#include "import_fault.hpp"
#include "mesh_import/import_mesh.hpp"

namespace pelagos {

namespace fs = std::filesystem;

MeshFolder::MeshFolder(const fs::path& mesh_file)
    : mesh_file_(mesh_file),
      folder_(fs::weakly_canonical(fs::absolute(mesh_file)).parent_path()),
      left_(MeshLimits::kBytes) {}

fs::path MeshFolder::find(const std::string& reference) const {
  std::error_code error;
  const fs::path path = fs::weakly_canonical(folder_ / fs::path(reference), error);  // links resolved: none leads out
  if (error || std::mismatch(folder_.begin(), folder_.end(), path.begin(), path.end()).first != folder_.end())
    throw ImportFault("refers to " + reference + "; allowed: files in the mesh's own folder or below");
  return path;
}

void MeshFolder::take(std::size_t bytes, const fs::path& file) {
  if (bytes > left_)
    throw ImportFault((file == mesh_file_ ? std::string() : "with " + file.filename().string() + ": ") +
                      std::to_string((MeshLimits::kBytes - left_ + bytes) >> 20) +
                      " MB; allowed: " + std::to_string(MeshLimits::kBytes >> 20) +
                      " MB with all files that it refers to. Reduce its triangles, or save it in a binary format "
                      "(.glb, binary .stl)");
  left_ -= bytes;
}

OpenFile::OpenFile(MeshFolder& folder, const fs::path& file) {
  // A pipe would wait for its writer: without O_NONBLOCK the open itself never comes back.
  descriptor_ = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  const std::string name = file == folder.mesh_file() ? std::string() : file.filename().string() + ": ";
  if (descriptor_ < 0) throw ImportFault(name + std::strerror(errno));
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode)) {
    ::close(descriptor_);
    throw ImportFault(name + "is not a regular file");
  }
  size_ = left_ = static_cast<std::size_t>(status.st_size);
  try {
    folder.take(size_, file);
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

OpenFile::~OpenFile() { ::close(descriptor_); }

std::size_t OpenFile::read(std::span<char> bytes) {
  const std::size_t wanted = std::min(bytes.size(), left_);
  std::size_t done = 0;
  while (done < wanted) {
    const ssize_t count = ::read(descriptor_, bytes.data() + done, wanted - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw ImportFault(std::strerror(errno));
    if (count == 0) break;
    done += static_cast<std::size_t>(count);
  }
  left_ = done < wanted ? 0 : left_ - done;
  return done;
}

void OpenFile::rewind() {
  if (::lseek(descriptor_, 0, SEEK_SET) < 0) throw ImportFault(std::strerror(errno));
  left_ = size_;
}

std::string read_all(MeshFolder& folder, const fs::path& file) {
  OpenFile open(folder, file);
  std::string bytes(open.size(), '\0');
  bytes.resize(open.read(bytes));
  return bytes;
}

std::uint32_t little_endian(std::span<const char> bytes, std::size_t offset, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t n = count; n > 0; --n) value = value << 8 | static_cast<unsigned char>(bytes[offset + n - 1]);
  return value;
}

float little_endian_float(std::span<const char> bytes, std::size_t offset) {
  return std::bit_cast<float>(little_endian(bytes, offset));
}

}  // namespace pelagos
