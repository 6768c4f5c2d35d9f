#include "files/asset_folder.hpp"

namespace pelagos {

namespace fs = std::filesystem;

fs::path installed_assets() {
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  for (const char* relative : {"../../../assets", "../share/pelagos/assets", "../assets"}) {
    const fs::path candidate = (program / relative).lexically_normal();
    if (fs::is_directory(candidate / "meshes", ignored)) return candidate;
  }
  return "assets";
}

std::vector<fs::path> mesh_folders(const std::vector<std::string>& folders) {
  std::vector<fs::path> all;
  const auto add = [&](const fs::path& folder) {
    all.push_back(folder);
    all.push_back(folder / "meshes");
  };
  for (const std::string& folder : folders) add(folder);
  add(installed_assets());
  return all;
}

}  // namespace pelagos
