#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "slick_fixture.hpp"

namespace pelagos {
namespace {

template <typename Change>
std::string refusal(Change change) {
  SlickSettings settings;
  change(settings);
  try {
    SlickLayer layer(settings);
  } catch (const std::invalid_argument& fault) {
    return fault.what();
  }
  return "";
}

TEST(SlickSettings, DefaultsAreAllowedForEveryOil) {
  for (const OilProperties& oil : kOils) EXPECT_EQ(refusal([&oil](SlickSettings& s) { s.oil = oil; }), "");
}

TEST(SlickSettings, NameTheFieldTheValueAndWhatIsAllowed) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal([](SlickSettings& s) { s.water_density = 800.0; }),
            "water_density: 800; allowed: finite and above the oil's density: oil must float");
  EXPECT_EQ(refusal([](SlickSettings& s) { s.most_elements = 0; }), "most_elements: 0; allowed: 1 to 1000000");
  EXPECT_EQ(refusal([](SlickSettings& s) { s.wind_share = 0.2; }), "wind_share: 0.2; allowed: 0 to 0.1");
  EXPECT_EQ(refusal([](SlickSettings& s) { s.wind_share_in_waves = -0.01; }),
            "wind_share_in_waves: -0.01; allowed: 0 to 0.1");
  EXPECT_EQ(refusal([](SlickSettings& s) { s.gravity = 0.0; }), "gravity: 0; allowed: finite and above 0");
  EXPECT_EQ(refusal([](SlickSettings& s) { s.water_viscosity = kNan; }),
            "water_viscosity: nan; allowed: finite and above 0");
  EXPECT_EQ(refusal([](SlickSettings& s) { s.terminal_thickness = -1.0; }),
            "terminal_thickness: -1; allowed: finite and above 0");
  EXPECT_EQ(refusal([](SlickSettings& s) { s.water_temperature = 80.0; }),
            "water_temperature: 80; allowed: -2 to 50 degrees C");
  EXPECT_EQ(refusal([](SlickSettings& s) {
              s.patch = SlickPatch{{0.0, 5.0}, {1.0, 5.0}};
            }),
            "patch.min.y: 5; allowed: finite and below patch.max");
  EXPECT_EQ(refusal([](SlickSettings& s) {
              s.exchange = ParticleExchange{0.0, 1.0};
            }),
            "exchange.thickness: 0; allowed: finite and above 0");
  EXPECT_EQ(refusal([](SlickSettings& s) {
              s.exchange = ParticleExchange{0.1, 0.0};
            }),
            "exchange.particle_mass: 0; allowed: 1e-6 kg to 1e9 kg");
  EXPECT_EQ(refusal([](SlickSettings& s) { s.oil.density = 0.0; }), "oil.density: 0; allowed: finite and above 0");
}

TEST(SlickLayerCalls, RefuseBadOil) {
  SlickLayer layer{SlickSettings{}};
  constexpr double kInf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(text_of(layer.release(0.0, {0.0, 0.0}, 1.0)), "mass: 0; allowed: 1e-6 kg to 1e9 kg");
  EXPECT_EQ(text_of(layer.release(2e9, {0.0, 0.0}, 1.0)), "mass: 2e+09; allowed: 1e-6 kg to 1e9 kg");
  EXPECT_EQ(text_of(layer.release(1.0, {kInf, 0.0}, 1.0)), "position.x: inf; allowed: -1e8 m to 1e8 m");
  EXPECT_EQ(text_of(layer.release(1.0, {0.0, 0.0}, 0.0)), "radius: 0; allowed: 0.001 m to 1e6 m");
  EXPECT_EQ(text_of(layer.take(1.0, {0.0, 0.0}, 1.0)), "mass: 1; allowed: at most the 0 kg that are submerged");
  EXPECT_EQ(text_of(layer.release_submerged(-1.0)), "mass: -1; allowed: 1e-6 kg to 1e9 kg");
  EXPECT_EQ(layer.ledger(), OilLedger{});
}

}  // namespace
}  // namespace pelagos
