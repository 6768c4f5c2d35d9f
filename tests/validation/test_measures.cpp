#include "measures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "harness.hpp"
#include "physics/pressure.hpp"

namespace pelagos::validation {
namespace {

/// Lattice points at d/2, 3d/2, ... of a block nx x 4 x nz with the spacing d = 1, moved by (x, z).
void add_block(FluidState& state, int nx, int nz, float x, float z) {
  std::vector<Float4>& all = state.particles.position;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < nx; ++i)
        all.push_back(
            {x + static_cast<float>(i) + 0.5F, static_cast<float>(j) + 0.5F, z + static_cast<float>(k) + 0.5F, 0});
  state.particles.count = all.size();
}

FluidState empty_state() {
  FluidState state;
  state.parameters.spacing = 1.0;
  state.parameters.support_radius = 2.0;
  return state;
}

TEST(Measures, FrontIsThatOfTheWaterThatHangsTogether) {
  FluidState state = empty_state();
  add_block(state, 10, 5, 0, 0);
  add_block(state, 3, 1, 10, 0);                  // a tongue
  add_block(state, 2, 2, 15, 0);                  // drops ahead of it, two empty cells away
  EXPECT_DOUBLE_EQ(front_position(state), 13.0);  // the last particle stands at 12.5
}

TEST(Measures, ProbeFindsALinearPressureInTheMiddle) {
  FluidState state = empty_state();
  add_block(state, 10, 10, 0, 0);
  std::vector<float> pressure;
  for (const Float4& p : state.particles.position) pressure.push_back(100.0F - 7.0F * p.z);
  // The lattice is symmetric around a cell's corner, so a linear field is met to single precision.
  EXPECT_NEAR(probe_pressure(state, pressure, 5.0, 5.0, 4.0), 65.0, 1e-3);
}

TEST(Measures, ProbeInAirIsDry) {
  FluidState state = empty_state();
  add_block(state, 10, 10, 0, 0);
  const std::vector<float> pressure(state.particles.count, 5.0F);
  EXPECT_GT(probe_pressure(state, pressure, 10.0, 5.0, 4.0), 0.0);  // at the wall, half a spacing off the particles
  EXPECT_EQ(probe_pressure(state, pressure, 11.5, 5.0, 4.0), 0.0);  // one spacing off the last particle's own
}

TEST(Measures, HullOfASquareLattice) {
  FluidState state = empty_state();
  add_block(state, 7, 4, 3, 2);
  EXPECT_DOUBLE_EQ(hull_area(state.particles.position), 6.0 * 3.0);  // through the outer particles' centres
}

TEST(Measures, CoveredAreaOfALatticeAndOfParticlesApart) {
  FluidState state = empty_state();
  add_block(state, 30, 30, 0, 0);
  // A lattice is covered without gaps: the area of its centres is 29^2, and on each side discs reach 0.56 to 0.75 on.
  const double covered = covered_area(state.particles.position, 1.0);
  EXPECT_GT(covered, std::pow(29.0 + 2.0 * 0.56, 2));
  EXPECT_LT(covered, std::pow(29.0 + 2.0 * 0.75, 2));
  // Apart, each particle covers its disc; a cell of a tenth is at the rim for 47 of 177 cells, on either side alike.
  const std::vector<Float4> apart{{0, 0, 0, 0}, {5, 0, 0, 0}, {0, 0, 5, 0}};
  EXPECT_NEAR(covered_area(apart, 1.0), 3.0 * M_PI * 0.75 * 0.75, 0.15);
}

TEST(Measures, LineFitOfALine) {
  LineFit fit;
  for (double x : {1.0, 2.0, 4.0, 7.0}) fit.add(x, 3.0 - 0.5 * x);
  EXPECT_NEAR(fit.slope(), -0.5, 1e-14);
  EXPECT_NEAR(fit.at(10.0), -2.0, 1e-13);
}

TEST(Measures, CurveBetweenAndBeyondItsPoints) {
  Curve curve;
  curve.add(0.0, 1.0);
  curve.add(2.0, 5.0);
  EXPECT_DOUBLE_EQ(curve.at(0.5), 2.0);
  EXPECT_DOUBLE_EQ(curve.at(-1.0), 1.0);
  EXPECT_DOUBLE_EQ(curve.at(3.0), 5.0);
  EXPECT_DOUBLE_EQ(curve.reaches(4.0), 1.5);
  EXPECT_TRUE(std::isnan(curve.reaches(6.0)));
}

class Columns : public ::testing::Test {
 protected:
  void write(const std::string& text) { std::ofstream(file_) << text; }
  void TearDown() override { std::filesystem::remove(file_); }
  std::string file_ =
      testing::TempDir() + "pelagos_columns_" + testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(Columns, SkipsCommentsAndNames) {
  write("# source\nt,x\n0,1.5\n# between\n2,-3e-1\n");
  const auto columns = read_columns(file_);
  ASSERT_EQ(columns.size(), 2U);
  EXPECT_EQ(columns[0], (std::vector<double>{0, 2}));
  EXPECT_EQ(columns[1], (std::vector<double>{1.5, -0.3}));
}

TEST_F(Columns, TakesOneSeries) {
  write("series,t,x\na,0,1\nb,0,2\na,1,3\n");
  EXPECT_EQ(read_columns(file_, "a").at(1), (std::vector<double>{1, 3}));
}

TEST_F(Columns, NamesTheLineOfAFault) {
  write("t,x\n0,1\n1,water\n");
  try {
    (void)read_columns(file_);
    FAIL() << "read without a fault";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(":3: \"water\" is not a number"), std::string::npos) << error.what();
  }
}

TEST(Goal, VerdictsByMagnitude) {
  EXPECT_STREQ(verdict(at_most(1, 3), -0.5), "met");
  EXPECT_STREQ(verdict(at_most(1, 3), -2.0), "missed");
  EXPECT_STREQ(verdict(at_most(1, 3), 4.0), "failed");
  EXPECT_STREQ(verdict(at_least(0.9, 0.5), 0.7), "missed");
  EXPECT_STREQ(verdict(at_most(1, 3), std::nan("")), "failed");
  EXPECT_STREQ(verdict({}, 7.0), "-");
}

TEST(Goal, EnergyMayFallButNotRise) {
  EXPECT_DOUBLE_EQ(energy_rise(3.0, 1000.0).value, 0.3);
  EXPECT_DOUBLE_EQ(energy_rise(-50.0, 1000.0).value, 0.0);
  EXPECT_STREQ(verdict(energy_rise(1.0, 1000.0).goal, energy_rise(1.0, 1000.0).value), "met");
  EXPECT_STREQ(verdict(energy_rise(3.0, 1000.0).goal, energy_rise(3.0, 1000.0).value), "missed");
  EXPECT_STREQ(verdict(energy_rise(NAN, 1000.0).goal, energy_rise(NAN, 1000.0).value), "failed");
}

/// The same pressure law in all schemes: a column of 10 layers, mean over half a second, in the middle of it.
TEST(Pressure, IsHydrostaticInEveryScheme) {
  for (const char* solver : {"corrected", "hybrid", "dfsph", "pbf"}) {
    const double d = 0.1;
    const FluidParameters parameters =
        patch_parameters({10 * d, 4 * d, 20 * d}, d, {Edge::kPeriodic, Edge::kPeriodic, Edge::kMirror});
    WaterRun run(1, parameters, {solver}, fill_block(parameters, {10 * d, 4 * d, 10 * d}));
    run.advance_to(1.0);
    LineFit fit;
    std::vector<float> pressure(run.state().particles.count);
    run.advance_to(1.5, [&] {
      compute_pressure(run.state(), pressure);
      for (std::size_t i = 0; i < pressure.size(); ++i) {
        const auto z = static_cast<double>(run.state().particles.position[i].z);
        if (z > 2 * d && z < 8 * d) fit.add(z, static_cast<double>(pressure[i]));
      }
    });
    // A factor of two, as of one constraint counted for both, would be 100 %; noise and the tolerance leave a few.
    EXPECT_NEAR(fit.at(0.5) / (1000.0 * 9.81 * 0.5), 1.0, 0.05) << solver;
  }
}

TEST(Pressure, IsZeroBeforeTheFirstStep) {
  const FluidParameters parameters =
      patch_parameters({1, 0.4, 1}, 0.1, {Edge::kMirror, Edge::kPeriodic, Edge::kMirror});
  const WaterRun run(1, parameters, {}, fill_block(parameters, {1, 0.4, 0.5}));
  std::vector<float> pressure(run.state().particles.count, -1.0F);
  compute_pressure(run.state(), pressure);
  for (const float p : pressure) EXPECT_EQ(p, 0.0F);
}

}  // namespace
}  // namespace pelagos::validation
