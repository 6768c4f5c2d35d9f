#include "wire/topics.hpp"

#include "pelagos.h"

namespace pelagos::topics {
namespace {

using std::chrono::milliseconds;

constexpr TopicQos kLastValue{};
constexpr TopicQos kLastValueForLate{.reliable = true, .depth = 1, .transient_local = true, .liveliness_lease = {}};

}  // namespace

// Depth 2: with lost packets the last frame can still be sent again while the next one goes out.
TopicSpec ocean_frame() {
  TopicQos writer;
  writer.depth = 2;
  return {"ocean_frame_v1", &pelagos_OceanFrameV1_desc, writer, kLastValue};
}

// The lease of 1 s is the server's sign of life; readers ask for none, so that any lease matches.
TopicSpec scene_info() {
  TopicQos writer = kLastValueForLate;
  writer.liveliness_lease = milliseconds(1000);
  return {"scene_info_v1", &pelagos_SceneInfoV1_desc, writer, kLastValueForLate};
}

TopicSpec status() { return {"status_v1", &pelagos_StatusV1_desc, kLastValue, kLastValue}; }

TopicSpec wind() { return {"wind_v1", &pelagos_WindV1_desc, kLastValueForLate, kLastValueForLate}; }

// Events come in bursts and each one counts.
TopicSpec event() {
  TopicQos qos;
  qos.depth = 64;
  return {"event_v1", &pelagos_EventV1_desc, qos, qos};
}

// The server takes best effort too, so that every bridge matches.
TopicSpec own_ship_pose() {
  TopicQos reader;
  reader.reliable = false;
  return {"own_ship_pose_v1", &pelagos_PoseV1_desc, kLastValue, reader};
}

TopicSpec body_pose() {
  TopicSpec spec = own_ship_pose();
  spec.name = "body_pose_v1";
  return spec;
}

}  // namespace pelagos::topics
