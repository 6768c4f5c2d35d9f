#pragma once

#include "physics/particles.hpp"

namespace pelagos {

/// Where a pass over density leaves its results; null: not wanted.
struct DensityOutput {
  float* delta = nullptr;
  float* alpha = nullptr;
  Float4* sum = nullptr;
  Float4* wall = nullptr;
  void* cache_words = nullptr;
  void* other_words = nullptr;                 ///< -a_ji, written near solids
  Float4* solid_wall[2] = {nullptr, nullptr};  ///< by slot, written near solids
  Float4* first = nullptr;                     ///< corrections
  Float4* second = nullptr;
  float* mobility = nullptr;  ///< two phases
};

}  // namespace pelagos
