#include "sea_bed.hpp"

#include "smooth_step.hpp"
#include "values/open_edges.hpp"

namespace pelagos {

namespace {

/// The bed's height at any place of the world.
class BlendedBed {
 public:
  explicit BlendedBed(const Scene& scene)
      : scene_(scene),
        bottom_(scene.water.blocks[0].min.z()),
        begin_(kRimColumns * scene.particle_spacing + scene.open_sea.zone_width) {}

  [[nodiscard]] double at(double x, double y) const {
    const SeaBedSettings& bed = scene_.open_sea.bed;
    const double share =
        smooth_step((distance_inside(scene_.patch, scene_.patch_edges, {x, y}) - begin_) / bed.blend_width);
    return bottom_ + share * (bed.heights.at(x, y) - bottom_);
  }

 private:
  const Scene& scene_;
  double bottom_, begin_;
};

}  // namespace

void shape_bed(const Scene& scene, const PatchFrame& frame, Floor& floor) {
  const BlendedBed bed(scene);
  const double half = 0.5 * static_cast<double>(floor.cell);
  floor.nodes.clear();
  for (int j = 0; j < floor.rows; ++j)
    for (int i = 0; i < floor.columns; ++i) {
      const Eigen::Vector2d at =
          frame.to_world(Eigen::Vector2d(static_cast<double>(floor.x + floor.cell * static_cast<float>(i)),
                                         static_cast<double>(floor.y + floor.cell * static_cast<float>(j))));
      const double x = at.x(), y = at.y();
      floor.nodes.push_back({static_cast<float>(frame.local_height(bed.at(x, y))),
                             static_cast<float>((bed.at(x + half, y) - bed.at(x - half, y)) / (2.0 * half)),
                             static_cast<float>((bed.at(x, y + half) - bed.at(x, y - half)) / (2.0 * half)), 0.0F});
    }
}

}  // namespace pelagos
