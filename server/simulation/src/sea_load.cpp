#include "simulation/sea_load.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

namespace pelagos {

namespace {

constexpr double kLeastSpread = 1e-6;  ///< m^2 for each m^2: a hull so narrow tells nothing of slopes

/// The slopes over x, y of values at arms, weighed, about their means.
struct SlopeFit {
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  Eigen::Vector2d products = Eigen::Vector2d::Zero();

  void add(double weight, const Eigen::Vector2d& arm, double value) {
    squares += weight * arm * arm.transpose();
    products += weight * value * arm;
  }
  /// The turn of a rigid body with these slopes of its vertical velocity.
  [[nodiscard]] Eigen::Vector3d turn() const {
    const Eigen::Matrix2d safe = squares + kLeastSpread * (1.0 + squares.trace()) * Eigen::Matrix2d::Identity();
    const Eigen::Vector2d slope = safe.ldlt().solve(products);
    return {slope.y(), -slope.x(), 0.0};
  }
};

Vector6d joined(const Eigen::Vector3d& along, const Eigen::Vector3d& about) {
  Vector6d both;
  both << along, about;
  return both;
}

/// The waves that a body of such panels feels.
WaveMoment felt_waves(const SeaPanels& panels, const CarryingSea& sea, const Eigen::Vector2d& anchor) {
  WaveMoment moment = sea.waves->at(sea.time, anchor);
  const auto most = static_cast<float>(2.0 * std::numbers::pi / (SeaLoader::kShortestWave * panels.edge));
  std::erase_if(moment.waves, [most](const MomentWave& wave) { return wave.wavenumber > most; });
  return moment;
}

}  // namespace

void SeaLoader::find_water(const SeaPanels& panels, const BodyState& state, const CarryingSea& sea) {
  const WaveMoment moment = felt_waves(panels, sea, state.position.head<2>());
  const std::size_t count = panels.mesh.vertices.size();
  for (auto* values : {&x_, &y_, &z_, &a_, &b_, &c_, &px_, &py_, &pz_, &ax_, &ay_, &az_, &pressure_})
    values->resize(count);
  place_.resize(count), head_.resize(count), velocity_.resize(count), acceleration_.resize(count);
  const Eigen::Matrix3d turn = state.orientation.toRotationMatrix();
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d arm = turn * panels.mesh.vertices[i];
    place_[i] = arm + state.position;
    px_[i] = x_[i] = static_cast<float>(arm.x());
    py_[i] = y_[i] = static_cast<float>(arm.y());
    pz_[i] = z_[i] = static_cast<float>(place_[i].z() - moment.level);
  }
  for (int k = 0; k < kSubstitutions && !moment.waves.empty(); ++k) {
    evaluate_displacement(moment, x_, y_, z_, a_, b_, c_);
    for (std::size_t i = 0; i < count; ++i) x_[i] = px_[i] - a_[i], y_[i] = py_[i] - b_[i], z_[i] = pz_[i] - c_[i];
  }
  evaluate_motion(moment, x_, y_, z_, Stretching::kNone, {a_, b_, c_, ax_, ay_, az_, pressure_});
  for (std::size_t i = 0; i < count; ++i) {
    head_[i] = -static_cast<double>(z_[i]);
    velocity_[i] = Eigen::Vector3f(a_[i], b_[i], c_[i]).cast<double>();
    acceleration_[i] = Eigen::Vector3f(ax_[i], ay_[i], az_[i]).cast<double>();
    if (sea.current != nullptr) velocity_[i] += sea.current->velocity_at(place_[i], sea.time);
  }
}

SeaLoader::WetPanel SeaLoader::wet_part(const std::array<std::uint32_t, 3>& triangle,
                                        const Eigen::Vector3d& about) const {
  WetPanel wet;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::uint32_t i = triangle[c], j = triangle[(c + 1) % 3];
    const Eigen::Vector3d from = place_[i] - about;
    wet.velocity += velocity_[i] / 3.0;
    wet.acceleration += acceleration_[i] / 3.0;
    if (head_[i] > 0.0) wet.corner[wet.count++] = {from, head_[i], share_[i]};
    if ((head_[i] > 0.0) == (head_[j] > 0.0)) continue;
    const double t = head_[i] / (head_[i] - head_[j]);
    wet.corner[wet.count++] = {from + t * (place_[j] - place_[i]), 0.0, share_[i] + t * (share_[j] - share_[i])};
  }
  return wet;
}

void SeaLoader::add_panel(const WetPanel& panel, const HullMotion& hull, const CarryingSea& sea, SeaLoad& load) {
  for (std::size_t k = 2; k < panel.count; ++k) {
    const Corner &a = panel.corner[0], &b = panel.corner[k - 1], &c = panel.corner[k];
    const double share = (a.share + b.share + c.share) / 3.0;
    const Eigen::Vector3d area = 0.5 * (b.arm - a.arm).cross(c.arm - a.arm), sum = a.arm + b.arm + c.arm;
    const double size = area.norm();
    if (!(share > 0.0 && size > 0.0)) continue;
    const double qa = a.head * a.share, qb = b.head * b.share, qc = c.head * c.share, q = qa + qb + qc;
    const Eigen::Vector3d moment = (q * sum + qa * a.arm + qb * b.arm + qc * c.arm) / 12.0;
    load.force -= sea.density * sea.gravity * joined(q / 3.0 * area, moment.cross(area));
    const double lid = -share * area.z();
    load.waterplane += lid;
    for (int axis = 0; axis < 2; ++axis) {  // about x counts the way along y
      const Eigen::Vector3d way = hull.turn.col(1 - axis);
      const Eigen::Vector3d at(way.dot(a.arm), way.dot(b.arm), way.dot(c.arm));
      load.waterplane_moments[static_cast<std::size_t>(axis)] += lid / 12.0 * (at.sum() * at.sum() + at.squaredNorm());
    }
    load.wetted += share * size;
    wet_.push_back({share * size, sum / 3.0, panel.velocity, panel.acceleration});
    add_drag(wet_.back(), area / size, hull, sea.density, load);
  }
}

void SeaLoader::add_drag(const WetPart& part, const Eigen::Vector3d& normal, const HullMotion& hull, double density,
                         SeaLoad& load) {
  const double speed = normal.dot(part.velocity - hull.velocity - hull.angular_velocity.cross(part.arm));
  const double drag = 0.5 * density * kDragOfSide * part.area * std::abs(speed);
  const Vector6d way = joined(normal, part.arm.cross(normal));
  load.drag += drag * speed * way;
  load.drag_rate += drag * way * way.transpose();
}

void SeaLoader::fit_water(SeaLoad& load) const {
  if (!(load.wetted > 0.0)) return;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero(), velocity = middle, acceleration = middle;
  for (const WetPart& part : wet_) {
    const double weight = part.area / load.wetted;
    middle += weight * part.arm;
    velocity += weight * part.velocity;
    acceleration += weight * part.acceleration;
  }
  SlopeFit of_velocity, of_acceleration;
  for (const WetPart& part : wet_) {
    const Eigen::Vector2d arm = (part.arm - middle).head<2>();
    of_velocity.add(part.area, arm, part.velocity.z() - velocity.z());
    of_acceleration.add(part.area, arm, part.acceleration.z() - acceleration.z());
  }
  const Eigen::Vector3d turn = of_velocity.turn(), turn_rate = of_acceleration.turn();
  load.water = joined(velocity - turn.cross(middle), turn);
  load.water_rate = joined(acceleration - turn_rate.cross(middle), turn_rate);
}

SeaLoad SeaLoader::load(const SeaPanels& panels, const BodyState& state, const Eigen::Vector3d& about,
                        const CarryingSea& sea, const PlaceShare& share) {
  SeaLoad load;
  wet_.clear();
  find_water(panels, state, sea);
  share_.resize(place_.size());
  for (std::size_t i = 0; i < place_.size(); ++i) share_[i] = share(place_[i].head<2>());
  const HullMotion hull{state.orientation.toRotationMatrix(),
                        state.velocity + state.angular_velocity.cross(about - state.position), state.angular_velocity};
  for (const auto& triangle : panels.mesh.triangles) add_panel(wet_part(triangle, about), hull, sea, load);
  fit_water(load);
  return load;
}

}  // namespace pelagos
