// Times a step of the slick: pelagos-time-slick [elements] [steps]

#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "slick_fixture.hpp"

namespace pelagos {
namespace {

/// Milliseconds a step of a slick of `count` elements that drifts, spreads and weathers.
void time_slick(std::size_t count, int steps, bool boom) {
  SlickSettings settings;
  settings.most_elements = 2 * count;
  SlickLayer layer(settings);
  const double radius = std::sqrt(static_cast<double>(count));
  release_disc(layer, 10.0 * static_cast<double>(count), {0.0, 0.0}, radius, count);
  if (boom && layer.set_boom("b", {{{radius, -radius}, {1.5 * radius, 0.0}, {radius, radius}}})) std::abort();
  const PlacedSurroundings surroundings(moving({0.2, 0.0}, {5.0, 0.0}));
  run(layer, surroundings, 2.0, 0.05);
  const auto begin = std::chrono::steady_clock::now();
  run(layer, surroundings, 0.05 * steps, 0.05);
  const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - begin;
  const auto left = static_cast<double>(layer.elements().size());
  std::printf("%6zu elements released, %6.0f present%s: %7.3f ms a step, %6.0f ns an element and step\n", count, left,
              boom ? ", with a boom" : "", spent.count() / steps, 1e6 * spent.count() / steps / left);
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
  pelagos::time_slick(count, steps, false);
  pelagos::time_slick(count, steps, true);
}
