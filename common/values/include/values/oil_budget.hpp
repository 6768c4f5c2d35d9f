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
  bool dry = false;           ///< on, and it finds hardly any oil
};

/// What keeps the oil of a source from flowing out.
enum class SourceWait {
  kNone,
  kNoWater,  ///< there is no water near its place
  kFull,     ///< as many particles are oil as may be
  kOutside,  ///< its body has carried it out of the patch
};

/// A source that runs.
struct SourceStatus {
  std::string name;
  SourceWait wait = SourceWait::kNone;
  double waiting = 0.0;  ///< s of simulated time, without a break up to now
  double pending = 0.0;  ///< kg that should have flowed out and has not

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("name", self.name);
    visit("wait", self.wait);
    visit("waiting", self.waiting);
    visit("pending", self.pending);
  }
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
  std::vector<SourceStatus> sources;  ///< that run, by name
  std::vector<std::string> booms;     ///< names
  std::vector<SkimmerStatus> skimmers;
};

}  // namespace pelagos
