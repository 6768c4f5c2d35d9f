#pragma once

#include <filesystem>
#include <vector>

#include "messages/field_reader.hpp"
#include "scene/read_scene.hpp"

namespace pelagos {

/// Where a scene came from and where its meshes may be.
struct SceneSource {
  std::string default_name;
  std::vector<std::filesystem::path> mesh_folders;  ///< in the order of search
  bool check_meshes = true;
  std::optional<double> particle_spacing;  ///< instead of the file's
};

/// Reads every field of a Scene message; faults are noted in the reader. The scene may be used only if none was.
[[nodiscard]] Scene validate_scene(const FieldReader& reader, const SceneSource& source);

/// The `body` entries.
[[nodiscard]] std::vector<BodySettings> validate_bodies(const FieldReader& scene_reader, const std::optional<Box>& tank,
                                                        const SceneSource& source);

}  // namespace pelagos
