#include "column_sums.hpp"

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "column_sums.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pelagos {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, 16>;
using V = hn::Vec<Tag>;

HWY_INLINE V set(float value) { return hn::Set(Tag(), value); }

/// Calls body(x, y, z) for all particles of a row, some at a time; lanes past the end lie far away.
template <class F>
HWY_INLINE void for_each_vector(const ColumnRow& row, F&& body) {
  const Tag d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= row.count; i += lanes)
    body(hn::LoadU(d, row.x + i), hn::LoadU(d, row.y + i), hn::LoadU(d, row.z + i));
  if (i == row.count) return;
  float x[16], y[16], z[16];
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const bool inside = i + lane < row.count;
    x[lane] = inside ? row.x[i + lane] : 1e18F;
    y[lane] = inside ? row.y[i + lane] : 1e18F;
    z[lane] = inside ? row.z[i + lane] : -1e18F;
  }
  body(hn::LoadU(d, x), hn::LoadU(d, y), hn::LoadU(d, z));
}

float highest_below_impl(const ColumnRows& rows, const ColumnAxis& axis, float below) {
  constexpr float kNothing = -std::numeric_limits<float>::infinity();
  const V nothing = set(kNothing), limit = set(below), square = set(axis.radius * axis.radius);
  V highest = nothing;
  for (const ColumnRow& row : rows)
    for_each_vector(row, [&](V x, V y, V z) {
      const V a = hn::Sub(x, set(axis.x)), b = hn::Sub(y, set(axis.y));
      const V r2 = hn::MulAdd(a, a, hn::Mul(b, b));
      const auto counts = hn::And(hn::Lt(r2, square), hn::Lt(z, limit));
      highest = hn::Max(highest, hn::IfThenElse(counts, z, nothing));
    });
  return hn::GetLane(hn::MaxOfLanes(Tag(), highest));
}

/// How much of a slice of thickness d about z is above a level.
HWY_INLINE V share_above(V z, V level, V inverse_spacing) {
  const V share = hn::MulAdd(hn::Sub(z, level), inverse_spacing, set(0.5F));
  return hn::Min(hn::Max(share, hn::Zero(Tag())), set(1.0F));
}

ColumnSums sum_column_impl(const ColumnRows& rows, const ColumnAxis& axis, float top) {
  const Tag d;
  const float spacing = axis.spacing, level = top - 2.0F * spacing;
  const V zero = hn::Zero(d), one = set(1.0F), inverse_square = set(1.0F / (axis.radius * axis.radius));
  const V inverse = set(1.0F / spacing), upper = set(top + 2.0F * spacing), middle = set(level);
  const V lower = set(level - 2.0F * spacing), bottom = set(level - 1.5F * spacing), summit = set(top);
  V under = zero, counted = zero, counted_x = zero, counted_y = zero, slab = zero, slab_x = zero, slab_y = zero;
  V lowest = set(std::numeric_limits<float>::infinity());
  for (const ColumnRow& row : rows)
    for_each_vector(row, [&](V x, V y, V z) {
      const V a = hn::Sub(x, set(axis.x)), b = hn::Sub(y, set(axis.y));
      const V rest = hn::Max(hn::NegMulAdd(hn::MulAdd(a, a, hn::Mul(b, b)), inverse_square, one), zero);
      const V weight = hn::Mul(rest, rest);
      const V above = share_above(z, middle, inverse);
      const V in_slab = hn::Mul(weight, hn::Sub(share_above(z, lower, inverse), above));
      const V in_count = hn::Mul(weight, hn::Sub(above, share_above(z, upper, inverse)));
      const auto below_top = hn::And(hn::Le(z, summit), hn::Gt(z, middle));
      under = hn::Add(under, hn::IfThenElseZero(below_top, weight));
      counted = hn::Add(counted, in_count);
      counted_x = hn::MulAdd(a, in_count, counted_x);
      counted_y = hn::MulAdd(b, in_count, counted_y);
      slab = hn::Add(slab, in_slab);
      slab_x = hn::MulAdd(a, in_slab, slab_x);
      slab_y = hn::MulAdd(b, in_slab, slab_y);
      lowest = hn::Min(lowest, hn::IfThenElse(hn::Gt(weight, zero), z, lowest));
    });
  const auto total = [&](V v) { return hn::GetLane(hn::SumOfLanes(d, v)); };
  return {
      total(under), total(counted), total(counted_x), total(counted_y),
      total(slab),  total(slab_x),  total(slab_y),    hn::GetLane(hn::MinOfLanes(d, lowest)) <= hn::GetLane(bottom)};
}

}  // namespace HWY_NAMESPACE
}  // namespace pelagos
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pelagos {

HWY_EXPORT(highest_below_impl);
HWY_EXPORT(sum_column_impl);

float highest_below(const ColumnRows& rows, const ColumnAxis& axis, float below) {
  return HWY_DYNAMIC_DISPATCH(highest_below_impl)(rows, axis, below);
}
ColumnSums sum_column(const ColumnRows& rows, const ColumnAxis& axis, float top) {
  return HWY_DYNAMIC_DISPATCH(sum_column_impl)(rows, axis, top);
}

}  // namespace pelagos
#endif
