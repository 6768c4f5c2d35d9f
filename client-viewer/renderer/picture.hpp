#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace pelagos {

/// 8-bit RGB, first row on top.
struct Picture {
  Picture(int w, int h) : width(w), height(h), rgb(static_cast<std::size_t>(w) * static_cast<std::size_t>(h) * 3) {}
  [[nodiscard]] std::uint8_t* at(int x, int y) { return &rgb[static_cast<std::size_t>((y * width + x) * 3)]; }
  [[nodiscard]] const std::uint8_t* at(int x, int y) const {
    return &rgb[static_cast<std::size_t>((y * width + x) * 3)];
  }
  int width, height;
  std::vector<std::uint8_t> rgb;
};

/// A file could not be written; the text names it and the reason.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Writes a file whole or not at all: into `file`.part first, then renamed. @throws OutputError
void write_file(const std::filesystem::path& file, const std::string& bytes);

/// @throws OutputError
void write_png(const Picture& picture, const std::filesystem::path& file);

/// A line of text on a dark bar along the lower edge, for viewers without a window.
void draw_banner(Picture& picture, const std::string& text);

}  // namespace pelagos
