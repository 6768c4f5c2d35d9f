#include "simulation/probes.hpp"

namespace pelagos {

std::vector<ProbeReading> Probes::read(const FluidState& fluid, WaterSurface& surface, const WaveField& sea,
                                       const Bodies& bodies, const PatchFrame& frame,
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
    place.local = frame.to_local(reading.position).head<2>();
    if (!probe.at_surface) place.height = frame.local_height(reading.position.z());
  }
  const std::vector<SurfaceReading> water = surface.read(fluid, sea, time, places);
  for (std::size_t k = 0; k < readings.size(); ++k) {
    readings[k].wet = water[k].wet;
    if (!water[k].wet) continue;
    readings[k].height = frame.world_height(water[k].height);
    readings[k].normal = water[k].normal;
    readings[k].velocity = water[k].velocity;
    if (current) readings[k].velocity += missing_current(water[k], *current, readings[k].position, time);
  }
  return readings;
}

}  // namespace pelagos
