#pragma once

#include <cstdint>

namespace pelagos {

/// Nanoseconds of a monotonic clock: the Clock that physics is given.
[[nodiscard]] std::int64_t monotonic_ns();

/// Nanoseconds since the epoch, for time stamps that cross machines.
[[nodiscard]] std::int64_t wall_ns();

}  // namespace pelagos
