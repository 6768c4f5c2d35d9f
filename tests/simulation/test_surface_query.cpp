// Queries of the surface: the wave field outside the patch and ahead of time, the particles inside, one surface.

#include "simulation/surface_query.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fields/field_hash.hpp"
#include "simulation/world.hpp"
#include "small_patch.hpp"
#include "waves/splitmix.hpp"

namespace pelagos {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// 28 x 26 x 5 m of an open sea off the world's origin, d = 1 m, with a swell and shorter waves across it.
Scene open_patch() {
  Scene scene;
  scene.name = "open_patch";
  scene.particle_spacing = 1.0;
  scene.patch = {{86, 37, -5}, {114, 63, 8}};
  scene.patch_edges = {PatchEdge::kOpen, PatchEdge::kOpen, PatchEdge::kWall};
  scene.water.blocks = {{{86, 37, -5}, {114, 63, 0}}};
  scene.open_sea.zone_width = 5.0;
  scene.far_sea.waves = {{0.4, 30.0, 0.0, 60.0, 0.0}, {0.1, 9.0, 0.0, 130.0, 1.0}};
  return scene;
}

class SurfaceQueries : public testing::Test {
 protected:
  void SetUp() override {
    while (world_.time() < 0.5) (void)world_.advance();
  }
  [[nodiscard]] SurfaceAnswer ask(const std::vector<Vector2d>& places, double ahead = 0.0) const {
    const SurfaceQuery query{ahead, places};
    EXPECT_FALSE(find_fault(query));
    return answer_query(world_.sea_around(), query,
                        ahead > 0.0 ? std::vector<SurfaceReading>() : world_.read_particles(places));
  }
  /// By the wave field itself, about an anchor (m, world).
  [[nodiscard]] SurfaceAtPlace waves_at(const Vector2d& place, double time, const Vector2d& anchor) const {
    const Eigen::Vector2f at = (place - anchor).cast<float>();
    float height = 0, sx = 0, sy = 0;
    Eigen::Vector3f v;
    evaluate_displaced_surface(world_.sea().at(time, anchor), {&at.x(), 1}, {&at.y(), 1},
                               {{&height, 1}, {&sx, 1}, {&sy, 1}, {&v.x(), 1}, {&v.y(), 1}, {&v.z(), 1}});
    return {SurfaceSource::kWaveField, world_.sea().level() + static_cast<double>(height),
            Vector3d(-static_cast<double>(sx), -static_cast<double>(sy), 1.0).normalized(), v.cast<double>()};
  }
  /// Within `reach` of the patch's middle and outside of it.
  [[nodiscard]] std::vector<Vector2d> places_outside(double reach, std::size_t count) const {
    SplitMix64 random(7);
    std::vector<Vector2d> places;
    while (places.size() < count) {
      const Vector2d part(random.next_unit() - 0.5, random.next_unit() - 0.5);
      const Vector2d place = world_.patch().middle() + 2.0 * reach * part;
      if (!world_.patch().covers(place)) places.push_back(place);
    }
    return places;
  }

  World world_{open_patch(), {2, nullptr, {}}};
};

TEST_F(SurfaceQueries, AreTheWaveFieldOutsideThePatch) {
  const std::vector<Vector2d> near = places_outside(4000.0, 1000);
  const SurfaceAnswer answer = ask(near);
  EXPECT_EQ(answer.simulation_time, world_.time());
  ASSERT_EQ(answer.places.size(), near.size());
  for (std::size_t k = 0; k < near.size(); ++k) {
    const SurfaceAtPlace expected = waves_at(near[k], world_.time(), world_.patch().middle());
    const SurfaceAtPlace& at = answer.places[k];
    EXPECT_EQ(at.source, SurfaceSource::kWaveField);
    EXPECT_NEAR(at.height, expected.height, 1e-12) << "but for the sum of level and height, the same bits";
    EXPECT_EQ(at.normal, expected.normal);
    EXPECT_EQ(at.velocity, expected.velocity);
  }
}

TEST_F(SurfaceQueries, AreAsExactAtTheHorizon) {
  const std::vector<Vector2d> far = places_outside(99e3, 1000);
  const SurfaceAnswer answer = ask(far);
  for (std::size_t k = 0; k < far.size(); ++k) {
    const SurfaceAtPlace expected = waves_at(far[k], world_.time(), far[k]);
    EXPECT_EQ(answer.places[k].source, SurfaceSource::kWaveField);
    EXPECT_NEAR(answer.places[k].height, expected.height, 4e-4) << "0.5 m of waves, 6 km from an anchor";
    EXPECT_LT((answer.places[k].velocity - expected.velocity).norm(), 1e-3);
  }
}

TEST_F(SurfaceQueries, AreTheOneSurfaceInsideThePatch) {
  std::vector<Vector2d> places;
  std::vector<SurfacePlace> local;
  for (double x = 84.0; x <= 116.0; x += 1.3)
    for (double y = 35.0; y <= 65.0; y += 1.3) {
      places.emplace_back(x, y);
      local.push_back({world_.patch().to_local(places.back()), {}});
    }
  TaskPool pool(1);
  WaterSurface surface(pool, world_.sea_around().around);
  const std::vector<SurfaceReading> expected = surface.read(world_.fluid(), world_.sea(), world_.time(), local);
  const SurfaceAnswer answer = ask(places);
  std::array<int, 3> count{};
  for (std::size_t k = 0; k < places.size(); ++k) {
    const SurfaceAtPlace& at = answer.places[k];
    EXPECT_EQ(at.height, world_.patch().world_height(expected[k].height));
    EXPECT_EQ(at.normal, expected[k].normal);
    EXPECT_EQ(at.velocity, expected[k].velocity);
    EXPECT_EQ(at.source, expected[k].share == 1.0   ? SurfaceSource::kParticles
                         : expected[k].share == 0.0 ? SurfaceSource::kWaveField
                                                    : SurfaceSource::kBlended);
    ++count.at(static_cast<std::size_t>(at.source));
  }
  for (const int some : count) EXPECT_GT(some, 20) << "there are places of all sources";
}

TEST_F(SurfaceQueries, AreContinuousAcrossTheEdge) {
  constexpr double kStep = 0.01;
  std::vector<Vector2d> line;
  for (double x = 85.0; x < 94.99; x += kStep) line.emplace_back(x, 50.0 + 0.3 * (x - 85.0));
  const SurfaceAnswer answer = ask(line);
  EXPECT_EQ(answer.places.front().source, SurfaceSource::kWaveField);
  EXPECT_EQ(answer.places.back().source, SurfaceSource::kParticles);
  for (std::size_t k = 1; k < line.size(); ++k) {
    const SurfaceAtPlace &before = answer.places[k - 1], &at = answer.places[k];
    EXPECT_LT(std::abs(at.height - before.height), 0.3 * kStep) << line[k].x() << " m: slopes of 0.15, and the blend";
    EXPECT_LT((at.normal - before.normal).norm(), 0.01) << line[k].x();
    EXPECT_LT((at.velocity - before.velocity).norm(), 0.02) << line[k].x();
  }
}

TEST_F(SurfaceQueries, AheadAreTheWaveFieldAtThatTimeEverywhere) {
  std::vector<Vector2d> places = places_outside(200.0, 20);
  places.push_back(world_.patch().middle());
  for (const double ahead : {0.001, 2.5, 5.0}) {
    const SurfaceAnswer answer = ask(places, ahead);
    EXPECT_EQ(answer.simulation_time, world_.time() + ahead);
    for (std::size_t k = 0; k < places.size(); ++k) {
      const SurfaceAtPlace expected = waves_at(places[k], world_.time() + ahead, world_.patch().middle());
      EXPECT_EQ(answer.places[k].source, SurfaceSource::kWaveField);
      EXPECT_NEAR(answer.places[k].height, expected.height, 1e-12);
      EXPECT_EQ(answer.places[k].velocity, expected.velocity);
    }
  }
}

TEST_F(SurfaceQueries, ChangeNothing) {
  World asked(open_patch(), {2, nullptr, {}});
  std::vector<Vector2d> places = places_outside(30.0, 100);
  places.push_back(asked.patch().middle());
  while (asked.time() < world_.time()) {
    (void)asked.read_particles(places);
    (void)asked.sea_around();
    (void)asked.advance();
  }
  EXPECT_EQ(hash_fields(asked.state()), hash_fields(world_.state()));
}

TEST(SurfaceQueriesWithCurrent, AddIt) {
  Scene scene = open_patch();
  scene.current.emplace();
  scene.current->velocity = {1.5, -0.5, 0.0};
  const World calm(open_patch(), {1, nullptr, {}}), drifting(scene, {1, nullptr, {}});
  const SurfaceQuery query{1.0, {{400.0, -20.0}, {100.0, 50.0}}};
  const SurfaceAnswer without = answer_query(calm.sea_around(), query, {});
  const SurfaceAnswer with = answer_query(drifting.sea_around(), query, {});
  for (std::size_t k = 0; k < 2; ++k)
    EXPECT_LT((with.places[k].velocity - without.places[k].velocity - Vector3d(1.5, -0.5, 0.0)).norm(), 1e-9);
}

TEST(SurfaceQueriesInATank, AreDryWhereThereIsNoWater) {
  Scene scene = test::small_patch();
  scene.water.blocks = {{{0, 0, 0}, {2, 4, 1.25}}};
  const World world(scene, {1, nullptr, {}});
  const SurfaceQuery query{0.0, {{0.7, 2.0}, {4.5, 2.0}, {-3.0, 2.0}}};
  const SurfaceAnswer answer = answer_query(world.sea_around(), query, world.read_particles(query.places));
  EXPECT_EQ(answer.places[0].source, SurfaceSource::kParticles);
  EXPECT_NEAR(answer.places[0].height, 1.25, 0.25) << "a spacing: the block has begun to fall";
  EXPECT_EQ(answer.places[1].source, SurfaceSource::kNoWater);
  EXPECT_EQ(answer.places[2].source, SurfaceSource::kWaveField);
}

std::string fault_of(double ahead, std::vector<Vector2d> places) {
  const auto fault = find_fault(SurfaceQuery{ahead, std::move(places)});
  return fault ? to_string(*fault) : "";
}

TEST(SurfaceQueryFaults, NameTheFieldTheValueAndWhatIsAllowed) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(fault_of(0.0, std::vector<Vector2d>(1000, {-1e5, 1e5})), "");
  EXPECT_EQ(fault_of(5.0, {{0, 0}}), "");
  EXPECT_EQ(fault_of(0.0, {}), "place: 0 places are given; allowed: 1 to 1000");
  EXPECT_EQ(fault_of(0.0, std::vector<Vector2d>(1001, {0, 0})), "place: 1001 places are given; allowed: 1 to 1000");
  EXPECT_EQ(fault_of(5.1, {{0, 0}}), "ahead: 5.1 is out of range; allowed: 0 to 5 s");
  EXPECT_EQ(fault_of(-0.1, {{0, 0}}), "ahead: -0.1 is out of range; allowed: 0 to 5 s");
  EXPECT_EQ(fault_of(nan, {{0, 0}}), "ahead: nan is out of range; allowed: 0 to 5 s");
  EXPECT_EQ(fault_of(0.0, {{0, 0}, {0, nan}}), "place[1].y: nan is out of range; allowed: -100000 to 100000 m");
  EXPECT_EQ(fault_of(0.0, {{infinity, 0}}), "place[0].x: inf is out of range; allowed: -100000 to 100000 m");
  EXPECT_EQ(fault_of(0.0, {{0, -100001}}), "place[0].y: -100001 is out of range; allowed: -100000 to 100000 m");
}

}  // namespace
}  // namespace pelagos
