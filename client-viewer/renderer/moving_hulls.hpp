#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "packing/surface_particle.hpp"
#include "renderer/foam_map.hpp"
#include "values/body.hpp"
#include "waves/wave_moment.hpp"

namespace pelagos {

/// The box around a body's mesh, m, body axes.
struct HullBox {
  Eigen::Vector3d low = Eigen::Vector3d::Zero(), high = Eigen::Vector3d::Zero();
};

/// m/s, horizontal: how the water moves as a whole, by a current or because it flows past a patch that goes along with
/// a ship. What waves move to and fro does not count.
[[nodiscard]] Eigen::Vector2d flow_of(std::span<const SurfaceParticle> particles, std::span<const MomentWave> waves);

/// The bodies with a box that stand in the water's surface, in their order.
/// @param waves   anchored at `anchor` (m, world)
/// @param level   m, world z of the mean water level
/// @param flow    m/s, see flow_of()
[[nodiscard]] std::vector<MovingHull> moving_hulls(std::span<const BodyState> bodies,
                                                   const std::map<std::uint32_t, HullBox>& boxes,
                                                   const WaveMoment& waves, const Eigen::Vector2d& anchor, double level,
                                                   const Eigen::Vector2d& flow);

}  // namespace pelagos
