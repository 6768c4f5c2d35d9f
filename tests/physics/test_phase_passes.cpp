#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "pair_scene.hpp"

namespace pelagos::test {
namespace {

// The pair passes with two phases, on every instruction set.

constexpr double kSpacing = 0.05;
constexpr float kLight = 4.0F, kHeavy = 1.0F;  // mobilities: a quarter of the water's density, and water

/// A block in disorder; the lighter phase on one side, and single particles of it in the other.
class PhasePasses : public testing::Test {
 protected:
  PhasePasses() {
    std::vector<Float4> points = lattice({9, 8, 9}, kSpacing);
    jitter(points, 0.2 * kSpacing, 5);
    for (std::size_t i = 0; i < points.size(); ++i) points[i].w = points[i].x > 0.2F || i % 23 == 0 ? 1.0F : 0.0F;
    scene_ = std::make_unique<PairScene>(pool_, points, std::span<const Float4>{}, kSpacing, 2.0 * kSpacing);
    single_alpha_ = scene_->gradients.alpha;
    phases_.light_mobility = kLight;
    phases_.heavy_mobility = kHeavy;
    phases_.mobility.assign(padded_count(scene_->count), 1.0F);
    for (std::size_t i = 0; i < scene_->count; ++i) phases_.mobility[i] = is_light(i) ? kLight : kHeavy;
    scene_->data.phases = &phases_;
    compute_density(pool_, scene_->data, scene_->delta, scene_->gradients);
  }
  [[nodiscard]] bool is_light(std::size_t i) const { return scene_->position[i].w > 0.5F; }
  [[nodiscard]] double mass(std::size_t i) const { return 1.0 / static_cast<double>(phases_.mobility[i]); }

  TaskPool pool_{2};
  PhasePair phases_;
  std::unique_ptr<PairScene> scene_;
  std::vector<float> single_alpha_;
};

std::vector<float> random_pressure(std::size_t count, std::uint32_t seed) {
  Random random(seed);
  std::vector<float> pressure(padded_count(count), 0.0F);
  for (std::size_t i = 0; i < count; ++i) pressure[i] = static_cast<float>(random.uniform(0, 1e-3));
  return pressure;
}

/// sum_i mass_i v_i, and the sum of its terms' sizes.
template <class Mass>
std::pair<Double3, double> momentum(std::span<const Float4> v, std::size_t count, Mass&& mass) {
  Double3 sum{};
  double size = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Double3 a = as_double(v[i]);
    for (std::size_t c = 0; c < 3; ++c) sum[c] += mass(i) * a[c];
    size += mass(i) * std::sqrt(dot(a, a));
  }
  return {sum, size};
}

TEST_F(PhasePasses, AlphaTakesTheLightestAround) {
  for (std::size_t i = 0; i < scene_->count; ++i) {
    bool light = false;
    for_each_neighbor(scene_->fluid_list, i, [&](std::size_t j) { light = light || is_light(j); });
    const float mobility = light ? kLight : kHeavy;
    ASSERT_EQ(scene_->gradients.mobility[i], mobility) << i;
    ASSERT_NEAR(scene_->gradients.alpha[i], single_alpha_[i] / mobility, 1e-6F * single_alpha_[i]) << i;
  }
}

TEST_F(PhasePasses, PressureMovesByMobilityAndKeepsMomentum) {
  const std::vector<float> p = random_pressure(scene_->count, 7);
  const std::vector<Float4> u = scene_->displacement(pool_, p);
  scene_->data.phases = nullptr;
  const std::vector<Float4> plain = scene_->displacement(pool_, p);
  for (std::size_t i = 0; i < scene_->count; ++i) {
    ASSERT_EQ(u[i].x, phases_.mobility[i] * plain[i].x) << i;
    ASSERT_EQ(u[i].z, phases_.mobility[i] * plain[i].z) << i;
  }
  const auto [sum, size] = momentum(u, scene_->count, [&](std::size_t i) { return mass(i); });
  for (const double c : sum) EXPECT_NEAR(c, 0.0, 1e-6 * size);  // single precision
}

TEST_F(PhasePasses, TheProblemStaysSymmetricAndPositive) {
  const std::vector<float> p = random_pressure(scene_->count, 8), q = random_pressure(scene_->count, 9);
  const std::vector<float> ap = scene_->rate(pool_, scene_->displacement(pool_, p), false),
                           aq = scene_->rate(pool_, scene_->displacement(pool_, q), false);
  double pq = 0, qp = 0, pp = 0;
  for (std::size_t i = 0; i < scene_->count; ++i) {
    pq -= static_cast<double>(p[i]) * static_cast<double>(aq[i]);
    qp -= static_cast<double>(q[i]) * static_cast<double>(ap[i]);
    pp -= static_cast<double>(p[i]) * static_cast<double>(ap[i]);
  }
  EXPECT_GT(pp, 0.0);
  EXPECT_NEAR(pq, qp, 1e-5 * pp);
}

TEST_F(PhasePasses, AlphaBoundsTheDiagonal) {
  for (std::size_t i = 0; i < scene_->count; i += 31) {
    std::vector<float> unit(padded_count(scene_->count), 0.0F);
    unit[i] = 1.0F;
    const double diagonal = -static_cast<double>(scene_->rate(pool_, scene_->displacement(pool_, unit), false)[i]);
    const double share = diagonal * static_cast<double>(scene_->gradients.alpha[i]);
    ASSERT_LE(share, 1.0 + 1e-5) << i;
    ASSERT_GE(share, static_cast<double>(kHeavy / kLight) - 1e-5) << i;
  }
}

TEST_F(PhasePasses, TheFilterKeepsMomentum) {
  const std::vector<Float4> v = random_vectors(scene_->count, 1.0, 10);
  VelocityGradients gradients;
  compute_velocity_gradients(pool_, scene_->data, scene_->gradients, Corrections{}, v, 0.0F, gradients);
  FilterChange filtered;
  compute_filter(pool_, scene_->data, gradients, filtered, scene_->delta);
  const std::vector<Float4>& change = filtered.all;
  const auto [sum, size] = momentum(change, scene_->count, [&](std::size_t i) { return mass(i); });
  for (const double c : sum) EXPECT_NEAR(c, 0.0, 1e-6 * size);
  scene_->data.phases = nullptr;
  FilterChange in_one_phase;
  compute_filter(pool_, scene_->data, gradients, in_one_phase, scene_->delta);
  const std::vector<Float4>& plain = in_one_phase.all;
  for (std::size_t i = 0; i < scene_->count; ++i)
    if (is_light(i)) {
      ASSERT_EQ(change[i].y, plain[i].y) << "the lighter phase takes the whole change";
    }
}

TEST_F(PhasePasses, ViscosityKeepsMomentumAndTakesEnergy) {
  phases_.light_viscosity = 0.03F;
  phases_.heavy_viscosity = 0.01F;
  phases_.mixed_viscosity = 0.015F;
  const std::vector<Float4> v = random_vectors(scene_->count, 1.0, 11);
  std::vector<Float4> a(padded_count(scene_->count));
  std::vector<float> delta(padded_count(scene_->count));
  compute_phase_acceleration(pool_, scene_->data, v, 0.0F, a, delta);
  const auto [sum, size] = momentum(a, scene_->count, [&](std::size_t i) { return mass(i); });
  for (const double c : sum) EXPECT_NEAR(c, 0.0, 1e-6 * size);
  double power = 0;
  for (std::size_t i = 0; i < scene_->count; ++i) {
    power += mass(i) * dot(as_double(v[i]), as_double(a[i]));
    ASSERT_NEAR(delta[i], scene_->delta[i], 1e-5F);
  }
  EXPECT_LT(power, 0.0);
  // Without densities to fill in, particles whose phase has no viscosity are passed over: the result is the same.
  phases_.heavy_viscosity = phases_.mixed_viscosity = 0.0F;
  std::vector<Float4> with(padded_count(scene_->count)), without(padded_count(scene_->count));
  compute_phase_acceleration(pool_, scene_->data, v, 9.81F, with, delta);
  compute_phase_acceleration(pool_, scene_->data, v, 9.81F, without);
  for (std::size_t i = 0; i < scene_->count; ++i) {
    ASSERT_EQ(with[i].x, without[i].x) << i;
    ASSERT_EQ(with[i].z, without[i].z) << i;
    if (!is_light(i)) {
      ASSERT_EQ(with[i].z, -9.81F) << i;
    }
  }
}

}  // namespace
}  // namespace pelagos::test
