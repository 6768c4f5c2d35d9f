// Included once per instruction set by hwy/foreach_target.h, hence the toggled guard.
#if defined(PELAGOS_PHYSICS_GRADIENT_SUMS_INL_HPP_) == defined(HWY_TARGET_TOGGLE)
#ifdef PELAGOS_PHYSICS_GRADIENT_SUMS_INL_HPP_
#undef PELAGOS_PHYSICS_GRADIENT_SUMS_INL_HPP_
#else
#define PELAGOS_PHYSICS_GRADIENT_SUMS_INL_HPP_
#endif

#include <hwy/highway.h>

#include "kept_gradients-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace pelagos {
namespace HWY_NAMESPACE {

// Sums of gradients that describe the rows of J, and what follows from them.

/// Below this (in units of 1/spacing^2) a particle has no neighbours worth the name: alpha is zero there.
constexpr float kAlphaFloor = 1e-6F;
/// Symmetric matrix, one a lane.
struct Symmetric {
  FloatV xx, xy, xz, yy, yz, zz;
};
/// Of a correction's two records.
HWY_INLINE Symmetric symmetric(const Vec4& first, const Vec4& second) {
  return {first.x, first.y, first.z, first.w, second.x, second.y};
}
HWY_INLINE Vec3 multiply(const Symmetric& m, const Vec3& v) {
  const auto row = [&](FloatV a, FloatV b, FloatV c)
                       HWY_ATTR { return hn::MulAdd(a, v.x, hn::MulAdd(b, v.y, hn::Mul(c, v.z))); };
  return {row(m.xx, m.xy, m.xz), row(m.xy, m.yy, m.yz), row(m.xz, m.yz, m.zz)};
}

/// sum of a_ij over the fluid (times spacing) and of their squares.
struct GradientSums {
  Vec3 sum;
  FloatV squares;
};

/// alpha with two phases: the largest mobility around counts for all.
HWY_INLINE void divide_alpha(FloatV mobility, float* alpha) {
  const FloatTag d;
  hn::StoreU(hn::Div(hn::LoadU(d, alpha), mobility), d, alpha);
}

/// Writes alpha, S and the wall part of a vector of particles.
HWY_INLINE void store_gradient_sums(const PairData& data, const GradientSums& fluid, const Vec3& wall, FloatV wall_rate,
                                    std::size_t i, Float4* sum_out, Float4* wall_out, float* alpha_out) {
  const FloatTag d;
  const FloatV spacing = hn::Set(d, data.spacing), inverse_spacing = hn::Set(d, 1.0F / data.spacing);
  const Vec3 total{hn::MulAdd(wall.x, spacing, fluid.sum.x), hn::MulAdd(wall.y, spacing, fluid.sum.y),
                   hn::MulAdd(wall.z, spacing, fluid.sum.z)};
  const FloatV diagonal = dot(total, total, fluid.squares);
  const FloatV inverse = hn::Div(hn::Set(d, data.spacing * data.spacing), diagonal);
  hn::StoreU(hn::IfThenElseZero(hn::Gt(diagonal, hn::Set(d, kAlphaFloor)), inverse), d, alpha_out + i);
  store_records({hn::Mul(total.x, inverse_spacing), hn::Mul(total.y, inverse_spacing),
                 hn::Mul(total.z, inverse_spacing), hn::Zero(d)},
                sum_out + i);
  store_records({wall.x, wall.y, wall.z, wall_rate}, wall_out + i);
}

}  // namespace HWY_NAMESPACE
}  // namespace pelagos
HWY_AFTER_NAMESPACE();

#endif
