#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "fluid_stages.hpp"
#include "physics/fluid.hpp"
#include "solid_fields.hpp"
#include "solid_planes.hpp"

namespace pelagos::test {
namespace {

constexpr double kD = 0.05, kH = 2.0 * kD;

FluidParameters parameters(double floor) {
  FluidParameters q;
  q.spacing = kD, q.support_radius = kH, q.viscosity = 0.0, q.scheme = Scheme::kCorrected;
  q.density.tolerance = q.divergence.tolerance = 3e-4;
  q.patch = Region{{0, 0, static_cast<float>(floor)}, {0.6F, 0.6F, 1.0F}};
  q.edges = {Edge::kPeriodic, Edge::kPeriodic, Edge::kMirror};
  return q;
}

/// A block of 12 x 12 x 8 particles on z = 0, jittered.
std::vector<Float4> block(double jitter) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-jitter * kD, jitter * kD);
  std::vector<Float4> points;
  for (int k = 0; k < 8; ++k)
    for (int j = 0; j < 12; ++j)
      for (int i = 0; i < 12; ++i)
        points.push_back({static_cast<float>((i + 0.5) * kD + shift(random)),
                          static_cast<float>((j + 0.5) * kD + shift(random)),
                          static_cast<float>((k + 0.5) * kD + shift(random)), 0});
  return points;
}

std::vector<Float4> random_vectors(std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> value;
  std::vector<Float4> vectors(padded_count(count));
  for (std::size_t i = 0; i < count; ++i) vectors[i] = {value(random), value(random), value(random), 0};
  return vectors;
}

/// Lists, corrections and gradients of the present positions.
void prepare(TaskPool& pool, FluidState& state) {
  StepReport report;
  refresh_neighbors(pool, state, report);
  compute_corrections(pool, pair_data(state), state.particles.density, state.gradients, state.corrections);
  compute_corrected_gradients(pool, pair_data(state), state.corrections, state.gradients);
  meet_bodies(pool, state);
}

FluidState on_mirror(TaskPool& pool, double jitter = 0.2) { return make_fluid(pool, parameters(0.0), block(jitter)); }
FluidState on_solid(TaskPool& pool, double jitter = 0.2) {
  FluidState state = make_fluid(pool, parameters(-0.5), block(jitter));
  state.solids.push_back({floor_field(Region{{-0.3F, -0.3F, -0.2F}, {0.9F, 0.9F, 0.2F}}, 0.5 * kD, 0.0)});
  return state;
}

/// <p, J v> and <J'p, v> with the bodies' part, and momentum.
struct Adjoint {
  double rate = 0, push = 0, momentum[3] = {0, 0, 0}, scale = 0;
};
Adjoint adjoint(TaskPool& pool, FluidState& state) {
  const PairData data = pair_data(state);
  const std::size_t count = state.particles.count;
  FluidParticles& p = state.particles;
  const std::vector<Float4> v = random_vectors(count, 3);
  std::copy(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(count), p.velocity.begin());
  extend_velocities(pool, state);
  std::vector<float> rate(padded_count(count)), pressure(extended_count(count, state.ghosts), 0.0F);
  std::mt19937 random(11);
  std::normal_distribution<float> value;
  for (std::size_t i = 0; i < count; ++i) pressure[i] = value(random);
  if (!state.ghosts.empty()) extend_scalars(pool, state.ghosts, pressure);
  compute_rate(pool, data, state.gradients, p.velocity, false, rate);
  std::vector<Float4> push(padded_count(count));
  apply_pressure(pool, data, state.gradients, pressure, push);
  Adjoint sums;
  for (std::size_t i = 0; i < count; ++i) {
    const Float4 &u = push[i], &w = state.gradients.wall[i], &x = v[i];
    sums.rate += static_cast<double>(pressure[i] * rate[i]);
    sums.scale += std::abs(static_cast<double>(pressure[i] * rate[i]));
    sums.push += static_cast<double>(u.x * x.x + u.y * x.y + u.z * x.z);
    sums.momentum[0] += static_cast<double>(u.x + pressure[i] * w.x);
    sums.momentum[1] += static_cast<double>(u.y + pressure[i] * w.y);
    sums.momentum[2] += static_cast<double>(u.z + pressure[i] * w.z);
  }
  return sums;
}

/// Water around a ball in a periodic box.
FluidState around_ball(TaskPool& pool, double radius, std::int32_t body = -1) {
  FluidParameters q = parameters(0.0);
  q.edges = {Edge::kPeriodic, Edge::kPeriodic, Edge::kPeriodic};
  q.patch = Region{{0, 0, 0}, {0.6F, 0.6F, 0.6F}};
  std::vector<Float4> points;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> shift(-0.15 * kD, 0.15 * kD);
  for (int k = 0; k < 12; ++k)
    for (int j = 0; j < 12; ++j)
      for (int i = 0; i < 12; ++i) {
        const double x = (i + 0.5) * kD, y = (j + 0.5) * kD, z = (k + 0.5) * kD;
        if (std::hypot(x - 0.3, y - 0.3, z - 0.3) < radius + 0.3 * kD) continue;
        points.push_back({static_cast<float>(x + shift(random)), static_cast<float>(y + shift(random)),
                          static_cast<float>(z + shift(random)), 0});
      }
  FluidState state = make_fluid(pool, q, points);
  state.solids.push_back(
      {ball_field(radius, 1.3 * kH, 0.25 * kD), Eigen::Matrix3f::Identity(), Eigen::Vector3f::Constant(0.3F), body});
  return state;
}

TEST(Solids, FlatFloorIsAMirror) {
  TaskPool pool(2);
  FluidState mirror = on_mirror(pool), solid = on_solid(pool);
  prepare(pool, mirror);
  prepare(pool, solid);
  const std::size_t count = mirror.particles.count;
  std::vector<std::size_t> of_id(count);
  for (std::size_t i = 0; i < count; ++i) of_id[solid.particles.id[i]] = i;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t k = of_id[mirror.particles.id[i]];
    ASSERT_NEAR(mirror.particles.density[i], solid.particles.density[k], 1e-5) << i;
    ASSERT_NEAR(mirror.gradients.sum[i].z * kD, solid.gradients.sum[k].z * kD, 3e-3) << i;
    ASSERT_NEAR(mirror.gradients.sum[i].x * kD, solid.gradients.sum[k].x * kD, 3e-3) << i;
    ASSERT_NEAR(mirror.corrections.first[i].x, solid.corrections.first[k].x, 1e-3) << i;
    ASSERT_NEAR(mirror.corrections.second[i].y, solid.corrections.second[k].y, 1e-3) << i;
  }
}

TEST(Solids, WaterOnAFlatFloorMovesAsOnAMirror) {
  TaskPool pool(2);
  FluidState mirror = on_mirror(pool, 0.05), solid = on_solid(pool, 0.05);
  for (int step = 0; step < 5; ++step)
    for (FluidState* state : {&mirror, &solid}) {
      StepReport report;
      advance_fluid(pool, *state, 0.004, nullptr, report);
      start_acceleration(pool, *state, report);
    }
  std::vector<std::size_t> of_id(mirror.particles.count);
  for (std::size_t i = 0; i < of_id.size(); ++i) of_id[solid.particles.id[i]] = i;
  for (std::size_t i = 0; i < of_id.size(); ++i) {
    const std::size_t k = of_id[mirror.particles.id[i]];
    // Tolerances of the solves, 3e-4 of a spacing, and half-precision gradients.
    ASSERT_NEAR(mirror.particles.position[i].z, solid.particles.position[k].z, 2e-3 * kD) << i;
    ASSERT_NEAR(mirror.particles.position[i].x, solid.particles.position[k].x, 2e-3 * kD) << i;
  }
}

TEST(Solids, PressureIsTheAdjointOfTheRateAtCurvedSurfaces) {
  TaskPool pool(2);
  FluidState state = around_ball(pool, 0.13);
  prepare(pool, state);
  const Adjoint sums = adjoint(pool, state);
  EXPECT_NEAR(sums.rate, -sums.push, 2e-4 * sums.scale);
  for (const double momentum : sums.momentum) EXPECT_NEAR(momentum, 0.0, 2e-4 * sums.scale);
}

TEST(Solids, PlainRateIsThatOfTheDensity) {
  TaskPool pool(1);
  FluidState state = around_ball(pool, 0.13);
  StepReport report;
  refresh_neighbors(pool, state, report);
  FluidParticles& p = state.particles;
  const std::vector<Float4> v = random_vectors(p.count, 17);
  for (std::size_t i = 0; i < p.count; ++i) p.velocity[i] = v[i];
  extend_velocities(pool, state);
  std::vector<float> rate(padded_count(p.count)), before = p.density;
  compute_rate(pool, pair_data(state), state.gradients, p.velocity, false, rate);
  constexpr float kDt = 2e-5F;
  for (std::size_t i = 0; i < p.count; ++i)
    p.position[i] = {p.position[i].x + kDt * v[i].x, p.position[i].y + kDt * v[i].y, p.position[i].z + kDt * v[i].z, 0};
  extend_positions(pool, state);
  refresh_density(pool, state, report);
  double error = 0, scale = 0;
  for (std::size_t i = 0; i < p.count; ++i) {
    error += std::abs(static_cast<double>((p.density[i] - before[i]) / kDt - rate[i]));
    scale += std::abs(static_cast<double>(rate[i]));
  }
  EXPECT_LT(error, 0.01 * scale);
}

TEST(Solids, ABodyTakesWhatTheWaterGives) {
  TaskPool pool(2);
  FluidState state = around_ball(pool, 0.13, 0);
  CoupledBody body;
  body.centre = Eigen::Vector3d::Constant(0.3);
  state.coupling.bodies.push_back(body);
  for (std::size_t i = 0; i < state.particles.count; ++i) state.particles.velocity[i] = {0.3F, 0, 0, 0};
  double before = 0, after = 0;
  for (std::size_t i = 0; i < state.particles.count; ++i) before += static_cast<double>(state.particles.velocity[i].x);
  state.parameters.gravity = 0.0;
  std::fill(state.particles.acceleration.begin(), state.particles.acceleration.end(), Float4{});
  state.parameters.filter = 0.0;
  StepReport report;
  advance_fluid(pool, state, 0.004, nullptr, report);
  for (std::size_t i = 0; i < state.particles.count; ++i) after += static_cast<double>(state.particles.velocity[i].x);
  const double mass = 1000.0 * kD * kD * kD, lost = mass * (before - after);
  EXPECT_GT(lost, 0.01);
  EXPECT_NEAR(state.coupling.bodies[0].impulse.x(), lost, 1e-3 * lost);
}

TEST(Solids, ParticlesInsideAreReflectedAndTheBodyTakesTheImpulse) {
  TaskPool pool(1);
  FluidState state = around_ball(pool, 0.13, 0);
  CoupledBody body;
  body.centre = Eigen::Vector3d::Constant(0.3);
  body.inverse_mass = Eigen::Vector3d::Constant(0.1);
  state.coupling.bodies.push_back(body);
  state.particles.position[4] = {0.42F, 0.3F, 0.3F, 0};  // 1 cm inside
  state.particles.velocity[4] = {-2.0F, 1.0F, 0, 0};
  push_out_of_solids(pool, state);
  EXPECT_NEAR(state.particles.position[4].x, 0.44, 5e-4);
  EXPECT_NEAR(state.particles.velocity[4].x, 2.0, 1e-3);
  EXPECT_NEAR(state.particles.velocity[4].y, 1.0, 1e-3);
  const double mass = 1000.0 * kD * kD * kD;
  EXPECT_NEAR(state.coupling.bodies[0].impulse.x(), -4.0 * mass, 1e-3);
  EXPECT_NEAR(state.coupling.bodies[0].velocity.x(), -0.4 * mass, 1e-4);
}

TEST(Solids, StepsHaveTheSameBitsForAnyNumberOfThreads) {
  std::uint64_t hash = 0;
  for (const int threads : {1, 2, 7}) {
    TaskPool pool(threads);
    FluidState state = around_ball(pool, 0.13);
    StepReport report;
    for (int step = 0; step < 4; ++step) {
      advance_fluid(pool, state, 0.004, nullptr, report);
      start_acceleration(pool, state, report);
    }
    if (hash == 0) hash = state_hash(state.particles);
    EXPECT_EQ(state_hash(state.particles), hash) << threads;
  }
}

}  // namespace
}  // namespace pelagos::test
