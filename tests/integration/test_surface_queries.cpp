// Queries of the surface to a running server, over DDS and over the instructors' link.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "client/frame_receiver.hpp"
#include "client/surface_client.hpp"
#include "pelagos_dds/participant.hpp"
#include "still_water_server.hpp"

namespace pelagos {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;

class SurfaceOfAServer : public StillWaterServer {};

TEST_F(SurfaceOfAServer, IsTheSameOverBothLinksAndTheWaveFieldOutside) {
  ask({"waves", "--wave", "0.5,30,90", "0.1,2.5s,60,45"});
  const FrameReceiver viewer(settings());
  SurfaceClient client(join_dds(settings()), 5);
  ASSERT_TRUE(eventually([&] {
    const auto scene = viewer.scene_info();
    return client.servers() > 0 && scene && scene->sea.components().size() == 2;
  }));
  ask({"pause"});

  const SurfaceQuery now{0.0, {{2000.0, -350.0}, {-40.0, 9000.0}}};
  std::optional<SurfaceReply> reply;
  ASSERT_TRUE(eventually([&] {  // until the way back stands too
    const auto sent = client.ask(now);
    if (!sent.refusal) reply = client.wait_for(sent.number, milliseconds(200));
    return reply.has_value();
  }));
  ASSERT_EQ(reply->news.refusal, "");
  const auto json = nlohmann::json::parse(ask({"surface", "--json", "--at", "2000,-350", "--at=-40,9000"}));
  EXPECT_EQ(json["simulation_time"], reply->news.answer.simulation_time) << "the sea is paused";
  const WaveField sea = viewer.scene_info()->sea;
  for (std::size_t k = 0; k < 2; ++k) {
    const SurfaceAtPlace& at = reply->news.answer.places[k];
    EXPECT_EQ(at.source, SurfaceSource::kWaveField);
    EXPECT_EQ(json["place"][k]["source"], "WAVE_FIELD");
    EXPECT_EQ(json["place"][k]["height"], at.height);
    const WaveMoment moment = sea.at(reply->news.answer.simulation_time, now.places[k]);
    const float zero = 0.0F;
    float height = 0, out[5];
    evaluate_displaced_surface(moment, {&zero, 1}, {&zero, 1},
                               {{&height, 1}, {&out[0], 1}, {&out[1], 1}, {&out[2], 1}, {&out[3], 1}, {&out[4], 1}});
    EXPECT_NEAR(at.height, sea.level() + static_cast<double>(height), 1e-3);
  }
  const auto later = client.ask({3.0, now.places});
  const auto ahead = client.wait_for(later.number, kPatience);
  ASSERT_TRUE(ahead);
  EXPECT_EQ(ahead->news.answer.simulation_time, reply->news.answer.simulation_time + 3.0);
  EXPECT_THAT(ask({"status"}), HasSubstr(" of the surface answered, 0 refused"));
}

TEST_F(SurfaceOfAServer, TellsWhatIsWrongAndGoesOn) {
  EXPECT_THAT(ask({"surface", "--at", "2e5,0"}, 1),
              HasSubstr("query_surface.place[0].x: 200000 is out of range; allowed: -100000 to 100000 m"));
  EXPECT_THAT(ask({"surface", "--at", "0,0", "--ahead", "6"}, 1), HasSubstr("allowed: 0 to 5 s [INVALID_VALUE]"));
  EXPECT_THAT(ask({"surface", "--at", "1,1"}), HasSubstr("particles"));
  EXPECT_THAT(ask({"status"}), HasSubstr("queries    1 of the surface answered, 2 refused"));
}

TEST_F(SurfaceOfAServer, IsPrintedByTheExampleBridge) {
  RunningProgram bridge(
      {program("pelagos-example-bridge"), "--domain", own_domain(), "--duration", "30", "--ask", "1500,-20"});
  EXPECT_TRUE(eventually([&] { return bridge.output().find("(wave field)") != std::string::npos; })) << bridge.output();
}

}  // namespace
}  // namespace pelagos
