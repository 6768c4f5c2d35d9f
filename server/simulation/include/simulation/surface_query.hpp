#pragma once

#include <optional>
#include <span>

#include "simulation/surface_blend.hpp"
#include "values/current.hpp"
#include "values/surface_query.hpp"
#include "waves/wave_field.hpp"

namespace pelagos {

/// The sea around at one instant, all but the particles: a value that may be asked on any thread.
struct SeaAround {
  SurfaceSurroundings around;
  WaveField sea;
  std::optional<Current> current;
  double time = 0.0;  ///< s, simulated
};

/// Answers a query that has no fault, by the same surface as probes have. Now: the particles' inside the patch, the
/// wave field's outside, blended between. Ahead: the wave field's, everywhere; what the particles will do is not known.
/// @param particles  now: the particles' readings at the query's places at the same instant (World::read_particles);
/// ahead: none
[[nodiscard]] SurfaceAnswer answer_query(const SeaAround& sea, const SurfaceQuery& query,
                                         std::span<const SurfaceReading> particles);

}  // namespace pelagos
