#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "physics/particles.hpp"
#include "physics/task_pool.hpp"
#include "simulation/current_layers.hpp"
#include "values/current.hpp"
#include "values/patch_frame.hpp"
#include "values/scene.hpp"

namespace pelagos {

/// Keeps the water of a patch moving with a current, along the axes that are periodic.
///
/// The water is cut into horizontal layers two particles thick (thicker ones in water deeper than 128 particles). With
/// u_k the mean velocity of the particles of layer k and U_k the current's mean over the same rows of the lattice at
/// rest,
///   a_k = dU_k / dt + (U_k - u_k) / T ,   T: CurrentSettings::relaxation
/// and a particle is accelerated by a(z), linear between the layers' middles: an acceleration that does not depend on
/// the time step, nor on what a single particle does. A wave moves the particles of a layer to and fro, not their mean,
/// so it is not damped. That holds where a layer is full of water; crests move forward and have no troughs beside them
/// at their height. All layers that are not full, with those above and the first full one below, therefore share one
/// mean.
///
/// The mean momentum of each layer is what is held: a drift of the whole patch by the wind is held back with it.
class CurrentDrive {
 public:
  /// @param frame  of the patch
  /// @param water_level  m, world
  /// @param particles    that start
  CurrentDrive(const Scene& scene, const PatchFrame& frame, double water_level, std::size_t particles);

  /// Whether the water can move with a current along x or y at all.
  [[nodiscard]] bool any() const { return moves_[0] || moves_[1]; }
  [[nodiscard]] const std::array<bool, 2>& moves_water() const { return moves_; }

  /// Gives the water the current's velocity at once: the start of a scene.
  void start(TaskPool& pool, const Current& current, double time, std::span<const Float4> position, std::size_t count,
             std::span<Float4> velocity) const;

  /// Adds the acceleration at `time` (s) of the first `count` particles, m/s^2. Particles that are not finite count for
  /// nothing. Each particle writes only its own entry, sums are in a fixed order: the same bits for any number of
  /// threads.
  void add_acceleration(TaskPool& pool, const Current& current, double time, std::span<const Float4> position,
                        std::span<const Float4> velocity, std::size_t count, std::span<Float4> acceleration);

 private:
  using Vector2 = std::array<double, 2>;
  [[nodiscard]] double full_row(const Scene& scene, std::size_t particles) const;
  [[nodiscard]] CurrentLayers layers() const;
  [[nodiscard]] std::size_t first_shared_layer() const;
  [[nodiscard]] double mean_profile(const CurrentSettings& current, std::size_t layer) const;
  void choose_accelerations(const Current& current, double time);

  std::array<bool, 2> moves_{false, false};
  double floor_ = 0.0;          ///< m, local: lower edge of the lowest layer
  double spacing_ = 0.0;        ///< m
  double depth_ = 0.0;          ///< m, of the water at rest above `floor_`
  std::size_t rows_ = 1;        ///< of the lattice at rest
  std::size_t layer_rows_ = 2;  ///< rows of a layer
  double full_ = 1.0;           ///< particles of a full layer

  std::vector<LayerSum> partial_;      ///< [blocks][layers]
  std::vector<LayerSum> layer_;        ///< [layers]
  std::vector<Vector2> acceleration_;  ///< [layers], m/s^2
};

}  // namespace pelagos
