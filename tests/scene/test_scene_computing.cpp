// How the water is computed: solver, governor, kernel, edges of the patch.

#include <gmock/gmock.h>

#include "scene_text.hpp"
#include "values/lattice.hpp"

namespace pelagos {
namespace {

using test::FaultCase;
using test::read_replacing;
using test::read_with;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

class SceneComputing : public testing::TestWithParam<FaultCase> {};

TEST_P(SceneComputing, RefusesNamingLineFieldAndWhatIsAllowed) {
  EXPECT_THAT(read_with(GetParam().text).faults,
              ElementsAre(AllOf(StartsWith(std::string("test.scene:7: ") + GetParam().field + ": "),
                                HasSubstr(GetParam().says))));
}

INSTANTIATE_TEST_SUITE_P(
    Fields, SceneComputing,
    testing::Values(
        FaultCase{"DensityNegative", "solver { density { tolerance: -1e-4 } }", "solver.density.tolerance",
                  "-0.0001 is out of range"},
        FaultCase{"DivergenceZero", "solver { divergence { tolerance: 0 } }", "solver.divergence.tolerance",
                  "1e-06 to 0.05"},
        FaultCase{"VelocityIterationsCrossed", "solver { divergence { max_iterations: 1 } }",
                  "solver.divergence.max_iterations", "min_iterations 2 is above max_iterations 1"},
        FaultCase{"PaperMethodOfDefault", "solver { method: PAPER }", "solver.method", "not with CORRECTED"},
        FaultCase{"PaperMethodOfCorrected", "solver { kind: CORRECTED method: PAPER }", "solver.method",
                  "CONJUGATE_GRADIENT, JACOBI"},
        FaultCase{"Relaxation", "solver { method: JACOBI relaxation: 0 }", "solver.relaxation", "allowed: 0.01 to 0.9"},
        FaultCase{"RelaxationTooMuch", "solver { method: JACOBI relaxation: 1 }", "solver.relaxation",
                  "1 is known to fail"},
        FaultCase{"WarmStart", "solver { warm_start: 1.1 }", "solver.warm_start", "allowed: 0 to 1"},
        FaultCase{"Filter", "solver { filter: 21 }", "solver.filter", "allowed: 0 to 20"},
        FaultCase{"FilterOfHybrid", "solver { kind: HYBRID filter: 3 }", "solver.filter", "kind: CORRECTED only"},
        FaultCase{"DivergenceOfPbf", "solver { kind: PBF divergence { tolerance: 1e-3 } }", "solver.divergence",
                  "CORRECTED, HYBRID and DFSPH only"},
        FaultCase{"RelaxationOfGradients", "solver { relaxation: 0.5 }", "solver.relaxation", "JACOBI and PAPER only"},
        FaultCase{"WarmStartOfPaper", "solver { kind: HYBRID method: PAPER warm_start: 0.5 }", "solver.warm_start",
                  "CONJUGATE_GRADIENT and JACOBI only"},
        FaultCase{"Support", "support_radius: 1.19", "support_radius", "allowed: 1.4 to 2.5 spacings"},
        FaultCase{"SupportThatExplodes", "support_radius: 1.3", "support_radius", "water explodes"},
        FaultCase{"SupportTooWide", "support_radius: 3", "support_radius", "3 is out of range"},
        FaultCase{"HaloBeyondSupport", "support_radius: 1.5 surface { halo: 1.6 }", "surface.halo", "0 to 1.5"},
        FaultCase{"Budget", "governor { frame_budget: 0 }", "governor.frame_budget", "0.0001 to 0.03333"},
        FaultCase{"BudgetTooLong", "governor { frame_budget: 0.04 }", "governor.frame_budget", "1 / frame_rate"},
        FaultCase{"GovernorTolerance", "governor { largest_tolerance: 1e-4 }", "governor.largest_tolerance",
                  "0.0003 to 0.05"},
        FaultCase{"GovernorToleranceTooMuch", "governor { largest_tolerance: 0.06 }", "governor.largest_tolerance",
                  "0.06 is out of range"},
        // The scene's own step is 0.07 sqrt(0.1 / 9.81) = 0.00707, twice that is 0.01413.
        FaultCase{"GovernorStep", "governor { largest_step: 0.02 }", "governor.largest_step", "0.01413"},
        FaultCase{"GovernorStepTooShort", "governor { largest_step: 0.007 }", "governor.largest_step",
                  "0.007067463 to"},
        FaultCase{"GovernorStepUnderOwn", "time_step { max_step: 0.01 } governor { largest_step: 0.009 }",
                  "governor.largest_step", "0.01 to"}),
    [](const auto& entry) { return entry.param.name; });

TEST(SceneFile, RefusesAPeriodicSideThatIsNoWholeNumberOfSpacings) {
  const std::string edges = "patch_edges { y: PERIODIC }\n";
  std::string text = test::kValid;
  text.replace(text.find("max { x: 2 y: 2 z: 2 }"), 22, "max { x: 2 y: 2.03 z: 2 }");
  EXPECT_THAT(
      read_scene_text(text + edges, "test.scene").faults,
      ElementsAre(AllOf(StartsWith("test.scene:7: patch_edges.y: "), HasSubstr("nearest allowed: 2 or 2.1 m"))));
  // Within 1e-6 of a spacing, and not.
  text.replace(text.find("2.03"), 4, "2.00000005");
  EXPECT_TRUE(read_scene_text(text + edges, "test.scene"));
  text.replace(text.find("2.00000005"), 10, "2.0000002");
  EXPECT_FALSE(read_scene_text(text + edges, "test.scene"));
  // A mirrored side may be any.
  EXPECT_TRUE(read_scene_text(text + "patch_edges { y: MIRROR }\n", "test.scene"));
}

TEST(SceneFile, FillsAxesWithoutWallsFromHalfASpacing) {
  const SceneResult result = read_with("patch_edges { x: PERIODIC z: MIRROR }\n");
  ASSERT_TRUE(result) << result.report();
  EXPECT_EQ(result.scene->patch_edges, (PatchEdges{PatchEdge::kPeriodic, PatchEdge::kWall, PatchEdge::kMirror}));
  EXPECT_EQ(particle_count(*result.scene), 10 * 10 * 10);
  const SceneResult sampled = read_with("patch_edges { x: PERIODIC z: MIRROR }\nsolver { kind: HYBRID }\n");
  ASSERT_TRUE(sampled) << sampled.report();
  EXPECT_EQ(particle_count(*sampled.scene), 10 * 9 * 10) << "a sampled wall's own particles stand on its face";
}

TEST(SceneFile, RefusesBlocksTooSmallForAParticleWithoutWallsToo) {
  const std::string flat = test::kValid;
  const auto with_height = [&](const char* height) {
    std::string text = flat;
    text.replace(text.find("max { x: 1 y: 1 z: 1 }"), 22, std::string("max { x: 1 y: 1 z: ") + height + " }");
    return read_scene_text(text + "patch_edges { z: MIRROR }\n", "test.scene");
  };
  EXPECT_THAT(with_height("0.09").faults,
              ElementsAre(AllOf(StartsWith("test.scene:5: water.block[0]: "), HasSubstr("(0.1, 0.1, 0.1) m"))));
  EXPECT_TRUE(with_height("0.1"));
}

TEST(SceneFile, KeepsTwoSupportRadiiBetweenTheFacesOfAPatch) {
  std::string text = test::kValid;
  text.replace(text.find("max { x: 2 y: 2 z: 2 }"), 22, "max { x: 2 y: 2 z: 0.45 }");
  text.replace(text.find("max { x: 1 y: 1 z: 1 }"), 22, "max { x: 1 y: 1 z: 0.45 }");
  EXPECT_TRUE(read_scene_text(text, "test.scene"));
  EXPECT_THAT(
      read_scene_text(text + "support_radius: 2.5\n", "test.scene").faults,
      ElementsAre(AllOf(StartsWith("test.scene:3: patch: is 0.45 m"), HasSubstr("at least 0.5 m (5 particle"))));
}

TEST(SceneFile, LetsAGovernorsLongestStepDecideOnViscosity) {
  // 0.1 d^2 / 0.01 = 0.1; without the governor 0.1414 would be allowed.
  const std::string governor = "governor { largest_step: 0.01 } water { kinematic_viscosity: ";
  EXPECT_TRUE(read_replacing("water {", governor + "0.099"));
  EXPECT_THAT(read_replacing("water {", governor + "0.12").faults, ElementsAre(HasSubstr("0 to 0.1 m^2/s")));
}

TEST(SceneSolver, TakesTheDefaultsOfItsKind) {
  const SceneResult corrected = read_with("");
  ASSERT_TRUE(corrected) << corrected.report();
  EXPECT_EQ(corrected.scene->solver.kind, SolverKind::kCorrected);
  EXPECT_EQ(corrected.scene->solver.divergence.min_iterations, 2);
  EXPECT_EQ(corrected.scene->solver.density.min_iterations, 0);
  EXPECT_EQ(corrected.scene->solver.relaxation, 0.5);
  EXPECT_EQ(corrected.scene->solver.warm_start, 1.0);
  EXPECT_EQ(corrected.scene->solver.filter, 3.0);
  EXPECT_EQ(corrected.scene->support_radius, 2.0);
  EXPECT_FALSE(corrected.scene->governor.on);
  EXPECT_EQ(corrected.scene->on_fault, FaultPolicy::kStop);
  EXPECT_EQ(corrected.scene->patch_edges, kWallsAround);
  for (const auto& [name, kind] :
       {std::pair{"HYBRID", SolverKind::kHybrid}, {"DFSPH", SolverKind::kDfsph}, {"PBF", SolverKind::kPbf}}) {
    const SceneResult other = read_with(std::string("solver { kind: ") + name + " method: PAPER }\n");
    ASSERT_TRUE(other) << other.report();
    EXPECT_EQ(other.scene->solver.kind, kind);
    EXPECT_EQ(other.scene->solver.method, PressureMethod::kPaper);
    EXPECT_EQ(other.scene->solver.divergence.min_iterations, 1) << name;
    EXPECT_EQ(other.scene->solver.density.min_iterations, 2) << name;
  }
}

TEST(SceneSolver, OnlyTheRepairOfCorrectedMayBeLeftOut) {
  const std::string none = "density { min_iterations: 0 } }\n";
  EXPECT_TRUE(read_with("solver { " + none));
  EXPECT_THAT(read_with("solver { kind: HYBRID " + none).faults, ElementsAre(HasSubstr("min_iterations: 0 is out")));
  EXPECT_FALSE(read_with("solver { divergence { min_iterations: 0 } }\n"));
}

TEST(SceneSolver, ReadsEveryFieldIntoItsPlace) {
  const SceneResult result = read_with(
      "solver { kind: CORRECTED method: JACOBI relaxation: 0.4 warm_start: 0.8 filter: 5 }\n"
      "support_radius: 2.25 on_fault: RESTORE\n"
      "governor { frame_budget: 0.02 largest_tolerance: 2e-3 largest_step: 0.012 }\n");
  ASSERT_TRUE(result) << result.report();
  const Scene& s = *result.scene;
  EXPECT_EQ(s.solver.kind, SolverKind::kCorrected);
  EXPECT_EQ(s.solver.method, PressureMethod::kJacobi);
  EXPECT_EQ(s.solver.relaxation, 0.4);
  EXPECT_EQ(s.solver.warm_start, 0.8);
  EXPECT_EQ(s.solver.filter, 5.0);
  EXPECT_EQ(s.support_radius, 2.25);
  EXPECT_EQ(s.on_fault, FaultPolicy::kRestore);
  EXPECT_TRUE(s.governor.on);
  EXPECT_EQ(s.governor.frame_budget, 0.02);
  EXPECT_EQ(s.governor.largest_tolerance, 2e-3);
  EXPECT_EQ(s.governor.largest_step, 0.012);
}

TEST(SceneSolver, AGovernorNeverAllowsLessThanTheSceneItself) {
  const SceneResult result = read_with("governor { } solver { density { tolerance: 0.02 } }\n");
  ASSERT_TRUE(result) << result.report();
  EXPECT_TRUE(result.scene->governor.on);
  EXPECT_EQ(result.scene->governor.largest_tolerance, 0.02);
  EXPECT_EQ(result.scene->governor.largest_step, 0.0) << "the scene's own";
}

}  // namespace
}  // namespace pelagos
