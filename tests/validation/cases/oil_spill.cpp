#include <stdexcept>

#include "../../support/places.hpp"
#include "harness.hpp"
#include "scene/read_scene.hpp"
#include "solver_names.hpp"
#include "world_run.hpp"

namespace pelagos::validation {

namespace {

constexpr double kPaperStep = 2.44;  // s a step, paper section VI.C, of 64,251 + 10,000 particles

Scene spill_scene(const Subject& subject) {
  const SceneResult result = read_scene_file(test::source_path("scenes/oil_spill.scene"));
  if (!result) throw std::runtime_error(result.report());
  Scene scene = *result.scene;
  if (!choose_solver(subject.solver, scene.solver)) throw std::invalid_argument("no solver " + subject.solver);
  scene.solver.density.tolerance = scene.solver.divergence.tolerance = 1e-3;
  return scene;
}

/// The same scene with water in place of the oil.
Scene without_oil(Scene scene) {
  scene.water.blocks.insert(scene.water.blocks.end(), scene.oil->blocks.begin(), scene.oil->blocks.end());
  scene.oil.reset();
  return scene;
}

/// Time of a step with oil over that of a step with water in its place, both advanced in turn, so that a machine whose
/// speed drifts does so for both.
double second_phase_ratio(const Session& session, const Scene& scene) {
  const int steps = session.quick() ? 10 : 150;
  WorldRun oil(session.options().threads, scene), water(session.options().threads, without_oil(scene));
  for (int k = 0; k < steps; ++k) {
    oil.advance_steps(1, [](const StepReport&) {});
    water.advance_steps(1, [](const StepReport&) {});
  }
  return oil.cost().wall_s / water.cost().wall_s;
}

void run_scene(Session& session, const Subject& subject) {
  const std::int64_t steps = session.quick() ? 20 : 400;
  WorldRun run(session.options().threads, spill_scene(subject));
  std::int64_t made = 0;
  run.advance_steps(steps, [&](const StepReport&) {
    session.progress(subject, static_cast<double>(++made) / static_cast<double>(steps));
  });
  const RunCost cost = run.cost();
  const double step = cost.wall_s / static_cast<double>(cost.steps);
  session.add(subject, {"a step", 1e3 * step, "ms", "2440 ms in the paper, on its machine"});
  session.add(subject, {"times faster than the paper", kPaperStep / step, "", "on this machine",
                        session.quick() ? Goal{} : at_least(80.0, 5.0)});
  session.add(subject, {"density error", 100.0 * cost.density_error, "%", "the tolerance", at_most(0.1, 0.3)});
  session.add(subject, {"iterations, both constraints", cost.density_iterations + cost.velocity_iterations, "", "-"});
  session.add(subject, {"cost of the second phase", 100.0 * (second_phase_ratio(session, spill_scene(subject)) - 1.0),
                        "% of a step", "the same scene with water in place of the oil, in turn",
                        session.quick() ? Goal{} : at_most(15.0, 100.0)});
  session.add_cost(subject, cost);
}

}  // namespace

void run_oil_spill(Session& session) {
  for (const std::string& solver : session.solvers({"corrected", "hybrid"})) {
    if (session.quick() && solver != kDefaultSolver) continue;
    const Subject subject{"oil_spill", "the paper's scene, tolerance 0.1 %", solver, 0.05};
    session.attempt(subject, [&] { run_scene(session, subject); });
  }
}

}  // namespace pelagos::validation
