#include "bench_queries.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>

#include "monotonic_clock.hpp"
#include "simulation/world.hpp"
#include "waves/sea_state.hpp"
#include "waves/splitmix.hpp"

namespace pelagos {

namespace {

constexpr int kTries = 20;
constexpr double kNear = 1e3, kFar = 20e3;  // m

template <class F>
double ms_of(F&& f) {
  const std::int64_t begin = monotonic_ns();
  f();
  return static_cast<double>(monotonic_ns() - begin) * 1e-6;
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Spread over a rectangle about its middle, m, world.
std::vector<Eigen::Vector2d> spread(const Eigen::Vector2d& middle, const Eigen::Vector2d& half) {
  SplitMix64 random(1);
  std::vector<Eigen::Vector2d> places(SurfaceQuery::kMostPlaces);
  for (Eigen::Vector2d& place : places) {
    const Eigen::Vector2d part(random.next_unit() - 0.5, random.next_unit() - 0.5);
    place = middle + (2.0 * half.array() * part.array()).matrix();
  }
  return places;
}

double answer_ms(const SeaAround& sea, double reach) {
  const SurfaceQuery query{1.0, spread(sea.around.frame.middle(), {reach, reach})};
  double best = std::numeric_limits<double>::max();
  for (int k = 0; k < kTries; ++k)
    best = std::min(best, ms_of([&] { static_cast<void>(answer_query(sea, query, {})); }));
  return best;
}

}  // namespace

BenchQueries measure_queries(const Scene& scene, int threads, int steps) {
  World world(scene, {threads, nullptr, {}});
  BenchQueries result;
  result.particles = world.fluid().particles.count;
  result.places = SurfaceQuery::kMostPlaces;
  const Box& box = world.patch().box;
  const std::vector<Eigen::Vector2d> inside = spread(world.patch().middle(), 0.5 * (box.max - box.min).head<2>());
  std::vector<double> step_ms, first_ms, next_ms;
  for (int k = 0; k < steps; ++k) {
    const auto read = [&] { static_cast<void>(world.read_particles(inside)); };
    step_ms.push_back(ms_of([&] { static_cast<void>(world.advance()); }));
    first_ms.push_back(ms_of(read));
    next_ms.push_back(ms_of(read));
  }
  result.step_ms = median(step_ms);
  result.first_read_ms = median(first_ms);
  result.next_read_ms = median(next_ms);
  SeaAround sea = world.sea_around();
  for (const std::uint32_t components : {40U, 200U}) {
    sea.sea = WaveField(make_wave_components({.beaufort = 5, .components = components}), sea.sea.level());
    result.waves.push_back({components, answer_ms(sea, kNear), answer_ms(sea, kFar)});
  }
  return result;
}

}  // namespace pelagos
