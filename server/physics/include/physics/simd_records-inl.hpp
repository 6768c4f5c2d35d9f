// Included once per instruction set by hwy/foreach_target.h, hence the toggled guard.
#if defined(PELAGOS_PHYSICS_SIMD_RECORDS_INL_HPP_) == defined(HWY_TARGET_TOGGLE)
#ifdef PELAGOS_PHYSICS_SIMD_RECORDS_INL_HPP_
#undef PELAGOS_PHYSICS_SIMD_RECORDS_INL_HPP_
#else
#define PELAGOS_PHYSICS_SIMD_RECORDS_INL_HPP_
#endif

#include <hwy/highway.h>

#include <cstdint>

#include "physics/particles.hpp"

// Records of four floats to vectors of their components and back. All of it moves data: no value is rounded.

HWY_BEFORE_NAMESPACE();
namespace pelagos {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// As many lanes as the machine has, at most kLanes: a vector is a whole part of a group.
using FloatTag = hn::CappedTag<float, kLanes>;
using IntTag = hn::RebindToSigned<FloatTag>;
using FloatV = hn::Vec<FloatTag>;
using IntV = hn::Vec<IntTag>;

/// x, y, z and w of a record for each lane.
template <class V>
struct Records {
  V x, y, z, w;
};
using Vec4 = Records<FloatV>;

#if HWY_TARGET == HWY_SCALAR
/// Brings one 16-byte record for each lane and transposes: the one gather helper that all pair loops share.
template <class D>
HWY_INLINE Records<hn::Vec<D>> gather_records(D d, const Float4* HWY_RESTRICT base,
                                              const std::int32_t* HWY_RESTRICT index) {
  const Float4& record = base[index[0]];
  return {hn::Set(d, record.x), hn::Set(d, record.y), hn::Set(d, record.z), hn::Set(d, record.w)};
}
#else
/// One record in each block of four lanes: those of the lanes first, first + 4, ... of `index`.
template <class D>
HWY_INLINE hn::Vec<D> load_blocks(D d, const Float4* HWY_RESTRICT base, const std::int32_t* HWY_RESTRICT index) {
  if constexpr (hn::MaxLanes(D()) == 16) {
    const hn::Half<D> half;
    const hn::Half<hn::Half<D>> block;
    const auto load = [&](int k) HWY_ATTR { return hn::Load(block, &base[index[k]].x); };
    return hn::Combine(d, hn::Combine(half, load(12), load(8)), hn::Combine(half, load(4), load(0)));
  } else if constexpr (hn::MaxLanes(D()) == 8) {
    const hn::Half<D> block;
    return hn::Combine(d, hn::Load(block, &base[index[4]].x), hn::Load(block, &base[index[0]].x));
  } else {
    static_assert(hn::MaxLanes(D()) == 4);
    return hn::Load(d, &base[index[0]].x);
  }
}

/// Brings one 16-byte record for each lane and transposes: the one gather helper that all pair loops share.
template <class D>
HWY_INLINE Records<hn::Vec<D>> gather_records(D d, const Float4* HWY_RESTRICT base,
                                              const std::int32_t* HWY_RESTRICT index) {
  const hn::Repartition<double, D> pairs;
  const hn::Vec<D> a = load_blocks(d, base, index), b = load_blocks(d, base, index + 1);
  const hn::Vec<D> c = load_blocks(d, base, index + 2), e = load_blocks(d, base, index + 3);
  const auto xy_ab = hn::BitCast(pairs, hn::InterleaveLower(d, a, b));  // xa xb ya yb
  const auto zw_ab = hn::BitCast(pairs, hn::InterleaveUpper(d, a, b));
  const auto xy_ce = hn::BitCast(pairs, hn::InterleaveLower(d, c, e));
  const auto zw_ce = hn::BitCast(pairs, hn::InterleaveUpper(d, c, e));
  return {hn::BitCast(d, hn::InterleaveLower(pairs, xy_ab, xy_ce)),
          hn::BitCast(d, hn::InterleaveUpper(pairs, xy_ab, xy_ce)),
          hn::BitCast(d, hn::InterleaveLower(pairs, zw_ab, zw_ce)),
          hn::BitCast(d, hn::InterleaveUpper(pairs, zw_ab, zw_ce))};
}
#endif
HWY_INLINE Vec4 gather_records(const Float4* HWY_RESTRICT base, const std::int32_t* HWY_RESTRICT index) {
  return gather_records(FloatTag(), base, index);
}

/// Loads consecutive records and transposes them (the query side of a pair loop).
HWY_INLINE Vec4 load_records(const Float4* from) {
  const FloatTag d;
  FloatV x, y, z, w;
  hn::LoadInterleaved4(d, &from->x, x, y, z, w);
  return {x, y, z, w};
}
HWY_INLINE void store_records(const Vec4& v, Float4* to) {
  hn::StoreInterleaved4(v.x, v.y, v.z, v.w, FloatTag(), &to->x);
}

}  // namespace HWY_NAMESPACE
}  // namespace pelagos
HWY_AFTER_NAMESPACE();

#endif
