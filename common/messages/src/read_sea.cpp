#include "messages/read_sea.hpp"

#include <string>

#include "messages/limits.hpp"
#include "values/sea_request.hpp"
#include "waves.pb.h"
#include "waves/sea_state.hpp"

namespace pelagos {

namespace {

SpectrumKind read_spectrum(const FieldReader& reader, bool by_scale) {
  switch (reader.read_enum("spectrum")) {
    case proto::v1::WaveSystem::JONSWAP:
      return SpectrumKind::kJonswap;
    case proto::v1::WaveSystem::PIERSON_MOSKOWITZ:
      return SpectrumKind::kPiersonMoskowitz;
    case proto::v1::WaveSystem::TMA:
      return SpectrumKind::kTma;
    case proto::v1::WaveSystem::OCHI_HUBBLE:
      return SpectrumKind::kOchiHubble;
    case proto::v1::WaveSystem::REGULAR:
      return SpectrumKind::kRegular;
    default:
      return by_scale ? SpectrumKind::kPiersonMoskowitz : SpectrumKind::kJonswap;
  }
}

/// Notes a fault for each of the fields that is given beside an earlier one. @return the first one; empty if there is
/// none
std::string only_one(const FieldReader& reader, std::initializer_list<const char*> fields) {
  std::string first;
  for (const char* field : fields) {
    if (!reader.has(field)) continue;
    if (first.empty())
      first = field;
    else
      reader.fault(field, "is given beside " + first + "; allowed: one of them");
  }
  return first;
}

/// A fully developed sea by a scale: nothing else says its height, period or form.
void read_scale(const FieldReader& reader, const std::string& scale, WaveSystem& system) {
  int number = 0;
  if (scale == "douglas" && reader.read("douglas", limits::kDouglas, number)) {
    system.douglas = number;
    system.height = douglas_wave_height(number);
  }
  if (scale == "beaufort" && reader.read("beaufort", limits::kBeaufort, number)) {
    system.beaufort = number;
    system.height = significant_wave_height(number);
  }
  for (const char* field : {"peak_period", "zero_crossing_period", "mean_period"})
    if (reader.has(field))
      reader.fault(field, "is given beside " + scale + ", a fully developed sea; allowed: with a height");
  if (system.spectrum != SpectrumKind::kPiersonMoskowitz)
    reader.fault("spectrum", "is given beside " + scale +
                                 ", a fully developed sea; allowed: PIERSON_MOSKOWITZ, or a "
                                 "height in place of " +
                                 scale);
}

void read_height_and_period(const FieldReader& reader, WaveSystem& system) {
  reader.read("height", limits::kSeaHeight, system.height);
  const std::string period = only_one(reader, {"peak_period", "zero_crossing_period", "mean_period"});
  if (period.empty()) reader.fault("peak_period", "is missing; required: it, zero_crossing_period or mean_period");
  if (period == "zero_crossing_period") system.period_kind = PeriodKind::kZeroCrossing;
  if (period == "mean_period") system.period_kind = PeriodKind::kMean;
  if (!period.empty()) reader.read(period.c_str(), limits::kSeaPeriod, system.period);
}

void read_spreading(const FieldReader& reader, WaveSystem& system) {
  const std::string given = only_one(reader, {"spreading", "spreading_at_peak", "long_crested"});
  if (given == "spreading") system.spreading_kind = SpreadingKind::kConstant;
  bool long_crested = false;
  reader.read("long_crested", long_crested);
  if (given == "long_crested" && long_crested) system.spreading_kind = SpreadingKind::kLongCrested;
  if (given == "spreading" || given == "spreading_at_peak")
    reader.read(given.c_str(), limits::kSpreading, system.spreading);
}

/// Parameters that only some spectra have.
void read_form(const FieldReader& reader, WaveSystem& system) {
  const bool peaked = system.spectrum == SpectrumKind::kJonswap || system.spectrum == SpectrumKind::kTma;
  const bool regular = system.spectrum == SpectrumKind::kRegular;
  reader.read("gamma", limits::kGamma, system.gamma);
  reader.read("shape", limits::kShape, system.shape);
  reader.read("phase_deg", limits::kWavePhase, system.phase_deg);
  if (!peaked && reader.has("gamma")) reader.fault("gamma", "is of other spectra; allowed: with JONSWAP and TMA");
  if (!regular && reader.has("phase_deg"))
    reader.fault("phase_deg", "is of one wave; allowed: with REGULAR, and the seed says it of others");
  if (system.spectrum == SpectrumKind::kOchiHubble)
    reader.require("shape");
  else if (reader.has("shape"))
    reader.fault("shape", "is of another spectrum; allowed: with OCHI_HUBBLE");
  for (const char* field : {"spreading", "spreading_at_peak", "long_crested"})
    if (regular && reader.has(field)) reader.fault(field, "is of many waves, not of a REGULAR one; allowed: none");
}

WaveSystem read_system(const FieldReader& reader) {
  WaveSystem system;
  const std::string height = only_one(reader, {"height", "douglas", "beaufort"});
  const bool by_scale = height == "douglas" || height == "beaufort";
  system.spectrum = read_spectrum(reader, by_scale);
  if (height.empty()) reader.fault("height", "is missing; required: it, douglas or beaufort");
  if (by_scale)
    read_scale(reader, height, system);
  else
    read_height_and_period(reader, system);
  reader.require("to_deg");
  reader.read("to_deg", limits::kWaveTo, system.to_deg);
  read_spreading(reader, system);
  read_form(reader, system);
  return system;
}

WindSeaSettings read_wind_sea(const FieldReader& reader) {
  WindSeaSettings sea;
  reader.read("fetch", limits::kFetch, sea.fetch);
  double blown_for = 0.0;
  if (reader.read("blown_for", limits::kBlownFor, blown_for)) sea.blown_for = blown_for;
  reader.read("pace", limits::kPaceOfSea, sea.pace);
  return sea;
}

}  // namespace

SeaSettings read_sea(const FieldReader& reader) {
  SeaSettings sea;
  const std::vector<FieldReader> entries = reader.children("system");
  if (entries.size() > kMostWaveSystems)
    reader.fault("system", "has " + format_count(static_cast<double>(entries.size())) + " entries; allowed: at most " +
                               format_count(kMostWaveSystems));
  else
    for (const FieldReader& entry : entries) sea.systems.push_back(read_system(entry));
  reader.read("components", limits::kSeaComponents, sea.components);
  std::uint64_t seed = 0;
  if (reader.read("seed", seed)) sea.seed = seed;
  reader.read("shortest_length", limits::kWaveLength, sea.shortest_length);
  if (reader.has("wind_sea")) sea.wind_sea = read_wind_sea(reader.child("wind_sea"));
  return sea;
}

}  // namespace pelagos
