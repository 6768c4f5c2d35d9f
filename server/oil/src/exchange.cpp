#include "exchange.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace pelagos {

namespace {

/// Width of a square whose surplus is put together, in widths of a particle.
constexpr double kSpacingsPerCell = 4.0;

struct Surplus {
  std::size_t element;
  Milligrams mass;
};

/// Takes `wanted` mg out of the surpluses, the first elements first; returns where, on average.
Eigen::Vector2d take_from(const std::vector<Surplus>& pile, Milligrams wanted, std::vector<SlickElement>& elements) {
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  const auto all = static_cast<double>(wanted);
  for (const Surplus& s : pile) {
    const Milligrams part = std::min(s.mass, wanted);
    SlickElement& e = elements[s.element];
    moment += static_cast<double>(part) / all * e.position;
    e.mass -= part;
    wanted -= part;
  }
  return moment;
}

}  // namespace

std::vector<ReturnedOil> take_surplus(const ParticleExchange& exchange, double oil_density,
                                      std::vector<SlickElement>& elements) {
  const Milligrams particle = to_milligrams(exchange.particle_mass);
  double cell_size = kSpacingsPerCell * std::cbrt(exchange.particle_mass / oil_density);
  for (const SlickElement& e : elements)
    if (e.film > exchange.thickness) cell_size = std::max(cell_size, disc_radius(e));
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<Surplus>> piles;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const SlickElement& e = elements[i];
    if (e.film <= exchange.thickness) continue;
    const auto surplus = static_cast<Milligrams>((1.0 - exchange.thickness / e.film) * static_cast<double>(e.mass));
    const Eigen::Vector2d cell = e.position / cell_size;
    piles[{std::llround(cell.x()), std::llround(cell.y())}].push_back({i, surplus});
  }
  std::vector<ReturnedOil> returned;
  for (const auto& [cell, pile] : piles) {
    Milligrams total = 0;
    for (const Surplus& s : pile) total += s.mass;
    const Milligrams particles = total / particle;
    if (particles == 0) continue;
    const Eigen::Vector2d where = take_from(pile, particles * particle, elements);
    returned.push_back({where, static_cast<std::size_t>(particles), to_kilograms(particles * particle)});
  }
  std::erase_if(elements, [](const SlickElement& e) { return e.mass <= 0; });
  return returned;
}

}  // namespace pelagos
