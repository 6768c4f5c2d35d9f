#include <cmath>

#include "harness.hpp"
#include "measures.hpp"
#include "two_liquids.hpp"

namespace pelagos::validation {

namespace {

// Half a block of oil at a mirror, afloat on deep water where it belongs by its weight, spreads in two dimensions.
constexpr double kOil = 800.0;     // kg/m^3
constexpr double kSpacing = 0.05;  // m
constexpr double kThinnest = 3.0;  // spacings: then it is thinner than the support of a kernel

struct Setup {
  const char* name;
  int long_cells, high_cells;  ///< of the block
  int tank_cells, deep_cells;
  bool quick;
};
constexpr Setup kSetups[] = {
    {"128 particles in the plane", 16, 8, 64, 24, true},
    {"512 particles in the plane", 32, 16, 220, 48, false},
};

void run_block(Session& session, const Subject& subject, const Setup& setup) {
  const double d = kSpacing, area = setup.long_cells * setup.high_cells * d * d;
  const double level = setup.deep_cells * d, high = setup.high_cells * d, length = setup.long_cells * d;
  // The oil stands out of the water by a fifth of its height, rounded to whole layers: filled higher, water cut away.
  const int above = static_cast<int>(std::lround((1.0 - kOil / 1000.0) * setup.high_cells));
  const double top = level + above * d;
  const TwoLiquids box{setup.tank_cells * d, top + 6 * d, top, d, kOil, false};
  const auto is_oil = [&](double x, double z) { return x < length && z > top - high; };
  Start start = box.start(is_oil);
  Start kept;
  for (std::size_t i = 0; i < start.positions.size(); ++i) {
    if (start.phase[i] == kWaterPhase && static_cast<double>(start.positions[i].z) > level) continue;
    kept.positions.push_back(start.positions[i]);
    kept.phase.push_back(start.phase[i]);
  }
  WaterRun run(session.options().threads, box.parameters(), {subject.solver}, kept);
  const double reduced = 9.81 * (1.0 - kOil / 1000.0), scale = std::cbrt(reduced * area);
  const double widest = area / (kThinnest * d);
  const double longest = 2.0 * std::pow(widest / (1.2 * scale), 1.5);
  Series series = session.series(subject, "spread", "t,length");
  LineFit way;    // L^(3/2) over t: its slope does not know when the spreading began
  LineFit power;  // log L over log t
  double reach = 0.0;
  while (run.time() < longest && reach < widest) {
    run.advance_to(run.time() + 0.01 * longest, [&] { session.progress(subject, std::min(1.0, reach / widest)); });
    reach = quantile_x(run.state(), true, 0.99) + 0.5 * d;
    series.add({run.time(), reach});
    if (reach < 1.8 * length || reach > widest) continue;
    way.add(run.time(), std::pow(reach, 1.5));
    power.add(std::log(run.time()), std::log(reach));
  }
  const double slope = way.count() > 2 ? way.slope() : NAN;
  const double coefficient = std::pow(slope, 2.0 / 3.0) / scale;
  session.add(subject, {"coefficient", coefficient, "(g' A)^(1/3) t^(2/3)",
                        "1.39 for a front of Froude number 1, 1.89 for sqrt 2 (Fay 1971)", at_least(1.25, 0.6)});
  const double exponent = power.count() > 2 ? power.slope() : NAN;
  session.add(subject, {"exponent, off 2/3 by", exponent - 2.0 / 3.0, "", "0", at_most(0.03, 0.25)});
  session.add_cost(subject, run.cost());
}

}  // namespace

void run_oil_slump(Session& session) {
  for (const Setup& setup : kSetups) {
    if (session.quick() && !setup.quick) continue;
    for (const std::string& solver : session.solvers({"corrected"})) {
      const Subject subject{"oil_slump", setup.name, solver, kSpacing};
      session.attempt(subject, [&] { run_block(session, subject, setup); });
    }
  }
}

}  // namespace pelagos::validation
