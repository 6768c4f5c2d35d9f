#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "physics/particles.hpp"
#include "rigid/mass_properties.hpp"
#include "rigid/mesh_query.hpp"
#include "rigid/triangle_mesh.hpp"
#include "values/body.hpp"
#include "values/patch_frame.hpp"

namespace pelagos {

/// A body as the water meets it: boundary samples below its surface, and the surface itself. All in body axes.
struct BodyShape {
  std::vector<Eigen::Vector3f> samples;  ///< m
  double inset = 0.0;                    ///< spacings, of the samples
  std::vector<Eigen::Vector3f> inward;   ///< of each sample, unit, from its side of the surface; zero: it serves both
  MeshKind kind = MeshKind::kClosed;
  TriangleMesh mesh;                 ///< m; of a closed one the outside of its parts' union (unite_parts)
  MassProperties solid;              ///< of a closed mesh, without its cavities; zero for an open one
  double displacement = 0.0;         ///< m^3, of all of it under water: with sealed cavities
  Eigen::AlignedBox3d bounding_box;  ///< m, of the mesh
  double reach = 0.0;                ///< m, largest distance of a sample from the body's origin
  std::vector<std::array<Eigen::Vector3d, 2>> rim;  ///< m, edges where an open mesh ends
  Refusals faults;                                  ///< not empty: the shape cannot be used, and why
  std::vector<std::string> notes;                   ///< what a person should know of its parts
  std::shared_ptr<const MeshQuery> surface;

  /// Whether a point (body axes) is inside the mesh, or behind an open one. Water must not start there.
  [[nodiscard]] bool inside(const Eigen::Vector3d& point_body) const {
    return surface && (kind == MeshKind::kClosed ? surface->inside(point_body) : surface->behind(point_body));
  }
  /// Distance to the mesh, m, negative inside or behind; no farther than +-limit.
  [[nodiscard]] double signed_distance(const Eigen::Vector3d& point_body, double limit) const;
};

/// Samples a mesh for boundary particles.
/// Samples lie on the inner parallel surface, `inset` spacings below the mesh (none: hulls float 11 to 15 % too high;
/// see default_sample_inset). Where the body is thinner than twice the inset, they lie in its middle; a thicker plate
/// has a whole layer for each of its sides. Each layer is
/// a maximal Poisson-disk set of a fine cloud of candidates (dart throwing as Bowers et al. 2010, "Parallel Poisson
/// disk sampling with spectrum analysis on surfaces", in a fixed random order): no two closer than 0.8 spacings, no
/// hole between them wider than that, about one for each spacing^2 as on the tank's walls. The same mesh gives the same
/// samples. Farthest-point selection (Eldar et al. 1997) keeps the same bounds with 6 % fewer samples, whose volumes
/// differ more (by 14 % rms instead of 12 %), and takes three to nine times as long.
/// @param mesh     without faults of this kind; otherwise the shape carries them and is empty. The parts of a closed
/// one
///                 may overlap, touch and nest: the shape is that of their union
/// @param spacing  particle spacing d, m, > 0
/// @param inset    in spacings, >= 0; nothing: default_sample_inset
/// @param origin   to name the mesh's triangles in faults and notes
[[nodiscard]] BodyShape make_body_shape(const TriangleMesh& mesh, double spacing, std::optional<double> inset,
                                        MeshKind kind = MeshKind::kClosed, const MeshOrigin& origin = {});

/// The same from a file (read_mesh); the faults of the file become those of the shape.
[[nodiscard]] BodyShape load_body_shape(const std::string& path, const MeshOptions& options, double spacing,
                                        std::optional<double> inset);

/// Places the samples where the body is: local position in the patch and velocity of the wall (m/s).
/// Writes x, y, z of the first samples.size() entries; w is left alone.
void place_samples(const BodyShape& shape, const BodyState& state, const PatchFrame& patch, std::span<Float4> position,
                   std::span<Float4> velocity);

}  // namespace pelagos
