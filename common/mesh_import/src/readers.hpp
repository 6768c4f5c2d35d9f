#pragma once

#include "file_bytes.hpp"
#include "mesh_builder.hpp"

namespace pelagos {

// The three formats. Each adds the triangles of the folder's mesh file. @throws ImportFault saying why it is refused
void read_obj(MeshFolder& folder, const ImportOptions& options, MeshBuilder& mesh);
void read_stl(MeshFolder& folder, MeshBuilder& mesh);
void read_gltf(MeshFolder& folder, const ImportOptions& options, MeshBuilder& mesh);

/// Gives the mesh's materials the diffuse colours of an OBJ material library (Kd); what else it says is passed over.
/// @throws ImportFault if it cannot be read
void read_material_library(MeshFolder& folder, const std::filesystem::path& library, MeshBuilder& mesh);

}  // namespace pelagos
