#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>

#include "rigid/mesh_query.hpp"
#include "rigid/triangle_mesh.hpp"
#include "test_meshes.hpp"
#include "waves/splitmix.hpp"

namespace pelagos {
namespace {

using test::make_box;
using test::make_sphere;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// A file in the temporary folder that goes with the test.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, const std::string& text)
      : path_(std::filesystem::temp_directory_path() / ("pelagos_" + std::to_string(getpid()) + "_" + name)) {
    std::ofstream(path_) << text;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  [[nodiscard]] std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

std::string obj_of(const TriangleMesh& mesh) {
  std::string text;
  for (const auto& v : mesh.vertices)
    text += "v " + std::to_string(v.x()) + " " + std::to_string(v.y()) + " " + std::to_string(v.z()) + "\n";
  for (const auto& t : mesh.triangles)
    text += "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " + std::to_string(t[2] + 1) + "\n";
  return text;
}

/// Every corner its own vertex, as in STL.
std::string stl_of(const TriangleMesh& mesh) {
  std::string text = "solid body\n";
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (std::size_t c = 0; c < 3; ++c) {
      const auto& v = mesh.corner(t, c);
      text += "vertex " + std::to_string(v.x()) + " " + std::to_string(v.y()) + " " + std::to_string(v.z()) + "\n";
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid body\n";
}

TEST(TriangleMesh, BoxAndSphereAreSoundAndHaveTheirVolumes) {
  const auto box = make_box({-1, -2, -3}, {2, 2, 0.5});
  EXPECT_THAT(find_mesh_faults(box), IsEmpty());
  EXPECT_NEAR(mesh_volume(box), 3 * 4 * 3.5, 1e-12);  // rounding
  EXPECT_NEAR(mesh_area(box), 2 * (12 + 14 + 10.5), 1e-12);
  const auto sphere = make_sphere(2.0, 40);
  EXPECT_THAT(find_mesh_faults(sphere), IsEmpty());
  EXPECT_NEAR(mesh_volume(sphere), 4.0 / 3 * std::numbers::pi * 8, 0.005 * 33.5);  // inscribed: (pi/40)^2 / 2 too small
}

TEST(TriangleMesh, NamesAnOpenEdge) {
  auto box = make_box({0, 0, 0}, {1, 1, 1});
  box.triangles.erase(box.triangles.begin() + 4);
  const auto faults = find_mesh_faults(box);
  ASSERT_THAT(faults, SizeIs(3));  // the hole has three edges
  EXPECT_THAT(faults, Contains(HasSubstr("open edge: only triangle")));
  EXPECT_THAT(faults, Contains(HasSubstr("(0, 0, 0) m")));
}

TEST(TriangleMesh, NamesAnInvertedTriangle) {
  auto box = make_box({0, 0, 0}, {1, 1, 1});
  std::swap(box.triangles[7][0], box.triangles[7][1]);
  EXPECT_THAT(find_mesh_faults(box), Contains(HasSubstr("inverted triangle: triangles")));
  EXPECT_THAT(find_mesh_faults(box), Contains(HasSubstr("8")));
}

TEST(TriangleMesh, NamesAShellInsideOut) {
  auto box = make_box({0, 0, 0}, {1, 1, 1});
  for (auto& triangle : box.triangles) std::swap(triangle[0], triangle[1]);
  EXPECT_THAT(find_mesh_faults(box), Contains(HasSubstr("facing inwards")));
}

TEST(TriangleMesh, NamesDegenerateAndAbsurdInput) {
  auto box = make_box({0, 0, 0}, {1, 1, 1});
  box.triangles.push_back({0, 1, 1});
  EXPECT_THAT(find_mesh_faults(box), Contains(HasSubstr("triangle 13")));
  box = make_box({0, 0, 0}, {1, 1, 1});
  box.vertices[5].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(find_mesh_faults(box), Contains(HasSubstr("vertex 6")));
  box = make_box({0, 0, 0}, {1, 1, 1});
  box.triangles[0][2] = 99;
  EXPECT_THAT(find_mesh_faults(box), SizeIs(1));
  EXPECT_THAT(find_mesh_faults({}), SizeIs(1));
}

TEST(MeshFile, ReadsObjAndStlAlike) {
  const auto sphere = make_sphere(1.5, 10);
  const TemporaryFile obj("sphere.obj", obj_of(sphere)), stl("sphere.stl", stl_of(sphere));
  for (const auto& path : {obj.path(), stl.path()}) {
    const MeshFile file = read_mesh(path, 2.0);
    ASSERT_THAT(file.faults, IsEmpty()) << file.faults.front();
    EXPECT_EQ(file.mesh.vertices.size(), sphere.vertices.size());
    EXPECT_EQ(file.mesh.triangles.size(), sphere.triangles.size());
    EXPECT_NEAR(mesh_volume(file.mesh), 8 * mesh_volume(sphere), 1e-4);  // six decimals in the file
  }
}

TEST(MeshFile, SaysWhatIsWrongWithTheFile) {
  EXPECT_THAT(read_mesh("/nowhere/hull.obj", 1.0).faults, Contains(HasSubstr("/nowhere/hull.obj")));
  const TemporaryFile garbage("garbage.obj", "v one two\nf 7 8 9\n\x01\x02");
  EXPECT_FALSE(read_mesh(garbage.path(), 1.0).faults.empty());
  const TemporaryFile empty("empty.stl", "");
  EXPECT_FALSE(read_mesh(empty.path(), 1.0).faults.empty());
  const TemporaryFile box("box.obj", obj_of(make_box({0, 0, 0}, {1, 1, 1})));
  EXPECT_THAT(read_mesh(box.path(), -1.0).faults, Contains(HasSubstr("scale")));
  EXPECT_THAT(read_mesh(box.path(), std::numeric_limits<double>::infinity()).faults, Contains(HasSubstr("scale")));
  EXPECT_THAT(read_mesh(box.path(), 1e9).faults, Contains(HasSubstr("1e6 m")));
}

TEST(MeshQuery, AgreesWithTheSphere) {
  const double radius = 2.0;
  const MeshQuery query(make_sphere(radius, 60));
  SplitMix64 random(3);
  for (int n = 0; n < 1000; ++n) {
    const Eigen::Vector3d point(5 * random.next_unit() - 2.5, 5 * random.next_unit() - 2.5,
                                5 * random.next_unit() - 2.5);
    const double depth = radius - point.norm();
    // the facets lie up to r (1 - cos(pi/60 * 0.71)) = 0.003 inside the sphere
    if (std::abs(depth) > 0.004) {
      EXPECT_EQ(query.inside(point), depth > 0) << point.transpose();
    }
    EXPECT_NEAR(query.distance(point, 100.0), std::abs(depth), 0.004);
    EXPECT_LE(query.distance(point, 0.1), 0.1);
  }
}

TEST(MeshQuery, InsideHoldsAtCornersAndEdgesOfTheLattice) {
  // Points whose rays along axes would run through edges and vertices.
  const MeshQuery query(make_box({-1, -1, -1}, {1, 1, 1}));
  for (int i = -4; i <= 4; ++i)
    for (int j = -4; j <= 4; ++j)
      for (int k = -4; k <= 4; ++k) {
        const Eigen::Vector3d point = 0.5 * Eigen::Vector3d(i, j, k);
        const double largest = point.cwiseAbs().maxCoeff();
        if (largest != 1.0) {
          EXPECT_EQ(query.inside(point), largest < 1.0) << point.transpose();
        }
      }
}

TEST(MeshQuery, RaysMeasureThickness) {
  const MeshQuery query(make_box({0, 0, 0}, {1, 2, 3}));
  EXPECT_NEAR(query.first_hit({0.3, 0.4, 0}, {0, 0, 1}, 1e-9), 3.0, 1e-12);
  EXPECT_NEAR(query.first_hit({-1, 0.4, 1}, {1, 0, 0}, 0), 1.0, 1e-12);
  EXPECT_TRUE(std::isinf(query.first_hit({-1, 0.4, 1}, {-1, 0, 0}, 0)));
}

}  // namespace
}  // namespace pelagos
