#include "import_fault.hpp"
#include "readers.hpp"
#include "text_lines.hpp"

namespace pelagos {

void read_material_library(MeshFolder& folder, const std::filesystem::path& library, MeshBuilder& mesh) {
  OpenFile file(folder, library);
  TextLines lines(file, true);
  ImportedMaterial* material = nullptr;  // of those that the mesh uses
  while (lines.next()) {
    std::string_view rest = lines.text();
    const std::string_view word = next_word(rest);
    if (word == "newmtl") material = mesh.find_material(std::string(trimmed(rest)));
    if (word != "Kd" || material == nullptr) continue;
    std::array<float, 3> colour{};
    bool whole = true;  // "Kd spectral file.rfl" is another way to say it, which is not read
    for (float& part : colour) {
      const auto number = number_of(next_word(rest));
      whole = whole && number.has_value();
      part = static_cast<float>(number.value_or(0.0));
    }
    if (whole) material->colour = colour;
  }
}

}  // namespace pelagos
