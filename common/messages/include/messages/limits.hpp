#pragma once

#include <cstddef>

#include "messages/field_reader.hpp"
#include "values/oil_limits.hpp"

namespace pelagos {

/// What commands about wind, current, waves, oil and probes may hold: checked when they are read, and told by the help
/// of pelagos-ctl. They are those of the .proto files.
namespace limits {

inline constexpr double kStrongestWind = 75.0;     // m/s; the strongest sustained winds at sea stay below 100 m/s
inline constexpr double kStrongestCurrent = 10.0;  // m/s

inline constexpr Range kWindSpeed{0.0, kStrongestWind, "m/s"};
inline constexpr Range kBeaufort{0, 12, "Beaufort"};
inline constexpr Range kWindFrom{0.0, 360.0, "degrees clockwise from north, where the wind blows from"};
inline constexpr Range kGust{0.0, 30.0, "m/s"};
inline constexpr Range kGustLength{0.01, 10000.0, "m"};
inline constexpr Range kBeta{0.0, 100.0, "", "the paper uses 1.5"};
inline constexpr Range kRoughness{1e-6, 5.0, "m", "z0 of the log profile"};
inline constexpr Range kRamp{0.0, 3600.0, "s"};

inline constexpr Range kCurrentSpeed{0.0, kStrongestCurrent, "m/s"};
inline constexpr Range kCurrentTo{0.0, 360.0, "degrees clockwise from north, where the current sets towards"};
inline constexpr Range kCurrentDepth{0.01, 11e3, "m"};  // down to the deepest trench
inline constexpr Range kRelaxation{0.5, 3600.0, "s"};

inline constexpr Range kWaveAmplitude{1e-3, 15.0, "m"};
inline constexpr Range kWaveLength{0.1, 10000.0, "m"};
inline constexpr Range kWavePeriod{0.25, 80.0, "s"};  // in deep water waves of 0.1 to 10,000 m
inline constexpr Range kWaveTo{0.0, 360.0, "degrees clockwise from north, where the wave runs to"};
inline constexpr Range kWavePhase{-360.0, 360.0, "degrees"};
inline constexpr Range kSeaHeight{0.01, 30.0, "m"};  // up to kHighestSea
inline constexpr Range kSeaPeriod{0.5, 40.0, "s"};
inline constexpr Range kSpreading{1.0, 1000.0, "", "s of cos^2s(theta / 2)"};
inline constexpr Range kGamma{1.0, 10.0};
inline constexpr Range kShape{0.5, 20.0, "", "lambda of Ochi and Hubble"};
inline constexpr Range kDouglas{0, 9, "degrees of the Douglas scale"};
inline constexpr Range kFetch{1e3, 2e6, "m"};
inline constexpr Range kBlownFor{0.0, 1e6, "s"};
inline constexpr Range kPaceOfSea{0.1, 100.0};
inline constexpr Range kSeaComponents{1, 512};
inline constexpr Range kBlend{0.0, 3600.0, "s"};

inline constexpr std::size_t kLongestName = 64;
inline constexpr Range kReleaseRate{1e-3, 1e6, "m^3/h"};
inline constexpr Range kReleaseDuration{0.1, 1e7, "s"};
inline constexpr Range kSpillVolume{1e-6, 1e6, "m^3"};
inline constexpr Range kSpillRadius{1e-3, 1e4, "m"};
inline constexpr Range kBoomDraft{0.01, 20.0, "m"};
inline constexpr Range kCriticalSpeed{0.01, 10.0, "m/s"};
inline constexpr std::size_t kFewestPoints = 2, kMostPoints = kMostPointsPerBoom;  // of a boom
inline constexpr Range kSkimmerRadius{0.01, 1000.0, "m"};
inline constexpr Range kSkimmerRate{0.0, 1e5, "m^3/h"};

}  // namespace limits

}  // namespace pelagos
