#include "simulation/current_layers.hpp"

#include <algorithm>
#include <cmath>

namespace pelagos {

namespace {

constexpr std::size_t kParticlesPerBlock = 4096;

/// The sums of some particles.
void add_to_layers(const CurrentLayers& layers, std::span<const Float4> position, std::span<const Float4> velocity,
                   std::span<LayerSum> sums) {
  for (std::size_t i = 0; i < position.size(); ++i) {
    const Float4& v = velocity[i];
    if (!std::isfinite(position[i].z + v.x + v.y)) continue;
    LayerSum& sum = sums[layers.layer_of(position[i].z)];
    sum.count += 1.0;
    sum.velocity[0] += static_cast<double>(v.x);
    sum.velocity[1] += static_cast<double>(v.y);
  }
}

}  // namespace

std::size_t CurrentLayers::layer_of(float z) const {
  const double place = (static_cast<double>(z) - floor) / thickness;
  return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(count - 1)));
}

void add_profile(TaskPool& pool, const CurrentSettings& current, double surface, const std::array<bool, 2>& moves,
                 std::span<const Float4> position, std::span<Float4> velocity) {
  pool.for_each_range(position.size(), kParticlesPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double part = current.profile(surface - static_cast<double>(position[i].z));
      if (moves[0]) velocity[i].x += static_cast<float>(part * current.velocity.x());
      if (moves[1]) velocity[i].y += static_cast<float>(part * current.velocity.y());
    }
  });
}

void sum_layers(TaskPool& pool, const CurrentLayers& layers, std::span<const Float4> position,
                std::span<const Float4> velocity, std::vector<LayerSum>& partial, std::span<LayerSum> sums) {
  const std::size_t blocks = (position.size() + kParticlesPerBlock - 1) / kParticlesPerBlock;
  partial.assign(blocks * layers.count, {});
  pool.for_each_range(position.size(), kParticlesPerBlock, [&](std::size_t begin, std::size_t end) {
    add_to_layers(layers, position.subspan(begin, end - begin), velocity.subspan(begin, end - begin),
                  std::span(partial).subspan(begin / kParticlesPerBlock * layers.count, layers.count));
  });
  std::fill(sums.begin(), sums.end(), LayerSum{});
  for (std::size_t n = 0; n < partial.size(); ++n) {
    LayerSum& sum = sums[n % layers.count];
    sum.count += partial[n].count;
    for (std::size_t axis = 0; axis < 2; ++axis) sum.velocity[axis] += partial[n].velocity[axis];
  }
}

void add_between_layers(TaskPool& pool, const CurrentLayers& layers, std::span<const std::array<double, 2>> of_layer,
                        const std::array<bool, 2>& moves, std::span<const Float4> position,
                        std::span<Float4> acceleration) {
  const auto last = static_cast<double>(layers.count - 1);
  pool.for_each_range(position.size(), kParticlesPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double place = (static_cast<double>(position[i].z) - layers.floor) / layers.thickness - 0.5;
      if (!std::isfinite(place)) continue;
      const double above = std::clamp(place, 0.0, last);
      const auto k = static_cast<std::size_t>(above), next = std::min(k + 1, layers.count - 1);
      const double part = above - static_cast<double>(k);
      const auto between = [&](std::size_t axis) {
        return static_cast<float>((1.0 - part) * of_layer[k][axis] + part * of_layer[next][axis]);
      };
      if (moves[0]) acceleration[i].x += between(0);
      if (moves[1]) acceleration[i].y += between(1);
    }
  });
}

}  // namespace pelagos
