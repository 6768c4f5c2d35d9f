// Times a step of the slick: pelagos-time-slick [elements] [steps]

#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "slick_fixture.hpp"
#include "values/oil_limits.hpp"

namespace pelagos {
namespace {

enum class Booms { kNone, kOne, kMost };

/// As many points of booms as may be, in zigzags all over the slick.
void set_most_booms(SlickLayer& layer, double radius) {
  for (std::size_t n = 0; n * kMostPointsPerBoom < kMostBoomPoints; ++n) {
    Boom boom;
    for (std::size_t i = 0; i < kMostPointsPerBoom; ++i) {
      const double along = 2.0 * static_cast<double>(i) / static_cast<double>(kMostPointsPerBoom) - 1.0;
      const double across = (0.5 * static_cast<double>(n) - 0.75) + (i % 2 == 0 ? 0.2 : -0.2);
      boom.line.emplace_back(radius * along, radius * across);
    }
    if (layer.set_boom(std::to_string(n), boom)) std::abort();
  }
}

/// Milliseconds a step of a slick of `count` elements that drifts, spreads and weathers.
void time_slick(std::size_t count, int steps, Booms booms) {
  SlickSettings settings;
  settings.most_elements = 2 * count;
  SlickLayer layer(settings);
  const double radius = std::sqrt(static_cast<double>(count));
  release_disc(layer, 10.0 * static_cast<double>(count), {0.0, 0.0}, radius, count);
  if (booms == Booms::kMost) set_most_booms(layer, radius);
  if (booms == Booms::kOne && layer.set_boom("b", {{{radius, -radius}, {1.5 * radius, 0.0}, {radius, radius}}}))
    std::abort();
  const PlacedSurroundings surroundings(moving({0.2, 0.0}, {5.0, 0.0}));
  run(layer, surroundings, 2.0, 0.05);
  const auto begin = std::chrono::steady_clock::now();
  run(layer, surroundings, 0.05 * steps, 0.05);
  const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - begin;
  const auto left = static_cast<double>(layer.elements().size());
  std::printf("%6zu elements released, %6.0f present%s: %7.3f ms a step, %6.0f ns an element and step\n", count, left,
              booms == Booms::kNone  ? ""
              : booms == Booms::kOne ? ", with a boom"
                                     : ", with all points of booms",
              spent.count() / steps, 1e6 * spent.count() / steps / left);
}

}  // namespace
}  // namespace pelagos

int main(int argc, char** argv) {
  const std::size_t count = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 4000;
  const int steps = argc > 2 ? std::atoi(argv[2]) : 400;
  if (count < 1 || count > 500000 || steps < 1) {
    std::fprintf(stderr, "elements: 1 to 500000; steps: 1 and more\n");
    return 1;
  }
  for (const auto booms : {pelagos::Booms::kNone, pelagos::Booms::kOne, pelagos::Booms::kMost})
    pelagos::time_slick(count, steps, booms);
}
