#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "physics/particles.hpp"
#include "physics/task_pool.hpp"
#include "values/current.hpp"

namespace pelagos {

// The loops over particles of a current that is held layer by layer, see current_drive.hpp. Each particle writes only
// its own entry and sums run in a fixed order: the same bits for any number of threads. Heights are local, in m.

/// Flat layers of one thickness, the lowest first.
struct CurrentLayers {
  double floor = 0.0;      ///< lower edge of the lowest layer
  double thickness = 1.0;  ///< of a layer
  std::size_t count = 1;

  /// What is above the water at rest belongs to the uppermost layer.
  [[nodiscard]] std::size_t layer_of(float z) const;
};

/// Particles of a layer.
struct LayerSum {
  double count = 0.0;
  std::array<double, 2> velocity{0.0, 0.0};  ///< m/s, their sum along x and y
};

/// velocity += the current's profile at each particle's depth below `surface`, along the axes that move.
void add_profile(TaskPool& pool, const CurrentSettings& current, double surface, const std::array<bool, 2>& moves,
                 std::span<const Float4> position, std::span<Float4> velocity);

/// Sums over the particles of each layer. Particles that are not finite count for nothing.
/// @param partial  scratch
/// @param sums     out, [layers.count]
void sum_layers(TaskPool& pool, const CurrentLayers& layers, std::span<const Float4> position,
                std::span<const Float4> velocity, std::vector<LayerSum>& partial, std::span<LayerSum> sums);

/// acceleration += a(z), linear between the layers' middles, along the axes that move.
/// @param of_layer  [layers.count] m/s^2
void add_between_layers(TaskPool& pool, const CurrentLayers& layers, std::span<const std::array<double, 2>> of_layer,
                        const std::array<bool, 2>& moves, std::span<const Float4> position,
                        std::span<Float4> acceleration);

}  // namespace pelagos
