#include "neighborhood_kernel.hpp"

#include <cmath>
#include <string_view>

namespace pelagos {

namespace {

/// The loop over lanes is left to the compiler to vectorise; each wrapper below compiles it for one instruction set.
[[gnu::always_inline]] inline void add_slots(const Float4* query, const Float4* neighbors, const std::int32_t* slots,
                                             NeighborList::SlotRange range, float support_radius, GroupSums& sums) {
  const float radius_squared = support_radius * support_radius;
  const float inverse_cubed = 1.0f / (radius_squared * support_radius);
  alignas(64) float qx[kLanes], qy[kLanes], qz[kLanes];
  alignas(64) float weight[kLanes] = {}, sx[kLanes] = {}, sy[kLanes] = {}, sz[kLanes] = {};
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    qx[lane] = query[lane].x;
    qy[lane] = query[lane].y;
    qz[lane] = query[lane].z;
  }
  for (std::size_t slot = range.begin; slot < range.end; ++slot) {
    const std::int32_t* index = slots + kLanes * slot;
    alignas(64) float nx[kLanes], ny[kLanes], nz[kLanes];
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const Float4& p = neighbors[index[lane]];
      nx[lane] = p.x;
      ny[lane] = p.y;
      nz[lane] = p.z;
    }
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const float dx = nx[lane] - qx[lane], dy = ny[lane] - qy[lane], dz = nz[lane] - qz[lane];
      const float squared = dx * dx + dy * dy + dz * dz;
      const bool near = squared < radius_squared;  // false for NaN
      const float w = near ? 1.0f - squared * std::sqrt(squared) * inverse_cubed : 0.0f;
      weight[lane] += w;
      sx[lane] += near ? w * dx : 0.0f;
      sy[lane] += near ? w * dy : 0.0f;
      sz[lane] += near ? w * dz : 0.0f;
    }
  }
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    sums.weight[lane] += weight[lane];
    sums.x[lane] += sx[lane];
    sums.y[lane] += sy[lane];
    sums.z[lane] += sz[lane];
  }
}

[[gnu::target("avx512f,avx512vl,avx512dq,avx512bw")]] void add_slots_avx512(const Float4* query,
                                                                            const Float4* neighbors,
                                                                            const std::int32_t* slots,
                                                                            NeighborList::SlotRange range,
                                                                            float support_radius, GroupSums& sums) {
  add_slots(query, neighbors, slots, range, support_radius, sums);
}

[[gnu::target("avx2")]] void add_slots_avx2(const Float4* query, const Float4* neighbors, const std::int32_t* slots,
                                            NeighborList::SlotRange range, float support_radius, GroupSums& sums) {
  add_slots(query, neighbors, slots, range, support_radius, sums);
}

void add_slots_baseline(const Float4* query, const Float4* neighbors, const std::int32_t* slots,
                        NeighborList::SlotRange range, float support_radius, GroupSums& sums) {
  add_slots(query, neighbors, slots, range, support_radius, sums);
}

}  // namespace

GroupKernel group_kernel(const char* instruction_set) {
  const std::string_view name = instruction_set;
  if (name == "avx512")
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                   __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw")
               ? add_slots_avx512
               : nullptr;
  if (name == "avx2") return __builtin_cpu_supports("avx2") ? add_slots_avx2 : nullptr;
  return name == "baseline" ? add_slots_baseline : nullptr;
}

GroupKernel select_group_kernel() {
  for (const char* name : {"avx512", "avx2"})
    if (const GroupKernel kernel = group_kernel(name)) return kernel;
  return add_slots_baseline;
}

}  // namespace pelagos
