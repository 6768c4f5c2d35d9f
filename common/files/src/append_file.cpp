#include "files/append_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace pelagos {
namespace {

constexpr std::size_t kMostWaiting = std::size_t{16} << 20;  // bytes; some 100,000 commands
constexpr int kMostNames = 10000;

}  // namespace

AppendFile::AppendFile(const std::filesystem::path& wanted) : file_(wanted) {
  if (open_new(wanted) || open_empty(wanted)) return;
  if (errno != EEXIST) {
    fault_ = std::strerror(errno);
    return;
  }
  for (int k = 1; k < kMostNames; ++k) {
    file_ = wanted.string() + "." + std::to_string(k);
    if (open_new(file_) || open_empty(file_)) return;
    if (errno != EEXIST) break;
  }
  fault_ = errno == EEXIST ? "all names up to " + file_.string() + " are taken" : std::strerror(errno);
}

AppendFile::~AppendFile() {
  if (out_ >= 0) close(out_);
}

bool AppendFile::open_new(const std::filesystem::path& file) {
  out_ = open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (out_ >= 0) flock(out_, LOCK_EX | LOCK_NB);
  return out_ >= 0;
}

/// A device, a pipe, or a file that is there, but holds nothing and is nobody's. Else false, and EEXIST.
bool AppendFile::open_empty(const std::filesystem::path& file) {
  if (errno != EEXIST) return false;
  struct stat found {};
  if (stat(file.c_str(), &found) != 0) return false;
  if (S_ISREG(found.st_mode) && found.st_size > 0) {
    errno = EEXIST;
    return false;
  }
  const int out = open(file.c_str(), O_WRONLY | O_CLOEXEC);
  if (out < 0) return false;
  const bool plain = S_ISREG(found.st_mode);
  if (plain && (flock(out, LOCK_EX | LOCK_NB) != 0 || fstat(out, &found) != 0 || found.st_size > 0)) {
    close(out);
    errno = EEXIST;
    return false;
  }
  out_ = out;
  return true;
}

void AppendFile::append(std::string_view line) {
  if (lost_lines_ > 0 || waiting_.size() + line.size() > kMostWaiting) {
    ++lost_lines_;
    return flush();
  }
  waiting_.append(line).push_back('\n');
  ++waiting_lines_;
  flush();
}

void AppendFile::flush() {
  if (out_ < 0) return;  // told when it was opened
  std::size_t done = 0;
  int fault = 0;
  while (done < waiting_.size() && fault == 0) {
    const ssize_t written = write(out_, waiting_.data() + done, waiting_.size() - done);
    if (written >= 0) done += static_cast<std::size_t>(written);
    if (written < 0 && errno != EINTR) fault = errno;
  }
  waiting_.erase(0, done);
  waiting_lines_ = static_cast<std::size_t>(std::count(waiting_.begin(), waiting_.end(), '\n'));
  fault_ = fault != 0 ? std::strerror(fault) : "";
  if (fault == 0 && lost_lines_ > 0) fault_ = "it was full for too long";
}

}  // namespace pelagos
