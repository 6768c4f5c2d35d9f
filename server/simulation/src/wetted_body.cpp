#include "simulation/wetted_body.hpp"

#include <Eigen/Dense>
#include <numbers>
#include <vector>

namespace pelagos {

namespace {

constexpr int kRingPlaces = 32;
constexpr double kRingWidth = 1.1;  ///< of the body's own half width: the ring runs just outside

/// z = c0 + c1 (x - mx) + c2 (y - my) by least squares; level where the points are too few to say more.
struct FittedPlane {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
};
FittedPlane fit_plane(const std::vector<Eigen::Vector3d>& points) {
  FittedPlane plane;
  for (const Eigen::Vector3d& point : points) plane.middle += point / static_cast<double>(points.size());
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  Eigen::Vector2d products = Eigen::Vector2d::Zero();
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector2d r = (point - plane.middle).head<2>();
    squares += r * r.transpose();
    products += r * (point.z() - plane.middle.z());
  }
  if (points.size() > kRingPlaces / 2) plane.slope = squares.ldlt().solve(products);
  return plane;
}

}  // namespace

Eigen::AlignedBox3d box_around(const BodyShape& shape, const Eigen::Vector3d& position,
                               const Eigen::Quaterniond& orientation) {
  Eigen::AlignedBox3d box;
  for (int corner = 0; corner < 8; ++corner)
    box.extend(orientation * shape.bounding_box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)) +
               position);
  return box;
}

std::vector<SurfacePlace> ring_around(const BodyShape& shape, const BodyState& state, const PatchFrame& frame) {
  const Eigen::AlignedBox3d box = box_around(shape, frame.to_local(state.position), state.orientation);
  const Eigen::Vector2d middle = box.center().head<2>();
  const Eigen::Vector2d half = kRingWidth * std::numbers::sqrt2 * 0.5 * box.sizes().head<2>();
  std::vector<SurfacePlace> places;
  for (int k = 0; k < kRingPlaces; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / kRingPlaces;
    places.push_back({middle + half.cwiseProduct(Eigen::Vector2d(std::cos(angle), std::sin(angle))), {}});
  }
  return places;
}

WaterPlane water_around(std::span<const SurfacePlace> ring, std::span<const SurfaceReading> readings,
                        const BodyState& state, const PatchFrame& frame, double still_level) {
  std::vector<Eigen::Vector3d> points;
  for (std::size_t k = 0; k < ring.size(); ++k)
    if (readings[k].wet) points.emplace_back(ring[k].local.x(), ring[k].local.y(), readings[k].height);
  FittedPlane plane;
  if (points.empty())
    plane.middle.z() = still_level;
  else
    plane = fit_plane(points);
  const Eigen::Vector3d up = Eigen::Vector3d(-plane.slope.x(), -plane.slope.y(), 1.0).normalized();
  return {state.orientation.conjugate() * up, up.dot(frame.to_world(plane.middle) - state.position)};
}

void measure_buoyancy(const BodyShape& shape, const WaterPlane& water, double weight_density, BodyLoad& load) {
  if (shape.kind != MeshKind::kClosed) return;
  const Hydrostatics still = hydrostatics(shape.mesh, water);
  load.wetted_volume = still.volume;
  load.wetted_area = still.wetted_area;
  load.buoyant_force = weight_density * still.volume * water.up;
  load.buoyant_moment = (still.centre_of_buoyancy - load.point).cross(load.buoyant_force);
}

void add_hold(const PartVolume& below, const PartVolume& hold_water, const WaterPlane& water, double weight_density,
              BodyLoad& load) {
  const double volume = below.volume - hold_water.volume;
  const Eigen::Vector3d moment = below.moment - hold_water.moment;
  load.wetted_volume += volume;
  load.buoyant_force += weight_density * volume * water.up;
  load.buoyant_moment += (moment - volume * load.point).cross(weight_density * water.up);
}

}  // namespace pelagos
