#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "floating.hpp"
#include "simulation/world.hpp"

namespace pelagos {
namespace {

using test::body_of;
using test::expect_sound;
using test::run_until;

struct Block {
  Eigen::Vector3d low, high;
};

/// An OBJ file in the temporary folder with one box for each block, and a cavity for each hole.
class BlocksFile {
 public:
  explicit BlocksFile(const std::vector<Block>& blocks, const std::vector<Block>& holes = {})
      : path_(std::filesystem::temp_directory_path() / ("pelagos_blocks_" + std::to_string(getpid()) + ".obj")) {
    std::ofstream out(path_);
    for (const Block& block : blocks) write(out, block, false);
    for (const Block& hole : holes) write(out, hole, true);
  }
  ~BlocksFile() { std::filesystem::remove(path_); }
  BlocksFile(const BlocksFile&) = delete;
  BlocksFile& operator=(const BlocksFile&) = delete;
  [[nodiscard]] std::string path() const { return path_.string(); }

 private:
  void write(std::ofstream& out, const Block& block, bool inwards) {
    for (int n = 0; n < 8; ++n)
      out << "v " << (n & 1 ? block.high : block.low).x() << ' ' << (n & 2 ? block.high : block.low).y() << ' '
          << (n & 4 ? block.high : block.low).z() << '\n';
    for (const auto& [a, b, c, d] : {std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4},
                                     std::array{2, 6, 7, 3}, std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}}) {
      out << "f " << first_ + a << ' ' << first_ + (inwards ? d : b) << ' ' << first_ + c << ' '
          << first_ + (inwards ? b : d) << '\n';
    }
    first_ += 8;
  }
  std::filesystem::path path_;
  int first_ = 1;
};

/// A quay wall across a patch, water on one side, 9 particles deep; seconds that it has to hold it.
struct Leak {
  std::size_t inside = 0, behind = 0;
};
Leak leak_through(const std::vector<Block>& wall, double seconds) {
  const BlocksFile file(wall);
  Scene scene;
  scene.particle_spacing = 0.1;
  scene.patch = {{-1.2, 0, 0}, {1.2, 0.8, 1.4}};
  scene.water.blocks = {{{-1.2, 0, 0}, {-0.3, 0.8, 0.9}}};
  scene.water.settle_steps = 50;
  BodySettings quay;
  quay.id = 1;
  quay.drive = BodyDrive::kStatic;
  quay.mesh_file = file.path();
  scene.bodies = {quay};
  World world(scene, {2, nullptr, {}});
  run_until(world, seconds, expect_sound);
  Leak leak;
  const FluidParticles& p = world.fluid().particles;
  for (std::size_t i = 0; i < p.count; ++i) {
    const double x = static_cast<double>(p.position[i].x) + world.patch().origin.x();
    leak.inside += x > -0.28 && x < 0.28 ? 1 : 0;
    leak.behind += x >= 0.28 ? 1 : 0;
  }
  return leak;
}

/// Five blocks that make an open boat of 2 x 1.2 x 0.8 m with plates of two spacings; her bottom is at z = 0.
std::vector<Block> open_boat() {
  return {{{-1, -0.6, 0}, {1, 0.6, 0.2}},
          {{-1, -0.6, 0}, {-0.8, 0.6, 0.8}},
          {{0.8, -0.6, 0}, {1, 0.6, 0.8}},
          {{-1, -0.6, 0}, {1, -0.4, 0.8}},
          {{-1, 0.4, 0}, {1, 0.6, 0.8}}};
}

TEST(MeshPartRuns, AnOpenBoatThatJustFitsIsLoweredAndFloatsByHerWeight) {
  const BlocksFile file(open_boat());
  Scene scene;
  scene.particle_spacing = 0.1;
  scene.patch = {{-1, -1.5, -1}, {1, 1.5, 1}};
  scene.patch_edges = {PatchEdge::kMirror, PatchEdge::kMirror, PatchEdge::kMirror};
  scene.water.blocks = {{{-1, -1.5, -1}, {1, 1.5, 0}}};
  scene.water.settle_steps = 100;
  BodySettings boat;
  boat.id = 1;
  boat.drive = BodyDrive::kFree;
  boat.mesh_file = file.path();
  boat.mass.mass = 960.0;
  boat.position = {0, 0, 0.05};
  scene.bodies = {boat};
  World world(scene, {2, nullptr, {}});
  Snapshot snapshot;
  StepReport report;
  double buoyant = 0.0, bottom = 0.0;
  int frames = 0;
  run_until(world, 24.0, [&](const WorldStep& step) {
    expect_sound(step);
    if (!step.frame_reached || world.time() < 16.0) return;
    world.take_frame(snapshot, report);
    buoyant += snapshot.loads[0].buoyant_force.z();
    bottom += body_of(world).position.z();
    ++frames;
  });
  EXPECT_NEAR(buoyant / frames / (960.0 * 9.81), 1.0, 0.015);
  EXPECT_NEAR(bottom / frames, 0.96 / 6.0 - 0.4, 0.006) << "the level rises by what she displaces";
  EXPECT_EQ(world.bodies().holds().at(0).water, 0.0);
}

TEST(MeshPartRuns, AWallOfBlocksThatOverlapHoldsWaterAsOneBlockDoes) {
  const double seconds = 3.0;
  for (const std::vector<Block>& wall :
       {std::vector<Block>{{{-0.3, -0.2, -0.2}, {0.3, 1.0, 1.4}}},
        std::vector<Block>{{{-0.3, -0.2, -0.2}, {0.3, 0.55, 1.4}}, {{-0.3, 0.25, -0.2}, {0.3, 1.0, 1.4}}},
        std::vector<Block>{{{-0.3, -0.2, -0.2}, {0.3, 0.4, 1.4}}, {{-0.3, 0.4, -0.2}, {0.3, 1.0, 1.4}}},
        std::vector<Block>{{{-0.3, -0.2, -0.2}, {0.3, 1.0, 0.5}}, {{-0.3, -0.2, 0.3}, {0.3, 1.0, 1.4}}}}) {
    const Leak leak = leak_through(wall, seconds);
    EXPECT_EQ(leak.inside, 0u) << wall.size() << " blocks, the first up to " << wall[0].high.transpose();
    EXPECT_EQ(leak.behind, 0u) << wall.size() << " blocks, the first up to " << wall[0].high.transpose();
  }
}

/// Mean height of a free body of half the water's density over the second second of its run, m. It starts higher by
/// `lift` (m) than where a solid one floats.
double floating_height(const std::vector<Block>& blocks, const std::vector<Block>& holes = {}, double lift = 0.0) {
  const BlocksFile file(blocks, holes);
  Scene scene = test::floating_box(0.5);
  scene.bodies[0].primitive.reset();
  scene.bodies[0].mesh_file = file.path();
  scene.bodies[0].position.z() += lift;
  World world(scene, {2, nullptr, {}});
  double sum = 0.0, time = 0.0;
  run_until(world, 2.0, [&](const WorldStep& step) {
    expect_sound(step);
    if (world.time() < 1.0) return;
    sum += step.report.dt * body_of(world).position.z();
    time += step.report.dt;
  });
  return sum / time;
}

TEST(MeshPartRuns, AHullOfPartsFloatsAsTheirUnion) {
  const double whole = floating_height({{{-0.6, -0.6, -0.4}, {0.6, 0.6, 0.4}}});
  EXPECT_NEAR(floating_height({{{-0.6, -0.6, -0.4}, {0.1, 0.6, 0.4}}, {{-0.1, -0.6, -0.4}, {0.6, 0.6, 0.4}}}), whole,
              0.01);
  // Half the density over 1.152 less 0.486 m^3: it floats 0.231 instead of 0.4 m deep, in water that is 0.024 m lower;
  // the cavity stays dry.
  const double hollow =
      floating_height({{{-0.6, -0.6, -0.4}, {0.6, 0.6, 0.4}}}, {{{-0.45, -0.45, -0.3}, {0.45, 0.45, 0.3}}}, 0.145);
  EXPECT_NEAR(hollow - whole, 0.169 - 0.024, 0.03);
}

}  // namespace
}  // namespace pelagos
