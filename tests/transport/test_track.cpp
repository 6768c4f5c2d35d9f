#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "../support/places.hpp"
#include "track.hpp"

namespace pelagos::example {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::optional<FileTrack> read(const std::string& text, std::string* error = nullptr) {
  std::istringstream input(text);
  std::string message;
  auto track = read_track(input, "track.csv", message);
  if (error != nullptr) *error = message;
  return track;
}

std::string error_of(const std::string& text) {
  std::string error;
  EXPECT_FALSE(read(text, &error));
  return error;
}

TEST(TrackFile, ReadsColumnsByName) {
  const auto track = read("# a comment\nnorth, east,time,heading_deg,roll_deg,wind\n2,1,10,350,5,x\n\n4,3,12,10,7,x\n");
  ASSERT_TRUE(track);
  ASSERT_EQ(track->points.size(), 2U);
  EXPECT_EQ(track->points[0].time, 0.0);  // shifted
  EXPECT_EQ(track->points[1].time, 2.0);
  const Track whole{*track, {}};
  const ShipState middle = state_at(whole, 1.0);
  EXPECT_DOUBLE_EQ(middle.east, 2.0);
  EXPECT_DOUBLE_EQ(middle.north, 3.0);
  EXPECT_DOUBLE_EQ(middle.heading_deg, 360.0);  // the short way from 350 to 10
  EXPECT_DOUBLE_EQ(middle.roll_deg, 6.0);
  EXPECT_DOUBLE_EQ(end_of(whole), 2.0);
  for (const double time : {0.0, 1.0, 2.0}) {  // 1 m/s north and east, at the ends too
    const NedMotion motion = motion_at(whole, time);
    EXPECT_NEAR(motion.velocity.x(), 1.0, 1e-9) << time;  // rounding of a difference over 1 ms
    EXPECT_NEAR(motion.velocity.y(), 1.0, 1e-9) << time;
  }
  EXPECT_EQ(motion_at(whole, 5.0).velocity, Eigen::Vector3d::Zero());
}

TEST(TrackFile, RefusesWithLineAndReason) {
  EXPECT_THAT(error_of(""), HasSubstr("no waypoints"));
  EXPECT_THAT(error_of("time,east,north\n"), HasSubstr("track.csv:1: column 'heading_deg' is missing"));
  const std::string header = "time,east,north,heading_deg\n";
  EXPECT_THAT(error_of(header), HasSubstr("no waypoints"));
  EXPECT_THAT(error_of(header + "0,1,2\n"), HasSubstr("track.csv:2: 3 fields"));
  EXPECT_THAT(error_of(header + "0,1,two,3\n"), HasSubstr("track.csv:2: north is 'two'"));
  EXPECT_THAT(error_of(header + "0,nan,2,3\n"), HasSubstr("east is 'nan'"));
  EXPECT_THAT(error_of(header + "0,1e6,2,3\n"), HasSubstr("allowed: a number within +-100000"));
  EXPECT_THAT(error_of(header + "0,1,2,3\n0,1,2,3\n"), HasSubstr("track.csv:3: time must increase"));
}

/// One waypoint after another that starts at 0 and ends at east 1.5, north -2, heading 90.
void expect_read(const std::string& text) {
  std::string error;
  const auto track = read(text, &error);
  ASSERT_TRUE(track) << text << error;
  ASSERT_EQ(track->points.size(), 2U) << text;
  EXPECT_EQ(track->points[1].time, 2.5) << text;
  EXPECT_EQ(track->points[1].east, 1.5) << text;
  EXPECT_EQ(track->points[1].north, -2.0) << text;
  EXPECT_EQ(track->points[1].heading_deg, 90.0) << text;
}

TEST(TrackFile, ReadsWhatSpreadsheetsWrite) {
  expect_read("\xEF\xBB\xBFtime,east,north,heading_deg\r\n0,0,0,0\r\n2.5,1.5,-2,090\r\n");
  expect_read("\xEF\xBB\xBFTime;East;North;Heading_deg\r\n0;0;0;0\r\n2,5;1,5;-2;90,0\r\n;;;\r\n");
  expect_read("sep=;\r\ntime;east;north;heading_deg;;\r\n0;0;0;0;;\r\n2,5;1.5;-2;90;;\r\n");
  expect_read("time\teast\tnorth\theading_deg\n0\t0\t0\t0\n2,5\t1,5\t-2\t90\n");
  expect_read(
      "\"time\",\"east\",\"north\",\"heading_deg\",\"a,b\"\n\"0\",0,0,0,\n\"2.5\", 1.5 ,-2,\"90\",\"c,d\"\n\n\n");
  expect_read("TIME , EAST , NORTH , HEADING_DEG \n0,0,0,0\n2.5,1.5,-2,90   \n   \n,,,\n");
}

TEST(TrackFile, NamesWhatItCannotRead) {
  const std::string header = "time,east,north,heading_deg\n";
  EXPECT_THAT(error_of(header + "0,0,0,0\n1,0,5,0,90\n"),
              AllOf(HasSubstr("track.csv:3: 5 fields; the line of names has 4"), HasSubstr("decimal commas?")));
  EXPECT_THAT(error_of(header + "0,\"0,5\",0,0\n"),
              HasSubstr("track.csv:2: east is '0,5' (a decimal comma; write 0.5)"));
  EXPECT_THAT(error_of(header + "0,0,0,90 deg\n"), HasSubstr("heading_deg is '90 deg'"));
  EXPECT_THAT(error_of(header + "0,0x10,0,0\n"), HasSubstr("east is '0x10' (hexadecimal)"));
  EXPECT_THAT(error_of(header + "0,0,0,−9\n"), HasSubstr("minus sign"));
  EXPECT_THAT(error_of(header + "00:00:01,0,0,0\n"), HasSubstr("time is '00:00:01'"));
  EXPECT_THAT(error_of(header + "0,0,0,0\r1,0,0,0\r"), HasSubstr("track.csv:2: a carriage return"));
  EXPECT_THAT(error_of("time;east;north;heading_deg\n0;1.234,5;0;0\n"), HasSubstr("track.csv:2: east is '1.234,5'"));
  EXPECT_THAT(error_of("zeit,east,north,heading_deg\n"),
              AllOf(HasSubstr("column 'time' is missing; this line names zeit, east"), HasSubstr("needed: time")));
  EXPECT_THAT(error_of("time,east,north,heading\n"),
              HasSubstr("column 'heading' is not known; did you mean 'heading_deg'?"));
  EXPECT_THAT(error_of("time,east,north,heading_deg,pitch\n0,0,0,0,5\n"), HasSubstr("did you mean 'pitch_deg'?"));
  EXPECT_THAT(error_of("time,time,east,north,heading_deg\n"), HasSubstr("column 'time' is named twice"));
  EXPECT_THAT(error_of(std::string("\xFF\xFEt\0i\0m\0e\0", 10)),
              HasSubstr("track.csv:1: the file is encoded as UTF-16"));
}

TEST(OvalTrackTest, LapTakesCircumferenceOverSpeed) {
  const double lap = 2.0 * 3.14159265358979 * 5.0 / 2.0;
  const Track track{OvalTrack{1.0, 2.0, 5.0, 5.0, 2.0, 0.5}, {}};
  EXPECT_NEAR(state_at(track, 0.0).north, 7.0, 1e-12);
  EXPECT_NEAR(state_at(track, 0.0).heading_deg, 90.0, 1e-9);
  EXPECT_NEAR(state_at(track, lap / 4.0).east, 6.0, 1e-9);
  EXPECT_NEAR(state_at(track, lap / 4.0).heading_deg, 180.0, 1e-9);
  EXPECT_NEAR(state_at(track, lap).east, 1.0, 1e-9);
  EXPECT_EQ(state_at(track, 3.0).up, 0.5);
  // Turning to starboard: positive yaw rate in NED, speed / radius. The error of the difference is of order 1e-6.
  EXPECT_NEAR(motion_at(track, 1.0).angular_rate_body.z(), 0.4, 1e-5);
}

TEST(OvalTrackTest, SpeedsUpFromRestEvenly) {
  OvalTrack oval{0.0, -300.0, 300.0, 300.0, 6.0, 0.0};
  oval.speed_up = 20.0;
  const Track track{oval, {}};
  const auto speed = [&](double time) { return motion_at(track, time).velocity.norm(); };
  EXPECT_NEAR(speed(0.01), 0.003, 1e-3);
  EXPECT_NEAR(speed(10.0), 3.0, 1e-3);
  EXPECT_NEAR(speed(20.5), 6.0, 1e-3);
  EXPECT_NEAR(speed(200.0), 6.0, 1e-3);
  EXPECT_NEAR(state_at(track, 20.0).east, 300.0 * std::sin(60.0 / 300.0), 1e-6);  // half of 6 m/s for 20 s
}

TEST(OvalTrackTest, SeaMotionHasItsAmplitudes) {
  const Track track{OvalTrack{}, {0.1, 1.5, 3.0}};
  double up = 0.0;
  double pitch = 0.0;
  double roll = 0.0;
  for (double time = 0.0; time < 30.0; time += 0.01) {
    up = std::max(up, std::abs(state_at(track, time).up));
    pitch = std::max(pitch, std::abs(state_at(track, time).pitch_deg));
    roll = std::max(roll, std::abs(state_at(track, time).roll_deg));
  }
  EXPECT_NEAR(up, 0.1, 1e-4);  // sampled every 10 ms: the peak may be missed by (pi / 6.3 * 0.01)^2
  EXPECT_NEAR(pitch, 1.5, 1e-3);
  EXPECT_NEAR(roll, 3.0, 1e-3);
}

TEST(ShippedTrack, LaysTheCoasterAlongsideTheQuayAtASeamanlikeSpeed) {
  std::ifstream file(test::source_path("examples/bridge/tracks/alongside.csv"));
  std::string error;
  const auto path = read_track(file, "alongside.csv", error);
  ASSERT_TRUE(path) << error;
  const Track track{*path, {}};
  for (double time = 0.0; time <= end_of(track); time += 0.25) {
    const ShipState ship = state_at(track, time);
    const NedMotion motion = motion_at(track, time);
    EXPECT_LT(motion.velocity.norm(), 1.2) << time;
    EXPECT_LT(std::abs(motion.angular_rate_body.z()), 0.02) << time;
    // Half a beam of 4.5 m and half a length of 18 m: a box around the hull stays clear of the quay's face at 20 m.
    const double turn = (90.0 - ship.heading_deg) * EIGEN_PI / 180.0;
    EXPECT_LT(ship.north + 4.5 * std::cos(turn) + 18.0 * std::sin(turn), 20.0 - 1.0) << time;
  }
  const NedMotion rest = motion_at(track, end_of(track) - 5.0);
  EXPECT_LT(rest.velocity.norm(), 1e-6);
}

}  // namespace
}  // namespace pelagos::example
