#include "hold_watch.hpp"

#include <fmt/format.h>

namespace pelagos {

std::vector<std::string> HoldWatch::look(std::span<const HoldReading> holds) {
  std::vector<std::string> news;
  for (const HoldReading& hold : holds) {
    const auto known = wet_.find(hold.body);
    if (known == wet_.end()) {
      wet_[hold.body] = hold.water > kWet * hold.volume;
      continue;
    }
    bool& wet = known->second;
    if (!wet && hold.water > kWet * hold.volume) {
      wet = true;
      news.push_back(fmt::format("body {}: water has got into its hold: {:.3g} of {:.3g} m^3", hold.body, hold.water,
                                 hold.volume));
    } else if (wet && hold.water < kDry * hold.volume) {
      wet = false;
      news.push_back(fmt::format("body {}: its hold is dry again", hold.body));
    }
  }
  return news;
}

}  // namespace pelagos
