#include "messages/read_waves.hpp"

#include "messages/limits.hpp"

namespace pelagos {

namespace {

WaveSettings read_wave(const FieldReader& reader) {
  WaveSettings wave;
  for (const char* field : {"amplitude", "to_deg"}) reader.require(field);
  reader.read("amplitude", limits::kWaveAmplitude, wave.amplitude);
  if (reader.has("length") && reader.has("period"))
    reader.fault("period", "is given beside the length; allowed: one of them");
  if (!reader.has("length") && !reader.has("period")) reader.fault("length", "is missing; required: it or the period");
  reader.read("length", limits::kWaveLength, wave.length);
  reader.read("period", limits::kWavePeriod, wave.period);
  reader.read("to_deg", limits::kWaveTo, wave.to_deg);
  reader.read("phase_deg", limits::kWavePhase, wave.phase_deg);
  return wave;
}

}  // namespace

std::vector<WaveSettings> read_waves(const FieldReader& reader) {
  std::vector<WaveSettings> waves;
  const std::vector<FieldReader> entries = reader.children("wave");
  if (entries.size() > kMostWaves) {
    reader.fault("wave", "has " + format_count(static_cast<double>(entries.size())) + " entries; allowed: at most " +
                             format_count(kMostWaves));
    return waves;
  }
  for (const FieldReader& entry : entries) waves.push_back(read_wave(entry));
  return waves;
}

}  // namespace pelagos
