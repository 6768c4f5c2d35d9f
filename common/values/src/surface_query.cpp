#include "values/surface_query.hpp"

#include <fmt/format.h>

#include <cmath>

namespace pelagos {

namespace {

/// Also false for what is not a number.
bool is_within(double value, double min, double max) { return value >= min && value <= max; }

}  // namespace

std::optional<Refusal> find_fault(const SurfaceQuery& query) {
  if (!is_within(query.ahead, 0.0, SurfaceQuery::kLongestAhead))
    return Refusal{"ahead", fmt::format("{:.10g} is out of range; allowed: 0 to {:g} s", query.ahead,
                                        SurfaceQuery::kLongestAhead)};
  if (query.places.empty() || query.places.size() > SurfaceQuery::kMostPlaces)
    return Refusal{
        "place", fmt::format("{} places are given; allowed: 1 to {}", query.places.size(), SurfaceQuery::kMostPlaces)};
  for (std::size_t k = 0; k < query.places.size(); ++k)
    for (int axis = 0; axis < 2; ++axis)
      if (const double x = query.places[k][axis]; !is_within(x, -SurfaceQuery::kReach, SurfaceQuery::kReach))
        return Refusal{
            fmt::format("place[{}].{}", k, axis == 0 ? 'x' : 'y'),
            fmt::format("{0:.10g} is out of range; allowed: -{1:.0f} to {1:.0f} m", x, SurfaceQuery::kReach)};
  return std::nullopt;
}

}  // namespace pelagos
