// Every shipped scene goes on from a saved state with the same bytes.

#include <gtest/gtest.h>

#include <filesystem>

#include "places.hpp"
#include "same_run.hpp"
#include "scene/read_scene.hpp"

namespace pelagos {

namespace {

class ShippedScene : public ::testing::TestWithParam<std::string> {};

TEST_P(ShippedScene, GoesOnFromAFile) {
  SceneReadOptions options;
  options.asset_roots = {test::source_path("assets")};
  const SceneResult read = read_scene_file(test::source_path("scenes/" + GetParam()), options);
  ASSERT_TRUE(read.scene.has_value());
  Scene scene = *read.scene;
  scene.water.settle_steps = 0;
  test::expect_same_run(scene, 6, 10);
}

std::vector<std::string> shipped_scenes() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(test::source_path("scenes")))
    if (entry.path().extension() == ".scene") names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

INSTANTIATE_TEST_SUITE_P(Scenes, ShippedScene, ::testing::ValuesIn(shipped_scenes()),
                         [](const auto& scene) { return scene.param.substr(0, scene.param.find('.')); });

}  // namespace

}  // namespace pelagos
