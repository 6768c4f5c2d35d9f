#include "validate_scene.hpp"

namespace pelagos {

std::string find_asset(const FieldReader& reader, const char* field, const std::string& written,
                       const SceneSource& source) {
  namespace fs = std::filesystem;
  if (!source.check_meshes) return written;
  const fs::path file(written);
  std::vector<fs::path> places;
  if (file.is_absolute()) {
    places.push_back(file);
  } else {
    for (const fs::path& folder : source.mesh_folders) places.push_back(folder / file);
  }
  std::string looked;
  for (const fs::path& place : places) {
    std::error_code error;
    if (fs::is_regular_file(place, error)) return fs::absolute(place, error).lexically_normal().string();
    looked += (looked.empty() ? "" : ", ") + place.lexically_normal().string();
  }
  reader.fault(field, "\"" + written + "\" is not there; looked for " + looked);
  return written;
}

}  // namespace pelagos
