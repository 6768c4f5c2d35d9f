#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "client/frame_receiver.hpp"

namespace pelagos {

/// How far pictures are behind the sea. A frame carries the server's wall clock; where that and the clock here differ,
/// only the time since a frame came is known.
class Latency {
 public:
  /// A frame that was drawn for the first time.
  /// @param drawn          when the picture was finished, by the steady clock
  /// @param system_now_ns  ns since 1970 at the same moment, by the clock of this machine
  void add(const OceanFrame& frame, std::chrono::steady_clock::time_point drawn, std::int64_t system_now_ns);

  /// ms from the server's frame time to the finished picture, one for each frame; empty where the clocks differ.
  [[nodiscard]] std::vector<double> from_server() const;
  /// ms from a frame's arrival to the finished picture.
  [[nodiscard]] const std::vector<double>& from_arrival() const { return from_arrival_; }

  /// By how many seconds the clock here is ahead of the server's (negative: behind), the quickest frame's way here
  /// included; 0 where they agree: no frame arrived before it was made, and the quickest within 2 s. Nothing without a
  /// frame.
  [[nodiscard]] std::optional<double> clock_difference() const;

 private:
  std::vector<double> from_server_, from_arrival_;  ///< ms
  double quickest_ms_ = 0.0;                        ///< from the server's frame time to the arrival
};

}  // namespace pelagos
