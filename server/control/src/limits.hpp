#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "control/control_server.hpp"
#include "values/token_bucket.hpp"

namespace pelagos {

using Clock = std::chrono::steady_clock;

/// Passes on 20 lines of each level at once and 20 a minute from then on, and tells how many it kept back: whoever
/// provokes lines for days does not fill a disk.
class LimitedLog {
 public:
  explicit LimitedLog(std::function<void(LogLevel, std::string_view)> sink) : sink_(std::move(sink)) {}
  void write(LogLevel level, const std::string& text) {
    if (!sink_) return;
    Budget& budget = budgets_[static_cast<std::size_t>(level)];
    if (!budget.lines.take(Clock::now())) {
      ++budget.kept_back;
      return;
    }
    if (budget.kept_back > 0)
      sink_(level, "control: " + std::to_string(budget.kept_back) + " more lines were kept back");
    budget.kept_back = 0;
    sink_(level, "control: " + text);
  }

 private:
  struct Budget {
    TokenBucket lines{1.0 / 3.0, 20.0};
    std::uint64_t kept_back = 0;
  };
  std::function<void(LogLevel, std::string_view)> sink_;
  std::array<Budget, 3> budgets_;  // by level
};

}  // namespace pelagos
