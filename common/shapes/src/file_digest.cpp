#include "shapes/file_digest.hpp"

#include <array>
#include <fstream>

namespace pelagos {

std::uint64_t file_digest(const std::filesystem::path& file) noexcept try {
  constexpr std::uint64_t kBasis = 0xcbf29ce484222325ull, kPrime = 0x100000001b3ull;
  constexpr std::uintmax_t kMostBytes = std::uintmax_t{128} << 20;
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error) || std::filesystem::file_size(file, error) > kMostBytes) return 0;
  std::ifstream in(file, std::ios::binary);
  std::uint64_t digest = kBasis;
  std::uintmax_t read = 0;
  std::array<char, 65536> block;
  while (in && read <= kMostBytes) {
    in.read(block.data(), block.size());
    for (std::streamsize i = 0; i < in.gcount(); ++i)
      digest = (digest ^ static_cast<std::uint8_t>(block[static_cast<std::size_t>(i)])) * kPrime;
    read += static_cast<std::uintmax_t>(in.gcount());
  }
  return in.eof() && read <= kMostBytes ? digest : 0;
} catch (...) {
  return 0;
}

}  // namespace pelagos
