#include "messages/sea_out.hpp"

namespace pelagos {

namespace {

proto::v1::WaveSystem::Spectrum spectrum_of(SpectrumKind spectrum) {
  switch (spectrum) {
    case SpectrumKind::kJonswap:
      return proto::v1::WaveSystem::JONSWAP;
    case SpectrumKind::kPiersonMoskowitz:
      return proto::v1::WaveSystem::PIERSON_MOSKOWITZ;
    case SpectrumKind::kTma:
      return proto::v1::WaveSystem::TMA;
    case SpectrumKind::kOchiHubble:
      return proto::v1::WaveSystem::OCHI_HUBBLE;
    case SpectrumKind::kRegular:
      return proto::v1::WaveSystem::REGULAR;
  }
  return proto::v1::WaveSystem::SPECTRUM_DEFAULT;
}

void write_period(const WaveSystem& system, proto::v1::WaveSystem& out) {
  switch (system.period_kind) {
    case PeriodKind::kPeak:
      out.set_peak_period(system.period);
      break;
    case PeriodKind::kZeroCrossing:
      out.set_zero_crossing_period(system.period);
      break;
    case PeriodKind::kMean:
      out.set_mean_period(system.period);
      break;
  }
}

void write_spreading(const WaveSystem& system, proto::v1::WaveSystem& out) {
  switch (system.spreading_kind) {
    case SpreadingKind::kByFrequency:
      out.set_spreading_at_peak(system.spreading);
      break;
    case SpreadingKind::kConstant:
      out.set_spreading(system.spreading);
      break;
    case SpreadingKind::kLongCrested:
      out.set_long_crested(true);
      break;
  }
}

}  // namespace

void write_wave_system(const WaveSystem& system, proto::v1::WaveSystem& out) {
  out.set_spectrum(spectrum_of(system.spectrum));
  if (system.douglas)
    out.set_douglas(*system.douglas);
  else if (system.beaufort)
    out.set_beaufort(*system.beaufort);
  else {
    out.set_height(system.height);
    write_period(system, out);
  }
  out.set_to_deg(system.to_deg);
  if (system.spectrum == SpectrumKind::kRegular) {
    out.set_phase_deg(system.phase_deg);
    return;
  }
  write_spreading(system, out);
  if (system.spectrum == SpectrumKind::kJonswap || system.spectrum == SpectrumKind::kTma) out.set_gamma(system.gamma);
  if (system.spectrum == SpectrumKind::kOchiHubble) out.set_shape(system.shape);
}

void write_wind_sea(const WindSeaSettings& sea, proto::v1::WindSea& out) {
  out.set_fetch(sea.fetch);
  if (sea.blown_for) out.set_blown_for(*sea.blown_for);
  out.set_pace(sea.pace);
}

}  // namespace pelagos
