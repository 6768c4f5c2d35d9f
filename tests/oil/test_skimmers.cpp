#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "slick_fixture.hpp"

namespace pelagos {
namespace {

SlickSettings resting() {
  SlickSettings settings = plain_settings();
  settings.terminal_thickness = 10.0;
  return settings;
}

TEST(Skimmers, WorkAtTheirRateWhereThereIsOil) {
  const SlickSettings settings = resting();
  SlickLayer layer(settings);
  ASSERT_FALSE(layer.release(1e5, {0.0, 0.0}, 10.0));
  ASSERT_FALSE(layer.set_skimmer("s", {{0.0, 0.0}, 3.0, 36.0}));  // 36 m3/h are 10 l/s
  run(layer, PlacedSurroundings(), 60.0, 1.0);
  const SkimmerReport& report = layer.state().skimmers.at("s").report;
  EXPECT_NEAR(to_kilograms(report.recovered), 0.6 * settings.oil.density, 1e-3);
  EXPECT_NEAR(report.present_rate, 36.0, 1e-6);
  EXPECT_FALSE(report.dry);
  EXPECT_EQ(layer.ledger().recovered, report.recovered);
  EXPECT_EQ(layer.ledger().balance(), 0);
}

TEST(Skimmers, TakeNoMoreThanLiesUnderThem) {
  const SlickSettings settings = resting();
  SlickLayer layer(settings);
  ASSERT_FALSE(layer.release(10.0, {0.0, 0.0}, 10.0));
  ASSERT_FALSE(layer.set_skimmer("s", {{0.0, 0.0}, 1.0, 1e5}));
  layer.advance(1.0, PlacedSurroundings());
  EXPECT_NEAR(to_kilograms(layer.ledger().recovered), 10.0 * 0.01, 1e-5);  // a hundredth of the disc's area
}

TEST(Skimmers, ReportThatTheyAreDry) {
  SlickLayer layer(resting());
  ASSERT_FALSE(layer.release(10.0, {100.0, 0.0}, 1.0));
  ASSERT_FALSE(layer.set_skimmer("s", {{0.0, 0.0}, 2.0, 20.0}));
  layer.advance(1.0, PlacedSurroundings());
  EXPECT_TRUE(layer.state().skimmers.at("s").report.dry);
  EXPECT_EQ(layer.ledger().recovered, 0);
  ASSERT_FALSE(layer.set_skimmer("s", {{0.0, 0.0}, 2.0, 0.0}));  // switched off: not dry
  layer.advance(1.0, PlacedSurroundings());
  EXPECT_FALSE(layer.state().skimmers.at("s").report.dry);
}

TEST(Skimmers, KeepTheirCountWhenTheyMove) {
  SlickLayer layer(resting());
  ASSERT_FALSE(layer.release(1000.0, {0.0, 0.0}, 5.0));
  ASSERT_FALSE(layer.set_skimmer("s", {{0.0, 0.0}, 2.0, 20.0}));
  layer.advance(10.0, PlacedSurroundings());
  const Milligrams before = layer.state().skimmers.at("s").report.recovered;
  ASSERT_FALSE(layer.set_skimmer("s", {{50.0, 0.0}, 2.0, 20.0}));
  layer.advance(10.0, PlacedSurroundings());
  EXPECT_EQ(layer.state().skimmers.at("s").report.recovered, before);
  layer.remove_skimmer("s");
  EXPECT_EQ(layer.ledger().recovered, before);
  EXPECT_TRUE(layer.state().skimmers.empty());
  layer.remove_skimmer("t");
  EXPECT_EQ(layer.ledger().recovered, before);
}

TEST(Skimmers, TakeEmulsionWithItsWater) {
  SlickSettings settings = resting();
  settings.emulsification = true;
  SlickLayer layer(settings);
  ASSERT_FALSE(layer.release(1e5, {0.0, 0.0}, 10.0));
  run(layer, PlacedSurroundings(moving({0.0, 0.0}, {10.0, 0.0})), 3600.0, 60.0);
  ASSERT_FALSE(layer.set_skimmer("s", {centre_of_mass(layer), 5.0, 36.0}));
  layer.advance(10.0, PlacedSurroundings());
  const SkimmerReport& report = layer.state().skimmers.at("s").report;
  const double oil = to_kilograms(report.recovered) / settings.oil.density;
  EXPECT_NEAR(oil + report.emulsion_water, 0.1, 1e-6);
  EXPECT_NEAR(report.emulsion_water / 0.1, layer.elements()[0].water, 1e-6);
}

TEST(Skimmers, ClearASlickToTheLastMilligram) {
  SlickLayer layer(resting());
  release_disc(layer, 50.0, {0.0, 0.0}, 3.0, 20);
  ASSERT_FALSE(layer.set_skimmer("s", {{0.0, 0.0}, 20.0, 1000.0}));
  run(layer, PlacedSurroundings(), 10.0, 1.0);
  EXPECT_TRUE(layer.elements().empty());
  EXPECT_EQ(layer.ledger().recovered, to_milligrams(50.0));
}

TEST(Skimmers, RefuseWhatIsNoSkimmer) {
  SlickLayer layer(resting());
  EXPECT_EQ(text_of(layer.set_skimmer("s", {{0.0, 0.0}, 0.0, 20.0})), "radius: 0; allowed: above 0 m, up to 1e6 m");
  EXPECT_EQ(text_of(layer.set_skimmer("s", {{0.0, 0.0}, 1.0, -1.0})), "rate: -1; allowed: 0 m3/h to 1e6 m3/h");
  EXPECT_EQ(text_of(layer.set_skimmer("s", {{2e8, 0.0}, 1.0, 1.0})), "position.x: 200000000; allowed: -1e8 m to 1e8 m");
  EXPECT_TRUE(layer.state().skimmers.empty());
}

}  // namespace
}  // namespace pelagos
