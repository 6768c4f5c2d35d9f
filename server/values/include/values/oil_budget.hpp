#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "values/oil_ledger.hpp"

namespace pelagos {

/// A skimmer and what it has recovered.
struct SkimmerStatus {
  std::string name;
  Milligrams recovered = 0;
  double present_rate = 0.0;  ///< m^3/h, of oil and emulsion
  bool dry = false;           ///< on, and hardly anything to take
};

/// Where the oil is at one instant, and how the slick looks in numbers.
struct OilBudget {
  OilLedger ledger;
  std::uint32_t particles = 0;     ///< oil in the particle phase
  std::uint32_t elements = 0;      ///< of the slick
  double area = 0.0;               ///< m^2, covered by the slick
  double mean_thickness = 0.0;     ///< m
  double largest_thickness = 0.0;  ///< m
  double emulsion_water = 0.0;     ///< m^3
  double displaced_water = 0.0;    ///< kg of water that has made room for oil, less what has come back
  double held_back = 0.0;          ///< kg that sources could not bring out: dry places, or the bound on oil particles
  std::vector<SkimmerStatus> skimmers;
};

}  // namespace pelagos
