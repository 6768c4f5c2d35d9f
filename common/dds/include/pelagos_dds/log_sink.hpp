#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>

#include "pelagos_dds/configuration.hpp"

namespace pelagos {

/// Lets at most `burst` lines through in each `window`, and says once per window how many it held back. Thread-safe.
class RateLimitedLog {
 public:
  explicit RateLimitedLog(DdsLog log, int burst = 5,
                          std::chrono::steady_clock::duration window = std::chrono::seconds(10));

  void write(std::string_view line);
  /// Lines held back since the start.
  [[nodiscard]] std::uint64_t suppressed() const;

 private:
  mutable std::mutex mutex_;
  DdsLog log_;
  int burst_;
  std::chrono::steady_clock::duration window_;
  std::chrono::steady_clock::time_point window_start_{};
  int written_ = 0;
  std::uint64_t held_back_ = 0;
  std::uint64_t suppressed_ = 0;
};

/// Takes over the messages of the DDS library (they go to stderr otherwise, one line for each malformed datagram):
/// the rate-limited lines go to `log`. An empty `log` gives stderr back to the library. For the whole process.
void install_dds_log(DdsLog log);

}  // namespace pelagos
