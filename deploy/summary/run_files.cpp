#include "run_files.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <fstream>

namespace pelagos {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

ordered_json read_json(const fs::path& file) {
  std::ifstream input(file);
  if (!input) throw RunFileError(file.string() + ": cannot be read");
  try {
    return ordered_json::parse(input);
  } catch (const nlohmann::json::exception& error) {
    throw RunFileError(file.string() + ": is not JSON: " + error.what());
  }
}

/// Files of a folder with that extension, sorted by name.
std::vector<fs::path> files_of(const fs::path& folder, const std::string& extension) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == extension) files.push_back(entry.path());
  }
  if (error) throw RunFileError(folder.string() + ": " + error.message());
  std::sort(files.begin(), files.end());
  return files;
}

/// The bridge closes with "done: N poses sent, M failed".
PosesSent read_poses(const fs::path& log) {
  std::ifstream input(log);
  std::string last;
  for (std::string line; std::getline(input, line);) last = line;
  unsigned long long sent = 0, failed = 0;
  if (std::sscanf(last.c_str(), "done: %llu poses sent, %llu failed", &sent, &failed) != 2)
    throw RunFileError(log.string() + ": the bridge did not close with the number of poses sent");
  return {sent, failed};
}

/// Size from the header chunk (PNG specification, 11.2.2 IHDR): signature, length, type, width, height, big-endian.
PictureFile read_picture(const fs::path& file) {
  std::array<unsigned char, 24> head{};
  std::ifstream input(file, std::ios::binary);
  input.read(reinterpret_cast<char*>(head.data()), head.size());
  if (!input || std::memcmp(head.data(), "\x89PNG\r\n\x1a\n", 8) != 0 || std::memcmp(head.data() + 12, "IHDR", 4) != 0)
    throw RunFileError(file.string() + ": is not a PNG picture");
  const auto number = [&](std::size_t at) {
    return std::uint32_t{head[at]} << 24 | std::uint32_t{head[at + 1]} << 16 | std::uint32_t{head[at + 2]} << 8 |
           std::uint32_t{head[at + 3]};
  };
  return {file.filename().string(), number(16), number(20), fs::file_size(file)};
}

}  // namespace

RunFiles read_run(const fs::path& run) {
  RunFiles files;
  files.server = read_json(run / "server.json");
  files.status_before = read_json(run / "status_before.json");
  files.status_after = read_json(run / "status_after.json");
  for (const fs::path& file : files_of(run / "channels", ".json")) files.channels.push_back(read_json(file));
  files.poses = read_poses(run / "logs" / "bridge.log");
  for (const fs::path& file : files_of(run, ".png")) files.pictures.push_back(read_picture(file));
  return files;
}

}  // namespace pelagos
