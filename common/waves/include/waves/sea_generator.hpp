#pragma once

#include <cstdint>
#include <vector>

#include "scales/scales.hpp"
#include "waves/dispersion.hpp"
#include "waves/wave_components.hpp"
#include "waves/wave_system.hpp"

namespace pelagos {

/// Where a sea is made.
struct SeaPlace {
  double gravity = kStandardGravity;  ///< m/s^2, > 0
  double depth = kInfiniteDepth;      ///< m, > 0
  std::uint64_t seed = 1;             ///< where the sea has none
};

/// Components of a sea.
struct SeaComponents {
  std::vector<WaveComponent> waves;  ///< system after system, each from long to short
  double left_out = 0.0;             ///< m^2: the variance of waves shorter than the shortest length
  double variance = 0.0;             ///< m^2: of the request, what was left out included
};

/// How many components each system gets: a regular wave one, a flat system none, the others equal shares of the rest,
/// the first ones one more where it does not divide. None of them gets less than one.
[[nodiscard]] std::vector<std::uint32_t> share_components(const SeaSettings& sea);

/// Makes the components of a sea. Of each system, whatever the seed and the number of components:
/// - The variance is Hs^2 / 16 (less what is left out), for the energy of each band of frequencies is its integral.
/// - The mean direction by energy is `to_deg`: directions are evenly spaced quantiles of the spreading, dealt out in
///   the order of a golden-ratio sequence, so that neighbours in frequency are far apart in direction and there is no
///   trend, and all turned by one angle at last.
/// - The mean period is that of the spectrum: frequencies are drawn in the middle half of their bands by the seed, and
///   all multiplied by one factor at last. It is Tm02 where the zero-crossing period is given, else Tm01.
/// With a shortest length the bands end there, so that all components are used; the energy beyond is told.
/// @param sea  that find_sea_refusal (values/sea_request.hpp) takes
[[nodiscard]] SeaComponents make_sea_components(const SeaSettings& sea, const SeaPlace& place = {});

}  // namespace pelagos
