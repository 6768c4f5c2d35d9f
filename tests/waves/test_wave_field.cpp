#include "waves/wave_field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "waves/sea_state.hpp"
#include "waves/splitmix.hpp"

namespace pelagos {
namespace {

constexpr double kGravity = 9.81;

WaveComponent wave_of(double amplitude, double wavenumber, double depth, double direction, double phase) {
  return {static_cast<float>(amplitude), static_cast<float>(wavenumber),
          static_cast<float>(wave_frequency(wavenumber, depth, kGravity)), static_cast<float>(direction),
          static_cast<float>(phase)};
}

/// Places over 200 m about the anchor, down to 8 m below the mean level and 1 m above it.
struct Places {
  explicit Places(std::size_t count, std::uint64_t seed = 1) {
    SplitMix64 random(seed);
    for (std::size_t i = 0; i < count; ++i) {
      x.push_back(static_cast<float>(200.0 * random.next_unit() - 100.0));
      y.push_back(static_cast<float>(200.0 * random.next_unit() - 100.0));
      z.push_back(static_cast<float>(9.0 * random.next_unit() - 8.0));
    }
  }
  std::vector<float> x, y, z;
};

struct Surfaces {
  Surfaces(const WaveMoment& moment, const Places& p) {
    for (auto* values : {&elevation, &slope_x, &slope_y, &rate}) values->resize(p.x.size());
    evaluate_surface(moment, p.x, p.y, {elevation, slope_x, slope_y, rate});
  }
  std::vector<float> elevation, slope_x, slope_y, rate;
};

struct Motions {
  Motions(const WaveMoment& moment, const Places& p, Stretching stretching) {
    for (auto& values : v) values.resize(p.x.size());
    evaluate_motion(moment, p.x, p.y, p.z, stretching, {v[0], v[1], v[2], v[3], v[4], v[5], v[6]});
  }
  std::vector<float> v[7];
};

TEST(Dispersion, HoldsToTwelveDigitsAtAnyDepth) {
  for (const double depth : {0.5, 3.0, 10.0, 60.0, 4000.0})
    for (double omega = 0.05; omega < 8.0; omega *= 1.3) {
      const double k = wave_number(omega, depth, kGravity);
      EXPECT_NEAR(kGravity * k * std::tanh(k * depth), omega * omega, 1e-12 * omega * omega) << depth << " " << omega;
      EXPECT_NEAR(wave_frequency(k, depth, kGravity), omega, 1e-12 * omega);
    }
}

TEST(Dispersion, HasTheDeepAndTheShallowLimit) {
  EXPECT_EQ(wave_number(0.7, kInfiniteDepth, kGravity), 0.7 * 0.7 / kGravity);
  EXPECT_NEAR(wave_number(0.7, 1000.0, kGravity), 0.7 * 0.7 / kGravity, 1e-15);
  // long waves run at sqrt(g h); the next term of the series is (k h)^2 / 6 = 5e-6
  EXPECT_NEAR(wave_number(0.02, 1.0, kGravity), 0.02 / std::sqrt(kGravity), 1e-5 * 0.02 / std::sqrt(kGravity));
}

/// One component by its formulas in double precision.
struct Formula {
  WaveComponent wave;
  double depth;
  double x, y, z, t;

  [[nodiscard]] double k() const { return static_cast<double>(wave.wavenumber); }
  [[nodiscard]] double omega() const { return static_cast<double>(wave.omega); }
  [[nodiscard]] double theta() const {
    const double direction = static_cast<double>(wave.direction);
    return k() * (std::cos(direction) * x + std::sin(direction) * y) - omega() * t + static_cast<double>(wave.phase);
  }
  [[nodiscard]] double even() const {
    return std::isinf(depth) ? std::exp(k() * z) : std::cosh(k() * (z + depth)) / std::sinh(k() * depth);
  }
  [[nodiscard]] double odd() const {
    return std::isinf(depth) ? std::exp(k() * z) : std::sinh(k() * (z + depth)) / std::sinh(k() * depth);
  }
};

class AtDepth : public testing::TestWithParam<double> {};

TEST_P(AtDepth, OneComponentIsItsFormula) {
  const double depth = GetParam(), time = 12345.6;
  const Eigen::Vector2d anchor(3.0e5, -2.0e5);
  const WaveComponent wave = wave_of(0.8, 0.11, depth, 2.3, 1.1);
  const WaveMoment moment = WaveField({wave}, 0.0, depth).at(time, anchor);
  const Places places(200);
  const Surfaces surface(moment, places);
  const Motions motion(moment, places, Stretching::kNone);
  const double a = static_cast<double>(wave.amplitude);
  // 1e-6: single precision; 100 m from the anchor the phase errs by 1e-6 of a turn
  constexpr double kError = 8e-6;
  for (std::size_t i = 0; i < places.x.size(); ++i) {
    const Formula f{wave,
                    depth,
                    anchor.x() + static_cast<double>(places.x[i]),
                    anchor.y() + static_cast<double>(places.y[i]),
                    std::clamp(static_cast<double>(places.z[i]), -depth, 0.0),
                    time};
    const double w = f.omega(), c = std::cos(f.theta()), s = std::sin(f.theta());
    const double along_x = std::cos(static_cast<double>(wave.direction));
    const double along_y = std::sin(static_cast<double>(wave.direction));
    EXPECT_NEAR(surface.elevation[i], a * c, kError);
    EXPECT_NEAR(surface.slope_x[i], -a * f.k() * along_x * s, kError);
    EXPECT_NEAR(surface.slope_y[i], -a * f.k() * along_y * s, kError);
    EXPECT_NEAR(surface.rate[i], a * w * s, kError);
    EXPECT_NEAR(motion.v[0][i], a * w * f.even() * along_x * c, kError);
    EXPECT_NEAR(motion.v[1][i], a * w * f.even() * along_y * c, kError);
    EXPECT_NEAR(motion.v[2][i], a * w * f.odd() * s, kError);
    EXPECT_NEAR(motion.v[3][i], a * w * w * f.even() * along_x * s, kError);
    EXPECT_NEAR(motion.v[4][i], a * w * w * f.even() * along_y * s, kError);
    EXPECT_NEAR(motion.v[5][i], -a * w * w * f.odd() * c, kError);
    EXPECT_NEAR(motion.v[6][i], a * w * w / f.k() * f.even() * c, 10.0 * kError);  // up to 8 m^2/s^2
  }
}

TEST_P(AtDepth, VelocityIsTheGradientOfAPotentialAndKeepsVolume) {
  const double depth = GetParam();
  std::vector<WaveComponent> waves;
  for (int i = 0; i < 12; ++i) waves.push_back(wave_of(0.2, 0.05 + 0.03 * i, depth, 0.4 * i, 1.3 * i));
  const WaveMoment moment = WaveField(waves, 0.0, depth).at(5.0, {0.0, 0.0});
  constexpr float kStep = 0.05F;
  for (const Eigen::Vector3f& place : {Eigen::Vector3f(3, 4, -1), Eigen::Vector3f(-20, 7, -2.3F)}) {
    Eigen::Matrix3d gradient;  // d velocity_row / d axis_column
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3f step = kStep * Eigen::Vector3f::Unit(axis);
      gradient.col(axis) = (motion_at(moment, place + step, Stretching::kNone).velocity -
                            motion_at(moment, place - step, Stretching::kNone).velocity)
                               .cast<double>() /
                           (2.0 * static_cast<double>(kStep));
    }
    // rounding 1e-6 m/s over 0.1 m, and (k step)^2 / 6 = 7e-5 of gradients up to 0.5 /s
    EXPECT_NEAR(gradient.trace(), 0.0, 1e-4);
    EXPECT_LT((gradient - gradient.transpose()).cwiseAbs().maxCoeff(), 1e-4);
    EXPECT_GT(gradient.norm(), 0.05);
  }
}

TEST_P(AtDepth, AccelerationAndPressureObeyTheLinearMomentumEquation) {
  const double depth = GetParam();
  std::vector<WaveComponent> waves;
  for (int i = 0; i < 12; ++i) waves.push_back(wave_of(0.2, 0.05 + 0.03 * i, depth, 0.4 * i, 1.3 * i));
  const WaveField field(waves, 0.0, depth);
  const WaveMoment moment = field.at(5.0, {0.0, 0.0});
  const WaveMoment before = field.at(4.99, {0.0, 0.0}), after = field.at(5.01, {0.0, 0.0});
  const Eigen::Vector3f place(3, 4, -1);
  const Eigen::Vector3f acceleration = motion_at(moment, place, Stretching::kNone).acceleration;
  const Eigen::Vector3f change =
      (motion_at(after, place, Stretching::kNone).velocity - motion_at(before, place, Stretching::kNone).velocity) /
      0.02F;
  EXPECT_LT((acceleration - change).norm(), 5e-4F);  // rounding 4e-6 m/s over 0.02 s, (omega dt)^2 / 6 = 1e-4
  Eigen::Vector3f gradient;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3f step = 0.1F * Eigen::Vector3f::Unit(axis);
    gradient[axis] = (motion_at(moment, place + step, Stretching::kNone).pressure -
                      motion_at(moment, place - step, Stretching::kNone).pressure) /
                     0.2F;
  }
  EXPECT_LT((acceleration + gradient).norm(), 1e-3F);  // rho dv/dt = -grad p; (k step)^2 / 6 = 3e-4
}

TEST_P(AtDepth, PressureVanishesAtTheSurfaceWithWheelersStretching) {
  const double depth = GetParam();
  std::vector<WaveComponent> waves;
  for (int i = 0; i < 12; ++i) waves.push_back(wave_of(0.08, 0.05 + 0.03 * i, depth, 0.4 * i, 1.3 * i));
  const WaveMoment moment = WaveField(waves, 0.0, depth).at(5.0, {0.0, 0.0});
  for (int i = 0; i < 20; ++i) {
    const auto x = static_cast<float>(3.7 * i), y = static_cast<float>(1.3 * i);
    const float elevation = surface_at(moment, x, y).elevation;
    const WaveMotion motion = motion_at(moment, {x, y, elevation}, Stretching::kWheeler);
    EXPECT_NEAR(motion.pressure, kGravity * static_cast<double>(elevation), 2e-5);
    EXPECT_NEAR(motion.velocity.z(), surface_at(moment, x, y).rate, 1e-5) << "the kinematic condition, linear";
    const Eigen::Vector3f above(x, y, elevation + 3.0F);
    EXPECT_EQ(motion_at(moment, above, Stretching::kWheeler).velocity.z(),
              motion_at(moment, {x, y, elevation + 1.0F}, Stretching::kWheeler).velocity.z());
    if (std::isinf(depth)) continue;
    const Eigen::Vector3f bottom(x, y, static_cast<float>(-depth));
    EXPECT_NEAR(motion_at(moment, bottom, Stretching::kWheeler).velocity.z(), 0.0F, 1e-6F);
  }
}

INSTANTIATE_TEST_SUITE_P(WaveField, AtDepth, testing::Values(2.5, 12.0, 45.0, kInfiniteDepth));

TEST(WaveField, AgreesWithTheSumsInDoublePrecision) {
  const auto waves = make_wave_components({.beaufort = 7, .wave_to_deg = 70, .components = 128, .seed = 3});
  const Eigen::Vector2d anchor(120.0, -40.0);
  const WaveMoment moment = WaveField(waves, 0.0).at(7200.0, anchor);
  const Places places(300);
  const Surfaces surface(moment, places);
  std::vector<float> shift[3];
  for (auto& values : shift) values.resize(places.x.size());
  const std::vector<float> top(places.x.size(), 0.0F);
  evaluate_displacement(moment, places.x, places.y, top, shift[0], shift[1], shift[2]);
  for (std::size_t i = 0; i < places.x.size(); ++i) {
    const double x = anchor.x() + static_cast<double>(places.x[i]), y = anchor.y() + static_cast<double>(places.y[i]);
    const WaveSurface exact = wave_surface(waves, x, y, 7200.0);
    EXPECT_NEAR(surface.elevation[i], exact.elevation, 2e-5);
    EXPECT_NEAR(surface.slope_x[i], exact.slope.x(), 2e-5);
    EXPECT_NEAR(surface.rate[i], exact.rate, 4e-5);
    const Eigen::Vector3d moved = wave_displacement(waves, x, y, 7200.0);
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(shift[axis][i], moved[axis], 2e-5);
  }
}

TEST_P(AtDepth, TheDisplacedSurfaceIsWhereItsParticlesAre) {
  std::vector<WaveComponent> waves;
  for (int i = 0; i < 12; ++i) waves.push_back(wave_of(0.5 / (1 + i), 0.05 + 0.05 * i, GetParam(), 0.4 * i, 1.3 * i));
  const WaveMoment moment = WaveField(waves, 0.0, GetParam()).at(17.0, {0.0, 0.0});
  const Places at_rest(100);
  const std::vector<float> top(at_rest.x.size(), 0.0F);
  std::vector<float> shift[3], out[6];
  for (auto& values : shift) values.resize(top.size());
  for (auto& values : out) values.resize(top.size());
  evaluate_displacement(moment, at_rest.x, at_rest.y, top, shift[0], shift[1], shift[2]);
  Places moved = at_rest;
  const auto height_at = [&](float way_x, float way_y) {
    for (std::size_t i = 0; i < top.size(); ++i) {
      moved.x[i] = at_rest.x[i] + shift[0][i] + way_x;
      moved.y[i] = at_rest.y[i] + shift[1][i] + way_y;
    }
    evaluate_displaced_surface(moment, moved.x, moved.y, {out[0], out[1], out[2], out[3], out[4], out[5]});
    return out[0];
  };
  constexpr float kStep = 0.05F;
  const std::vector<float> east = height_at(kStep, 0.0F), west = height_at(-kStep, 0.0F);
  const std::vector<float> north = height_at(0.0F, kStep), south = height_at(0.0F, -kStep);
  const std::vector<float> here = height_at(0.0F, 0.0F);
  Places surface = at_rest;
  surface.z = top;
  const Motions motion(moment, surface, Stretching::kNone);
  for (std::size_t i = 0; i < top.size(); ++i) {
    EXPECT_NEAR(here[i], shift[2][i], 2e-5);
    // rounding 4e-6 m over 0.1 m, and step^2 / 6 of a third derivative up to 0.3 /m^2
    EXPECT_NEAR(out[1][i], (east[i] - west[i]) / (2 * kStep), 4e-4);
    EXPECT_NEAR(out[2][i], (north[i] - south[i]) / (2 * kStep), 4e-4);
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(out[3 + axis][i], motion.v[axis][i], 2e-5);
  }
}

TEST(WaveField, BatchesGiveTheBitsOfSinglePlaces) {
  const auto waves = make_wave_components({.beaufort = 6, .components = 40, .seed = 2});
  for (const double depth : {8.0, kInfiniteDepth}) {
    const WaveMoment moment = WaveField(waves, 1.0, depth).at(99.0, {10.0, 20.0});
    const Places places(37);  // no multiple of any machine's lanes
    const Surfaces surface(moment, places);
    const Motions motion(moment, places, Stretching::kWheeler);
    for (std::size_t i = 0; i < places.x.size(); ++i) {
      const WavePoint point = surface_at(moment, places.x[i], places.y[i]);
      EXPECT_EQ(point.elevation, surface.elevation[i]);
      EXPECT_EQ(point.slope_x, surface.slope_x[i]);
      EXPECT_EQ(point.rate, surface.rate[i]);
      const WaveMotion one = motion_at(moment, {places.x[i], places.y[i], places.z[i]}, Stretching::kWheeler);
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(one.velocity[axis], motion.v[axis][i]);
        EXPECT_EQ(one.acceleration[axis], motion.v[3 + axis][i]);
      }
      EXPECT_EQ(one.pressure, motion.v[6][i]);
    }
  }
}

TEST(WaveField, VelocityAloneHasTheSameBits) {
  const WaveMoment moment = WaveField(make_wave_components({.beaufort = 6, .seed = 2}), 0.0, 9.0).at(3.0, {0.0, 0.0});
  const Places places(50);
  const Motions all(moment, places, Stretching::kWheeler);
  std::vector<float> v[3];
  for (auto& values : v) values.resize(places.x.size());
  evaluate_motion(moment, places.x, places.y, places.z, Stretching::kWheeler, {v[0], v[1], v[2], {}, {}, {}, {}});
  for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(v[axis], all.v[axis]);
}

TEST(WaveBlend, RunsFromOneSeaToTheOtherWithoutAJump) {
  const auto calm = make_wave_components({.beaufort = 3, .seed = 1}), rough = make_wave_components({.beaufort = 6});
  WaveField field(calm, 0.0);
  ASSERT_TRUE(field.exchange(rough, 100.0, 20.0));
  ASSERT_TRUE(field.exchange(calm, 110.0, 30.0)) << "before the first is there";
  const auto at = [&](double t) {
    const WaveMoment moment = field.at(t, {0.0, 0.0});
    return std::pair{surface_at(moment, 12.0F, 5.0F), motion_at(moment, {12.0F, 5.0F, -1.0F}, Stretching::kNone)};
  };
  constexpr double kStep = 0.01;
  for (double t = 99.0; t < 142.0; t += kStep) {
    const auto [before, below_before] = at(t);
    const auto [after, below_after] = at(t + kStep);
    // The rate is the derivative of the height at every time: its own change over a step is at most 5 m/s^2 dt.
    EXPECT_NEAR((after.elevation - before.elevation) / kStep, 0.5 * (after.rate + before.rate), 2e-3) << t;
    EXPECT_LT((below_after.velocity - below_before.velocity).norm(), 0.05F) << t;
    const Eigen::Vector3f mean = 0.5F * (below_after.acceleration + below_before.acceleration);
    EXPECT_LT(((below_after.velocity - below_before.velocity) / static_cast<float>(kStep) - mean).norm(), 2e-3F) << t;
  }
  const auto [start, x] = at(99.0);
  EXPECT_FLOAT_EQ(start.elevation, surface_at(WaveField(calm, 0.0).at(99.0, {0.0, 0.0}), 12.0F, 5.0F).elevation);
  EXPECT_FLOAT_EQ(at(141.0).first.elevation,
                  surface_at(WaveField(calm, 0.0).at(141.0, {0.0, 0.0}), 12.0F, 5.0F).elevation);
  EXPECT_EQ(field.at(99.5, {0.0, 0.0}).waves.size(), calm.size()) << "a sea that has no share costs nothing";
  EXPECT_EQ(field.at(115.0, {0.0, 0.0}).waves.size(), 2 * calm.size() + rough.size());
  EXPECT_EQ(field.at(141.0, {0.0, 0.0}).waves.size(), calm.size());
}

TEST(WaveBlend, RefusesMoreBlendsThanItKeepsAndDropsThoseThatAreOver) {
  WaveField field;
  for (std::size_t i = 1; i < WaveField::kMostLayers; ++i)
    EXPECT_TRUE(field.exchange({}, static_cast<double>(i), 60.0));
  EXPECT_FALSE(field.exchange({}, 10.0, 60.0));
  EXPECT_EQ(field.open_from(), 61.0) << "when the first blend is over";
  EXPECT_FALSE(field.exchange({}, 60.9, 60.0));
  EXPECT_EQ(field.layers().size(), WaveField::kMostLayers);
  WaveField at_once = field;
  EXPECT_TRUE(at_once.exchange({wave_of(1.0, 0.1, kInfiniteDepth, 0.0, 0.0)}, 60.9, 0.0)) << "it needs no room";
  EXPECT_EQ(at_once.layers().size(), 2U);
  EXPECT_NEAR(surface_at(at_once.at(60.9, {0.0, 0.0}), 0.0F, 0.0F).elevation, std::cos(60.9 * std::sqrt(0.1 * 9.81)),
              0.01);
  EXPECT_TRUE(field.exchange({wave_of(1.0, 0.1, kInfiniteDepth, 0.0, 0.0)}, 200.0, 0.0));
  EXPECT_EQ(field.layers().size(), 2U);
  EXPECT_EQ(field.components().size(), 1U);
  EXPECT_EQ(surface_at(field.at(199.9, {0.0, 0.0}), 0.0F, 0.0F).elevation, 0.0F);
  EXPECT_NE(surface_at(field.at(200.0, {0.0, 0.0}), 0.0F, 0.0F).elevation, 0.0F);
}

}  // namespace
}  // namespace pelagos
