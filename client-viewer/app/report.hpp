#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "client/frame_receiver.hpp"
#include "renderer/renderer.hpp"
#include "source/latency.hpp"

namespace pelagos {

/// "measured", "host", "arrival", "none".
[[nodiscard]] const char* name_of(ViewerClock clock);

/// What a headless run did; becomes `<channel>.json`.
struct RunReport {
  std::string channel;
  std::string scene;
  std::string renderer;
  int width = 0, height = 0;
  std::uint64_t frames_drawn = 0;
  std::uint64_t pictures_written = 0;
  std::string last_picture;
  double seconds = 0.0;                 ///< from the first frame drawn to the last
  double seconds_without_server = 0.0;  ///< after the first frame
  PassTimes pass_ms_sum = {};
  double frame_ms_sum = 0.0;    ///< drawing only
  double picture_ms_sum = 0.0;  ///< reading back and writing files
  Latency latency;              ///< of frames seen for the first time while the sea moves
  double delay = 0.0;           ///< s, behind the schedule
  std::vector<double> skew_ms;  ///< magnitudes
  std::uint64_t pictures_held = 0;
  ClockState clock;
  bool paused = false;  ///< the sea, when the last picture was drawn
  ReceiverCounters counters;
  std::vector<std::string> errors;
};

/// @throws OutputError
void write_report(const RunReport& report, const std::filesystem::path& file);

}  // namespace pelagos
