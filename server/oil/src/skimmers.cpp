#include "skimmers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pelagos {

namespace {

constexpr double kSecondsPerHour = 3600.0;
constexpr double kDryShare = 0.01;  ///< of what the skimmer can take

struct InReach {
  std::size_t element;
  double volume;  ///< m^3 under the skimmer's disc
};

Milligrams skim_with(SkimmerState& state, double oil_density, double dt, std::vector<SlickElement>& elements,
                     std::vector<InReach>& reach) {
  const Skimmer& skimmer = state.skimmer;
  const double capacity = skimmer.rate / kSecondsPerHour * dt;
  reach.clear();
  double available = 0.0;
  for (std::size_t i = 0; i < elements.size() && capacity > 0.0; ++i) {
    const SlickElement& e = elements[i];
    const double radius = disc_radius(e), distance = (e.position - skimmer.position).norm();
    if (e.mass <= 0 || distance >= radius + skimmer.radius) continue;
    const double share = shared_area(distance, radius, skimmer.radius) / (std::numbers::pi * radius * radius);
    reach.push_back({i, share * film_volume(e, oil_density)});
    available += reach.back().volume;
  }
  const double factor = available > capacity ? capacity / available : 1.0;
  Milligrams taken = 0;
  double volume = 0.0;
  for (const InReach& r : reach) {
    SlickElement& e = elements[r.element];
    const double oil = factor * r.volume * (1.0 - e.water) * oil_density;
    const Milligrams mass = std::min(to_milligrams(oil), e.mass);
    const double wet = to_kilograms(mass) / oil_density / (1.0 - e.water);
    e.mass -= mass;
    taken += mass;
    volume += wet;
    state.report.emulsion_water += wet * e.water;
  }
  state.report.recovered += taken;
  state.report.present_rate = dt > 0.0 ? volume / dt * kSecondsPerHour : 0.0;
  state.report.dry = capacity > 0.0 && volume < kDryShare * capacity;
  return taken;
}

}  // namespace

double shared_area(double distance, double radius_a, double radius_b) {
  const double small = std::min(radius_a, radius_b), large = std::max(radius_a, radius_b);
  if (distance >= small + large) return 0.0;
  if (distance <= large - small) return std::numbers::pi * small * small;
  // Two circular segments, cut off by the chord through the points where the circles meet.
  const auto segment = [](double radius, double to_chord) {
    const double cosine = std::clamp(to_chord / radius, -1.0, 1.0);
    return radius * radius * (std::acos(cosine) - cosine * std::sqrt(1.0 - cosine * cosine));
  };
  const double to_chord = (distance * distance + large * large - small * small) / (2.0 * distance);
  return segment(large, to_chord) + segment(small, distance - to_chord);
}

Milligrams skim(double oil_density, double dt, std::vector<SlickElement>& elements,
                std::map<std::string, SkimmerState>& skimmers) {
  Milligrams taken = 0;
  std::vector<InReach> reach;
  for (auto& [name, state] : skimmers) taken += skim_with(state, oil_density, dt, elements, reach);
  if (taken > 0) std::erase_if(elements, [](const SlickElement& e) { return e.mass <= 0; });
  return taken;
}

}  // namespace pelagos
