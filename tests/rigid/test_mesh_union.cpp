#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "../support/refusal_matcher.hpp"
#include "rigid/hydrostatics.hpp"
#include "rigid/mass_properties.hpp"
#include "rigid/mesh_query.hpp"
#include "rigid/mesh_union.hpp"
#include "shapes/primitive.hpp"
#include "test_meshes.hpp"
#include "waves/splitmix.hpp"

namespace pelagos {
namespace {

using test::joined;
using test::make_box;
using test::make_sphere;
using test::Says;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

TriangleMesh reversed(TriangleMesh mesh) {
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

TriangleMesh turned(TriangleMesh mesh, const Eigen::AngleAxisd& turn, const Eigen::Vector3d& shift = {0, 0, 0}) {
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex = turn * vertex + shift;
  return mesh;
}

/// A solid put together from boxes that do not overlap; a negative one takes away.
struct Brick {
  Eigen::Vector3d low, high;
  double sign = 1.0;
};

MassProperties solid_of(const std::vector<Brick>& bricks) {
  MassProperties all;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (const Brick& brick : bricks) {
    const Eigen::Vector3d size = brick.high - brick.low, centre = 0.5 * (brick.low + brick.high);
    const double volume = brick.sign * size.prod();
    all.volume += volume;
    moment += volume * centre;
    second +=
        volume * (centre * centre.transpose() + Eigen::Matrix3d((size.array().square() / 12.0).matrix().asDiagonal()));
  }
  all.centre = moment / all.volume;
  second -= all.volume * all.centre * all.centre.transpose();
  all.inertia = second.trace() * Eigen::Matrix3d::Identity() - second;
  return all;
}

/// The union must be the solid of the bricks, also turned, and in water that stands level or heeled, where the bricks
/// are cut by themselves.
void expect_union(const TriangleMesh& parts, const std::vector<Brick>& bricks) {
  EXPECT_THAT(find_mesh_faults(parts), IsEmpty());
  for (const double angle : {0.0, 0.7}) {
    const Eigen::AngleAxisd turn(angle, Eigen::Vector3d(1, 2, -0.5).normalized());
    const MeshUnion united = unite_parts(turned(parts, turn));
    ASSERT_THAT(united.faults, IsEmpty());
    const MassProperties expected = solid_of(bricks), solid = mass_properties(united.mesh);
    const double exact = 1e-8 * expected.volume;  // corners of pieces nearer than 1e-9 of the size are merged
    EXPECT_NEAR(solid.volume, expected.volume, exact) << "turned by " << angle;
    EXPECT_LT((turn.inverse() * solid.centre - expected.centre).norm(), 1e-8);
    EXPECT_LT((turn.inverse() * solid.inertia * turn.toRotationMatrix() - expected.inertia).norm(),
              1e-7 * expected.inertia.norm());
    for (const Eigen::Vector3d& up : {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0.3, -0.4, 1).normalized()}) {
      const WaterPlane water{turn * up, 0.13};
      Hydrostatics sum;
      for (const Brick& brick : bricks) {
        const Hydrostatics one = hydrostatics(turned(make_box(brick.low, brick.high), turn), water);
        sum.volume += brick.sign * one.volume;
        sum.centre_of_buoyancy += brick.sign * one.volume * one.centre_of_buoyancy;
        sum.waterplane_area += brick.sign * one.waterplane_area;
      }
      const Hydrostatics wet = hydrostatics(united.mesh, water);
      EXPECT_NEAR(wet.volume, sum.volume, exact);
      EXPECT_LT((wet.volume * wet.centre_of_buoyancy - sum.centre_of_buoyancy).norm(), 1e-7);
      EXPECT_NEAR(wet.waterplane_area, sum.waterplane_area, 1e-7);
    }
  }
}

TEST(MeshUnion, OverlappingBoxes) {
  expect_union(joined({make_box({-1, -1, -1}, {1, 1, 1}), make_box({0.5, -0.3, -0.4}, {2, 0.6, 0.8})}),
               {{{-1, -1, -1}, {1, 1, 1}}, {{1, -0.3, -0.4}, {2, 0.6, 0.8}}});
}

TEST(MeshUnion, CoplanarDecks) {
  const auto hull = make_box({-3, -1, -1}, {3, 1, 0}), house = make_box({1, -1, -0.5}, {2, 1, 1.5});
  expect_union(joined({hull, house}), {{{-3, -1, -1}, {3, 1, 0}}, {{1, -1, 0}, {2, 1, 1.5}}});
  const auto wall = make_box({0, 0, 0}, {0.6, 2, 1}), more = make_box({0, 1.5, 0}, {0.6, 4, 1});
  expect_union(joined({more, wall}), {{{0, 0, 0}, {0.6, 4, 1}}});
}

TEST(MeshUnion, TouchingFaces) {
  expect_union(joined({make_box({-1, 0, 0}, {0, 1, 1}), make_box({0, 0, 0}, {1, 1, 1})}), {{{-1, 0, 0}, {1, 1, 1}}});
  expect_union(joined({make_box({-1, 0, 0}, {0, 1, 1}), make_box({0, 0.25, 0.5}, {1, 0.75, 2})}),
               {{{-1, 0, 0}, {0, 1, 1}}, {{0, 0.25, 0.5}, {1, 0.75, 2}}});
}

TEST(MeshUnion, TouchingFacesOfOneWeldedPart) {
  // As an STL file gives them: nothing says which triangle belongs to which box.
  const auto face = weld_vertices(joined({make_box({-1, 0, 0}, {0, 1, 1}), make_box({0, 0, 0}, {1, 1, 1})}), 1e-6);
  ASSERT_EQ(face.vertices.size(), 12u);
  expect_union(face, {{{-1, 0, 0}, {1, 1, 1}}});
  const auto edge = weld_vertices(joined({make_box({-1, -1, 0}, {0, 0, 1}), make_box({0, 0, 0}, {1, 1, 1})}), 1e-6);
  ASSERT_EQ(edge.vertices.size(), 14u);
  expect_union(edge, {{{-1, -1, 0}, {0, 0, 1}}, {{0, 0, 0}, {1, 1, 1}}});
  EXPECT_THAT(unite_parts(edge).parts, SizeIs(2));
  const auto corner = weld_vertices(joined({make_box({-1, -1, -1}, {0, 0, 0}), make_box({0, 0, 0}, {1, 1, 1})}), 1e-6);
  ASSERT_EQ(corner.vertices.size(), 15u);
  expect_union(corner, {{{-1, -1, -1}, {0, 0, 0}}, {{0, 0, 0}, {1, 1, 1}}});
  const auto twice = weld_vertices(joined({make_box({0, 0, 0}, {1, 1, 1}), make_box({0, 0, 0}, {1, 1, 1})}), 1e-6);
  ASSERT_EQ(twice.vertices.size(), 8u);
  expect_union(twice, {{{0, 0, 0}, {1, 1, 1}}});
}

TEST(MeshUnion, LeavesPartsThatOnlyMeetAtEdgesAsTheyAre) {
  const auto edge = joined({make_box({-1, -1, 0}, {0, 0, 1}), make_box({0, 0, 0}, {1, 1, 1})});
  const MeshUnion united = unite_parts(edge);
  EXPECT_EQ(united.mesh.vertices, edge.vertices);
  EXPECT_EQ(united.mesh.triangles, edge.triangles);
  EXPECT_THAT(united.notes, IsEmpty());
}

TEST(MeshUnion, TShape) {
  expect_union(joined({make_box({-2, -0.5, 0}, {2, 0.5, 1}), make_box({-0.5, 0.5, 0}, {0.5, 3, 1})}),
               {{{-2, -0.5, 0}, {2, 0.5, 1}}, {{-0.5, 0.5, 0}, {0.5, 3, 1}}});
}

TEST(MeshUnion, Duplicates) {
  const auto box = make_box({-1, -1, -1}, {2, 1, 1});
  expect_union(joined({box, box, box}), {{{-1, -1, -1}, {2, 1, 1}}});
  EXPECT_THAT(unite_parts(joined({box, box})).notes,
              ElementsAre(HasSubstr("part without effect"), HasSubstr("24 m^3 one by one and 12 m^3 together")));
}

TEST(MeshUnion, ThreePartsThatAllOverlap) {
  expect_union(joined({make_box({-3, -0.5, -0.5}, {3, 0.5, 0.5}), make_box({-0.5, -3, -0.5}, {0.5, 3, 0.5}),
                       make_box({-0.4, -0.4, -3}, {0.4, 0.4, 3})}),
               {{{-3, -0.5, -0.5}, {3, 0.5, 0.5}},
                {{-0.5, -3, -0.5}, {0.5, -0.5, 0.5}},
                {{-0.5, 0.5, -0.5}, {0.5, 3, 0.5}},
                {{-0.4, -0.4, -3}, {0.4, 0.4, -0.5}},
                {{-0.4, -0.4, 0.5}, {0.4, 0.4, 3}}});
}

TEST(MeshUnion, CrossedPrisms) {
  // Two square bars through each other, one turned about its own axis by 45 degrees: the overlap is a square bar of
  // side 1 along x over which the other's diamond |x| + |z| < sqrt(1/2) stands: with u = |z|, 2 int (sqrt(1/2) - u) 2
  // du.
  const auto along = make_box({-3, -0.5, -0.5}, {3, 0.5, 0.5}), across = make_box({-0.5, -3, -0.5}, {0.5, 3, 0.5});
  const double half = std::sqrt(0.5);
  const double overlap = 1.0 * 2.0 * (2.0 * (half * 0.5 - 0.125));
  const MeshUnion united =
      unite_parts(joined({along, turned(across, Eigen::AngleAxisd(std::numbers::pi / 4, Eigen::Vector3d::UnitY()))}));
  EXPECT_NEAR(mesh_volume(united.mesh), 12.0 - overlap, 1e-7);
}

TEST(MeshUnion, SpheresThatOverlap) {
  // Lens of two spheres of radius r at distance d: pi (2r - d)^2 (d^2 + 4 d r) / (12 d).
  const double r = 1.0, d = 0.7;
  const auto sphere = make_sphere(r, 60);
  const MeshUnion united =
      unite_parts(joined({sphere, turned(sphere, Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()), {d, 0.1, 0})}));
  const double distance = std::hypot(d, 0.1);
  const double lens =
      std::numbers::pi * std::pow(2 * r - distance, 2) * (distance * distance + 4 * distance * r) / (12 * distance);
  EXPECT_NEAR(mesh_volume(united.mesh), 8.0 / 3 * std::numbers::pi - lens, 0.02);  // facets: 0.3 %
}

/// Volume by counting points.
double sampled_volume(const MeshQuery& query, int n) {
  const Eigen::AlignedBox3d box = query.bounding_box();
  SplitMix64 random(7);
  int inside = 0;
  for (int k = 0; k < n; ++k) {
    const Eigen::Vector3d at(random.next_unit(), random.next_unit(), random.next_unit());
    inside += query.inside(box.min() + at.cwiseProduct(box.sizes())) ? 1 : 0;
  }
  return box.volume() * inside / n;
}

TEST(MeshUnion, ManyTurnedBoxesEncloseWhatTheirWindingNumbersSay) {
  SplitMix64 random(3);
  TriangleMesh parts;
  for (int k = 0; k < 12; ++k) {
    const Eigen::Vector3d size(0.3 + random.next_unit(), 0.3 + random.next_unit(), 0.3 + random.next_unit());
    const Eigen::Vector3d axis(random.next_unit() - 0.5, random.next_unit() - 0.5, random.next_unit() - 0.5);
    const Eigen::Vector3d shift(random.next_unit(), random.next_unit(), random.next_unit());
    parts = joined(
        {parts, turned(make_box(-size, size), Eigen::AngleAxisd(6 * random.next_unit(), axis.normalized()), shift)});
  }
  const MeshUnion united = unite_parts(parts);
  ASSERT_THAT(united.faults, IsEmpty());
  const MeshQuery query(united.mesh), separate(parts);
  const int n = 40000;
  const double counted = sampled_volume(separate, n), volume = mesh_volume(united.mesh);
  const double box = query.bounding_box().volume(), share = volume / box;
  EXPECT_NEAR(volume, counted, 4.0 * box * std::sqrt(share * (1 - share) / n)) << "four standard deviations";
  EXPECT_NEAR(sampled_volume(query, n), counted, 1e-4 * box) << "the union's own rays";
}

/// Boxes and cavities with corners on a lattice, so that faces, edges and corners of many of them lie on one another.
class LatticeBoxes {
 public:
  explicit LatticeBoxes(std::uint64_t seed) : random_(seed) {
    const int boxes = pick(2, 6), cavities = pick(0, 2);
    for (int n = 0; n < boxes + cavities; ++n) add(n < boxes ? 1 : -1, n == 0);
  }
  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
  [[nodiscard]] bool has_cavities() const { return winding_ != covered_; }
  /// Of the cells that the winding number says are solid.
  [[nodiscard]] double volume() const {
    return static_cast<double>(std::count_if(winding_.begin(), winding_.end(), [](int w) { return w >= 1; }));
  }
  /// Whether a cavity reaches out of all boxes.
  [[nodiscard]] bool bare() const {
    for (std::size_t n = 0; n < winding_.size(); ++n)
      if (winding_[n] < covered_[n] && covered_[n] == 0) return true;
    return false;
  }

 private:
  static constexpr int kCells = 4;
  int pick(int low, int high) {
    return low + static_cast<int>(random_.next() % static_cast<std::uint64_t>(high - low + 1));
  }

  void add(int sign, bool whole) {
    Eigen::Vector3i low, high;
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = whole ? 0 : pick(0, kCells - 1);
      high[axis] = whole ? kCells : pick(low[axis] + 1, kCells);
    }
    const TriangleMesh box = make_box(low.cast<double>(), high.cast<double>());
    mesh_ = joined({mesh_, sign > 0 ? box : reversed(box)});
    for (int n = 0; n < kCells * kCells * kCells; ++n) {
      const Eigen::Array3i cell(n / (kCells * kCells), n / kCells % kCells, n % kCells);
      if (!((cell >= low.array()).all() && (cell < high.array()).all())) continue;
      winding_[static_cast<std::size_t>(n)] += sign;
      covered_[static_cast<std::size_t>(n)] += sign > 0 ? 1 : 0;
    }
  }

  SplitMix64 random_;
  TriangleMesh mesh_;
  std::vector<int> winding_ = std::vector<int>(kCells * kCells * kCells), covered_ = winding_;
};

TEST(MeshUnion, BoxesOnALatticeEncloseTheCellsOfTheirWindingNumbers) {
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    const LatticeBoxes boxes(seed);
    for (const bool welded : {false, true}) {  // into one part, whose edges several boxes share
      const TriangleMesh mesh = welded ? weld_vertices(boxes.mesh(), 1e-6) : boxes.mesh();
      const MeshUnion united = unite_parts(turned(mesh, Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 3).normalized())));
      EXPECT_EQ(united.faults.empty(), !boxes.bare()) << seed;
      if (united.faults.empty()) {
        EXPECT_NEAR(mesh_volume(united.mesh), boxes.volume(), 1e-6) << "seed " << seed << (welded ? ", welded" : "");
      }
    }
  }
}

TEST(MeshUnion, TheOrderOfTrianglesDoesNotMatter) {
  // Merged into one part and mixed, nothing says which triangle belongs to which box.
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    const LatticeBoxes boxes(seed);
    if (boxes.has_cavities()) continue;
    TriangleMesh mesh = weld_vertices(boxes.mesh(), 1e-6);
    std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), std::mt19937(seed));
    const MeshUnion united = unite_parts(mesh);
    ASSERT_THAT(united.faults, IsEmpty()) << seed;
    EXPECT_NEAR(mesh_volume(united.mesh), boxes.volume(), 1e-6) << "seed " << seed;
  }
}

TEST(MeshUnion, Cavity) {
  const auto hull = make_box({-2, -1, -1}, {2, 1, 1}), hold = reversed(make_box({-1.5, -0.5, -0.5}, {1.5, 0.5, 0.5}));
  const std::vector<Brick> solid{{{-2, -1, -1}, {2, 1, 1}}, {{-1.5, -0.5, -0.5}, {1.5, 0.5, 0.5}, -1.0}};
  for (const TriangleMesh& parts : {joined({hull, hold}), joined({hold, hull})}) {
    expect_union(parts, solid);
    const MeshUnion united = unite_parts(parts);
    EXPECT_EQ(united.mesh.triangles, parts.triangles) << "nothing to cut";
    EXPECT_THAT(united.notes, ElementsAre(HasSubstr("takes 3 m^3 out of the solid around it; it is closed")));
    EXPECT_FALSE(MeshQuery(united.mesh).inside({0, 0, 0}));
    ASSERT_TRUE(united.outer) << "the sea meets the hull alone";
    EXPECT_EQ(united.outer->vertices, hull.vertices);
    EXPECT_EQ(united.outer->triangles, hull.triangles);
  }
}

TEST(MeshUnion, PartInACavity) {
  const auto hull = make_box({-2, -1, -1}, {2, 1, 1}), hold = reversed(make_box({-1.5, -0.5, -0.5}, {1.5, 0.5, 0.5}));
  expect_union(
      joined({hull, hold, make_box({-1, -0.2, -0.2}, {0, 0.2, 0.2})}),
      {{{-2, -1, -1}, {2, 1, 1}}, {{-1.5, -0.5, -0.5}, {1.5, 0.5, 0.5}, -1.0}, {{-1, -0.2, -0.2}, {0, 0.2, 0.2}}});
  // a bulkhead that reaches through the shell on both sides
  expect_union(
      joined({hull, hold, make_box({0, -0.8, -0.8}, {0.2, 0.8, 0.8})}),
      {{{-2, -1, -1}, {2, 1, 1}}, {{-1.5, -0.5, -0.5}, {1.5, 0.5, 0.5}, -1.0}, {{0, -0.5, -0.5}, {0.2, 0.5, 0.5}}});
}

TEST(MeshUnion, WhatIsInASealedCavityIsNotOutside) {
  const auto hull = make_box({-2, -1, -1}, {2, 1, 1}), hold = reversed(make_box({-1.5, -0.5, -0.5}, {1.5, 0.5, 0.5}));
  const auto bulkhead = make_box({0, -0.8, -0.8}, {0.2, 0.8, 0.8}), mast = make_box({1, -0.1, 0}, {1.2, 0.1, 5});
  const MeshUnion united = unite_parts(joined({hull, hold, bulkhead, mast}));
  EXPECT_NEAR(mesh_volume(united.outside()), 16.0 + 0.2 * 0.2 * 4.0, 1e-8);
  EXPECT_NEAR(mesh_area(united.outside()), 40.0 + 4 * 0.2 * 4.0, 1e-7);
}

TEST(MeshUnion, CavityThatEndsFlushWithTheDeckIsOpen) {
  expect_union(joined({make_box({-2, -1, -1}, {2, 1, 1}), reversed(make_box({-1.5, -0.5, -0.5}, {1.5, 0.5, 1}))}),
               {{{-2, -1, -1}, {2, 1, 1}}, {{-1.5, -0.5, -0.5}, {1.5, 0.5, 1}, -1.0}});
}

TEST(MeshUnion, CavitiesThatJoinAreOpenTogether) {
  const auto hull = make_box({-2, -1, -1}, {2, 1, 1}), tank = reversed(make_box({-1.8, -0.8, -0.8}, {-1.6, 0.8, 0.8}));
  const auto low = reversed(make_box({-1.5, -0.5, -0.5}, {1.5, 0.5, 0.3})),
             hatch = reversed(make_box({0, -0.2, 0.1}, {0.5, 0.2, 1}));
  const MeshUnion united = unite_parts(joined({hull, tank, low, hatch}));
  EXPECT_TRUE(united.parts[1].sealed);
  EXPECT_FALSE(united.parts[2].sealed);
  EXPECT_FALSE(united.parts[3].sealed);
  EXPECT_NEAR(mesh_volume(united.outside()), 16.0 - 2.4 - 0.5 * 0.4 * 0.7, 1e-8);
  EXPECT_NEAR(mesh_volume(united.mesh), 16.0 - 2.4 - 0.5 * 0.4 * 0.7 - 0.2 * 1.6 * 1.6, 1e-8);
}

TEST(MeshUnion, CavitiesThatOverlapAreOne) {
  expect_union(joined({make_box({-2, -1, -1}, {2, 1, 1}), reversed(make_box({-1.5, -0.5, -0.5}, {0.5, 0.5, 0.5})),
                       reversed(make_box({0, -0.5, -0.5}, {1.5, 0.5, 0.5}))}),
               {{{-2, -1, -1}, {2, 1, 1}}, {{-1.5, -0.5, -0.5}, {1.5, 0.5, 0.5}, -1.0}});
}

TEST(MeshUnion, SolidInASolidCountsOnceAndIsTold) {
  const auto parts = joined({make_box({-2, -1, -1}, {2, 1, 1}), make_box({-1.5, -0.5, -0.5}, {1.5, 0.5, 0.5})});
  expect_union(parts, {{{-2, -1, -1}, {2, 1, 1}}});
  const MeshUnion united = unite_parts(parts);
  EXPECT_EQ(united.parts[1].role, PartRole::kSwallowed);
  EXPECT_THAT(united.notes,
              ElementsAre(HasSubstr("if it is a cavity, reverse"), HasSubstr("19 m^3 one by one and 16")));
  // one that is flush with the deck, and comes first
  const auto flush = joined({make_box({-1, -0.5, 0}, {1, 0.5, 1}), make_box({-2, -1, -1}, {2, 1, 1})});
  expect_union(flush, {{{-2, -1, -1}, {2, 1, 1}}});
  EXPECT_EQ(unite_parts(flush).parts[0].role, PartRole::kSwallowed);
}

TEST(MeshUnion, RefusesPartsThatFaceInwardsAndAreNoCavity) {
  const auto hull = make_box({-2, -1, -1}, {2, 1, 1}), hold = make_box({-1.5, -0.5, -0.5}, {1.5, 0.5, 0.5});
  const auto buoy = make_box({5, 0, 0}, {6, 1, 1}), house = make_box({0, -0.5, 0.5}, {1, 0.5, 2});
  EXPECT_THAT(unite_parts(joined({hull, reversed(buoy)})).faults,
              ElementsAre(AllOf(Says("triangle 13"), Says("no part that it could be a cavity of"))));
  EXPECT_THAT(unite_parts(joined({hull, reversed(house)})).faults,
              ElementsAre(AllOf(Says("triangle 13"), Says("reaches out"))));
  EXPECT_THAT(unite_parts(joined({reversed(hull), house})).faults, ElementsAre(Says("triangle 1 ")));
  const auto inside_out = joined({reversed(hull), hold});
  EXPECT_THAT(unite_parts(inside_out).faults, ElementsAre(Says("the whole mesh is inside out")));
  EXPECT_THAT(unite_parts(reversed(inside_out)).faults, IsEmpty()) << "the advice is followed";
  EXPECT_THAT(find_mesh_faults(joined({hull, reversed(buoy)})), SizeIs(1)) << "a file with it is refused";
  EXPECT_THAT(unite_parts(joined({hull, make_box({3, 0, 0}, {4, 1, 0})})).faults,
              ElementsAre(Says("encloses nothing")));
}

TEST(MeshUnion, KeepsItsDigitsFarFromTheOrigin) {
  const Eigen::Vector3d far(654321.0, -345678.0, 12.0);
  const MeshUnion united =
      unite_parts(turned(joined({make_box({-1, -1, -1}, {1, 1, 1}), make_box({0.5, -0.3, -0.4}, {2, 0.6, 0.8})}),
                         Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()), far));
  EXPECT_NEAR(mass_properties(united.mesh).volume, 8.0 + 1.08, 1e-7);  // coordinates are rounded to 1e-10 m
}

TEST(MeshUnion, LeavesDigitsThatDifferOutOfAccount) {
  // Six digits, as many programs write: the faces that should touch are 1e-6 apart, or overlap by as much.
  for (const double gap : {1e-6, -1e-6}) {
    const auto parts = joined({make_box({-1, 0, 0}, {0, 1, 1}), make_box({gap, 0, 0}, {1, 1, 1})});
    const MeshUnion united = unite_parts(parts);
    EXPECT_NEAR(mesh_volume(united.mesh), 2.0, 3e-6);
    EXPECT_NEAR(mesh_area(united.mesh), 10.0, 1e-5) << "no face is left between them";
  }
}

TEST(MeshUnion, NearlyParallelFacesLeaveNoHoleAndCountNothingTwice) {
  // Decks that cross at a slope near the distance at which faces lie on one another.
  for (const double slope : {1e-3, 1e-4, 1e-5, 3e-6, 1e-6, 1e-7}) {
    const auto hull = make_box({-10, -2, -1}, {10, 2, 0});
    const auto inner = turned(make_box({-1, -1, -0.5}, {1, 1, 0}), Eigen::AngleAxisd(slope, Eigen::Vector3d::UnitY()));
    for (const TriangleMesh& parts : {joined({hull, inner}), joined({inner, hull})}) {
      const MeshUnion united = unite_parts(parts);
      // What stands out is a wedge of 2 x 1 m and a height of `slope`. Faces nearer than 4e-5 m lie on one another: a
      // step as high is left open along the outline of 8 m, which counts for 1/3 of its distance from the reference.
      EXPECT_NEAR(mesh_volume(united.mesh), 80.0 + slope, 1e-3) << slope;
      EXPECT_NEAR(mesh_area(united.mesh), 80.0 + 80.0 + 40.0 + 8.0, 5e-3) << slope;
    }
  }
}

TEST(MeshUnion, RefusesPartsThatCrossTooOften) {
  TriangleMesh parts;
  for (int k = 0; k < 900; ++k) {
    const double angle = std::numbers::pi * k / 900;
    parts =
        joined({parts, turned(make_box({-10, -0.01, -0.5}, {10, 0.01, 0.5 + 1e-3 * k}),
                              Eigen::AngleAxisd(angle, Eigen::Vector3d(0.1 * std::sin(7.0 * k), 0, 1).normalized()))});
  }
  EXPECT_THAT(unite_parts(parts).faults, ElementsAre(Says("allowed")));
}

}  // namespace
}  // namespace pelagos
