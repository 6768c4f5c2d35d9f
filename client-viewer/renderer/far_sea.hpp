#pragma once

#include <vector>

#include "channels/camera.hpp"
#include "renderer/gl_objects.hpp"
#include "waves/wave_moment.hpp"

namespace pelagos {

/// Radii of the rings of the far sea's grid for an eye at `height` metres above the water: fine below the eye, a fixed
/// part of the distance further out, one pixel line at the horizon. The first is 0, the last at least 30 km.
[[nodiscard]] std::vector<float> ring_radii(double height, double coarseness);

/// First sector and number of sectors (of `around`) that the picture of a camera can show.
struct SectorRange {
  int first = 0, count = 0;
};
[[nodiscard]] SectorRange visible_sectors(const Camera& camera, int around);

/// Draws the open sea from all its wave components: (inverse depth, slope x, slope y, foam of crests).
class FarSeaPass {
 public:
  /// @param coarseness  1: fine; larger: cheaper
  FarSeaPass(int width, int height, double coarseness);

  /// @param height  of the eye above the mean water level, m
  /// @param waves   at the time shown, anchored at the eye
  /// @param carried_by_patch  waves longer than this (m) are the simulation's own inside the patch
  void draw(const Camera& camera, double height, const WaveMoment& waves, double carried_by_patch);

  /// No sea at all.
  void leave_out() { target_.begin_solids(); }

  /// What grid_cell() of the shaders needs for an eye at that height, m: coarseness, the height that the grid is for,
  /// angle between two sectors (rad).
  [[nodiscard]] Eigen::Vector3d grid_for(double height) const;
  [[nodiscard]] const Texture& surface() const { return surface_; }

 private:
  void prepare_grid(double height);

  Program program_;
  Texture surface_;
  Framebuffer target_;
  Buffer rings_, indices_, waves_;
  std::vector<MomentWave> longest_first_;
  VertexArray array_;
  double coarseness_;
  double grid_height_ = 0.0;
  int ring_count_ = 0;
};

}  // namespace pelagos
