#include "physics/pair_passes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "density_passes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "density_output.hpp"
#include "gradient_storage.hpp"
#include "group_blocks.hpp"
#include "solid_pairs-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace pelagos {
namespace HWY_NAMESPACE {

std::size_t cached_gradient_size() { return sizeof(CachedGradient); }

/// The correction ends where walls make up this share of the density.
constexpr float kWallShare = 0.1F;

/// The inverse of M blended into the unit matrix where M is nearly singular and at walls. Weight as in
/// compute_corrections.
/// @param rough  0 to 1: how far the correction has ended at solids' skew corners
HWY_INLINE void store_correction(const Symmetric& m, FloatV walls, FloatV rough, Float4* first, Float4* second) {
  const FloatTag d;
  const FloatV one = hn::Set(d, 1.0F), zero = hn::Zero(d);
  const auto minor = [](FloatV a, FloatV b, FloatV c, FloatV e)
                         HWY_ATTR { return hn::Sub(hn::Mul(a, b), hn::Mul(c, e)); };
  const FloatV cxx = minor(m.yy, m.zz, m.yz, m.yz), cxy = minor(m.xz, m.yz, m.xy, m.zz),
               cxz = minor(m.xy, m.yz, m.xz, m.yy), cyy = minor(m.xx, m.zz, m.xz, m.xz),
               cyz = minor(m.xy, m.xz, m.xx, m.yz), czz = minor(m.xx, m.yy, m.xy, m.xy);
  const FloatV det = hn::MulAdd(m.xx, cxx, hn::MulAdd(m.xy, cxy, hn::Mul(m.xz, cxz)));
  const FloatV t = hn::Min(one, hn::Max(zero, hn::Mul(hn::Sub(det, hn::Set(d, 0.05F)), hn::Set(d, 1.0F / 0.15F))));
  const FloatV away =
      hn::Min(hn::Max(zero, hn::NegMulAdd(walls, hn::Set(d, 1.0F / kWallShare), one)), hn::Sub(one, rough));
  const FloatV w = hn::Mul(away, hn::Mul(hn::Mul(t, t), hn::NegMulAdd(hn::Set(d, 2.0F), t, hn::Set(d, 3.0F))));
  const FloatV rest = hn::Sub(one, w);
  const FloatV factor = hn::Div(w, hn::Max(det, hn::Set(d, 0.04F)));
  store_records(
      {hn::MulAdd(cxx, factor, rest), hn::Mul(cxy, factor), hn::Mul(cxz, factor), hn::MulAdd(cyy, factor, rest)},
      first);
  store_records({hn::Mul(cyz, factor), hn::MulAdd(czz, factor, rest), w, zero}, second);
}

/// M -= scale x g^T, which is symmetric because g is along x.
HWY_INLINE void add_moments(const Vec3& along, const Vec3& g, FloatV scale, Symmetric& m) {
  const FloatV x = hn::Mul(scale, along.x), y = hn::Mul(scale, along.y), z = hn::Mul(scale, along.z);
  m.xx = hn::NegMulAdd(x, g.x, m.xx);
  m.xy = hn::NegMulAdd(x, g.y, m.xy);
  m.xz = hn::NegMulAdd(x, g.z, m.xz);
  m.yy = hn::NegMulAdd(y, g.y, m.yy);
  m.yz = hn::NegMulAdd(y, g.z, m.yz);
  m.zz = hn::NegMulAdd(z, g.z, m.zz);
}

/// Sums over the neighbours of a vector of particles.
struct DensitySums {
  FloatV weight, lightest;  ///< of the kernel, to a factor; the lighter phase's mark
  GradientSums gradients;
  Symmetric moments;
};

/// One neighbour each of a vector of particles, with its images in the surfaces of the slots kUsed. Gradients are kept.
template <bool kMoments, unsigned kUsed>
HWY_INLINE void add_images(const PairData& data, const KernelScales& scales, const PairGeometry& pair,
                           const Vec3& plain, const Mirrors& own, const Mirrors& other, CachedGradient* kept,
                           CachedGradient* kept_other, DensitySums& sums, SolidWalls& walls) {
  const FloatV inverse_spacing = hn::Set(FloatTag(), 1.0F / data.spacing);
  Vec3 g = plain, back = plain;
  for_each_image<kUsed>([&]<unsigned kIn>(Slots<kIn>) HWY_ATTR {
    const ImagePair image = image_pair<kIn>(own, other, pair);
    const KernelPair kernel = cubic_spline(image.squared, scales.support, scales.inverse_support);
    const FloatV factor = hn::Mul(kernel.gradient_factor, scales.gradient_spacing), share = share_of<kIn>(own);
    const FloatV own_factor = hn::Mul(factor, share);
    sums.weight = hn::MulAdd(kernel.value, share, sums.weight);
    const Vec3 along_a = scaled(image.a, own_factor), along_b = scaled(image.b, own_factor);
    if constexpr (kMoments) add_moments(image.a, along_a, inverse_spacing, sums.moments);
    add_to(g, along_b);
    add_wall<kIn>(subtract(along_a, along_b), walls);
    add_to(back, scaled(image.a, hn::Mul(factor, share_of<kIn>(other))));
  });
  const Vec3 rounded = keep_gradient(g, kept);
  keep_gradient(back, kept_other);
  add_to(sums.gradients.sum, rounded);
  sums.gradients.squares = dot(rounded, rounded, sums.gradients.squares);
}

template <bool kMoments, bool kPhases, unsigned kUsed>
HWY_INLINE void add_fluid(const PairData& data, const KernelScales& scales, std::size_t group, std::size_t lane,
                          std::size_t i, const Vec4& own, const DensityOutput& out, DensitySums& sums,
                          SolidWalls& walls) {
  auto *cache = static_cast<CachedGradient*>(out.cache_words), *others = static_cast<CachedGradient*>(out.other_words);
  const FloatV inverse_spacing = hn::Set(FloatTag(), 1.0F / data.spacing);
  Mirrors mirrors = no_mirrors();
  if constexpr (kUsed != 0U) mirrors = own_mirrors<kUsed>(data, i, {own.x, own.y, own.z});
  const NeighborList::SlotRange fluid = data.fluid->groups[group];
  for (std::uint32_t s = fluid.begin; s < fluid.end; ++s) {
    const std::int32_t* index = data.fluid->slots.data() + s * kLanes + lane;
    const Vec4 other = gather_records(data.position, index);
    const PairGeometry pair = difference(own, other);
    const KernelPair kernel = cubic_spline(pair.r_squared, scales.support, scales.inverse_support);
    const Vec3 plain = scaled(pair, hn::Mul(kernel.gradient_factor, scales.gradient_spacing));
    const std::size_t at = s * kCacheStride + lane;
    sums.weight = hn::Add(sums.weight, kernel.value);
    if constexpr (kPhases) sums.lightest = hn::Max(sums.lightest, other.w);
    if constexpr (kUsed == 0U) {
      const Vec3 g = keep_gradient(plain, cache + at);
      add_to(sums.gradients.sum, g);
      sums.gradients.squares = dot(g, g, sums.gradients.squares);
      if constexpr (kMoments) add_moments({pair.x, pair.y, pair.z}, g, inverse_spacing, sums.moments);
    } else {
      if constexpr (kMoments) add_moments({pair.x, pair.y, pair.z}, plain, inverse_spacing, sums.moments);
      const Mirrors its = other_mirrors<kUsed>(data, index, {other.x, other.y, other.z});
      add_images<kMoments, kUsed>(data, scales, pair, plain, mirrors, its, cache + at, others + at, sums, walls);
    }
  }
}

/// What boundary samples add to density, gradient, rate and moments.
struct SampleSums {
  FloatV density, rate;
  Vec3 gradient;
};
template <bool kMoments>
HWY_INLINE SampleSums sum_samples(const PairData& data, const KernelScales& scales, std::size_t group, std::size_t lane,
                                  const Vec4& own, Symmetric& moments) {
  const FloatTag d;
  SampleSums sums{hn::Zero(d), hn::Zero(d), zero3()};
  const NeighborList::SlotRange walls = data.boundary->groups[group];
  for (std::uint32_t s = walls.begin; s < walls.end; ++s) {
    const std::int32_t* index = data.boundary->slots.data() + s * kLanes + lane;
    const Vec4 other = gather_records(data.walls->position.data(), index);
    const PairGeometry pair = difference(own, other);
    const KernelPair kernel = cubic_spline(pair.r_squared, scales.support, scales.inverse_support);
    sums.density = hn::MulAdd(hn::Mul(kernel.value, scales.wall_value), other.w, sums.density);
    const Vec3 g = scaled(pair, hn::Mul(hn::Mul(kernel.gradient_factor, scales.wall_gradient), other.w));
    add_to(sums.gradient, g);
    if constexpr (kMoments) add_moments({pair.x, pair.y, pair.z}, g, hn::Set(d, 1.0F), moments);
    if (data.walls_move) {
      const Vec4 v = gather_records(data.walls->velocity.data(), index);
      sums.rate = dot({v.x, v.y, v.z}, g, sums.rate);
    }
  }
  return sums;
}

template <bool kMoments, bool kPhases, unsigned kUsed>
HWY_INLINE void density_part(const PairData& data, const KernelScales& scales, std::size_t group, std::size_t lane,
                             std::size_t i, const DensityOutput& out) {
  const FloatTag d;
  const Vec4 own = load_records(data.position + i);
  const FloatV zero = hn::Zero(d);
  DensitySums sums{zero, own.w, {zero3(), zero}, {zero, zero, zero, zero, zero, zero}};
  SolidWalls solids = no_solid_walls();
  add_fluid<kMoments, kPhases, kUsed>(data, scales, group, lane, i, own, out, sums, solids);
  SampleSums samples = sum_samples<kMoments>(data, scales, group, lane, own, sums.moments);
  if constexpr (kUsed != 0U) add_to(samples.gradient, store_solid_walls(data, solids, i, out.solid_wall));
  hn::StoreU(hn::MulAdd(sums.weight, scales.value, samples.density), d, out.delta + i);
  store_gradient_sums(data, sums.gradients, samples.gradient, samples.rate, i, out.sum, out.wall, out.alpha);
  if constexpr (kMoments) {
    FloatV rough = zero;
    if constexpr (kUsed == 3U) rough = hn::Sub(hn::Set(d, 1.0F), load_records(data.solids->blend.data() + i).w);
    store_correction(sums.moments, samples.density, rough, out.first + i, out.second + i);
  }
  if constexpr (kPhases) {
    const FloatV mobility =
        choose_phase(is_light(sums.lightest), data.phases->light_mobility, data.phases->heavy_mobility);
    hn::StoreU(mobility, d, out.mobility + i);
    divide_alpha(mobility, out.alpha + i);
  }
}

template <bool kMoments, bool kPhases>
HWY_INLINE void density_groups_with(const PairData& data, std::size_t first_group, std::size_t last_group,
                                    const DensityOutput& out) {
  const KernelScales scales = kernel_scales(data);
  for (std::size_t group = first_group; group < last_group; ++group)
    with_slots(data, group, [&]<unsigned kUsed>(Slots<kUsed>) HWY_ATTR {
      for_each_part(group, [&](std::size_t lane, std::size_t i)
                               HWY_ATTR { density_part<kMoments, kPhases, kUsed>(data, scales, group, lane, i, out); });
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
  out.other_words = gradients.other.words.data();
  for (std::size_t slot = 0; slot < SolidPlanes::kSlots; ++slot)
    out.solid_wall[slot] = gradients.solid_wall[slot].data();
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
  if (corrected || data.solids) reserve_cache(data, gradients.other);
  if (data.solids)
    for (std::vector<Float4>& wall : gradients.solid_wall) wall.resize(padded);
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
