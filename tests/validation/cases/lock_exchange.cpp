#include <fmt/format.h>

#include <cmath>

#include "harness.hpp"
#include "measures.hpp"
#include "two_liquids.hpp"

namespace pelagos::validation {

namespace {

// A box six depths long, oil of 950 kg/m^3 on its left, water on its right. Two spacings of room are left above: a full
// box slowed the fronts by 20 % at 40 spacings of depth, at a density error of 0.5 %.
constexpr double kHeight = 1.0, kLength = 6.0, kOil = 950.0;  // m
constexpr double kFrom = 1.0, kTo = 2.2;                      // depths from the gate, between which speeds are measured

double speed_scale() { return std::sqrt(9.81 * (1.0 - kOil / 1000.0) * kHeight); }

void run_gate(Session& session, const Subject& subject) {
  const TwoLiquids box{kLength, kHeight + 2.0 * subject.spacing, kHeight, subject.spacing, kOil, false};
  WaterRun run(session.options().threads, box.parameters(), {subject.solver},
               box.start([](double x, double) { return x < 0.5 * kLength; }));
  const double end = 2.6 * kHeight / (0.45 * speed_scale());
  Series series = session.series(subject, "fronts", "t,oil,water");
  // The front is what a thousandth of a liquid has passed: a few rows of particles, not a single one.
  LineFit oil_way, water_way;
  run.advance_to(end, [&] {
    session.progress(subject, run.time() / end);
    const double oil = quantile_x(run.state(), true, 0.999) - 0.5 * kLength;
    const double water = 0.5 * kLength - quantile_x(run.state(), false, 0.001);
    series.add({run.time() * speed_scale() / kHeight, oil / kHeight, water / kHeight});
    if (oil > kFrom * kHeight && oil < kTo * kHeight) oil_way.add(run.time(), oil);
    if (water > kFrom * kHeight && water < kTo * kHeight) water_way.add(run.time(), water);
  });
  const auto froude = [](const LineFit& way) { return way.count() > 2 ? way.slope() / speed_scale() : NAN; };
  const double both = 0.5 * (froude(oil_way) + froude(water_way));
  session.add(subject, {"front of the oil, U / sqrt(g' H)", froude(oil_way), "", "0.477"});
  session.add(subject, {"front of the water, U / sqrt(g' H)", froude(water_way), "", "0.477"});
  session.add(subject, {"mean front speed error", 100.0 * (both / 0.477 - 1.0), "%",
                        "0.477, computed without wall friction (Haertel et al. 2000)", at_most(3.0, 30.0)});
  session.add_cost(subject, run.cost());
}

}  // namespace

void run_lock_exchange(Session& session) {
  for (const int cells : {16, 24, 40}) {
    if (session.quick() && cells > 16) continue;
    for (const std::string& solver : session.solvers({"corrected", "hybrid"})) {
      if ((session.quick() || cells == 40) && solver != kDefaultSolver) continue;
      const Subject subject{"lock_exchange", fmt::format("H/d {}", cells), solver, kHeight / cells};
      session.attempt(subject, [&] { run_gate(session, subject); });
    }
  }
}

}  // namespace pelagos::validation
