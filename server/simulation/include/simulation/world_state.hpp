#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "physics/fluid.hpp"
#include "simulation/bodies.hpp"
#include "simulation/frame_clock.hpp"
#include "simulation/oil_spill.hpp"
#include "simulation/rim_gaps.hpp"
#include "simulation/scene_sea.hpp"
#include "surface/surface_extractor.hpp"
#include "values/current.hpp"
#include "values/effort.hpp"
#include "values/patch_frame.hpp"
#include "values/probe.hpp"
#include "values/sea_request.hpp"
#include "waves/wave_field.hpp"
#include "wind/air.hpp"

namespace pelagos {

/// The current of a world.
struct CurrentState {
  std::optional<Current> running;
  std::optional<Current> slowing;  ///< of no speed: what was cleared, while the water is still slowed down
  double slowing_until = 0.0;      ///< s, simulated

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("running", self.running);
    visit("slowing", self.slowing);
    visit("slowing_until", self.slowing_until);
  }
};

/// How a world copes with values that are not finite.
struct FaultState {
  int in_row = 0;              ///< within the last careful time
  double careful_until = 0.0;  ///< s, simulated: steps are shorter up to there, while there are faults in a row
  std::uint64_t restored = 0;  ///< in all

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("in_row", self.in_row);
    visit("careful_until", self.careful_until);
    visit("restored", self.restored);
  }
};

/// All that the future of a world depends on, besides its scene and its inputs: one value. Whatever else a world holds
/// comes from the scene or is computed again in each step. Saved, loaded, hashed and compared by its fields
/// (fields/fields.hpp); simulation/state_file.hpp makes a file of it.
struct WorldState {
  std::uint64_t step = 0;  ///< steps made so far
  FrameClock clock;
  PatchFrame patch;
  WaterState water;
  RimGaps rim_gaps;  ///< of an open sea
  BodiesState bodies;
  std::optional<OilSpillState> oil;
  std::optional<Air> wind;  ///< its ramp included
  CurrentState current;
  WaveField sea;                                  ///< around the patch, with the blends that run
  std::optional<SeaRequest> sea_request;          ///< what its newest waves were made from
  std::optional<GrowingSea> growing_sea;          ///< where the wind raises them
  std::map<std::uint32_t, ProbeSettings> probes;  ///< by id
  std::vector<FoamOfParticle> foam;               ///< by particle
  Effort effort;
  FaultState faults;
  double largest_speed = 0.0;  ///< m/s, of the water: the next step's size respects it

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("step", self.step);
    visit("clock", self.clock);
    visit("patch", self.patch);
    visit("water", self.water);
    visit("rim_gaps", self.rim_gaps);
    visit("bodies", self.bodies);
    visit("oil", self.oil);
    visit("wind", self.wind);
    visit("current", self.current);
    visit("sea", self.sea);
    visit("sea_request", self.sea_request);
    visit("growing_sea", self.growing_sea);
    visit("probes", self.probes);
    visit("foam", self.foam);
    visit("effort", self.effort);
    visit("faults", self.faults);
    visit("largest_speed", self.largest_speed);
  }
};

}  // namespace pelagos
