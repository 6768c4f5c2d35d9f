// Included once per instruction set by hwy/foreach_target.h, hence the toggled guard.
#if defined(PELAGOS_PHYSICS_SOLID_PAIRS_INL_HPP_) == defined(HWY_TARGET_TOGGLE)
#ifdef PELAGOS_PHYSICS_SOLID_PAIRS_INL_HPP_
#undef PELAGOS_PHYSICS_SOLID_PAIRS_INL_HPP_
#else
#define PELAGOS_PHYSICS_SOLID_PAIRS_INL_HPP_
#endif

#include <hwy/highway.h>

#include <type_traits>

#include "gradient_sums-inl.hpp"
#include "physics/solids.hpp"

HWY_BEFORE_NAMESPACE();
namespace pelagos {
namespace HWY_NAMESPACE {

// Image pairs in the surfaces of solids, see physics/solids.hpp.

/// The slots that a loop looks at, as bits: the work of two is done only where both are in use.
template <unsigned kUsed>
using Slots = std::integral_constant<unsigned, kUsed>;

/// A particle that lies on a surface or inside counts as this far outside, spacings: its images stay what they are.
constexpr float kLeastDistance = 1e-4F;

HWY_INLINE Vec3 scaled(const Vec3& v, FloatV factor) {
  return {hn::Mul(v.x, factor), hn::Mul(v.y, factor), hn::Mul(v.z, factor)};
}
HWY_INLINE Vec3 subtract(const Vec3& a, const Vec3& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
/// v + f n
HWY_INLINE Vec3 add_along(const Vec3& v, FloatV f, const Vec3& n) {
  return {hn::MulAdd(f, n.x, v.x), hn::MulAdd(f, n.y, v.y), hn::MulAdd(f, n.z, v.z)};
}

/// The surfaces of a vector of particles, by slot.
struct Mirrors {
  Vec3 normal[SolidPlanes::kSlots];
  FloatV distance[SolidPlanes::kSlots];
  Vec4 blend;
};

/// To be filled: vectors have no default value on every machine.
HWY_INLINE Mirrors no_mirrors() {
  const FloatV zero = hn::Zero(FloatTag());
  return {{zero3(), zero3()}, {zero, zero}, {zero, zero, zero, zero}};
}

HWY_INLINE void set_mirror(const Vec4& plane, const Vec3& x, FloatV least, std::size_t slot, Mirrors& mirrors) {
  const FloatTag d;
  mirrors.normal[slot] = {plane.x, plane.y, plane.z};
  mirrors.distance[slot] = hn::Max(least, hn::Sub(dot(mirrors.normal[slot], x, hn::Zero(d)), plane.w));
}
template <unsigned kUsed>
HWY_INLINE Mirrors own_mirrors(const PairData& data, std::size_t i, const Vec3& x) {
  Mirrors mirrors = no_mirrors();
  const FloatV least = hn::Set(FloatTag(), kLeastDistance * data.spacing);
  for (std::size_t slot = 0; slot < SolidPlanes::kSlots; ++slot)
    if (kUsed >> slot & 1U) set_mirror(load_records(data.solids->plane[slot].data() + i), x, least, slot, mirrors);
  mirrors.blend = load_records(data.solids->blend.data() + i);
  return mirrors;
}
template <unsigned kUsed>
HWY_INLINE Mirrors other_mirrors(const PairData& data, const std::int32_t* index, const Vec3& x) {
  Mirrors mirrors = no_mirrors();
  const FloatV least = hn::Set(FloatTag(), kLeastDistance * data.spacing);
  for (std::size_t slot = 0; slot < SolidPlanes::kSlots; ++slot)
    if (kUsed >> slot & 1U) set_mirror(gather_records(data.solids->plane[slot].data(), index), x, least, slot, mirrors);
  mirrors.blend = gather_records(data.solids->blend.data(), index);
  return mirrors;
}

/// How the image in the slots kIn counts for the particle itself.
template <unsigned kIn>
HWY_INLINE FloatV share_of(const Mirrors& mirrors) {
  return kIn == 1U ? mirrors.blend.x : kIn == 2U ? mirrors.blend.y : mirrors.blend.z;
}

/// R v of the surfaces in kIn, and R' v.
template <unsigned kIn>
HWY_INLINE Vec3 reflect(const Mirrors& mirrors, Vec3 v) {
  for (std::size_t k = SolidPlanes::kSlots; k-- > 0;)
    if (kIn >> k & 1U)
      v = add_along(v, hn::Mul(hn::Set(FloatTag(), -2.0F), dot(mirrors.normal[k], v, hn::Zero(FloatTag()))),
                    mirrors.normal[k]);
  return v;
}
template <unsigned kIn>
HWY_INLINE Vec3 reflect_back(const Mirrors& mirrors, Vec3 v) {
  for (std::size_t k = 0; k < SolidPlanes::kSlots; ++k)
    if (kIn >> k & 1U)
      v = add_along(v, hn::Mul(hn::Set(FloatTag(), -2.0F), dot(mirrors.normal[k], v, hn::Zero(FloatTag()))),
                    mirrors.normal[k]);
  return v;
}

/// One image of a pair: A, B and r'^2 of physics/solids.hpp.
struct ImagePair {
  Vec3 a, b;
  FloatV squared;
};
template <unsigned kIn>
HWY_INLINE ImagePair image_pair(const Mirrors& own, const Mirrors& other, const PairGeometry& pair) {
  ImagePair image{{pair.x, pair.y, pair.z}, {pair.x, pair.y, pair.z}, pair.r_squared};
  for (std::size_t k = 0; k < SolidPlanes::kSlots; ++k) {
    if (!(kIn >> k & 1U)) continue;
    const FloatV twice = hn::Add(own.distance[k], own.distance[k]);
    const FloatV other_twice = hn::Add(other.distance[k], other.distance[k]);
    image.squared = hn::MulAdd(twice, other_twice, image.squared);
    image.a = add_along(image.a, other_twice, own.normal[k]);
    image.b = add_along(image.b, hn::Neg(twice), other.normal[k]);
  }
  return image;
}

/// Calls f(Slots<in>) for each image that the slots in use make.
template <unsigned kUsed, class F>
HWY_INLINE void for_each_image(F&& f) {
  if constexpr (kUsed & 1U) f(Slots<1U>());
  if constexpr (kUsed & 2U) f(Slots<2U>());
  if constexpr (kUsed == 3U) f(Slots<3U>());
}

/// What the surfaces add to the walls' part of the gradients, by slot, times the spacing.
struct SolidWalls {
  Vec3 part[SolidPlanes::kSlots];
};
HWY_INLINE SolidWalls no_solid_walls() { return {{zero3(), zero3()}}; }
/// An image in both surfaces is both of theirs, half each.
template <unsigned kIn>
HWY_INLINE void add_wall(const Vec3& v, SolidWalls& walls) {
  if constexpr (kIn == 3U) {
    const Vec3 half = scaled(v, hn::Set(FloatTag(), 0.5F));
    add_to(walls.part[0], half);
    add_to(walls.part[1], half);
  } else {
    add_to(walls.part[kIn - 1U], v);
  }
}

/// Writes the parts, 1/m, and returns their sum.
HWY_INLINE Vec3 store_solid_walls(const PairData& data, const SolidWalls& walls, std::size_t i, Float4* const* out) {
  const FloatV inverse_spacing = hn::Set(FloatTag(), 1.0F / data.spacing);
  Vec3 sum = zero3();
  for (std::size_t k = 0; k < SolidPlanes::kSlots; ++k) {
    const Vec3 part = scaled(walls.part[k], inverse_spacing);
    store_records({part.x, part.y, part.z, hn::Zero(FloatTag())}, out[k] + i);
    add_to(sum, part);
  }
  return sum;
}

/// Calls f(Slots<used>) for the slots that a group uses.
template <class F>
HWY_INLINE void with_slots(const PairData& data, std::size_t group, F&& f) {
  switch (data.solids ? data.solids->group[group] : 0U) {
    case 1U:
      return f(Slots<1U>());
    case 2U:
      return f(Slots<2U>());
    case 3U:
      return f(Slots<3U>());
    default:
      return f(Slots<0U>());
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace pelagos
HWY_AFTER_NAMESPACE();

#endif
