// The probes of a scene.

#include <gmock/gmock.h>

#include "scene_text.hpp"

namespace pelagos {
namespace {

using test::FaultCase;
using test::read_with;

TEST(SceneProbes, AreReadWithTheirDefaults) {
  const SceneResult result = read_with(std::string(test::kBody) +
                                       "}\n"
                                       "probe { id: 4 position { x: 0.5 y: 0.25 } }\n"
                                       "probe { id: 5 name: \"bow\" body: 1 position { x: 9 y: 0 z: -1 } }\n"
                                       "probe { id: 6 position { x: 0.5 y: 0.25 z: 0.5 } at_surface: true }\n");
  ASSERT_TRUE(result) << result.report();
  const std::vector<ProbeSettings>& probes = result.scene->probes;
  ASSERT_EQ(probes.size(), 3U);
  EXPECT_EQ(probes[0].id, 4U);
  EXPECT_EQ(probes[0].name, "probe 4");
  EXPECT_EQ(probes[0].body, 0U);
  EXPECT_TRUE(probes[0].at_surface) << "no z was given";
  EXPECT_EQ(probes[1].name, "bow");
  EXPECT_EQ(probes[1].body, 1U);
  EXPECT_EQ(probes[1].position, Eigen::Vector3d(9.0, 0.0, -1.0));
  EXPECT_FALSE(probes[1].at_surface);
  EXPECT_TRUE(probes[2].at_surface);
}

class SceneProbeFault : public testing::TestWithParam<FaultCase> {};
INSTANTIATE_TEST_SUITE_P(
    Fields, SceneProbeFault,
    testing::Values(
        FaultCase{"NoId", "probe { position { x: 1 y: 1 } }", "probe[0].id", "required"},
        FaultCase{"Zero", "probe { id: 0 position { x: 1 y: 1 } }", "probe[0].id", "allowed: 1"},
        FaultCase{"NoPlace", "probe { id: 1 }", "probe[0].position", "required"},
        FaultCase{"Outside", "probe { id: 1 position { x: 3 y: 1 } }", "probe[0].position", "outside the patch"},
        FaultCase{"NotFinite", "probe { id: 1 position { x: nan y: 1 } }", "probe[0].position.x",
                  "nan is out of range"},
        FaultCase{"NoSuchBody", "probe { id: 1 body: 3 position { x: 1 y: 1 } }", "probe[0].body", "no body 3"},
        FaultCase{"Twice", "probe { id: 1 position { x: 1 y: 1 } } probe { id: 1 position { x: 1 y: 1 } }",
                  "probe[1].id", "taken"}),
    [](const auto& field) { return field.param.name; });

TEST_P(SceneProbeFault, IsNamed) { test::expect_only_fault(GetParam()); }

}  // namespace
}  // namespace pelagos
