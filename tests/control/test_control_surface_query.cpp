#include <limits>

#include "control_fixture.hpp"

namespace pelagos {
namespace {

using test::Error;
using test::RawStation;
using test::Request;
using testing::HasSubstr;

class SurfaceQueryLink : public test::ControlTest {
 protected:
  static Request request_for(const std::vector<Eigen::Vector2d>& places, double ahead = 0.0) {
    Request request;
    request.set_id(9);
    auto& query = *request.mutable_query_surface();
    if (ahead != 0.0) query.set_ahead(ahead);
    for (const Eigen::Vector2d& place : places) {
      auto& out = *query.add_place();
      out.set_x(place.x());
      out.set_y(place.y());
    }
    return request;
  }
  proto::v1::Response ask(const std::vector<Eigen::Vector2d>& places, double ahead = 0.0) {
    RawStation station(port());
    const auto reply = station.ask(request_for(places, ahead));
    EXPECT_TRUE(reply && reply->has_response());
    return reply ? reply->response() : proto::v1::Response();
  }
  void expect_refused(const std::vector<Eigen::Vector2d>& places, double ahead, const std::string& field,
                      const std::string& allowed) {
    const auto reply = ask(places, ahead);
    EXPECT_EQ(reply.id(), 9u);
    EXPECT_EQ(reply.error().code(), Error::INVALID_VALUE);
    EXPECT_EQ(reply.error().field(), field);
    EXPECT_THAT(reply.error().message(), HasSubstr(allowed));
    expect_unharmed();
  }
};

TEST_F(SurfaceQueryLink, AnswersEveryPlaceInOrderWithItsSource) {
  using Reading = proto::v1::SurfaceAtPlace;
  status_.simulation_time = 12.25;
  const auto reply = ask({{8, 0}, {60, 1}, {400, -3}, {-2000, 0}});
  EXPECT_EQ(reply.id(), 9u);
  ASSERT_TRUE(reply.has_surface_answer());
  const auto& answer = reply.surface_answer();
  EXPECT_EQ(answer.simulation_time(), 12.25);
  ASSERT_EQ(answer.place_size(), 4);
  EXPECT_EQ(answer.place(0).source(), Reading::PARTICLES);
  EXPECT_EQ(answer.place(1).source(), Reading::BLENDED);
  EXPECT_EQ(answer.place(2).source(), Reading::WAVE_FIELD);
  EXPECT_EQ(answer.place(3).source(), Reading::NO_WATER);
  EXPECT_FALSE(answer.place(3).has_height());
  EXPECT_EQ(answer.place(2).height(), 100.0);
  EXPECT_DOUBLE_EQ(-answer.place(2).normal().x() / answer.place(2).normal().z(), 0.25);
  EXPECT_EQ(answer.place(0).velocity().x(), 1.5);
  EXPECT_EQ(answer.place(0).velocity().z(), 0.125);
  EXPECT_EQ(ask({{8, 0}}, 2.5).surface_answer().simulation_time(), 14.75);
  EXPECT_TRUE(commands().empty()) << "a question is no command";
}

TEST_F(SurfaceQueryLink, TakesAThousandPlacesAndNoMore) {
  EXPECT_EQ(ask(std::vector<Eigen::Vector2d>(1000, {1, 2})).surface_answer().place_size(), 1000);
  expect_refused(std::vector<Eigen::Vector2d>(1001, {1, 2}), 0.0, "query_surface.place",
                 "1001 places are given; allowed: 1 to 1000");
  expect_refused({}, 0.0, "query_surface.place", "0 places are given; allowed: 1 to 1000");
}

TEST_F(SurfaceQueryLink, RefusesWhatIsNowhereOrTooFarAhead) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  expect_refused({{1, 2}, {0, nan}}, 0.0, "query_surface.place[1].y", "nan is out of range; allowed: -100000");
  expect_refused({{infinity, 0}}, 0.0, "query_surface.place[0].x", "inf is out of range");
  expect_refused({{0, 0}}, 5.5, "query_surface.ahead", "5.5 is out of range; allowed: 0 to 5 s");
  expect_refused({{0, 0}}, nan, "query_surface.ahead", "nan is out of range");
}

TEST_F(SurfaceQueryLink, TellsWhyThereIsNoAnswer) {
  refusal_ = "32 queries wait for their answers";
  const auto reply = ask({{1, 2}});
  EXPECT_EQ(reply.error().code(), Error::REFUSED);
  EXPECT_EQ(reply.error().message(), "32 queries wait for their answers");
  expect_unharmed();
}

TEST_F(SurfaceQueryLink, KeepsTheOrderOfAnswers) {
  RawStation station(port());
  ASSERT_TRUE(station.send(request_for({{1, 2}})));
  ASSERT_TRUE(station.send(request_for({{1, 2}}, 9.0)));
  Request status;
  status.set_id(10);
  status.mutable_get_status();
  ASSERT_TRUE(station.send(status));
  EXPECT_TRUE(station.read()->response().has_surface_answer());
  EXPECT_TRUE(station.read()->response().has_error());
  EXPECT_TRUE(station.read()->response().has_status());
}

TEST_F(SurfaceQueryLink, AFaultOfTheServerIsToldAsOne) {
  throws_ = true;
  EXPECT_EQ(ask({{1, 2}}).error().code(), Error::INTERNAL);
}

}  // namespace
}  // namespace pelagos
