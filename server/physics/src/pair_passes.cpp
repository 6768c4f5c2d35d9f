#include "physics/pair_passes.hpp"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pair_passes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd_pairs-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace pelagos {
namespace HWY_NAMESPACE {

/// Below this (in units of 1/spacing^2) a particle has no neighbours worth the name: alpha is zero there.
constexpr float kAlphaFloor = 1e-6F;
/// Three components of kLanes gradients.
constexpr std::size_t kCacheStride = 3 * kLanes;

std::size_t cached_gradient_size() { return sizeof(CachedGradient); }

/// Calls f(first_lane, i) for the parts of a group that one vector covers.
template <class F>
HWY_INLINE void for_each_part(std::size_t group, F&& f) {
  for (std::size_t lane = 0; lane < kLanes; lane += hn::Lanes(FloatTag())) f(lane, group * kLanes + lane);
}

void density_groups(const PairData& data, std::size_t first_group, std::size_t last_group, float* delta, float* alpha,
                    Float4* wall, void* cache_words) {
  const FloatTag d;
  auto* cache = static_cast<CachedGradient*>(cache_words);
  const float radius = data.support_radius;
  const FloatV support = hn::Set(d, radius), inverse_support = hn::Set(d, 1.0F / radius);
  const float sigma = static_cast<float>(8.0 / M_PI) / (radius * radius * radius);
  const FloatV value_scale = hn::Set(d, sigma * data.volume);
  const FloatV gradient_scale = hn::Set(d, sigma * data.volume * data.spacing / (radius * radius));
  const FloatV wall_scale = hn::Set(d, sigma / (radius * radius));
  for (std::size_t group = first_group; group < last_group; ++group)
    for_each_part(group, [&](std::size_t lane, std::size_t i) HWY_ATTR {
      const Vec4 own = load_records(data.position + i);
      FloatV sum = hn::Zero(d), gx = sum, gy = sum, gz = sum, squares = sum;
      const NeighborList::SlotRange fluid = data.fluid->groups[group];
      for (std::uint32_t s = fluid.begin; s < fluid.end; ++s) {
        const Vec4 other = gather_records(data.position, data.fluid->slots.data() + s * kLanes + lane);
        const FloatV x = hn::Sub(own.x, other.x), y = hn::Sub(own.y, other.y), z = hn::Sub(own.z, other.z);
        const FloatV r2 = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
        const KernelPair kernel = cubic_spline(r2, support, inverse_support);
        const FloatV factor = hn::Mul(kernel.gradient_factor, gradient_scale);
        const FloatV px = hn::Mul(factor, x), py = hn::Mul(factor, y), pz = hn::Mul(factor, z);
        CachedGradient* out = cache + s * kCacheStride + lane;
        store_cached(px, out);
        store_cached(py, out + kLanes);
        store_cached(pz, out + 2 * kLanes);
        sum = hn::Add(sum, kernel.value);
        gx = hn::Add(gx, px);
        gy = hn::Add(gy, py);
        gz = hn::Add(gz, pz);
        squares = hn::MulAdd(px, px, hn::MulAdd(py, py, hn::MulAdd(pz, pz, squares)));
      }
      FloatV density = hn::Mul(sum, value_scale);
      FloatV wx = hn::Zero(d), wy = wx, wz = wx, rate = wx;
      const NeighborList::SlotRange walls = data.boundary->groups[group];
      for (std::uint32_t s = walls.begin; s < walls.end; ++s) {
        const std::int32_t* index = data.boundary->slots.data() + s * kLanes + lane;
        const Vec4 other = gather_records(data.walls->position.data(), index);
        const FloatV x = hn::Sub(own.x, other.x), y = hn::Sub(own.y, other.y), z = hn::Sub(own.z, other.z);
        const FloatV r2 = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
        const KernelPair kernel = cubic_spline(r2, support, inverse_support);
        density = hn::MulAdd(hn::Mul(kernel.value, hn::Set(d, sigma)), other.w, density);
        const FloatV factor = hn::Mul(hn::Mul(kernel.gradient_factor, wall_scale), other.w);
        const FloatV px = hn::Mul(factor, x), py = hn::Mul(factor, y), pz = hn::Mul(factor, z);
        wx = hn::Add(wx, px);
        wy = hn::Add(wy, py);
        wz = hn::Add(wz, pz);
        if (data.walls_move) {
          const Vec4 velocity = gather_records(data.walls->velocity.data(), index);
          rate = hn::MulAdd(velocity.x, px, hn::MulAdd(velocity.y, py, hn::MulAdd(velocity.z, pz, rate)));
        }
      }
      store_records({wx, wy, wz, rate}, wall + i);
      const FloatV spacing = hn::Set(d, data.spacing);
      gx = hn::MulAdd(wx, spacing, gx);
      gy = hn::MulAdd(wy, spacing, gy);
      gz = hn::MulAdd(wz, spacing, gz);
      const FloatV diagonal = hn::MulAdd(gx, gx, hn::MulAdd(gy, gy, hn::MulAdd(gz, gz, squares)));
      const FloatV inverse = hn::Div(hn::Set(d, data.spacing * data.spacing), diagonal);
      hn::StoreU(density, d, delta + i);
      hn::StoreU(hn::IfThenElseZero(hn::Gt(diagonal, hn::Set(d, kAlphaFloor)), inverse), d, alpha + i);
    });
}

void pressure_groups(const PairData& data, std::size_t first_group, std::size_t last_group, const void* cache_words,
                     const Float4* wall, const float* pressure, Float4* displacement) {
  const FloatTag d;
  const auto* cache = static_cast<const CachedGradient*>(cache_words);
  const FloatV minus_inverse_spacing = hn::Set(d, -1.0F / data.spacing);
  for (std::size_t group = first_group; group < last_group; ++group)
    for_each_part(group, [&](std::size_t lane, std::size_t i) HWY_ATTR {
      const FloatV own = hn::LoadU(d, pressure + i);
      FloatV x = hn::Zero(d), y = x, z = x;
      const NeighborList::SlotRange fluid = data.fluid->groups[group];
      for (std::uint32_t s = fluid.begin; s < fluid.end; ++s) {
        const IntV index = hn::LoadU(IntTag(), data.fluid->slots.data() + s * kLanes + lane);
        const FloatV both = hn::Add(own, hn::GatherIndex(d, pressure, index));
        const CachedGradient* g = cache + s * kCacheStride + lane;
        x = hn::MulAdd(both, load_cached(g), x);
        y = hn::MulAdd(both, load_cached(g + kLanes), y);
        z = hn::MulAdd(both, load_cached(g + 2 * kLanes), z);
      }
      const Vec4 w = load_records(wall + i);
      store_records({hn::NegMulAdd(own, w.x, hn::Mul(x, minus_inverse_spacing)),
                     hn::NegMulAdd(own, w.y, hn::Mul(y, minus_inverse_spacing)),
                     hn::NegMulAdd(own, w.z, hn::Mul(z, minus_inverse_spacing)), hn::Zero(d)},
                    displacement + i);
    });
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
        const Vec4 other = gather_records(velocity, data.fluid->slots.data() + s * kLanes + lane);
        const CachedGradient* g = cache + s * kCacheStride + lane;
        sum = hn::MulAdd(hn::Sub(own.x, other.x), load_cached(g), sum);
        sum = hn::MulAdd(hn::Sub(own.y, other.y), load_cached(g + kLanes), sum);
        sum = hn::MulAdd(hn::Sub(own.z, other.z), load_cached(g + 2 * kLanes), sum);
      }
      const Vec4 w = load_records(wall + i);
      FloatV walls = hn::MulAdd(own.x, w.x, hn::MulAdd(own.y, w.y, hn::Mul(own.z, w.z)));
      if (moving_walls) walls = hn::Sub(walls, w.w);
      hn::StoreU(hn::MulAdd(sum, inverse_spacing, walls), d, rate + i);
    });
}

void acceleration_groups(const PairData& data, std::size_t first_group, std::size_t last_group, const Float4* velocity,
                         float viscosity, float gravity, Float4* acceleration) {
  const FloatTag d;
  const float radius = data.support_radius;
  const float sigma = static_cast<float>(8.0 / M_PI) / (radius * radius * radius);
  const FloatV support = hn::Set(d, radius), inverse_support = hn::Set(d, 1.0F / radius);
  const FloatV scale = hn::Set(d, viscosity * 10.0F * data.volume * sigma / (radius * radius));
  const FloatV softening = hn::Set(d, 0.01F * radius * radius);
  for (std::size_t group = first_group; group < last_group; ++group)
    for_each_part(group, [&](std::size_t lane, std::size_t i) HWY_ATTR {
      const Vec4 own = load_records(data.position + i), own_velocity = load_records(velocity + i);
      FloatV ax = hn::Zero(d), ay = ax, az = ax;
      const NeighborList::SlotRange fluid = data.fluid->groups[group];
      for (std::uint32_t s = fluid.begin; s < fluid.end; ++s) {
        const std::int32_t* index = data.fluid->slots.data() + s * kLanes + lane;
        const Vec4 other = gather_records(data.position, index), other_velocity = gather_records(velocity, index);
        const FloatV x = hn::Sub(own.x, other.x), y = hn::Sub(own.y, other.y), z = hn::Sub(own.z, other.z);
        const FloatV vx = hn::Sub(own_velocity.x, other_velocity.x), vy = hn::Sub(own_velocity.y, other_velocity.y),
                     vz = hn::Sub(own_velocity.z, other_velocity.z);
        const FloatV r2 = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
        const FloatV approach = hn::MulAdd(vx, x, hn::MulAdd(vy, y, hn::Mul(vz, z)));
        const KernelPair kernel = cubic_spline(r2, support, inverse_support);
        const FloatV factor = hn::Div(hn::Mul(kernel.gradient_factor, approach), hn::Add(r2, softening));
        ax = hn::MulAdd(factor, x, ax);
        ay = hn::MulAdd(factor, y, ay);
        az = hn::MulAdd(factor, z, az);
      }
      store_records({hn::Mul(ax, scale), hn::Mul(ay, scale), hn::MulAdd(az, scale, hn::Set(d, -gravity)), hn::Zero(d)},
                    acceleration + i);
    });
}

}  // namespace HWY_NAMESPACE
}  // namespace pelagos
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pelagos {

HWY_EXPORT(cached_gradient_size);
HWY_EXPORT(density_groups);
HWY_EXPORT(pressure_groups);
HWY_EXPORT(rate_groups);
HWY_EXPORT(acceleration_groups);

namespace {
/// 256 particles a block: small enough to balance two cores, large enough to amortise the claim.
constexpr std::size_t kGroupsPerBlock = 16;
}  // namespace

void compute_density(TaskPool& pool, const PairData& data, std::span<float> delta, std::span<float> alpha,
                     std::span<Float4> wall, GradientCache& cache) {
  const std::size_t bytes = data.fluid->slots.size() * 3 * HWY_DYNAMIC_DISPATCH(cached_gradient_size)();
  if (cache.words.size() * sizeof(std::uint32_t) < bytes) cache.words.resize(bytes / sizeof(std::uint32_t));
  pool.for_each_range(data.fluid->groups.size(), kGroupsPerBlock, [&](std::size_t first, std::size_t last) {
    HWY_DYNAMIC_DISPATCH(density_groups)
    (data, first, last, delta.data(), alpha.data(), wall.data(), cache.words.data());
  });
}

void apply_pressure(TaskPool& pool, const PairData& data, const GradientCache& cache, std::span<const Float4> wall,
                    std::span<const float> pressure, std::span<Float4> displacement) {
  pool.for_each_range(data.fluid->groups.size(), kGroupsPerBlock, [&](std::size_t first, std::size_t last) {
    HWY_DYNAMIC_DISPATCH(pressure_groups)
    (data, first, last, cache.words.data(), wall.data(), pressure.data(), displacement.data());
  });
}

void compute_rate(TaskPool& pool, const PairData& data, const GradientCache& cache, std::span<const Float4> wall,
                  std::span<const Float4> velocity, bool moving_walls, std::span<float> rate) {
  pool.for_each_range(data.fluid->groups.size(), kGroupsPerBlock, [&](std::size_t first, std::size_t last) {
    HWY_DYNAMIC_DISPATCH(rate_groups)
    (data, first, last, cache.words.data(), wall.data(), velocity.data(), moving_walls, rate.data());
  });
}

void compute_acceleration(TaskPool& pool, const PairData& data, std::span<const Float4> velocity, float viscosity,
                          float gravity, std::span<Float4> acceleration) {
  pool.for_each_range(data.fluid->groups.size(), kGroupsPerBlock, [&](std::size_t first, std::size_t last) {
    HWY_DYNAMIC_DISPATCH(acceleration_groups)
    (data, first, last, velocity.data(), viscosity, gravity, acceleration.data());
  });
}

}  // namespace pelagos
#endif  // HWY_ONCE
