#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "meshes/mesh_data.hpp"
#include "values/scene_info.hpp"

namespace pelagos {

/// Meshes by body; bodies with the same mesh share it.
using BodyMeshes = std::map<std::uint32_t, std::shared_ptr<const MeshData>>;

/// Reads the meshes of a scene's bodies on a thread of its own, so that drawing goes on meanwhile. Each mesh is read
/// once, however many bodies have it, and kept as long as a body of the scene has it. All calls from one thread.
class MeshLoader {
 public:
  /// Triangles of all bodies together: what drawing and memory have to bear. Beyond, a body is drawn as a box.
  static constexpr std::size_t kMostTriangles = 2'000'000;

  explicit MeshLoader(std::filesystem::path folder);
  /// Waits for the mesh that is being read, a second or two at the most (mesh_import/import_mesh.hpp).
  ~MeshLoader();
  MeshLoader(const MeshLoader&) = delete;
  MeshLoader& operator=(const MeshLoader&) = delete;

  /// The bodies whose meshes are wanted from now on, in place of those before. Returns at once.
  void want(const std::vector<BodyInfo>& bodies);

  /// Meshes that have been read, of the bodies that are wanted.
  [[nodiscard]] BodyMeshes meshes() const;
  /// Goes up when meshes() changes.
  [[nodiscard]] std::uint64_t revision() const;
  /// Everything that is wanted has been read, or cannot be.
  [[nodiscard]] bool done() const;
  /// What there was to say about meshes since the last call, a line each: missing files, files that are not the
  /// server's, boxes in place of meshes.
  [[nodiscard]] std::vector<std::string> take_notes();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace pelagos
