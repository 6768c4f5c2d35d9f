#include "renderer/picture.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#endif
#include <stb/stb_easy_font.h>
#include <stb/stb_image_write.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace pelagos {

void write_file(const std::filesystem::path& file, const std::string& bytes) {
  const std::string part = file.string() + ".part";
  const auto fail = [&](int reason) {
    std::remove(part.c_str());
    throw OutputError("cannot write " + file.string() + ": " + std::strerror(reason));
  };
  std::FILE* out = std::fopen(part.c_str(), "wb");
  if (out == nullptr) fail(errno);
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), out) == bytes.size();
  const int write_error = errno;
  const bool closed = std::fclose(out) == 0;
  if (!written) fail(write_error);
  if (!closed) fail(errno);
  if (std::rename(part.c_str(), file.c_str()) != 0) fail(errno);
}

void write_png(const Picture& picture, const std::filesystem::path& file) {
  std::string bytes;
  const auto collect = [](void* context, void* data, int size) {
    static_cast<std::string*>(context)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
  };
  if (stbi_write_png_to_func(collect, &bytes, picture.width, picture.height, 3, picture.rgb.data(),
                             picture.width * 3) == 0)
    throw OutputError("cannot encode " + file.string());
  write_file(file, bytes);
}

void draw_banner(Picture& picture, const std::string& text) {
  constexpr int kScale = 2, kMargin = 8;
  const int bar = std::min(picture.height, 12 * kScale + kMargin);
  const int top = picture.height - bar;
  for (int y = top; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      for (int k = 0; k < 3; ++k) picture.at(x, y)[k] = static_cast<std::uint8_t>(picture.at(x, y)[k] / 4);
  struct Vertex {
    float x, y, z;
    std::uint8_t colour[4];
  };
  std::vector<Vertex> corners(text.size() * 64 + 64);
  std::string line = text;
  const int quads = stb_easy_font_print(0, 0, line.data(), nullptr, corners.data(),
                                        static_cast<int>(corners.size() * sizeof(Vertex)));
  for (int q = 0; q < quads; ++q) {
    const Vertex& a = corners[static_cast<std::size_t>(4 * q)];
    const Vertex& b = corners[static_cast<std::size_t>(4 * q + 2)];
    for (int y = static_cast<int>(a.y) * kScale; y < static_cast<int>(b.y) * kScale; ++y)
      for (int x = static_cast<int>(a.x) * kScale; x < static_cast<int>(b.x) * kScale; ++x) {
        const int px = x + kMargin, py = y + top + kMargin / 2 + 1;
        if (px < picture.width && py < picture.height) std::fill_n(picture.at(px, py), 3, std::uint8_t{235});
      }
  }
}

}  // namespace pelagos
