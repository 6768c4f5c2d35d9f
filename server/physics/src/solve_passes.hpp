#pragma once

#include <cstddef>
#include <cstdint>

#include "physics/particles.hpp"

namespace pelagos {

// Pointwise parts of the constraint solve over a range of particles, vectorised for the machine at run time.

struct SolveArrays {
  const float* alpha;
  const float* source;
  float* pressure;       ///< p
  float* residual;       ///< r = b - A p
  float* direction;      ///< s: the last move, per unit step
  float* image;          ///< q = A s
  Float4* displacement;  ///< u = -J' p
  const Float4* trial;   ///< w = -J' s
};

/// Sums of one range: what the scalar part of the iteration needs.
struct SolveSums {
  float error = 0;        ///< sum of p > 0 ? |r| : max(r, 0)
  float z_image = 0;      ///< <z, q>
  float r_direction = 0;  ///< <r, s>
  float s_image = 0;      ///< <s, q>
  float longest = 3e38F;  ///< min over s < 0 of p / -s
};

/// r = b + rate (rate = J u of the warm start; null when cold).
void start_residual(std::size_t begin, std::size_t end, const SolveArrays& a, const float* rate);
/// Error and <z, q> of the present point.
SolveSums judge(std::size_t begin, std::size_t end, const SolveArrays& a);
/// s = max(-p, step (z + beta s)) on the free particles; <r, s> and the longest admissible step.
SolveSums make_direction(std::size_t begin, std::size_t end, const SolveArrays& a, float beta, float step);
/// q = -rate; <s, q>.
SolveSums set_image(std::size_t begin, std::size_t end, const SolveArrays& a, const float* rate);
/// p, u, r moved by t; s and q brought back to unit step; error and <z, q> of the new point.
SolveSums move(std::size_t begin, std::size_t end, const SolveArrays& a, float t, float inverse_step);

/// Sums that describe the state after a step.
struct StateSums {
  float speed_squared = 0;          ///< sum |v|^2, weighed by mass / mass of a water particle
  float height = 0;                 ///< sum z, weighed likewise
  float largest_speed_squared = 0;  ///< max |v + dt a|^2 of the finite particles
  float compression = 0;            ///< sum max(delta - 1, 0)
  float largest_density = 0;
  std::uint32_t outside = 0;
  std::uint32_t not_finite = 0;
};
struct StateArrays {
  const Float4* position;
  const Float4* velocity;
  const Float4* acceleration;
  const float* density;
  float min[3], max[3];                 ///< m, the patch
  const std::uint8_t* phase = nullptr;  ///< null: all particles have the same mass
  float oil_mass = 1;                   ///< of an oil particle, over that of a water particle
};
StateSums measure_state(std::size_t begin, std::size_t end, const StateArrays& a, float dt);

/// to += factor * from, in x, y and z.
void add_scaled(std::size_t begin, std::size_t end, float factor, const Float4* from, Float4* to);
/// x += u and v += u / dt with |u| bounded; either target may be null. Returns how many were bounded.
std::uint32_t apply_displacement(std::size_t begin, std::size_t end, float bound, float inverse_dt,
                                 const Float4* displacement, Float4* position, Float4* velocity);

}  // namespace pelagos
