#include <algorithm>

#include "fluid_stages.hpp"
#include "held_particles.hpp"

namespace pelagos {

void refresh_neighbors(TaskPool& pool, FluidState& state, StepReport& report) {
  wrap(pool, state);
  sort_particles(pool, state);
  search_neighbors(pool, state, report);
  refresh_density(pool, state, report);
}

void settle_fluid(TaskPool& pool, FluidState& state, int steps) {
  StepReport report;
  for (int step = 0; step < steps; ++step) {
    refresh_neighbors(pool, state, report);
    leave_held_out(state);
    solve_density(pool, state, 0.0F, BodiesIn::kHold, report);
    apply_correction(pool, state, {true, 0.0});
  }
  if (steps == 0) return;
  state.gradients_present = false;
  std::fill(state.particles.density_pressure.begin(), state.particles.density_pressure.end(), 0.0F);
  extend_positions(pool, state);
  start_acceleration(pool, state, report);  // the sort does not carry the accelerations along
}

}  // namespace pelagos
