#include "solve_passes.hpp"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solve_passes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// Plain loops: the compiler vectorises them for each instruction set (with `omp simd`, reductions included).

HWY_BEFORE_NAMESPACE();
namespace pelagos {
namespace HWY_NAMESPACE {

void start_residual_impl(std::size_t begin, std::size_t end, const SolveArrays& a, const float* rate) {
  if (rate) {
#pragma omp simd
    for (std::size_t i = begin; i < end; ++i) a.residual[i] = a.source[i] + rate[i];
  } else {
#pragma omp simd
    for (std::size_t i = begin; i < end; ++i) a.residual[i] = a.source[i];
  }
}

SolveSums judge_impl(std::size_t begin, std::size_t end, const SolveArrays& a) {
  float error = 0, z_image = 0;
  const float *p = a.pressure, *r = a.residual, *alpha = a.alpha, *q = a.image;
#pragma omp simd reduction(+ : error, z_image)
  for (std::size_t i = begin; i < end; ++i) {
    const bool pressed = p[i] > 0.0F;
    const float positive = r[i] > 0.0F ? r[i] : 0.0F;
    error += alpha[i] > 0.0F ? (pressed ? std::fabs(r[i]) : positive) : 0.0F;
    const float z = pressed ? alpha[i] * r[i] : alpha[i] * positive;
    z_image += z * q[i];
  }
  SolveSums sums;
  sums.error = error;
  sums.z_image = z_image;
  return sums;
}

SolveSums make_direction_impl(std::size_t begin, std::size_t end, const SolveArrays& a, float beta, float step) {
  float r_direction = 0, longest = 3e38F;
  const float *p = a.pressure, *r = a.residual, *alpha = a.alpha;
  float* s = a.direction;
#pragma omp simd reduction(+ : r_direction) reduction(min : longest)
  for (std::size_t i = begin; i < end; ++i) {
    const float wanted = step * (alpha[i] * r[i] + beta * s[i]);
    const float lower = -p[i];
    float move = p[i] > 0.0F ? wanted : (r[i] > 0.0F ? wanted : 0.0F);
    move = move > lower ? move : lower;
    s[i] = move;
    r_direction += r[i] * move;
    const float reach = move < 0.0F ? p[i] / -move : 3e38F;
    longest = longest < reach ? longest : reach;
  }
  SolveSums sums;
  sums.r_direction = r_direction;
  sums.longest = longest;
  return sums;
}

SolveSums set_image_impl(std::size_t begin, std::size_t end, const SolveArrays& a, const float* rate) {
  float s_image = 0;
  const float* s = a.direction;
  float* q = a.image;
#pragma omp simd reduction(+ : s_image)
  for (std::size_t i = begin; i < end; ++i) {
    q[i] = -rate[i];
    s_image += s[i] * q[i];
  }
  SolveSums sums;
  sums.s_image = s_image;
  return sums;
}

SolveSums move_impl(std::size_t begin, std::size_t end, const SolveArrays& a, float t, float inverse_step) {
  float *p = a.pressure, *r = a.residual, *s = a.direction, *q = a.image;
#pragma omp simd
  for (std::size_t i = begin; i < end; ++i) {
    const float moved = p[i] + t * s[i];
    p[i] = moved > 0.0F ? moved : 0.0F;
    r[i] -= t * q[i];
    s[i] *= inverse_step;
    q[i] *= inverse_step;
  }
  const float* w = &a.trial->x;
  float* u = &a.displacement->x;
#pragma omp simd
  for (std::size_t k = 4 * begin; k < 4 * end; ++k) u[k] += t * w[k];
  return judge_impl(begin, end, a);
}

template <bool kPhases>
StateSums measure_state_with(std::size_t begin, std::size_t end, const StateArrays& a, float dt) {
  float speed = 0, height = 0, compression = 0, largest_speed = 0, largest_density = 0;
  std::uint32_t outside = 0, not_finite = 0;
  const float x0 = a.min[0], y0 = a.min[1], z0 = a.min[2], x1 = a.max[0], y1 = a.max[1], z1 = a.max[2];
#pragma omp simd reduction(+ : speed, height, compression, outside, not_finite) reduction(max : largest_speed, largest_density)
  for (std::size_t i = begin; i < end; ++i) {
    const Float4 x = a.position[i], v = a.velocity[i], b = a.acceleration[i];
    const float v2 = v.x * v.x + v.y * v.y + v.z * v.z;
    const float nx = v.x + dt * b.x, ny = v.y + dt * b.y, nz = v.z + dt * b.z;
    const float next2 = nx * nx + ny * ny + nz * nz;
    if constexpr (kPhases) {
      const float mass = a.phase[i] == kOilPhase ? a.oil_mass : 1.0F;
      speed += mass * v2;
      height += mass * x.z;
    } else {
      speed += v2;
      height += x.z;
    }
    const float excess = a.density[i] - 1.0F;
    compression += excess > 0.0F ? excess : 0.0F;
    largest_density = a.density[i] > largest_density ? a.density[i] : largest_density;
    // Written so that NaN counts as outside and not finite.
    const bool inside = (x.x >= x0) & (x.x <= x1) & (x.y >= y0) & (x.y <= y1) & (x.z >= z0) & (x.z <= z1);
    const bool finite = (next2 < 1e30F) & (x.x * x.x + x.y * x.y + x.z * x.z < 1e30F) & (a.density[i] < 1e30F);
    // A runaway must not bring the next step's size to zero: it is reported, and left out of the speed.
    largest_speed = finite & (next2 > largest_speed) ? next2 : largest_speed;
    outside += inside ? 0U : 1U;
    not_finite += finite ? 0U : 1U;
  }
  return {speed, height, largest_speed, compression, largest_density, outside, not_finite};
}

StateSums measure_state_impl(std::size_t begin, std::size_t end, const StateArrays& a, float dt) {
  return a.phase ? measure_state_with<true>(begin, end, a, dt) : measure_state_with<false>(begin, end, a, dt);
}

void add_scaled_impl(std::size_t begin, std::size_t end, float factor, const Float4* from, Float4* to) {
  const float* a = &from->x;
  float* b = &to->x;
#pragma omp simd
  for (std::size_t k = 4 * begin; k < 4 * end; ++k) b[k] += factor * a[k];
}

std::uint32_t apply_displacement_impl(std::size_t begin, std::size_t end, float bound, float inverse_dt,
                                      const Float4* displacement, Float4* position, Float4* velocity) {
  std::uint32_t bounded = 0;
  for (std::size_t i = begin; i < end; ++i) {
    Float4 u = displacement[i];
    const float length_squared = u.x * u.x + u.y * u.y + u.z * u.z;
    if (length_squared > bound * bound) {
      const float factor = bound / std::sqrt(length_squared);
      u = {u.x * factor, u.y * factor, u.z * factor, 0.0F};
      ++bounded;
    }
    if (position) {
      position[i].x += u.x;
      position[i].y += u.y;
      position[i].z += u.z;
    }
    if (velocity) {
      velocity[i].x += u.x * inverse_dt;
      velocity[i].y += u.y * inverse_dt;
      velocity[i].z += u.z * inverse_dt;
    }
  }
  return bounded;
}

}  // namespace HWY_NAMESPACE
}  // namespace pelagos
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pelagos {

HWY_EXPORT(start_residual_impl);
HWY_EXPORT(judge_impl);
HWY_EXPORT(make_direction_impl);
HWY_EXPORT(set_image_impl);
HWY_EXPORT(move_impl);
HWY_EXPORT(measure_state_impl);
HWY_EXPORT(add_scaled_impl);
HWY_EXPORT(apply_displacement_impl);

void start_residual(std::size_t begin, std::size_t end, const SolveArrays& a, const float* rate) {
  HWY_DYNAMIC_DISPATCH(start_residual_impl)(begin, end, a, rate);
}
SolveSums judge(std::size_t begin, std::size_t end, const SolveArrays& a) {
  return HWY_DYNAMIC_DISPATCH(judge_impl)(begin, end, a);
}
SolveSums make_direction(std::size_t begin, std::size_t end, const SolveArrays& a, float beta, float step) {
  return HWY_DYNAMIC_DISPATCH(make_direction_impl)(begin, end, a, beta, step);
}
SolveSums set_image(std::size_t begin, std::size_t end, const SolveArrays& a, const float* rate) {
  return HWY_DYNAMIC_DISPATCH(set_image_impl)(begin, end, a, rate);
}
SolveSums move(std::size_t begin, std::size_t end, const SolveArrays& a, float t, float inverse_step) {
  return HWY_DYNAMIC_DISPATCH(move_impl)(begin, end, a, t, inverse_step);
}
StateSums measure_state(std::size_t begin, std::size_t end, const StateArrays& a, float dt) {
  return HWY_DYNAMIC_DISPATCH(measure_state_impl)(begin, end, a, dt);
}
void add_scaled(std::size_t begin, std::size_t end, float factor, const Float4* from, Float4* to) {
  HWY_DYNAMIC_DISPATCH(add_scaled_impl)(begin, end, factor, from, to);
}
std::uint32_t apply_displacement(std::size_t begin, std::size_t end, float bound, float inverse_dt,
                                 const Float4* displacement, Float4* position, Float4* velocity) {
  return HWY_DYNAMIC_DISPATCH(apply_displacement_impl)(begin, end, bound, inverse_dt, displacement, position, velocity);
}

}  // namespace pelagos
#endif  // HWY_ONCE
