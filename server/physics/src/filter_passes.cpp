#include "physics/pair_passes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter_passes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "group_blocks.hpp"
#include "kept_gradients-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace pelagos {
namespace HWY_NAMESPACE {

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

}  // namespace HWY_NAMESPACE
}  // namespace pelagos
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pelagos {

HWY_EXPORT(velocity_gradient_groups);
HWY_EXPORT(filter_groups);

namespace {

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

}  // namespace

void compute_velocity_gradients(TaskPool& pool, const PairData& data, const Gradients& gradients,
                                std::span<const Float4> velocity, VelocityGradients& out) {
  const std::size_t size = gathered_count(data);
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

}  // namespace pelagos
#endif  // HWY_ONCE
