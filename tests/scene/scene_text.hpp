#pragma once

#include <gmock/gmock.h>

#include <string>

#include "scene/read_scene.hpp"

namespace pelagos::test {

/// A small valid scene; lines 1 to 9.
inline const std::string kValid =
    "name: \"small\"\n"                                                            // 1
    "particle_spacing: 0.1\n"                                                      // 2
    "patch { min { x: 0 y: 0 z: 0 } max { x: 2 y: 2 z: 2 } }\n"                    // 3
    "water {\n"                                                                    // 4
    "  block { min { x: 0 y: 0 z: 0 } max { x: 1 y: 1 z: 1 } }  # 10 x 10 x 10\n"  // 5
    "}\n";                                                                         // 6

/// The start of a body entry, without its closing brace.
inline constexpr const char* kBody = "body { id: 1 mesh_file: \"a.obj\" position { x: 1 y: 1 z: 1 } ";

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

/// One faulty field: text that goes after the valid scene at line 7, and what the only fault must say.
struct FaultCase {
  const char* name;
  const char* text;
  const char* field;
  const char* says;
};
inline void PrintTo(const FaultCase& c, std::ostream* out) { *out << c.text; }

/// The scene with that text is refused for that one fault, told with its line, its field and what is allowed.
inline void expect_only_fault(const FaultCase& fault) {
  const SceneResult result = read_with(fault.text);
  EXPECT_FALSE(result);
  EXPECT_THAT(result.faults, testing::ElementsAre(
                                 testing::AllOf(testing::StartsWith(std::string("test.scene:7: ") + fault.field + ": "),
                                                testing::HasSubstr(fault.says))));
}

/// The same text inside others, as an entry of the scene or a command: told with the path that leads there.
inline void expect_only_fault_in(const std::string& before, const FaultCase& fault, const std::string& after,
                                 const std::string& path) {
  const SceneResult result = read_with(before + fault.text + after);
  EXPECT_FALSE(result);
  EXPECT_THAT(result.faults,
              testing::ElementsAre(testing::AllOf(testing::StartsWith("test.scene:7: " + path + fault.field),
                                                  testing::HasSubstr(fault.says))));
}

}  // namespace pelagos::test
