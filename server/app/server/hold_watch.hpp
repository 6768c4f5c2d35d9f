#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "values/hold_reading.hpp"

namespace pelagos {

/// Tells once when water has got into a body's hold, and when it has run out again.
class HoldWatch {
 public:
  /// What is new. The first call takes what it sees as known: the notes on the start tell it.
  [[nodiscard]] std::vector<std::string> look(std::span<const HoldReading> holds);

 private:
  static constexpr double kWet = 0.05, kDry = 0.02;  ///< of the hold's volume
  std::map<std::uint32_t, bool> wet_;                ///< by body
};

}  // namespace pelagos
