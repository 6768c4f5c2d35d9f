// Cost of the wave field's batches on one thread: time_waves

#include <chrono>
#include <cstdio>
#include <vector>

#include "waves/sea_state.hpp"
#include "waves/wave_field.hpp"

namespace {

constexpr int kRounds = 20;

/// Shortest of some rounds, ns a place and component.
template <class F>
double measure(std::size_t places, std::size_t components, F&& work) {
  double shortest = 1e30;
  for (int round = 0; round < kRounds; ++round) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    const double taken = std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count();
    shortest = std::min(shortest, taken / static_cast<double>(places * components));
  }
  return shortest;
}

}  // namespace

int main() {
  using namespace pelagos;
  constexpr std::size_t kPlaces = 47 * 47 * 13;
  std::vector<float> x(kPlaces), y(kPlaces), z(kPlaces), out[7];
  for (std::size_t i = 0; i < kPlaces; ++i) {
    x[i] = 2.0F * static_cast<float>(i % 47);
    y[i] = 2.0F * static_cast<float>(i / 47 % 47);
    z[i] = -1.0F * static_cast<float>(i / (47 * 47));
  }
  for (auto& values : out) values.resize(kPlaces);
  std::printf("ns a place and component, %zu places\n", kPlaces);
  std::printf(
      "components  depth  surface  displaced surface  displacement  velocity  velocity+acceleration+pressure\n");
  for (const std::uint32_t components : {40U, 200U})
    for (const double depth : {15.0, kInfiniteDepth}) {
      const auto waves = make_wave_components({.beaufort = 5, .components = components});
      const WaveMoment moment = WaveField(waves, 0.0, depth).at(100.0, {0.0, 0.0});
      const double surface = measure(kPlaces, components, [&] {
        evaluate_surface(moment, x, y, {out[0], out[1], out[2], out[3]});
      });
      const double displaced = measure(kPlaces, components, [&] {
        evaluate_displaced_surface(moment, x, y, {out[0], out[1], out[2], out[3], out[4], out[5]});
      });
      const double shift =
          measure(kPlaces, components, [&] { evaluate_displacement(moment, x, y, z, out[0], out[1], out[2]); });
      const double velocity = measure(kPlaces, components, [&] {
        evaluate_motion(moment, x, y, z, Stretching::kWheeler, {out[0], out[1], out[2], {}, {}, {}, {}});
      });
      const double all = measure(kPlaces, components, [&] {
        evaluate_motion(moment, x, y, z, Stretching::kWheeler,
                        {out[0], out[1], out[2], out[3], out[4], out[5], out[6]});
      });
      std::printf("%10u  %5g  %7.2f  %17.2f  %12.2f  %8.2f  %8.2f\n", components, depth, surface, displaced, shift,
                  velocity, all);
    }
}
