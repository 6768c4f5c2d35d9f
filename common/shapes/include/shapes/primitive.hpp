#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "shapes/triangle_mesh.hpp"

namespace pelagos {

// Bodies that need no mesh file. Each is centred on the body's origin; metres, every size above 0.

/// A cuboid with its edges along the body's axes.
struct BoxShape {
  Eigen::Vector3d size = Eigen::Vector3d::Ones();  ///< m along x, y, z
};
struct SphereShape {
  double radius = 1.0;  ///< m
};
/// A cylinder that stands upright: its axis is z.
struct CylinderShape {
  double radius = 1.0;  ///< m
  double length = 1.0;  ///< m along z
};
/// An upright cylinder with a half sphere on each end.
struct CapsuleShape {
  double radius = 1.0;  ///< m
  double length = 3.0;  ///< m along z over all, at least twice the radius
};

using Primitive = std::variant<BoxShape, SphereShape, CylinderShape, CapsuleShape>;

/// The primitive as a closed mesh. Round ones have 64 sides; they are widened across z, by 0.1 to 0.2 %, so that the
/// mesh encloses exactly the volume of the shape: what floats sits as deep as it should.
[[nodiscard]] TriangleMesh make_mesh(const Primitive& primitive);

/// Enclosed volume of the shape itself, m^3.
[[nodiscard]] double volume_of(const Primitive& primitive);

/// Its name where a mesh file's name is expected, as "primitive:box:2x1x0.5" (size), "primitive:sphere:1.5" (radius),
/// "primitive:cylinder:0.5x4", "primitive:capsule:0.5x4" (radius, length). Reading it back gives the same bits.
[[nodiscard]] std::string name_of(const Primitive& primitive);

/// The primitive of such a name; nothing if it is none, a number is not finite or not above 0 and at most 1e6, or a
/// capsule is shorter than its two ends.
[[nodiscard]] std::optional<Primitive> parse_primitive(std::string_view name);

}  // namespace pelagos
