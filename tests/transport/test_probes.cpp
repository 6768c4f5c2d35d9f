#include <gmock/gmock.h>

#include <algorithm>
#include <limits>

#include "loopback.hpp"
#include "pelagos_dds/entities.hpp"
#include "transport/probe_receiver.hpp"
#include "wire/convert.hpp"
#include "wire/topics.hpp"

namespace pelagos {
namespace {

using Eigen::Vector3d;

ProbeReading some_reading() {
  ProbeReading reading;
  reading.id = 4;
  reading.name = "bow";
  reading.position = {1.0, 2.0, 3.0};
  reading.wet = true;
  reading.height = 1.5;
  reading.normal = Vector3d(0.1, -0.2, 0.9).normalized();
  reading.velocity = {0.3, 0.4, -0.5};
  return reading;
}

ProbeSettings some_probe(std::uint32_t body) {
  ProbeSettings probe;
  probe.id = 4;
  probe.name = "bow";
  probe.body = body;
  probe.position = {9.0, 2.0, 1.0};
  probe.at_surface = false;
  return probe;
}

TEST(ProbeConversion, ReadingRoundTripInBothFrames) {
  Snapshot snapshot;
  snapshot.frame = 12;
  snapshot.simulation_time = 0.4;
  for (const pelagos_WorldFrame frame : {pelagos_FRAME_ENU, pelagos_FRAME_NED}) {
    const ProbeReading reading = some_reading();
    const pelagos_ProbeV1 wire = wire::to_wire(reading, snapshot, 17, frame);
    EXPECT_EQ(wire.source, 17U);
    EXPECT_EQ(wire.frame, 12U);
    EXPECT_EQ(wire.simulation_time, 0.4);
    EXPECT_EQ(wire.surface.z, frame == pelagos_FRAME_NED ? -1.5 : 1.5);
    EXPECT_EQ(wire.surface.x, frame == pelagos_FRAME_NED ? 2.0 : 1.0);
    const ProbeReading back = wire::from_wire(wire);
    EXPECT_EQ(back.id, 4U);
    EXPECT_EQ(back.name, "bow");
    EXPECT_TRUE(back.wet);
    EXPECT_EQ(back.height, 1.5);
    EXPECT_EQ(back.position, reading.position);
    EXPECT_EQ(back.normal, reading.normal);
    EXPECT_EQ(back.velocity, reading.velocity);
  }
}

TEST(ProbeConversion, AirIsInBothFrames) {
  Snapshot snapshot;
  snapshot.frame = 12;
  ProbeReading reading = some_reading();
  reading.air = Vector3d(4.0, -7.0, 0.5);
  const pelagos_AirV1 enu = wire::air_to_wire(reading, snapshot, 17, pelagos_FRAME_ENU);
  EXPECT_EQ(enu.source, 17U);
  EXPECT_EQ(enu.probe, 4U);
  EXPECT_EQ(enu.frame, 12U);
  EXPECT_EQ(Vector3d(enu.velocity.x, enu.velocity.y, enu.velocity.z), Vector3d(4.0, -7.0, 0.5));
  const pelagos_AirV1 ned = wire::air_to_wire(reading, snapshot, 17, pelagos_FRAME_NED);
  EXPECT_EQ(Vector3d(ned.velocity.x, ned.velocity.y, ned.velocity.z), Vector3d(-7.0, 4.0, -0.5));
  EXPECT_EQ(Vector3d(ned.position.x, ned.position.y, ned.position.z), Vector3d(2.0, 1.0, -3.0));
}

TEST(ProbeConversion, RequestsAreInTheWorldsAxesOrTheBodys) {
  const pelagos_ProbeRequestV1 world = wire::to_wire(some_probe(0), 3, pelagos_FRAME_NED);
  EXPECT_EQ(world.position.x, 2.0);  // north
  EXPECT_EQ(world.position.z, -1.0);
  const pelagos_ProbeRequestV1 carried = wire::to_wire(some_probe(2), 3, pelagos_FRAME_NED);
  EXPECT_EQ(carried.position.x, 9.0);   // forward
  EXPECT_EQ(carried.position.y, -2.0);  // starboard
  for (const std::uint32_t body : {0U, 2U})
    for (const pelagos_WorldFrame frame : {pelagos_FRAME_ENU, pelagos_FRAME_NED}) {
      const ProbeSettings back = wire::from_wire(wire::to_wire(some_probe(body), 3, frame));
      EXPECT_EQ(back.position, Vector3d(9.0, 2.0, 1.0));
      EXPECT_EQ(back.body, body);
      EXPECT_EQ(back.name, "bow");
      EXPECT_FALSE(back.at_surface);
    }
}

TEST(ProbeConversion, ANameTooLongIsCut) {
  ProbeSettings probe = some_probe(0);
  probe.name.assign(100, 'x');
  EXPECT_EQ(wire::from_wire(wire::to_wire(probe, 3, pelagos_FRAME_ENU)).name, std::string(64, 'x'));
  probe.name.clear();
  EXPECT_EQ(wire::from_wire(wire::to_wire(probe, 3, pelagos_FRAME_ENU)).name, "probe 4");
}

class ProbeLoopback : public testing::Test {
 protected:
  void send(const pelagos_ProbeRequestV1& sample) { ASSERT_TRUE(writer_.write(&sample)); }
  std::vector<ProbeRequest> take(std::size_t count) {
    std::vector<ProbeRequest> all, some;
    EXPECT_TRUE(eventually([&] {
      receiver_.take(some);
      all.insert(all.end(), some.begin(), some.end());
      return all.size() >= count;
    }));
    return all;
  }

  std::shared_ptr<DdsParticipant> participant_ = join_dds(test_settings());
  DdsWriter writer_{*participant_, topics::probe_request()};
  ProbeReceiver receiver_{participant_};
};

TEST_F(ProbeLoopback, ARequestMadeBeforeTheServerStartsIsTaken) {
  send(wire::to_wire(some_probe(1), 3, pelagos_FRAME_NED));
  ProbeReceiver late(participant_);
  std::vector<ProbeRequest> requests;
  ASSERT_TRUE(eventually([&] {
    late.take(requests);
    return !requests.empty();
  }));
  EXPECT_EQ(requests[0].sender, 3U);
  EXPECT_EQ(requests[0].refusal, std::nullopt);
  EXPECT_EQ(std::get<SetProbe>(requests[0].command).probe.position, Vector3d(9.0, 2.0, 1.0));
}

TEST_F(ProbeLoopback, RequestsAreTakenOnceAndFaultsNamed) {
  send(wire::to_wire(some_probe(0), 3, pelagos_FRAME_ENU));
  ASSERT_EQ(take(1).size(), 1U);
  pelagos_ProbeRequestV1 remove = wire::to_wire(some_probe(0), 3, pelagos_FRAME_ENU);
  remove.remove = true;
  send(remove);
  const auto removed = take(1);
  ASSERT_EQ(removed.size(), 1U);
  EXPECT_EQ(std::get<RemoveProbe>(removed[0].command).id, 4U);

  pelagos_ProbeRequestV1 bad = wire::to_wire(some_probe(0), 3, pelagos_FRAME_ENU);
  bad.position.y = std::numeric_limits<double>::quiet_NaN();
  send(bad);
  EXPECT_EQ(take(1).at(0).refusal, (Refusal{"position.y", "is nan; allowed: a finite number, m"}));
  bad.probe = 0;
  send(bad);
  EXPECT_EQ(take(1).at(0).refusal, (Refusal{"probe", "is 0; allowed: 1 or more"}));
}

TEST_F(ProbeLoopback, NamesWithControlCharactersAreRefusedAndNotPassedOn) {
  for (const std::string name : {"a\x1b[2J", "line\nbreak", "\x7f", "caf\xe9", "left\xe2\x80\xaeright"}) {
    ProbeSettings probe = some_probe(0);
    probe.name = name;
    send(wire::to_wire(probe, 3, pelagos_FRAME_ENU));
    const auto requests = take(1);
    ASSERT_EQ(requests.size(), 1U);
    ASSERT_TRUE(requests[0].refusal) << name;
    EXPECT_EQ(requests[0].refusal->field, "name");
    EXPECT_THAT(requests[0].refusal->what, testing::HasSubstr("allowed: up to 64 bytes")) << name;
    EXPECT_EQ(std::get<SetProbe>(requests[0].command).probe.name, "probe 4");
  }
  ProbeSettings probe = some_probe(0);
  probe.name = "anem\xc3\xb3metro";
  send(wire::to_wire(probe, 3, pelagos_FRAME_ENU));
  EXPECT_EQ(take(1).at(0).refusal, std::nullopt);
}

TEST_F(ProbeLoopback, AFloodIsTakenWithinLimitsAndOthersAreServed) {
  std::vector<ProbeRequest> all, some;
  ProbeSettings probe = some_probe(0);
  for (int round = 0; round < 60; ++round) {
    for (int k = 0; k < 32; ++k) {
      probe.id = static_cast<std::uint32_t>(1 + k);
      send(wire::to_wire(probe, 66, pelagos_FRAME_ENU));
    }
    EXPECT_TRUE(eventually([&, before = all.size() + receiver_.dropped()] {
      receiver_.take(some);
      all.insert(all.end(), some.begin(), some.end());
      return all.size() + receiver_.dropped() > before;
    }));
  }
  EXPECT_GT(receiver_.dropped(), 0U);
  EXPECT_LT(all.size(), 300U + 20U * 30U);  // 300 at once, and 20 a second for as long as this may take
  send(wire::to_wire(probe, 7, pelagos_FRAME_ENU));
  EXPECT_TRUE(eventually([&] {
    receiver_.take(some);
    return std::any_of(some.begin(), some.end(), [](const ProbeRequest& request) { return request.sender == 7; });
  }));
}

TEST_F(Loopback, ProbesAreReadByAnyone) {
  start();
  const DdsReader reader(*participant_, topics::probe());
  std::vector<ProbeReading> heard;
  std::uint64_t frame = 0;
  ASSERT_TRUE(eventually([&] {
    auto snapshot = test_snapshot(*publisher_, ++frame, 10);
    snapshot->probes = {some_reading()};
    publisher_->submit(std::move(snapshot));
    reader.take_all<pelagos_ProbeV1>([&](const pelagos_ProbeV1& sample) { heard.push_back(wire::from_wire(sample)); });
    return !heard.empty();
  }));
  EXPECT_EQ(heard[0].id, 4U);
  EXPECT_EQ(heard[0].height, 1.5);
}

}  // namespace
}  // namespace pelagos
