#include "physics/pair_passes.hpp"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pair_passes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "pass_outputs.hpp"
#include "simd_pairs-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace pelagos {
namespace HWY_NAMESPACE {

/// Below this (in units of 1/spacing^2) a particle has no neighbours worth the name: alpha is zero there.
constexpr float kAlphaFloor = 1e-6F;
/// Three components of kLanes gradients.
constexpr std::size_t kCacheStride = 3 * kLanes;

std::size_t cached_gradient_size() { return sizeof(CachedGradient); }

/// Calls f(first_lane, i) for the parts of a group that one vector covers.
template <class F>
HWY_INLINE void for_each_part(std::size_t group, F&& f) {
  for (std::size_t lane = 0; lane < kLanes; lane += hn::Lanes(FloatTag())) f(lane, group * kLanes + lane);
}

/// Squared length and kernel of a pair.
struct PairGeometry {
  FloatV x, y, z, r_squared;
};
HWY_INLINE PairGeometry difference(const Vec4& own, const Vec4& other) {
  const FloatV x = hn::Sub(own.x, other.x), y = hn::Sub(own.y, other.y), z = hn::Sub(own.z, other.z);
  return {x, y, z, hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)))};
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
HWY_INLINE Vec3 scaled(const PairGeometry& pair, FloatV factor) {
  return {hn::Mul(factor, pair.x), hn::Mul(factor, pair.y), hn::Mul(factor, pair.z)};
}

/// Keeps a gradient; returns it as it will be read back, so that sums agree with it.
HWY_INLINE Vec3 keep_gradient(const Vec3& v, CachedGradient* out) {
  return {store_cached(v.x, out), store_cached(v.y, out + kLanes), store_cached(v.z, out + 2 * kLanes)};
}
HWY_INLINE Vec3 kept_gradient(const CachedGradient* from) {
  return {load_cached(from), load_cached(from + kLanes), load_cached(from + 2 * kLanes)};
}

/// Symmetric matrix, one a lane.
struct Symmetric {
  FloatV xx, xy, xz, yy, yz, zz;
};
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

/// Which lanes hold particles of the lighter phase.
HWY_INLINE hn::Mask<FloatTag> is_light(FloatV phase) { return hn::Gt(phase, hn::Set(FloatTag(), 0.5F)); }
HWY_INLINE FloatV choose_phase(hn::Mask<FloatTag> light, float of_light, float of_heavy) {
  const FloatTag d;
  return hn::IfThenElse(light, hn::Set(d, of_light), hn::Set(d, of_heavy));
}

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

/// The correction ends where walls make up this share of the density.
constexpr float kWallShare = 0.1F;

/// The inverse of M blended into the unit matrix where M is nearly singular and at walls. Weight as in
/// compute_corrections.
HWY_INLINE void store_correction(const Symmetric& m, FloatV walls, Float4* first, Float4* second) {
  const FloatTag d;
  const FloatV one = hn::Set(d, 1.0F), zero = hn::Zero(d);
  const auto minor = [](FloatV a, FloatV b, FloatV c, FloatV e)
                         HWY_ATTR { return hn::Sub(hn::Mul(a, b), hn::Mul(c, e)); };
  const FloatV cxx = minor(m.yy, m.zz, m.yz, m.yz), cxy = minor(m.xz, m.yz, m.xy, m.zz),
               cxz = minor(m.xy, m.yz, m.xz, m.yy), cyy = minor(m.xx, m.zz, m.xz, m.xz),
               cyz = minor(m.xy, m.xz, m.xx, m.yz), czz = minor(m.xx, m.yy, m.xy, m.xy);
  const FloatV det = hn::MulAdd(m.xx, cxx, hn::MulAdd(m.xy, cxy, hn::Mul(m.xz, cxz)));
  const FloatV t = hn::Min(one, hn::Max(zero, hn::Mul(hn::Sub(det, hn::Set(d, 0.05F)), hn::Set(d, 1.0F / 0.15F))));
  const FloatV away = hn::Max(zero, hn::NegMulAdd(walls, hn::Set(d, 1.0F / kWallShare), one));
  const FloatV w = hn::Mul(away, hn::Mul(hn::Mul(t, t), hn::NegMulAdd(hn::Set(d, 2.0F), t, hn::Set(d, 3.0F))));
  const FloatV rest = hn::Sub(one, w);
  const FloatV factor = hn::Div(w, hn::Max(det, hn::Set(d, 0.04F)));
  store_records(
      {hn::MulAdd(cxx, factor, rest), hn::Mul(cxy, factor), hn::Mul(cxz, factor), hn::MulAdd(cyy, factor, rest)},
      first);
  store_records({hn::Mul(cyz, factor), hn::MulAdd(czz, factor, rest), w, zero}, second);
}

/// M -= scale x g^T, which is symmetric because g is along x.
HWY_INLINE void add_moments(const PairGeometry& pair, const Vec3& g, FloatV scale, Symmetric& m) {
  const FloatV x = hn::Mul(scale, pair.x), y = hn::Mul(scale, pair.y), z = hn::Mul(scale, pair.z);
  m.xx = hn::NegMulAdd(x, g.x, m.xx);
  m.xy = hn::NegMulAdd(x, g.y, m.xy);
  m.xz = hn::NegMulAdd(x, g.z, m.xz);
  m.yy = hn::NegMulAdd(y, g.y, m.yy);
  m.yz = hn::NegMulAdd(y, g.z, m.yz);
  m.zz = hn::NegMulAdd(z, g.z, m.zz);
}

template <bool kMoments, bool kPhases>
HWY_INLINE void density_groups_with(const PairData& data, std::size_t first_group, std::size_t last_group,
                                    const DensityOutput& out) {
  const FloatTag d;
  auto* cache = static_cast<CachedGradient*>(out.cache_words);
  const KernelScales scales = kernel_scales(data);
  const FloatV inverse_spacing = hn::Set(d, 1.0F / data.spacing);
  for (std::size_t group = first_group; group < last_group; ++group)
    for_each_part(group, [&](std::size_t lane, std::size_t i) HWY_ATTR {
      const Vec4 own = load_records(data.position + i);
      const FloatV zero = hn::Zero(d);
      FloatV weight = zero, lightest = own.w;
      GradientSums sums{zero3(), zero};
      Symmetric moments{zero, zero, zero, zero, zero, zero};
      const NeighborList::SlotRange fluid = data.fluid->groups[group];
      for (std::uint32_t s = fluid.begin; s < fluid.end; ++s) {
        const Vec4 other = gather_records(data.position, data.fluid->slots.data() + s * kLanes + lane);
        const PairGeometry pair = difference(own, other);
        const KernelPair kernel = cubic_spline(pair.r_squared, scales.support, scales.inverse_support);
        const Vec3 g = keep_gradient(scaled(pair, hn::Mul(kernel.gradient_factor, scales.gradient_spacing)),
                                     cache + s * kCacheStride + lane);
        weight = hn::Add(weight, kernel.value);
        add_to(sums.sum, g);
        sums.squares = dot(g, g, sums.squares);
        if constexpr (kMoments) add_moments(pair, g, inverse_spacing, moments);
        if constexpr (kPhases) lightest = hn::Max(lightest, other.w);
      }
      FloatV wall_density = zero, rate = zero;
      Vec3 wall_sum = zero3();
      const NeighborList::SlotRange walls = data.boundary->groups[group];
      for (std::uint32_t s = walls.begin; s < walls.end; ++s) {
        const std::int32_t* index = data.boundary->slots.data() + s * kLanes + lane;
        const Vec4 other = gather_records(data.walls->position.data(), index);
        const PairGeometry pair = difference(own, other);
        const KernelPair kernel = cubic_spline(pair.r_squared, scales.support, scales.inverse_support);
        wall_density = hn::MulAdd(hn::Mul(kernel.value, scales.wall_value), other.w, wall_density);
        const Vec3 g = scaled(pair, hn::Mul(hn::Mul(kernel.gradient_factor, scales.wall_gradient), other.w));
        add_to(wall_sum, g);
        if constexpr (kMoments) add_moments(pair, g, hn::Set(d, 1.0F), moments);
        if (data.walls_move) {
          const Vec4 v = gather_records(data.walls->velocity.data(), index);
          rate = dot({v.x, v.y, v.z}, g, rate);
        }
      }
      hn::StoreU(hn::MulAdd(weight, scales.value, wall_density), d, out.delta + i);
      store_gradient_sums(data, sums, wall_sum, rate, i, out.sum, out.wall, out.alpha);
      if constexpr (kMoments) store_correction(moments, wall_density, out.first + i, out.second + i);
      if constexpr (kPhases) {
        const FloatV mobility =
            choose_phase(is_light(lightest), data.phases->light_mobility, data.phases->heavy_mobility);
        hn::StoreU(mobility, d, out.mobility + i);
        divide_alpha(mobility, out.alpha + i);
      }
    });
}

void density_groups(const PairData& data, std::size_t first_group, std::size_t last_group, const DensityOutput& out) {
  if (data.phases)
    density_groups_with<false, true>(data, first_group, last_group, out);
  else
    density_groups_with<false, false>(data, first_group, last_group, out);
}

void correction_groups(const PairData& data, std::size_t first_group, std::size_t last_group,
                       const DensityOutput& out) {
  if (data.phases)
    density_groups_with<true, true>(data, first_group, last_group, out);
  else
    density_groups_with<true, false>(data, first_group, last_group, out);
}

HWY_INLINE Symmetric symmetric(const Vec4& first, const Vec4& second) {
  return {first.x, first.y, first.z, first.w, second.x, second.y};
}

/// sum_b v_b.(B_i a_ib): what moving walls add to the rate of density.
HWY_INLINE FloatV corrected_wall_rate(const PairData& data, const KernelScales& scales, const Symmetric& correction,
                                      std::size_t group, std::size_t lane, const Vec4& own) {
  const FloatTag d;
  FloatV rate = hn::Zero(d);
  const NeighborList::SlotRange walls = data.boundary->groups[group];
  for (std::uint32_t s = walls.begin; s < walls.end; ++s) {
    const std::int32_t* index = data.boundary->slots.data() + s * kLanes + lane;
    const Vec4 other = gather_records(data.walls->position.data(), index);
    const PairGeometry pair = difference(own, other);
    const KernelPair kernel = cubic_spline(pair.r_squared, scales.support, scales.inverse_support);
    const FloatV factor = hn::Mul(hn::Mul(kernel.gradient_factor, scales.wall_gradient), other.w);
    const Vec4 v = gather_records(data.walls->velocity.data(), index);
    rate = dot({v.x, v.y, v.z}, multiply(correction, scaled(pair, factor)), rate);
  }
  return rate;
}

void corrected_gradient_groups(const PairData& data, std::size_t first_group, std::size_t last_group,
                               const Float4* first, const Float4* second, const float* mobility, float* alpha,
                               Float4* sum, Float4* wall, void* own_words, void* other_words) {
  const FloatTag d;
  auto *own_cache = static_cast<CachedGradient*>(own_words), *other_cache = static_cast<CachedGradient*>(other_words);
  const KernelScales scales = kernel_scales(data);
  for (std::size_t group = first_group; group < last_group; ++group)
    for_each_part(group, [&](std::size_t lane, std::size_t i) HWY_ATTR {
      const Symmetric own = symmetric(load_records(first + i), load_records(second + i));
      GradientSums sums{zero3(), hn::Zero(d)};
      const NeighborList::SlotRange fluid = data.fluid->groups[group];
      for (std::uint32_t s = fluid.begin; s < fluid.end; ++s) {
        const std::int32_t* index = data.fluid->slots.data() + s * kLanes + lane;
        const std::size_t at = s * kCacheStride + lane;
        const Vec3 plain = kept_gradient(own_cache + at);
        const Vec3 g = keep_gradient(multiply(own, plain), own_cache + at);
        keep_gradient(multiply(symmetric(gather_records(first, index), gather_records(second, index)), plain),
                      other_cache + at);
        add_to(sums.sum, g);
        sums.squares = dot(g, g, sums.squares);
      }
      const Vec4 plain_wall = load_records(wall + i);
      FloatV rate = hn::Zero(d);
      if (data.walls_move) rate = corrected_wall_rate(data, scales, own, group, lane, load_records(data.position + i));
      store_gradient_sums(data, sums, multiply(own, {plain_wall.x, plain_wall.y, plain_wall.z}), rate, i, sum, wall,
                          alpha);
      if (mobility) divide_alpha(hn::LoadU(d, mobility + i), alpha + i);
    });
}

template <bool kPhases>
HWY_INLINE void pressure_groups_with(const PairData& data, std::size_t first_group, std::size_t last_group,
                                     const void* cache_words, const Float4* sum, const float* pressure,
                                     Float4* displacement) {
  const FloatTag d;
  const auto* cache = static_cast<const CachedGradient*>(cache_words);
  const FloatV minus_inverse_spacing = hn::Set(d, -1.0F / data.spacing);
  for (std::size_t group = first_group; group < last_group; ++group)
    for_each_part(group, [&](std::size_t lane, std::size_t i) HWY_ATTR {
      const FloatV own = hn::LoadU(d, pressure + i);
      Vec3 push = zero3();
      const NeighborList::SlotRange fluid = data.fluid->groups[group];
      for (std::uint32_t s = fluid.begin; s < fluid.end; ++s) {
        const IntV index = hn::LoadU(IntTag(), data.fluid->slots.data() + s * kLanes + lane);
        const FloatV other = hn::GatherIndex(d, pressure, index);
        const Vec3 g = kept_gradient(cache + s * kCacheStride + lane);
        push.x = hn::MulAdd(other, g.x, push.x);
        push.y = hn::MulAdd(other, g.y, push.y);
        push.z = hn::MulAdd(other, g.z, push.z);
      }
      const Vec4 w = load_records(sum + i);
      Vec3 u{hn::NegMulAdd(own, w.x, hn::Mul(push.x, minus_inverse_spacing)),
             hn::NegMulAdd(own, w.y, hn::Mul(push.y, minus_inverse_spacing)),
             hn::NegMulAdd(own, w.z, hn::Mul(push.z, minus_inverse_spacing))};
      if constexpr (kPhases) {
        const FloatV mobility = hn::LoadU(d, data.phases->mobility.data() + i);
        u = {hn::Mul(u.x, mobility), hn::Mul(u.y, mobility), hn::Mul(u.z, mobility)};
      }
      store_records({u.x, u.y, u.z, hn::Zero(d)}, displacement + i);
    });
}

void pressure_groups(const PairData& data, std::size_t first_group, std::size_t last_group, const void* cache_words,
                     const Float4* sum, const float* pressure, Float4* displacement) {
  if (data.phases)
    pressure_groups_with<true>(data, first_group, last_group, cache_words, sum, pressure, displacement);
  else
    pressure_groups_with<false>(data, first_group, last_group, cache_words, sum, pressure, displacement);
}

void rate_groups(const PairData& data, std::size_t first_group, std::size_t last_group, const void* cache_words,
                 const Float4* wall, const Float4* velocity, bool moving_walls, float* rate) {
  const FloatTag d;
  const auto* cache = static_cast<const CachedGradient*>(cache_words);
  const FloatV inverse_spacing = hn::Set(d, 1.0F / data.spacing);
  for (std::size_t group = first_group; group < last_group; ++group)
    for_each_part(group, [&](std::size_t lane, std::size_t i) HWY_ATTR {
      const Vec4 own = load_records(velocity + i);
      FloatV sum = hn::Zero(d);
      const NeighborList::SlotRange fluid = data.fluid->groups[group];
      for (std::uint32_t s = fluid.begin; s < fluid.end; ++s) {
        const PairGeometry change =
            difference(own, gather_records(velocity, data.fluid->slots.data() + s * kLanes + lane));
        sum = dot({change.x, change.y, change.z}, kept_gradient(cache + s * kCacheStride + lane), sum);
      }
      const Vec4 w = load_records(wall + i);
      FloatV walls = hn::MulAdd(own.x, w.x, hn::MulAdd(own.y, w.y, hn::Mul(own.z, w.z)));
      if (moving_walls) walls = hn::Sub(walls, w.w);
      hn::StoreU(hn::MulAdd(sum, inverse_spacing, walls), d, rate + i);
    });
}

void velocity_gradient_groups(const PairData& data, std::size_t first_group, std::size_t last_group,
                              const void* cache_words, const Float4* velocity, Float4* row_x, Float4* row_y,
                              Float4* row_z) {
  const FloatTag d;
  const auto* cache = static_cast<const CachedGradient*>(cache_words);
  const FloatV scale = hn::Set(d, -1.0F / data.spacing);  // own - other is gathered: hence the sign
  for (std::size_t group = first_group; group < last_group; ++group)
    for_each_part(group, [&](std::size_t lane, std::size_t i) HWY_ATTR {
      const Vec4 own = load_records(velocity + i);
      Vec3 gx = zero3(), gy = zero3(), gz = zero3();
      const NeighborList::SlotRange fluid = data.fluid->groups[group];
      for (std::uint32_t s = fluid.begin; s < fluid.end; ++s) {
        const Vec4 other = gather_records(velocity, data.fluid->slots.data() + s * kLanes + lane);
        const Vec3 g = kept_gradient(cache + s * kCacheStride + lane);
        const auto add = [&](FloatV change, Vec3& row) HWY_ATTR {
          row.x = hn::MulAdd(change, g.x, row.x);
          row.y = hn::MulAdd(change, g.y, row.y);
          row.z = hn::MulAdd(change, g.z, row.z);
        };
        add(hn::Sub(own.x, other.x), gx);
        add(hn::Sub(own.y, other.y), gy);
        add(hn::Sub(own.z, other.z), gz);
      }
      const auto store = [&](const Vec3& row, FloatV component, Float4* out) HWY_ATTR {
        store_records({hn::Mul(row.x, scale), hn::Mul(row.y, scale), hn::Mul(row.z, scale), component}, out + i);
      };
      store(gx, own.x, row_x);
      store(gy, own.y, row_y);
      store(gz, own.z, row_z);
    });
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

template <bool kPhases>
HWY_INLINE void filter_groups_with(const PairData& data, std::size_t first_group, std::size_t last_group,
                                   const Float4* row_x, const Float4* row_y, const Float4* row_z, Float4* change,
                                   float* delta) {
  const FloatTag d;
  const KernelScales scales = kernel_scales(data);
  const FloatV half = hn::Set(d, 0.5F);
  for (std::size_t group = first_group; group < last_group; ++group)
    for_each_part(group, [&](std::size_t lane, std::size_t i) HWY_ATTR {
      const Vec4 own = load_records(data.position + i);
      const Vec4 own_x = load_records(row_x + i), own_y = load_records(row_y + i), own_z = load_records(row_z + i);
      Vec3 sum = zero3();
      FloatV density = hn::Zero(d), across = hn::Zero(d);
      if constexpr (kPhases)  // rho0_lighter / rho0_i
        across = choose_phase(is_light(own.w), 1.0F, data.phases->heavy_mobility / data.phases->light_mobility);
      const NeighborList::SlotRange fluid = data.fluid->groups[group];
      for (std::uint32_t s = fluid.begin; s < fluid.end; ++s) {
        const std::int32_t* index = data.fluid->slots.data() + s * kLanes + lane;
        const Vec4 place = gather_records(data.position, index);
        const PairGeometry pair = difference(own, place);
        FloatV weight = cubic_spline(pair.r_squared, scales.support, scales.inverse_support).value;
        density = hn::Add(density, weight);
        if constexpr (kPhases) weight = hn::IfThenElse(hn::Eq(own.w, place.w), weight, hn::Mul(weight, across));
        const auto add = [&](const Vec4& mine, const Vec4& other, FloatV& to) HWY_ATTR {
          const Vec3 both{hn::Add(mine.x, other.x), hn::Add(mine.y, other.y), hn::Add(mine.z, other.z)};
          const FloatV linear = dot(both, {pair.x, pair.y, pair.z}, hn::Zero(d));
          to = hn::MulAdd(weight, hn::MulAdd(half, linear, hn::Sub(other.w, mine.w)), to);
        };
        add(own_x, gather_records(row_x, index), sum.x);
        add(own_y, gather_records(row_y, index), sum.y);
        add(own_z, gather_records(row_z, index), sum.z);
      }
      store_records(
          {hn::Mul(sum.x, scales.value), hn::Mul(sum.y, scales.value), hn::Mul(sum.z, scales.value), hn::Zero(d)},
          change + i);
      hn::StoreU(hn::MulAdd(density, scales.value, wall_density(data, scales, own, group, lane)), d, delta + i);
    });
}

void filter_groups(const PairData& data, std::size_t first_group, std::size_t last_group, const Float4* row_x,
                   const Float4* row_y, const Float4* row_z, Float4* change, float* delta) {
  if (data.phases)
    filter_groups_with<true>(data, first_group, last_group, row_x, row_y, row_z, change, delta);
  else
    filter_groups_with<false>(data, first_group, last_group, row_x, row_y, row_z, change, delta);
}

void acceleration_groups(const PairData& data, std::size_t first_group, std::size_t last_group, const Float4* velocity,
                         float viscosity, float gravity, Float4* acceleration, float* delta) {
  const FloatTag d;
  const KernelScales scales = kernel_scales(data);
  const float squared = data.support_radius * data.support_radius;
  const FloatV scale = hn::Mul(hn::Set(d, viscosity * 10.0F / data.spacing), scales.gradient_spacing);
  const FloatV softening = hn::Set(d, 1e-6F * squared);  // only against 0/0
  for (std::size_t group = first_group; group < last_group; ++group)
    for_each_part(group, [&](std::size_t lane, std::size_t i) HWY_ATTR {
      const Vec4 own = load_records(data.position + i), own_velocity = load_records(velocity + i);
      FloatV weight = hn::Zero(d);
      Vec3 sum = zero3();
      const NeighborList::SlotRange fluid = data.fluid->groups[group];
      for (std::uint32_t s = fluid.begin; s < fluid.end; ++s) {
        const std::int32_t* index = data.fluid->slots.data() + s * kLanes + lane;
        const PairGeometry pair = difference(own, gather_records(data.position, index));
        const PairGeometry change = difference(own_velocity, gather_records(velocity, index));
        const FloatV approach = dot({change.x, change.y, change.z}, {pair.x, pair.y, pair.z}, hn::Zero(d));
        const KernelPair kernel = cubic_spline(pair.r_squared, scales.support, scales.inverse_support);
        weight = hn::Add(weight, kernel.value);
        const FloatV factor = hn::Div(hn::Mul(kernel.gradient_factor, approach), hn::Add(pair.r_squared, softening));
        add_to(sum, scaled(pair, factor));
      }
      store_records(
          {hn::Mul(sum.x, scale), hn::Mul(sum.y, scale), hn::MulAdd(sum.z, scale, hn::Set(d, -gravity)), hn::Zero(d)},
          acceleration + i);
      if (delta)
        hn::StoreU(hn::MulAdd(weight, scales.value, wall_density(data, scales, own, group, lane)), d, delta + i);
    });
}

/// nu_ij for a vector of particles: that of its own phase, and that between the phases.
struct PairViscosity {
  FloatV own, mixed;
};

void phase_acceleration_groups(const PairData& data, std::size_t first_group, std::size_t last_group,
                               const Float4* velocity, float gravity, Float4* acceleration, float* delta) {
  const FloatTag d;
  const PhasePair& phases = *data.phases;
  const KernelScales scales = kernel_scales(data);
  const FloatV scale = hn::Mul(hn::Set(d, 10.0F / data.spacing), scales.gradient_spacing);
  const FloatV softening = hn::Set(d, 1e-6F * data.support_radius * data.support_radius);  // only against 0/0
  const FloatV zero = hn::Zero(d), down = hn::Set(d, -gravity);
  for (std::size_t group = first_group; group < last_group; ++group)
    for_each_part(group, [&](std::size_t lane, std::size_t i) HWY_ATTR {
      const Vec4 own = load_records(data.position + i);
      const PairViscosity nu{choose_phase(is_light(own.w), phases.light_viscosity, phases.heavy_viscosity),
                             hn::Set(d, phases.mixed_viscosity)};
      if (!delta && hn::AllTrue(d, hn::Eq(nu.own, zero))) {  // then the mixed one is zero, too
        store_records({zero, zero, down, zero}, acceleration + i);
        return;
      }
      const Vec4 own_velocity = load_records(velocity + i);
      FloatV weight = zero;
      Vec3 sum = zero3();
      const NeighborList::SlotRange fluid = data.fluid->groups[group];
      for (std::uint32_t s = fluid.begin; s < fluid.end; ++s) {
        const std::int32_t* index = data.fluid->slots.data() + s * kLanes + lane;
        const Vec4 place = gather_records(data.position, index);
        const PairGeometry pair = difference(own, place);
        const PairGeometry change = difference(own_velocity, gather_records(velocity, index));
        const FloatV approach = dot({change.x, change.y, change.z}, {pair.x, pair.y, pair.z}, zero);
        const KernelPair kernel = cubic_spline(pair.r_squared, scales.support, scales.inverse_support);
        weight = hn::Add(weight, kernel.value);
        const FloatV viscosity = hn::IfThenElse(hn::Eq(own.w, place.w), nu.own, nu.mixed);
        const FloatV factor =
            hn::Div(hn::Mul(hn::Mul(kernel.gradient_factor, approach), viscosity), hn::Add(pair.r_squared, softening));
        add_to(sum, scaled(pair, factor));
      }
      const FloatV push = hn::Mul(scale, hn::LoadU(d, phases.mobility.data() + i));
      store_records({hn::Mul(sum.x, push), hn::Mul(sum.y, push), hn::MulAdd(sum.z, push, down), zero},
                    acceleration + i);
      if (delta)
        hn::StoreU(hn::MulAdd(weight, scales.value, wall_density(data, scales, own, group, lane)), d, delta + i);
    });
}

}  // namespace HWY_NAMESPACE
}  // namespace pelagos
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pelagos {

HWY_EXPORT(cached_gradient_size);
HWY_EXPORT(density_groups);
HWY_EXPORT(correction_groups);
HWY_EXPORT(corrected_gradient_groups);
HWY_EXPORT(pressure_groups);
HWY_EXPORT(rate_groups);
HWY_EXPORT(velocity_gradient_groups);
HWY_EXPORT(filter_groups);
HWY_EXPORT(acceleration_groups);
HWY_EXPORT(phase_acceleration_groups);

namespace {
/// 256 particles a block: small enough to balance two cores, large enough to amortise the claim.
constexpr std::size_t kGroupsPerBlock = 16;

template <class F>
void for_each_group(TaskPool& pool, const PairData& data, F&& f) {
  pool.for_each_range(data.fluid->groups.size(), kGroupsPerBlock, f);
}

/// B' = S B S for images, S the reflection.
void extend_corrections(TaskPool& pool, const Ghosts& ghosts, Corrections& corrections) {
  pool.for_each_range(ghosts.count, 2048, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const Float4 &s = ghosts.sign[k], &a = corrections.first[ghosts.source[k]],
                   &b = corrections.second[ghosts.source[k]];
      corrections.first[ghosts.begin + k] = {a.x, s.x * s.y * a.y, s.x * s.z * a.z, a.w};
      corrections.second[ghosts.begin + k] = {s.y * s.z * b.x, b.y, b.z, 0.0F};
    }
  });
}

/// G' = S G S and v' = S v for images.
void extend_gradients(TaskPool& pool, const Ghosts& ghosts, VelocityGradients& gradients) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    pool.for_each_range(ghosts.count, 2048, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const Float4 &s = ghosts.sign[k], &g = gradients.row[axis][ghosts.source[k]];
        const float own = axis == 0 ? s.x : axis == 1 ? s.y : s.z;
        gradients.row[axis][ghosts.begin + k] = {own * s.x * g.x, own * s.y * g.y, own * s.z * g.z, own * g.w};
      }
    });
}

void reserve_cache(const PairData& data, GradientCache& cache) {
  const std::size_t bytes = data.fluid->slots.size() * 3 * HWY_DYNAMIC_DISPATCH(cached_gradient_size)();
  if (cache.words.size() * sizeof(std::uint32_t) < bytes) cache.words.resize(bytes / sizeof(std::uint32_t));
}

void reserve_gradients(const PairData& data, bool corrected, Gradients& gradients) {
  const std::size_t padded = padded_count(data.count);
  gradients.corrected = corrected;
  gradients.alpha.resize(padded);
  gradients.sum.resize(padded);
  gradients.wall.resize(padded);
  if (data.phases) gradients.mobility.resize(padded);
  reserve_cache(data, gradients.own);
  if (corrected) reserve_cache(data, gradients.other);
}

DensityOutput density_output(std::span<float> delta, Gradients& gradients) {
  DensityOutput out;
  out.delta = delta.data();
  out.alpha = gradients.alpha.data();
  out.sum = gradients.sum.data();
  out.wall = gradients.wall.data();
  out.cache_words = gradients.own.words.data();
  out.mobility = gradients.mobility.data();
  return out;
}
}  // namespace

void compute_density(TaskPool& pool, const PairData& data, std::span<float> delta, Gradients& gradients) {
  reserve_gradients(data, false, gradients);
  const DensityOutput out = density_output(delta, gradients);
  for_each_group(pool, data, [&](std::size_t first, std::size_t last) {
    HWY_DYNAMIC_DISPATCH(density_groups)(data, first, last, out);
  });
}

void compute_corrections(TaskPool& pool, const PairData& data, std::span<float> delta, Gradients& gradients,
                         Corrections& corrections) {
  reserve_gradients(data, false, gradients);
  const std::size_t size = data.ghosts ? extended_count(data.count, *data.ghosts) : padded_count(data.count);
  corrections.first.resize(size);
  corrections.second.resize(size);
  DensityOutput out = density_output(delta, gradients);
  out.first = corrections.first.data();
  out.second = corrections.second.data();
  for_each_group(pool, data, [&](std::size_t first, std::size_t last) {
    HWY_DYNAMIC_DISPATCH(correction_groups)(data, first, last, out);
  });
  if (data.ghosts) extend_corrections(pool, *data.ghosts, corrections);
}

void compute_corrected_gradients(TaskPool& pool, const PairData& data, const Corrections& corrections,
                                 Gradients& gradients) {
  reserve_gradients(data, true, gradients);
  for_each_group(pool, data, [&](std::size_t first, std::size_t last) {
    HWY_DYNAMIC_DISPATCH(corrected_gradient_groups)
    (data, first, last, corrections.first.data(), corrections.second.data(),
     data.phases ? gradients.mobility.data() : nullptr, gradients.alpha.data(), gradients.sum.data(),
     gradients.wall.data(), gradients.own.words.data(), gradients.other.words.data());
  });
}

void apply_pressure(TaskPool& pool, const PairData& data, const Gradients& gradients, std::span<const float> pressure,
                    std::span<Float4> displacement) {
  const GradientCache& cache = gradients.corrected ? gradients.other : gradients.own;
  for_each_group(pool, data, [&](std::size_t first, std::size_t last) {
    HWY_DYNAMIC_DISPATCH(pressure_groups)
    (data, first, last, cache.words.data(), gradients.sum.data(), pressure.data(), displacement.data());
  });
}

void compute_rate(TaskPool& pool, const PairData& data, const Gradients& gradients, std::span<const Float4> velocity,
                  bool moving_walls, std::span<float> rate) {
  for_each_group(pool, data, [&](std::size_t first, std::size_t last) {
    HWY_DYNAMIC_DISPATCH(rate_groups)
    (data, first, last, gradients.own.words.data(), gradients.wall.data(), velocity.data(), moving_walls, rate.data());
  });
}

void compute_velocity_gradients(TaskPool& pool, const PairData& data, const Gradients& gradients,
                                std::span<const Float4> velocity, VelocityGradients& out) {
  const std::size_t size = data.ghosts ? extended_count(data.count, *data.ghosts) : padded_count(data.count);
  for (std::vector<Float4>& row : out.row) row.resize(size);
  for_each_group(pool, data, [&](std::size_t first, std::size_t last) {
    HWY_DYNAMIC_DISPATCH(velocity_gradient_groups)
    (data, first, last, gradients.own.words.data(), velocity.data(), out.row[0].data(), out.row[1].data(),
     out.row[2].data());
  });
  if (data.ghosts) extend_gradients(pool, *data.ghosts, out);
}

void compute_filter(TaskPool& pool, const PairData& data, const VelocityGradients& gradients, std::span<Float4> change,
                    std::span<float> delta) {
  for_each_group(pool, data, [&](std::size_t first, std::size_t last) {
    HWY_DYNAMIC_DISPATCH(filter_groups)
    (data, first, last, gradients.row[0].data(), gradients.row[1].data(), gradients.row[2].data(), change.data(),
     delta.data());
  });
}

void compute_acceleration(TaskPool& pool, const PairData& data, std::span<const Float4> velocity, float viscosity,
                          float gravity, std::span<Float4> acceleration, std::span<float> delta) {
  for_each_group(pool, data, [&](std::size_t first, std::size_t last) {
    HWY_DYNAMIC_DISPATCH(acceleration_groups)
    (data, first, last, velocity.data(), viscosity, gravity, acceleration.data(), delta.data());
  });
}

void compute_phase_acceleration(TaskPool& pool, const PairData& data, std::span<const Float4> velocity, float gravity,
                                std::span<Float4> acceleration, std::span<float> delta) {
  for_each_group(pool, data, [&](std::size_t first, std::size_t last) {
    HWY_DYNAMIC_DISPATCH(phase_acceleration_groups)
    (data, first, last, velocity.data(), gravity, acceleration.data(), delta.data());
  });
}

}  // namespace pelagos
#endif  // HWY_ONCE
