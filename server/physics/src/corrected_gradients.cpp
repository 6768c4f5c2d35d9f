#include "physics/pair_passes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "corrected_gradients.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "gradient_storage.hpp"
#include "gradient_sums-inl.hpp"
#include "group_blocks.hpp"

HWY_BEFORE_NAMESPACE();
namespace pelagos {
namespace HWY_NAMESPACE {

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

}  // namespace HWY_NAMESPACE
}  // namespace pelagos
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pelagos {

HWY_EXPORT(corrected_gradient_groups);

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

}  // namespace pelagos
#endif  // HWY_ONCE
