#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <span>
#include <vector>

#include "simulation/open_sea.hpp"

namespace pelagos {

/// Hulls that are in reach of the rim.
struct HullsAtRim {
  std::span<const Eigen::AlignedBox3d> boxes;                ///< m, world: around them
  std::function<bool(const Eigen::Vector3f& local)> covers;  ///< whether no particle may stand at a place
};

/// The theory's displacement and velocity for the rim, as OpenSea has them at a time.
struct RimMotion {
  WaveMoment place, velocity;
};

/// Where hulls stand in the rim of an open sea, its particles are taken out, for they cannot give way. Their labels are
/// kept, and they come back when the hull has gone and no other water stands there.
class RimGaps {
 public:
  [[nodiscard]] bool empty() const { return labels_.empty(); }

  /// Between steps. Whether particles have come or gone.
  bool renew(TaskPool& pool, const OpenSea& sea, const PatchFrame& frame, const HullsAtRim& hulls,
             const RimMotion& motion, FluidState& fluid);

  /// The patch has moved by a spacing, as OpenSea::shift says. Gaps that are no longer in the rim are none.
  void shift(const OpenSea& sea, std::size_t axis, int way);

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("labels", self.labels_);
  }

 private:
  bool open(TaskPool& pool, const OpenSea& sea, const PatchFrame& frame, const HullsAtRim& hulls, FluidState& fluid);
  bool close(const OpenSea& sea, const HullsAtRim& hulls, const RimMotion& motion, FluidState& fluid);

  std::vector<Float4> labels_;
};

}  // namespace pelagos
