#include "physics/pair_passes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "corrected_gradients.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "gradient_storage.hpp"
#include "group_blocks.hpp"
#include "solid_pairs-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace pelagos {
namespace HWY_NAMESPACE {

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

/// The corrections, and the gradients that are kept.
struct CorrectionArrays {
  const Float4 *first, *second;
  CachedGradient *own, *other;
};

/// Turns the kept gradients into corrected ones; returns their sums.
HWY_INLINE GradientSums correct_kept(const PairData& data, const CorrectionArrays& a, const Symmetric& own,
                                     std::size_t group, std::size_t lane) {
  GradientSums sums{zero3(), hn::Zero(FloatTag())};
  const NeighborList::SlotRange fluid = data.fluid->groups[group];
  for (std::uint32_t s = fluid.begin; s < fluid.end; ++s) {
    const std::int32_t* index = data.fluid->slots.data() + s * kLanes + lane;
    const std::size_t at = s * kCacheStride + lane;
    const Vec3 plain = kept_gradient(a.own + at);
    const Vec3 g = keep_gradient(multiply(own, plain), a.own + at);
    keep_gradient(multiply(symmetric(gather_records(a.first, index), gather_records(a.second, index)), plain),
                  a.other + at);
    add_to(sums.sum, g);
    sums.squares = dot(g, g, sums.squares);
  }
  return sums;
}

/// The same near solids, from the positions where the planes were found: the image in R of a particle with the
/// correction B has R B R'.
template <unsigned kUsed>
HWY_INLINE GradientSums correct_with_images(const PairData& data, const CorrectionArrays& a, const Symmetric& own,
                                            std::size_t group, std::size_t lane, std::size_t i, SolidWalls& walls) {
  GradientSums sums{zero3(), hn::Zero(FloatTag())};
  const KernelScales scales = kernel_scales(data);
  const Float4* positions = data.solids->position.data();
  const Vec4 place = load_records(positions + i);
  const Mirrors mirrors = own_mirrors<kUsed>(data, i, {place.x, place.y, place.z});
  const NeighborList::SlotRange fluid = data.fluid->groups[group];
  for (std::uint32_t s = fluid.begin; s < fluid.end; ++s) {
    const std::int32_t* index = data.fluid->slots.data() + s * kLanes + lane;
    const Vec4 there = gather_records(positions, index);
    const PairGeometry pair = difference(place, there);
    const KernelPair kernel = cubic_spline(pair.r_squared, scales.support, scales.inverse_support);
    const Vec3 plain = scaled(pair, hn::Mul(kernel.gradient_factor, scales.gradient_spacing));
    const Symmetric its_own = symmetric(gather_records(a.first, index), gather_records(a.second, index));
    const Mirrors its = other_mirrors<kUsed>(data, index, {there.x, there.y, there.z});
    Vec3 g = multiply(own, plain), back = multiply(its_own, plain);
    for_each_image<kUsed>([&]<unsigned kIn>(Slots<kIn>) HWY_ATTR {
      const ImagePair image = image_pair<kIn>(mirrors, its, pair);
      const KernelPair of_image = cubic_spline(image.squared, scales.support, scales.inverse_support);
      const FloatV factor = hn::Mul(of_image.gradient_factor, scales.gradient_spacing);
      const FloatV own_factor = hn::Mul(factor, share_of<kIn>(mirrors));
      const Vec3 along_a = multiply(own, scaled(image.a, own_factor));
      const Vec3 along_b = reflect<kIn>(its, multiply(own, reflect_back<kIn>(its, scaled(image.b, own_factor))));
      add_to(g, along_b);
      add_wall<kIn>(subtract(along_a, along_b), walls);
      const Vec3 its_a = scaled(image.a, hn::Mul(factor, share_of<kIn>(its)));
      add_to(back, reflect<kIn>(mirrors, multiply(its_own, reflect_back<kIn>(mirrors, its_a))));
    });
    const std::size_t at = s * kCacheStride + lane;
    const Vec3 rounded = keep_gradient(g, a.own + at);
    keep_gradient(back, a.other + at);
    add_to(sums.sum, rounded);
    sums.squares = dot(rounded, rounded, sums.squares);
  }
  return sums;
}

void corrected_gradient_groups(const PairData& data, std::size_t first_group, std::size_t last_group,
                               const Float4* first, const Float4* second, const float* mobility, float* alpha,
                               Float4* sum, Float4* wall, Float4* const* solid_wall, void* own_words,
                               void* other_words) {
  const FloatTag d;
  const CorrectionArrays arrays{first, second, static_cast<CachedGradient*>(own_words),
                                static_cast<CachedGradient*>(other_words)};
  const KernelScales scales = kernel_scales(data);
  for (std::size_t group = first_group; group < last_group; ++group)
    with_slots(data, group, [&]<unsigned kUsed>(Slots<kUsed>) HWY_ATTR {
      for_each_part(group, [&](std::size_t lane, std::size_t i) HWY_ATTR {
        const Symmetric own = symmetric(load_records(first + i), load_records(second + i));
        const Vec4 plain_wall = load_records(wall + i);
        Vec3 samples{plain_wall.x, plain_wall.y, plain_wall.z}, solids = zero3();
        GradientSums sums{zero3(), hn::Zero(d)};
        if constexpr (kUsed == 0U) {
          sums = correct_kept(data, arrays, own, group, lane);
        } else {
          for (std::size_t slot = 0; slot < SolidPlanes::kSlots; ++slot) {
            const Vec4 part = load_records(solid_wall[slot] + i);
            samples = subtract(samples, {part.x, part.y, part.z});
          }
          SolidWalls walls = no_solid_walls();
          sums = correct_with_images<kUsed>(data, arrays, own, group, lane, i, walls);
          solids = store_solid_walls(data, walls, i, solid_wall);
        }
        Vec3 total = multiply(own, samples);
        if constexpr (kUsed != 0U) add_to(total, solids);
        FloatV rate = hn::Zero(d);
        if (data.walls_move)
          rate = corrected_wall_rate(data, scales, own, group, lane, load_records(data.position + i));
        store_gradient_sums(data, sums, total, rate, i, sum, wall, alpha);
        if (mobility) divide_alpha(hn::LoadU(d, mobility + i), alpha + i);
      });
    });
}

}  // namespace HWY_NAMESPACE
}  // namespace pelagos
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pelagos {

HWY_EXPORT(corrected_gradient_groups);

void compute_corrected_gradients(TaskPool& pool, const PairData& data, const Corrections& corrections,
                                 Gradients& gradients) {
  reserve_gradients(data, true, gradients);
  Float4* const solid_wall[] = {gradients.solid_wall[0].data(), gradients.solid_wall[1].data()};
  for_each_group(pool, data, [&](std::size_t first, std::size_t last) {
    HWY_DYNAMIC_DISPATCH(corrected_gradient_groups)
    (data, first, last, corrections.first.data(), corrections.second.data(),
     data.phases ? gradients.mobility.data() : nullptr, gradients.alpha.data(), gradients.sum.data(),
     gradients.wall.data(), solid_wall, gradients.own.words.data(), gradients.other.words.data());
  });
}

}  // namespace pelagos
#endif  // HWY_ONCE
