// Open seas of finite depth, and waves over a bed that is not level.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness.hpp"
#include "open_sea_run.hpp"
#include "waves/dispersion.hpp"

namespace pelagos::validation {

namespace {

constexpr double kGravity = 9.81, kDepth = 10.0, kLength = 60.0;  // m/s^2; m; m, of the waves there

/// m/s: how fast a wave carries its energy.
double group_speed(double wavenumber, double omega, double depth) {
  const double kh = wavenumber * depth;
  return 0.5 * omega / wavenumber * (1.0 + 2.0 * kh / std::sinh(2.0 * kh));
}

SeaPatch flume(double spacing, double length) {
  SeaPatch patch;
  patch.spacing = spacing, patch.length = length, patch.width = 5.0 * spacing, patch.depth = kDepth;
  patch.slice = true, patch.zone = 20.0;
  return patch;
}

Scene sea_of(const SeaPatch& patch, double amplitude) {
  Scene scene = open_sea_scene(patch);
  scene.open_sea.depth = patch.depth;
  scene.far_sea.waves = {{amplitude, kLength, 0.0, 90.0, 0.0}};
  return scene;
}

/// The patch stands on the level bottom of the sea.
void run_level(Session& session) {
  const Subject subject{"sea_bed", "level bottom", kDefaultSolver, 1.0};
  session.attempt(subject, [&] {
    const double k = 2.0 * M_PI / kLength, omega = wave_frequency(k, kDepth, kGravity), period = 2.0 * M_PI / omega;
    WorldRun run(session.options().threads, sea_of(flume(1.0, 100.0), 0.5));
    SurfaceGauges gauges(gauge_grid(25.0, 13, 0.0, 1));
    record(session, subject, run, gauges, 6.0 * period, 0.05 * period, 16.0 * period);
    const RegularFit fit = fit_regular(gauges.samples(), k, omega);
    session.add(subject, {"error of the amplitude", 100.0 * (fit.amplitude - 1.0), "%", "0", at_most(2.0, 4.0)});
    session.add(subject, {"phase", fit.phase_deg, "degrees", "0", at_most(3.0, 12.0)});
    session.add(subject, {"reflected", 100.0 * fit.reflected, "%", "0", at_most(2.0, 5.0)});
    session.add(subject, {"level", agreement(gauges.samples()).level, "m", "0", at_most(0.03, 0.08)});
    session.add_cost(subject, run.cost());
  });
}

/// A bar: up at 1:20 from x = -150 m on to a shelf of 40 m, and down again at 1:10. @return m above the level bottom
double bar(double x, double height) {
  const double up = (x + 150.0) / 20.0, shelf = -150.0 + 20.0 * height + 40.0, down = height - (x - shelf) / 10.0;
  return std::clamp(std::min(up, down), 0.0, height);
}

HeightGrid bar_grid(const Scene& scene, double height) {
  HeightGrid grid;
  grid.x = scene.patch.min.x(), grid.y = scene.patch.min.y(), grid.cell = 2.0 * scene.particle_spacing;
  grid.columns = static_cast<int>(scene.patch.size().x() / grid.cell) + 1;
  grid.rows = 2;
  for (int j = 0; j < grid.rows; ++j)
    for (int i = 0; i < grid.columns; ++i)
      grid.height.push_back(static_cast<float>(bar(grid.x + grid.cell * i, height) - kDepth));
  return grid;
}

/// Height of waves on the shelf of the bar, against the energy that they carry to it.
void run_bar(Session& session, double spacing) {
  constexpr double kShelfDepth = 4.0, kHeight = kDepth - kShelfDepth, kAmplitude = 0.25;
  const Subject subject{"sea_bed", "bar with a slope of 1:20", kDefaultSolver, spacing};
  session.attempt(subject, [&] {
    const double k = 2.0 * M_PI / kLength, omega = wave_frequency(k, kDepth, kGravity), period = 2.0 * M_PI / omega;
    const double shelf_k = wave_number(omega, kShelfDepth, kGravity);
    const double theory =
        kAmplitude * std::sqrt(group_speed(k, omega, kDepth) / group_speed(shelf_k, omega, kShelfDepth));
    Scene scene = sea_of(flume(spacing, 400.0), kAmplitude);
    scene.open_sea.bed = {bar_grid(scene, kHeight), 20.0 * spacing};
    scene.water.settle_steps = 100;
    WorldRun run(session.options().threads, scene);
    std::vector<Eigen::Vector2d> shelf = gauge_grid(17.0, 9, 0.0, 1), start = gauge_grid(10.0, 6, 0.0, 1);
    for (Eigen::Vector2d& place : shelf) place.x() += -150.0 + 20.0 * kHeight + 20.0;
    for (Eigen::Vector2d& place : start) place.x() -= 162.0;
    SurfaceGauges on_shelf(shelf), before(start);
    const double end = 16.0 * period;
    double next = 8.0 * period;
    run.advance_to(end, [&](const StepReport&) {
      session.progress(subject, run.world().time() / end);
      if (run.world().time() < next) return;
      on_shelf.read(run.world());
      before.read(run.world());
      next += 0.05 * period;
    });
    const WayAmplitudes there = fit_ways(on_shelf.samples(), shelf_k, omega),
                        here = fit_ways(before.samples(), k, omega);
    session.add(subject,
                {"error of the height on the shelf", 100.0 * (there.out / theory - 1.0), "%", "0", at_most(5.0, 10.0)});
    session.add(subject, {"amplitude before the slope over theory", here.out / kAmplitude, "", "1"});
    session.add(subject, {"returning part on the shelf", 100.0 * there.back / there.out, "%", ""});
    session.add_cost(subject, run.cost());
  });
}

}  // namespace

void run_sea_bed(Session& session) {
  run_level(session);
  if (session.quick()) return;
  run_bar(session, 1.0);
  run_bar(session, 0.5);
}

}  // namespace pelagos::validation
