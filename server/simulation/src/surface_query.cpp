#include "simulation/surface_query.hpp"

#include <vector>

namespace pelagos {

namespace {

SurfaceSource source_of(const SurfaceReading& reading) {
  if (!reading.wet) return SurfaceSource::kNoWater;
  if (reading.share == 0.0) return SurfaceSource::kWaveField;
  return reading.share == 1.0 ? SurfaceSource::kParticles : SurfaceSource::kBlended;
}

}  // namespace

SurfaceAnswer answer_query(const SeaAround& sea, const SurfaceQuery& query, std::span<const SurfaceReading> particles) {
  const PatchFrame& frame = sea.around.frame;
  std::vector<SurfacePlace> places(query.places.size());
  for (std::size_t k = 0; k < places.size(); ++k) places[k].local = frame.to_local(query.places[k]);
  SurfaceAnswer answer;
  answer.simulation_time = sea.time + query.ahead;
  std::vector<SurfaceReading> readings(places.size());
  if (query.ahead > 0.0) {
    read_waves(sea.around, sea.sea, answer.simulation_time, places, readings);
  } else {
    readings.assign(particles.begin(), particles.end());
    mix_with_waves(sea.around, sea.sea, sea.time, places, readings);
  }
  for (std::size_t k = 0; k < places.size(); ++k) {
    const SurfaceReading& reading = readings[k];
    SurfaceAtPlace& at = answer.places.emplace_back();
    at.source = source_of(reading);
    if (!reading.wet) continue;
    at.height = frame.world_height(reading.height);
    at.normal = reading.normal;
    at.velocity = reading.velocity;
    if (sea.current)
      at.velocity += missing_current(reading, *sea.current, {query.places[k].x(), query.places[k].y(), at.height},
                                     answer.simulation_time);
  }
  return answer;
}

}  // namespace pelagos
