#pragma once

#include <cstddef>
#include <vector>

#include "values/scene.hpp"

namespace pelagos {

/// What a query of the surface costs at a scene, with as many places as one may have, ms.
struct BenchQueries {
  /// By the number of waves, the shortest of 20 tries: what the server's own thread for queries does, `ahead` of time
  /// so that all is waves.
  struct Waves {
    std::size_t components = 0;
    double near_ms = 0.0;  ///< within 1 km
    double far_ms = 0.0;   ///< within 20 km
  };
  std::size_t particles = 0, places = 0;
  // Medians over the steps made.
  double step_ms = 0.0;
  double first_read_ms = 0.0;  ///< the simulation's thread: all places in the patch, the first to ask after a step
  double next_read_ms = 0.0;   ///< a further query at the same boundary
  std::vector<Waves> waves;
};

/// @param steps  >= 1: after each of them the simulation's thread reads
[[nodiscard]] BenchQueries measure_queries(const Scene& scene, int threads, int steps);

}  // namespace pelagos
