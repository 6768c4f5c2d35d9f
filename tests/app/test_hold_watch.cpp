#include "hold_watch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pelagos {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(HoldWatch, TellsOnceWhenWaterGetsInAndOnceWhenItIsOut) {
  HoldWatch watch;
  const auto look = [&](double water) { return watch.look(std::vector<HoldReading>{{7, 10.0, water}}); };
  EXPECT_THAT(look(0.0), IsEmpty());
  EXPECT_THAT(look(0.4), IsEmpty());
  EXPECT_THAT(look(0.6), ElementsAre(HasSubstr("body 7: water has got into its hold: 0.6 of 10 m^3")));
  EXPECT_THAT(look(5.0), IsEmpty());
  EXPECT_THAT(look(0.3), IsEmpty());
  EXPECT_THAT(look(0.1), ElementsAre(HasSubstr("body 7: its hold is dry again")));
}

TEST(HoldWatch, TakesTheStartAsKnown) {
  HoldWatch watch;
  EXPECT_THAT(watch.look(std::vector<HoldReading>{{1, 10.0, 9.0}}), IsEmpty());
  EXPECT_THAT(watch.look(std::vector<HoldReading>{{1, 10.0, 9.0}}), IsEmpty());
}

}  // namespace
}  // namespace pelagos
