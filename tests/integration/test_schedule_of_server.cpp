// The schedule of a running server, as a viewer follows it: at its pace, through a pause, steps and their end.

#include <gtest/gtest.h>

#include <cmath>

#include "client/frame_receiver.hpp"
#include "still_water_server.hpp"

namespace pelagos {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

class ScheduleOfAServer : public StillWaterServer {
 protected:
  /// The viewer knows the server's clock, and a frame has come.
  [[nodiscard]] bool follows() {
    return eventually([this] {
      take_frames();
      return newest_ && viewer_.clock_state().clock == ViewerClock::kMeasured;
    });
  }
  void take_frames() {
    while (auto frame = viewer_.take_next()) newest_ = std::move(frame);
  }
  [[nodiscard]] double due(std::int64_t after_ns = 0) const {
    return viewer_.due_at(LocalClocks{}.now().clock_ns + after_ns)->scheduled.time;
  }

  FrameReceiver viewer_{settings()};
  std::unique_ptr<OceanFrame> newest_;
};

TEST_F(ScheduleOfAServer, GoesAtThePaceOfItsFrames) {
  ASSERT_TRUE(follows());
  std::this_thread::sleep_for(std::chrono::seconds(4));  // the fit's window
  const std::int64_t begin_ns = LocalClocks{}.now().clock_ns;
  const double begin = viewer_.due_at(begin_ns - kSecond / 10)->scheduled.time;
  std::this_thread::sleep_for(std::chrono::seconds(3));
  const std::int64_t end_ns = LocalClocks{}.now().clock_ns;
  const double end = viewer_.due_at(end_ns - kSecond / 10)->scheduled.time;
  // Paced by the clock, but for what a machine with other work gives up.
  EXPECT_NEAR((end - begin) / (1e-9 * static_cast<double>(end_ns - begin_ns)), 1.0, 0.05);
  take_frames();
  EXPECT_NEAR(due(), newest_->simulation_time, 0.2) << "the schedule is that of the frames";
  EXPECT_TRUE(newest_->completed_ns);
}

TEST_F(ScheduleOfAServer, StopsAtTheLastFrameOfAPauseAndGoesOn) {
  ASSERT_TRUE(follows());
  ask({"pause"});
  ASSERT_TRUE(eventually([&] {
    take_frames();
    return due() == newest_->simulation_time && due(60 * kSecond) == newest_->simulation_time;
  }));
  const double held = newest_->simulation_time;
  ask({"step", "200"});
  ASSERT_TRUE(eventually([&] {
    take_frames();
    return newest_->simulation_time > held && due(60 * kSecond) == newest_->simulation_time;
  }));
  const double stepped = newest_->simulation_time;
  FrameReceiver late(settings());  // one that comes into the pause
  ASSERT_TRUE(eventually([&] { return late.clock_state().clock == ViewerClock::kMeasured; }));
  EXPECT_EQ(late.due_at(LocalClocks{}.now().clock_ns)->scheduled.time, due());
  ask({"resume"});
  EXPECT_TRUE(eventually([&] { return due() > stepped + 0.5; }));
}

}  // namespace
}  // namespace pelagos
