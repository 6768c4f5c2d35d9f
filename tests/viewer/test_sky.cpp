#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderer/sky.hpp"

namespace pelagos {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kJune = 1'782'000'000.0;  // 2026-06-21 00:00 UTC

TEST(Sky, PutsTheSunWhereTheAlmanacDoes) {
  // Summer solstice at Greenwich: noon at 12:02, 61.96 degrees up in the south (90 - 51.48 + 23.44).
  const SunPlace noon = sun_place(kJune + 12.03 * 3600.0, 51.48, 0.0);
  EXPECT_NEAR(noon.elevation / kDegree, 61.96, 0.05);
  EXPECT_NEAR(std::abs(noon.azimuth) / kDegree, 180.0, 1.0);
  // Sunrise there at 03:43 UTC with the upper limb and refraction: the centre stands 0.83 degrees below the horizon.
  EXPECT_NEAR(sun_place(kJune + 3.72 * 3600.0, 51.48, 0.0).elevation / kDegree, -0.83, 0.25);
  EXPECT_NEAR(sun_place(kJune + 3.72 * 3600.0, 51.48, 0.0).azimuth / kDegree, 49.0, 1.0) << "north-east";
  // Six hours of longitude further east it is noon at 06:02.
  EXPECT_NEAR(sun_place(kJune + 6.03 * 3600.0, 51.48, 90.0).elevation / kDegree, 61.96, 0.05);
  // On the southern tropic in June the sun stands in the north.
  EXPECT_NEAR(sun_place(kJune + 12.03 * 3600.0, -23.44, 0.0).azimuth / kDegree, 0.0, 1.0);
}

TEST(Sky, GetsDarkAndRedWithTheSun) {
  const GeodeticOrigin origin{51.48, 0.0, 0.0};
  const auto at = [&](double hour) { return sky_at({.utc = kJune + hour * 3600.0}, origin, 0.0); };
  const SkyMoment noon = at(12.0), evening = at(19.8), night = at(24.0);
  EXPECT_GT(noon.sun_strength, 1.0);
  EXPECT_LT(evening.sun_strength, 0.6 * noon.sun_strength);
  EXPECT_GT(evening.sun_colour.x(), 1.1 * evening.sun_colour.z());
  EXPECT_EQ(night.sun_strength, 0.0);
  EXPECT_LT(night.daylight, 0.1);
  EXPECT_GT(night.daylight, 0.0);
  EXPECT_NEAR(night.sun.norm(), 1.0, 1e-12);
}

TEST(Sky, MovesOnWithTheSimulation) {
  const GeodeticOrigin origin{0.0, 0.0, 0.0};
  const Weather morning{.utc = kJune + 8.0 * 3600.0}, fixed;
  EXPECT_FALSE(sky_at(morning, origin, 600.0).looks_like(sky_at(morning, origin, 0.0)));
  EXPECT_TRUE(sky_at(morning, origin, 5.0).looks_like(sky_at(morning, origin, 0.0)));
  EXPECT_TRUE(sky_at(fixed, origin, 1e6).looks_like(sky_at(fixed, origin, 0.0)));
  EXPECT_NEAR(sky_at(fixed, origin, 0.0).sun_strength, 1.25, 1e-9);
}

TEST(Sky, LosesTheSunInCloudsAndFog) {
  const GeodeticOrigin origin;
  EXPECT_LT(sky_at({.cloud_oktas = 8.0}, origin, 0.0).sun_strength, 0.05);
  EXPECT_LT(sky_at({.visibility = 200.0}, origin, 0.0).sun_strength, 0.1);
}

}  // namespace
}  // namespace pelagos
