#include "physics/ghosts.hpp"

#include <algorithm>
#include <limits>

#include "coordinate.hpp"
#include "fluid_stages.hpp"

namespace pelagos {

namespace {

/// One axis of one image: x' = sign x + offset.
struct AxisImage {
  float sign = 1.0F, offset = 0.0F;
};
struct AxisImages {
  std::array<AxisImage, 3> image{};  ///< the first is the particle itself
  std::size_t count = 1;
};

bool has_images(Edge edge) { return edge == Edge::kMirror || edge == Edge::kPeriodic; }

AxisImages images_across(const Region& patch, Edge edge, std::size_t axis, float reach, float x) {
  AxisImages images;
  if (!has_images(edge)) return images;
  const float low = patch.min[axis], high = patch.max[axis];
  const auto add = [&](AxisImage image) { images.image[images.count++] = image; };
  if (x < low + reach) add(edge == Edge::kMirror ? AxisImage{-1.0F, 2.0F * low} : AxisImage{1.0F, high - low});
  if (x > high - reach) add(edge == Edge::kMirror ? AxisImage{-1.0F, 2.0F * high} : AxisImage{1.0F, low - high});
  return images;
}

void add_images(const Region& patch, const std::array<Edge, 3>& edges, float reach, std::size_t i, const Float4& p,
                std::vector<Ghosts::Image>& out) {
  std::array<AxisImages, 3> axes;
  for (std::size_t axis = 0; axis < 3; ++axis)
    axes[axis] = images_across(patch, edges[axis], axis, reach, coordinate(p, axis));
  for (std::size_t a = 0; a < axes[0].count; ++a)
    for (std::size_t b = 0; b < axes[1].count; ++b)
      for (std::size_t c = 0; c < axes[2].count; ++c) {
        if (a + b + c == 0) continue;
        const AxisImage &x = axes[0].image[a], &y = axes[1].image[b], &z = axes[2].image[c];
        out.push_back(
            {static_cast<std::uint32_t>(i), {x.sign, y.sign, z.sign, 1.0F}, {x.offset, y.offset, z.offset, 0.0F}});
      }
}

Float4 place(const Float4& sign, const Float4& offset, const Float4& p) {
  return {sign.x * p.x + offset.x, sign.y * p.y + offset.y, sign.z * p.z + offset.z, p.w};
}

/// Where a particle has no image: farther than `reach` from all faces that have images.
struct Inside {
  std::array<float, 3> low, high;

  Inside(const Region& patch, const std::array<Edge, 3>& edges, float reach) {
    constexpr float kAnywhere = std::numeric_limits<float>::infinity();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool images = has_images(edges[axis]);
      low[axis] = images ? patch.min[axis] + reach : -kAnywhere;
      high[axis] = images ? patch.max[axis] - reach : kAnywhere;
    }
  }
  [[nodiscard]] bool contains(const Float4& p) const {
    return p.x >= low[0] && p.x <= high[0] && p.y >= low[1] && p.y <= high[1] && p.z >= low[2] && p.z <= high[2];
  }
};

/// Brings the blocks' images together, in the order of their particles.
void join_images(TaskPool& pool, std::size_t blocks, Ghosts& ghosts) {
  std::vector<std::size_t> first(blocks + 1, 0);
  for (std::size_t b = 0; b < blocks; ++b) first[b + 1] = first[b] + ghosts.found[b].size();
  ghosts.images.resize(first[blocks]);
  pool.for_each_block(blocks, [&](std::size_t b) {
    std::copy(ghosts.found[b].begin(), ghosts.found[b].end(),
              ghosts.images.begin() + static_cast<std::ptrdiff_t>(first[b]));
  });
}

/// Images in the order of their particles, whatever the number of threads.
void collect_images(TaskPool& pool, const Region& patch, const std::array<Edge, 3>& edges, float reach,
                    std::size_t count, std::span<const Float4> position, Ghosts& ghosts) {
  const std::size_t blocks = (count + kPointBlock - 1) / kPointBlock;
  if (ghosts.found.size() < blocks) ghosts.found.resize(blocks);
  const Inside inside(patch, edges, reach);
  pool.for_each_range(count, kPointBlock, [&](std::size_t begin, std::size_t end) {
    std::vector<Ghosts::Image>& out = ghosts.found[begin / kPointBlock];
    out.clear();
    for (std::size_t i = begin; i < end; ++i)
      if (!inside.contains(position[i])) add_images(patch, edges, reach, i, position[i], out);
  });
  join_images(pool, blocks, ghosts);
}

template <class F>
void for_each_ghost(TaskPool& pool, const Ghosts& ghosts, F&& f) {
  pool.for_each_range(ghosts.count, kPointBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) f(k);
  });
}

}  // namespace

bool has_ghosts(const std::array<Edge, 3>& edges) { return std::any_of(edges.begin(), edges.end(), has_images); }

void wrap_particles(TaskPool& pool, const Region& patch, const std::array<Edge, 3>& edges, std::size_t count,
                    std::span<Float4> position, std::span<Float4> velocity) {
  pool.for_each_range(count, kPointBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!has_images(edges[axis])) continue;
      const float low = patch.min[axis], high = patch.max[axis], period = high - low;
      for (std::size_t i = begin; i < end; ++i) {
        float& x = coordinate(position[i], axis);
        if (x >= low && x < high) continue;
        if (edges[axis] == Edge::kPeriodic) {
          x += x < low ? period : -period;
        } else if (x != high) {
          x = 2.0F * (x < low ? low : high) - x;
          coordinate(velocity[i], axis) *= -1.0F;
        }
      }
    }
  });
}

void make_ghosts(TaskPool& pool, const Region& patch, const std::array<Edge, 3>& edges, float reach, std::size_t count,
                 std::vector<Float4>& position, Ghosts& ghosts) {
  collect_images(pool, patch, edges, reach, count, position, ghosts);
  ghosts.count = ghosts.images.size();
  ghosts.begin = padded_count(count);
  ghosts.unsorted.resize(ghosts.count);
  for_each_ghost(pool, ghosts, [&](std::size_t k) {
    const Ghosts::Image& image = ghosts.images[k];
    ghosts.unsorted[k] = place(image.sign, image.offset, position[image.source]);
  });
  ghosts.grid.sort(pool, ghosts.unsorted, ghosts.order);
  ghosts.source.resize(ghosts.count);
  ghosts.sign.resize(ghosts.count);
  ghosts.offset.resize(ghosts.count);
  for_each_ghost(pool, ghosts, [&](std::size_t k) {
    const Ghosts::Image& image = ghosts.images[ghosts.order[k]];
    ghosts.source[k] = image.source;
    ghosts.sign[k] = image.sign;
    ghosts.offset[k] = image.offset;
  });
  if (position.size() < extended_count(count, ghosts)) position.resize(extended_count(count, ghosts), kFarRecord);
  extend_positions(pool, ghosts, position);
}

std::size_t extended_count(std::size_t count, const Ghosts& ghosts) {
  return ghosts.empty() ? padded_count(count) : ghosts.begin + padded_count(ghosts.count);
}

void extend_scalars(TaskPool& pool, const Ghosts& ghosts, std::span<float> values) {
  for_each_ghost(pool, ghosts, [&](std::size_t k) { values[ghosts.begin + k] = values[ghosts.source[k]]; });
}

void extend_positions(TaskPool& pool, const Ghosts& ghosts, std::span<Float4> positions) {
  for_each_ghost(pool, ghosts, [&](std::size_t k) {
    positions[ghosts.begin + k] = place(ghosts.sign[k], ghosts.offset[k], positions[ghosts.source[k]]);
  });
}

void extend_vectors(TaskPool& pool, const Ghosts& ghosts, std::span<Float4> vectors) {
  for_each_ghost(pool, ghosts, [&](std::size_t k) {
    vectors[ghosts.begin + k] = place(ghosts.sign[k], Float4{}, vectors[ghosts.source[k]]);
  });
}

}  // namespace pelagos
