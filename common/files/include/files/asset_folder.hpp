#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pelagos {

/// The folder with meshes/ and rigs/ that belongs to the running program: of the source tree or of the installation;
/// "assets" where there is none.
[[nodiscard]] std::filesystem::path installed_assets();

/// Where meshes of scenes are looked for, after the scene's own folder: each of `folders` and its meshes/, then the
/// same of the installed assets.
[[nodiscard]] std::vector<std::filesystem::path> mesh_folders(const std::vector<std::string>& folders);

}  // namespace pelagos
