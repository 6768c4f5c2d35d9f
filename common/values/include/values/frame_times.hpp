#pragma once

namespace pelagos {

/// When the state of a frame is taken.
enum class FrameTimes {
  kEven,     ///< at multiples of the frame interval, to which steps are shortened
  kAtSteps,  ///< at the end of the step in which such a multiple lies: no step is shortened
};

}  // namespace pelagos
