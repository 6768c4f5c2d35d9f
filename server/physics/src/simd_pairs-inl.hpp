// Included once per instruction set by hwy/foreach_target.h, hence the toggled guard.
#if defined(PELAGOS_PHYSICS_SIMD_PAIRS_INL_HPP_) == defined(HWY_TARGET_TOGGLE)
#ifdef PELAGOS_PHYSICS_SIMD_PAIRS_INL_HPP_
#undef PELAGOS_PHYSICS_SIMD_PAIRS_INL_HPP_
#else
#define PELAGOS_PHYSICS_SIMD_PAIRS_INL_HPP_
#endif

#include <hwy/highway.h>

#include "compress_table.hpp"
#include "physics/simd_records-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace pelagos {
namespace HWY_NAMESPACE {

/// Gradients cached within a solve are stored in half precision where the machine converts it in one instruction.
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX2
using CachedGradient = hwy::float16_t;
#else
using CachedGradient = float;
#endif

HWY_INLINE FloatV load_cached(const hwy::float16_t* from) {
  const FloatTag d;
  return hn::PromoteTo(d, hn::LoadU(hn::Rebind<hwy::float16_t, FloatTag>(), from));
}
HWY_INLINE FloatV load_cached(const float* from) { return hn::LoadU(FloatTag(), from); }
/// Returns the value as it will be read back.
HWY_INLINE FloatV store_cached(FloatV v, hwy::float16_t* to) {
  const FloatTag d;
  const hn::Rebind<hwy::float16_t, FloatTag> d16;
  const auto half = hn::DemoteTo(d16, v);
  hn::StoreU(half, d16, to);
  return hn::PromoteTo(d, half);
}
HWY_INLINE FloatV store_cached(FloatV v, float* to) {
  hn::StoreU(v, FloatTag(), to);
  return v;
}

/// Stores the lanes of `v` where `mask` holds, packed; a whole vector is written. Returns how many they are.
HWY_INLINE std::size_t store_packed(IntV v, hn::Mask<IntTag> mask, std::int32_t* to) {
  const IntTag di;
#if HWY_TARGET == HWY_AVX2
  std::uint8_t bits = 0;
  hn::StoreMaskBits(di, mask, &bits);
  hn::StoreU(hn::TableLookupLanes(v, hn::SetTableIndices(di, kCompressTable[bits].data())), di, to);
  return hwy::PopCount(bits);
#else
  hn::StoreU(hn::Compress(v, mask), di, to);
  return hn::CountTrue(di, mask);
#endif
}

/// 1/sqrt(v) to single precision (one Newton step on the estimate).
HWY_INLINE FloatV inverse_sqrt(FloatV v) {
  const FloatTag d;
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX2
  const FloatV e = hn::ApproximateReciprocalSqrt(v);
#else  // the estimates of the others differ from machine to machine
  const FloatV e = hn::Div(hn::Set(d, 1.0F), hn::Sqrt(v));
#endif
  const FloatV half = hn::Mul(hn::Set(d, 0.5F), v);
  return hn::Mul(e, hn::NegMulAdd(hn::Mul(half, e), e, hn::Set(d, 1.5F)));
}

/// Cubic spline at a squared distance: value / sigma, and (dW/dr)/r * support_radius^2 / sigma.
struct KernelPair {
  FloatV value, gradient_factor;
};
HWY_INLINE KernelPair cubic_spline(FloatV r_squared, FloatV radius, FloatV inverse_radius) {
  const FloatTag d;
  const FloatV safe = hn::Max(r_squared, hn::Set(d, 1e-20F));
  const FloatV r_inverse = inverse_sqrt(safe);
  const FloatV q = hn::Mul(hn::Mul(safe, r_inverse), inverse_radius);
  const FloatV zero = hn::Zero(d);
  const FloatV a = hn::Max(hn::Sub(hn::Set(d, 1.0F), q), zero), b = hn::Max(hn::Sub(hn::Set(d, 0.5F), q), zero);
  const FloatV a2 = hn::Mul(a, a), b2 = hn::Mul(b, b);
  const FloatV value = hn::MulAdd(hn::Mul(hn::Set(d, 2.0F), a2), a, hn::Mul(hn::Mul(hn::Set(d, -8.0F), b2), b));
  const FloatV slope = hn::MulAdd(hn::Set(d, -6.0F), a2, hn::Mul(hn::Set(d, 24.0F), b2));
  // (dW/dr)/r = sigma/R slope/r;  times R^2/sigma: slope R / r
  return {value, hn::Mul(slope, hn::Mul(r_inverse, radius))};
}

}  // namespace HWY_NAMESPACE
}  // namespace pelagos
HWY_AFTER_NAMESPACE();

#endif
