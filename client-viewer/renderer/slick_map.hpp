#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "renderer/gl_objects.hpp"
#include "values/slick.hpp"

namespace pelagos {

/// A film of oil to draw. The span must outlive the call.
struct Slick {
  std::span<const SlickDisc> discs;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< m, world, of the discs
};

/// Where the map of a film lies: a square of the world, north up. Its texels have lengths of a ladder and lie on a grid
/// that is fixed in the world, so that a slick that grows and drifts does not crawl over them.
struct SlickPlace {
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();  ///< m, world, south-west
  double length = 0.0;                               ///< m, of a side; 0: nothing to draw
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< m, world, of the oil's mass: patterns drift along with it
  double reach = 0.0;                                ///< m, of the elements' bells, mean by mass
};
[[nodiscard]] SlickPlace place_of(const Slick& slick, int texels);

/// The film seen from above, as a picture of its thickness. The sea looks up in it what lies on it, wherever a pixel's
/// place on the water is: so it follows waves, is hidden by what hides the water, and is the same in all channels.
class SlickMap {
 public:
  explicit SlickMap(int texels);

  void draw(const Slick& slick, const SlickPlace& place);

  /// Sums over discs of weight * thickness (um), the same times the share of water, and weight; alpha: how far out
  /// of the oil, 1 at an element, 0.5 at the edge of its disc, 0 where nothing is left. With all its mip levels.
  [[nodiscard]] const Texture& film() const { return film_; }

 private:
  Program program_;
  Texture film_;
  Framebuffer target_;
  Buffer discs_;
  VertexArray nothing_;
};

}  // namespace pelagos
