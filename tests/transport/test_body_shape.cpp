#include <gmock/gmock.h>

#include <limits>

#include "loopback.hpp"
#include "pelagos_dds/entities.hpp"
#include "wire/convert.hpp"
#include "wire/topics.hpp"

namespace pelagos {
namespace {

using testing::HasSubstr;

std::shared_ptr<BodySurface> tetrahedron(float length) {
  auto surface = std::make_shared<BodySurface>();
  surface->file_digest = 0x1234567890abcdefull;
  surface->high.setConstant(static_cast<double>(length));
  surface->vertices = {{0, 0, 0}, {length, 0, 0}, {0, length, 0}, {0, 0, length}};
  surface->triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  surface->triangle_count = 4;
  return surface;
}

SceneInfo scene_with_shape(float length) {
  SceneInfo scene = test_scene();
  scene.bodies[0].surface = tetrahedron(length);
  return scene;
}

void expect_same(const BodySurface& got, const BodySurface& sent) {
  EXPECT_EQ(got.file_digest, sent.file_digest);
  EXPECT_EQ(got.low, sent.low);
  EXPECT_EQ(got.high, sent.high);
  EXPECT_EQ(got.triangle_count, sent.triangle_count);
  EXPECT_EQ(got.vertices, sent.vertices);
  EXPECT_EQ(got.triangles, sent.triangles);
}

TEST(BodyShapeOnTheWire, RoundTrip) {
  const auto surface = tetrahedron(4.0F);
  const wire::BodyShapeSample sample(*surface, 7, 99);
  EXPECT_EQ(sample.get().source, 99U);
  EXPECT_EQ(sample.get().body, 7U);
  EXPECT_FALSE(wire::find_fault(sample.get()));
  expect_same(wire::from_wire(sample.get()), *surface);
}

TEST(BodyShapeOnTheWire, WhatNoMeshHasIsRefused) {
  const auto fault_of = [](const auto& change) {
    const auto surface = tetrahedron(4.0F);
    change(*surface);
    const wire::BodyShapeSample sample(*surface, 7, 99);
    const auto fault = wire::find_fault(sample.get());
    return fault ? to_string(*fault) : "";
  };
  EXPECT_THAT(fault_of([](BodySurface& s) { s.triangles[3][1] = 4; }), HasSubstr("corners: name a vertex"));
  EXPECT_THAT(fault_of([](BodySurface& s) { s.triangles[0][0] = 0xFFFFFFFF; }), HasSubstr("corners"));
  EXPECT_THAT(fault_of([](BodySurface& s) { s.vertices.clear(); }), HasSubstr("corners: are of no vertices"));
  EXPECT_THAT(fault_of([](BodySurface& s) { s.vertices[2].y() = std::numeric_limits<float>::quiet_NaN(); }),
              HasSubstr("vertices: is nan"));
  EXPECT_THAT(fault_of([](BodySurface& s) { s.low.x() = 5.0; }), HasSubstr("box_max: is below box_min"));
  EXPECT_THAT(fault_of([](BodySurface& s) { s.triangles.resize(BodySurface::kMostTriangles + 1); }),
              HasSubstr("corners: has 300003 items; allowed: at most 300000"));
  EXPECT_EQ(fault_of([](BodySurface& s) { s.triangles.resize(BodySurface::kMostTriangles); }), "");
}

TEST_F(Loopback, LateViewerGetsTheShapesOfTheBodies) {
  participant_ = join_dds(test_settings());
  const SceneInfo scene = scene_with_shape(4.0F);
  publisher_ = std::make_unique<FramePublisher>(participant_, scene);
  receiver_ = std::make_unique<FrameReceiver>(test_settings());
  ASSERT_TRUE(eventually([this] {
    const auto info = receiver_->scene_info();
    return info && info->bodies[0].surface;
  }));
  expect_same(*receiver_->scene_info()->bodies[0].surface, *scene.bodies[0].surface);
}

TEST_F(Loopback, ShapesAreThoseOfTheServerThatIsFollowed) {
  participant_ = join_dds(test_settings());
  publisher_ = std::make_unique<FramePublisher>(participant_, scene_with_shape(4.0F));
  receiver_ = std::make_unique<FrameReceiver>(test_settings());
  const auto length = [this] {
    const auto info = receiver_->scene_info();
    return info && info->bodies[0].surface ? info->bodies[0].surface->high.x() : 0.0;
  };
  ServerStatus status;
  publisher_->submit_status(status);  // heard twice a second from now on
  ASSERT_TRUE(eventually([&] { return length() == 4.0; }));
  FramePublisher second(participant_, scene_with_shape(64.0F));
  second.submit_status(status);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_EQ(length(), 4.0) << "the first lives";
  publisher_.reset();
  EXPECT_TRUE(eventually([&] { return length() == 64.0; })) << "said once, before it was followed";
}

}  // namespace
}  // namespace pelagos
