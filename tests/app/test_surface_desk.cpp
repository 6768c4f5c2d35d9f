// Queries of the surface, from whoever asks to the step boundary and back.

#include "surface_desk.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <thread>

#include "fields/field_hash.hpp"

namespace pelagos {
namespace {

using testing::HasSubstr;

/// 28 x 26 x 5 m of an open sea, d = 1 m.
Scene open_patch() {
  Scene scene;
  scene.particle_spacing = 1.0;
  scene.patch = {{-14, -13, -5}, {14, 13, 8}};
  scene.patch_edges = {PatchEdge::kOpen, PatchEdge::kOpen, PatchEdge::kWall};
  scene.water.blocks = {{{-14, -13, -5}, {14, 13, 0}}};
  scene.open_sea.zone_width = 5.0;
  scene.far_sea.waves = {{0.4, 30.0, 0.0, 60.0, 0.0}};
  return scene;
}

/// Takes what becomes of queries.
class Answers {
 public:
  [[nodiscard]] TakeSurface take() {
    return [this](const SurfaceNews& news) {
      const std::scoped_lock lock(mutex_);
      news_.push_back(news);
    };
  }
  [[nodiscard]] std::vector<SurfaceNews> wait_for(std::size_t count) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    for (;;) {
      {
        const std::scoped_lock lock(mutex_);
        if (news_.size() >= count || std::chrono::steady_clock::now() > end) return news_;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

 private:
  std::mutex mutex_;
  std::vector<SurfaceNews> news_;
};

class Desk : public testing::Test {
 protected:
  [[nodiscard]] std::string ask(SurfaceDesk& desk, const SurfaceQuery& query, const std::string& client = "a") {
    const auto refusal = desk.ask(query, client, answers_.take());
    return refusal ? to_string(*refusal) : "";
  }
  /// Serves until so many answers are there: at once, but for the share of the thread's time.
  [[nodiscard]] std::vector<SurfaceNews> serve(SurfaceDesk& desk, std::size_t count) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (desk.counts().answered < count && std::chrono::steady_clock::now() < end) {
      desk.serve(world_);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return answers_.wait_for(count);
  }

  World world_{open_patch(), {1, nullptr, {}}};
  Answers answers_;
  const SurfaceQuery query_{0.0, {{0.0, 0.0}, {-13.0, 2.0}, {500.0, -300.0}}};
  const SurfaceQuery ahead_{2.0, {{0.0, 0.0}}};
};

TEST_F(Desk, AnswersFromTheNextBoundary) {
  SurfaceDesk desk;
  desk.serve(world_);
  EXPECT_EQ(ask(desk, query_), "");
  EXPECT_EQ(ask(desk, ahead_), "");
  EXPECT_EQ(desk.counts().answered, 0U);
  const std::vector<SurfaceNews> news = serve(desk, 2);
  ASSERT_EQ(news.size(), 2U);
  EXPECT_EQ(news[0].refusal, "");
  const SurfaceAnswer expected = answer_query(world_.sea_around(), query_, world_.read_particles(query_.places));
  EXPECT_EQ(news[0].answer.simulation_time, 0.0);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(news[0].answer.places[k].source, expected.places[k].source);
    EXPECT_EQ(news[0].answer.places[k].height, expected.places[k].height);
    EXPECT_EQ(news[0].answer.places[k].velocity, expected.places[k].velocity);
  }
  EXPECT_EQ(news[0].answer.places[0].source, SurfaceSource::kParticles);
  EXPECT_EQ(news[1].answer.simulation_time, 2.0);
  EXPECT_EQ(news[1].answer.places[0].source, SurfaceSource::kWaveField);
}

TEST_F(Desk, RefusesBadValuesAndGoesOn) {
  SurfaceDesk desk;
  desk.serve(world_);
  EXPECT_EQ(ask(desk, {6.0, {{0, 0}}}), "ahead: 6 is out of range; allowed: 0 to 5 s");
  EXPECT_EQ(ask(desk, {0.0, {}}), "place: 0 places are given; allowed: 1 to 1000");
  EXPECT_EQ(desk.counts().refused, 2U);
  EXPECT_EQ(ask(desk, query_), "");
  EXPECT_EQ(serve(desk, 1).size(), 1U);
}

TEST_F(Desk, RefusesBeforeTheFirstBoundaryAndAfterTheEnd) {
  SurfaceDesk desk;
  EXPECT_THAT(ask(desk, query_), HasSubstr("still places and settles its water"));
  desk.serve(world_);
  EXPECT_EQ(ask(desk, query_), "");
  desk.close();
  EXPECT_EQ(answers_.wait_for(1).at(0).refusal, "the server is stopping") << "whoever waits is told";
  EXPECT_EQ(ask(desk, query_), "the server is stopping");
}

TEST_F(Desk, LimitsWhatAClientAsksAndServesOthers) {
  SurfaceDeskLimits limits;
  limits.client_per_second = limits.all_per_second = 1e-9;  // what is there at once, and no more
  limits.client_burst = 300.0;
  limits.all_burst = 500.0;
  SurfaceDesk desk(limits);
  desk.serve(world_);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(ask(desk, query_), "") << "each counts as 100 places";
  EXPECT_THAT(ask(desk, query_), HasSubstr("too many places are asked; allowed: "));
  EXPECT_EQ(ask(desk, query_, "b"), "");
  EXPECT_EQ(ask(desk, query_, "b"), "");
  EXPECT_THAT(ask(desk, query_, "c"), HasSubstr("by all clients together"));
  EXPECT_EQ(serve(desk, 5).size(), 5U);
  EXPECT_EQ(desk.counts().refused, 2U);
}

TEST_F(Desk, LimitsWhatWaits) {
  SurfaceDesk desk;
  desk.serve(world_);
  for (int k = 0; k < 4; ++k) EXPECT_EQ(ask(desk, query_), "");
  EXPECT_EQ(ask(desk, query_), "4 queries of a wait for their answers; allowed: at most so many");
  for (int k = 4; k < 32; ++k) EXPECT_EQ(ask(desk, query_, "client " + std::to_string(k)), "");
  EXPECT_EQ(ask(desk, query_, "z"), "32 queries wait for their answers; allowed: at most so many");
  EXPECT_EQ(serve(desk, 32).size(), 32U);
  EXPECT_EQ(ask(desk, query_), "") << "there is room again";
  EXPECT_EQ(serve(desk, 33).size(), 33U);
}

TEST_F(Desk, TakesAShareOfTheSimulationsTimeAndNoMore) {
  SurfaceDeskLimits limits;
  limits.share = 1e-9;
  limits.share_burst = 1e-9;  // s: the first query leaves a debt
  SurfaceDesk desk(limits);
  desk.serve(world_);
  EXPECT_EQ(ask(desk, query_), "");
  EXPECT_EQ(ask(desk, query_), "");
  EXPECT_EQ(serve(desk, 1).size(), 1U);
  for (int k = 0; k < 100; ++k) desk.serve(world_);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_EQ(desk.counts().answered, 1U) << "the other one waits";
}

TEST_F(Desk, QueriesChangeNothing) {
  World alone(open_patch(), {1, nullptr, {}});
  SurfaceDesk desk;
  for (int step = 0; step < 12; ++step) {
    desk.serve(world_);
    EXPECT_EQ(ask(desk, query_), "");
    desk.serve(world_);
    (void)world_.advance();
    (void)alone.advance();
    EXPECT_EQ(answers_.wait_for(static_cast<std::size_t>(step) + 1).size(), static_cast<std::size_t>(step) + 1);
  }
  EXPECT_EQ(hash_fields(world_.state()), hash_fields(alone.state()));
}

}  // namespace
}  // namespace pelagos
