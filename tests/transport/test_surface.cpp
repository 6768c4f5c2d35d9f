// Queries of the surface over DDS: there and back, in both frames, and what is refused.

#include <gmock/gmock.h>

#include <limits>

#include "client/surface_client.hpp"
#include "loopback.hpp"
#include "pelagos_dds/entities.hpp"
#include "transport/surface_link.hpp"
#include "wire/convert.hpp"
#include "wire/topics.hpp"

namespace pelagos {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::HasSubstr;

SurfaceQuery some_query() { return {1.5, {{10.0, -20.0}, {-3000.0, 4000.0}, {0.0, 0.0}}}; }

SurfaceAnswer some_answer() {
  SurfaceAnswer answer{7.25, {}};
  answer.places.push_back({SurfaceSource::kBlended, 1.25, Vector3d(0.1, -0.2, 0.9).normalized(), {0.5, 0.25, -0.125}});
  answer.places.push_back({SurfaceSource::kWaveField, -0.5, Vector3d::UnitZ(), {1.0, 2.0, 3.0}});
  answer.places.push_back({});
  return answer;
}

void expect_same(const SurfaceAnswer& got, const SurfaceAnswer& expected) {
  EXPECT_EQ(got.simulation_time, expected.simulation_time);
  ASSERT_EQ(got.places.size(), expected.places.size());
  for (std::size_t k = 0; k < got.places.size(); ++k) {
    EXPECT_EQ(got.places[k].source, expected.places[k].source);
    EXPECT_EQ(got.places[k].height, expected.places[k].height);
    EXPECT_LT((got.places[k].normal - expected.places[k].normal).norm(), 1e-7) << "single precision";
    EXPECT_EQ(got.places[k].velocity, expected.places[k].velocity);
  }
}

TEST(SurfaceConversion, RoundTripInBothFrames) {
  for (const pelagos_WorldFrame frame : {pelagos_FRAME_ENU, pelagos_FRAME_NED}) {
    const bool ned = frame == pelagos_FRAME_NED;
    const wire::SurfaceQuerySample sample(some_query(), 3, 41, frame);
    EXPECT_EQ(sample.get().places._buffer[0].x, ned ? -20.0 : 10.0);
    const wire::ReceivedSurfaceQuery received = wire::from_wire(sample.get());
    EXPECT_EQ(received.client, 3U);
    EXPECT_EQ(received.number, 41U);
    EXPECT_EQ(received.fault, "");
    EXPECT_EQ(received.query.ahead, 1.5);
    EXPECT_EQ(received.query.places, some_query().places);

    const wire::SurfaceAnswerSample answer({some_answer(), ""}, received, 17);
    const pelagos_SurfaceAnswerV1& wire = answer.get();
    EXPECT_EQ(wire.source, 17U);
    EXPECT_EQ(wire.client, 3U);
    EXPECT_EQ(wire.query, 41U);
    EXPECT_EQ(wire.ahead, 1.5);
    EXPECT_EQ(wire.frame, frame);
    EXPECT_FALSE(wire::find_fault(wire));
    const pelagos_SurfaceAtPlaceV1& first = wire.places._buffer[0];
    EXPECT_EQ(Vector3d(first.surface.x, first.surface.y, first.surface.z),
              ned ? Vector3d(-20.0, 10.0, -1.25) : Vector3d(10.0, -20.0, 1.25));
    EXPECT_EQ(Vector3d(first.velocity.x, first.velocity.y, first.velocity.z),
              ned ? Vector3d(0.25, 0.5, 0.125) : Vector3d(0.5, 0.25, -0.125));
    EXPECT_EQ(first.source, pelagos_SURFACE_BLENDED);
    expect_same(wire::from_wire(wire).answer, some_answer());
  }
}

TEST(SurfaceConversion, FaultsAreNamedAsTheSenderHasThem) {
  SurfaceQuery query = some_query();
  query.places[1].x() = std::numeric_limits<double>::quiet_NaN();  // east
  const wire::SurfaceQuerySample enu(query, 3, 1, pelagos_FRAME_ENU), ned(query, 3, 1, pelagos_FRAME_NED);
  EXPECT_THAT(wire::from_wire(enu.get()).fault, HasSubstr("place[1].x: nan is out of range"));
  EXPECT_THAT(wire::from_wire(ned.get()).fault, HasSubstr("place[1].y: nan is out of range"));
}

TEST(SurfaceConversion, AReasonTooLongIsCut) {
  const wire::SurfaceAnswerSample answer({{}, std::string(1000, 'x')}, {}, 17);
  EXPECT_EQ(std::string(answer.get().fault), std::string(255, 'x'));
  EXPECT_EQ(wire::from_wire(answer.get()).refusal.size(), 255U);
}

TEST(SurfaceConversion, AnswersThatCannotBeAreRefused) {
  const wire::SurfaceQuerySample sample(some_query(), 3, 41, pelagos_FRAME_ENU);
  SurfaceAnswer bad = some_answer();
  bad.places[1].height = std::numeric_limits<double>::infinity();
  const wire::SurfaceAnswerSample answer({bad, ""}, wire::from_wire(sample.get()), 17);
  const auto fault = wire::find_fault(answer.get());
  ASSERT_TRUE(fault);
  EXPECT_THAT(to_string(*fault), HasSubstr("places[1].surface: is inf"));
}

class SurfaceLoopback : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(eventually([this] { return client_.servers() == 1; }));
    ASSERT_TRUE(eventually([this] {  // the way back stands too once an answer has come
      const auto sent = client_.ask(some_query());
      return client_.wait_for(sent.number, std::chrono::milliseconds(100)).has_value();
    }));
    const std::scoped_lock lock(mutex_);
    asked_.clear();
  }
  [[nodiscard]] std::vector<std::string> asked() {
    const std::scoped_lock lock(mutex_);
    return asked_;
  }
  std::optional<Refusal> answer(const SurfaceQuery& query, const std::string& client, const TakeSurface& take) {
    if (auto fault = find_fault(query)) return fault;
    const std::scoped_lock lock(mutex_);
    asked_.push_back(client);
    if (!refusal_.empty()) return Refusal{"", refusal_};
    SurfaceAnswer answer{query.ahead, {}};
    for (const Vector2d& place : query.places)
      answer.places.push_back({SurfaceSource::kWaveField, place.x() + 2.0 * place.y(), Vector3d::UnitZ(), {1, 2, 3}});
    take({answer, ""});
    return std::nullopt;
  }

  std::mutex mutex_;
  std::vector<std::string> asked_;
  std::string refusal_;
  std::shared_ptr<DdsParticipant> participant_ = join_dds(test_settings());
  SurfaceLink link_{participant_, 17,
                    [this](const SurfaceQuery& query, const std::string& client, const TakeSurface& take) {
                      return answer(query, client, take);
                    }};
  SurfaceClient client_{participant_, 3};
};

TEST_F(SurfaceLoopback, AThousandPlacesThereAndBack) {
  SurfaceQuery query{2.5, {}};
  for (int k = 0; k < 1000; ++k) query.places.emplace_back(0.5 * k, -2.0 * k);
  const auto sent = client_.ask(query);
  ASSERT_FALSE(sent.refusal);
  const auto reply = client_.wait_for(sent.number, kPatience);
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->source, 17U);
  EXPECT_EQ(reply->news.refusal, "");
  EXPECT_EQ(reply->news.answer.simulation_time, 2.5);
  ASSERT_EQ(reply->news.answer.places.size(), 1000U);
  EXPECT_EQ(reply->news.answer.places[999].height, -3.5 * 999.0);
  EXPECT_THAT(asked(), testing::ElementsAre("bridge 3"));
}

TEST_F(SurfaceLoopback, AnswersGoToWhoAsked) {
  SurfaceClient other(participant_, 4);
  ASSERT_TRUE(eventually([&] {
    const auto sent = other.ask(some_query());
    return other.wait_for(sent.number, std::chrono::milliseconds(100)).has_value();
  }));
  EXPECT_TRUE(client_.take().empty());
}

TEST_F(SurfaceLoopback, TheClientRefusesWhatNoServerTakes) {
  EXPECT_EQ(to_string(*client_.ask({9.0, {{0, 0}}}).refusal), "ahead: 9 is out of range; allowed: 0 to 5 s");
  EXPECT_EQ(client_.ask({0.0, std::vector<Vector2d>(1001, {0, 0})}).refusal->field, "place");
  EXPECT_EQ(client_.refused_samples(), 0U);
}

TEST_F(SurfaceLoopback, TheServerAnswersBadQueriesWithTheReason) {
  const DdsWriter writer(*participant_, topics::surface_query());
  const DdsReader reader(*participant_, topics::surface_answer());
  SurfaceQuery query = some_query();
  query.places[2].y() = 2e5;
  std::vector<std::string> faults;
  ASSERT_TRUE(eventually([&] {
    const wire::SurfaceQuerySample sample(query, 5, 8, pelagos_FRAME_NED);
    EXPECT_TRUE(writer.write(&sample.get()));
    reader.take_all<pelagos_SurfaceAnswerV1>([&](const pelagos_SurfaceAnswerV1& answer) {
      if (answer.client != 5) return;
      EXPECT_EQ(answer.query, 8U);
      EXPECT_EQ(answer.places._length, 0U);
      faults.emplace_back(answer.fault);
    });
    return !faults.empty();
  }));
  EXPECT_EQ(faults[0], "place[2].x: 200000 is out of range; allowed: -100000 to 100000 m");
}

TEST_F(SurfaceLoopback, MoreThanAThousandPlacesCannotBeWritten) {
  const DdsWriter writer(*participant_, topics::surface_query());
  const wire::SurfaceQuerySample sample({0.0, std::vector<Vector2d>(1001, {0, 0})}, 5, 8, pelagos_FRAME_ENU);
  EXPECT_FALSE(writer.write(&sample.get()));
}

TEST_F(SurfaceLoopback, OfAFloodThatIsRefusedSomeAreTold) {
  {
    const std::scoped_lock lock(mutex_);
    refusal_ = "too many places are asked";
  }
  std::size_t told = 0;
  const auto begin = std::chrono::steady_clock::now();
  for (int sent = 0; sent < 200; ++sent) {
    EXPECT_FALSE(client_.ask(some_query()).refusal);
    for (const SurfaceReply& reply : client_.take()) {
      EXPECT_EQ(reply.news.refusal, "too many places are asked");
      ++told;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  EXPECT_GT(told, 0U);
  EXPECT_LE(static_cast<double>(told), 20.0 + 20.0 * taken.count()) << "20 at once and 20 a second";
}

}  // namespace
}  // namespace pelagos
