#include "mesh_import/import_mesh.hpp"

#include <exception>

#include "import_fault.hpp"
#include "readers.hpp"
#include "text_lines.hpp"

namespace pelagos {

namespace {

void read(const std::string& ending, MeshFolder& folder, const ImportOptions& options, MeshBuilder& mesh) {
  if (ending == ".obj") return read_obj(folder, options, mesh);
  if (ending == ".stl") return read_stl(folder, mesh);
  if (ending == ".gltf" || ending == ".glb") return read_gltf(folder, options, mesh);
  throw ImportFault("meshes that end in " + in_quotes(ending) + " are not read; allowed: .obj, .stl, .gltf, .glb");
}

}  // namespace

ImportedMesh import_mesh(const std::filesystem::path& file, const ImportOptions& options) {
  ImportedMesh refused;
  try {
    MeshFolder folder(file);
    MeshBuilder builder;
    read(lower_case(file.extension().string()), folder, options, builder);
    ImportedMesh mesh = builder.take();
    if (mesh.triangles.empty()) {
      mesh.faults.push_back({"", "has no triangles: there are no faces with an area"});
      mesh.vertices.clear();
    }
    return mesh;
  } catch (const std::bad_alloc&) {
    refused.faults.push_back({"", "there is not enough memory to read it"});
  } catch (const ImportFault& fault) {
    refused.faults.push_back(fault.refusal());
  } catch (const std::exception& error) {
    refused.faults.push_back({"", error.what()});
  }
  return refused;
}

}  // namespace pelagos
