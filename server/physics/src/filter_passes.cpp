#include "physics/pair_passes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter_passes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "filter_output.hpp"
#include "group_blocks.hpp"
#include "solid_pairs-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace pelagos {
namespace HWY_NAMESPACE {

/// Rows of a velocity gradient, times -spacing.
struct GradientRows {
  Vec3 x, y, z;
};
/// rows += change g', change: own velocity less the neighbour's
HWY_INLINE void add_change(const Vec3& change, const Vec3& g, GradientRows& rows) {
  rows.x = add_along(rows.x, change.x, g);
  rows.y = add_along(rows.y, change.y, g);
  rows.z = add_along(rows.z, change.z, g);
}

/// 2 n (n.v) of each surface's own velocity v, by slot: what an image's velocity has beside the reflected one.
struct SurfaceDrifts {
  Vec3 of[SolidPlanes::kSlots];
};
template <unsigned kUsed>
HWY_INLINE SurfaceDrifts surface_drifts(const PairData& data, const Mirrors& own, std::size_t i) {
  const FloatTag d;
  SurfaceDrifts drifts{{zero3(), zero3()}};
  for (std::size_t k = 0; k < SolidPlanes::kSlots; ++k) {
    if (!(kUsed >> k & 1U)) continue;
    const FloatV speed = hn::LoadU(d, data.solids->speed[k].data() + i);
    drifts.of[k] = scaled(own.normal[k], hn::Add(speed, speed));
  }
  return drifts;
}
/// The velocity of a neighbour's image in the surfaces kIn.
template <unsigned kIn>
HWY_INLINE Vec3 image_velocity(const Mirrors& its, const SurfaceDrifts& drifts, const Vec3& v) {
  Vec3 image = reflect<kIn>(its, v);
  for (std::size_t k = 0; k < SolidPlanes::kSlots; ++k)
    if (kIn >> k & 1U) add_to(image, drifts.of[k]);
  return image;
}

HWY_INLINE GradientRows kept_rows(const PairData& data, const CachedGradient* cache, const Float4* velocity,
                                  std::size_t group, std::size_t lane, const Vec3& own) {
  GradientRows rows{zero3(), zero3(), zero3()};
  const NeighborList::SlotRange fluid = data.fluid->groups[group];
  for (std::uint32_t s = fluid.begin; s < fluid.end; ++s) {
    const Vec4 other = gather_records(velocity, data.fluid->slots.data() + s * kLanes + lane);
    add_change(subtract(own, {other.x, other.y, other.z}), kept_gradient(cache + s * kCacheStride + lane), rows);
  }
  return rows;
}

/// The same near solids, from the positions where the planes were found.
template <unsigned kUsed>
HWY_INLINE GradientRows rows_with_images(const PairData& data, const Symmetric& correction, const Float4* velocity,
                                         std::size_t group, std::size_t lane, std::size_t i, const Vec3& own) {
  const KernelScales scales = kernel_scales(data);
  const Float4* positions = data.solids->position.data();
  const Vec4 place = load_records(positions + i);
  const Mirrors mirrors = own_mirrors<kUsed>(data, i, {place.x, place.y, place.z});
  const SurfaceDrifts drifts = surface_drifts<kUsed>(data, mirrors, i);
  GradientRows rows{zero3(), zero3(), zero3()};
  const NeighborList::SlotRange fluid = data.fluid->groups[group];
  for (std::uint32_t s = fluid.begin; s < fluid.end; ++s) {
    const std::int32_t* index = data.fluid->slots.data() + s * kLanes + lane;
    const Vec4 there = gather_records(positions, index), moves = gather_records(velocity, index);
    const Vec3 v{moves.x, moves.y, moves.z};
    const PairGeometry pair = difference(place, there);
    const Mirrors its = other_mirrors<kUsed>(data, index, {there.x, there.y, there.z});
    const KernelPair kernel = cubic_spline(pair.r_squared, scales.support, scales.inverse_support);
    add_change(subtract(own, v), scaled(pair, hn::Mul(kernel.gradient_factor, scales.gradient_spacing)), rows);
    for_each_image<kUsed>([&]<unsigned kIn>(Slots<kIn>) HWY_ATTR {
      const ImagePair image = image_pair<kIn>(mirrors, its, pair);
      const KernelPair of_image = cubic_spline(image.squared, scales.support, scales.inverse_support);
      const FloatV factor = hn::Mul(hn::Mul(of_image.gradient_factor, scales.gradient_spacing), share_of<kIn>(mirrors));
      add_change(subtract(own, image_velocity<kIn>(its, drifts, v)), scaled(image.a, factor), rows);
    });
  }
  return {multiply(correction, rows.x), multiply(correction, rows.y), multiply(correction, rows.z)};
}

/// rows -= c (G - G^T) / 2, c = limit / (limit + 2 G:G). @param limit  the square of the weak rate, in the rows' unit
HWY_INLINE void leave_out_weak_rotation(FloatV limit, GradientRows& rows) {
  const FloatTag d;
  const FloatV squares = dot(rows.x, rows.x, dot(rows.y, rows.y, dot(rows.z, rows.z, hn::Zero(d))));
  const FloatV all = hn::Max(hn::Add(limit, hn::Add(squares, squares)), hn::Set(d, 1e-30F));
  const FloatV half_share = hn::Mul(hn::Set(d, 0.5F), hn::Div(limit, all));
  const auto draw_together = [&](FloatV& a, FloatV& b) HWY_ATTR {
    const FloatV half = hn::Mul(half_share, hn::Sub(a, b));
    a = hn::Sub(a, half), b = hn::Add(b, half);
  };
  draw_together(rows.x.y, rows.y.x);
  draw_together(rows.x.z, rows.z.x);
  draw_together(rows.y.z, rows.z.y);
}

void velocity_gradient_groups(const PairData& data, std::size_t first_group, std::size_t last_group,
                              const void* cache_words, const Float4* first, const Float4* second,
                              const Float4* velocity, float weak_rate, Float4* row_x, Float4* row_y, Float4* row_z) {
  const auto* cache = static_cast<const CachedGradient*>(cache_words);
  const FloatV scale = hn::Set(FloatTag(), -1.0F / data.spacing);
  const FloatV limit = hn::Set(FloatTag(), weak_rate * data.spacing * weak_rate * data.spacing);
  const auto store = [&](const Vec3& row, FloatV component, Float4* out) HWY_ATTR {
    store_records({hn::Mul(row.x, scale), hn::Mul(row.y, scale), hn::Mul(row.z, scale), component}, out);
  };
  for (std::size_t group = first_group; group < last_group; ++group)
    with_slots(data, group, [&]<unsigned kUsed>(Slots<kUsed>) HWY_ATTR {
      for_each_part(group, [&](std::size_t lane, std::size_t i) HWY_ATTR {
        const Vec4 v = load_records(velocity + i);
        const Vec3 own{v.x, v.y, v.z};
        GradientRows rows{zero3(), zero3(), zero3()};
        if constexpr (kUsed == 0U)
          rows = kept_rows(data, cache, velocity, group, lane, own);
        else
          rows = rows_with_images<kUsed>(data, symmetric(load_records(first + i), load_records(second + i)), velocity,
                                         group, lane, i, own);
        leave_out_weak_rotation(limit, rows);
        store(rows.x, own.x, row_x + i);
        store(rows.y, own.y, row_y + i);
        store(rows.z, own.z, row_z + i);
      });
    });
}

/// Velocity and its gradient, as the filter gathers them: rows in x, y, z, the velocity's component in w.
struct Motion {
  Vec4 x, y, z;
};
HWY_INLINE Motion own_motion(const Float4* const* rows, std::size_t i) {
  return {load_records(rows[0] + i), load_records(rows[1] + i), load_records(rows[2] + i)};
}
HWY_INLINE Motion other_motion(const Float4* const* rows, const std::int32_t* index) {
  return {gather_records(rows[0], index), gather_records(rows[1], index), gather_records(rows[2], index)};
}
HWY_INLINE Vec3 velocity_of(const Motion& m) { return {m.x.w, m.y.w, m.z.w}; }
/// G v
HWY_INLINE Vec3 along(const Motion& m, const Vec3& v) {
  const FloatV zero = hn::Zero(FloatTag());
  return {dot({m.x.x, m.x.y, m.x.z}, v, zero), dot({m.y.x, m.y.y, m.y.z}, v, zero),
          dot({m.z.x, m.z.y, m.z.z}, v, zero)};
}

/// What the images of a neighbour add to the filter, by slot, and to the density.
/// @param across  factor on the weight between phases
template <unsigned kUsed>
HWY_INLINE void add_filter_images(const KernelScales& scales, const PairGeometry& pair, const Mirrors& mirrors,
                                  const Mirrors& its, const SurfaceDrifts& drifts, const Motion& own,
                                  const Motion& other, FloatV across, SolidWalls& solids, FloatV& density) {
  const FloatV half = hn::Set(FloatTag(), 0.5F);
  for_each_image<kUsed>([&]<unsigned kIn>(Slots<kIn>) HWY_ATTR {
    const ImagePair image = image_pair<kIn>(mirrors, its, pair);
    const FloatV weight =
        hn::Mul(cubic_spline(image.squared, scales.support, scales.inverse_support).value, share_of<kIn>(mirrors));
    density = hn::Add(density, weight);
    const Vec3 its_change = reflect<kIn>(its, along(other, reflect_back<kIn>(its, image.a)));
    Vec3 linear = along(own, image.a);
    add_to(linear, its_change);
    const Vec3 apart = subtract(image_velocity<kIn>(its, drifts, velocity_of(other)), velocity_of(own));
    add_wall<kIn>(scaled(add_along(apart, half, linear), hn::Mul(weight, across)), solids);
  });
}

template <bool kPhases, unsigned kUsed>
HWY_INLINE void filter_part(const PairData& data, const KernelScales& scales, std::size_t group, std::size_t lane,
                            std::size_t i, const Float4* const* rows, const FilterOutput& out) {
  const FloatTag d;
  const FloatV half = hn::Set(d, 0.5F), one = hn::Set(d, 1.0F);
  const Vec4 place = load_records(data.position + i);
  const Motion own = own_motion(rows, i);
  Vec3 sum = zero3();
  FloatV density = hn::Zero(d), between = hn::Zero(d);
  if constexpr (kPhases)  // rho0_lighter / rho0_i
    between = choose_phase(is_light(place.w), 1.0F, data.phases->heavy_mobility / data.phases->light_mobility);
  SolidWalls solids = no_solid_walls();
  Mirrors mirrors = no_mirrors();
  SurfaceDrifts drifts{{zero3(), zero3()}};
  if constexpr (kUsed != 0U) {
    mirrors = own_mirrors<kUsed>(data, i, {place.x, place.y, place.z});
    drifts = surface_drifts<kUsed>(data, mirrors, i);
  }
  const NeighborList::SlotRange fluid = data.fluid->groups[group];
  for (std::uint32_t s = fluid.begin; s < fluid.end; ++s) {
    const std::int32_t* index = data.fluid->slots.data() + s * kLanes + lane;
    const Vec4 there = gather_records(data.position, index);
    const PairGeometry pair = difference(place, there);
    FloatV weight = cubic_spline(pair.r_squared, scales.support, scales.inverse_support).value;
    density = hn::Add(density, weight);
    FloatV across = one;
    if constexpr (kPhases) {
      across = hn::IfThenElse(hn::Eq(place.w, there.w), one, between);
      weight = hn::Mul(weight, across);
    }
    const Motion other = other_motion(rows, index);
    const auto add = [&](const Vec4& mine, const Vec4& its, FloatV& to) HWY_ATTR {
      const Vec3 both{hn::Add(mine.x, its.x), hn::Add(mine.y, its.y), hn::Add(mine.z, its.z)};
      const FloatV linear = dot(both, {pair.x, pair.y, pair.z}, hn::Zero(d));
      to = hn::MulAdd(weight, hn::MulAdd(half, linear, hn::Sub(its.w, mine.w)), to);
    };
    add(own.x, other.x, sum.x);
    add(own.y, other.y, sum.y);
    add(own.z, other.z, sum.z);
    if constexpr (kUsed != 0U) {
      const Mirrors its = other_mirrors<kUsed>(data, index, {there.x, there.y, there.z});
      add_filter_images<kUsed>(scales, pair, mirrors, its, drifts, own, other, across, solids, density);
    }
  }
  if constexpr (kUsed != 0U)
    for (std::size_t k = 0; k < SolidPlanes::kSlots; ++k) {
      const Vec3 part = scaled(solids.part[k], scales.value);
      store_records({part.x, part.y, part.z, hn::Zero(d)}, out.solid_change[k] + i);
      add_to(sum, solids.part[k]);
    }
  store_records({hn::Mul(sum.x, scales.value), hn::Mul(sum.y, scales.value), hn::Mul(sum.z, scales.value), hn::Zero(d)},
                out.change + i);
  hn::StoreU(hn::MulAdd(density, scales.value, wall_density(data, scales, place, group, lane)), d, out.delta + i);
}

template <bool kPhases>
HWY_INLINE void filter_groups_with(const PairData& data, std::size_t first_group, std::size_t last_group,
                                   const Float4* const* rows, const FilterOutput& out) {
  const KernelScales scales = kernel_scales(data);
  for (std::size_t group = first_group; group < last_group; ++group)
    with_slots(data, group, [&]<unsigned kUsed>(Slots<kUsed>) HWY_ATTR {
      for_each_part(group, [&](std::size_t lane, std::size_t i)
                               HWY_ATTR { filter_part<kPhases, kUsed>(data, scales, group, lane, i, rows, out); });
    });
}

void filter_groups(const PairData& data, std::size_t first_group, std::size_t last_group, const Float4* const* rows,
                   const FilterOutput& out) {
  if (data.phases)
    filter_groups_with<true>(data, first_group, last_group, rows, out);
  else
    filter_groups_with<false>(data, first_group, last_group, rows, out);
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
                                const Corrections& corrections, std::span<const Float4> velocity, float weak_rate,
                                VelocityGradients& out) {
  const std::size_t size = gathered_count(data);
  for (std::vector<Float4>& row : out.row) row.resize(size);
  for_each_group(pool, data, [&](std::size_t first, std::size_t last) {
    HWY_DYNAMIC_DISPATCH(velocity_gradient_groups)
    (data, first, last, gradients.own.words.data(), corrections.first.data(), corrections.second.data(),
     velocity.data(), weak_rate, out.row[0].data(), out.row[1].data(), out.row[2].data());
  });
  if (data.ghosts) extend_gradients(pool, *data.ghosts, out);
}

void compute_filter(TaskPool& pool, const PairData& data, const VelocityGradients& gradients, FilterChange& change,
                    std::span<float> delta) {
  const std::size_t padded = padded_count(data.count);
  change.all.resize(padded);
  if (data.solids)
    for (std::vector<Float4>& values : change.solid) values.resize(padded);
  const FilterOutput out{change.all.data(), {change.solid[0].data(), change.solid[1].data()}, delta.data()};
  const Float4* const rows[] = {gradients.row[0].data(), gradients.row[1].data(), gradients.row[2].data()};
  for_each_group(pool, data, [&](std::size_t first, std::size_t last) {
    HWY_DYNAMIC_DISPATCH(filter_groups)(data, first, last, rows, out);
  });
}

}  // namespace pelagos
#endif  // HWY_ONCE
