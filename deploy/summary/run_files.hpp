#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace pelagos {

/// A file of a run that is missing or is not what it should be. The text names the file.
class RunFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct PictureFile {
  std::string name;  ///< without folders
  std::uint32_t width = 0, height = 0;
  std::uintmax_t bytes = 0;
};

struct PosesSent {
  std::uint64_t sent = 0, failed = 0;
};

/// What the programs of one run of deploy/demo left in its folder.
struct RunFiles {
  nlohmann::ordered_json server;                 ///< server.json, the server's report at its end
  nlohmann::ordered_json status_before;          ///< answers to pelagos-ctl status
  nlohmann::ordered_json status_after;           ///<
  std::vector<nlohmann::ordered_json> channels;  ///< channels/NAME.json, sorted by name
  PosesSent poses;                               ///< the last line of logs/bridge.log
  std::vector<PictureFile> pictures;             ///< NAME.png, sorted by name
};

/// @throws RunFileError
[[nodiscard]] RunFiles read_run(const std::filesystem::path& run);

}  // namespace pelagos
