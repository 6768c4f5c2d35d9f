#include "values/sea_request.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "values/wave_settings.hpp"
#include "waves/sea_generator.hpp"
#include "waves/sea_state.hpp"
#include "waves/wave_spectrum.hpp"

namespace pelagos {

namespace {

using Fault = std::optional<Refusal>;

bool is_regular(const WaveSystem& system) { return system.spectrum == SpectrumKind::kRegular; }

/// m, of a deep-water wave.
double wave_length(double period, double gravity) { return gravity * period * period / (2.0 * std::numbers::pi); }

/// m, for the height of a system with waves so long.
double highest_of(const WaveSystem& system, double length) {
  return (is_regular(system) ? kHighestSlenderness : kSteepestSea) * length;
}

Fault find_too_steep(const SeaSettings& sea, double gravity) {
  double squares = 0.0;  // of each system's part of what is allowed
  for (std::size_t i = 0; i < sea.systems.size(); ++i) {
    const WaveSystem& system = sea.systems[i];
    if (!(system.height > 0.0)) continue;
    const double period = peak_period(system, kInfiniteDepth, gravity), length = wave_length(period, gravity);
    const double highest = highest_of(system, length);
    if (system.height > highest)
      return Refusal{fmt::format("system[{}].height", i),
                     fmt::format("{:g} m is too steep for a {} period of {:.4g} s, a wave of {:.4g} m; allowed: at "
                                 "most {:.4g} m, {} of that length",
                                 system.height, is_regular(system) ? "wave" : "peak", period, length, highest,
                                 is_regular(system) ? "0.1412" : "1/15")};
    squares += std::pow(system.height / highest, 2.0);
  }
  if (squares <= 1.0) return {};
  return Refusal{"system",
                 fmt::format("the systems together are {:.3g} times as steep as a sea can be (root of the sum "
                             "of the squares of each one's part of its allowed height); allowed: at most 1",
                             std::sqrt(squares))};
}

Fault find_too_high(const SeaSettings& sea) {
  double variance = 0.0;
  for (const WaveSystem& system : sea.systems)
    variance += system.height * system.height / (is_regular(system) ? 8.0 : 16.0);
  const double height = 4.0 * std::sqrt(variance);
  if (height <= kHighestSea) return {};
  return Refusal{"system", fmt::format("the systems together have a significant height of {:.3g} m; allowed: at most "
                                       "{:g} m",
                                       height, kHighestSea)};
}

Fault find_too_few_components(const SeaSettings& sea) {
  std::size_t needed = 0;
  for (const WaveSystem& system : sea.systems) needed += system.height > 0.0 ? 1 : 0;
  needed += sea.wind_sea ? 1 : 0;
  if (sea.components >= needed) return {};
  return Refusal{"components", fmt::format("{} are too few for {} systems; allowed: {} to {}", sea.components, needed,
                                           needed, kMostWaves)};
}

Fault find_all_too_short(const SeaSettings& sea, double gravity) {
  if (!(sea.shortest_length > 0.0)) return {};
  const SeaComponents made = make_sea_components(sea, {gravity, kInfiniteDepth, 1});
  if (!made.waves.empty() || !(made.variance > 0.0)) return {};
  return Refusal{"shortest_length", fmt::format("all waves of the sea are shorter than {:g} m; allowed: a length that "
                                                "leaves some of them",
                                                sea.shortest_length)};
}

const char* name_of(SpectrumKind spectrum) {
  switch (spectrum) {
    case SpectrumKind::kPiersonMoskowitz:
      return "Pierson-Moskowitz";
    case SpectrumKind::kTma:
      return "TMA";
    case SpectrumKind::kOchiHubble:
      return "Ochi-Hubble";
    case SpectrumKind::kRegular:
      return "regular wave";
    case SpectrumKind::kJonswap:
      break;
  }
  return "JONSWAP";
}

const char* name_of(PeriodKind period) {
  switch (period) {
    case PeriodKind::kZeroCrossing:
      return "Tz";
    case PeriodKind::kMean:
      return "Tm";
    case PeriodKind::kPeak:
      break;
  }
  return "Tp";
}

bool is_swell(const WaveSystem& system) {
  if (!(system.period > 0.0) || !(system.height > 0.0)) return false;
  const double developed = 2.0 * std::numbers::pi / peak_frequency(system.height, kStandardGravity);
  return peak_period(system, kInfiniteDepth, kStandardGravity) > 1.2 * developed;
}

std::string describe_spreading(const WaveSystem& system) {
  switch (system.spreading_kind) {
    case SpreadingKind::kLongCrested:
      return ", long-crested";
    case SpreadingKind::kConstant:
      return fmt::format(", spreading {:g}", system.spreading);
    case SpreadingKind::kByFrequency:
      break;
  }
  return fmt::format(", spreading {:g} at the peak", system.spreading);
}

std::string describe_scale(const WaveSystem& system) {
  if (system.beaufort) return fmt::format(" of Beaufort {}", *system.beaufort);
  if (system.douglas) return fmt::format(" of Douglas degree {}", *system.douglas);
  return "";
}

}  // namespace

std::optional<Refusal> find_sea_refusal(const SeaSettings& sea, double gravity) {
  if (auto fault = find_too_few_components(sea)) return fault;
  if (auto fault = find_too_steep(sea, gravity)) return fault;
  if (auto fault = find_too_high(sea)) return fault;
  return find_all_too_short(sea, gravity);
}

std::string describe_system(const WaveSystem& system) {
  if (!(system.height > 0.0)) return "flat sea" + describe_scale(system);
  if (is_regular(system))
    return fmt::format("regular wave of {:g} m, {:g} s, to {:03.0f} deg", system.height, system.period, system.to_deg);
  std::string text = is_swell(system) ? "swell " : "wind sea ";
  text += name_of(system.spectrum) + describe_scale(system) + fmt::format(", Hs {:.4g} m", system.height);
  text += system.period > 0.0 ? fmt::format(", {} {:.4g} s", name_of(system.period_kind), system.period)
                              : std::string(", fully developed");
  text += fmt::format(", to {:03.0f} deg", system.to_deg);
  if (system.spectrum == SpectrumKind::kJonswap || system.spectrum == SpectrumKind::kTma)
    text += fmt::format(", gamma {:.3g}", system.gamma);
  if (system.spectrum == SpectrumKind::kOchiHubble) text += fmt::format(", shape {:g}", system.shape);
  return text + describe_spreading(system);
}

std::string describe_sea(const SeaSettings& sea) {
  std::string text;
  for (const WaveSystem& system : sea.systems) text += (text.empty() ? "" : "; ") + describe_system(system);
  if (sea.shortest_length > 0.0) text += fmt::format("; without waves under {:g} m", sea.shortest_length);
  if (sea.wind_sea)
    text += fmt::format(
        "{}with the wind over a fetch of {:g} km{}", text.empty() ? "a sea that grows " : "; it grows ",
        1e-3 * sea.wind_sea->fetch,
        sea.wind_sea->pace == 1.0 ? "" : fmt::format(", {:g} times as fast as in nature", sea.wind_sea->pace));
  return text;
}

}  // namespace pelagos
