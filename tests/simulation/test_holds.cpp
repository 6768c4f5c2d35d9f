// Holds of open boats: dry unless the sea reaches them over the rim, and counted in the buoyant part.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <fstream>

#include "simulation/hold.hpp"
#include "simulation/world.hpp"

namespace pelagos {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kWeight = 1000.0 * 9.81;  // N/m^3
constexpr std::array<std::array<int, 4>, 4> kSides{{{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

/// An open box, 3 x 2 x 1 m outside, walls and bottom of a given thickness (m); its bottom at z = 0.
class BoatFile {
 public:
  explicit BoatFile(double plate = 0.25)
      : path_(testing::TempDir() + "pelagos_boat_" + std::to_string(getpid()) + ".obj") {
    std::ofstream file(path_);
    const auto ring = [&](double half_x, double half_y, double z) {
      for (const auto& [x, y] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)})
        file << "v " << x * half_x << ' ' << y * half_y << ' ' << z << '\n';
    };
    ring(1.5, 1.0, 0.0), ring(1.5, 1.0, 1.0), ring(1.5 - plate, 1.0 - plate, plate),
        ring(1.5 - plate, 1.0 - plate, 1.0);
    const auto quad = [&](int a, int b, int c, int d) {
      file << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << "\nf " << a + 1 << ' ' << c + 1 << ' ' << d + 1 << '\n';
    };
    quad(0, 3, 2, 1);
    quad(8, 9, 10, 11);
    for (const auto& [a, b, c, d] : kSides) {
      quad(a, b, c, d);
      quad(b + 8, a + 8, d + 8, c + 8);
      quad(d, c, c + 8, d + 8);
    }
  }
  ~BoatFile() { std::remove(path_.c_str()); }
  BoatFile(const BoatFile&) = delete;
  BoatFile& operator=(const BoatFile&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// The boat in a patch of 6 x 5 x 3 m with 1.5 m of water, its level at z = 0; d = 0.125 m.
/// @param bottom  z of the boat's bottom, m
Scene afloat(const BoatFile& boat, double bottom, BodyDrive drive = BodyDrive::kFree) {
  Scene scene;
  scene.name = "afloat";
  scene.particle_spacing = 0.125;
  scene.patch = {{-3, -2.5, -1.5}, {3, 2.5, 1.5}};
  scene.patch_edges = {PatchEdge::kMirror, PatchEdge::kMirror, PatchEdge::kMirror};
  scene.water.blocks = {{{-3, -2.5, -1.5}, {3, 2.5, 0}}};
  scene.water.settle_steps = 1;  // a snapshot needs neighbours
  BodySettings body;
  body.id = 1;
  body.name = "lighter";
  body.mesh_file = boat.path();
  body.drive = drive;
  if (is_free(drive)) body.mass.mass = 3000.0;
  body.position = {0, 0, bottom};
  scene.bodies = {body};
  return scene;
}

BodyLoad load_of(World& world) {
  Snapshot snapshot;
  StepReport report;
  world.take_frame(snapshot, report);
  return snapshot.loads.at(0);
}

TEST(Holds, OfAnOpenBoatIsTheRoomBelowItsRim) {
  const BoatFile boat;
  const BodyShape shape = load_body_shape(boat.path(), {}, 0.125, 0.61);
  const Hold hold(shape, 0.125);
  EXPECT_NEAR(hold.volume(), 2.5 * 1.5 * 0.75, 1e-9);
  EXPECT_NEAR(hold.below({Eigen::Vector3d::UnitZ(), 0.5}).volume, 2.5 * 1.5 * 0.25, 1e-6);
  EXPECT_NEAR(hold.below({Eigen::Vector3d::UnitZ(), 0.5}).moment.z(), 2.5 * 1.5 * 0.25 * 0.375, 1e-6);
  EXPECT_TRUE(hold.contains({0, 0, 0.3}));
  EXPECT_TRUE(hold.contains({1.24, 0.74, 0.26}));
  EXPECT_FALSE(hold.contains({0, 0, 1.2}));
  EXPECT_FALSE(hold.contains({0, 1.05, 0.3}));
}

TEST(Holds, OfThinPlatesAreClosedToo) {
  const BoatFile boat(0.004);
  const BodyShape shape = load_body_shape(boat.path(), {}, 0.125, 0.61);
  const Hold hold(shape, 0.125);
  EXPECT_NEAR(hold.volume(), 2.992 * 1.992 * 0.996, 0.03 * 6.0);
  EXPECT_FALSE(hold.contains({0, 1.03, 0.5}));
  EXPECT_TRUE(hold.contains({0, 0.97, 0.5}));
}

TEST(Holds, SolidBodiesHaveNone) {
  for (const Primitive& solid : {Primitive(BoxShape{{1, 1, 1}}), Primitive(SphereShape{0.5})})
    EXPECT_TRUE(Hold(make_body_shape(make_mesh(solid), 0.125, 0.6), 0.125).empty());
}

TEST(Holds, StartDryAndBearTheBoat) {
  // 3000 kg float at a draft of 0.5 m: the buoyant part is the weight.
  const BoatFile boat;
  World world(afloat(boat, -0.5), {1, nullptr, {}});
  EXPECT_NEAR(load_of(world).buoyant_force.z(), 3000.0 * 9.81, 45.0);
  EXPECT_NEAR(world.water_level(), 0.0, 1e-9);
  EXPECT_EQ(world.bodies().holds().at(0).water, 0.0);
  EXPECT_THAT(world.start_notes(),
              ElementsAre(AllOf(HasSubstr("body 1 (lighter): its hold of 2.81 m^3 starts dry"),
                                HasSubstr("0.938 m^3 of it below the level"), HasSubstr("hold: FLOODED"))));
}

TEST(Holds, OfABoatAboveTheWaterStartDry) {
  const BoatFile boat;
  World world(afloat(boat, 0.05), {1, nullptr, {}});
  EXPECT_THAT(world.start_notes(),
              ElementsAre(HasSubstr("its hold of 2.81 m^3 starts dry, above the level of the water")));
  EXPECT_NEAR(load_of(world).buoyant_force.norm(), 0.0, 1e-9);
}

TEST(Holds, OfSceneryAboveTheWaterNeedNoNote) {
  const BoatFile tub;
  EXPECT_THAT(World(afloat(tub, 0.05, BodyDrive::kStatic), {1, nullptr, {}}).start_notes(), IsEmpty());
}

TEST(Holds, OfABoatThatDipsBearItWithoutWaterInIt) {
  const BoatFile boat;
  World world(afloat(boat, 0.0), {1, nullptr, {}});
  while (world.time() < 0.3) world.advance();
  EXPECT_EQ(world.bodies().holds().at(0).water, 0.0);
  const BodyLoad load = load_of(world);
  const double draft = -world.bodies().states().at(0).position.z();
  EXPECT_GT(draft, 0.1);
  EXPECT_GT(load.buoyant_force.norm(), kWeight * 6.0 * draft) << "the water rises around her";
  EXPECT_LT(load.buoyant_force.norm(), kWeight * 6.0 * (draft + 0.25));
}

TEST(Holds, FloodedOnesAreToldAndWeighOnTheBoat) {
  const BoatFile boat;
  Scene scene = afloat(boat, -0.5);
  scene.bodies[0].hold = HoldStart::kFlooded;
  World world(scene, {1, nullptr, {}});
  // Water up to the level outside: 0.25 m in the hold; what is left of the buoyant part is the plating's.
  const double water = world.bodies().holds().at(0).water;
  EXPECT_NEAR(water, 2.5 * 1.5 * 0.25, 0.1);
  EXPECT_NEAR(load_of(world).buoyant_force.z(), kWeight * (3.0 - water), 45.0);
  EXPECT_THAT(world.start_notes(), Contains(HasSubstr("starts with 0.9")));
  EXPECT_THAT(world.start_notes(), Contains(HasSubstr("m^3 of water in it")));
}

TEST(Holds, TheSeaFillsAHoldWhoseRimIsUnderIt) {
  const BoatFile boat;
  const World world(afloat(boat, -1.25), {1, nullptr, {}});
  EXPECT_GT(world.bodies().holds().at(0).water, 0.85 * 2.5 * 1.5 * 0.75);
  EXPECT_THAT(world.start_notes(), Contains(HasSubstr("of water in it")));
}

TEST(Holds, ABlockInTheHoldIsPouredIn) {
  const BoatFile boat;
  Scene scene = afloat(boat, -0.5);
  scene.water.blocks[0].max.z() = -0.25;  // the sea ends below the hold's bottom
  scene.water.blocks.push_back({{-1, -0.5, -0.25}, {1, 0.5, 0.25}});
  const World world(scene, {1, nullptr, {}});
  EXPECT_NEAR(world.bodies().holds().at(0).water, 2.0 * 1.0 * 0.5, 0.15);
}

TEST(Holds, OfSceneryFillAsTheBlocksSay) {
  const BoatFile boat;
  Scene scene = afloat(boat, -0.5, BodyDrive::kStatic);
  const World full(scene, {1, nullptr, {}});
  EXPECT_GT(full.bodies().holds().at(0).water, 0.8);
  scene.bodies[0].hold = HoldStart::kDry;
  const World dry(scene, {1, nullptr, {}});
  EXPECT_EQ(dry.bodies().holds().at(0).water, 0.0);
}

TEST(Holds, ThinPlatingIsTold) {
  const BoatFile thin(0.06);
  EXPECT_THAT(World(afloat(thin, -0.5), {1, nullptr, {}}).start_notes(),
              Contains(HasSubstr("is thinner than 1.1 spacings (0.138 m) and has one layer")));
}

TEST(Holds, PlatingOfTwoSpacingsIsNoReasonForANote) {
  const BoatFile boat;  // as MeshPartRuns.AnOpenBoatThatJustFitsIsLoweredAndFloatsByHerWeight has it
  EXPECT_THAT(World(afloat(boat, -0.5), {1, nullptr, {}}).start_notes(), testing::Not(Contains(HasSubstr("plating"))));
}

}  // namespace
}  // namespace pelagos
