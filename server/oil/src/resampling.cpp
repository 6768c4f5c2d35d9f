#include "resampling.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace pelagos {

namespace {

void drop_empty(std::vector<SlickElement>& elements) {
  std::erase_if(elements, [](const SlickElement& e) { return e.mass <= 0; });
}

void merge(SlickElement& into, SlickElement& from) {
  pour_in(into, from);
  from.mass = 0;
}

/// Contained elements are squeezed together: they shrink (see spread) and merge only where they share a place.
bool coincide(const SlickElement& a, const SlickElement& b) {
  constexpr double kDistance = 0.05;
  return (a.position - b.position).norm() < kDistance * std::min(a.size, b.size);
}

/// Parts in four: each keeps 0.7 of the size, and the centres move apart so far that the second moment stays.
constexpr double kPartSize = 0.7;

std::array<SlickElement, 4> parts_of(const SlickElement& whole) {
  const double offset = whole.size * std::sqrt(kBellMoment * (1.0 - kPartSize * kPartSize) / 2.0);
  std::array<SlickElement, 4> parts{whole, whole, whole, whole};
  for (std::size_t k = 0; k < 4; ++k) {
    SlickElement& part = parts[k];
    part.mass = whole.mass / 4 + (static_cast<Milligrams>(k) < whole.mass % 4 ? 1 : 0);
    part.size = kPartSize * whole.size;
    part.evaporation_rest = k == 0 ? whole.evaporation_rest : 0.0;
    part.position += Eigen::Vector2d((k & 1u) != 0 ? offset : -offset, (k & 2u) != 0 ? offset : -offset);
  }
  return parts;
}

}  // namespace

void merge_covering(std::span<const ElementPair> pairs, std::vector<SlickElement>& elements) {
  if (pairs.empty()) return;
  std::vector<std::uint8_t> merged(elements.size(), 0);
  for (const auto& [i, j] : pairs) {
    if (merged[i] || merged[j] || elements[i].mass <= 0 || elements[j].mass <= 0) continue;
    if (elements[i].contained && elements[j].contained && !coincide(elements[i], elements[j])) continue;
    merged[i] = merged[j] = 1;
    merge(elements[i], elements[j]);
  }
  drop_empty(elements);
}

void merge_down_to(std::size_t most, const Barriers& barriers, std::vector<SlickElement>& elements) {
  using Candidate = std::tuple<double, std::uint32_t, std::uint32_t>;
  bool across_booms = barriers.empty();
  while (elements.size() > most) {
    ElementGrid grid;
    grid.build(elements);
    std::vector<Candidate> candidates;
    for (std::uint32_t i = 0; i < elements.size(); ++i) {
      const SlickElement& e = elements[i];
      Candidate nearest{INFINITY, i, i};
      for (double reach = 2.0 * e.size; std::get<2>(nearest) == i; reach *= 4.0) {
        grid.for_each_near(e.position.x(), e.position.y(), reach, [&](const ElementGrid::Entry& entry) {
          if (entry.element == i) return;
          const double distance = std::hypot(entry.x - e.position.x(), entry.y - e.position.y());
          const Candidate candidate{distance / (e.size + entry.size), i, entry.element};
          if (candidate < nearest && (across_booms || !barriers.crossed(e.position, {entry.x, entry.y})))
            nearest = candidate;
        });
        if (reach > 1e9) break;  // every other element lies behind a boom
      }
      if (std::get<2>(nearest) != i) candidates.push_back(nearest);
    }
    if (candidates.empty()) {
      across_booms = true;
      continue;
    }
    std::sort(candidates.begin(), candidates.end());
    std::vector<std::uint8_t> merged(elements.size(), 0);
    std::size_t left = elements.size();
    for (const auto& [distance, i, j] : candidates) {
      if (left <= most) break;
      if (merged[i] || merged[j]) continue;
      merged[i] = merged[j] = 1;
      merge(elements[std::min(i, j)], elements[std::max(i, j)]);
      --left;
    }
    drop_empty(elements);
  }
}

void split_large(double largest_radius, std::size_t most, const Barriers& barriers,
                 std::vector<SlickElement>& elements) {
  const std::size_t count = elements.size();
  for (std::size_t i = 0; i < count && elements.size() + 3 <= most; ++i) {
    if (disc_radius(elements[i]) <= largest_radius || elements[i].mass < 4) continue;
    const auto parts = parts_of(elements[i]);
    const bool clear = std::none_of(parts.begin(), parts.end(), [&](const SlickElement& part) {
      return barriers.crossed(elements[i].position, part.position);
    });
    if (!clear) continue;
    elements[i] = parts[0];
    elements.insert(elements.end(), parts.begin() + 1, parts.end());
  }
}

}  // namespace pelagos
