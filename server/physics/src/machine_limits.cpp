#include "physics/machine_limits.hpp"

#include <numeric>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "machine_limits.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd_pairs-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace pelagos {
namespace HWY_NAMESPACE {

constexpr std::size_t kChains = 16;

float sum_lanes(FloatV v) { return hn::GetLane(hn::SumOfLanes(FloatTag(), v)); }

float read_range(const float* values, std::size_t count) {
  const FloatTag d;
  const std::size_t lanes = hn::Lanes(d);
  FloatV a = hn::Zero(d), b = a, c = a, e = a;
  std::size_t i = 0;
  for (; i + 4 * lanes <= count; i += 4 * lanes) {
    a = hn::Add(a, hn::LoadU(d, values + i));
    b = hn::Add(b, hn::LoadU(d, values + i + lanes));
    c = hn::Add(c, hn::LoadU(d, values + i + 2 * lanes));
    e = hn::Add(e, hn::LoadU(d, values + i + 3 * lanes));
  }
  return std::accumulate(values + i, values + count, sum_lanes(hn::Add(hn::Add(a, b), hn::Add(c, e))));
}

float gather_groups(const NeighborList& list, std::size_t first_group, std::size_t last_group, const Float4* records) {
  FloatV sum = hn::Zero(FloatTag());
  for (std::size_t group = first_group; group < last_group; ++group)
    for (std::size_t lane = 0; lane < kLanes; lane += hn::Lanes(FloatTag()))
      for (std::uint32_t s = list.groups[group].begin; s < list.groups[group].end; ++s) {
        const Vec4 record = gather_records(records, list.slots.data() + s * kLanes + lane);
        sum = hn::Add(sum, hn::Add(hn::Add(record.x, record.y), hn::Add(record.z, record.w)));
      }
  return sum_lanes(sum);
}

float multiply_add_block(std::size_t rounds, float factor, float term) {
  const FloatTag d;
  const FloatV m = hn::Set(d, factor), t = hn::Set(d, term);
  FloatV chain[kChains];  // all differ, or the compiler would keep one of them
  for (std::size_t c = 0; c < kChains; ++c) chain[c] = hn::Set(d, term * static_cast<float>(c));
  for (std::size_t k = 0; k < rounds; ++k)
    for (FloatV& value : chain) value = hn::MulAdd(value, m, t);
  FloatV sum = hn::Zero(d);
  for (const FloatV& value : chain) sum = hn::Add(sum, value);
  return sum_lanes(sum);
}

double operations_a_round() { return 2.0 * static_cast<double>(kChains * hn::Lanes(FloatTag())); }

}  // namespace HWY_NAMESPACE
}  // namespace pelagos
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pelagos {

HWY_EXPORT(read_range);
HWY_EXPORT(gather_groups);
HWY_EXPORT(multiply_add_block);
HWY_EXPORT(operations_a_round);

namespace {
/// Sums f(begin, end) over blocks in their order.
template <class F>
float sum_blocks(TaskPool& pool, std::size_t count, std::size_t block, F&& f) {
  std::vector<float> partial((count + block - 1) / block);
  pool.for_each_range(count, block,
                      [&](std::size_t begin, std::size_t end) { partial[begin / block] = f(begin, end); });
  return std::accumulate(partial.begin(), partial.end(), 0.0F);
}
}  // namespace

float read_all(TaskPool& pool, std::span<const float> values) {
  return sum_blocks(pool, values.size(), 1U << 16U, [&](std::size_t begin, std::size_t end) {
    return HWY_DYNAMIC_DISPATCH(read_range)(values.data() + begin, end - begin);
  });
}

float gather_all(TaskPool& pool, const NeighborList& list, const Float4* records) {
  return sum_blocks(pool, list.groups.size(), 16, [&](std::size_t begin, std::size_t end) {
    return HWY_DYNAMIC_DISPATCH(gather_groups)(list, begin, end, records);
  });
}

float multiply_add(TaskPool& pool, std::size_t blocks, std::size_t rounds) {
  return sum_blocks(pool, blocks, 1, [&](std::size_t begin, std::size_t) {
    return HWY_DYNAMIC_DISPATCH(multiply_add_block)(rounds, 0.5F, 1e-3F * static_cast<float>(begin + 1));
  });
}

double multiply_add_operations(std::size_t blocks, std::size_t rounds) {
  return static_cast<double>(blocks) * static_cast<double>(rounds) * HWY_DYNAMIC_DISPATCH(operations_a_round)();
}

}  // namespace pelagos
#endif
