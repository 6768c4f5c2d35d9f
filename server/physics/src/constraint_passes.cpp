#include "physics/pair_passes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "constraint_passes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "group_blocks.hpp"
#include "kept_gradients-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace pelagos {
namespace HWY_NAMESPACE {

template <bool kPhases>
HWY_INLINE void pressure_groups_with(const PairData& data, std::size_t first_group, std::size_t last_group,
                                     const void* cache_words, const void* solid_words, const Float4* sum,
                                     const float* pressure, Float4* displacement) {
  const FloatTag d;
  const FloatV minus_inverse_spacing = hn::Set(d, -1.0F / data.spacing);
  for (std::size_t group = first_group; group < last_group; ++group)
    for_each_part(group, [&](std::size_t lane, std::size_t i) HWY_ATTR {
      const bool at_solid = data.solids && data.solids->group[group] != 0;
      const auto* cache = static_cast<const CachedGradient*>(at_solid ? solid_words : cache_words);
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
                     const void* solid_words, const Float4* sum, const float* pressure, Float4* displacement) {
  if (data.phases)
    pressure_groups_with<true>(data, first_group, last_group, cache_words, solid_words, sum, pressure, displacement);
  else
    pressure_groups_with<false>(data, first_group, last_group, cache_words, solid_words, sum, pressure, displacement);
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

}  // namespace HWY_NAMESPACE
}  // namespace pelagos
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pelagos {

HWY_EXPORT(pressure_groups);
HWY_EXPORT(rate_groups);

void apply_pressure(TaskPool& pool, const PairData& data, const Gradients& gradients, std::span<const float> pressure,
                    std::span<Float4> displacement) {
  const GradientCache& cache = gradients.corrected ? gradients.other : gradients.own;
  for_each_group(pool, data, [&](std::size_t first, std::size_t last) {
    HWY_DYNAMIC_DISPATCH(pressure_groups)
    (data, first, last, cache.words.data(), gradients.other.words.data(), gradients.sum.data(), pressure.data(),
     displacement.data());
  });
}

void compute_rate(TaskPool& pool, const PairData& data, const Gradients& gradients, std::span<const Float4> velocity,
                  bool moving_walls, std::span<float> rate) {
  for_each_group(pool, data, [&](std::size_t first, std::size_t last) {
    HWY_DYNAMIC_DISPATCH(rate_groups)
    (data, first, last, gradients.own.words.data(), gradients.wall.data(), velocity.data(), moving_walls, rate.data());
  });
}

}  // namespace pelagos
#endif  // HWY_ONCE
