#include "scene/read_scene.hpp"

#include "files/input_file.hpp"
#include "messages/describe_faults.hpp"
#include "messages/parse_text.hpp"
#include "scene.pb.h"
#include "validate_scene.hpp"

namespace pelagos {
namespace {

constexpr std::size_t kLargestFile = 1 << 20;

SceneResult refuse(TextRefusals faults, const std::string& source_name) {
  SceneResult result;
  result.faults = describe_faults(std::move(faults), source_name);
  return result;
}

SceneResult refuse(const std::string& what, const std::string& source_name) {
  return refuse(TextRefusals{{0, 0, {"", what}}}, source_name);
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
  proto::v1::Scene message;
  ParsedText parsed;
  parse_text(text, message, parsed);
  if (!parsed.readable) return refuse(parsed.faults, source_name);

  TextRefusals faults = parsed.faults;
  const FieldReader reader(message, faults, "", &parsed.locations, 1);
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
  TextRefusals faults;
  const FieldReader reader(message, faults);
  Scene scene = validate_scene(reader, source_of(source_name, options));
  if (!faults.empty()) return refuse(faults, source_name);
  return {std::move(scene), {}};
}

SceneResult read_scene_file(const std::filesystem::path& path, const SceneReadOptions& options) {
  const std::string name = path.string();
  const InputFile file = read_input_file(path, "scene", kLargestFile);
  if (!file.fault.empty()) return refuse(file.fault, name);
  return read_scene_text(file.bytes, name, options);
}

}  // namespace pelagos
