#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "values/scene.hpp"

namespace pelagos::test {

/// A closed cube of one metre about its origin, as a mesh file that goes away with the test.
class CubeFile {
 public:
  CubeFile() : path_(std::filesystem::temp_directory_path() / ("pelagos_cube_" + std::to_string(getpid()) + ".obj")) {
    std::ofstream file(path_);
    for (const double z : {-0.5, 0.5})
      for (const double y : {-0.5, 0.5})
        for (const double x : {-0.5, 0.5}) file << "v " << x << ' ' << y << ' ' << z << '\n';
    file << "f 1 3 4\nf 1 4 2\nf 5 6 8\nf 5 8 7\nf 1 2 6\nf 1 6 5\nf 3 7 8\nf 3 8 4\nf 1 5 7\nf 1 7 3\nf 2 4 8\nf 2 8 "
            "6\n";
  }
  ~CubeFile() { std::filesystem::remove(path_); }
  CubeFile(const CubeFile&) = delete;
  CubeFile& operator=(const CubeFile&) = delete;
  [[nodiscard]] std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

/// 5 x 4 x 1 m of water in a patch, d = 0.25 m: 19 x 15 x 4 = 1140 particles.
inline Scene small_patch() {
  Scene scene;
  scene.name = "small_patch";
  scene.particle_spacing = 0.25;
  scene.patch = {{0, 0, 0}, {5, 4, 3}};
  scene.water.blocks = {{{0, 0, 0}, {5, 4, 1.25}}};
  scene.water.settle_steps = 50;
  return scene;
}

inline Scene patch_with_cube(const CubeFile& cube) {
  Scene scene = small_patch();
  BodySettings body;
  body.id = 1;
  body.name = "cube";
  body.mesh_file = cube.path();
  body.position = {2.5, 2.0, 0.9};
  scene.bodies = {body};
  return scene;
}

}  // namespace pelagos::test
