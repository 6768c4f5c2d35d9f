#include "files/output_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace pelagos {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kTrialBytes = 4096;  // a block: on a full disk an empty file can still be made

/// The file that a name stands for: behind a link, what it points to.
fs::path target_of(const fs::path& file) {
  std::error_code error;
  const fs::path target = fs::is_symlink(file, error) ? fs::weakly_canonical(file, error) : file;
  return error ? file : target;
}

fs::path part_of(const fs::path& file) { return file.string() + "." + std::to_string(getpid()) + ".part"; }

bool is_special(const fs::path& file) {
  std::error_code error;
  return fs::exists(file, error) && !fs::is_regular_file(file, error) && !fs::is_directory(file, error);
}

/// 0, or errno.
int write_all(const fs::path& file, int flags, std::string_view bytes) {
  const int out = open(file.c_str(), flags | O_WRONLY | O_CLOEXEC, 0666);
  if (out < 0) return errno;
  int fault = 0;
  while (!bytes.empty() && fault == 0) {
    const ssize_t written = write(out, bytes.data(), bytes.size());
    if (written >= 0) bytes.remove_prefix(static_cast<std::size_t>(written));
    if (written < 0 && errno != EINTR) fault = errno;
  }
  if (fault == 0 && fsync(out) != 0 && errno != EINVAL && errno != EROFS) fault = errno;
  if (close(out) != 0 && fault == 0) fault = errno;
  return fault;
}

std::string advice(int fault) {
  if (fault == ENOSPC || fault == EDQUOT || fault == EFBIG) return "; make room, or name a file on another disk";
  if (fault == EACCES || fault == EPERM || fault == EROFS) return "; name a file that this user may write";
  return "";
}

std::string reason(int fault) { return std::strerror(fault) + advice(fault); }

}  // namespace

std::string fault_of_output_file(const fs::path& name) {
  const fs::path file = target_of(name);
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  std::error_code error;
  if (name.empty()) return "is empty; name a file";
  if (fs::is_directory(file, error)) return "is a folder; name a file in it";
  if (!fs::exists(folder, error)) return "there is no folder " + folder.string() + "; make it first";
  if (!fs::is_directory(folder, error)) return folder.string() + " is no folder; name a file in one";
  if (fs::exists(file, error) && access(file.c_str(), W_OK) != 0) return "cannot be written: " + reason(errno);
  if (is_special(file)) return "";
  const fs::path part = part_of(file);
  const int fault = write_all(part, O_CREAT | O_EXCL, std::string(kTrialBytes, '\n'));
  if (fault != EEXIST) unlink(part.c_str());
  return fault == 0 ? "" : "cannot be written: " + reason(fault);
}

std::string fault_of_output_folder(const fs::path& folder) {
  std::error_code error;
  if (folder.empty()) return "is empty; name a folder";
  if (fs::exists(folder, error) && !fs::is_directory(folder, error)) return "is a file; name a folder";
  fs::create_directories(folder, error);
  if (error) return "the folder cannot be made: " + error.message() + "; name one that this user may write";
  return fault_of_output_file(folder / "trial");
}

std::string write_whole_file(const fs::path& name, std::string_view bytes) {
  const fs::path file = target_of(name);
  const auto refuse = [&](int fault) { return "cannot write " + name.string() + ": " + reason(fault); };
  if (is_special(file)) {
    const int fault = write_all(file, 0, bytes);
    return fault == 0 ? "" : refuse(fault);
  }
  const fs::path part = part_of(file);
  int fault = write_all(part, O_CREAT | O_TRUNC, bytes);
  if (fault == 0 && rename(part.c_str(), file.c_str()) != 0) fault = errno;
  if (fault == 0) return "";
  unlink(part.c_str());
  return refuse(fault);
}

}  // namespace pelagos
