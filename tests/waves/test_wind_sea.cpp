#include "waves/wind_sea.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scales/scales.hpp"

namespace pelagos {
namespace {

constexpr double kGravity = kStandardGravity, kHour = 3600.0;

WindSea after(const WindSea& sea, const WindSeaSettings& settings, const SteadyWind& wind, double seconds) {
  return wind_sea_after(sea, settings, wind, seconds, kGravity);
}

TEST(WindSea, OfAFetchIsThatOfWilson) {
  // 20 m/s over 100 km: g F / U^2 = 2452.5, by hand.
  const WindSea sea = developed_sea({20.0, 250.0}, 100e3, kGravity);
  EXPECT_NEAR(sea.height, 3.711, 0.005);
  EXPECT_NEAR(sea.peak_period, 1.05 * 7.04, 0.02);
  EXPECT_EQ(sea.to_deg, 250.0);
  EXPECT_NEAR(developed_sea({10.0, 0.0}, 1e12, kGravity).height, 0.30 * 100.0 / kGravity, 0.01);
  EXPECT_EQ(developed_sea({0.0, 0.0}, 100e3, kGravity).height, 0.0);
}

TEST(WindSea, NeedsItsTimeToGrow) {
  EXPECT_NEAR(time_to_grow(100e3, 20.0), 7.27 * kHour, 0.01 * kHour);
  for (const double fetch : {2e3, 50e3, 900e3})
    EXPECT_NEAR(fetch_after(time_to_grow(fetch, 13.0), 13.0), fetch, 1e-6 * fetch);
}

TEST(WindSea, GrowsFromNothingToThatOfTheFetch) {
  const WindSeaSettings settings{100e3, 0.0, 1.0};
  const SteadyWind wind{20.0, 90.0};
  WindSea sea = start_wind_sea(settings, wind, kGravity);
  EXPECT_EQ(sea.height, 0.0);
  double last = 0.0;
  for (int minute = 0; minute < 430; ++minute) {
    sea = after(sea, settings, wind, 60.0);
    EXPECT_GE(sea.height, last);
    last = sea.height;
    // After every hour it is the sea of the fetch that needs as long, in however many steps it came.
    if (minute % 60 == 59) {
      EXPECT_NEAR(sea.height, developed_sea(wind, fetch_after(60.0 * (minute + 1), 20.0), kGravity).height, 1e-6);
    }
  }
  for (int minute = 0; minute < 60; ++minute) sea = after(sea, settings, wind, 60.0);
  EXPECT_NEAR(sea.height, developed_sea(wind, 100e3, kGravity).height, 1e-9);
  EXPECT_NEAR(sea.peak_period, developed_sea(wind, 100e3, kGravity).peak_period, 1e-9);
}

TEST(WindSea, ChangesAtThePaceOfTheExercise) {
  const SteadyWind wind{15.0, 0.0};
  const WindSea start = start_wind_sea({200e3, kHour, 1.0}, wind, kGravity);
  const WindSea fast = after(start, {200e3, {}, 20.0}, wind, 180.0), slow = after(start, {200e3, {}, 1.0}, wind, kHour);
  EXPECT_NEAR(fast.height, slow.height, 1e-9);
}

TEST(WindSea, DiesDownAndTurnsAfterTheWind) {
  const WindSea rough{3.0, 8.0, 350.0};
  const WindSea calm = after(rough, {}, {0.0, 0.0}, 6.0 * kHour);
  EXPECT_NEAR(calm.height, 3.0 * std::exp(-1.0), 1e-9);
  EXPECT_EQ(calm.peak_period, 8.0);
  EXPECT_EQ(calm.to_deg, 350.0) << "no wind turns it";
  const WindSea turned = after(rough, {}, {5.0, 30.0}, kHour);
  EXPECT_NEAR(turned.to_deg, 350.0 + 40.0 * (1.0 - std::exp(-1.0)) - 360.0, 1e-9) << "by the short way, over north";
  EXPECT_GT(turned.height, developed_sea({5.0, 30.0}, 300e3, kGravity).height);
}

TEST(WindSea, HasThePeakOfItsAge) {
  EXPECT_EQ(peak_factor({4.0, 6.0, 0.0}), 5.0);
  EXPECT_EQ(peak_factor({4.0, 12.0, 0.0}), 1.0);
  EXPECT_NEAR(peak_factor({4.0, 8.0, 0.0}), std::exp(5.75 - 1.15 * 4.0), 1e-12);
}

}  // namespace
}  // namespace pelagos
