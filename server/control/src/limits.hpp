#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <string>
#include <string_view>

#include "control/control_server.hpp"

namespace pelagos {

using Clock = std::chrono::steady_clock;

/// So many requests a second, with some at once.
class TokenBucket {
 public:
  TokenBucket(double per_second, double burst) : per_second_(per_second), burst_(burst), tokens_(burst) {}
  [[nodiscard]] bool take(Clock::time_point now) {
    tokens_ = std::min(burst_, tokens_ + per_second_ * std::chrono::duration<double>(now - last_).count());
    last_ = now;
    if (tokens_ < 1.0) return false;
    tokens_ -= 1.0;
    return true;
  }

 private:
  double per_second_;
  double burst_;
  double tokens_;
  Clock::time_point last_ = Clock::now();
};

/// Passes on at most 20 lines a second and tells how many it kept back.
class LimitedLog {
 public:
  explicit LimitedLog(std::function<void(LogLevel, std::string_view)> sink) : sink_(std::move(sink)) {}
  void write(LogLevel level, const std::string& text) {
    if (!sink_) return;
    const auto now = Clock::now();
    if (now - window_ >= std::chrono::seconds(1)) {
      if (kept_back_ > 0) {
        sink_(LogLevel::kWarning, "control: " + std::to_string(kept_back_) + " more lines were kept back");
      }
      window_ = now;
      lines_ = 0;
      kept_back_ = 0;
    }
    if (lines_ >= 20) {
      ++kept_back_;
      return;
    }
    ++lines_;
    sink_(level, "control: " + text);
  }

 private:
  std::function<void(LogLevel, std::string_view)> sink_;
  Clock::time_point window_{};
  int lines_ = 0;
  std::uint64_t kept_back_ = 0;
};

}  // namespace pelagos
