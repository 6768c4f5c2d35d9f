#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "element_grid.hpp"
#include "oil/slick_frame.hpp"
#include "oil/slick_layer.hpp"
#include "oil/weathering.hpp"

namespace pelagos {

namespace {

constexpr int kPointsPerDisc = 32;

struct FilmShare {
  double thickness, area;
};

/// Thickness below which `share` of the area lies.
double percentile(const std::vector<FilmShare>& films, double total, double share) {
  double sum = 0.0;
  for (const FilmShare& film : films) {
    sum += film.area;
    if (sum >= share * total) return film.thickness;
  }
  return films.empty() ? 0.0 : films.back().thickness;
}

}  // namespace

double covered_area(std::span<const SlickElement> elements) {
  ElementGrid grid;
  grid.build(elements);
  double largest = 0.0;
  for (const SlickElement& e : elements) largest = std::max(largest, disc_radius(e));
  double area = 0.0;
  for (const SlickElement& e : elements) {
    const double radius = disc_radius(e);
    double share = 0.0;
    for (int k = 0; k < kPointsPerDisc; ++k) {
      // Vogel's spiral: points of equal weight all over the disc.
      const double angle = k * std::numbers::pi * (3.0 - std::sqrt(5.0));
      const double distance = radius * std::sqrt((k + 0.5) / kPointsPerDisc);
      const double x = e.position.x() + distance * std::cos(angle), y = e.position.y() + distance * std::sin(angle);
      int over = 0;
      grid.for_each_near(x, y, largest, [&](const ElementGrid::Entry& entry) {
        const double reach = kDiscPerSize * entry.size;
        over += (entry.x - x) * (entry.x - x) + (entry.y - y) * (entry.y - y) < reach * reach ? 1 : 0;
      });
      share += 1.0 / std::max(over, 1);
    }
    area += share / kPointsPerDisc * std::numbers::pi * radius * radius;
  }
  return area;
}

SlickStatistics SlickLayer::statistics() const {
  SlickStatistics s;
  std::vector<FilmShare> films;
  double mass = 0.0, film_area = 0.0;
  for (const SlickElement& e : state_.elements) {
    const double volume = film_volume(e, settings_.oil.density), kilograms = to_kilograms(e.mass);
    s.volume += volume;
    s.emulsion_water += volume * e.water;
    mass += kilograms;
    s.mean_viscosity +=
        kilograms * weathered_viscosity(settings_.oil, e.evaporated, e.water, settings_.water_temperature);
    s.largest_thickness = std::max(s.largest_thickness, e.film);
    films.push_back({e.film, volume / e.film});
    film_area += films.back().area;
  }
  if (films.empty()) return s;
  s.mean_viscosity /= mass;
  s.area = covered_area(state_.elements);
  s.mean_thickness = s.volume / s.area;
  std::sort(films.begin(), films.end(),
            [](const FilmShare& a, const FilmShare& b) { return a.thickness < b.thickness; });
  s.median_thickness = percentile(films, film_area, 0.5);
  s.percentile_90 = percentile(films, film_area, 0.9);
  return s;
}

}  // namespace pelagos
