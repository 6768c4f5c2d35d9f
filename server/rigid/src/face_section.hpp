#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pelagos {

/// A straight piece of the outline that a closed shell has in the plane of a face, m in the plane's axes. Two outlines
/// count: of the section just above the face, and of that just below.
struct OutlineSegment {
  Eigen::Vector2d from, to;  ///< from.x() <= to.x()
  int above = 0, below = 0;  ///< what the shell's winding numbers change by, on the way across the segment towards +y;
                             ///< nothing where it is vertical
  std::uint32_t shell = 0;   ///< index into the shells of the section
  int repeat = 0;            ///< 1 or -1: no outline, but an edge of a triangle that stands for the face where it lies
};

/// A shell other than the face's own.
struct SectionShell {
  bool outward = true;  ///< false: a cavity
  bool first = false;   ///< comes before the face's own
};

/// How the other shells lie about a place on a face.
struct FaceSurroundings {
  int above = 0, below = 0;              ///< winding number of all of them just above the face, and just below
  int solid_above = 0, solid_below = 0;  ///< the same of those that face outwards
  bool repeated = false;                 ///< a shell that comes first has the same face here
};

/// A trapezoid in the plane, anticlockwise, its parallel sides along y; corners may coincide.
using Trapezoid = std::array<Eigen::Vector2d, 4>;

/// What a face's own shell counts above and below it: 0 and 1 if it faces outwards, -1 and 0 if inwards.
struct OwnWinding {
  int above = 0, below = 1;
};

/// Areas of a face, m^2.
struct FaceAreas {
  double all = 0.0;
  double kept = 0.0;      ///< at the boundary of the union
  double buried = 0.0;    ///< solid by other shells on both sides
  double backed = 0.0;    ///< solid by other shells behind
  double bare = 0.0;      ///< in front in no shell that faces outwards
  double joining = 0.0;   ///< solid neither in front nor behind: its shell goes over into another void
  double opening = 0.0;   ///< of that: behind in no shell that faces outwards, so that void is the sea
  double enclosed = 0.0;  ///< other shells wind round it, either way
};

/// What is left of a face in the union of its own shell and others.
struct FaceRemainder {
  FaceAreas areas;
  std::vector<Trapezoid> pieces;  ///< cover what is kept
  bool complete = true;           ///< false: the work ran out
};

/// Decides for every place of a face whether it lies on the boundary of the union, {winding number >= 1}: it does where
/// the number just above is at most 0 and just below at least 1; of faces that lie on one another and face the same way
/// the one of the first shell stands for all.
/// The face is cut into slabs at all x where an outline has a corner or two of them cross; inside a slab outlines keep
/// their order, and the winding numbers are summed from below (as Bentley and Ottmann 1979 sweep). Where outlines come
/// closer to one another than `tiny`, their order does not matter: there is nothing that could become inconsistent.
/// @param corners   m, of the face in its plane, anticlockwise
/// @param segments  all that reach below the highest corner within the face's range of x; together closed outlines
/// @param tiny      m, heights and widths to leave out
/// @param work      steps that may be spent; is counted down
[[nodiscard]] FaceRemainder cut_face(const std::array<Eigen::Vector2d, 3>& corners, OwnWinding own,
                                     const std::vector<OutlineSegment>& segments,
                                     const std::vector<SectionShell>& shells, double tiny, std::size_t& work);

}  // namespace pelagos
