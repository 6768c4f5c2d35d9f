// Included once per instruction set by hwy/foreach_target.h, hence the toggled guard.
#if defined(PELAGOS_PHYSICS_KEPT_GRADIENTS_INL_HPP_) == defined(HWY_TARGET_TOGGLE)
#ifdef PELAGOS_PHYSICS_KEPT_GRADIENTS_INL_HPP_
#undef PELAGOS_PHYSICS_KEPT_GRADIENTS_INL_HPP_
#else
#define PELAGOS_PHYSICS_KEPT_GRADIENTS_INL_HPP_
#endif

#include <hwy/highway.h>

#include "pair_kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace pelagos {
namespace HWY_NAMESPACE {

// Gradients of pairs as they are kept within a step.

/// Three components of kLanes gradients.
constexpr std::size_t kCacheStride = 3 * kLanes;

/// Keeps a gradient; returns it as it will be read back, so that sums agree with it.
HWY_INLINE Vec3 keep_gradient(const Vec3& v, CachedGradient* out) {
  return {store_cached(v.x, out), store_cached(v.y, out + kLanes), store_cached(v.z, out + 2 * kLanes)};
}
HWY_INLINE Vec3 kept_gradient(const CachedGradient* from) {
  return {load_cached(from), load_cached(from + kLanes), load_cached(from + 2 * kLanes)};
}

}  // namespace HWY_NAMESPACE
}  // namespace pelagos
HWY_AFTER_NAMESPACE();

#endif
