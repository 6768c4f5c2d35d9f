// What strangers may put into a sample, and what becomes of it.
#include "wire/sample_fault.hpp"

#include <gmock/gmock.h>

#include <functional>
#include <limits>

#include "loopback.hpp"
#include "wire/convert.hpp"

namespace pelagos {
namespace {

using testing::HasSubstr;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A scene with many bodies, as a sample.
SceneInfo crowd(std::uint32_t bodies) {
  SceneInfo scene = test_scene();
  scene.bodies.clear();
  for (std::uint32_t i = 0; i < bodies; ++i) scene.bodies.push_back({i + 1, "buoy", "buoy.obj", 1.0});
  return scene;
}

void change_wave(SceneInfo& scene, std::size_t wave, float WaveComponent::*member, float value) {
  std::vector<WaveComponent> waves(scene.sea.components().begin(), scene.sea.components().end());
  waves[wave].*member = value;
  scene.sea = WaveField(waves, scene.water_level);
}

std::string fault_of(const SceneInfo& scene) {
  const wire::SceneInfoSample sample(scene, 1);
  const auto fault = wire::find_fault(sample.get());
  return fault ? to_string(*fault) : "";
}

TEST(SceneFault, NamesAndNumbersOfBodiesAreBounded) {
  EXPECT_EQ(fault_of(crowd(64)), "");
  EXPECT_THAT(fault_of(crowd(65)), HasSubstr("bodies: has 65 items; allowed: at most 64"));
  SceneInfo scene = crowd(3);
  scene.bodies[2].mesh_file = std::string(260, 'a');
  EXPECT_EQ(fault_of(scene), "");
  scene.bodies[2].mesh_file += 'a';
  EXPECT_THAT(fault_of(scene), HasSubstr("bodies[2].mesh_file: has 261 bytes; allowed: at most 260"));
  scene = crowd(3);
  scene.bodies[1].name = std::string(100'000, 'n');
  EXPECT_THAT(fault_of(scene), HasSubstr("bodies[1].name: has 100000 bytes"));
  scene = crowd(3);
  scene.bodies[1].id = scene.bodies[0].id;
  EXPECT_THAT(fault_of(scene), HasSubstr("bodies[1].id"));
  scene = crowd(1);
  scene.scene = std::string(257, 's');
  EXPECT_THAT(fault_of(scene), HasSubstr("scene: has 257 bytes"));
}

TEST(SceneFault, NumbersThatNoSeaHasAreRefusedByName) {
  const std::pair<const char*, std::function<void(SceneInfo&)>> faults[] = {
      {"particle_spacing: is 0", [](SceneInfo& s) { s.particle_spacing = 0.0; }},
      {"particle_spacing: is nan", [](SceneInfo& s) { s.particle_spacing = kNaN; }},
      {"frame_interval", [](SceneInfo& s) { s.frame_interval = -1.0; }},
      {"water_level: is 1e+30", [](SceneInfo& s) { s.water_level = 1e30; }},
      {"tank_max: is not above", [](SceneInfo& s) { std::swap(s.patch.min, s.patch.max); }},
      {"tank_min", [](SceneInfo& s) { s.patch.min.y() = -1e12; }},
      {"origin_latitude_deg", [](SceneInfo& s) { s.origin.latitude_deg = 90.1; }},
      {"origin_height", [](SceneInfo& s) { s.origin.height = kNaN; }},
      {"far_sea[1].amplitude", [](SceneInfo& s) { change_wave(s, 1, &WaveComponent::amplitude, 1e20F); }},
      {"far_sea[0].wavenumber", [](SceneInfo& s) { change_wave(s, 0, &WaveComponent::wavenumber, -1.0F); }},
      {"far_sea[0].phase",
       [](SceneInfo& s) { change_wave(s, 0, &WaveComponent::phase, std::numeric_limits<float>::infinity()); }},
      {"bodies[0].mesh_scale", [](SceneInfo& s) { s.bodies[0].mesh_scale = 0.0; }},
  };
  for (const auto& [text, change] : faults) {
    SceneInfo scene = test_scene();
    change(scene);
    EXPECT_THAT(fault_of(scene), HasSubstr(text));
  }
}

TEST(SeaFault, LayersWavesAndTimesAreBounded) {
  using Layers = std::vector<WaveLayer>;
  const WaveComponent wave{0.5F, 0.2F, 1.4F, 0.7F, 2.0F};
  const auto fault_of_sea = [](const Layers& layers, double level = 0.0, double depth = kInfiniteDepth) {
    const wire::SeaSample sample(WaveField::of_layers(layers, level, depth), 1);
    const auto fault = wire::find_fault(sample.get());
    return fault ? to_string(*fault) : "";
  };
  EXPECT_EQ(fault_of_sea(Layers(8, {std::vector(512, wave), 3.0, 60.0})), "");
  EXPECT_THAT(fault_of_sea(Layers(8, {std::vector(513, wave), 3.0, 60.0})), HasSubstr("waves: has 4104 items"));
  EXPECT_THAT(fault_of_sea({{{wave}, kNaN, 1.0}}), HasSubstr("layers[0].start: is nan"));
  EXPECT_THAT(fault_of_sea({{{wave}, 0.0, 0.0}, {{wave}, 0.0, -1.0}}), HasSubstr("layers[1].seconds: is -1"));
  EXPECT_THAT(fault_of_sea({{{wave}, 0.0, 3601.0}}), HasSubstr("layers[0].seconds: is 3601; allowed: 0 to 3600"));
  EXPECT_THAT(fault_of_sea({{{wave}, 0.0, 0.0}}, 1e30), HasSubstr("water_level: is 1e+30"));
  EXPECT_THAT(fault_of_sea({{{wave}, 0.0, 0.0}}, 0.0, -5.0), HasSubstr("depth: is -5"));
  WaveComponent high = wave;
  high.amplitude = 1e20F;
  EXPECT_THAT(fault_of_sea({{{wave, high}, 0.0, 0.0}}), HasSubstr("waves[1].amplitude: is 1e+20"));
  pelagos_SeaV1 none{};
  ASSERT_TRUE(wire::find_fault(none).has_value());
  EXPECT_THAT(to_string(*wire::find_fault(none)), HasSubstr("layers: is empty; allowed: 1 to 8 items"));
  std::vector<pelagos_SeaLayerV1> nine(9);
  none.layers._buffer = nine.data();
  none.layers._length = 9;
  EXPECT_THAT(to_string(*wire::find_fault(none)), HasSubstr("layers: has 9 items; allowed: at most 8"));
}

TEST(StatusFault, NumbersThatAViewerComputesWithAreBounded) {
  ServerStatus status;
  const auto refused = [&] {
    const wire::StatusSample sample(status, 1, pelagos_FRAME_ENU);
    return wire::find_fault(sample.get()).has_value();
  };
  EXPECT_FALSE(refused());
  status.real_time_factor = kNaN;
  EXPECT_TRUE(refused());
  status.real_time_factor = 1.0;
  status.simulation_time = 1e300;
  EXPECT_TRUE(refused());
  status.simulation_time = 0.0;
  status.bodies.resize(65);
  for (std::uint32_t i = 0; i < 65; ++i) status.bodies[i].body = i;
  EXPECT_TRUE(refused());
  status.bodies.resize(64);
  EXPECT_FALSE(refused());
  status.bodies[63].velocity.z() = 1e30;
  EXPECT_TRUE(refused());
}

TEST(FrameFault, BodiesAreBoundedAndOnceEach) {
  std::vector<pelagos_BodyStateV1> bodies(64, wire::to_wire(BodyState{}, pelagos_FRAME_ENU));
  for (std::uint32_t i = 0; i < 64; ++i) bodies[i].body = i;
  pelagos_OceanFrameV1 frame{};
  frame.particle_spacing = 1.0F;
  frame.record_bytes = kRecordBytes;
  frame.bodies._buffer = bodies.data();
  frame.bodies._length = frame.bodies._maximum = 64;
  EXPECT_FALSE(wire::find_fault(frame));
  bodies[9].body = 3;
  EXPECT_THAT(to_string(wire::find_fault(frame).value()), HasSubstr("bodies[9].body"));
  bodies[9].body = 9;
  bodies[9].position.x = 1e9;
  EXPECT_THAT(to_string(wire::find_fault(frame).value()), HasSubstr("bodies[9].position: is 1e+09"));
  bodies[9].position.x = 0.0;
  frame.simulation_time = -1e40;
  EXPECT_THAT(to_string(wire::find_fault(frame).value()), HasSubstr("simulation_time"));
  frame.simulation_time = 0.0;
  frame.origin.y = 1e30;
  EXPECT_THAT(to_string(wire::find_fault(frame).value()), HasSubstr("origin"));
}

TEST(WindFault, AWindThatNoSeaHasIsRefused) {
  WindSettings wind;
  wind.velocity = {12.0, 0.0, 0.0};
  pelagos_WindV1 sample{};
  sample.has_wind = true;
  sample.wind = wire::to_wire(wind);
  EXPECT_FALSE(wire::find_fault(sample));
  sample.wind.velocity_to.x = 1e9;
  EXPECT_TRUE(wire::find_fault(sample));
  sample.has_wind = false;
  EXPECT_FALSE(wire::find_fault(sample)) << "then it means nothing";
}

TEST(WireText, WhatPeopleReadHasNoControlCharacters) {
  Event event;
  event.kind = "wind\x1b[2J";
  event.source = "station \n forged line";
  event.text = std::string(100'000, 'x');
  const Event shown = wire::from_wire(wire::to_wire(event, 1));
  EXPECT_EQ(shown.kind, "wind\\x1b[2J");
  EXPECT_EQ(shown.source, "station \\n forged line");
  EXPECT_LE(shown.text.size(), 1024U);
  SceneInfo scene = test_scene();
  scene.scene = "bay\x1b]0;title\x07";
  scene.bodies[0].mesh_file = "a\x1b.obj";
  const wire::SceneInfoSample sample(scene, 1);
  const SceneInfo info = wire::from_wire(sample.get());
  EXPECT_EQ(info.scene, "bay\\x1b]0;title\\x07");
  EXPECT_EQ(info.bodies[0].mesh_file, scene.bodies[0].mesh_file) << "the name of a file stays as it is";
}

}  // namespace
}  // namespace pelagos
