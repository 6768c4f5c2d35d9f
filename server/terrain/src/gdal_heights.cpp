// The module that reads heights with GDAL.

#include <cpl_conv.h>
#include <cpl_error.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "terrain_module.hpp"

namespace {

constexpr double kMostCells = 64e6;  // of the file, within the area that is asked for: 512 MB
constexpr int kMostHeaderLines = 8;  // of an ESRI ASCII grid
constexpr double kMargin = 2.0;      // cells read around that area

using Places = std::vector<double>;

/// Columns and rows of a file, counted from the centre of its first cell.
struct CellPlaces {
  Places column, row;
};

/// A part of the file's cells.
struct Window {
  int column = 0, row = 0, columns = 0, rows = 0;
  std::vector<double> height;  // not a number where there is none

  [[nodiscard]] double at(int i, int j) const {
    i = std::clamp(i - column, 0, columns - 1);
    j = std::clamp(j - row, 0, rows - 1);
    return height[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(i)];
  }
};

std::string last_error() {
  const std::string text = CPLGetLastErrorMsg();
  return text.empty() ? "" : ": " + text;
}

/// From the world's plane to the file's coordinates. Distances and directions from the origin are kept (azimuthal
/// equidistant); within 10 km that differs from the tangent plane by less than 1 cm.
std::string to_file_coordinates(const PelagosHeightRequest& request, const OGRSpatialReference& file, Places& x,
                                Places& y) {
  OGRSpatialReference world;
  char plane[160];
  std::snprintf(plane, sizeof plane, "+proj=aeqd +datum=WGS84 +units=m +lat_0=%.12f +lon_0=%.12f", request.latitude_deg,
                request.longitude_deg);
  if (world.importFromProj4(plane) != OGRERR_NONE) return "cannot be placed at the scene's origin" + last_error();
  OGRSpatialReference target(file);
  target.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  world.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const std::unique_ptr<OGRCoordinateTransformation> way(OGRCreateCoordinateTransformation(&world, &target));
  if (!way || way->Transform(static_cast<int>(x.size()), x.data(), y.data()) == 0)
    return "has a coordinate reference system into which the scene's origin cannot be converted" + last_error();
  return "";
}

std::string find_cells(GDALDataset& data, const PelagosHeightRequest& request, CellPlaces& places) {
  Places x(request.x, request.x + request.count), y(request.y, request.y + request.count);
  const OGRSpatialReference* system = data.GetSpatialRef();
  if (system != nullptr && !system->IsEmpty() && (system->IsGeographic() || system->IsProjected()))
    if (std::string fault = to_file_coordinates(request, *system, x, y); !fault.empty()) return fault;
  double forward[6], back[6];
  if (data.GetGeoTransform(forward) != CE_None || GDALInvGeoTransform(forward, back) == 0)
    return "does not say where its cells lie; allowed: a GeoTIFF or ESRI ASCII grid with its place";
  for (std::size_t k = 0; k < x.size(); ++k) {
    places.column.push_back(back[0] + back[1] * x[k] + back[2] * y[k] - 0.5);
    places.row.push_back(back[3] + back[4] * x[k] + back[5] * y[k] - 0.5);
  }
  return "";
}

/// The cells that all places need.
std::string frame_window(GDALDataset& data, const CellPlaces& places, Window& window) {
  const auto limits = [](const Places& at, int most, int& first, int& count) {
    const auto [low, high] = std::minmax_element(at.begin(), at.end());
    const double begin = std::clamp(std::floor(*low) - kMargin, 0.0, most - 1.0);
    const double end = std::clamp(std::ceil(*high) + kMargin, 0.0, most - 1.0);
    first = static_cast<int>(begin);
    count = static_cast<int>(end - begin) + 1;
  };
  limits(places.column, data.GetRasterXSize(), window.column, window.columns);
  limits(places.row, data.GetRasterYSize(), window.row, window.rows);
  if (static_cast<double>(window.columns) * window.rows <= kMostCells) return "";
  return "has " + std::to_string(window.columns) + " x " + std::to_string(window.rows) +
         " cells in the patch; allowed: 64,000,000";
}

std::string read_window(GDALRasterBand& band, Window& window) {
  window.height.resize(static_cast<std::size_t>(window.columns) * static_cast<std::size_t>(window.rows));
  if (band.RasterIO(GF_Read, window.column, window.row, window.columns, window.rows, window.height.data(),
                    window.columns, window.rows, GDT_Float64, 0, 0) != CE_None)
    return "cannot be read" + last_error();
  int has_none = 0, has_scale = 0, has_offset = 0;
  const double none = band.GetNoDataValue(&has_none), scale = band.GetScale(&has_scale),
               offset = band.GetOffset(&has_offset);
  for (double& height : window.height) {
    if (has_none != 0 && height == none) height = std::numeric_limits<double>::quiet_NaN();
    if (has_scale != 0) height *= scale;
    if (has_offset != 0) height += offset;
  }
  return "";
}

/// Bilinear between the centres of cells; not a number beyond the file's cells and where a cell has no height.
double height_at(const GDALDataset& data, const Window& window, double column, double row) {
  auto& raster = const_cast<GDALDataset&>(data);
  const bool inside =
      column >= -0.5 && row >= -0.5 && column <= raster.GetRasterXSize() - 0.5 && row <= raster.GetRasterYSize() - 0.5;
  if (!inside) return std::numeric_limits<double>::quiet_NaN();
  const auto i = static_cast<int>(std::floor(column)), j = static_cast<int>(std::floor(row));
  const double a = column - i, b = row - j;
  double sum = 0.0;
  const auto take = [&](int right, int down, double weight) {
    if (weight > 0.0) sum += weight * window.at(i + right, j + down);
  };
  take(0, 0, (1.0 - a) * (1.0 - b));
  take(1, 0, a * (1.0 - b));
  take(0, 1, (1.0 - a) * b);
  take(1, 1, a * b);
  return sum;
}

/// Heights in other units than metres would be taken for metres.
std::string check_unit(GDALRasterBand& band) {
  std::string unit = band.GetUnitType();
  std::transform(unit.begin(), unit.end(), unit.begin(), [](unsigned char c) { return std::tolower(c); });
  if (unit.empty() || unit == "m" || unit == "metre" || unit == "meter" || unit == "metres" || unit == "meters")
    return "";
  return "has heights in \"" + unit + "\"; allowed: metres";
}

/// GDAL takes a word of an ASCII grid that is no number for 0, and "-6,5" for -6.
std::string check_ascii_numbers(const char* file) {
  std::ifstream in(file);
  std::string line, word;
  for (int number = 1; std::getline(in, line); ++number) {
    std::istringstream words(line);
    bool first = true;
    while (words >> word) {
      double value = 0.0;
      const char* begin = word.data() + (word[0] == '+' ? 1 : 0);
      const auto [end, error] = std::from_chars(begin, word.data() + word.size(), value);
      const bool decimal = error == std::errc() && end == word.data() + word.size() && std::isfinite(value);
      const bool name = first && std::isalpha(static_cast<unsigned char>(word[0])) && number <= kMostHeaderLines;
      if (!decimal && !name)
        return "has \"" + word.substr(0, 40) + "\" in line " + std::to_string(number) +
               "; allowed: decimal numbers with a point, and the NODATA_value where there is no height";
      first = false;
    }
  }
  return "";
}

std::string read(const PelagosHeightRequest& request) {
  GDALAllRegister();
  const char* drivers[] = {"GTiff", "AAIGrid", nullptr};
  const std::unique_ptr<GDALDataset> data(GDALDataset::Open(request.file, GDAL_OF_RASTER | GDAL_OF_READONLY, drivers));
  if (!data) return "is no GeoTIFF or ESRI ASCII grid that can be read" + last_error();
  if (std::string_view(data->GetDriver()->GetDescription()) == "AAIGrid")
    if (std::string fault = check_ascii_numbers(request.file); !fault.empty()) return fault;
  if (data->GetRasterCount() != 1)
    return "has " + std::to_string(data->GetRasterCount()) + " bands; allowed: one, the heights";
  GDALRasterBand& band = *data->GetRasterBand(1);
  CellPlaces places;
  Window window;
  if (std::string fault = check_unit(band); !fault.empty()) return fault;
  if (std::string fault = find_cells(*data, request, places); !fault.empty()) return fault;
  if (std::string fault = frame_window(*data, places, window); !fault.empty()) return fault;
  if (std::string fault = read_window(band, window); !fault.empty()) return fault;
  for (std::size_t k = 0; k < request.count; ++k)
    request.height[k] = static_cast<float>(height_at(*data, window, places.column[k], places.row[k]));
  return "";
}

}  // namespace

extern "C" __attribute__((visibility("default"))) void pelagos_read_heights(const PelagosHeightRequest* request) {
  CPLPushErrorHandler(CPLQuietErrorHandler);
  CPLErrorReset();
  std::string fault;
  try {
    fault = read(*request);
  } catch (const std::exception& error) {
    fault = std::string("cannot be read: ") + error.what();
  }
  CPLPopErrorHandler();
  std::snprintf(request->fault, request->room, "%s", fault.c_str());
}
