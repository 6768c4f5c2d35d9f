// The second liquid of a scene.

#include <gmock/gmock.h>

#include "scene_text.hpp"
#include "values/lattice.hpp"

namespace pelagos {
namespace {

using test::FaultCase;
using test::read_with;

const std::string kBlock = "block { min { x: 0 y: 0 z: 1 } max { x: 1 y: 1 z: 1.5 } }";  // 9 x 9 x 4, on the water

OilSettings accepted(const std::string& oil) {
  const SceneResult result = read_with("oil { " + oil + " }");
  EXPECT_TRUE(result) << result.report();
  return result && result.scene->oil ? *result.scene->oil : OilSettings{};
}

TEST(SceneOil, IsThereOnlyWhereAskedFor) { EXPECT_FALSE(read_with("").scene.value().oil); }

TEST(SceneOil, TakesEveryTypeOfTheTable) {
  for (const OilProperties& type : kOils) {
    const OilSettings oil = accepted("type: \"" + std::string(type.name) + "\"");
    EXPECT_EQ(oil.properties.name, type.name);
    EXPECT_EQ(oil.properties.density, type.density);
    EXPECT_EQ(oil.properties.viscosity, type.viscosity);
    EXPECT_EQ(oil.properties.api_gravity, type.api_gravity);
    EXPECT_EQ(oil.properties.weathers_as, "");
  }
}

TEST(SceneOil, TakesValuesAndBlocks) {
  const OilSettings oil = accepted("density: 800 viscosity: 0.5 " + kBlock);
  EXPECT_EQ(oil.properties.density, 800.0);
  EXPECT_EQ(oil.properties.viscosity, 0.5);
  ASSERT_EQ(oil.blocks.size(), 1u);
  EXPECT_EQ(oil.blocks[0].max.z(), 1.5);
  EXPECT_EQ(particle_count(*read_with("oil { " + kBlock + " }").scene), 10 * 10 * 10 + 10 * 10 * 5);
}

TEST(SceneOil, IsMediumCrudeWhereNothingIsSaid) {
  const OilSettings oil = accepted("");
  EXPECT_EQ(oil.properties.name, "medium crude");
  EXPECT_EQ(oil.properties.density, 879.13);
  EXPECT_TRUE(oil.blocks.empty());
}

TEST(SceneOil, OfItsOwnValuesSaysWhoseWeatheringItTakes) {
  const OilProperties heavy = accepted("density: 990 viscosity: 30").properties, bunker = *find_oil("bunker C");
  EXPECT_EQ(heavy.weathers_as, "bunker C");
  EXPECT_EQ(heavy.api_gravity, bunker.api_gravity);
  EXPECT_EQ(heavy.refined, bunker.refined);
  EXPECT_EQ(heavy.most_water_content, bunker.most_water_content);
  EXPECT_EQ(accepted("density: 800 viscosity: 0").properties.weathers_as, "light crude");
}

class SceneOilFault : public testing::TestWithParam<FaultCase> {};
INSTANTIATE_TEST_SUITE_P(
    Fields, SceneOilFault,
    testing::Values(
        FaultCase{"Misspelt", "oil { type: \"disel\" }", "oil.type",
                  "\"disel\" is no known oil; did you mean \"diesel\"? allowed: \"gasoline\", \"diesel\","},
        FaultCase{"Unknown", "oil { type: \"marmalade\" }", "oil.type", "or density and viscosity instead"},
        FaultCase{"BothWays", "oil { type: \"diesel\" density: 850 viscosity: 0.1 }", "oil.type",
                  "one of the two ways"},
        FaultCase{"NoViscosity", "oil { density: 850 }", "oil.viscosity", "is missing"},
        FaultCase{"NoDensity", "oil { viscosity: 0.1 }", "oil.density", "is missing"},
        FaultCase{"TooLight", "oil { density: 99 viscosity: 1 }", "oil.density", "allowed: 100 to 2000 kg/m^3"},
        FaultCase{"TooHeavy", "oil { density: 2001 viscosity: 1 }", "oil.density", "0.1 to 2 times the water's"},
        FaultCase{"NegativeViscosity", "oil { density: 850 viscosity: -1 }", "oil.viscosity", "0 to 1000 Pa s"},
        FaultCase{"NanViscosity", "oil { density: 850 viscosity: nan }", "oil.viscosity", "nan is out of range"},
        FaultCase{"OverlapsWater", "oil { block { min { z: 0.9 } max { x: 1 y: 1 z: 1.5 } } }", "oil.block[0]",
                  "overlaps water.block[0]"},
        FaultCase{
            "OverlapsItself",
            "oil { block { min { z: 1 } max { x: 1 y: 1 z: 1.5 } } block { min { z: 1.4 } max { x: 1 y: 1 z: 2 } } }",
            "oil.block[1]", "overlaps oil.block[0]"},
        FaultCase{"Outside", "oil { block { min { z: 1 } max { x: 1 y: 1 z: 3 } } }", "oil.block[0]",
                  "inside the patch"},
        FaultCase{"TooSmall", "oil { block { min { z: 1 } max { x: 1 y: 1 z: 1.09 } } }", "oil.block[0]",
                  "too small for one particle"},
        FaultCase{"Unfit", "oil { colour: 1 }", "oil.colour", "unknown field"}),
    [](const auto& entry) { return entry.param.name; });

TEST_P(SceneOilFault, IsNamedWithWhatIsAllowed) { test::expect_only_fault(GetParam()); }

TEST(OilTable, HoldsWhatStepsAreKnownToBearAndNothingElseIsFound) {
  for (const OilProperties& oil : kOils) {
    EXPECT_GT(oil.density, 700.0) << oil.name;
    EXPECT_LT(oil.density, 1000.0) << oil.name;  // floats on fresh water
    EXPECT_GT(oil.viscosity, 0.0) << oil.name;
    EXPECT_LE(oil.viscosity, 45.0) << oil.name;
  }
  EXPECT_TRUE(find_oil(kDefaultOil));
  EXPECT_FALSE(find_oil("Diesel"));
}

}  // namespace
}  // namespace pelagos
