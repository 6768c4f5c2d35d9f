#include <limits>

#include "control_fixture.hpp"

namespace pelagos {
namespace {

using test::Error;
using test::RawStation;
using test::Request;
using testing::HasSubstr;

class WindQuery : public test::ControlTest {
 protected:
  proto::v1::Response ask(const std::vector<Eigen::Vector3d>& places) {
    Request request;
    request.set_id(9);
    auto& query = *request.mutable_query_wind();
    for (const Eigen::Vector3d& place : places) {
      auto& position = *query.add_position();
      position.set_x(place.x());
      position.set_y(place.y());
      position.set_z(place.z());
    }
    RawStation station(port());
    const auto reply = station.ask(request);
    EXPECT_TRUE(reply && reply->has_response());
    return reply ? reply->response() : proto::v1::Response();
  }
  void expect_refused(const std::vector<Eigen::Vector3d>& places, const std::string& field,
                      const std::string& allowed) {
    const auto reply = ask(places);
    EXPECT_EQ(reply.error().code(), Error::INVALID_VALUE);
    EXPECT_EQ(reply.error().field(), field);
    EXPECT_THAT(reply.error().message(), HasSubstr(allowed));
    expect_unharmed();
  }
};

TEST_F(WindQuery, AnswersEveryPlaceInOrderWithTheTimeOfTheAir) {
  status_.simulation_time = 12.25;
  const auto reply = ask({{3, -4, 10}, {0, 0, -1}, {-6, 0, 2}});
  EXPECT_EQ(reply.id(), 9u);
  ASSERT_TRUE(reply.has_wind_reading());
  const auto& reading = reply.wind_reading();
  EXPECT_EQ(reading.simulation_time(), 12.25);
  ASSERT_EQ(reading.place_size(), 3);
  EXPECT_EQ(reading.place(0).velocity().x(), 3.0);
  EXPECT_EQ(reading.place(0).velocity().y(), -4.0);
  EXPECT_EQ(reading.place(0).velocity().z(), 0.5);
  EXPECT_DOUBLE_EQ(reading.place(0).speed(), 5.0);
  EXPECT_NEAR(reading.place(0).from_deg(), 323.130102, 1e-6);  // towards the south-east, 3 east to 4 south
  EXPECT_TRUE(reading.place(1).has_velocity());
  EXPECT_EQ(reading.place(1).speed(), 0.0);
  EXPECT_FALSE(reading.place(1).has_from_deg());
  EXPECT_NEAR(reading.place(2).from_deg(), 90.0, 1e-9);
  EXPECT_TRUE(commands().empty()) << "a question is no command";
}

TEST_F(WindQuery, TakesAHundredPlacesAndNoMore) {
  EXPECT_EQ(ask(std::vector<Eigen::Vector3d>(100, {1, 2, 3})).wind_reading().place_size(), 100);
  expect_refused(std::vector<Eigen::Vector3d>(101, {1, 2, 3}), "query_wind.position",
                 "101 places are given; allowed: 1");
  expect_refused({}, "query_wind.position", "0 places are given; allowed: 1 to 100");
}

TEST_F(WindQuery, RefusesPlacesThatAreNowhere) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(ask({{1e6, -1e6, 1e6}}).has_wind_reading());
  expect_refused({{1, 2, 3}, {0, nan, 0}}, "query_wind.position[1].y", "nan is out of range; allowed: -1000000");
  expect_refused({{infinity, 0, 0}}, "query_wind.position[0].x", "allowed: -1000000 to 1000000 m");
  expect_refused({{0, 0, 1.1e6}}, "query_wind.position[0].z", "1100000 is out of range");
}

TEST_F(WindQuery, AFaultOfTheServerIsToldAsOne) {
  throws_ = true;
  EXPECT_EQ(ask({{1, 2, 3}}).error().code(), Error::INTERNAL);
}

}  // namespace
}  // namespace pelagos
