// Included once per instruction set by hwy/foreach_target.h, hence the toggled guard.
#if defined(PELAGOS_PHYSICS_PAIR_KERNEL_INL_HPP_) == defined(HWY_TARGET_TOGGLE)
#ifdef PELAGOS_PHYSICS_PAIR_KERNEL_INL_HPP_
#undef PELAGOS_PHYSICS_PAIR_KERNEL_INL_HPP_
#else
#define PELAGOS_PHYSICS_PAIR_KERNEL_INL_HPP_
#endif

#include <hwy/highway.h>

#include <cmath>

#include "physics/pair_passes.hpp"
#include "simd_pairs-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace pelagos {
namespace HWY_NAMESPACE {

// What all passes over pairs share: vectors of the lanes, the geometry of a pair, the kernel of fluid and walls.

/// Calls f(first_lane, i) for the parts of a group that one vector covers.
template <class F>
HWY_INLINE void for_each_part(std::size_t group, F&& f) {
  for (std::size_t lane = 0; lane < kLanes; lane += hn::Lanes(FloatTag())) f(lane, group * kLanes + lane);
}

struct Vec3 {
  FloatV x, y, z;
};
HWY_INLINE Vec3 zero3() { return {hn::Zero(FloatTag()), hn::Zero(FloatTag()), hn::Zero(FloatTag())}; }
HWY_INLINE FloatV dot(const Vec3& a, const Vec3& b, FloatV plus) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::MulAdd(a.z, b.z, plus)));
}
HWY_INLINE void add_to(Vec3& sum, const Vec3& v) {
  sum.x = hn::Add(sum.x, v.x);
  sum.y = hn::Add(sum.y, v.y);
  sum.z = hn::Add(sum.z, v.z);
}

/// Squared length and kernel of a pair.
struct PairGeometry {
  FloatV x, y, z, r_squared;
};
HWY_INLINE PairGeometry difference(const Vec4& own, const Vec4& other) {
  const FloatV x = hn::Sub(own.x, other.x), y = hn::Sub(own.y, other.y), z = hn::Sub(own.z, other.z);
  return {x, y, z, hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)))};
}

HWY_INLINE Vec3 scaled(const PairGeometry& pair, FloatV factor) {
  return {hn::Mul(factor, pair.x), hn::Mul(factor, pair.y), hn::Mul(factor, pair.z)};
}

/// Scales of the cubic spline for pairs of fluid (volume V) and for wall samples (volume in the record).
struct KernelScales {
  FloatV support, inverse_support, value, gradient_spacing, wall_value, wall_gradient;
};
HWY_INLINE KernelScales kernel_scales(const PairData& data) {
  const FloatTag d;
  const float radius = data.support_radius, sigma = static_cast<float>(8.0 / M_PI) / (radius * radius * radius);
  const float squared = radius * radius;
  return {hn::Set(d, radius),
          hn::Set(d, 1.0F / radius),
          hn::Set(d, sigma * data.volume),
          hn::Set(d, sigma * data.volume * data.spacing / squared),
          hn::Set(d, sigma),
          hn::Set(d, sigma / squared)};
}

/// Which lanes hold particles of the lighter phase.
HWY_INLINE hn::Mask<FloatTag> is_light(FloatV phase) { return hn::Gt(phase, hn::Set(FloatTag(), 0.5F)); }
HWY_INLINE FloatV choose_phase(hn::Mask<FloatTag> light, float of_light, float of_heavy) {
  const FloatTag d;
  return hn::IfThenElse(light, hn::Set(d, of_light), hn::Set(d, of_heavy));
}

/// sum_b V_b W_ib of a vector of particles.
HWY_INLINE FloatV wall_density(const PairData& data, const KernelScales& scales, const Vec4& own, std::size_t group,
                               std::size_t lane) {
  FloatV sum = hn::Zero(FloatTag());
  const NeighborList::SlotRange walls = data.boundary->groups[group];
  for (std::uint32_t s = walls.begin; s < walls.end; ++s) {
    const Vec4 other = gather_records(data.walls->position.data(), data.boundary->slots.data() + s * kLanes + lane);
    const PairGeometry pair = difference(own, other);
    sum = hn::MulAdd(cubic_spline(pair.r_squared, scales.support, scales.inverse_support).value, other.w, sum);
  }
  return hn::Mul(sum, scales.wall_value);
}

}  // namespace HWY_NAMESPACE
}  // namespace pelagos
HWY_AFTER_NAMESPACE();

#endif
