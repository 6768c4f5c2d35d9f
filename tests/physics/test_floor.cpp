// A floor that bends and moves, and water that moves as it is given.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "physics/water_step.hpp"

namespace pelagos::test {
namespace {

constexpr float kD = 1.0F;

/// z = 0.3 + 0.1 x - 0.05 y + 0.01 x^2 - 0.02 x y + 0.004 y^2, rising with 0.25 m/s.
Float4 bowl(float x, float y) {
  return {0.3F + 0.1F * x - 0.05F * y + 0.01F * x * x - 0.02F * x * y + 0.004F * y * y, 0.1F + 0.02F * x - 0.02F * y,
          -0.05F - 0.02F * x + 0.008F * y, 0.25F};
}

Floor floor_of(Float4 (*surface)(float, float)) {
  Floor floor;
  floor.x = -4.0F, floor.y = -6.0F, floor.cell = 2.0F, floor.columns = 10, floor.rows = 12;
  for (int j = 0; j < floor.rows; ++j)
    for (int i = 0; i < floor.columns; ++i)
      floor.nodes.push_back(
          surface(floor.x + floor.cell * static_cast<float>(i), floor.y + floor.cell * static_cast<float>(j)));
  return floor;
}

Float4 flat(float, float) { return {}; }

TEST(Floor, IsExactWhereItIsQuadratic) {
  const Floor floor = floor_of(bowl);
  for (float x = -3.9F; x < 13.0F; x += 0.7F)
    for (float y = -5.9F; y < 15.0F; y += 0.9F) {
      const Float4 want = bowl(x, y), got = floor.at(x, y);
      EXPECT_NEAR(got.x, want.x, 2e-5F) << x << ", " << y;
      EXPECT_NEAR(got.y, want.y, 5e-6F);
      EXPECT_NEAR(got.z, want.z, 5e-6F);
      EXPECT_NEAR(got.w, want.w, 1e-6F);
    }
}

TEST(Floor, EndsAsAtItsRim) {
  const Floor floor = floor_of(bowl);
  EXPECT_EQ(floor.at(-100.0F, 3.0F).x, floor.at(-4.0F, 3.0F).x);
  EXPECT_EQ(floor.at(2.0F, 1e6F).x, floor.at(2.0F, 16.0F).x);
}

/// Waves of 10 and 14 m, 1.2 and 0.8 m high.
Float4 hilly(float x, float y) {
  const float a = 0.2F * static_cast<float>(M_PI), b = static_cast<float>(M_PI) / 7.0F;
  return {0.6F * std::sin(a * x) + 0.4F * std::cos(b * y), 0.6F * a * std::cos(a * x), -0.4F * b * std::sin(b * y),
          0.0F};
}

/// Places on a grid in the middle of the floor, not at its nodes.
template <class F>
void for_each_place(F&& f) {
  for (float x = 1.1F; x < 9.0F; x += 0.73F)
    for (float y = 0.9F; y < 9.0F; y += 0.91F) f(x, y);
}

// With slopes between nodes that are not those of the height, water at rest ran up the sides of mounds.
TEST(Floor, HasTheSlopesOfItsHeight) {
  const Floor floor = floor_of(hilly);
  constexpr float kStep = 0.01F;
  for_each_place([&](float x, float y) {
    const Float4 at = floor.at(x, y);
    EXPECT_NEAR(at.y, (floor.at(x + kStep, y).x - floor.at(x - kStep, y).x) / (2.0F * kStep), 1e-3F) << x << ", " << y;
    EXPECT_NEAR(at.z, (floor.at(x, y + kStep).x - floor.at(x, y - kStep).x) / (2.0F * kStep), 1e-3F) << x << ", " << y;
  });
}

TEST(Floor, HasATangentPlaneAtEachPlace) {
  const Floor floor = floor_of(bowl);
  const Float4 at = bowl(2.5F, 1.5F);
  const float up = 1.0F / std::sqrt(1.0F + at.y * at.y + at.z * at.z);
  for (const float distance : {0.8F, 0.1F, -0.3F}) {
    const FloorPlane plane =
        floor_plane(floor, {2.5F - distance * at.y * up, 1.5F - distance * at.z * up, at.x + distance * up, 0.0F});
    EXPECT_NEAR(plane.surface.x, -at.y * up, 1e-3F);
    EXPECT_NEAR(plane.surface.z, up, 1e-3F);
    EXPECT_NEAR(plane.surface.w, distance, 1e-3F);
    EXPECT_NEAR(plane.speed, 0.25F * up, 1e-3F);
  }
}

TEST(Floor, HasTheDirectionInWhichTheDistanceGrows) {
  const Floor floor = floor_of(bowl);
  constexpr float kStep = 0.02F;
  for_each_place([&](float x, float y) {
    const Float4 place{x, y, floor.at(x, y).x + 1.0F, 0.0F}, normal = floor_plane(floor, place).surface;
    const auto distance = [&](float dx, float dy, float dz) {
      return floor_plane(floor, {x + dx, y + dy, place.z + dz, 0.0F}).surface.w;
    };
    EXPECT_NEAR(normal.x, (distance(kStep, 0, 0) - distance(-kStep, 0, 0)) / (2.0F * kStep), 2e-3F) << x << ", " << y;
    EXPECT_NEAR(normal.y, (distance(0, kStep, 0) - distance(0, -kStep, 0)) / (2.0F * kStep), 2e-3F) << x << ", " << y;
    EXPECT_NEAR(normal.z, (distance(0, 0, kStep) - distance(0, 0, -kStep)) / (2.0F * kStep), 2e-3F) << x << ", " << y;
  });
}

/// 10 x 10 columns of water, 6 deep, in a periodic box on a floor at z = 0.
FluidState water_on_floor(TaskPool& pool) {
  FluidParameters q;
  q.spacing = kD, q.support_radius = 2.0 * kD, q.viscosity = 0.0, q.scheme = Scheme::kCorrected;
  q.density.tolerance = q.divergence.tolerance = 3e-4;
  q.density.min_iterations = 0;
  q.patch = Region{{0, 0, -6}, {10, 10, 14}};
  q.edges = {Edge::kPeriodic, Edge::kPeriodic, Edge::kOpen};
  std::vector<Float4> points;
  for (int k = 0; k < 6; ++k)
    for (int j = 0; j < 10; ++j)
      for (int i = 0; i < 10; ++i)
        points.push_back({static_cast<float>(i) + 0.5F, static_cast<float>(j) + 0.5F, static_cast<float>(k) + 0.5F, 0});
  FluidState state = make_fluid(pool, q, points);
  state.floor = floor_of(flat);
  return state;
}

double mean_height(const FluidState& state) {
  double sum = 0.0;
  for (std::size_t i = 0; i < state.particles.count; ++i) sum += static_cast<double>(state.particles.position[i].z);
  return sum / static_cast<double>(state.particles.count);
}

TEST(Floor, BearsWaterAtRest) {
  TaskPool pool(2);
  FluidState state = water_on_floor(pool);
  for (int n = 0; n < 100; ++n) (void)step_water(pool, state, 0.02);
  EXPECT_NEAR(mean_height(state), 3.0, 0.02);
  for (std::size_t i = 0; i < state.particles.count; ++i) EXPECT_GT(state.particles.position[i].z, 0.3F);
}

TEST(Floor, LiftsTheWaterAsItRises) {
  TaskPool pool(2);
  FluidState state = water_on_floor(pool);
  double time = 0.0, height = 0.0;
  for (int n = 0; n < 200; ++n) {
    // Up by 1 m in 4 s, with a speed that starts and ends at zero.
    const double dt = 0.02, next = time + dt;
    const auto way = [](double t) { return 0.5 * (1.0 - std::cos(M_PI * t / 4.0)); };
    height = way(next);
    const double speed = (way(next + dt) - way(next)) / dt;  // over the coming drift
    for (Float4& node : state.floor.nodes) node = {static_cast<float>(height), 0.0F, 0.0F, static_cast<float>(speed)};
    (void)step_water(pool, state, dt);
    time = next;
    ASSERT_NEAR(mean_height(state), 3.0 + height, 0.03) << time;
  }
  EXPECT_NEAR(height, 1.0, 1e-6);
}

TEST(Floor, PutsBackWhatFallsThrough) {
  TaskPool pool(1);
  FluidState state = water_on_floor(pool);
  state.particles.position[50].z = 0.05F;
  state.particles.velocity[50].z = -8.0F;
  for (int n = 0; n < 40; ++n) (void)step_water(pool, state, 0.02);
  for (std::size_t i = 0; i < state.particles.count; ++i) EXPECT_GT(state.particles.position[i].z, 0.0F);
}

/// The water's first two columns along x are held at their labels.
FluidState half_held(TaskPool& pool) {
  FluidState state = water_on_floor(pool);
  FluidParticles& p = state.particles;
  p.label.assign(padded_count(p.count), {});
  for (std::size_t i = 0; i < p.count; ++i)
    p.label[i] = {p.position[i].x, p.position[i].y, p.position[i].z - 6.0F, p.position[i].x < 2.0F ? kHeld : 0.0F};
  find_held(state);
  return state;
}
void hold_still(FluidState& state) {
  HeldWater& held = state.held;
  held.position.clear();
  held.velocity.assign(held.rows.size(), {});
  for (const std::uint32_t i : held.rows) {
    const Float4& label = state.particles.label[i];
    held.position.push_back({label.x, label.y, label.z + 6.0F, 0.0F});
  }
}

TEST(HeldWater, StaysWhereItIsGivenAndBearsItsNeighbours) {
  TaskPool pool(2);
  FluidState state = half_held(pool);
  EXPECT_EQ(state.held.rows.size(), 120U);
  for (int n = 0; n < 100; ++n) {
    hold_still(state);
    const StepReport report = step_water(pool, state, 0.02);
    ASSERT_TRUE(report.divergence.converged);
  }
  EXPECT_EQ(state.held.rows.size(), 120U);
  for (const std::uint32_t i : state.held.rows) {
    const Float4 &x = state.particles.position[i], &label = state.particles.label[i], &v = state.particles.velocity[i];
    EXPECT_EQ(x.x, label.x);
    EXPECT_EQ(x.z, label.z + 6.0F);
    EXPECT_EQ(v.x, 0.0F);
    EXPECT_EQ(v.z, 0.0F);
  }
  for (std::size_t i = 0; i < state.particles.count; ++i) {
    const Float4& v = state.particles.velocity[i];
    EXPECT_LT(v.x * v.x + v.y * v.y + v.z * v.z, 0.3F * 0.3F) << "beside held water the rest stays calm";
  }
  EXPECT_NEAR(mean_height(state), 3.0, 0.03);
}

TEST(HeldWater, GoesWithItsLabelsWhenParticlesComeAndGo) {
  TaskPool pool(1);
  FluidState state = half_held(pool);
  const std::size_t before = state.particles.count;
  (void)remove_particles(pool, state, [&](std::size_t i) { return state.particles.label[i].w == 0.0F && i % 2 == 0; });
  EXPECT_LT(state.particles.count, before);
  const std::vector<Float4> place{{1.5F, 2.5F, 6.5F, 0}}, still(1), label{{1.5F, 2.5F, 0.5F, kHeld}};
  add_particles(state, place, still, kWaterPhase, label);
  find_held(state);
  EXPECT_EQ(state.held.rows.size(), 121U);
  EXPECT_EQ(state.held.rows.back(), state.particles.count - 1);
  for (std::size_t i = 0; i < state.particles.count; ++i)
    EXPECT_EQ(state.particles.label[i].x, state.particles.position[i].x) << "labels keep to their particles";
}

}  // namespace
}  // namespace pelagos::test
