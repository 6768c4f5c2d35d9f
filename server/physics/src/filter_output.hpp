#pragma once

#include "physics/solids.hpp"

namespace pelagos {

/// Where the filter leaves its results.
struct FilterOutput {
  Float4* change = nullptr;
  Float4* solid_change[SolidPlanes::kSlots] = {};  ///< written near solids
  float* delta = nullptr;
};

}  // namespace pelagos
