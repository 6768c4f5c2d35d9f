#include "wire/topics.hpp"

#include "pelagos.h"

namespace pelagos::topics {
namespace {

using std::chrono::milliseconds;

// Readers hold a few servers at most: a hostile peer that makes up sources must not fill the memory.
constexpr int kMostSources = 64;
constexpr int kMostBodies = 64, kMostProbes = 256;  // of a scene

// More than the last value: samples that another process sends under a server's source must not push the server's own
// out before they have been looked at.
TopicQos reader_qos() {
  TopicQos qos;
  qos.most_instances = kMostSources;
  qos.depth = 4;
  return qos;
}

TopicQos for_late(TopicQos qos) {
  qos.transient_local = true;
  return qos;
}

}  // namespace

// Depth 2: with lost packets the last frame can still be sent again while the next one goes out.
TopicSpec ocean_frame() {
  TopicQos writer;
  writer.depth = 2;
  return {"ocean_frame_v1", &pelagos_OceanFrameV1_desc, writer, reader_qos()};
}

// A reader keeps what comes while it decodes a frame.
TopicSpec schedule() {
  TopicQos reader = for_late(reader_qos());
  reader.depth = 16;
  return {"schedule_v1", &pelagos_ScheduleV1_desc, for_late({}), reader};
}

// The lease of 1 s is the server's sign of life; readers ask for none, so that any lease matches.
TopicSpec scene_info() {
  TopicQos writer = for_late({});
  writer.liveliness_lease = milliseconds(1000);
  return {"scene_info_v1", &pelagos_SceneInfoV1_desc, writer, for_late(reader_qos())};
}

TopicSpec sea() { return {"sea_v1", &pelagos_SeaV1_desc, for_late({}), for_late(reader_qos())}; }

TopicSpec body_shape() {
  TopicQos reader = for_late(reader_qos());
  reader.most_instances = 4 * kMostBodies;  // they are large
  return {"body_shape_v1", &pelagos_BodyShapeV1_desc, for_late({}), reader};
}

TopicSpec status() { return {"status_v2", &pelagos_StatusV2_desc, TopicQos{}, reader_qos()}; }

TopicSpec wind() { return {"wind_v1", &pelagos_WindV1_desc, for_late({}), for_late(reader_qos())}; }

TopicSpec slick() {
  TopicQos writer;
  writer.depth = 2;
  return {"slick_v1", &pelagos_SlickV1_desc, writer, reader_qos()};
}
TopicSpec oil_budget() { return {"oil_budget_v1", &pelagos_OilBudgetV1_desc, for_late({}), for_late(reader_qos())}; }

TopicSpec body_load() {
  TopicQos writer, reader = reader_qos();
  writer.depth = 2;
  reader.most_instances = kMostSources * kMostBodies;
  return {"body_load_v1", &pelagos_BodyLoadV1_desc, writer, reader};
}

TopicSpec probe() {
  TopicQos writer, reader = reader_qos();
  writer.depth = 2;
  reader.most_instances = kMostSources * kMostProbes;
  return {"probe_v1", &pelagos_ProbeV1_desc, writer, reader};
}

TopicSpec air() {
  TopicSpec spec = probe();
  spec.name = "air_v1";
  spec.type = &pelagos_AirV1_desc;
  return spec;
}

// Transient local, so that a server that starts after a bridge gets what it asked for.
TopicSpec probe_request() {
  TopicQos reader = for_late({});
  reader.reliable = true;
  reader.most_instances = 1024;
  return {"probe_request_v1", &pelagos_ProbeRequestV1_desc, for_late({}), reader};
}

// The server takes best effort too, so that every bridge matches. Depth 4: a bridge may ask again before its last
// query has been answered.
TopicSpec surface_query() {
  TopicQos writer, reader;
  writer.depth = 4;
  reader.reliable = false;
  reader.depth = 4;
  reader.most_instances = 256;
  return {"surface_query_v1", &pelagos_SurfaceQueryV1_desc, writer, reader};
}

TopicSpec surface_answer() {
  TopicQos writer, reader = reader_qos();
  writer.depth = 4;
  reader.most_instances = 256;  // a reader hears the answers to other clients too
  return {"surface_answer_v1", &pelagos_SurfaceAnswerV1_desc, writer, reader};
}

// As queries of the surface: a request that is lost is made again.
TopicSpec clock_request() {
  TopicQos writer, reader;
  writer.depth = 4;
  reader.reliable = false;
  reader.depth = 4;
  reader.most_instances = 256;
  return {"clock_request_v1", &pelagos_ClockRequestV1_desc, writer, reader};
}

TopicSpec clock_answer() {
  TopicQos writer, reader = reader_qos();
  writer.depth = 4;
  reader.most_instances = 256;  // a reader hears the answers to other viewers too
  return {"clock_answer_v1", &pelagos_ClockAnswerV1_desc, writer, reader};
}

TopicSpec viewer_status() {
  TopicQos reader = reader_qos();
  reader.most_instances = 256;
  return {"viewer_status_v1", &pelagos_ViewerStatusV1_desc, TopicQos{}, reader};
}

// Events come in bursts and each one counts.
TopicSpec event() {
  TopicQos writer;
  writer.depth = 64;
  TopicQos reader = reader_qos();
  reader.depth = 64;
  return {"event_v1", &pelagos_EventV1_desc, writer, reader};
}

// The server takes best effort too, so that every bridge matches. It keeps more than the last value, so that somebody
// who floods a body with bad poses does not push good ones out before they have been looked at.
TopicSpec own_ship_pose() {
  TopicQos reader;
  reader.reliable = false;
  reader.depth = 32;
  reader.most_instances = 1024;
  return {"own_ship_pose_v1", &pelagos_PoseV1_desc, TopicQos{}, reader};
}

TopicSpec body_pose() {
  TopicSpec spec = own_ship_pose();
  spec.name = "body_pose_v1";
  return spec;
}

TopicSpec geodetic_pose() {
  TopicSpec spec = own_ship_pose();
  spec.name = "geodetic_pose_v1";
  spec.type = &pelagos_GeodeticPoseV1_desc;
  return spec;
}

}  // namespace pelagos::topics
