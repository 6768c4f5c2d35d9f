// What an operator is told of sources that wait and skimmers that run dry.

#include "spill_watch.hpp"

#include <gmock/gmock.h>

namespace pelagos {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kFrame = 1.0 / 30.0;

/// Frames from `begin` to `end` that all show the same; what was told, as "kind: text".
class Frames {
 public:
  std::vector<std::string> show(const OilBudget& oil, double begin, double end) {
    std::vector<std::string> told;
    for (double t = begin; t < end; t += kFrame)
      for (const CommandNews& news : watch_.observe(oil, t)) told.push_back(news.kind + ": " + news.text);
    return told;
  }

 private:
  SpillWatch watch_;
};

OilBudget with_source(SourceWait wait, double waiting, double pending = 83.0) {
  OilBudget oil;
  oil.sources = {{"leak", wait, waiting, pending}};
  return oil;
}

OilBudget with_skimmer(bool dry, double rate = 12.0) {
  OilBudget oil;
  oil.skimmers = {{"rig", 1'500'000, dry ? 0.0 : rate, dry}};
  return oil;
}

TEST(SpillWatch, SaysNothingOfOilThatFlows) {
  Frames frames;
  EXPECT_THAT(frames.show({}, 0.0, 10.0), IsEmpty());
  EXPECT_THAT(frames.show(with_source(SourceWait::kNone, 0.0), 10.0, 20.0), IsEmpty());
  EXPECT_THAT(frames.show(with_skimmer(false), 20.0, 30.0).size(), 1U) << "the source has ended, and no more";
}

TEST(SpillWatch, TellsOnceThatASourceWaitsAndWhy) {
  Frames frames;
  EXPECT_THAT(frames.show(with_source(SourceWait::kNoWater, 4.9), 0.0, 1.0), IsEmpty());
  const auto told = frames.show(with_source(SourceWait::kNoWater, 5.0), 1.0, 9.0);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_THAT(told[0], AllOf(HasSubstr("release_waits: source \"leak\""), HasSubstr("for 5 s"),
                             HasSubstr("no water near it"), HasSubstr("83 kg wait")));
  EXPECT_THAT(frames.show(with_source(SourceWait::kNone, 0.0), 9.0, 12.0),
              testing::ElementsAre("release_flows: source \"leak\" flows again"));
  EXPECT_EQ(frames.show(with_source(SourceWait::kFull, 6.0), 12.0, 13.0).size(), 1U) << "and again";
  EXPECT_THAT(frames.show(with_source(SourceWait::kOutside, 7.0), 13.0, 14.0), IsEmpty()) << "it waits still";
}

TEST(SpillWatch, TellsThatASourceHasEndedAndWhatItKept) {
  Frames frames;
  frames.show(with_source(SourceWait::kNone, 0.0), 0.0, 1.0);
  OilBudget after;
  after.held_back = 12.5;
  EXPECT_THAT(frames.show(after, 1.0, 2.0),
              testing::ElementsAre("release_ended: source \"leak\" has ended; 12.5 kg could not flow out"));
  frames.show(with_source(SourceWait::kNone, 0.0), 2.0, 3.0);
  EXPECT_THAT(frames.show({}, 3.0, 4.0), testing::ElementsAre("release_ended: source \"leak\" has ended"));
}

TEST(SpillWatch, TellsOnceThatASkimmerIsDryAndThatItTakesOilAgain) {
  Frames frames;
  EXPECT_THAT(frames.show(with_skimmer(true), 0.0, 4.9), IsEmpty());
  const auto told = frames.show(with_skimmer(true), 4.9, 20.0);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_THAT(told[0], AllOf(HasSubstr("skimmer_dry: skimmer \"rig\""), HasSubstr("recovered 1.5 kg")));
  EXPECT_THAT(frames.show(with_skimmer(false), 20.0, 24.0), IsEmpty());
  EXPECT_THAT(frames.show(with_skimmer(false), 24.0, 40.0),
              testing::ElementsAre("skimmer_oil: skimmer \"rig\" takes oil again, 12 m^3/h"));
}

TEST(SpillWatch, DoesNotTellEveryGapInTheOil) {
  Frames frames;
  for (int k = 0; k < 20; ++k)
    EXPECT_THAT(frames.show(with_skimmer(k % 2 == 0), 3.0 * k, 3.0 * (k + 1)), IsEmpty()) << k;
}

TEST(SpillWatch, ASkimmerThatIsSwitchedOffTakesNoOil) {
  Frames frames;
  EXPECT_EQ(frames.show(with_skimmer(true), 0.0, 10.0).size(), 1U);
  EXPECT_THAT(frames.show(with_skimmer(false, 0.0), 10.0, 20.0), IsEmpty());
  EXPECT_EQ(frames.show(with_skimmer(true), 20.0, 30.0).size(), 1U) << "on and dry once more";
}

}  // namespace
}  // namespace pelagos
