// What deploy/demo says of a run: failures and shortfalls.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run_summary.hpp"

namespace pelagos {
namespace {

using nlohmann::ordered_json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// A run in which all worked.
RunFiles good_run() {
  RunFiles files;
  files.server = {{"particles", 1000},
                  {"speed", {{"real_time_factor", 1.0}, {"step_ms_mean", 5.0}}},
                  {"transport", {{"frames_published", 300}, {"frames_dropped", 0}, {"poses_accepted", 280}}}};
  files.channels = {{{"channel", "port"},
                     {"frames_drawn", 20},
                     {"frames_received", 290},
                     {"gaps", 0},
                     {"pictures_written", 2},
                     {"errors", ordered_json::array()}}};
  files.poses = {281, 0};
  files.pictures = {{"port.png", 640, 360, 100000}};
  files.status_before = {{"wind", {{"speed", 9.0}}}};
  files.status_after = {{"wind", {{"speed", 15.0}}}};
  return files;
}

TEST(RunSummary, FindsNothingWrongWithAGoodRun) {
  EXPECT_THAT(find_failures(good_run()), IsEmpty());
  EXPECT_THAT(find_shortfalls(good_run()), IsEmpty());
}

TEST(RunSummary, TellsOfASeaSlowerThanRealTime) {
  RunFiles files = good_run();
  files.server["speed"]["real_time_factor"] = 0.93;
  EXPECT_THAT(find_failures(files), IsEmpty());
  EXPECT_THAT(find_shortfalls(files), ElementsAre(HasSubstr("ran at 0.93 of real time")));
}

TEST(RunSummary, TellsOfFramesThatWereDroppedOrMissed) {
  RunFiles files = good_run();
  files.server["transport"]["frames_dropped"] = 2;
  files.channels[0]["gaps"] = 7;
  EXPECT_THAT(find_shortfalls(files),
              ElementsAre(HasSubstr("2 frames dropped"),
                          AllOf(HasSubstr("viewer port"), HasSubstr("7 of 297 frames"), HasSubstr("socket buffers"))));
}

TEST(RunSummary, BlamesNoSocketsForFramesOfASlowSea) {
  RunFiles files = good_run();
  files.server["speed"]["real_time_factor"] = 0.6;
  files.channels[0]["gaps"] = 7;
  EXPECT_THAT(find_shortfalls(files),
              ElementsAre(HasSubstr("ran at 0.60 of real time"),
                          AllOf(HasSubstr("the processor has too much to do"), Not(HasSubstr("socket")))));
}

TEST(RunSummary, TellsOfAWindThatDidNotRise) {
  RunFiles files = good_run();
  files.status_after["wind"]["speed"] = 9.0;
  EXPECT_THAT(find_failures(files), ElementsAre(HasSubstr("wind did not rise")));
}

}  // namespace
}  // namespace pelagos
