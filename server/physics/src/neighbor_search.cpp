#include "physics/neighbor_search.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "search_job.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "neighbor_search.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd_pairs-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace pelagos {
namespace HWY_NAMESPACE {

/// Copies the points of the 27 cells around a cell into `out`, relative to its centre, padded to whole vectors.
/// Whole vectors are copied: what goes past the end of a run is overwritten by the next one.
void collect_candidates(const SearchJob& job, const std::array<int, 3>& cell, const Float4& center, Candidates& out) {
  const FloatTag d;
  const IntTag di;
  const std::size_t lanes = hn::Lanes(d);
  const FloatV ox = hn::Set(d, center.x), oy = hn::Set(d, center.y), oz = hn::Set(d, center.z);
  const RunList runs = find_runs(job, cell);
  out.reserve(runs.points + 2 * kLanes);
  std::size_t n = 0;
  for (std::size_t r = 0; r < runs.count; ++r) {
    const Run& run = runs.run[r];
    std::size_t at = n;
    for (std::uint32_t k = run.first; k < run.last; k += static_cast<std::uint32_t>(lanes), at += lanes) {
      const Vec4 p = load_records(run.position + k);
      const FloatV x = hn::Sub(p.x, ox), y = hn::Sub(p.y, oy), z = hn::Sub(p.z, oz);
      hn::StoreU(x, d, &out.x[at]);
      hn::StoreU(y, d, &out.y[at]);
      hn::StoreU(z, d, &out.z[at]);
      hn::StoreU(hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z))), d, &out.squared[at]);
      hn::StoreU(hn::Iota(di, static_cast<std::int32_t>(k + run.index_offset)), di, &out.index[at]);
    }
    n += run.last - run.first;
  }
  out.count = n;
  for (std::size_t pad = 0; pad < kLanes; pad += lanes) {
    hn::StoreU(hn::Zero(d), d, &out.x[n + pad]);
    hn::StoreU(hn::Zero(d), d, &out.y[n + pad]);
    hn::StoreU(hn::Zero(d), d, &out.z[n + pad]);
    hn::StoreU(hn::Set(d, kFar * kFar), d, &out.squared[n + pad]);
  }
}

/// |c - p|^2 < R^2 as |c|^2 - 2 p.c < R^2 - |p|^2, all relative to the cell's centre.
HWY_INLINE hn::Mask<IntTag> is_near(FloatV squared, FloatV x, FloatV y, FloatV z, FloatV minus_2x, FloatV minus_2y,
                                    FloatV minus_2z, FloatV limit) {
  const FloatV t = hn::MulAdd(minus_2x, x, hn::MulAdd(minus_2y, y, hn::MulAdd(minus_2z, z, squared)));
  return hn::RebindMask(IntTag(), hn::Lt(t, limit));
}

/// Writes the candidates within reach of two query points to their rows (the second may repeat the first). Past the
/// capacity only the count goes on: such a row is redone by the exact path.
HWY_INLINE void test_two(const Candidates& c, const Float4& a, const Float4& b, float radius_squared,
                         std::int32_t* row_a, std::int32_t* row_b, std::uint32_t& length_a, std::uint32_t& length_b) {
  const FloatTag d;
  const IntTag di;
  const FloatV ax = hn::Set(d, -2.0F * a.x), ay = hn::Set(d, -2.0F * a.y), az = hn::Set(d, -2.0F * a.z);
  const FloatV bx = hn::Set(d, -2.0F * b.x), by = hn::Set(d, -2.0F * b.y), bz = hn::Set(d, -2.0F * b.z);
  const FloatV limit_a = hn::Set(d, radius_squared - (a.x * a.x + a.y * a.y + a.z * a.z));
  const FloatV limit_b = hn::Set(d, radius_squared - (b.x * b.x + b.y * b.y + b.z * b.z));
  const float *cx = c.x.data(), *cy = c.y.data(), *cz = c.z.data(), *cs = c.squared.data();
  const std::int32_t* ci = c.index.data();
  const std::size_t count = c.count;
  std::size_t na = 0, nb = 0;
  for (std::size_t k = 0; k < count; k += hn::Lanes(d)) {
    const FloatV x = hn::LoadU(d, cx + k), y = hn::LoadU(d, cy + k), z = hn::LoadU(d, cz + k);
    const FloatV squared = hn::LoadU(d, cs + k);
    const IntV index = hn::LoadU(di, ci + k);
    const auto near_a = is_near(squared, x, y, z, ax, ay, az, limit_a);
    const auto near_b = is_near(squared, x, y, z, bx, by, bz, limit_b);
    na += store_packed(index, near_a, row_a + (na < kRowCapacity ? na : kRowCapacity));
    nb += store_packed(index, near_b, row_b + (nb < kRowCapacity ? nb : kRowCapacity));
  }
  length_a = static_cast<std::uint32_t>(na);
  length_b = static_cast<std::uint32_t>(nb);
}

/// Claims slots for a group and writes its rows into them, transposed. Groups that do not fit only claim.
void write_group(const SearchJob& job, std::size_t group, SearchScratch& scratch) {
  NeighborList& list = *job.list;
  std::uint32_t longest = 0;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    longest = std::max(longest, scratch.length[lane]);
    list.pair_count[group * kLanes + lane] = scratch.length[lane];
  }
  list.groups[group] = {};
  if (longest == 0 || longest > kRowCapacity) return;  // a long group is left to the exact path
  const std::uint32_t padded = (longest + 3) / 4 * 4;
  const std::uint64_t first = job.claims->claim(job.share_of(group), padded);
  if (first + padded > job.slot_capacity) return;
  const IntTag di;
  const std::size_t lanes = hn::Lanes(di);
  const IntV dummies = hn::Set(di, job.dummy);
  std::array<std::int32_t, kLanes> record;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    std::int32_t* row = scratch.rows.data() + lane * kRowStride;
    for (std::uint32_t k = scratch.length[lane]; k < padded; k += static_cast<std::uint32_t>(lanes))
      hn::StoreU(dummies, di, row + k);
    record[lane] = static_cast<std::int32_t>(lane * kRowStride / 4);
  }
  // Rows are read as records of four indices: the gather helper transposes bits without looking at them.
  const auto* rows = reinterpret_cast<const Float4*>(scratch.rows.data());
  for (std::uint32_t k = 0; k < padded; k += 4)
    for (std::size_t lane = 0; lane < kLanes; lane += lanes) {
      const Vec4 four = gather_records(rows + k / 4, record.data() + lane);
      std::int32_t* out = list.slots.data() + (first + k) * kLanes + lane;
      hn::StoreU(hn::BitCast(di, four.x), di, out);
      hn::StoreU(hn::BitCast(di, four.y), di, out + kLanes);
      hn::StoreU(hn::BitCast(di, four.z), di, out + 2 * kLanes);
      hn::StoreU(hn::BitCast(di, four.w), di, out + 3 * kLanes);
    }
  list.groups[group] = {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(first + longest)};
}

/// Finds the neighbours of the groups [first_group, last_group), cell by cell.
void search_groups(const SearchJob& job, std::size_t first_group, std::size_t last_group, SearchScratch& scratch) {
  const CellGrid& grid = *job.query_grid;
  const std::size_t count = job.query.size();
  const std::size_t end = std::min(last_group * kLanes, count);
  const float radius_squared = job.support_radius * job.support_radius;
  scratch.length.fill(0);
  std::size_t i = first_group * kLanes;
  while (i < end) {
    const std::size_t cell = grid.cell_of(job.query[i]);
    const std::size_t cell_end = std::min<std::size_t>(grid.begin()[cell + 1], end);
    const std::array<int, 3> at = cell_coordinates(grid, cell);
    const Float4 center = grid.center(at[0], at[1], at[2]);
    collect_candidates(job, at, center, scratch.candidates);
    if (scratch.candidates.count == 0) {  // nothing near: all rows of the cell stay empty
      const std::size_t group_end = std::min((i / kLanes + 1) * kLanes, end);
      i = std::min(cell_end, group_end);
      if (i == group_end) {
        write_group(job, (i - 1) / kLanes, scratch);
        scratch.length.fill(0);
      }
      continue;
    }
    while (i < cell_end) {
      const std::size_t lane = i % kLanes;
      // Two at a time, as long as both are of this cell and this group.
      const bool two = i + 1 < cell_end && lane + 1 < kLanes;
      const std::size_t other = two ? lane + 1 : lane;
      const Float4 a = relative_to(center, job.query[i]), b = two ? relative_to(center, job.query[i + 1]) : a;
      test_two(scratch.candidates, a, b, radius_squared, scratch.rows.data() + lane * kRowStride,
               scratch.rows.data() + other * kRowStride, scratch.length[lane], scratch.length[other]);
      i += two ? 2 : 1;
      if (i % kLanes == 0 || i == end) {
        write_group(job, (i - 1) / kLanes, scratch);
        scratch.length.fill(0);
      }
    }
  }
}

const char* target_name() { return hwy::TargetName(HWY_TARGET); }

}  // namespace HWY_NAMESPACE
}  // namespace pelagos
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pelagos {

HWY_EXPORT(search_groups);
HWY_EXPORT(target_name);

namespace {

constexpr std::size_t kGroupsPerBlock = 16;

/// A neighbour of a long row; rows are made in ascending order of indices within a source.
struct LongRowEntry {
  float distance_squared;
  std::uint32_t order;  ///< place in the row
  std::int32_t index;
};

/// Keeps the nearest, in the order in which they were; of equally near ones the first.
void cut_row(std::vector<LongRowEntry>& row) {
  const auto nearer = [](const LongRowEntry& a, const LongRowEntry& b) {
    return a.distance_squared != b.distance_squared ? a.distance_squared < b.distance_squared : a.order < b.order;
  };
  std::nth_element(row.begin(), row.begin() + kLongestRow, row.end(), nearer);
  row.resize(kLongestRow);
  std::sort(row.begin(), row.end(), [](const LongRowEntry& a, const LongRowEntry& b) { return a.order < b.order; });
}

/// The neighbours of one group, however many up to kLongestRow a particle; counts long and cut rows.
void search_group_exactly(const SearchJob& job, std::size_t group, SearchReport& report) {
  NeighborList& list = *job.list;
  std::array<std::vector<LongRowEntry>, kLanes> rows;
  std::size_t longest = 0;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const std::size_t i = group * kLanes + lane;
    if (i >= job.query.size()) continue;
    const Float4& p = job.query[i];
    const RunList runs = find_runs(job, cell_coordinates(*job.query_grid, job.query_grid->cell_of(p)));
    for (const Run& run : std::span(runs.run).first(runs.count))
      for (std::uint32_t k = run.first; k < run.last; ++k) {
        const float x = run.position[k].x - p.x, y = run.position[k].y - p.y, z = run.position[k].z - p.z;
        const float r_squared = x * x + y * y + z * z;
        if (r_squared < job.support_radius * job.support_radius)
          rows[lane].push_back({r_squared, static_cast<std::uint32_t>(rows[lane].size()),
                                static_cast<std::int32_t>(k + run.index_offset)});
      }
    report.long_rows += rows[lane].size() > kRowCapacity ? 1U : 0U;
    if (rows[lane].size() > kLongestRow) {
      cut_row(rows[lane]);
      ++report.cut_rows;
    }
    longest = std::max(longest, rows[lane].size());
    list.pair_count[i] = static_cast<std::uint32_t>(rows[lane].size());
  }
  const std::uint64_t first = job.claims->claim_apart(longest);
  if (list.slots.size() < (first + longest) * kLanes) list.slots.resize((first + longest) * kLanes);
  for (std::size_t k = 0; k < longest; ++k)
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      list.slots[(first + k) * kLanes + lane] = k < rows[lane].size() ? rows[lane][k].index : job.dummy;
  list.groups[group] = {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(first + longest)};
}

}  // namespace

SearchReport find_neighbors(TaskPool& pool, const CellGrid& query_grid, std::span<const Float4> query,
                            std::span<const SearchSource> sources, float support_radius, std::int32_t dummy,
                            NeighborList& list) {
  const std::size_t groups = padded_count(query.size()) / kLanes;
  list.groups.assign(groups, {});
  list.pair_count.assign(groups * kLanes, 0);
  list.dummy = dummy;
  const auto shares = static_cast<std::size_t>(pool.thread_count());
  std::optional<SlotClaims> claims;
  SearchJob job{&query_grid, query, sources, support_radius, dummy, &list, 0, shares, nullptr};
  for (;;) {
    job.slot_capacity = list.slots.size() / kLanes;
    job.claims = &claims.emplace(shares, job.slot_capacity);
    pool.for_each_range(groups, kGroupsPerBlock, [&](std::size_t first, std::size_t last) {
      thread_local SearchScratch scratch;
      HWY_DYNAMIC_DISPATCH(search_groups)(job, first, last, scratch);
    });
    const std::uint64_t wanted = claims->claimed();
    if (wanted <= job.slot_capacity) break;
    list.slots.resize((wanted + wanted / 4 + kLanes) * kLanes);  // and once more, with room
  }
  SearchReport report;
  for (std::size_t group = 0; group < groups; ++group) {
    const auto first = list.pair_count.begin() + static_cast<std::ptrdiff_t>(group * kLanes);
    if (*std::max_element(first, first + kLanes) > kRowCapacity) search_group_exactly(job, group, report);
    for (std::size_t lane = 0; lane < kLanes; ++lane) report.pairs += first[static_cast<std::ptrdiff_t>(lane)];
    report.slots += list.groups[group].end - list.groups[group].begin;
  }
  return report;
}

const char* instruction_set() { return HWY_DYNAMIC_DISPATCH(target_name)(); }

bool limit_instruction_set(const char* name) {
  const std::string_view wanted = name;
  std::int64_t disabled = -1;
  if (wanted == "avx512") disabled = 0;
  if (wanted == "avx2") disabled = HWY_AVX3;
  if (wanted == "sse4") disabled = HWY_AVX3 | HWY_AVX2;
  if (wanted == "baseline") disabled = HWY_AVX3 | HWY_AVX2 | HWY_SSE4;
  if (disabled < 0) return false;
  hwy::DisableTargets(disabled);
  const std::string_view runs = instruction_set();
  if (wanted == "avx512") return runs == "AVX3";
  if (wanted == "avx2") return runs == "AVX2";
  return wanted != "sse4" || runs == "SSE4";
}

}  // namespace pelagos
#endif  // HWY_ONCE
