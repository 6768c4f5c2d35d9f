#include <cmath>

#include "wind/wind.hpp"

namespace pelagos {

namespace {

constexpr std::size_t kParticlesPerBlock = 1024;

/// velocity += scale ln(z / roughness) v_ref(place), z above the floor. Nothing below the floor.
void add_push(TaskPool& pool, const Air& air, const Air::Moment& moment, double scale, std::span<const Float4> position,
              std::span<Float4> velocity) {
  const double floor = air.local_floor(), roughness = moment.wind.roughness;
  pool.for_each_range(position.size(), kParticlesPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      const Float4& p = position[n];
      const Eigen::Vector3d place = vector_of(p).cast<double>();
      const double height = place.z() - floor;
      if (!place.allFinite() || !(height > 0.0)) continue;
      const Eigen::Vector3f push = (scale * std::log(height / roughness) * air.reference(moment, place)).cast<float>();
      Float4& v = velocity[n];
      v = {v.x + push.x(), v.y + push.y(), v.z + push.z(), v.w};
    }
  });
}

}  // namespace

void Wind::push_as_printed(TaskPool& pool, std::span<const Float4> position, const Air::Moment& moment,
                           std::span<Float4> velocity) const {
  const double scale =
      moment.wind.beta * Air::kDensity / around_.rest_density / std::log(Air::kReferenceHeight / moment.wind.roughness);
  add_push(pool, air_, moment, scale, position, velocity);
}

}  // namespace pelagos
