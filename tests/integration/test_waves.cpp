// The waves of a server, exchanged by an instructor, as viewers get them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "client/frame_receiver.hpp"
#include "fields/field_difference.hpp"
#include "still_water_server.hpp"

namespace pelagos {
namespace {

using testing::HasSubstr;

class WavesOfAServer : public StillWaterServer {
 protected:
  nlohmann::json sea_status() { return nlohmann::json::parse(ask({"status", "--json"})).at("sea"); }
  /// What a viewer has of the sea, once it has so many layers.
  static WaveField sea_of(const FrameReceiver& viewer, std::size_t layers) {
    EXPECT_TRUE(eventually([&] {
      const auto scene = viewer.scene_info();
      return scene && scene->sea.layers().size() == layers;
    }));
    const auto scene = viewer.scene_info();
    return scene ? scene->sea : WaveField();
  }
};

TEST_F(WavesOfAServer, BlendAlikeInEveryViewer) {
  const FrameReceiver viewer(settings());
  EXPECT_TRUE(sea_of(viewer, 1).components().empty()) << "the scene's sea is flat";
  ask({"waves", "--wave", "0.5,30,90", "0.1,2.5s,60,45", "--blend", "600"});
  ask({"waves", "--wave", "0.2,12,180", "--blend", "300"});
  const WaveField sea = sea_of(viewer, 3);
  EXPECT_EQ(sea.layers()[1].components.size(), 2U);
  EXPECT_EQ(sea.layers()[1].seconds, 600.0);
  EXPECT_EQ(sea.layers()[2].components.size(), 1U);
  EXPECT_EQ(sea.layers()[2].seconds, 300.0);
  EXPECT_GT(sea.layers()[2].start, sea.layers()[1].start);
  EXPECT_FLOAT_EQ(sea.components()[0].amplitude, 0.2F);

  const FrameReceiver late(settings());  // joins in the middle of the blends
  const auto difference = find_difference(sea, sea_of(late, 3));
  EXPECT_FALSE(difference.has_value()) << difference->field;

  const nlohmann::json status = sea_status();
  EXPECT_EQ(status.at("waves"), 1);
  EXPECT_EQ(status.at("earlier"), 2);
  EXPECT_GT(status.at("blend_left").get<double>(), 100.0);
  EXPECT_THAT(server_.errors(), HasSubstr("waves: 2 of them, significant height 1.44 m, the highest 30 m long to 90 "
                                          "deg, over 600.0 s"));

  ask({"waves", "--off"});
  EXPECT_TRUE(eventually([&] { return viewer.scene_info()->sea.components().empty(); }));
  EXPECT_FALSE(sea_status().contains("share")) << "at once: nothing blends";
}

TEST_F(WavesOfAServer, ChangeWhileTheSeaIsPaused) {
  const FrameReceiver viewer(settings());
  sea_of(viewer, 1);
  ask({"pause"});
  ask({"waves", "--wave", "0.2,12,180"});
  EXPECT_EQ(sea_of(viewer, 2).components().size(), 1U);
  EXPECT_EQ(sea_status().at("waves"), 1);
}

}  // namespace
}  // namespace pelagos
