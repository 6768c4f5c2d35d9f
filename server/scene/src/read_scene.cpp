#include "scene/read_scene.hpp"

#include <algorithm>
#include <fstream>

#include "parse_text.hpp"
#include "validate_scene.hpp"

namespace pelagos {
namespace {

constexpr std::size_t kLargestFile = 1 << 20;

std::string describe(const FieldFault& fault, const std::string& source_name) {
  std::string text = source_name;
  if (fault.line > 0) text += ":" + std::to_string(fault.line);
  if (fault.column > 0) text += ":" + std::to_string(fault.column);
  if (!fault.field.empty()) text += ": " + fault.field;
  return text + ": " + fault.what;
}

SceneResult refuse(FieldFaults faults, const std::string& source_name) {
  std::stable_sort(faults.begin(), faults.end(),
                   [](const FieldFault& a, const FieldFault& b) { return a.line < b.line; });
  SceneResult result;
  for (const FieldFault& fault : faults) {
    std::string line = describe(fault, source_name);
    if (result.faults.empty() || result.faults.back() != line) result.faults.push_back(std::move(line));
  }
  return result;
}

SceneResult refuse(const std::string& what, const std::string& source_name) {
  return refuse(FieldFaults{{0, 0, "", what}}, source_name);
}

SceneSource source_of(const std::string& source_name, const SceneReadOptions& options) {
  const std::filesystem::path path(source_name);
  SceneSource source;
  source.default_name = path.stem().empty() ? "scene" : path.stem().string();
  source.mesh_folders.push_back(path.parent_path());
  source.mesh_folders.insert(source.mesh_folders.end(), options.asset_roots.begin(), options.asset_roots.end());
  source.check_meshes = options.check_meshes;
  source.particle_spacing = options.particle_spacing;
  return source;
}

SceneResult too_large(const std::string& source_name) {
  return refuse("is larger than a scene can be; allowed: at most " + std::to_string(kLargestFile) + " bytes",
                source_name);
}

}  // namespace

std::string SceneResult::report() const {
  std::string text;
  for (const std::string& fault : faults) text += fault + "\n";
  return text;
}

SceneResult read_scene_text(std::string_view text, const std::string& source_name, const SceneReadOptions& options) {
  if (text.size() > kLargestFile) return too_large(source_name);
  ParsedText parsed;
  parse_scene_text(text, parsed);
  if (!parsed.readable) return refuse(parsed.faults, source_name);

  FieldFaults faults = parsed.faults;
  const FieldReader reader(parsed.message, faults, "", &parsed.locations, 1);
  Scene scene = validate_scene(reader, source_of(source_name, options));
  if (!faults.empty()) return refuse(faults, source_name);
  return {std::move(scene), {}};
}

SceneResult read_scene_message(std::string_view bytes, const std::string& source_name,
                               const SceneReadOptions& options) {
  if (bytes.size() > kLargestFile) return too_large(source_name);
  proto::v1::Scene message;
  if (!message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) {
    return refuse("these bytes are not a scene message", source_name);
  }
  FieldFaults faults;
  const FieldReader reader(message, faults);
  Scene scene = validate_scene(reader, source_of(source_name, options));
  if (!faults.empty()) return refuse(faults, source_name);
  return {std::move(scene), {}};
}

SceneResult read_scene_file(const std::filesystem::path& path, const SceneReadOptions& options) {
  const std::string name = path.string();
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) return refuse("no such scene file", name);
  if (std::filesystem::is_directory(status)) return refuse("is a folder; a scene file is needed", name);
  std::ifstream file(path, std::ios::binary);
  if (!file) return refuse("cannot be opened; may this user read it?", name);
  std::string text(kLargestFile + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad()) return refuse("cannot be read to its end", name);
  text.resize(static_cast<std::size_t>(file.gcount()));
  return read_scene_text(text, name, options);
}

}  // namespace pelagos
