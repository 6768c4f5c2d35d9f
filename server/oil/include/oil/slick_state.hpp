#pragma once

#include <map>
#include <string>
#include <vector>

#include "oil/response.hpp"
#include "oil/slick_element.hpp"
#include "values/oil_ledger.hpp"

namespace pelagos {

/// Oil on its way under one segment of a boom; a mass of 0 means none.
struct BoomState {
  Boom boom;
  std::vector<SlickElement> passing;  ///< of each segment
  std::vector<double> passing_side;   ///< of each segment: the side the oil comes from, +1 left, -1 right

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("boom", self.boom);
    visit("passing", self.passing);
    visit("passing_side", self.passing_side);
  }
};

struct SkimmerState {
  Skimmer skimmer;
  SkimmerReport report;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("skimmer", self.skimmer);
    visit("report", self.report);
  }
};

/// All that a slick's future depends on besides its settings and surroundings: what a checkpoint keeps.
struct SlickState {
  std::vector<SlickElement> elements;
  OilLedger booked;  ///< `afloat` and `contained` are 0 here: they are added up from the oil itself
  std::map<std::string, BoomState> booms;
  std::map<std::string, SkimmerState> skimmers;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("elements", self.elements);
    visit("booked", self.booked);
    visit("booms", self.booms);
    visit("skimmers", self.skimmers);
  }
};

}  // namespace pelagos
