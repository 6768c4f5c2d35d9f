// What an accepted scene holds.

#include <gmock/gmock.h>

#include "scene_text.hpp"
#include "values/lattice.hpp"

namespace pelagos {
namespace {

using test::kBody;
using test::read_with;

TEST(SceneFile, TakesTheDefaultsOfWhatIsLeftOut) {
  const SceneResult result = read_with("");
  ASSERT_TRUE(result) << result.report();
  const Scene& scene = *result.scene;
  EXPECT_EQ(scene.seed, 1u);
  EXPECT_EQ(scene.gravity, 9.81);
  EXPECT_EQ(scene.water.rest_density, 1000.0);
  EXPECT_LT(scene.water.kinematic_viscosity, 0.0);
  EXPECT_EQ(scene.solver.density.tolerance, 3e-4);
  EXPECT_EQ(scene.solver.method, PressureMethod::kConjugateGradient);
  EXPECT_FALSE(scene.wind);
  EXPECT_EQ(scene.frame_interval, 1.0 / 30.0);
  EXPECT_EQ(particle_count(scene), 10 * 10 * 10);
}

TEST(SceneFile, ReadsShapes) {
  const std::pair<const char*, const char*> cases[] = {
      {"box { size { x: 2 y: 1 z: 0.5 } }", "primitive:box:2x1x0.5"},
      {"sphere { radius: 0.25 }", "primitive:sphere:0.25"},
      {"cylinder { radius: 0.5 length: 4 }", "primitive:cylinder:0.5x4"},
      {"capsule { radius: 0.5 length: 4 }", "primitive:capsule:0.5x4"}};
  for (const auto& [text, name] : cases) {
    const SceneResult result =
        read_with("body { id: 1 position { x: 1 y: 1 z: 1 } shape { " + std::string(text) + " } }");
    ASSERT_TRUE(result) << result.report();
    const BodySettings& body = result.scene->bodies.at(0);
    ASSERT_TRUE(body.primitive);
    EXPECT_EQ(name_of(*body.primitive), name);
    EXPECT_TRUE(body.mesh_file.empty());
  }
}

TEST(SceneFile, ReadsEveryFieldIntoItsPlace) {
  const SceneResult result = read_with(
      "seed: 18446744073709551615 gravity: 1.62 tank_walls_visible: true frame_rate: 60\n"
      "solver { kind: HYBRID method: JACOBI density { tolerance: 1e-4 min_iterations: 3 max_iterations: 50 }\n"
      "  divergence { tolerance: 2e-3 min_iterations: 4 max_iterations: 60 } }\n"
      "time_step { cfl: 0.3 max_step: 0.005 }\n"
      "wind { speed: 10 from_deg: 270 amplitude: 2 length: 5 beta: 1 pulse { period: 8 width: 3 } }\n"
      "far_sea { beaufort: 6 wave_to_deg: 45 components: 12 }\n"
      "origin { latitude_deg: 38.9 longitude_deg: 121.6 height: 3 }\n"
      "surface { publish_all: true detection_threshold: 0.2 halo: 0.5 }\n"
      "body { id: 7 name: \"tug\" mesh_file: \"tug.glb\" mesh_scale: 2 mesh_axes: Z_FORWARD_Y_UP open: true "
      "sample_inset: 0.5 drive: STATIC\n"
      "  position { x: 1 y: 1.5 z: 0.5 } orientation { w: 0.6 z: 0.8 } }\n");
  ASSERT_TRUE(result) << result.report();
  const Scene& s = *result.scene;
  EXPECT_EQ(s.seed, 18446744073709551615u);
  EXPECT_EQ(s.gravity, 1.62);
  EXPECT_TRUE(s.tank_walls_visible);
  EXPECT_EQ(s.frame_interval, 1.0 / 60.0);
  EXPECT_EQ(s.solver.method, PressureMethod::kJacobi);
  EXPECT_EQ(s.solver.density.tolerance, 1e-4);
  EXPECT_EQ(s.solver.density.min_iterations, 3);
  EXPECT_EQ(s.solver.density.max_iterations, 50);
  EXPECT_EQ(s.solver.divergence.tolerance, 2e-3);
  EXPECT_EQ(s.solver.divergence.min_iterations, 4);
  EXPECT_EQ(s.solver.divergence.max_iterations, 60);
  EXPECT_EQ(s.time_step.cfl, 0.3);
  EXPECT_EQ(s.time_step.max_step, 0.005);
  ASSERT_TRUE(s.wind);
  EXPECT_NEAR(s.wind->velocity.x(), 10.0, 1e-12);  // from the west: towards the east; sin and cos round
  EXPECT_NEAR(s.wind->velocity.y(), 0.0, 1e-12);
  EXPECT_EQ(s.wind->amplitude, 2.0);
  EXPECT_EQ(s.wind->length, 5.0);
  EXPECT_EQ(s.wind->beta, 1.0);
  ASSERT_TRUE(s.wind->pulse);
  EXPECT_EQ(s.wind->pulse->period, 8.0);
  EXPECT_EQ(s.wind->pulse->width, 3.0);
  EXPECT_EQ(s.far_sea.beaufort, 6);
  EXPECT_EQ(s.far_sea.wave_to_deg, 45.0);
  EXPECT_EQ(s.far_sea.components, 12u);
  EXPECT_EQ(s.origin.latitude_deg, 38.9);
  EXPECT_EQ(s.origin.longitude_deg, 121.6);
  EXPECT_EQ(s.origin.height, 3.0);
  EXPECT_TRUE(s.surface.publish_all);
  EXPECT_EQ(s.surface.detection_threshold, 0.2);
  EXPECT_EQ(s.surface.halo, 0.5);
  ASSERT_EQ(s.bodies.size(), 1u);
  EXPECT_EQ(s.bodies[0].id, 7u);
  EXPECT_EQ(s.bodies[0].name, "tug");
  EXPECT_EQ(s.bodies[0].mesh_scale, 2.0);
  EXPECT_EQ(s.bodies[0].mesh_axes, MeshAxes::kZForwardYUp);
  EXPECT_TRUE(s.bodies[0].open);
  EXPECT_FALSE(s.bodies[0].primitive);
  EXPECT_EQ(s.bodies[0].sample_inset, 0.5);
  EXPECT_EQ(s.bodies[0].drive, BodyDrive::kStatic);
  EXPECT_EQ(s.bodies[0].position, Eigen::Vector3d(1.0, 1.5, 0.5));
  EXPECT_NEAR(s.bodies[0].orientation.z(), 0.8, 1e-12);  // normalising rounds
}

TEST(SceneFile, TurnsShipAnglesIntoTheWorldFrame) {
  const auto axis = [](const char* angles, const Eigen::Vector3d& body_axis) {
    const SceneResult result = read_with(std::string(kBody) + angles + " }");
    EXPECT_TRUE(result) << result.report();
    return result ? Eigen::Vector3d(result.scene->bodies[0].orientation * body_axis) : Eigen::Vector3d();
  };
  const Eigen::Vector3d forward = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d port = Eigen::Vector3d::UnitY();
  constexpr double kRounding = 1e-12;
  EXPECT_TRUE(axis("", forward).isApprox(Eigen::Vector3d::UnitY(), kRounding));                 // north
  EXPECT_TRUE(axis("heading_deg: 90", forward).isApprox(Eigen::Vector3d::UnitX(), kRounding));  // east
  EXPECT_TRUE(axis("heading_deg: 90", port).isApprox(Eigen::Vector3d::UnitY(), kRounding));     // port is north
  EXPECT_GT(axis("pitch_deg: 10", forward).z(), 0.17);  // bow up by sin 10 degrees = 0.1736
  EXPECT_GT(axis("roll_deg: 10", port).z(), 0.17);      // starboard down: port up
}

TEST(SceneFile, ABodyIsFreeAlongItsOwnAxes) {
  const auto freedoms = [](const std::string& text) {
    const SceneResult result = read_with(
        "body { id: 1 mesh_file: \"a.obj\" position { x: 1 y: 1 z: 1 } drive: FREE mass { kg: 1 } " + text + " }");
    EXPECT_TRUE(result) << result.report();
    return result ? result.scene->bodies[0].freedoms : Freedoms{};
  };
  EXPECT_TRUE(freedoms("").all());
  const Freedoms heave = freedoms("heading_deg: 37 free: HEAVE");
  EXPECT_EQ(heave.along, Eigen::Vector3d(0.0, 0.0, 1.0));
  EXPECT_EQ(heave.about, Eigen::Vector3d(0.0, 0.0, 0.0));
  const Freedoms east = freedoms("heading_deg: 90 roll_deg: 10 free: [HEAVE, ROLL, SURGE]");
  EXPECT_EQ(east.along, Eigen::Vector3d(1.0, 0.0, 1.0));
  EXPECT_EQ(east.about, Eigen::Vector3d(1.0, 0.0, 0.0));
  const Freedoms north = freedoms("free: [YAW, ROLL, SURGE]");
  EXPECT_EQ(north.along, Eigen::Vector3d(0.0, 1.0, 0.0));
  EXPECT_EQ(north.about, Eigen::Vector3d(0.0, 1.0, 1.0));
}

TEST(SceneFile, AHoldStartsAsTheBodySays) {
  const auto hold_of = [](const std::string& text) {
    return read_with("body { id: 1 mesh_file: \"a.obj\" position { x: 1 y: 1 z: 1 } " + text + " }")
        .scene->bodies[0]
        .hold;
  };
  EXPECT_EQ(hold_of(""), HoldStart::kDefault);
  EXPECT_EQ(hold_of("hold: DRY"), HoldStart::kDry);
  EXPECT_EQ(hold_of("hold: FLOODED"), HoldStart::kFlooded);
}

TEST(SceneFile, WindHasTheLawThatItNames) {
  const auto wind_of = [](const std::string& text) {
    return *read_with("wind { velocity { x: 9 } " + text + " }").scene->wind;
  };
  EXPECT_EQ(wind_of("").law, WindLaw::kGust);
  EXPECT_EQ(wind_of("").roughness, 2e-4);
  EXPECT_EQ(wind_of("law: GUST").law, WindLaw::kGust);
  EXPECT_EQ(wind_of("law: STRESS roughness: 0.001").law, WindLaw::kStress);
  EXPECT_EQ(wind_of("law: STRESS roughness: 0.001").roughness, 0.001);
  const WindSettings paper = wind_of("law: PAPER pulse { period: 10 width: 100 }");  // steps, as printed
  EXPECT_EQ(paper.law, WindLaw::kPaper);
  EXPECT_EQ(paper.roughness, 0.01);
  ASSERT_TRUE(paper.pulse);
  EXPECT_TRUE(never_closes(*paper.pulse));
}

}  // namespace
}  // namespace pelagos
