#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/grid.hpp"
#include "physics/particles.hpp"

namespace pelagos {

/// How the two faces of the patch across one axis close it.
enum class Edge : std::uint8_t {
  kWall,      ///< boundary samples
  kMirror,    ///< a smooth plane: ghosts are mirror images, normal coordinate and normal velocity reflected
  kPeriodic,  ///< ghosts are the particles of the opposite side
  kOpen,      ///< nothing: whoever advances the water keeps it there, see physics/held_water.hpp and physics/floor.hpp
};

/// Images of the particles near mirrored and periodic faces, one support radius deep. They stand behind the particles
/// in the same arrays and in the same neighbour lists, so pair loops do not know them; whoever changes an array that is
/// gathered brings its images up to date with `extend`. An image i' of i and an image j' of j are as far from each
/// other's originals, so a sum over neighbours and images keeps its exact adjoint. Such a patch is at least one support
/// radius across: only the nearest image on either side is made.
struct Ghosts {
  std::size_t count = 0;
  std::size_t begin = 0;              ///< place of the first one in the arrays
  std::vector<std::uint32_t> source;  ///< [count] the particle that each is an image of
  std::vector<Float4> sign, offset;   ///< [count] image position = sign * position + offset, velocity = sign * velocity
  CellGrid grid;                      ///< holds them in cell order

  /// An image before it is sorted.
  struct Image {
    std::uint32_t source;
    Float4 sign, offset;
  };
  std::vector<std::vector<Image>> found;  ///< by blocks of particles; kept, as all below, for the next step
  std::vector<Image> images;              ///< all of them, in the order of their particles
  std::vector<Float4> unsorted;           ///< m, their places
  std::vector<std::uint32_t> order;

  [[nodiscard]] bool empty() const { return count == 0; }
};

/// Whether any axis has images.
[[nodiscard]] bool has_ghosts(const std::array<Edge, 3>& edges);

/// Brings particles that have crossed a periodic or mirrored face back: shifted by the period, or reflected with their
/// normal velocity.
void wrap_particles(TaskPool& pool, const Region& patch, const std::array<Edge, 3>& edges, std::size_t count,
                    std::span<Float4> position, std::span<Float4> velocity);

/// Makes the images of the particles within `reach` of a face and sorts them by cell. `position` is resized to hold
/// them, from padded_count(count) on; entries in between are left alone.
void make_ghosts(TaskPool& pool, const Region& patch, const std::array<Edge, 3>& edges, float reach, std::size_t count,
                 std::vector<Float4>& position, Ghosts& ghosts);

/// Entries that an array needs which is gathered with ghosts.
[[nodiscard]] std::size_t extended_count(std::size_t count, const Ghosts& ghosts);

/// values[image] from values[source].
void extend_scalars(TaskPool& pool, const Ghosts& ghosts, std::span<float> values);
void extend_positions(TaskPool& pool, const Ghosts& ghosts, std::span<Float4> positions);
/// Velocities, displacements: the sign alone. w is copied.
void extend_vectors(TaskPool& pool, const Ghosts& ghosts, std::span<Float4> vectors);

}  // namespace pelagos
