#pragma once

#include <cstddef>

namespace pelagos {

// How much of a response one world holds. It bounds memory and the cost of a step, whoever asks for it: scenes, events,
// stations or a replay. docs/control.md tells them, and the status how many there are.

inline constexpr std::size_t kMostBooms = 100;
inline constexpr std::size_t kMostPointsPerBoom = 1000;
inline constexpr std::size_t kMostBoomPoints = 4000;  ///< of all booms together
inline constexpr std::size_t kMostSkimmers = 100;
inline constexpr std::size_t kMostReleases = 100;  ///< sources that run at a time

}  // namespace pelagos
