// Boxes, and blocks that start full of a liquid.

#include "validate_scene.hpp"
#include "values/lattice.hpp"

namespace pelagos {

namespace {

constexpr std::size_t kMostBlocks = 64;
constexpr double kFarthest = 1e6;  // m; coordinates beyond it lose a millimetre in single precision offsets

std::string describe(const Eigen::Vector3d& v) {
  return "(" + format_number(v.x()) + ", " + format_number(v.y()) + ", " + format_number(v.z()) + ")";
}
std::string describe(const Box& box) { return describe(box.min) + " to " + describe(box.max); }

bool inside(const Box& inner, const Box& outer, double slack) {
  return (inner.min.array() >= outer.min.array() - slack).all() &&
         (inner.max.array() <= outer.max.array() + slack).all();
}

bool overlap(const Box& a, const Box& b, double slack) {
  return (a.min.array() < b.max.array() - slack).all() && (b.min.array() < a.max.array() - slack).all();
}

/// Least size of a block that holds a particle: 2 spacings between sampled walls, one where the axis has none.
Eigen::Vector3d least_block(const PatchEdges& edges, double spacing) {
  return 2.0 * spacing * Eigen::Vector3d(lattice_offset(edges[0]), lattice_offset(edges[1]), lattice_offset(edges[2]));
}

void refuse_small_block(const FieldReader& entry, const Box& block, double spacing, const PatchEdges& edges) {
  const Eigen::Vector3d least = least_block(edges, spacing);
  if (edges == kWallsAround) {
    entry.fault("", "is too small for one particle: " + describe(block.size()) + " m; allowed: at least " +
                        format_number(least.x()) + " m (2 particle spacings) along each axis");
  } else {
    entry.fault("", "is too small for one particle: " + describe(block.size()) + " m; allowed: at least " +
                        describe(least) + " m (2 particle spacings between sampled walls, else 1)");
  }
}

}  // namespace

std::optional<Box> read_box(const FieldReader& reader) {
  Box box;
  const Range range{-kFarthest, kFarthest, "m"};
  reader.require("min");
  reader.require("max");
  const bool min_valid = reader.read("min", range, box.min);
  const bool max_valid = reader.read("max", range, box.max);
  if (!min_valid || !max_valid) return std::nullopt;
  if ((box.size().array() <= 0.0).any()) {
    reader.fault("", "runs from min " + describe(box.min) + " to max " + describe(box.max) +
                         "; allowed: min below max on each axis");
    return std::nullopt;
  }
  return box;
}

std::vector<Box> BlockReader::read(const FieldReader& liquid, const char* name) {
  std::vector<Box> blocks;
  const std::vector<FieldReader> entries = liquid.children("block");
  if (entries.size() > kMostBlocks) {
    liquid.fault("block", "has " + format_count(static_cast<double>(entries.size())) + " entries; allowed: at most 64");
    return blocks;
  }
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const std::optional<Box> block = read_box(entries[i]);
    if (!block) continue;
    place(entries[i], std::string(name) + ".block[" + std::to_string(i) + "]", *block);
    blocks.push_back(*block);
  }
  if (total_ > kMostParticles && !entries.empty()) {
    liquid.fault("block", "asks for " + format_count(total_) + " particles in all; allowed: at most " +
                              format_count(kMostParticles) + " (a larger particle_spacing or smaller blocks)");
  }
  return blocks;
}

void BlockReader::place(const FieldReader& entry, std::string name, const Box& block) {
  const double slack = 1e-6 * spacing_.value_or(0.0);
  if (patch_ && !inside(block, *patch_, slack)) {
    entry.fault("", "lies at " + describe(block) + "; allowed: inside the patch, " + describe(*patch_));
  }
  if (spacing_) {
    const double count = particle_count(block, *spacing_, edges_);
    if (count < 1.0) refuse_small_block(entry, block, *spacing_, edges_);
    total_ += count;
  }
  for (const auto& [other, box] : placed_) {
    if (overlap(block, box, slack))
      entry.fault("", "overlaps " + other + ", " + describe(box) + "; allowed: blocks that touch at most");
  }
  placed_.emplace_back(std::move(name), block);
}

}  // namespace pelagos
