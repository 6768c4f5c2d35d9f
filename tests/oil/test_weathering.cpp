#include <gtest/gtest.h>

#include <cmath>
#include <string_view>

#include "oil/weathering.hpp"
#include "slick_fixture.hpp"

namespace pelagos {
namespace {

double evaporated_after(std::string_view oil, double hours, double film, double wind, double celsius = 15.0) {
  return evaporated_share(find_oil(oil).value(), 0.0, film, wind, celsius, 0.0, hours * 3600.0);
}

TEST(OilTable, ApiGravityAndDensitySayTheSame) {
  for (const OilProperties& oil : kOils)  // API = 141.5 / (rho / 999) - 131.5, at 60 degrees F
    EXPECT_NEAR(oil.api_gravity, 141.5 / (oil.density / 999.0) - 131.5, 0.6) << oil.name;
}

TEST(Evaporation, FollowsTheClosedFormOfStiverAndMackay) {
  // F = T / (B TG) ln(1 + B TG / T theta exp(A - B T0 / T)), written out for the light crude.
  const double api = 39.2, t0 = 532.98 - 3.1295 * api, tg = 985.62 - 13.597 * api, t = 288.15;
  const double theta = 2.5e-3 * std::pow(5.0, 0.78) * 3600.0 / 1e-3;
  const double expected = t / (10.3 * tg) * std::log(1.0 + 10.3 * tg / t * theta * std::exp(6.3 - 10.3 * t0 / t));
  EXPECT_NEAR(evaporated_after("light crude", 1.0, 1e-3, 5.0), expected, 1e-12);
}

TEST(Evaporation, DoesNotDependOnTheStep) {
  const OilProperties oil = find_oil("medium crude").value();
  double share = 0.0;
  for (int step = 0; step < 3600; ++step) {
    // The fresh film is what counts: what has evaporated thins the film that is left.
    share = evaporated_share(oil, share, 1e-3 * (1.0 - share), 8.0, 15.0, 0.0, 1.0);
  }
  EXPECT_NEAR(share, evaporated_after("medium crude", 1.0, 1e-3, 8.0), 1e-9);
}

TEST(Evaporation, LighterOilsLoseMore) {
  const auto day = [](std::string_view oil) { return evaporated_after(oil, 24.0, 1e-3, 5.0); };
  EXPECT_GT(day("gasoline"), 0.95);  // gasoline is gone within hours
  EXPECT_GT(day("light crude"), day("medium crude"));
  EXPECT_GT(day("medium crude"), day("heavy crude"));
  EXPECT_GT(day("heavy crude"), day("bunker C"));
  // Fingas, The evaporation of oil spills: within days light crudes lose up to 75 %, medium ones up to 40 %, heavy and
  // residual oils about 5 %. The law gives a millimetre of heavy crude too much.
  EXPECT_NEAR(day("light crude"), 0.45, 0.1);
  EXPECT_NEAR(day("medium crude"), 0.35, 0.1);
  EXPECT_NEAR(day("heavy crude"), 0.2, 0.08);
}

TEST(Evaporation, GrowsWithWindWarmthAndThinness) {
  const double base = evaporated_after("medium crude", 1.0, 1e-3, 5.0, 15.0);
  EXPECT_GT(evaporated_after("medium crude", 1.0, 1e-3, 10.0, 15.0), base);
  EXPECT_GT(evaporated_after("medium crude", 1.0, 1e-3, 5.0, 25.0), base);
  EXPECT_GT(evaporated_after("medium crude", 1.0, 1e-4, 5.0, 15.0), base);
  EXPECT_EQ(evaporated_after("medium crude", 1.0, 1e-3, 0.0, 15.0), 0.0);
  EXPECT_EQ(evaporated_after("gasoline", 1e9, 1e-6, 30.0, 30.0), 1.0);  // never beyond all
}

TEST(Emulsification, FollowsMackaysUptake) {
  const OilProperties oil = find_oil("medium crude").value();
  // Y = Y_max (1 - exp(-K (U + 1)^2 t / Y_max))
  const double expected = 0.7 * (1.0 - std::exp(-2e-6 * 121.0 * 3600.0 / 0.7));
  EXPECT_NEAR(water_content(oil, 0.0, 10.0, 3600.0), expected, 1e-12);
  EXPECT_NEAR(water_content(oil, water_content(oil, 0.0, 10.0, 1200.0), 10.0, 2400.0), expected, 1e-12);
  EXPECT_NEAR(water_content(oil, 0.0, 10.0, 1e9), 0.7, 1e-12);
  EXPECT_EQ(water_content(find_oil("diesel").value(), 0.0, 10.0, 1e6), 0.0);
}

TEST(Viscosity, GrowsByMooneysLaw) {
  const OilProperties oil = find_oil("medium crude").value();
  const double fresh = kinematic_viscosity(oil);
  EXPECT_NEAR(weathered_viscosity(oil, 0.0, 0.0, 15.0), fresh, 1e-12);
  // exp(2.5 * 0.7 / (1 - 0.65 * 0.7)) = 24.8 times thicker as emulsion of 70 % water
  EXPECT_NEAR(weathered_viscosity(oil, 0.0, 0.7, 15.0) / fresh, 24.80, 0.01);
  EXPECT_NEAR(weathered_viscosity(oil, 0.2, 0.0, 15.0) / fresh, std::exp(2.0), 1e-9);
  EXPECT_LT(weathered_viscosity(oil, 0.0, 0.0, 25.0), fresh);
}

TEST(TerminalThickness, FollowsTheViscosity) {
  EXPECT_DOUBLE_EQ(terminal_thickness(1e-7), 1e-5);
  EXPECT_DOUBLE_EQ(terminal_thickness(1e-3), 1e-4);
  EXPECT_NEAR(terminal_thickness(5.05e-5), 5.5e-5, 1e-9);
}

SlickLayer weathered_layer(double seconds, double dt, double wind = 10.0) {
  SlickSettings settings;
  settings.terminal_thickness = 1.0;  // the film stays as thick as it is
  SlickLayer layer(settings);
  EXPECT_FALSE(layer.release(10.0, {0.0, 0.0}, 2.0));
  run(layer, PlacedSurroundings(moving({0.0, 0.0}, {wind, 0.0})), seconds, dt);
  return layer;
}

TEST(SlickWeathering, EvaporatedOilIsCountedToTheMilligram) {
  const SlickLayer layer = weathered_layer(600.0, 0.05);
  const OilLedger ledger = layer.ledger();
  EXPECT_GT(ledger.evaporated, 0);
  EXPECT_EQ(ledger.balance(), 0);
  const double share = layer.elements()[0].evaporated;
  EXPECT_NEAR(to_kilograms(ledger.evaporated), 10.0 * share, 2e-6);  // small steps lose nothing to rounding
}

TEST(SlickWeathering, EmulsionWaterIsNoOil) {
  const SlickLayer layer = weathered_layer(3600.0, 1.0);
  const SlickElement& e = layer.elements()[0];
  EXPECT_GT(e.water, 0.4);
  EXPECT_EQ(layer.ledger().balance(), 0);
  const double oil = to_kilograms(e.mass) / layer.settings().oil.density;
  EXPECT_NEAR(layer.statistics().volume, oil / (1.0 - e.water), 1e-9);
  EXPECT_NEAR(layer.statistics().emulsion_water, layer.statistics().volume - oil, 1e-9);
  EXPECT_GT(layer.statistics().mean_viscosity, kinematic_viscosity(layer.settings().oil));
}

TEST(SlickWeathering, CanBeSwitchedOff) {
  SlickLayer layer(plain_settings());
  ASSERT_FALSE(layer.release(10.0, {0.0, 0.0}, 2.0));
  run(layer, PlacedSurroundings(moving({0.0, 0.0}, {20.0, 0.0})), 60.0, 1.0);
  EXPECT_EQ(layer.ledger().evaporated, 0);
  EXPECT_EQ(layer.elements()[0].water, 0.0);
}

TEST(SlickWeathering, GasolineVanishes) {
  SlickSettings settings;
  settings.oil = find_oil("gasoline").value();
  SlickLayer layer(settings);
  release_disc(layer, 1.0, {0.0, 0.0}, 1.0, 10);
  run(layer, PlacedSurroundings(moving({0.0, 0.0}, {10.0, 0.0})), 24.0 * 3600.0, 10.0);
  EXPECT_EQ(layer.ledger().evaporated, to_milligrams(1.0));
  EXPECT_TRUE(layer.elements().empty());
}

}  // namespace
}  // namespace pelagos
