#include "dam_break.hpp"
#include "../../support/places.hpp"

namespace pelagos::validation {

WaterRun start_dam_break(int threads, const DamBreak& dam, const SolverChoice& solver) {
  const double d = dam.spacing(), width = DamBreak::kSlice * d;
  const FluidParameters parameters =
      patch_parameters({dam.tank, width, 2.0 * dam.height}, d, {Edge::kMirror, Edge::kPeriodic, Edge::kMirror});
  return {threads, parameters, solver, fill_block(parameters, {dam.length, width, dam.height})};
}

std::string data_file(const std::string& name) { return test::source_path("tests/validation/data/" + name); }

}  // namespace pelagos::validation
