#include "terrain/read_heights.hpp"

#include <dlfcn.h>

#include <array>
#include <cmath>
#include <filesystem>

#include "terrain_module.hpp"

namespace pelagos {

namespace {

constexpr const char* kModule = "../lib/pelagos/pelagos_terrain.so";  // from the folder of the program

struct Module {
  PelagosReadHeights read = nullptr;
  std::string fault;
};

Module load() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::string file = (program.parent_path() / kModule).lexically_normal().string();
  if (!std::filesystem::exists(file, error))
    return {nullptr, "cannot be read: " + file + " is missing; build Pelagos with GDAL (libgdal-dev)"};
  void* handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* symbol = handle != nullptr ? dlsym(handle, "pelagos_read_heights") : nullptr;
  if (symbol == nullptr) return {nullptr, std::string("cannot be read: ") + dlerror()};
  return {reinterpret_cast<PelagosReadHeights>(symbol), ""};  // NOLINT: what dlsym is for
}

}  // namespace

HeightsRead read_heights(const std::string& file, double latitude_deg, double longitude_deg, HeightGrid& grid) {
  static const Module module = load();
  HeightsRead done{module.fault, 0};
  if (module.read == nullptr) return done;
  const std::size_t count = static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows);
  std::vector<double> x(count), y(count);
  for (std::size_t k = 0; k < count; ++k) {
    x[k] = grid.node_x(k);
    y[k] = grid.node_y(k);
  }
  grid.height.assign(count, 0.0F);
  std::array<char, 512> fault{};
  const PelagosHeightRequest request{file.c_str(), latitude_deg,       longitude_deg, x.data(),    y.data(),
                                     count,        grid.height.data(), fault.data(),  fault.size()};
  module.read(&request);
  done.fault = fault.data();
  if (!done.fault.empty()) return done;
  for (const float height : grid.height) done.holes += std::isfinite(height) ? 0 : 1;
  return done;
}

}  // namespace pelagos
