#include "physics/pair_passes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "density_passes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "density_output.hpp"
#include "gradient_storage.hpp"
#include "gradient_sums-inl.hpp"
#include "group_blocks.hpp"

HWY_BEFORE_NAMESPACE();
namespace pelagos {
namespace HWY_NAMESPACE {

std::size_t cached_gradient_size() { return sizeof(CachedGradient); }

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

}  // namespace HWY_NAMESPACE
}  // namespace pelagos
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pelagos {

HWY_EXPORT(cached_gradient_size);
HWY_EXPORT(density_groups);
HWY_EXPORT(correction_groups);

namespace {

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

void reserve_cache(const PairData& data, GradientCache& cache) {
  const std::size_t bytes = data.fluid->slots.size() * 3 * HWY_DYNAMIC_DISPATCH(cached_gradient_size)();
  if (cache.words.size() * sizeof(std::uint32_t) < bytes) cache.words.resize(bytes / sizeof(std::uint32_t));
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
  const std::size_t size = gathered_count(data);
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

}  // namespace pelagos
#endif  // HWY_ONCE
