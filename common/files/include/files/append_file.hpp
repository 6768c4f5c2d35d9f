#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace pelagos {

/// A record that grows line by line, each on its way to the disk at once. It never touches a file that holds something:
/// beside FILE it begins FILE.1, or FILE.2, ... What cannot be written, on a full disk, waits in memory for room and
/// then follows, so that no line is missing. For one thread.
class AppendFile {
 public:
  /// Opens the file. What failed is told by `fault`.
  explicit AppendFile(const std::filesystem::path& wanted);
  ~AppendFile();
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;

  /// Adds a line; the line feed is added to it.
  void append(std::string_view line);
  /// Tries again to write what waits.
  void flush();

  /// The file that is written: the one that was wanted, or the next that was free.
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  /// Why lines wait, or were lost; empty while all is written.
  [[nodiscard]] const std::string& fault() const { return fault_; }
  [[nodiscard]] std::size_t waiting_lines() const { return waiting_lines_; }
  /// Lines that found no room in memory either: from the first of these on the record ends.
  [[nodiscard]] std::size_t lost_lines() const { return lost_lines_; }

 private:
  bool open_new(const std::filesystem::path& file);
  bool open_empty(const std::filesystem::path& file);

  std::filesystem::path file_;
  int out_ = -1;
  std::string waiting_;
  std::size_t waiting_lines_ = 0, lost_lines_ = 0;
  std::string fault_;
};

}  // namespace pelagos
