#pragma once

#include <string>

#include "values/height_grid.hpp"

namespace pelagos {

/// What came of reading a file of heights.
struct HeightsRead {
  std::string fault;  ///< what is wrong with the file and what is allowed; empty: nothing
  /// Nodes for which the file holds no height; their heights are not finite.
  std::size_t holes = 0;
};

/// Reads heights at the nodes of `grid` from a GeoTIFF or an ESRI ASCII grid, bilinear between the file's cells, and
/// writes them into the grid. A file with a coordinate reference system is placed by the world's origin; one without
/// has the world's coordinates, m. Heights are metres, upwards.
///
/// GDAL does the reading. It is in a module beside the programs that is loaded on the first call: to load it takes
/// 0.2 s and 35 MB, which scenes without such a file do not pay.
/// @param latitude_deg, longitude_deg  of the world's origin, WGS84
[[nodiscard]] HeightsRead read_heights(const std::string& file, double latitude_deg, double longitude_deg,
                                       HeightGrid& grid);

}  // namespace pelagos
