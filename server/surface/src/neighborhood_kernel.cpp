#include "neighborhood_kernel.hpp"

#include <xmmintrin.h>

namespace pelagos {

namespace {

/// x, y and z of four records, one a lane.
struct FourPoints {
  __m128 x, y, z;
};

inline FourPoints load_four(const Float4& a, const Float4& b, const Float4& c, const Float4& d) {
  const __m128 ra = _mm_load_ps(&a.x), rb = _mm_load_ps(&b.x), rc = _mm_load_ps(&c.x), rd = _mm_load_ps(&d.x);
  const __m128 xy_ab = _mm_unpacklo_ps(ra, rb), xy_cd = _mm_unpacklo_ps(rc, rd);  // xa xb ya yb, xc xd yc yd
  const __m128 zw_ab = _mm_unpackhi_ps(ra, rb), zw_cd = _mm_unpackhi_ps(rc, rd);
  return {_mm_movelh_ps(xy_ab, xy_cd), _mm_movehl_ps(xy_cd, xy_ab), _mm_movelh_ps(zw_ab, zw_cd)};
}

inline __m128 dot(const FourPoints& a, const FourPoints& b) {
  return _mm_add_ps(_mm_add_ps(_mm_mul_ps(a.x, b.x), _mm_mul_ps(a.y, b.y)), _mm_mul_ps(a.z, b.z));
}

inline FourPoints difference(const FourPoints& a, const FourPoints& b) {
  return {_mm_sub_ps(a.x, b.x), _mm_sub_ps(a.y, b.y), _mm_sub_ps(a.z, b.z)};
}

inline FourPoints masked(__m128 mask, const FourPoints& a) {
  return {_mm_and_ps(mask, a.x), _mm_and_ps(mask, a.y), _mm_and_ps(mask, a.z)};
}

inline FourPoints repeat(const Float4& a) { return {_mm_set1_ps(a.x), _mm_set1_ps(a.y), _mm_set1_ps(a.z)}; }

/// Support radius in the forms that the weights need.
struct Support {
  explicit Support(float radius)
      : squared(_mm_set1_ps(radius * radius)),
        inverse(_mm_set1_ps(1.0f / radius)),
        inverse_cubed(_mm_set1_ps(1.0f / (radius * radius * radius))) {}
  __m128 squared, inverse, inverse_cubed;
};

inline float sum_of(__m128 a) {
  alignas(16) float lane[4];
  _mm_store_ps(lane, a);
  return (lane[0] + lane[1]) + (lane[2] + lane[3]);
}

inline void add_to(float* sum, __m128 value) { _mm_store_ps(sum, _mm_add_ps(_mm_load_ps(sum), value)); }

}  // namespace

void add_slots(const Float4* query, const Float4* neighbors, const std::int32_t* slots, NeighborList::SlotRange range,
               float support_radius, GroupSums& sums) {
  constexpr std::size_t kFour = 4;
  const Support support(support_radius);
  const __m128 one = _mm_set1_ps(1.0f);
  for (std::size_t lane = 0; lane < kLanes; lane += kFour) {
    const FourPoints own = load_four(query[lane], query[lane + 1], query[lane + 2], query[lane + 3]);
    __m128 weight = _mm_setzero_ps(), x = weight, y = weight, z = weight;
    for (std::size_t slot = range.begin; slot < range.end; ++slot) {
      const std::int32_t* index = slots + kLanes * slot + lane;
      const FourPoints r = difference(
          load_four(neighbors[index[0]], neighbors[index[1]], neighbors[index[2]], neighbors[index[3]]), own);
      const __m128 squared = dot(r, r);
      const __m128 near = _mm_cmplt_ps(squared, support.squared);  // all bits or none; none for NaN
      const __m128 cubed = _mm_mul_ps(squared, _mm_sqrt_ps(squared));
      const __m128 w = _mm_and_ps(near, _mm_sub_ps(one, _mm_mul_ps(cubed, support.inverse_cubed)));
      const FourPoints near_r = masked(near, r);
      weight = _mm_add_ps(weight, w);
      x = _mm_add_ps(x, _mm_mul_ps(w, near_r.x));
      y = _mm_add_ps(y, _mm_mul_ps(w, near_r.y));
      z = _mm_add_ps(z, _mm_mul_ps(w, near_r.z));
    }
    add_to(sums.weight + lane, weight);
    add_to(sums.x + lane, x);
    add_to(sums.y + lane, y);
    add_to(sums.z + lane, z);
  }
}

void add_neighbors(const Float4& own, const Float4& own_velocity, const Float4* neighbors, const Float4* velocities,
                   const NeighborList& list, std::size_t i, float support_radius, ParticleSums& sums) {
  const std::int32_t* slots = list.slots.data() + list.groups[i / kLanes].begin * kLanes + i % kLanes;
  const std::size_t count = list.pair_count[i];
  const auto index_of = [&](std::size_t k) { return k < count ? slots[k * kLanes] : list.dummy; };
  const Support support(support_radius);
  const __m128 one = _mm_set1_ps(1.0f), zero = _mm_setzero_ps();
  const FourPoints centre = repeat(own), centre_velocity = repeat(own_velocity);
  __m128 weight = zero, x = zero, y = zero, z = zero, closing = zero, closing_weight = zero;
  __m128 xx = zero, xy = zero, xz = zero, yy = zero, yz = zero, zz = zero;
  for (std::size_t k = 0; k < count; k += 4) {
    const std::int32_t a = index_of(k), b = index_of(k + 1), c = index_of(k + 2), d = index_of(k + 3);
    const FourPoints far_r = difference(load_four(neighbors[a], neighbors[b], neighbors[c], neighbors[d]), centre);
    const __m128 squared = dot(far_r, far_r);
    const __m128 near = _mm_cmplt_ps(squared, support.squared);
    const FourPoints r = masked(near, far_r);
    const __m128 distance = _mm_sqrt_ps(squared);
    const __m128 cubed = _mm_mul_ps(squared, distance);
    const __m128 w = _mm_and_ps(near, _mm_sub_ps(one, _mm_mul_ps(cubed, support.inverse_cubed)));
    const FourPoints wr{_mm_mul_ps(w, r.x), _mm_mul_ps(w, r.y), _mm_mul_ps(w, r.z)};
    weight = _mm_add_ps(weight, w);
    x = _mm_add_ps(x, wr.x);
    y = _mm_add_ps(y, wr.y);
    z = _mm_add_ps(z, wr.z);
    xx = _mm_add_ps(xx, _mm_mul_ps(wr.x, r.x));
    xy = _mm_add_ps(xy, _mm_mul_ps(wr.x, r.y));
    xz = _mm_add_ps(xz, _mm_mul_ps(wr.x, r.z));
    yy = _mm_add_ps(yy, _mm_mul_ps(wr.y, r.y));
    yz = _mm_add_ps(yz, _mm_mul_ps(wr.y, r.z));
    zz = _mm_add_ps(zz, _mm_mul_ps(wr.z, r.z));
    if (velocities == nullptr) continue;
    const FourPoints v =
        difference(load_four(velocities[a], velocities[b], velocities[c], velocities[d]), centre_velocity);
    const __m128 speed = _mm_sub_ps(_mm_sqrt_ps(dot(v, v)), _mm_div_ps(dot(v, r), distance));
    // Counted are neighbours at a distance whose closing speed is a number.
    const __m128 counted = _mm_and_ps(_mm_and_ps(near, _mm_cmpgt_ps(squared, zero)), _mm_cmpord_ps(speed, speed));
    const __m128 share = _mm_and_ps(counted, _mm_sub_ps(one, _mm_mul_ps(distance, support.inverse)));
    closing = _mm_add_ps(closing, _mm_mul_ps(share, _mm_and_ps(counted, speed)));
    closing_weight = _mm_add_ps(closing_weight, share);
  }
  sums.weight += sum_of(weight);
  sums.x += sum_of(x);
  sums.y += sum_of(y);
  sums.z += sum_of(z);
  sums.xx += sum_of(xx);
  sums.xy += sum_of(xy);
  sums.xz += sum_of(xz);
  sums.yy += sum_of(yy);
  sums.yz += sum_of(yz);
  sums.zz += sum_of(zz);
  sums.closing += sum_of(closing);
  sums.closing_weight += sum_of(closing_weight);
}

}  // namespace pelagos
