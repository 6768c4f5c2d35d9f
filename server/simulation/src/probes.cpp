#include "simulation/probes.hpp"

#include <fmt/format.h>

#include "simulation/surface_columns.hpp"

namespace pelagos {

std::optional<std::string> Probes::set(const ProbeSettings& probe) {
  if (!probes_.contains(probe.id) && probes_.size() >= kMostProbes)
    return fmt::format("there are {} probes already; allowed: at most so many", kMostProbes);
  probes_[probe.id] = probe;
  return std::nullopt;
}

std::optional<std::string> Probes::remove(std::uint32_t id) {
  if (probes_.erase(id) == 0) return fmt::format("there is no probe {}", id);
  return std::nullopt;
}

std::vector<std::uint32_t> Probes::ids() const {
  std::vector<std::uint32_t> ids;
  for (const auto& [id, probe] : probes_) ids.push_back(id);
  return ids;
}

std::vector<ProbeReading> Probes::read(const FluidState& fluid, const Bodies& bodies, const Eigen::Vector3d& origin,
                                       const std::optional<Current>& current, double time) const {
  std::vector<ProbeReading> readings;
  std::vector<SurfacePlace> places;
  for (const auto& [id, probe] : probes_) {
    ProbeReading& reading = readings.emplace_back();
    reading.id = id;
    reading.name = probe.name;
    reading.position = probe.position;
    if (const auto carrier = bodies.state_of(probe.body))
      reading.position = carrier->orientation * probe.position + carrier->position;
    SurfacePlace& place = places.emplace_back();
    place.local = (reading.position - origin).head<2>();
    if (!probe.at_surface) place.height = reading.position.z() - origin.z();
  }
  const std::vector<SurfaceReading> surface = read_surface(fluid, places);
  for (std::size_t k = 0; k < readings.size(); ++k) {
    readings[k].wet = surface[k].wet;
    if (!surface[k].wet) continue;
    readings[k].height = surface[k].height + origin.z();
    readings[k].normal = surface[k].normal;
    readings[k].velocity = surface[k].velocity;
    if (current) readings[k].velocity += current->unresolved_velocity_at(readings[k].position, time);
  }
  return readings;
}

}  // namespace pelagos
