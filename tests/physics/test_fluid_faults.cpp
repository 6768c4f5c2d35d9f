#include <gtest/gtest.h>

#include <limits>

#include "water_scene.hpp"

namespace pelagos::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();

struct Fault {
  const char* name;
  void (*inject)(FluidParticles&, std::size_t);
};
void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.name; }

class FluidFault : public testing::TestWithParam<Fault> {};

INSTANTIATE_TEST_SUITE_P(
    Values, FluidFault,
    testing::Values(Fault{"NanPosition", [](FluidParticles& p, std::size_t i) { p.position[i].x = kNan; }},
                    Fault{"NanVelocity", [](FluidParticles& p, std::size_t i) { p.velocity[i].z = kNan; }},
                    Fault{"NanAcceleration", [](FluidParticles& p, std::size_t i) { p.acceleration[i].y = kNan; }},
                    Fault{"InfinitePosition", [](FluidParticles& p, std::size_t i) { p.position[i].z = -kInfinity; }},
                    Fault{"InfiniteVelocity", [](FluidParticles& p, std::size_t i) { p.velocity[i].x = kInfinity; }},
                    Fault{"HugeVelocity", [](FluidParticles& p, std::size_t i) { p.velocity[i].x = 1e30F; }}),
    [](const testing::TestParamInfo<Fault>& fault) { return fault.param.name; });

TEST_P(FluidFault, IsReportedInThatStepAndDoesNotSpread) {
  WaterScene water = small_dam_break(2, {8, 7, 9});
  settle_fluid(water.pool, water.state, 5);
  for (int n = 0; n < 5; ++n) ASSERT_EQ(water.step(0.004).not_finite, 0U);
  GetParam().inject(water.state.particles, 200);
  for (int n = 0; n < 10; ++n) {
    const StepReport report = water.step(0.004);
    EXPECT_EQ(report.not_finite, 1U) << "step " << n << " after the fault";
    EXPECT_LT(report.largest_speed, 10.0);  // the sound ones: the next step's size is not brought to zero
  }
  // The others go on, inside the patch.
  EXPECT_LE(water.measure().outside, 1U);
}

TEST(FluidFaults, AFaultyWarmStartIsReportedAndEnds) {
  WaterScene water = small_dam_break(2, {8, 7, 9});
  settle_fluid(water.pool, water.state, 5);
  for (int n = 0; n < 5; ++n) static_cast<void>(water.step(0.004));
  water.state.particles.density_pressure[200] = kNan;
  const StepReport report = water.step(0.004);
  EXPECT_GT(report.not_finite, 0U);
  EXPECT_FALSE(report.density.converged);
  for (int n = 0; n < 5; ++n) static_cast<void>(water.step(0.004));  // neither a crash nor a loop without end
}

TEST(FluidFaults, AllParticlesNotFinite) {
  WaterScene water = small_dam_break(2, {8, 7, 9});
  for (std::size_t i = 0; i < water.state.particles.count; ++i) water.state.particles.position[i].x = kNan;
  for (int n = 0; n < 5; ++n) EXPECT_EQ(water.step(0.004).not_finite, water.state.particles.count);
}

TEST(FluidFaults, ParticlesOutsideAreCounted) {
  WaterScene water(
      2, patch_parameters({1, 1, 1}, 0.05),
      std::vector<Float4>{{0.5F, 0.5F, 0.5F, 0}, {1.2F, 0.5F, 0.5F, 0}, {0.5F, -0.1F, 0.5F, 0}, {50, 50, -80, 0}});
  const StepReport report = water.step(0.001);
  EXPECT_EQ(report.outside, 3U);
  EXPECT_EQ(report.not_finite, 0U);
}

TEST(FluidFaults, MovingSamplesComeGoAndFail) {
  WaterScene water = small_dam_break(2, {8, 7, 9});
  FluidState& state = water.state;
  settle_fluid(water.pool, water.state, 5);
  for (int n = 0; n < 12; ++n) {
    // A plate that moves in, grows, loses a sample to NaN and disappears.
    const std::size_t samples = n < 3 ? 0 : n < 6 ? 9 : n < 9 ? 40 : 0;
    state.moving_position.assign(samples, {});
    state.moving_velocity.assign(samples, {});
    for (std::size_t k = 0; k < samples; ++k) {
      state.moving_position[k] = {0.6F, 0.04F * static_cast<float>(k % 8), 0.05F * static_cast<float>(k / 8), 1e-4F};
      state.moving_velocity[k] = {-0.5F, 0, 0, 0};
    }
    if (n == 8) state.moving_position[3] = {kNan, kNan, kNan, 1e-4F};
    const StepReport report = water.step(0.004);
    ASSERT_EQ(report.not_finite, 0U) << n;
  }
}

}  // namespace
}  // namespace pelagos::test
