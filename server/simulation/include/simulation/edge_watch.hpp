#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>

#include "simulation/open_sea.hpp"
#include "simulation/water_surface.hpp"
#include "values/edge_quality.hpp"

namespace pelagos {

/// Keeps the figures of an open sea's edges. They are for people: the state does not have them, and no step depends on
/// them.
class EdgeWatch {
 public:
  void count(const Renewal& renewal);
  /// @param dt  s, of the step
  void add_zones(const ZoneMismatch& mismatch, double dt);
  /// The particles' heights at places inside against the waves' that the patch carries.
  /// @param moment  of the carried waves, about local zero   @param seconds  since the last time
  /// @param hidden  whether a hull stands at a place, m, local: the place is left out
  void add_heights(const OpenSeaShape& shape, const SurfaceGrid& surface, const WaveMoment& moment, double seconds,
                   const std::function<bool(const Eigen::Vector3d&)>& hidden);
  /// @param free, wanted  particles that are not held, now and at the start
  [[nodiscard]] EdgeQuality quality(const OpenSeaShape& shape, std::size_t free, std::size_t wanted,
                                    const WaveMoment& moment) const;

 private:
  std::uint64_t created_ = 0, deleted_ = 0;
  double mismatch_ = 0.0, mismatch_weight_ = 0.0;  ///< sums that fade
  double product_ = 0.0, square_ = 0.0, seconds_ = 0.0;
};

}  // namespace pelagos
