#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "oil/slick_element.hpp"
#include "values/slick.hpp"

namespace pelagos {

/// @param thickness  m; a value that is not finite or negative shows nothing
[[nodiscard]] OilAppearance appearance(double thickness);

/// The slick as a value, to be passed between threads.
struct SlickFrame {
  std::vector<SlickDisc> discs;  ///< in the order of the elements
};

[[nodiscard]] SlickFrame make_frame(std::span<const SlickElement> elements);

/// The slick in numbers. Percentiles are by area: half of the slick's area is thinner than the median.
struct SlickStatistics {
  double area = 0.0;            ///< m^2, covered by the union of the discs
  double volume = 0.0;          ///< m^3, oil and emulsion water
  double mean_thickness = 0.0;  ///< m, volume / area
  double median_thickness = 0.0, percentile_90 = 0.0, largest_thickness = 0.0;  ///< m, of the film at the elements
  double emulsion_water = 0.0;                                                  ///< m^3
  double mean_viscosity = 0.0;                                                  ///< m^2/s, mean by mass
};

/// Covered area of the discs, m^2: 32 points a disc, each worth its share of the disc divided by the number of discs
/// over it. Within 3 % for slicks of ten elements and more (0.1 % for a lone one).
[[nodiscard]] double covered_area(std::span<const SlickElement> elements);

}  // namespace pelagos
