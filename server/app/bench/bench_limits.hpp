#pragma once

#include <cstddef>

#include "values/scene.hpp"

namespace pelagos {

/// What this machine does at best with loops that do one thing only, on the data of a scene; best of several tries.
struct BenchLimits {
  double multiply_add_gflops = 0;  ///< single precision, full vectors
  double memory_read_gb_s = 0;     ///< 512 MB, read once a try
  double cached_read_gb_s = 0;     ///< as many bytes as a pass of a solve reads
  double gather_ns_per_slot = 0;   ///< a 16-byte record for each slot of the neighbour list, in the pair loops' order
  std::size_t particles = 0, slots = 0, pass_bytes = 0;
};

/// Advances the scene by `steps`, then measures. Throws std::invalid_argument if the scene's bodies cannot be used.
[[nodiscard]] BenchLimits measure_limits(const Scene& scene, int threads, int steps);

}  // namespace pelagos
