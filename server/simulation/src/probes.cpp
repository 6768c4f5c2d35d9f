#include "simulation/probes.hpp"

#include <fmt/format.h>

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

std::vector<ProbeReading> Probes::read(const FluidState& fluid, WaterSurface& surface, const WaveField& sea,
                                       const Bodies& bodies, const Eigen::Vector3d& origin,
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
  const std::vector<SurfaceReading> water = surface.read(fluid, sea, time, places);
  for (std::size_t k = 0; k < readings.size(); ++k) {
    readings[k].wet = water[k].wet;
    if (!water[k].wet) continue;
    readings[k].height = water[k].height + origin.z();
    readings[k].normal = water[k].normal;
    readings[k].velocity = water[k].velocity;
    if (!current) continue;
    const Eigen::Vector3d& place = readings[k].position;  // the wave field makes no current at all
    readings[k].velocity += water[k].share * current->unresolved_velocity_at(place, time) +
                            (1.0 - water[k].share) * current->velocity_at(place, time);
  }
  return readings;
}

}  // namespace pelagos
