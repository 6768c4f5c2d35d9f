// How free bodies are carried by the part of a current that the particles do not make.

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "rigid/hydrostatics.hpp"
#include "simulation/bodies.hpp"

namespace pelagos {

namespace {

constexpr double kWatchInterval = 0.25;  ///< s between readings of the water's drift
constexpr int kWatchRows = 8;            ///< of places over the patch, along x and y

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// m/s, the middle of the surface's velocities all over the patch: wakes cover few of the places.
Eigen::Vector2d drift_of_surface(WaterSurface& surface, const FluidState& fluid) {
  const Region& patch = fluid.parameters.patch;
  const Eigen::Vector2d min(patch.min[0], patch.min[1]), max(patch.max[0], patch.max[1]);
  std::vector<SurfacePlace> places;
  for (int i = 0; i < kWatchRows; ++i)
    for (int j = 0; j < kWatchRows; ++j)
      places.push_back({min + (max - min).cwiseProduct(Eigen::Vector2d(i + 0.5, j + 0.5) / kWatchRows), {}});
  std::array<std::vector<double>, 2> along;
  for (const SurfaceReading& reading : surface.read_particles(fluid, places))
    for (std::size_t axis = 0; reading.wet && axis < 2; ++axis)
      along[axis].push_back(reading.velocity[static_cast<Eigen::Index>(axis)]);
  if (along[0].empty()) return Eigen::Vector2d::Zero();
  return {median(along[0]), median(along[1])};
}

/// The mean of `velocity_at(place)` over the samples under the level (m, world); at the level where there are none.
template <class F>
Eigen::Vector2d mean_over_hull(const BodyShape& shape, const BodyState& state, double level, F&& velocity_at) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double count = 0.0;
  const Eigen::Matrix3d rotation = state.orientation.toRotationMatrix();
  for (const Eigen::Vector3f& sample : shape.samples) {
    const Eigen::Vector3d place = rotation * sample.cast<double>() + state.position;
    if (!(place.z() < level)) continue;
    sum += velocity_at(place).template head<2>();
    count += 1.0;
  }
  if (count > 0.0) return sum / count;
  return velocity_at(Eigen::Vector3d(state.position.x(), state.position.y(), level)).template head<2>();
}

/// Share of its weight that still water would carry, at most 1.
double carried_share(const BodyShape& shape, const BodyState& state, double mass, double level, double rest_density) {
  if (shape.kind != MeshKind::kClosed) return 0.0;
  const WaterPlane still{state.orientation.conjugate() * Eigen::Vector3d::UnitZ(), level - state.position.z()};
  return std::min(1.0, rest_density * hydrostatics(shape.mesh, still).volume / mass);
}

/// Gives the particles at each body's hull its force (N) over dt, more to the nearer ones.
void push_water(std::span<const Eigen::Vector2d> forces, double dt, FluidState& fluid) {
  std::vector<double> total(forces.size(), 0.0);
  for (const BodyContact& contact : fluid.coupling.contacts)
    total[contact.body] += static_cast<double>(contact.gradient.norm());
  const double mass = fluid.parameters.rest_density * fluid.parameters.volume();
  for (const BodyContact& contact : fluid.coupling.contacts) {
    const double all = total[contact.body];
    if (!(all > 0.0)) continue;
    const double share = static_cast<double>(contact.gradient.norm()) / all;
    const Eigen::Vector2f change = (share * dt / mass * forces[contact.body]).cast<float>();
    fluid.particles.velocity[contact.particle].x += change.x();
    fluid.particles.velocity[contact.particle].y += change.y();
  }
}

}  // namespace

void Bodies::start_drift(const Current& current, double time, double water_level, double rest_density) {
  for (Body& body : bodies_) {
    if (!body.drifts()) continue;
    const double share = carried_share(body.shape, body.state, body.free->mass().mass, water_level, rest_density);
    Eigen::Vector3d velocity = body.free->velocity();
    velocity.head<2>() +=
        share * mean_over_hull(body.shape, body.state, water_level,
                               [&](const Eigen::Vector3d& place) { return current.velocity_at(place, time); });
    body.free->take(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), velocity, body.free->angular_velocity());
    body.free->write_to(body.state);
  }
}

DriftSea Bodies::sea_of(const Body& body, double time, const Current& current, double water_level) const {
  DriftSea sea;
  sea.current = mean_over_hull(body.shape, body.state, water_level, [&](const Eigen::Vector3d& place) {
    return current.unresolved_velocity_at(place, time);
  });
  const double depth = std::max(0.0, water_level - body.free->centre().z());
  sea.rate = current.target().profile(depth) * current.surface_rate_at(time).head<2>();
  sea.water = surface_drift_.velocity;
  for (std::size_t axis = 0; axis < 2; ++axis) sea.acts[axis] = !current.moves_water()[axis];
  sea.relaxation = current.target().relaxation;
  return sea;
}

void Bodies::drift(double dt, const BodySea& at, FluidState& fluid) {
  const bool acts = at.current != nullptr && !(at.current->moves_water()[0] && at.current->moves_water()[1]) &&
                    std::any_of(bodies_.begin(), bodies_.end(), [](const Body& body) { return body.drifts(); });
  if (!acts && !surface_drift_.acts) return;
  surface_drift_.acts = acts;
  if (!acts) {
    for (Body& body : bodies_) body.drift = {}, body.drift_force.setZero();
    return;
  }
  if (!at.wind_drags) {
    surface_drift_.velocity.setZero();
  } else if (at.time >= surface_drift_.due) {
    surface_drift_.velocity = drift_of_surface(*at.surface, fluid);
    surface_drift_.due = at.time + kWatchInterval;
  }
  std::vector<Eigen::Vector2d> on_water(fluid.coupling.bodies.size(), Eigen::Vector2d::Zero());
  std::size_t coupled = 0;
  for (Body& body : bodies_) {
    if (!body.moves()) continue;
    const CoupledBody& push = fluid.coupling.bodies[coupled++];
    if (!body.drifts()) continue;
    const double mass = body.free->mass().mass;
    const DriftForce force = body.drift.act(
        sea_of(body, at.time, *at.current, at.water_level),
        {mass, mass * fluid.parameters.gravity, (push.velocity - push.impulse / mass).head<2>(), push.impulse / dt},
        dt);
    body.drift_force = force.on_body;
    on_water[coupled - 1] = force.on_water;
  }
  push_water(on_water, dt, fluid);
}

}  // namespace pelagos
