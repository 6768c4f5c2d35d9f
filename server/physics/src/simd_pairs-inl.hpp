// Included once per instruction set by hwy/foreach_target.h, hence the toggled guard.
#if defined(PELAGOS_PHYSICS_SIMD_PAIRS_INL_HPP_) == defined(HWY_TARGET_TOGGLE)
#ifdef PELAGOS_PHYSICS_SIMD_PAIRS_INL_HPP_
#undef PELAGOS_PHYSICS_SIMD_PAIRS_INL_HPP_
#else
#define PELAGOS_PHYSICS_SIMD_PAIRS_INL_HPP_
#endif

#include <hwy/highway.h>

#include "compress_table.hpp"
#include "physics/particles.hpp"

HWY_BEFORE_NAMESPACE();
namespace pelagos {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, kLanes>;
using IntTag = hn::RebindToSigned<FloatTag>;
using FloatV = hn::Vec<FloatTag>;
using IntV = hn::Vec<IntTag>;

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

struct Vec4 {
  FloatV x, y, z, w;
};

/// Brings one 16-byte record for each lane and transposes: the one gather helper that all pair loops share.
HWY_INLINE Vec4 gather_records(const Float4* HWY_RESTRICT base, const std::int32_t* HWY_RESTRICT index) {
#if HWY_TARGET == HWY_AVX3
  const auto load = [&](int k) { return _mm_load_ps(&base[index[k]].x); };
  const auto four = [&](int k) {
    __m512 v = _mm512_castps128_ps512(load(k));
    v = _mm512_mask_broadcast_f32x4(v, 0x00F0, load(k + 4));
    v = _mm512_mask_broadcast_f32x4(v, 0x0F00, load(k + 8));
    return _mm512_mask_broadcast_f32x4(v, 0xF000, load(k + 12));
  };
  const __m512 a = four(0), b = four(1), c = four(2), e = four(3);
  const __m512d ab_low = _mm512_castps_pd(_mm512_unpacklo_ps(a, b)),
                ab_high = _mm512_castps_pd(_mm512_unpackhi_ps(a, b));
  const __m512d ce_low = _mm512_castps_pd(_mm512_unpacklo_ps(c, e)),
                ce_high = _mm512_castps_pd(_mm512_unpackhi_ps(c, e));
  return {FloatV{_mm512_castpd_ps(_mm512_unpacklo_pd(ab_low, ce_low))},
          FloatV{_mm512_castpd_ps(_mm512_unpackhi_pd(ab_low, ce_low))},
          FloatV{_mm512_castpd_ps(_mm512_unpacklo_pd(ab_high, ce_high))},
          FloatV{_mm512_castpd_ps(_mm512_unpackhi_pd(ab_high, ce_high))}};
#elif HWY_TARGET == HWY_AVX2
  const auto two = [&](int k) {
    const __m256 low = _mm256_castps128_ps256(_mm_load_ps(&base[index[k]].x));
    return _mm256_insertf128_ps(low, _mm_load_ps(&base[index[k + 4]].x), 1);
  };
  const __m256 a = two(0), b = two(1), c = two(2), e = two(3);
  const __m256d ab_low = _mm256_castps_pd(_mm256_unpacklo_ps(a, b)),
                ab_high = _mm256_castps_pd(_mm256_unpackhi_ps(a, b));
  const __m256d ce_low = _mm256_castps_pd(_mm256_unpacklo_ps(c, e)),
                ce_high = _mm256_castps_pd(_mm256_unpackhi_ps(c, e));
  return {FloatV{_mm256_castpd_ps(_mm256_unpacklo_pd(ab_low, ce_low))},
          FloatV{_mm256_castpd_ps(_mm256_unpackhi_pd(ab_low, ce_low))},
          FloatV{_mm256_castpd_ps(_mm256_unpacklo_pd(ab_high, ce_high))},
          FloatV{_mm256_castpd_ps(_mm256_unpackhi_pd(ab_high, ce_high))}};
#else
  const FloatTag d;
  const std::size_t lanes = hn::Lanes(d);
  HWY_ALIGN float x[kLanes], y[kLanes], z[kLanes], w[kLanes];
  for (std::size_t k = 0; k < lanes; ++k) {
    const Float4& record = base[index[k]];
    x[k] = record.x;
    y[k] = record.y;
    z[k] = record.z;
    w[k] = record.w;
  }
  return {hn::Load(d, x), hn::Load(d, y), hn::Load(d, z), hn::Load(d, w)};
#endif
}

/// Loads consecutive records and transposes them (the query side of a pair loop).
HWY_INLINE Vec4 load_records(const Float4* from) {
  const FloatTag d;
  Vec4 v;
  hn::LoadInterleaved4(d, &from->x, v.x, v.y, v.z, v.w);
  return v;
}
HWY_INLINE void store_records(const Vec4& v, Float4* to) {
  hn::StoreInterleaved4(v.x, v.y, v.z, v.w, FloatTag(), &to->x);
}

/// Stores the lanes of `v` where `mask` holds, packed; a whole vector is written. Returns how many they are.
HWY_INLINE std::size_t store_packed(IntV v, hn::Mask<IntTag> mask, std::int32_t* to) {
  const IntTag di;
#if HWY_TARGET == HWY_AVX2
  const auto bits = static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(hn::VecFromMask(di, mask).raw)));
  const __m256i lanes = _mm256_load_si256(reinterpret_cast<const __m256i*>(kCompressTable[bits].data()));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm256_permutevar8x32_epi32(v.raw, lanes));
  return static_cast<std::size_t>(__builtin_popcount(bits));
#else
  hn::StoreU(hn::Compress(v, mask), di, to);
  return hn::CountTrue(di, mask);
#endif
}

/// 1/sqrt(v) to single precision (one Newton step on the estimate).
HWY_INLINE FloatV inverse_sqrt(FloatV v) {
  const FloatTag d;
#if HWY_TARGET == HWY_AVX3
  const FloatV e{_mm512_rsqrt14_ps(v.raw)};
#elif HWY_TARGET == HWY_AVX2
  const FloatV e{_mm256_rsqrt_ps(v.raw)};
#else
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
