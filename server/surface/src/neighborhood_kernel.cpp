#include "neighborhood_kernel.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "neighborhood_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "physics/simd_records-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace pelagos {
namespace HWY_NAMESPACE {

// No multiplication is fused with an addition: every instruction set gives the same bits.

/// Differences of x, y and z, one a lane.
template <class V>
struct Differences {
  V x, y, z;
};

template <class V>
HWY_INLINE V dot(const Differences<V>& a, const Differences<V>& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
template <class V>
HWY_INLINE Differences<V> difference(const Records<V>& a, const Records<V>& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
template <class M, class V>
HWY_INLINE Differences<V> zero_unless(M mask, const Differences<V>& a) {
  return {hn::IfThenElseZero(mask, a.x), hn::IfThenElseZero(mask, a.y), hn::IfThenElseZero(mask, a.z)};
}

/// Support radius in the forms that the weights need.
template <class D>
struct Support {
  hn::Vec<D> squared, inverse, inverse_cubed;
};
template <class D>
HWY_INLINE Support<D> make_support(D d, float radius) {
  return {hn::Set(d, radius * radius), hn::Set(d, 1.0F / radius), hn::Set(d, 1.0F / (radius * radius * radius))};
}

/// 1 - (r/h)^3 where `near` holds, else 0.
template <class D, class M, class V>
HWY_INLINE V weight_of(D d, M near, V squared, V distance, V inverse_cubed) {
  const V cubed = hn::Mul(squared, distance);
  return hn::IfThenElseZero(near, hn::Sub(hn::Set(d, 1.0F), hn::Mul(cubed, inverse_cubed)));
}

void add_slots_impl(const Float4* query, const Float4* neighbors, const std::int32_t* slots,
                    NeighborList::SlotRange range, float support_radius, GroupSums& sums) {
  const FloatTag d;
  const Support<FloatTag> support = make_support(d, support_radius);
  const auto add_to = [&](float* sum, FloatV value) HWY_ATTR { hn::Store(hn::Add(hn::Load(d, sum), value), d, sum); };
  for (std::size_t lane = 0; lane < kLanes; lane += hn::Lanes(d)) {
    const Vec4 own = load_records(query + lane);
    FloatV weight = hn::Zero(d), x = weight, y = weight, z = weight;
    for (std::size_t slot = range.begin; slot < range.end; ++slot) {
      const Differences<FloatV> r = difference(gather_records(neighbors, slots + kLanes * slot + lane), own);
      const FloatV squared = dot(r, r);
      const auto near = hn::Lt(squared, support.squared);  // false for NaN
      const FloatV w = weight_of(d, near, squared, hn::Sqrt(squared), support.inverse_cubed);
      const Differences<FloatV> near_r = zero_unless(near, r);
      weight = hn::Add(weight, w);
      x = hn::Add(x, hn::Mul(w, near_r.x));
      y = hn::Add(y, hn::Mul(w, near_r.y));
      z = hn::Add(z, hn::Mul(w, near_r.z));
    }
    add_to(sums.weight + lane, weight);
    add_to(sums.x + lane, x);
    add_to(sums.y + lane, y);
    add_to(sums.z + lane, z);
  }
}

/// Neighbours of one particle are taken four at a time on every machine: so many partial sums, added in one order. A
/// machine without vectors takes them in four parts.
constexpr std::size_t kFour = 4;
using FourTag = hn::CappedTag<float, kFour>;
using FourV = hn::Vec<FourTag>;

HWY_INLINE Records<FourV> repeat(const Float4& a) {
  const FourTag d;
  return {hn::Set(d, a.x), hn::Set(d, a.y), hn::Set(d, a.z), hn::Set(d, a.w)};
}

/// Partial sums of ParticleSums.
struct FourSums {
  FourV weight, x, y, z, xx, xy, xz, yy, yz, zz, closing, closing_weight;
};
HWY_INLINE void add_moments(FourV w, const Differences<FourV>& r, FourSums& sums) {
  const Differences<FourV> wr{hn::Mul(w, r.x), hn::Mul(w, r.y), hn::Mul(w, r.z)};
  sums.weight = hn::Add(sums.weight, w);
  sums.x = hn::Add(sums.x, wr.x);
  sums.y = hn::Add(sums.y, wr.y);
  sums.z = hn::Add(sums.z, wr.z);
  sums.xx = hn::Add(sums.xx, hn::Mul(wr.x, r.x));
  sums.xy = hn::Add(sums.xy, hn::Mul(wr.x, r.y));
  sums.xz = hn::Add(sums.xz, hn::Mul(wr.x, r.z));
  sums.yy = hn::Add(sums.yy, hn::Mul(wr.y, r.y));
  sums.yz = hn::Add(sums.yz, hn::Mul(wr.y, r.z));
  sums.zz = hn::Add(sums.zz, hn::Mul(wr.z, r.z));
}
/// The partial sums of each member of ParticleSums, from all parts.
struct PartialSums {
  HWY_ALIGN float value[12][kFour];
};
HWY_INLINE void store_part(const FourSums& sums, std::size_t part, PartialSums& out) {
  const FourV all[12] = {sums.weight, sums.x,  sums.y,  sums.z,  sums.xx,      sums.xy,
                         sums.xz,     sums.yy, sums.yz, sums.zz, sums.closing, sums.closing_weight};
  for (std::size_t n = 0; n < 12; ++n) hn::StoreU(all[n], FourTag(), out.value[n] + part);
}
void add_sums(const PartialSums& from, ParticleSums& to) {
  float* const all[12] = {&to.weight, &to.x,  &to.y,  &to.z,  &to.xx,      &to.xy,
                          &to.xz,     &to.yy, &to.yz, &to.zz, &to.closing, &to.closing_weight};
  for (std::size_t n = 0; n < 12; ++n) {
    const float* part = from.value[n];
    *all[n] += (part[0] + part[1]) + (part[2] + part[3]);
  }
}

/// Neighbours of one particle.
struct ParticleRow {
  const std::int32_t* slots;
  std::size_t count;
  std::int32_t dummy;

  [[nodiscard]] std::int32_t operator[](std::size_t k) const { return k < count ? slots[k * kLanes] : dummy; }
};

/// The partial sums of the neighbours part, part + 4, ...; as many as a vector has lanes.
HWY_INLINE FourSums sum_part(const Float4& own, const Float4& own_velocity, const Float4* neighbors,
                             const Float4* velocities, const ParticleRow& row, std::size_t part, float support_radius) {
  const FourTag d;
  const Support<FourTag> support = make_support(d, support_radius);
  const FourV zero = hn::Zero(d), one = hn::Set(d, 1.0F);
  const Records<FourV> centre = repeat(own), centre_velocity = repeat(own_velocity);
  FourSums sums{zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero};
  for (std::size_t k = 0; k < row.count; k += kFour) {
    std::int32_t index[kFour];
    for (std::size_t n = 0; n < hn::Lanes(d); ++n) index[n] = row[k + part + n];
    const Differences<FourV> far_r = difference(gather_records(d, neighbors, index), centre);
    const FourV squared = dot(far_r, far_r), distance = hn::Sqrt(squared);
    const auto near = hn::Lt(squared, support.squared);
    const Differences<FourV> r = zero_unless(near, far_r);
    add_moments(weight_of(d, near, squared, distance, support.inverse_cubed), r, sums);
    if (velocities == nullptr) continue;
    const Differences<FourV> v = difference(gather_records(d, velocities, index), centre_velocity);
    const FourV speed = hn::Sub(hn::Sqrt(dot(v, v)), hn::Div(dot(v, r), distance));
    // Counted are neighbours at a distance whose closing speed is a number.
    const auto counted = hn::And(hn::And(near, hn::Gt(squared, zero)), hn::Eq(speed, speed));
    const FourV share = hn::IfThenElseZero(counted, hn::Sub(one, hn::Mul(distance, support.inverse)));
    sums.closing = hn::Add(sums.closing, hn::Mul(share, hn::IfThenElseZero(counted, speed)));
    sums.closing_weight = hn::Add(sums.closing_weight, share);
  }
  return sums;
}

void add_neighbors_impl(const Float4& own, const Float4& own_velocity, const Float4* neighbors,
                        const Float4* velocities, const NeighborList& list, std::size_t i, float support_radius,
                        ParticleSums& sums) {
  const std::size_t first = list.groups[i / kLanes].begin * kLanes + i % kLanes;
  const ParticleRow row{list.slots.data() + first, list.pair_count[i], list.dummy};
  PartialSums partial;
  for (std::size_t part = 0; part < kFour; part += hn::Lanes(FourTag()))
    store_part(sum_part(own, own_velocity, neighbors, velocities, row, part, support_radius), part, partial);
  add_sums(partial, sums);
}

}  // namespace HWY_NAMESPACE
}  // namespace pelagos
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pelagos {

HWY_EXPORT(add_slots_impl);
HWY_EXPORT(add_neighbors_impl);

void add_slots(const Float4* query, const Float4* neighbors, const std::int32_t* slots, NeighborList::SlotRange range,
               float support_radius, GroupSums& sums) {
  HWY_DYNAMIC_DISPATCH(add_slots_impl)(query, neighbors, slots, range, support_radius, sums);
}

void add_neighbors(const Float4& own, const Float4& own_velocity, const Float4* neighbors, const Float4* velocities,
                   const NeighborList& list, std::size_t i, float support_radius, ParticleSums& sums) {
  HWY_DYNAMIC_DISPATCH(add_neighbors_impl)
  (own, own_velocity, neighbors, velocities, list, i, support_radius, sums);
}

}  // namespace pelagos
#endif  // HWY_ONCE
