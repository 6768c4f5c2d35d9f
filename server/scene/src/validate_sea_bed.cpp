// A sea bed from a file.

#include <cmath>

#include "terrain/read_heights.hpp"
#include "validate_scene.hpp"
#include "values/open_edges.hpp"

namespace pelagos {

namespace {

constexpr double kLeastBlend = 4.0, kMostBlend = 100.0, kDefaultBlend = 20.0;  // spacings
constexpr double kSteepestBlend =
    0.2;                             ///< of the blend's width: so much may the bed differ from the level bottom there
constexpr double kLeastBelow = 0.5;  ///< spacings that a bed may lie under the lowest water
constexpr int kSettleSteps = 100;    ///< without the scene's: layers on a lattice do not fit a bed
constexpr double kLargestOffset = 12000.0;  // m

/// Nodes a spacing apart all over the patch.
HeightGrid lay_grid(const Scene& scene) {
  HeightGrid grid;
  grid.cell = scene.particle_spacing;
  grid.x = scene.patch.min.x();
  grid.y = scene.patch.min.y();
  grid.columns = static_cast<int>(std::ceil(scene.patch.size().x() / grid.cell - 1e-6)) + 1;
  grid.rows = static_cast<int>(std::ceil(scene.patch.size().y() / grid.cell - 1e-6)) + 1;
  return grid;
}

std::string at(const HeightGrid& grid, std::size_t node) {
  return "at (" + format_number(grid.node_x(node)) + ", " + format_number(grid.node_y(node)) + ")";
}

bool refuse_holes(const FieldReader& entry, const HeightsRead& read, const HeightGrid& grid) {
  if (read.holes == 0) return false;
  std::size_t first = 0;
  while (std::isfinite(grid.height[first])) ++first;
  entry.fault("file", "has no height for " + std::to_string(read.holes) + " of " + std::to_string(grid.height.size()) +
                          " places of the patch, the first " + at(grid, first) +
                          "; allowed: a height everywhere in the patch");
  return true;
}

void check_heights(const FieldReader& entry, const Scene& scene, const SeaBedSettings& bed) {
  const double d = scene.particle_spacing, bottom = scene.water.blocks[0].min.z();
  const double blended = kRimColumns * d + scene.open_sea.zone_width + bed.blend_width;
  const double most = kSteepestBlend * bed.blend_width;
  const HeightGrid& grid = bed.heights;
  for (std::size_t node = 0; node < grid.height.size(); ++node) {
    const double above = static_cast<double>(grid.height[node]) - bottom;
    const bool near = distance_inside(scene.patch, scene.patch_edges, {grid.node_x(node), grid.node_y(node)}) < blended;
    if (near && std::abs(above) > most)
      return entry.fault("file", "is " + format_number(std::abs(above)) + (above > 0.0 ? " m above" : " m below") +
                                     " the level bottom " + at(grid, node) + ", near an open edge; allowed: at most " +
                                     format_number(most) + " m of difference, a fifth of blend_width, within " +
                                     format_number(blended) + " m of open edges");
    if (above < -kLeastBelow * d)
      return entry.fault("file", "lies " + format_number(-above) + " m below the lowest water " + at(grid, node) +
                                     "; allowed: a block of water and a depth that reach the deepest place");
  }
}

}  // namespace

void read_sea_bed(const FieldReader& entry, const SceneSource& source, Scene& scene) {
  SeaBedSettings& bed = scene.open_sea.bed;
  const double d = scene.particle_spacing;
  bed.blend_width = kDefaultBlend * d;
  entry.read("blend_width", {kLeastBlend * d, kMostBlend * d, "m", "4 to 100 spacings"}, bed.blend_width);
  double offset = 0.0;
  entry.read("offset", {-kLargestOffset, kLargestOffset, "m"}, offset);
  if (scene.open_sea.follows()) entry.fault("", "lies in a patch that follows; allowed: without follow");
  const double simulated = scene.water.blocks.empty() ? 0.0 : scene.water.blocks[0].size().z();
  if (std::abs(scene.open_sea.depth - simulated) > 1e-6 * d)
    entry.fault("", "needs open_sea.depth to be that of the block of water, " + format_number(simulated) + " m");
  std::string written;
  if (!entry.require("file") || !entry.read("file", 1024, written)) return;
  const std::string file = find_asset(entry, "file", written, source);
  if (!source.check_meshes || scene.water.blocks.empty() || !std::filesystem::exists(file)) return;
  bed.heights = lay_grid(scene);
  const HeightsRead read = read_heights(file, scene.origin.latitude_deg, scene.origin.longitude_deg, bed.heights);
  if (!read.fault.empty()) return entry.fault("file", "\"" + written + "\" " + read.fault);
  if (refuse_holes(entry, read, bed.heights)) return;
  for (float& height : bed.heights.height) height += static_cast<float>(offset);
  check_heights(entry, scene, bed);
  if (scene.water.settle_steps == 0) scene.water.settle_steps = kSettleSteps;
}

}  // namespace pelagos
