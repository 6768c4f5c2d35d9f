#pragma once

#include "meshes/mesh_data.hpp"

namespace pelagos {

/// Whether a box is drawn as a quay: at least 20 m long, 2 m wide and 2 m high.
[[nodiscard]] bool looks_like_quay(const BoxShape& box);

/// A box as a quay of concrete: joints between its blocks, a coping, fenders and ladders on the long sides, bollards
/// and a yellow line on its top. Fenders stand out by a third of a metre; all else keeps to the box, but for what
/// stands on its top.
[[nodiscard]] MeshData draw_quay(const BoxShape& box);

}  // namespace pelagos
