#include "moving_walls.hpp"

#include <algorithm>
#include <cmath>

#include "physics/boundary.hpp"

namespace pelagos::hard {

namespace {

constexpr double kSpacing = 0.05;

/// Sides and floor of a box about the axis x = y = 0, floor at z = 0.
std::vector<Float4> bucket_samples(TaskPool& pool, double half, double height) {
  const auto side = static_cast<float>(half);
  std::vector<Float4> samples = sample_box({{-side, -side, 0}, {side, side, static_cast<float>(height)}}, kSpacing);
  assign_boundary_volumes(pool, 2.0 * kSpacing, samples);
  std::erase_if(samples, [&](const Float4& p) {
    const bool on_side = std::abs(p.x) > side - 1e-4F || std::abs(p.y) > side - 1e-4F;
    return p.z > static_cast<float>(height) - 1e-4F && !on_side;
  });
  return samples;
}

void place_bucket(FluidState& state, const std::vector<Float4>& samples, double center, double floor, double angle,
                  double speed) {
  const double c = std::cos(angle), s = std::sin(angle);
  state.moving_position.resize(samples.size());
  state.moving_velocity.resize(samples.size());
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double x = static_cast<double>(samples[k].x), y = static_cast<double>(samples[k].y);
    const double rx = c * x - s * y, ry = s * x + c * y;
    state.moving_position[k] = {static_cast<float>(center + rx), static_cast<float>(center + ry),
                                samples[k].z + static_cast<float>(floor), samples[k].w};
    state.moving_velocity[k] = {static_cast<float>(-speed * ry), static_cast<float>(speed * rx), 0, 0};
  }
}

}  // namespace

WallOutcome rotate_bucket(const std::string& solver, double speed, int turns_percent) {
  const double half = 6 * kSpacing, height = 20 * kSpacing, center = 0.6, floor = 0.1;
  HardWater water(tank_with(solver, {2 * center, 2 * center, 1.4}, kSpacing),
                  block({11, 11, 8}, kSpacing, {center - 5 * kSpacing, center - 5 * kSpacing, floor + kSpacing}));
  const std::vector<Float4> samples = bucket_samples(water.pool(), half, height);
  place_bucket(water.state(), samples, center, floor, 0.0, 0.0);
  water.settle(60);
  WallOutcome out;
  const double end = 0.01 * turns_percent * 2.0 * M_PI / speed, dt = 0.07 * water.step_unit();
  double angle = 0.0;
  for (double time = 0.0; time < end; time += dt) {
    const double now = speed * std::min(1.0, time / 0.25);  // up to speed within a quarter of a second
    angle += now * dt;
    place_bucket(water.state(), samples, center, floor, angle, now);
    if (water.step(dt).not_finite > 0) break;
    std::size_t leaked = 0;
    const FluidParticles& p = water.state().particles;
    for (std::size_t i = 0; i < p.count; ++i) {
      const double x = static_cast<double>(p.position[i].x) - center, y = static_cast<double>(p.position[i].y) - center;
      const double bx = std::cos(angle) * x + std::sin(angle) * y, by = -std::sin(angle) * x + std::cos(angle) * y;
      const bool beside = std::max(std::abs(bx), std::abs(by)) > half,
                 below = static_cast<double>(p.position[i].z) < floor;
      leaked += beside || below ? 1 : 0;
    }
    out.leaked = std::max(out.leaked, leaked);
  }
  out.water = water.outcome();
  double momentum = 0.0, inertia = 0.0;
  const FluidParticles& p = water.state().particles;
  for (std::size_t i = 0; i < p.count; ++i) {
    const double x = static_cast<double>(p.position[i].x) - center, y = static_cast<double>(p.position[i].y) - center;
    momentum += x * static_cast<double>(p.velocity[i].y) - y * static_cast<double>(p.velocity[i].x);
    inertia += x * x + y * y;
  }
  out.angular_speed = momentum / inertia;
  return out;
}

WallOutcome push_piston(const std::string& solver, double reach, PistonSteps steps) {
  FluidParameters p = tank_with(solver, {2.0, 0.4, 3.0}, kSpacing);
  p.edges[1] = Edge::kPeriodic;
  HardWater water(p, block({37, 8, 6}, kSpacing, {2 * kSpacing, 0.5 * kSpacing, kSpacing}));
  const double longest = 0.07 * water.step_unit(), speed = reach * kSpacing / longest;
  // The wall goes on beyond the periodic faces for one support radius, as the floor does.
  std::vector<Float4> wall = block({1, 17, 61}, kSpacing, {0, -4 * kSpacing, 0});
  assign_boundary_volumes(water.pool(), p.support_radius, wall);
  std::erase_if(wall, [](const Float4& q) { return q.y < -0.101F || q.y > 0.501F; });
  const auto place = [&](double x, double u) {
    FluidState& state = water.state();
    state.moving_position = wall;
    for (Float4& q : state.moving_position) q.x = static_cast<float>(x);
    state.moving_velocity.assign(wall.size(), {static_cast<float>(u), 0, 0, 0});
  };
  double x = kSpacing;
  place(x, 0.0);
  water.settle(60);
  WallOutcome out;
  while (x < 0.8) {  // over half a metre and more: a third of the water's length
    double dt = longest;
    if (steps == PistonSteps::kAdaptive)
      dt = std::max(0.1 * longest, admissible_time_step(p, 0.4, longest, std::max(speed, water.speed())));
    x += speed * dt;
    place(x, speed);
    if (water.step(dt).not_finite > 0) break;
    std::size_t leaked = 0;
    const FluidParticles& particles = water.state().particles;
    for (std::size_t i = 0; i < particles.count; ++i)
      leaked += static_cast<double>(particles.position[i].x) < x ? 1 : 0;
    out.leaked = std::max(out.leaked, leaked);
  }
  out.water = water.outcome();
  return out;
}

}  // namespace pelagos::hard
