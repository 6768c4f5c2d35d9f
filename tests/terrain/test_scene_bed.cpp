// Sea beds from files. The files are written with GDAL itself.

#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <ogr_spatialref.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>

#include "scene/read_scene.hpp"

namespace pelagos {
namespace {

using testing::HasSubstr;

constexpr double kLatitude = 38.86, kLongitude = 121.75;
constexpr double kNone = -9999.0;

/// m, world z: a mound of 3 m in the middle of a level bottom at -5 m, a little off the origin.
double mound(double x, double y) { return -5.0 + 3.0 * std::exp(-(std::pow(x - 4.0, 2) + y * y) / 64.0); }

class SceneBed : public testing::Test {
 protected:
  SceneBed() {
    std::string pattern = (std::filesystem::temp_directory_path() / "pelagos bed XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
    GDALAllRegister();
  }
  ~SceneBed() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::string file(const char* name) const { return (folder_ / name).string(); }

  /// An ESRI ASCII grid of 1 m around the origin. @param half  m, it reaches so far to all sides
  void write_ascii(const char* name, const std::function<double(double, double)>& height, int half = 42) const {
    std::ofstream out(file(name));
    out << "ncols " << 2 * half << "\nnrows " << 2 * half << "\nxllcorner " << -half << "\nyllcorner " << -half
        << "\ncellsize 1\nNODATA_value " << kNone << "\n";
    for (int row = 0; row < 2 * half; ++row)
      for (int column = 0; column < 2 * half; ++column)
        out << height(column - half + 0.5, half - row - 0.5) << (column + 1 < 2 * half ? ' ' : '\n');
  }

  /// A GeoTIFF in a coordinate reference system, its middle at the origin. @param cell  in the system's units
  void write_tiff(const char* name, int system, double cell, int bands = 1, const char* unit = "") const {
    constexpr int kCells = 120;
    OGRSpatialReference geographic, own;
    geographic.importFromEPSG(4326);
    own.importFromEPSG(system);
    geographic.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    own.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    double middle_x = kLongitude, middle_y = kLatitude;
    std::unique_ptr<OGRCoordinateTransformation>(OGRCreateCoordinateTransformation(&geographic, &own))
        ->Transform(1, &middle_x, &middle_y);
    const std::unique_ptr<GDALDataset> data(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
        file(name).c_str(), kCells, kCells, bands, GDT_Float32, nullptr));
    const double corner_x = middle_x - 0.5 * kCells * cell, corner_y = middle_y + 0.5 * kCells * cell;
    double place[6] = {corner_x, cell, 0.0, corner_y, 0.0, -cell};
    data->SetGeoTransform(place);
    data->SetSpatialRef(&own);
    const std::unique_ptr<OGRCoordinateTransformation> back(OGRCreateCoordinateTransformation(&own, &geographic));
    std::vector<float> row(kCells);
    for (int j = 0; j < kCells; ++j) {
      for (int i = 0; i < kCells; ++i) {
        double x = corner_x + (i + 0.5) * cell, y = corner_y - (j + 0.5) * cell;
        back->Transform(1, &x, &y);
        // Series of Snyder (1987) for the lengths of a degree, WGS84.
        const double phi = kLatitude * M_PI / 180.0;
        const double north = 111132.92 - 559.82 * std::cos(2 * phi) + 1.175 * std::cos(4 * phi);
        const double east = 111412.84 * std::cos(phi) - 93.5 * std::cos(3 * phi) + 0.118 * std::cos(5 * phi);
        row[static_cast<std::size_t>(i)] = static_cast<float>(mound(east * (x - kLongitude), north * (y - kLatitude)));
      }
      for (int band = 1; band <= bands; ++band)
        ASSERT_EQ(
            data->GetRasterBand(band)->RasterIO(GF_Write, 0, j, kCells, 1, row.data(), kCells, 1, GDT_Float32, 0, 0),
            CE_None);
    }
    data->GetRasterBand(1)->SetUnitType(unit);
  }

  /// A patch of 80 x 80 x 5 m over the bed. @param open_sea  beside the bed's file
  [[nodiscard]] SceneResult read(const std::string& name, const std::string& bed = "",
                                 const std::string& open_sea = "depth: 5") const {
    const std::string text =
        "name: \"bed\" particle_spacing: 1\n"
        "patch { min { x: -40 y: -40 z: -5 } max { x: 40 y: 40 z: 9 } }\n"
        "patch_edges { x: OPEN y: OPEN }\n"
        "water { block { min { x: -40 y: -40 z: -5 } max { x: 40 y: 40 z: 0 } } }\n"
        "origin { latitude_deg: 38.86 longitude_deg: 121.75 }\n"
        "open_sea { zone_width: 8 " +
        open_sea + " bed { file: \"" + name + "\" blend_width: 8 " + bed + " } }\n";
    return read_scene_text(text, file("bed.scene"));
  }

  void expect_fault(const SceneResult& result, const std::string& says) const {
    EXPECT_FALSE(result);
    EXPECT_THAT(result.report(), HasSubstr(says));
  }

  std::filesystem::path folder_;
};

/// m: an eighth of the curvatures along x and y, 2 * 3 / 64 each at the top, for nodes amid cells of 1 m.
constexpr double kBilinearError = 0.0235;

/// m, largest difference from the mound.
double error_of(const HeightGrid& grid, double offset = 0.0) {
  double worst = 0.0;
  for (std::size_t node = 0; node < grid.height.size(); ++node)
    worst = std::max(
        worst, std::abs(static_cast<double>(grid.height[node]) - offset - mound(grid.node_x(node), grid.node_y(node))));
  return worst;
}

TEST_F(SceneBed, OfAnAsciiGridHasTheWorldsCoordinates) {
  write_ascii("mound.asc", mound);
  const SceneResult result = read("mound.asc");
  ASSERT_TRUE(result) << result.report();
  const HeightGrid& grid = result.scene->open_sea.bed.heights;
  EXPECT_EQ(grid.columns, 81);
  EXPECT_EQ(grid.rows, 81);
  EXPECT_LT(error_of(grid), kBilinearError);
  EXPECT_EQ(result.scene->open_sea.bed.blend_width, 8.0);
}

TEST_F(SceneBed, TakesAnOffset) {
  write_ascii("mound.asc", [](double x, double y) { return mound(x, y) + 2.5; });
  const SceneResult result = read("mound.asc", "offset: -2.5");
  ASSERT_TRUE(result) << result.report();
  EXPECT_LT(error_of(result.scene->open_sea.bed.heights), kBilinearError);
}

TEST_F(SceneBed, OfAGeographicGeoTiffLiesAboutTheOrigin) {
  write_tiff("degrees.tif", 4326, 1e-5);  // cells of 0.9 x 1.1 m
  const SceneResult result = read("degrees.tif");
  ASSERT_TRUE(result) << result.report();
  EXPECT_LT(error_of(result.scene->open_sea.bed.heights), 0.03);
}

TEST_F(SceneBed, OfAGeoTiffInUtmLiesAboutTheOrigin) {
  write_tiff("utm.tif", 32651, 1.0);
  const SceneResult result = read("utm.tif");
  ASSERT_TRUE(result) << result.report();
  EXPECT_LT(error_of(result.scene->open_sea.bed.heights), 0.03);
}

TEST_F(SceneBed, WithHolesIsRefused) {
  write_ascii("hole.asc", [](double x, double y) { return std::hypot(x - 10.5, y - 3.5) < 0.1 ? kNone : mound(x, y); });
  expect_fault(read("hole.asc"),
               "open_sea.bed.file: has no height for 4 of 6561 places of the patch, the first at (10, 3); allowed: a "
               "height everywhere in the patch");
}

TEST_F(SceneBed, ThatDoesNotCoverThePatchIsRefused) {
  write_ascii("small.asc", mound, 30);
  expect_fault(read("small.asc"), "of 6561 places of the patch, the first at (-40, -40)");
  write_tiff("elsewhere.tif", 4326, 1e-6);
  expect_fault(read("elsewhere.tif"), "has no height for");
}

TEST_F(SceneBed, InOtherUnitsIsRefused) {
  write_tiff("feet.tif", 32651, 1.0, 1, "ft");
  expect_fault(read("feet.tif"), "\"feet.tif\" has heights in \"ft\"; allowed: metres");
}

TEST_F(SceneBed, OfAPictureIsRefused) {
  write_tiff("bands.tif", 32651, 1.0, 3);
  expect_fault(read("bands.tif"), "\"bands.tif\" has 3 bands; allowed: one, the heights");
  std::ofstream(file("words.asc")) << "no grid at all\n";
  expect_fault(read("words.asc"), "\"words.asc\" is no GeoTIFF or ESRI ASCII grid that can be read");
  expect_fault(read("nothing.asc"), "open_sea.bed.file: \"nothing.asc\" is not there; looked for");
}

TEST_F(SceneBed, OfWordsThatAreNoNumbersIsRefused) {
  for (const char* word : {"-5,5", "abc", "nan", "inf", "--5", "5m"}) {
    write_ascii("good.asc", mound);
    std::ifstream good(file("good.asc"));
    std::string text((std::istreambuf_iterator<char>(good)), {});
    const std::size_t at = text.rfind(' ');  // the last number
    std::ofstream(file("bad.asc")) << text.substr(0, at + 1) << word << "\n";
    expect_fault(read("bad.asc"), std::string("has \"") + word + "\" in line 90; allowed: decimal numbers");
  }
}

TEST_F(SceneBed, NearAnOpenEdgeIsNearlyLevel) {
  write_ascii("ridge.asc", [](double x, double) { return -5.0 + (x > -26.0 && x < -24.0 ? 2.0 : 0.0); });
  expect_fault(
      read("ridge.asc"),
      "open_sea.bed.file: is 2 m above the level bottom at (-25, -40), near an open edge; allowed: at most 1.6 m "
      "of difference, a fifth of blend_width, within 19 m of open edges");
}

TEST_F(SceneBed, LiesInTheWater) {
  write_ascii("pit.asc", [](double x, double y) { return mound(x, y) - (std::hypot(x, y) < 10 ? 6.0 : 0.0); });
  expect_fault(read("pit.asc"), "m below the lowest water at (");
}

TEST_F(SceneBed, NeedsADepthAndAPatchThatStays) {
  write_ascii("mound.asc", mound);
  expect_fault(read("mound.asc", "", ""), "open_sea.bed: needs open_sea.depth to be that of the block of water, 5 m");
  expect_fault(read("mound.asc", "", "depth: 5 follow { track { speed: 1 course_deg: 90 } }"),
               "open_sea.bed: lies in a patch that follows; allowed: without follow");
  expect_fault(read("mound.asc", "offset: 1e5"),
               "open_sea.bed.offset: 100000 is out of range; allowed: -12000 to 12000 m");
}

}  // namespace
}  // namespace pelagos
