#pragma once

#include <cstdint>

namespace pelagos {

/// Water in the hold of a body, the room in it that water reaches over a rim only.
struct HoldReading {
  std::uint32_t body = 0;
  double volume = 0.0;  ///< m^3, of the hold up to its rim
  double water = 0.0;   ///< m^3, in it now
};

}  // namespace pelagos
