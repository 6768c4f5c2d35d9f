#include <gmock/gmock.h>

#include "scene_text.hpp"
#include "values/lattice.hpp"

namespace pelagos {
namespace {

using test::FaultCase;
using test::kBody;
using test::read_replacing;
using test::read_with;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

class SceneRange : public testing::TestWithParam<FaultCase> {};

TEST_P(SceneRange, RefusesNamingLineFieldAndWhatIsAllowed) { test::expect_only_fault(GetParam()); }

INSTANTIATE_TEST_SUITE_P(
    Fields, SceneRange,
    testing::Values(
        FaultCase{"Gravity", "gravity: -1", "gravity", "allowed: 0 to 100 m/s^2"},
        FaultCase{"GravityNan", "gravity: nan", "gravity", "nan is out of range"},
        FaultCase{"GravityInfinite", "gravity: inf", "gravity", "inf is out of range"},
        FaultCase{"GravityZeroWithoutStep", "gravity: 0", "gravity", "time_step.max_step"},
        FaultCase{"GravityZeroWithWind", "gravity: 0 time_step { max_step: 0.01 } wind { velocity { x: 1 } }", "wind",
                  "without gravity"},
        FaultCase{"FrameRate", "frame_rate: 0", "frame_rate", "allowed: 1 to 240 frames per second"},
        FaultCase{"Density", "solver { density { tolerance: 0 } }", "solver.density.tolerance", "1e-06 to 0.05"},
        FaultCase{"Divergence", "solver { divergence { tolerance: 0.5 } }", "solver.divergence.tolerance",
                  "0.5 is out"},
        FaultCase{"Iterations", "solver { density { max_iterations: 0 } }", "solver.density.max_iterations",
                  "1 to 1000"},
        FaultCase{"IterationsCrossed", "solver { density { min_iterations: 9 max_iterations: 8 } }",
                  "solver.density.min_iterations", "above max_iterations 8"},
        FaultCase{"Cfl", "time_step { cfl: 3 }", "time_step.cfl", "0.05 to 1"},
        // 0.14 sqrt(0.1 / 9.81) = 0.01413
        FaultCase{"MaxStep", "time_step { max_step: 0.02 }", "time_step.max_step", "to 0.01413"},
        FaultCase{"WindNothing", "wind { amplitude: 1 }", "wind", "exactly one of speed"},
        FaultCase{"WindTwice", "wind { speed: 5 from_deg: 10 beaufort: 3 }", "wind", "more than one way"},
        FaultCase{"WindNoDirection", "wind { speed: 5 }", "wind.from_deg", "is missing"},
        FaultCase{"WindDirection", "wind { speed: 5 from_deg: 361 }", "wind.from_deg", "0 to 360"},
        FaultCase{"WindDirectionTwice", "wind { velocity { x: 1 } from_deg: 10 }", "wind.from_deg", "velocity has it"},
        FaultCase{"WindSpeed", "wind { speed: 76 from_deg: 0 }", "wind.speed", "0 to 75 m/s"},
        FaultCase{"WindLong", "wind { velocity { x: 60 y: 60 } }", "wind.velocity", "allowed: 0 to 75 m/s"},
        FaultCase{"WindNan", "wind { velocity { y: nan } }", "wind.velocity.y", "nan is out of range"},
        FaultCase{"Beaufort", "wind { beaufort: 13 from_deg: 0 }", "wind.beaufort", "0 to 12"},
        FaultCase{"BeaufortNegative", "wind { beaufort: -1 from_deg: 0 }", "wind.beaufort", "-1 is out of range"},
        FaultCase{"WindAmplitude", "wind { velocity { x: 1 } amplitude: -1 }", "wind.amplitude", "0 to 30 m/s"},
        FaultCase{"WindLength", "wind { velocity { x: 1 } length: 0 }", "wind.length", "0.01 to 10000 m"},
        FaultCase{"WindBeta", "wind { velocity { x: 1 } beta: -2 }", "wind.beta", "0 to 100"},
        FaultCase{"PulsePeriod", "wind { velocity { x: 1 } pulse { period: 0 width: 1 } }", "wind.pulse.period",
                  "0.01"},
        FaultCase{"PulseWidth", "wind { velocity { x: 1 } pulse { period: 10 width: 100 } }", "wind.pulse.width",
                  "longer than the period"},
        FaultCase{"PulsePaperWidth", "wind { velocity { x: 1 } law: PAPER pulse { period: 10 width: 0.5 } }",
                  "wind.pulse.width", "allowed: 1 to 1000000 steps"},
        FaultCase{"WindRoughness", "wind { velocity { x: 1 } roughness: -0.1 }", "wind.roughness",
                  "-0.1 is out of range; allowed: 1e-06 to 5 m"},
        FaultCase{"WindRoughnessAtTheReference", "wind { velocity { x: 1 } roughness: 10 }", "wind.roughness",
                  "allowed: 1e-06 to 5 m"},
        FaultCase{"WindBetaOfStress", "wind { velocity { x: 1 } law: STRESS beta: 2 }", "wind.beta",
                  "GUST and PAPER only"},
        FaultCase{"PulseMissing", "wind { velocity { x: 1 } pulse { period: 10 } }", "wind.pulse.width", "is missing"},
        FaultCase{"FarSea", "far_sea { beaufort: 13 }", "far_sea.beaufort", "0 to 12"},
        FaultCase{"FarSeaComponents", "far_sea { components: 0 }", "far_sea.components", "1 to 128"},
        FaultCase{"FarSeaDirection", "far_sea { wave_to_deg: -1 }", "far_sea.wave_to_deg", "0 to 360"},
        FaultCase{"Latitude", "origin { latitude_deg: 91 }", "origin.latitude_deg", "-89.9 to 89.9"},
        FaultCase{"Longitude", "origin { longitude_deg: 181 }", "origin.longitude_deg", "-180 to 180"},
        FaultCase{"Height", "origin { height: 1e6 }", "origin.height", "-1000 to 10000 m"},
        FaultCase{"Threshold", "surface { detection_threshold: 2 }", "surface.detection_threshold", "0 to 1"},
        FaultCase{"Halo", "surface { halo: 9 }", "surface.halo", "0 to 2"},
        FaultCase{"BodyNoId", "body { mesh_file: \"a.obj\" position { } }", "body[0].id", "is missing"},
        FaultCase{"BodyId", "body { id: 0 mesh_file: \"a.obj\" position { } }", "body[0].id", "1 to 4294967295"},
        FaultCase{"BodyNoMesh", "body { id: 1 position { } }", "body[0].mesh_file", "is missing"},
        FaultCase{"BodyMeshReserved", "body { id: 1 mesh_file: \"y-up:hull.glb\" position { } }", "body[0].mesh_file",
                  "begins with a word"},
        FaultCase{"ShapeBesideMesh", "body { id: 1 mesh_file: \"a.obj\" shape { sphere { radius: 1 } } position { } }",
                  "body[0].shape", "one of the two"},
        FaultCase{"ShapeEmpty", "body { id: 1 shape { } position { } }", "body[0].shape", "exactly one of box"},
        FaultCase{"ShapeTwo",
                  "body { id: 1 shape { sphere { radius: 1 } capsule { radius: 1 length: 2 } } position { } }",
                  "body[0].shape", "has 2 entries"},
        FaultCase{"ShapeBoxSize", "body { id: 1 shape { box { size { x: 1 y: 2 } } } position { } }",
                  "body[0].shape.box.size.z", "is missing"},
        FaultCase{"ShapeBoxFlat", "body { id: 1 shape { box { size { x: 1 y: 2 z: 0 } } } position { } }",
                  "body[0].shape.box.size.z", "0.001 to 10000 m"},
        FaultCase{"ShapeNoLength", "body { id: 1 shape { cylinder { radius: 1 } } position { } }",
                  "body[0].shape.cylinder.length", "is missing"},
        FaultCase{"ShapeNan", "body { id: 1 shape { sphere { radius: nan } } position { } }",
                  "body[0].shape.sphere.radius", "nan is out of range"},
        FaultCase{"ShapeShortCapsule", "body { id: 1 shape { capsule { radius: 1 length: 1.5 } } position { } }",
                  "body[0].shape.capsule.length", "at least 2 m"},
        FaultCase{"ShapeScaled", "body { id: 1 shape { sphere { radius: 1 } } mesh_scale: 2 position { } }",
                  "body[0].mesh_scale", "goes with a mesh_file"},
        FaultCase{"BodyOpenMoving", "body { id: 1 mesh_file: \"a.obj\" open: true position { } }", "body[0].open",
                  "drive: STATIC only"},
        FaultCase{"BodyMeshEmpty", "body { id: 1 mesh_file: \"\" position { } }", "body[0].mesh_file", "1 to 1024"},
        FaultCase{"BodyNoPosition", "body { id: 1 mesh_file: \"a.obj\" }", "body[0].position", "is missing"},
        FaultCase{"BodyOutside", "body { id: 1 mesh_file: \"a.obj\" position { x: 9 } }", "body[0].position",
                  "outside the patch"}),
    [](const auto& entry) { return entry.param.name; });

class SceneBody : public testing::TestWithParam<FaultCase> {};

TEST_P(SceneBody, RefusesNamingLineFieldAndWhatIsAllowed) {
  const SceneResult result = read_with(std::string(kBody) + GetParam().text + " }");
  EXPECT_THAT(result.faults,
              ElementsAre(AllOf(StartsWith(std::string("test.scene:7: body[0].") + GetParam().field + ": "),
                                HasSubstr(GetParam().says))));
}

INSTANTIATE_TEST_SUITE_P(
    Fields, SceneBody,
    testing::Values(
        FaultCase{"Scale", "mesh_scale: 0", "mesh_scale", "0.001 to 1000"},
        FaultCase{"Inset", "sample_inset: 2", "sample_inset", "0 to 1"},
        FaultCase{"Heading", "heading_deg: 400", "heading_deg", "0 to 360"},
        FaultCase{"HeadingNan", "heading_deg: nan", "heading_deg", "nan is out of range"},
        FaultCase{"Pitch", "pitch_deg: 91", "pitch_deg", "-90 to 90"},
        FaultCase{"Roll", "roll_deg: -181", "roll_deg", "-180 to 180"},
        FaultCase{"Quaternion", "orientation { w: 0.5 }", "orientation", "has length 0.5"},
        FaultCase{"QuaternionZero", "orientation { }", "orientation", "has length 0;"},
        FaultCase{"QuaternionInfinite", "orientation { w: inf }", "orientation.w", "inf is out"},
        FaultCase{"FreeWithoutMass", "drive: FREE", "mass", "needs one, with kg or density"},
        FaultCase{"MassOfADriven", "mass { kg: 1 }", "mass", "drive FREE or POSE_HORIZONTAL"},
        FaultCase{"MassEmpty", "drive: FREE mass { }", "mass.kg", "both missing"},
        FaultCase{"MassTwice", "drive: FREE mass { kg: 1 density: 2 }", "mass.kg", "one of the two"},
        FaultCase{"MassZero", "drive: FREE mass { kg: 0 }", "mass.kg", "0 is out of range"},
        FaultCase{"MassNan", "drive: FREE mass { density: nan }", "mass.density", "nan is out of range"},
        FaultCase{"Gyration", "drive: FREE mass { kg: 1 gyration { x: 1 y: 1 z: 2 } }", "mass.gyration", "no solid's"},
        FaultCase{"GyrationZero", "drive: FREE mass { kg: 1 gyration { x: 1 y: 1 } }", "mass.gyration",
                  "all three above 0"},
        FaultCase{"VelocityOfADriven", "velocity { x: 1 }", "velocity", "allowed: with drive FREE"},
        FaultCase{"VelocityOfALed", "drive: POSE_HORIZONTAL mass { kg: 1 } velocity { x: 1 }", "velocity",
                  "allowed: with drive FREE"},
        FaultCase{"FreeFromOfADriven", "free_from: 3", "free_from", "allowed: with drive FREE"},
        FaultCase{"FreeOfADriven", "free: HEAVE", "free", "allowed: with drive FREE"},
        FaultCase{"FreeTwice", "drive: FREE mass { kg: 1 } free: HEAVE free: HEAVE", "free", "HEAVE is given twice"},
        FaultCase{"FreeToDoNothing", "drive: FREE mass { kg: 1 } free: FREEDOM_DEFAULT", "free", "is no motion"},
        FaultCase{"FreeToSurgeAskew", "drive: FREE mass { kg: 1 } heading_deg: 30 free: SURGE", "free",
                  "SURGE and SWAY differ"},
        FaultCase{"FreeToRollAskew", "drive: FREE mass { kg: 1 } heading_deg: 91 free: ROLL", "free",
                  "ROLL and PITCH differ"},
        FaultCase{"HoldOfAnOpenMesh", "drive: STATIC open: true hold: DRY", "hold", "allowed: with a closed mesh"},
        FaultCase{"FreeFromNegative", "drive: FREE mass { kg: 1 } free_from: -3", "free_from", "-3 is out of range"},
        FaultCase{"Both", "orientation { w: 1 } heading_deg: 3", "orientation", "not both"}),
    [](const auto& entry) { return entry.param.name; });

TEST(SceneFile, RefusesNegativeSpacing) {
  EXPECT_THAT(read_replacing("0.1", "-0.1").faults,
              ElementsAre(AllOf(StartsWith("test.scene:2: particle_spacing: -0.1 is out of range"),
                                HasSubstr("allowed: 0.001 to 100 m"))));
}

TEST(SceneFile, ChecksEverythingAgainstASpacingGivenInstead) {
  SceneReadOptions options;
  options.particle_spacing = 0.125;
  const SceneResult coarser = read_scene_text(test::kValid, "test.scene", options);
  ASSERT_TRUE(coarser) << coarser.report();
  EXPECT_EQ(coarser.scene->particle_spacing, 0.125);
  options.particle_spacing = 1e-4;  // the patch would need far too many samples
  EXPECT_THAT(read_scene_text(test::kValid, "test.scene", options).report(), HasSubstr("at this spacing"));
}

TEST(SceneFile, TellsRangesOfAWindGivenTwiceAsWell) {
  const std::string report = test::read_with("wind { beaufort: 14 from_deg: 400 speed: 3 }\n").report();
  EXPECT_THAT(report, HasSubstr("more than one way"));
  EXPECT_THAT(report, HasSubstr("wind.beaufort: 14 is out of range"));
  EXPECT_THAT(report, HasSubstr("wind.from_deg: 400 is out of range"));
}

TEST(SceneFile, RefusesWaterThatAnExplicitStepCannotKeepStable) {
  // 0.1 d^2 / (0.07 sqrt(d/g)) = 0.001 / 0.0070674 = 0.1415
  EXPECT_THAT(read_replacing("water {", "water { kinematic_viscosity: 0.2").faults,
              ElementsAre(AllOf(StartsWith("test.scene:4: water.kinematic_viscosity: 0.2"), HasSubstr("0 to 0.1414"))));
  EXPECT_TRUE(read_replacing("water {", "water { kinematic_viscosity: 0.14"));
}

TEST(SceneFile, AsksForAViscosityWhereTheDefaultIsUnstable) {
  // 0.1 d^2 / max_step = 0.001 / 0.1 = 0.01; the default would be 0.01 * 2^1.5 = 0.02828
  const std::string weightless = "gravity: 0 solver { kind: HYBRID } time_step { max_step: 0.1 } water {";
  EXPECT_THAT(read_replacing("water {", weightless).faults,
              ElementsAre(AllOf(StartsWith("test.scene:4: water.kinematic_viscosity: defaults to 0.02828"),
                                HasSubstr("give one: 0 to 0.01 m^2/s"))));
  EXPECT_TRUE(read_replacing("water {", weightless + " kinematic_viscosity: 0.009"));
  // The corrected solver needs none.
  EXPECT_TRUE(read_replacing("water {", "gravity: 0 time_step { max_step: 0.1 } water {"));
}

TEST(SceneFile, TakesItsNameFromTheFile) {
  std::string text = test::kValid;
  text.replace(0, text.find('\n'), "");
  const SceneResult result = read_scene_text(text, "/some/my scene (1).scene");
  ASSERT_TRUE(result) << result.report();
  EXPECT_EQ(result.scene->name, "my_scene__1_");
}

TEST(SceneFile, RefusesDensityAndSettlingOutOfRange) {
  EXPECT_THAT(read_replacing("water {", "water { rest_density: 1 settle_steps: -1").faults,
              ElementsAre(HasSubstr("water.rest_density: 1 is out of range; allowed: 500 to 2000 kg/m^3"),
                          HasSubstr("water.settle_steps: -1 is out of range; allowed: 0 to 5000")));
}

TEST(SceneFile, TellsThePresentNamesOfFieldsThatWereRenamed) {
  const SceneResult result = read_scene_text(
      "particle_spacing: 0.1\ntank { min { } max { x: 2 y: 2 z: 2 } }\ntank_edges { x: MIRROR }\n"
      "water { block { min { } max { x: 2 y: 2 z: 1 } } }\n",
      "old.scene");
  EXPECT_THAT(result.faults,
              testing::IsSupersetOf({"old.scene:2: tank: unknown field; its name is \"patch\" now",
                                     "old.scene:3: tank_edges: unknown field; its name is \"patch_edges\" now"}));
}

TEST(SceneFile, RefusesBlocksThatLeaveThePatch) {
  EXPECT_THAT(read_replacing("max { x: 1 y: 1 z: 1 }", "max { x: 1 y: 1 z: 3 }").faults,
              ElementsAre(AllOf(StartsWith("test.scene:5: water.block[0]: "), HasSubstr("inside the patch"))));
}

TEST(SceneFile, RefusesBlocksTooSmallForAParticle) {
  EXPECT_THAT(
      read_replacing("max { x: 1 y: 1 z: 1 }", "max { x: 1 y: 1 z: 0.09 }").faults,
      ElementsAre(AllOf(StartsWith("test.scene:5: water.block[0]: "), HasSubstr("at least (0.1, 0.1, 0.1) m"))));
  EXPECT_TRUE(read_replacing("max { x: 1 y: 1 z: 1 }", "max { x: 1 y: 1 z: 0.1 }"));
  // The paper's solvers sample the walls.
  const std::string hybrid = "solver { kind: HYBRID } water {";
  const auto with_height = [&](const char* z) {
    std::string text = test::kValid;
    text.replace(text.find("max { x: 1 y: 1 z: 1 }"), 22, std::string("max { x: 1 y: 1 z: ") + z + " }");
    return read_scene_text(text.replace(text.find("water {"), 7, hybrid), "test.scene");
  };
  EXPECT_THAT(with_height("0.15").faults,
              ElementsAre(AllOf(StartsWith("test.scene:5: water.block[0]: "), HasSubstr("at least 0.2 m"))));
  EXPECT_TRUE(with_height("0.2"));
}

TEST(SceneFile, RefusesInsideOutBoxes) {
  EXPECT_THAT(read_replacing("max { x: 1 y: 1 z: 1 }", "max { x: 1 y: 1 z: -1 }").faults,
              ElementsAre(AllOf(StartsWith("test.scene:5: water.block[0]: "), HasSubstr("min below max"))));
}

TEST(SceneFile, RefusesOverlappingBlocksAndTakesTouchingOnes) {
  const std::string second = "  block { min { x: 0.9 } max { x: 2 y: 1 z: 1 } }\n}\n";
  std::string text = test::kValid;
  text.replace(text.rfind("}\n"), 2, second);
  EXPECT_THAT(read_scene_text(text, "test.scene").faults,
              ElementsAre(AllOf(StartsWith("test.scene:6: water.block[1]: overlaps water.block[0]"))));
  text.replace(text.find("0.9"), 3, "1.0");
  EXPECT_TRUE(read_scene_text(text, "test.scene"));
}

TEST(SceneFile, RefusesABillionParticlesAtOnceWithTheNumber) {
  // 1000 along each axis.
  const SceneResult result = read_scene_text(
      "particle_spacing: 0.01\n"
      "patch { min { } max { x: 10 y: 10 z: 10 } }\n"
      "water { block { min { } max { x: 10 y: 10 z: 10 } } }\n",
      "test.scene");
  EXPECT_THAT(result.faults,
              testing::Contains(AllOf(StartsWith("test.scene:3: water.block: "), HasSubstr("1,000,000,000 particles"),
                                      HasSubstr("at most 4,000,000"))));
}

TEST(SceneFile, RefusesPatchesThatWouldNotFitInMemory) {
  const SceneResult result = read_scene_text(
      "particle_spacing: 0.001 solver { kind: HYBRID }\n"
      "patch { min { } max { x: 1e6 y: 1e6 z: 1e6 } }\n"
      "water { block { min { } max { x: 0.01 y: 0.01 z: 0.01 } } }\n",
      "test.scene");
  EXPECT_THAT(result.faults, ElementsAre(AllOf(StartsWith("test.scene:2: patch: "), HasSubstr("search cells")),
                                         AllOf(StartsWith("test.scene:2: patch: "), HasSubstr("wall particles"))));
}

TEST(SceneFile, RefusesPatchesNarrowerThanTheSupport) {
  EXPECT_THAT(read_replacing("max { x: 2 y: 2 z: 2 }", "max { x: 2 y: 2 z: 0.3 }").faults,
              testing::Contains(AllOf(StartsWith("test.scene:3: patch: "), HasSubstr("at least 0.4 m"))));
}

TEST(SceneFile, NamesEverythingThatIsMissing) {
  EXPECT_THAT(read_scene_text("", "test.scene").faults,
              ElementsAre("test.scene:1: particle_spacing: is missing; it is required",
                          "test.scene:1: patch: is missing; it is required",
                          "test.scene:1: water: is missing; it is required"));
  EXPECT_THAT(read_scene_text("particle_spacing: 1\npatch { min { } }\n\nwater { }", "test.scene").faults,
              ElementsAre("test.scene:2: patch.max: is missing; it is required",
                          "test.scene:4: water.block: is missing; it is required"));
}

TEST(SceneFile, RefusesEmptyAndUnprintableNames) {
  EXPECT_THAT(read_replacing("small", "").faults, ElementsAre(HasSubstr(":1: name: has 0 bytes of UTF-8")));
  EXPECT_THAT(read_replacing("small", "a b/c").faults, ElementsAre(HasSubstr("A-Z a-z 0-9 _ - .")));
}

TEST(SceneFile, RefusesTwoBodiesWithOneId) {
  const std::string body = std::string(kBody) + "}\n";
  EXPECT_THAT(read_with(body + body).faults,
              ElementsAre(AllOf(StartsWith("test.scene:8: body[1].id: 1 is taken by body[0]"))));
}

TEST(SceneFile, RefusesAMeshThatIsNotThereNamingWhereItLooked) {
  SceneReadOptions options;
  options.asset_roots = {"/nowhere/assets"};
  const SceneResult result = read_scene_text(test::kValid + "body { id: 1 mesh_file: \"hull.obj\" position { } }",
                                             "/some/test.scene", options);
  EXPECT_THAT(result.faults, ElementsAre(AllOf(StartsWith("/some/test.scene:7: body[0].mesh_file: "),
                                               HasSubstr("/some/hull.obj"), HasSubstr("/nowhere/assets/hull.obj"))));
}

TEST(SceneFile, ReportsAllFaultsAtOnceInTheOrderOfTheFile) {
  const SceneResult result = read_scene_text(
      "particle_spacing: 0.1\n"
      "gravty: 9.81\n"  // unknown
      "patch { min { } max { x: 2 y: 2 z: 2 } }\n"
      "water {\n"
      "  rest_density: 5\n"                                            // out of range
      "  block { min { } max { x: 1 y: 1 z: 1 } colour: \"blue\" }\n"  // unknown, inside the first block
      "  block { min { x: 1 } max { x: 9 y: 1 z: 1 } }\n"              // outside
      "}\n"
      "wind {\n"
      "  beaufort: 99 from_deg: 10\n"  // out of range
      "  beta: nan\n"                  // not a number
      "}\n",
      "test.scene");
  EXPECT_THAT(result.faults,
              ElementsAre(StartsWith("test.scene:2: gravty: unknown field; did you mean \"gravity\"?"),
                          StartsWith("test.scene:5: water.rest_density: 5 is out of range"),
                          StartsWith("test.scene:6: water.block[0].colour: unknown field; allowed here: min, max"),
                          StartsWith("test.scene:7: water.block[1]: "), StartsWith("test.scene:10: wind.beaufort: 99"),
                          StartsWith("test.scene:11: wind.beta: nan")));
}

}  // namespace
}  // namespace pelagos
