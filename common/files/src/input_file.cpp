#include "files/input_file.hpp"

#include <fstream>
#include <vector>

namespace pelagos {

InputFile read_input_file(const std::filesystem::path& path, const std::string& kind, std::size_t largest) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) return {"", "no such " + kind + " file"};
  if (std::filesystem::is_directory(status)) return {"", "is a folder; a " + kind + " file is needed"};
  std::ifstream file(path, std::ios::binary);
  if (!file) return {"", "cannot be opened; may this user read it?"};
  std::string bytes;
  std::vector<char> chunk(std::size_t{1} << 16);
  while (bytes.size() <= largest && file.read(chunk.data(), static_cast<std::streamsize>(chunk.size())).gcount() > 0)
    bytes.append(chunk.data(), static_cast<std::size_t>(file.gcount()));
  if (file.bad()) return {"", "cannot be read to its end"};
  if (bytes.size() > largest) bytes.resize(largest + 1);
  return {std::move(bytes), ""};
}

}  // namespace pelagos
