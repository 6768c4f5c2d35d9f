#pragma once

#include <gmock/gmock.h>

#include <string>

#include "scene/read_scene.hpp"

namespace pelagos::test {

/// A small valid scene; lines 1 to 9.
inline const std::string kValid =
    "name: \"small\"\n"                                                         // 1
    "particle_spacing: 0.1\n"                                                   // 2
    "tank { min { x: 0 y: 0 z: 0 } max { x: 2 y: 2 z: 2 } }\n"                  // 3
    "water {\n"                                                                 // 4
    "  block { min { x: 0 y: 0 z: 0 } max { x: 1 y: 1 z: 1 } }  # 9 x 9 x 9\n"  // 5
    "}\n";                                                                      // 6

/// The scene with more text after it (its first line is line 7), refused away from any file system.
inline SceneResult read_with(const std::string& more) {
  SceneReadOptions options;
  options.check_meshes = false;
  return read_scene_text(kValid + more, "test.scene", options);
}

/// The scene with one piece of its text replaced.
inline SceneResult read_replacing(const std::string& what, const std::string& by) {
  std::string text = kValid;
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  text.replace(at, what.size(), by);
  return read_scene_text(text, "test.scene");
}

}  // namespace pelagos::test
