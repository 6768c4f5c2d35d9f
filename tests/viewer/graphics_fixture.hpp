#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "meshes/body_mesh.hpp"
#include "renderer/gl_context.hpp"
#include "renderer/gl_objects.hpp"
#include "renderer/renderer.hpp"

namespace pelagos {

/// Gives a renderer a scene with the meshes of its bodies, as far as the folder has them.
inline void set_scene(Renderer& renderer, const SceneInfo& scene, const std::filesystem::path& folder) {
  BodyMeshes meshes;
  for (const BodyInfo& body : scene.bodies) {
    try {
      meshes[body.id] = std::make_shared<const MeshData>(load_body_mesh(folder, body).data);
    } catch (const MeshError&) {  // not drawn
    }
  }
  renderer.set_scene(scene);
  renderer.set_meshes(meshes);
}

/// A context for each test; the test is skipped where EGL offers none.
class Graphics : public testing::Test {
 protected:
  void SetUp() override {
    try {
      context_ = std::make_unique<HeadlessContext>();
    } catch (const GraphicsError& error) {
      GTEST_SKIP() << error.what();
    }
  }

 private:
  std::unique_ptr<HeadlessContext> context_;
};

}  // namespace pelagos
