#include "renderer/shadow.hpp"

#include <algorithm>
#include <cmath>

namespace pelagos {
namespace {

constexpr double kFarthest = 250.0;  // m from the eye: shadows of bodies farther off are not drawn
constexpr float kNoBody = -1e9F;     // m

struct Ball {
  Eigen::Vector3d centre;
  double radius;
};

Ball ball_around(const PlacedMesh& placed) {
  const Eigen::Vector3f middle = 0.5F * (placed.mesh->low() + placed.mesh->high());
  const float radius = 0.5F * (placed.mesh->high() - placed.mesh->low()).norm();
  return {(placed.position + placed.world_from_body * middle).cast<double>(), static_cast<double>(radius)};
}

}  // namespace

ShadowPlace shadow_place(const std::vector<PlacedMesh>& meshes, const Eigen::Vector3d& sun, int texels) {
  ShadowPlace place;
  const Eigen::Vector3d across = sun.unitOrthogonal(), up = sun.cross(across);
  Eigen::Array3d low = Eigen::Array3d::Constant(HUGE_VAL), high = -low;
  for (const PlacedMesh& placed : meshes) {
    const Ball ball = ball_around(placed);
    if (ball.centre.norm() - ball.radius > kFarthest) continue;
    const Eigen::Array3d at(across.dot(ball.centre), up.dot(ball.centre), sun.dot(ball.centre));
    low = low.min(at - ball.radius);
    high = high.max(at + ball.radius);
  }
  const double side = (high - low).head<2>().maxCoeff() * 1.04;
  if (!(side > 0.0) || !std::isfinite(side)) return place;
  const Eigen::Array3d middle = 0.5 * (low + high);
  place.u << across / side, 0.5 - middle.x() / side;
  place.v << up / side, 0.5 - middle.y() / side;
  place.bias = 3.0 * side / texels;
  place.middle = middle.z();
  place.scale = 1.0 / (1.01 * (high.z() - low.z()));
  return place;
}

ShadowPass::ShadowPass(int texels)
    : program_("shadow.vert", "shadow.frag"),
      map_(texels, texels, GL_R32F, GL_NEAREST, GL_CLAMP_TO_EDGE),
      target_({&map_}, true) {}

void ShadowPass::draw(const std::vector<PlacedMesh>& meshes) {
  target_.begin_solids({kNoBody, 0, 0, 0});
  program_.use();
  draw_meshes(meshes, program_);
  glDisable(GL_DEPTH_TEST);
}

}  // namespace pelagos
