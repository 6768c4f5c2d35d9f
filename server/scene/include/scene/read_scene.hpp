#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "values/scene.hpp"

namespace pelagos {

struct SceneReadOptions {
  /// Folders in which a relative mesh_file is looked for, after the scene file's own.
  std::vector<std::filesystem::path> asset_roots;
  /// false: mesh files need not exist (they then stay as written), e.g. to check a scene away from its assets.
  bool check_meshes = true;
  /// Taken instead of the file's particle_spacing, m; everything is checked against it.
  std::optional<double> particle_spacing;
};

/// Either a scene that keeps every range of proto/scene.proto, or what is wrong with it.
struct SceneResult {
  std::optional<Scene> scene;
  /// In the order of the file. A syntax or type error comes alone, as "file:line:column: what"; otherwise every unknown
  /// field and every value out of range, as "file:line: field.path: what is wrong; what is allowed".
  std::vector<std::string> faults;

  explicit operator bool() const { return scene.has_value(); }
  /// All faults, one a line.
  [[nodiscard]] std::string report() const;
};

/// Reads a scene file (Protobuf text format, at most 1 MiB). Never throws for what the file holds, and allocates no
/// more than the file's own size suggests, whatever it asks for.
[[nodiscard]] SceneResult read_scene_file(const std::filesystem::path& path, const SceneReadOptions& options = {});

/// The same from text. @param source_name  stands for the file's name in faults; relative meshes are looked for
/// beside it
[[nodiscard]] SceneResult read_scene_text(std::string_view text, const std::string& source_name,
                                          const SceneReadOptions& options = {});

/// The same from a serialized `pelagos.proto.v1.Scene`, as a station may send it.
[[nodiscard]] SceneResult read_scene_message(std::string_view bytes, const std::string& source_name,
                                             const SceneReadOptions& options = {});

}  // namespace pelagos
