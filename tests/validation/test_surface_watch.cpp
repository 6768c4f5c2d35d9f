#include <gtest/gtest.h>

#include <cmath>

#include "surface_watch.hpp"

namespace pelagos::validation {
namespace {

constexpr double kSpacing = 0.1;
const PlanGrid kGrid = plan_grid(0.0, 0.0, 4.0, 1.0, kSpacing);

/// Water up to `level(x)`, moving along x with `flow(x)`.
struct Water {
  std::vector<Float4> position, velocity;
  void fill(double (*level)(double), double (*flow)(double)) {
    for (double x = 0.05; x < 4.0; x += kSpacing)
      for (double y = 0.05; y < 1.0; y += kSpacing)
        for (double z = 0.05; z < level(x); z += 0.02) {
          position.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), 0.0F});
          velocity.push_back({static_cast<float>(flow(x)), 0.0F, 0.0F, 0.0F});
        }
  }
};

double two_crests(double x) { return 1.0 + 0.3 * std::cos(2.0 * M_PI * (x - 1.0) / 2.0); }  // at x = 1 and 3

TEST(SurfaceWatch, FindsCrestsThatRunTowardsEachOtherOnly) {
  Water meeting, parting, together;
  meeting.fill(two_crests, [](double x) { return x < 2.0 ? 1.0 : -1.0; });
  parting.fill(two_crests, [](double x) { return x < 2.0 ? -1.0 : 1.0; });
  together.fill(two_crests, [](double) { return 1.0; });
  const auto depth = [](const Water& w) { return find_meeting(surface_profile(kGrid, w.position, w.velocity)).depth; };
  // Crest to trough 0.6, flattened by the mean over three bins, (1 + 2 cos 36 deg) / 3, and as crests lie between bins,
  // cos 18 deg: 0.498. Heights are steps of 0.02.
  EXPECT_NEAR(depth(meeting), 0.498, 0.025);
  EXPECT_EQ(depth(parting), 0.0);
  EXPECT_EQ(depth(together), 0.0);
}

TEST(SurfaceWatch, KnowsAnOverturningLipFromADrop) {
  Water water;
  water.fill([](double) { return 0.6; }, [](double) { return 0.0; });
  EXPECT_EQ(find_overhang(kGrid, water.position).cells, 0);
  std::vector<Float4> drop = water.position;
  drop.push_back({1.05F, 0.55F, 1.4F, 0.0F});
  drop.push_back({1.06F, 0.55F, 1.45F, 0.0F});
  EXPECT_EQ(find_overhang(kGrid, drop).cells, 0);
  std::vector<Float4> lip = water.position;
  for (float x = 1.05F; x < 1.5F; x += 0.1F)
    for (float z = 1.2F; z < 1.45F; z += 0.05F) lip.push_back({x, 0.55F, z, 0.0F});
  const Overhang found = find_overhang(kGrid, lip);
  EXPECT_EQ(found.cells, 3);  // 1.0 to 1.6 in columns of 0.2 m
  EXPECT_NEAR(found.y, 0.5, 1e-9);
}

TEST(SurfaceWatch, TakesEmptyTanksAndStrays) {
  EXPECT_EQ(find_overhang(kGrid, {}).cells, 0);
  EXPECT_EQ(find_meeting(surface_profile(kGrid, {}, {})).depth, 0.0);
  const float nan = std::nanf("");
  const std::vector<Float4> stray = {{nan, 0, 0, 0}, {-1, 0, 0, 0}, {9, 9, 9, 0}}, still(3);
  EXPECT_TRUE(std::isnan(surface_profile(kGrid, stray, still).height.at(3)));
}

}  // namespace
}  // namespace pelagos::validation
