// Bodies in the hollow of others: what they touch is the mesh, not its convex hull.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "rigid/convex_hull.hpp"
#include "shapes/primitive.hpp"
#include "simulation/world.hpp"

namespace pelagos {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// A dock that is a U across x, 3 m wide, 2 m long, walls 0.5 m and floor 0.5 m thick, walls 1.5 m high inside.
class DockFile {
 public:
  DockFile() : path_(testing::TempDir() + "pelagos_dock_" + std::to_string(getpid()) + ".obj") {
    constexpr double kProfile[8][2] = {{-1.5, -0.5}, {1.5, -0.5}, {1.5, 1.5}, {1, 1.5},
                                       {1, 0},       {-1, 0},     {-1, 1.5},  {-1.5, 1.5}};
    constexpr int kEnd[6][3] = {{1, 2, 5}, {2, 3, 4}, {2, 4, 5}, {1, 5, 6}, {1, 6, 7}, {1, 7, 8}};
    std::ofstream file(path_);
    for (const double y : {-1.0, 1.0})
      for (const auto& [x, z] : kProfile) file << "v " << x << ' ' << y << ' ' << z << '\n';
    for (const auto& [a, b, c] : kEnd) {
      file << "f " << a << ' ' << b << ' ' << c << '\n';
      file << "f " << a + 8 << ' ' << c + 8 << ' ' << b + 8 << '\n';
    }
    for (int k = 1; k <= 8; ++k) {
      const int next = k % 8 + 1;
      file << "f " << k << ' ' << k + 8 << ' ' << next << '\n';
      file << "f " << next << ' ' << k + 8 << ' ' << next + 8 << '\n';
    }
  }
  ~DockFile() { std::remove(path_.c_str()); }
  DockFile(const DockFile&) = delete;
  DockFile& operator=(const DockFile&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// The dock with its floor at z = 1 m and a ball between its walls, above a puddle in a corner of the patch.
Scene docked(const DockFile& dock, BodyDrive drive, double gravity) {
  Scene scene;
  scene.name = "docked";
  scene.particle_spacing = 0.25;
  scene.gravity = gravity;
  scene.patch = {{-4, -4, 0}, {4, 4, 4}};
  scene.water.blocks = {{{-4, -4, 0}, {-3, -3, 0.75}}};
  BodySettings body;
  body.id = 1;
  body.name = "dock";
  body.mesh_file = dock.path();
  body.drive = drive;
  body.position = {0, 0, 1};
  if (is_free(drive)) body.mass.density = 300.0;
  scene.bodies = {body};
  BodySettings ball;
  ball.id = 2;
  ball.name = "buoy";
  ball.primitive = SphereShape{0.4};
  ball.drive = BodyDrive::kFree;
  ball.mass.density = 500.0;
  ball.position = {0.2, 0.0, 1.6};
  scene.bodies.push_back(ball);
  return scene;
}

TEST(HollowContacts, ABuoyBetweenTheWallsOfADockTouchesNothing) {
  const DockFile dock;
  for (const BodyDrive drive : {BodyDrive::kStatic, BodyDrive::kPose}) {
    const Scene scene = docked(dock, drive, 0.0);
    World world(scene, {1, nullptr, {}});
    while (world.time() < 0.5) world.advance();
    const BodyState buoy = world.bodies().states()[1];
    EXPECT_LT((buoy.position - scene.bodies[1].position).norm(), 1e-9) << static_cast<int>(drive);
  }
}

TEST(HollowContacts, ABuoyFallsOnToTheFloorOfTheDock) {
  const DockFile dock;
  for (const BodyDrive drive : {BodyDrive::kStatic, BodyDrive::kPose}) {
    World world(docked(dock, drive, 9.81), {1, nullptr, {}});
    double lowest = 2.0;
    while (world.time() < 1.0) {
      world.advance();
      lowest = std::min(lowest, world.bodies().states()[1].position.z());
    }
    EXPECT_NEAR(world.bodies().states()[1].position.z(), 1.4, 0.05 * 0.25 + 0.01) << static_cast<int>(drive);
    EXPECT_GT(lowest, 1.4 - 0.25) << "through the floor";
  }
}

TEST(HollowContacts, ADockThatIsFreeIsRefusedWithABuoyInIt) {
  const DockFile dock;
  try {
    const World world(docked(dock, BodyDrive::kFree, 9.81), {1, nullptr, {}});
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("body 1 (dock): "), HasSubstr("body 2 (buoy) stands"),
                                    HasSubstr("convex hull"), HasSubstr("drive STATIC or POSE")));
  }
  Scene apart = docked(dock, BodyDrive::kFree, 9.81);
  apart.bodies[1].position = {0.0, 3.0, 1.6};
  EXPECT_NO_THROW(World(apart, {1, nullptr, {}}));
}

TEST(ConvexHull, TellsWhatAMeshLeavesEmpty) {
  EXPECT_NEAR(hollow_share(make_mesh(BoxShape{{3, 2, 1}})), 0.0, 1e-9);
  EXPECT_NEAR(hollow_share(make_mesh(SphereShape{0.5})), 0.0, 1e-6);
  const DockFile dock;
  EXPECT_NEAR(hollow_share(read_mesh(dock.path()).mesh), 2.0 * 1.5 / (3.0 * 2.0), 1e-9);
}

TEST(HollowContacts, AFreeHollowBodyIsToldToTouchAsItsHull) {
  const DockFile dock;
  Scene scene = docked(dock, BodyDrive::kFree, 0.0);
  scene.bodies[1].position = {3.0, 0.0, 1.6};
  EXPECT_THAT(World(scene, {1, nullptr, {}}).start_notes(),
              Contains(AllOf(HasSubstr("body 1 (dock): it touches other bodies as the convex hull of its mesh"),
                             HasSubstr("100 % larger"))));
  scene.bodies.pop_back();
  EXPECT_THAT(World(scene, {1, nullptr, {}}).start_notes(), Not(Contains(HasSubstr("convex hull"))));
  Scene still = docked(dock, BodyDrive::kStatic, 0.0);
  EXPECT_THAT(World(still, {1, nullptr, {}}).start_notes(), Not(Contains(HasSubstr("convex hull"))));
}

}  // namespace
}  // namespace pelagos
