#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "simulation/world.hpp"
#include "small_patch.hpp"

namespace pelagos {
namespace {

using test::small_patch;
using testing::AllOf;
using testing::HasSubstr;

BodySettings make_body(std::uint32_t id, const Primitive& primitive, const Eigen::Vector3d& position, BodyDrive drive) {
  BodySettings body;
  body.id = id;
  body.name = "body " + std::to_string(id);
  body.primitive = primitive;
  body.position = position;
  body.drive = drive;
  return body;
}

BodySettings make_block(std::uint32_t id, const Eigen::Vector3d& position, BodyDrive drive = BodyDrive::kStatic) {
  return make_body(id, BoxShape{{1.0, 1.0, 1.0}}, position, drive);
}

/// Why the world of a scene cannot be made; empty if it can.
std::string refusal_of(const Scene& scene) {
  try {
    const World world(scene, {1, nullptr, {}});
    return {};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

Scene patch_with(const std::vector<BodySettings>& bodies) {
  Scene scene = small_patch();
  scene.water.settle_steps = 0;
  scene.bodies = bodies;
  return scene;
}

/// A sea bed that rises from z = 0.1 at x = -1 m to 0.7 at its end, an open mesh file.
class BedFile {
 public:
  /// @param end  x where it ends, m
  explicit BedFile(double end) : path_(testing::TempDir() + "pelagos_bed_" + std::to_string(getpid()) + ".obj") {
    std::ofstream(path_) << "v -1 -1 0.1\nv " << end << " -1 0.7\nv " << end
                         << " 5 0.7\nv -1 5 0.1\nf 1 2 3\nf 1 3 4\n";
  }
  ~BedFile() { std::filesystem::remove(path_); }
  BedFile(const BedFile&) = delete;
  BedFile& operator=(const BedFile&) = delete;
  [[nodiscard]] BodySettings body(bool open) const {
    BodySettings body;
    body.id = 3;
    body.name = "sea bed";
    body.mesh_file = path_;
    body.drive = BodyDrive::kStatic;
    body.open = open;
    return body;
  }

 private:
  std::string path_;
};

TEST(StaticBodies, AreSampledAmongTheWallsThatNeverMove) {
  Scene scene = patch_with({make_block(1, {2.5, 2.0, 0.9})}), bare = patch_with({});
  scene.solver.kind = bare.solver.kind = SolverKind::kHybrid;  // the corrected one meets their distance fields
  World world(scene, {1, nullptr, {}});
  const World empty(bare, {1, nullptr, {}});
  EXPECT_EQ(world.bodies().moving_sample_count(), 0u);
  EXPECT_GT(world.bodies().sample_count(), 20u);
  EXPECT_EQ(world.fluid().static_walls, empty.fluid().static_walls + world.bodies().sample_count());
  EXPECT_TRUE(world.fluid().moving_position.empty());
  for (int step = 0; step < 20; ++step) ASSERT_EQ(world.advance().report.not_finite, 0u);
  EXPECT_EQ(world.bodies().states().size(), 1u) << "viewers draw it";
  for (std::size_t i = 0; i < world.fluid().particles.count; ++i) {
    const Float4& p = world.fluid().particles.position[i];
    const Eigen::Vector3d x = Eigen::Vector3d(p.x, p.y, p.z) + world.patch().origin - Eigen::Vector3d(2.5, 2.0, 0.9);
    EXPECT_GT(x.cwiseAbs().maxCoeff(), 0.5 - 0.25) << "a particle deep inside the block";
  }
}

TEST(StaticBodies, AreMetByTheirDistanceFieldsWithoutSamples) {
  World world(patch_with({make_block(1, {2.5, 2.0, 0.9})}), {1, nullptr, {}});
  EXPECT_EQ(world.bodies().sample_count(), 0u);
  EXPECT_EQ(world.fluid().static_walls, 0u);
  ASSERT_EQ(world.fluid().solids.size(), 1u);
  EXPECT_LT(world.fluid().solids[0].body, 0) << "it never moves";
  for (int step = 0; step < 20; ++step) ASSERT_EQ(world.advance().report.not_finite, 0u);
  for (std::size_t i = 0; i < world.fluid().particles.count; ++i) {
    const Float4& p = world.fluid().particles.position[i];
    const Eigen::Vector3d x = Eigen::Vector3d(p.x, p.y, p.z) + world.patch().origin - Eigen::Vector3d(2.5, 2.0, 0.9);
    EXPECT_GT(x.cwiseAbs().maxCoeff(), 0.5 - 0.05) << "a particle inside the block";
  }
}

TEST(StaticBodies, StandAsFirmAsMovingOnesAtRest) {
  // The same block as STATIC and as POSE without poses: other lists, the same forces but for rounding.
  World fixed(patch_with({make_block(1, {2.5, 2.0, 0.9})}), {1, nullptr, {}});
  World held(patch_with({make_block(1, {2.5, 2.0, 0.9}, BodyDrive::kPose)}), {1, nullptr, {}});
  ASSERT_EQ(fixed.fluid().particles.count, held.fluid().particles.count);
  for (int step = 0; step < 10; ++step) {
    const double a = fixed.advance().report.kinetic_energy, b = held.advance().report.kinetic_energy;
    EXPECT_NEAR(a, b, 0.01 * b) << step;  // rounding grows where water is pushed about: 1 % over ten steps
  }
}

TEST(StaticBodies, SamplesOutOfTheWatersReachAreLeftOut) {
  // A quay of 9 m length, of which 1 m is in the patch of 5 m.
  Scene scene = patch_with({make_body(1, BoxShape{{9.0, 2.0, 2.0}}, {0.0, 2.0, 1.0}, BodyDrive::kStatic)});
  scene.solver.kind = SolverKind::kHybrid;
  const World world(scene, {1, nullptr, {}});
  for (const Float4& sample : world.bodies().static_samples(PatchFrame{})) EXPECT_GE(sample.x, -0.5F);
}

TEST(StaticBodies, AnOpenSeaBedHoldsTheWater) {
  const BedFile bed(6.0);
  Scene scene = patch_with({bed.body(true)});
  scene.water.settle_steps = 50;
  World world(scene, {1, nullptr, {}});
  const std::size_t count = world.fluid().particles.count;
  EXPECT_LT(count, 1600u * 3 / 4) << "no water starts under the bed";
  EXPECT_GT(count, 1600u / 4);
  for (int step = 0; step < 100; ++step) ASSERT_EQ(world.advance().report.not_finite, 0u);
  for (std::size_t i = 0; i < count; ++i) {
    const Float4& p = world.fluid().particles.position[i];
    const Eigen::Vector3d x = Eigen::Vector3d(p.x, p.y, p.z) + world.patch().origin;
    const double bed_level = 0.1 + (x.x() + 1.0) * 0.6 / 7.0;
    EXPECT_GT(x.z(), bed_level - 0.6 * 0.25) << "below its samples";
  }
}

TEST(BodyFaults, AClosedMeshIsMeantUnlessTheSceneSaysOpen) {
  const BedFile bed(6.0);
  EXPECT_THAT(refusal_of(patch_with({bed.body(false)})),
              AllOf(HasSubstr("body 3 (sea bed): "), HasSubstr("open edge: only the face at line "),
                    HasSubstr("says open: true")));
}

TEST(BodyFaults, ARimMustNotStandInWater) {
  const BedFile bed(3.0);
  EXPECT_THAT(refusal_of(patch_with({bed.body(true)})),
              AllOf(HasSubstr("rim of its open mesh stands in water"), HasSubstr("at (3, ")));
}

TEST(BodyFaults, BodiesMustNotStandInOneAnother) {
  const Eigen::Vector3d middle(2.5, 2.0, 1.5);
  EXPECT_THAT(refusal_of(patch_with({make_block(1, middle, BodyDrive::kPose), make_block(2, middle)})),
              AllOf(HasSubstr("body 1 (body 1): stands in body 2 (body 2): "), HasSubstr("bodies apart at the start")));
  EXPECT_EQ(refusal_of(patch_with({make_block(1, middle), make_block(2, middle + Eigen::Vector3d(0.5, 0.0, 0.0))})), "")
      << "a tower on a rock";
  EXPECT_THAT(
      refusal_of(patch_with({make_body(1, SphereShape{0.3}, middle, BodyDrive::kStatic), make_block(2, middle)})),
      HasSubstr("stands in body 2"));
  const Eigen::Vector3d beside(1.0, 0.0, 0.0);
  EXPECT_EQ(refusal_of(patch_with({make_block(1, middle, BodyDrive::kPose), make_block(2, middle + beside)})), "");
}

TEST(BodyFaults, ABodyMustBeInThePatch) {
  const BodySettings outside = make_body(1, BoxShape{{1.0, 1.0, 1.0}}, {9.0, 2.0, 1.0}, BodyDrive::kStatic);
  EXPECT_THAT(refusal_of(patch_with({outside})),
              AllOf(HasSubstr("outside the patch, at (8.5, 1.5, 0.5) to (9.5, 2.5, 1.5) m"), HasSubstr("(5, 4, 3)")));
}

TEST(BodyFaults, AThinPlateIsABody) {
  EXPECT_EQ(refusal_of(patch_with({make_body(1, BoxShape{{1.0, 1.0, 0.001}}, {2.5, 2.0, 2.0}, BodyDrive::kStatic)})),
            "");
}

TEST(World, DescribesShapesToViewers) {
  const World world(patch_with({make_block(1, {2.5, 2.0, 0.9})}), {1, nullptr, {}});
  EXPECT_EQ(world.describe().bodies.at(0).mesh_file, "primitive:box:1x1x1");
}

}  // namespace
}  // namespace pelagos
