#include "physics/pair_passes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "viscosity_passes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "group_blocks.hpp"
#include "pair_kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace pelagos {
namespace HWY_NAMESPACE {

void acceleration_groups(const PairData& data, std::size_t first_group, std::size_t last_group, const Float4* velocity,
                         float viscosity, float gravity, Float4* acceleration, float* delta) {
  const FloatTag d;
  const KernelScales scales = kernel_scales(data);
  const float squared = data.support_radius * data.support_radius;
  const FloatV scale = hn::Mul(hn::Set(d, viscosity * 10.0F / data.spacing), scales.gradient_spacing);
  const FloatV softening = hn::Set(d, 1e-6F * squared);  // only against 0/0
  for (std::size_t group = first_group; group < last_group; ++group)
    for_each_part(group, [&](std::size_t lane, std::size_t i) HWY_ATTR {
      const Vec4 own = load_records(data.position + i), own_velocity = load_records(velocity + i);
      FloatV weight = hn::Zero(d);
      Vec3 sum = zero3();
      const NeighborList::SlotRange fluid = data.fluid->groups[group];
      for (std::uint32_t s = fluid.begin; s < fluid.end; ++s) {
        const std::int32_t* index = data.fluid->slots.data() + s * kLanes + lane;
        const PairGeometry pair = difference(own, gather_records(data.position, index));
        const PairGeometry change = difference(own_velocity, gather_records(velocity, index));
        const FloatV approach = dot({change.x, change.y, change.z}, {pair.x, pair.y, pair.z}, hn::Zero(d));
        const KernelPair kernel = cubic_spline(pair.r_squared, scales.support, scales.inverse_support);
        weight = hn::Add(weight, kernel.value);
        const FloatV factor = hn::Div(hn::Mul(kernel.gradient_factor, approach), hn::Add(pair.r_squared, softening));
        add_to(sum, scaled(pair, factor));
      }
      store_records(
          {hn::Mul(sum.x, scale), hn::Mul(sum.y, scale), hn::MulAdd(sum.z, scale, hn::Set(d, -gravity)), hn::Zero(d)},
          acceleration + i);
      if (delta)
        hn::StoreU(hn::MulAdd(weight, scales.value, wall_density(data, scales, own, group, lane)), d, delta + i);
    });
}

/// nu_ij for a vector of particles: that of its own phase, and that between the phases.
struct PairViscosity {
  FloatV own, mixed;
};

void phase_acceleration_groups(const PairData& data, std::size_t first_group, std::size_t last_group,
                               const Float4* velocity, float gravity, Float4* acceleration, float* delta) {
  const FloatTag d;
  const PhasePair& phases = *data.phases;
  const KernelScales scales = kernel_scales(data);
  const FloatV scale = hn::Mul(hn::Set(d, 10.0F / data.spacing), scales.gradient_spacing);
  const FloatV softening = hn::Set(d, 1e-6F * data.support_radius * data.support_radius);  // only against 0/0
  const FloatV zero = hn::Zero(d), down = hn::Set(d, -gravity);
  for (std::size_t group = first_group; group < last_group; ++group)
    for_each_part(group, [&](std::size_t lane, std::size_t i) HWY_ATTR {
      const Vec4 own = load_records(data.position + i);
      const PairViscosity nu{choose_phase(is_light(own.w), phases.light_viscosity, phases.heavy_viscosity),
                             hn::Set(d, phases.mixed_viscosity)};
      if (!delta && hn::AllTrue(d, hn::Eq(nu.own, zero))) {  // then the mixed one is zero, too
        store_records({zero, zero, down, zero}, acceleration + i);
        return;
      }
      const Vec4 own_velocity = load_records(velocity + i);
      FloatV weight = zero;
      Vec3 sum = zero3();
      const NeighborList::SlotRange fluid = data.fluid->groups[group];
      for (std::uint32_t s = fluid.begin; s < fluid.end; ++s) {
        const std::int32_t* index = data.fluid->slots.data() + s * kLanes + lane;
        const Vec4 place = gather_records(data.position, index);
        const PairGeometry pair = difference(own, place);
        const PairGeometry change = difference(own_velocity, gather_records(velocity, index));
        const FloatV approach = dot({change.x, change.y, change.z}, {pair.x, pair.y, pair.z}, zero);
        const KernelPair kernel = cubic_spline(pair.r_squared, scales.support, scales.inverse_support);
        weight = hn::Add(weight, kernel.value);
        const FloatV viscosity = hn::IfThenElse(hn::Eq(own.w, place.w), nu.own, nu.mixed);
        const FloatV factor =
            hn::Div(hn::Mul(hn::Mul(kernel.gradient_factor, approach), viscosity), hn::Add(pair.r_squared, softening));
        add_to(sum, scaled(pair, factor));
      }
      const FloatV push = hn::Mul(scale, hn::LoadU(d, phases.mobility.data() + i));
      store_records({hn::Mul(sum.x, push), hn::Mul(sum.y, push), hn::MulAdd(sum.z, push, down), zero},
                    acceleration + i);
      if (delta)
        hn::StoreU(hn::MulAdd(weight, scales.value, wall_density(data, scales, own, group, lane)), d, delta + i);
    });
}

}  // namespace HWY_NAMESPACE
}  // namespace pelagos
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pelagos {

HWY_EXPORT(acceleration_groups);
HWY_EXPORT(phase_acceleration_groups);

void compute_acceleration(TaskPool& pool, const PairData& data, std::span<const Float4> velocity, float viscosity,
                          float gravity, std::span<Float4> acceleration, std::span<float> delta) {
  for_each_group(pool, data, [&](std::size_t first, std::size_t last) {
    HWY_DYNAMIC_DISPATCH(acceleration_groups)
    (data, first, last, velocity.data(), viscosity, gravity, acceleration.data(), delta.data());
  });
}

void compute_phase_acceleration(TaskPool& pool, const PairData& data, std::span<const Float4> velocity, float gravity,
                                std::span<Float4> acceleration, std::span<float> delta) {
  for_each_group(pool, data, [&](std::size_t first, std::size_t last) {
    HWY_DYNAMIC_DISPATCH(phase_acceleration_groups)
    (data, first, last, velocity.data(), gravity, acceleration.data(), delta.data());
  });
}

}  // namespace pelagos
#endif  // HWY_ONCE
