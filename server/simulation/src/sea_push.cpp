#include "simulation/sea_push.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "rigid/triangle_mesh.hpp"

namespace pelagos {

namespace {

Matrix6d blocks(const Eigen::Matrix3d& along, const Eigen::Matrix3d& about) {
  Matrix6d both = Matrix6d::Zero();
  both.topLeftCorner<3, 3>() = along;
  both.bottomRightCorner<3, 3>() = about;
  return both;
}

double damping(double ratio, double stiffness, double mass) {
  return 2.0 * ratio * std::sqrt(std::max(0.0, stiffness * mass));
}

/// World axes.
struct SeaMatrices {
  Matrix6d mass, added, damping, stiffness;
};

SeaMatrices matrices(const SeaBody& sea_body, const FreeBody& body, const SeaLoad& load, const CarryingSea& sea,
                     double share) {
  const Eigen::Matrix3d turn = body.orientation().toRotationMatrix();
  const auto turned = [&turn](const Eigen::Vector3d& of_axes) -> Eigen::Matrix3d {
    return turn * of_axes.asDiagonal() * turn.transpose();
  };
  const double displaced = share * sea.density * sea_body.displacement, weight = sea.density * sea.gravity;
  SeaMatrices m;
  m.mass = blocks(body.mass().mass * Eigen::Matrix3d::Identity(), turn * body.mass().inertia * turn.transpose());
  m.added = blocks(turned(displaced * sea_body.added.along), turned(displaced * sea_body.added.about));
  const Eigen::Vector3d stiff(weight * std::max(0.0, load.waterplane_moments[0]),
                              weight * std::max(0.0, load.waterplane_moments[1]), 0.0);
  const double heave = weight * std::max(0.0, load.waterplane);
  m.stiffness = blocks(Eigen::Vector3d(0.0, 0.0, heave).asDiagonal(), turned(stiff));
  const Matrix6d whole = share * m.mass + m.added;
  const Eigen::Matrix3d inertia = turn.transpose() * whole.bottomRightCorner<3, 3>() * turn;
  const double slow = kSurgeDamping * std::sqrt(sea.gravity / sea_body.length);
  m.damping = blocks(
      Eigen::Vector3d(slow * whole(0, 0), slow * whole(1, 1), damping(kHeaveDamping, heave, whole(2, 2))).asDiagonal(),
      turned({damping(kRollDamping, stiff[0], inertia(0, 0)), damping(kPitchDamping, stiff[1], inertia(1, 1)),
              slow * inertia(2, 2)}));
  return m;
}

}  // namespace

SeaBody make_sea_body(const TriangleMesh& mesh, double mass, double density) {
  SeaBody body;
  body.panels = make_sea_panels(mesh);
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : mesh.vertices) box.extend(vertex);
  const double volume = mesh_volume(mesh);
  body.displacement = mass > 0.0 ? std::min(mass / density, volume) : volume;
  const Eigen::Vector3d half = 0.5 * box.sizes();
  const double depth = 3.0 * body.displacement / (2.0 * std::numbers::pi * half.x() * half.y());
  body.added = ellipsoid_added_mass({half.x(), half.y(), depth});
  body.length = 2.0 * std::max(half.x(), half.y());
  return body;
}

double carried_share(const SeaBody& sea_body, const SeaLoad& load, const CarryingSea& sea) {
  return std::clamp(load.force[2] / (sea.density * sea.gravity * sea_body.displacement), 0.0, 1.0);
}

Vector6d sea_push(const SeaBody& sea_body, const FreeBody& body, const SeaLoad& load, const CarryingSea& sea,
                  double dt) {
  const SeaMatrices m = matrices(sea_body, body, load, sea, carried_share(sea_body, load, sea));
  Vector6d velocity, rate = load.water_rate;
  velocity << body.velocity(), body.angular_velocity();
  rate[2] += sea.gravity;
  Vector6d push = dt * (load.force + m.added * rate + m.damping * (load.water - velocity) + load.drag);
  Matrix6d all = m.mass + m.added + dt * (m.damping + load.drag_rate) + 0.25 * dt * dt * m.stiffness;
  for (int motion = 0; motion < 6; ++motion) {
    if (body.freedoms().has(motion)) continue;
    all.row(motion).setZero();
    all.col(motion).setZero();
    all(motion, motion) = 1.0;
    push[motion] = 0.0;
  }
  return all.ldlt().solve(push);
}

Vector6d impulse_of(const FreeBody& body, const Vector6d& push, const Vector6d& on_led) {
  const Eigen::Matrix3d turn = body.orientation().toRotationMatrix();
  Vector6d impulse;
  impulse << body.mass().mass * push.head<3>(), turn * (body.mass().inertia * (turn.transpose() * push.tail<3>()));
  for (int motion = 0; motion < 6; ++motion)
    if (!body.freedoms().has(motion)) impulse[motion] = on_led[motion];
  return impulse;
}

}  // namespace pelagos
