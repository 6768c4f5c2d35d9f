#pragma once

#include <map>
#include <string>
#include <vector>

#include "oil/slick_element.hpp"
#include "oil/slick_state.hpp"

namespace pelagos {

/// Area that two discs share, m^2.
[[nodiscard]] double shared_area(double distance, double radius_a, double radius_b);

/// Lets the skimmers work over dt, in the order of their names. Returns the oil taken.
Milligrams skim(double oil_density, double dt, std::vector<SlickElement>& elements,
                std::map<std::string, SkimmerState>& skimmers);

}  // namespace pelagos
