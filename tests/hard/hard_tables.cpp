#include "hard_tables.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "hard_water.hpp"

namespace pelagos::hard {

namespace {

std::string text(const char* format, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

/// What counts as having held: the dam break's own bounds.
bool held(const Outcome& out) { return out.sound() && out.density_error < 0.01 && out.energy_rise < 0.01; }

std::vector<std::string> sweep_row(const std::string& solver, double factor, double cfl) {
  HardWater water(small_dam(solver));
  water.settle(60);
  water.run(0.8, factor, cfl);
  const Outcome out = water.outcome();
  const char* verdict = held(out) ? "yes" : out.not_finite > 0 ? "not finite" : out.outside > 0 ? "leaks" : "no";
  return {solver,
          text("%.3f", factor),
          cfl > 0.0 ? text("%.1f", cfl) : "-",
          verdict,
          text("%.0f", out.steps),
          text("%.2e", out.mean_density_error),
          text("%.2e", out.density_error),
          text("%.3f", out.largest_density),
          text("%.1e", out.energy_rise),
          text("%.0f", out.outside),
          text("%.1f", out.density_iterations),
          text("%.1f", out.velocity_iterations)};
}

double mean_energy(const std::vector<double>& energies, double from, double to) {
  const auto n = static_cast<double>(energies.size());
  const auto begin = static_cast<std::size_t>(from * n), end = static_cast<std::size_t>(to * n);
  double sum = 0.0;
  for (std::size_t k = begin; k < end; ++k) sum += energies[k];
  return sum / static_cast<double>(std::max<std::size_t>(end - begin, 1));
}

/// @param slosh  else still water
std::vector<std::string> long_row(const std::string& solver, bool slosh, int steps, int& failures) {
  HardWater water(slosh ? sloshing_tank(solver) : still_column(solver, 10, 3e-4));
  water.settle(100);
  const double longest = 0.07 * water.step_unit(), height = water.mean_height();
  std::vector<double> kinetic;
  double drift = 0.0;
  for (int n = 0; n < steps && water.outcome().not_finite == 0; ++n) {
    const double dt =
        std::max(0.1 * longest, admissible_time_step(water.state().parameters, 0.4, longest, water.speed()));
    kinetic.push_back(water.step(dt).kinetic_energy);
    if (n % 100 == 99 && !slosh) drift = std::max(drift, std::abs(water.mean_height() - height) / 0.05);
  }
  const Outcome out = water.outcome();
  const double early = mean_energy(kinetic, 0.1, 0.2), late = mean_energy(kinetic, 0.9, 1.0);
  const bool good = out.sound() && water.all_there() && drift < 0.25 && out.energy_rise < 0.01 && late < 2.0 * early;
  failures += good ? 0 : 1;
  return {slosh ? "sloshing" : "still",  solver,
          good ? "yes" : "NO",           text("%.0f", out.steps),
          text("%.2e", early),           text("%.2e", late),
          text("%.5f", out.rms_speed),   slosh ? "-" : text("%.3f", drift),
          text("%.1e", out.energy_rise), text("%.2e", out.density_error),
          text("%.0f", out.outside)};
}

/// Mean height of the oil over that of the water, spacings.
double oil_over_water(const FluidState& state) {
  double height[2] = {0, 0}, count[2] = {0, 0};
  for (std::size_t i = 0; i < state.particles.count; ++i) {
    height[state.particles.phase[i]] += static_cast<double>(state.particles.position[i].z);
    ++count[state.particles.phase[i]];
  }
  return (height[kOilPhase] / count[kOilPhase] - height[kWaterPhase] / count[kWaterPhase]) / 0.05;
}

std::vector<std::string> oil_row(const std::string& solver, double ratio, int steps, int& failures) {
  HardWater water(oil_dam(solver, ratio));
  water.settle(60);
  const double longest = 0.07 * water.step_unit();
  for (int n = 0; n < steps && water.outcome().not_finite == 0; ++n)
    water.step(std::max(0.1 * longest, admissible_time_step(water.state().parameters, 0.4, longest, water.speed())));
  const Outcome out = water.outcome();
  const double apart = oil_over_water(water.state());
  // The light one ends on top; at a hundredth less the water's own unrest stirs it.
  const bool good = held(out) && water.all_there() && (ratio > 0.9 || apart > 2.0);
  failures += good ? 0 : 1;
  return {solver,
          text("%.2f", ratio),
          good ? "yes" : "NO",
          text("%.0f", out.steps),
          text("%.2f", apart),
          text("%.5f", out.rms_speed),
          text("%.1e", out.energy_rise),
          text("%.2e", out.density_error),
          text("%.3f", out.largest_density),
          text("%.0f", out.outside),
          text("%.1f", out.density_iterations),
          text("%.1f", out.velocity_iterations)};
}

}  // namespace

void Table::add(std::vector<std::string> row) {
  for (const std::string& cell : row) std::printf("%s  ", cell.c_str());
  std::printf("\n");
  std::fflush(stdout);
  rows_.push_back(std::move(row));
}

void Table::write(const std::string& folder, const std::string& name) const {
  const auto put = [&](const std::string& ending, const std::string& begin, const std::string& between,
                       const std::string& end, bool ruled) {
    std::ofstream file(folder + "/" + name + ending);
    const auto line = [&](const std::vector<std::string>& cells) {
      file << begin;
      for (std::size_t k = 0; k < cells.size(); ++k) file << (k > 0 ? between : "") << cells[k];
      file << end << '\n';
    };
    line(columns_);
    if (ruled) line(std::vector<std::string>(columns_.size(), "---"));
    for (const auto& row : rows_) line(row);
    file.close();
    if (!file) throw std::runtime_error("cannot write " + folder + "/" + name + ending);
  };
  put(".csv", "", ",", "", false);
  put(".md", "| ", " | ", " |", true);
}

Table sweep_steps(const std::vector<std::string>& solvers, int& failures) {
  Table table({"solver", "step factor", "CFL", "held", "steps", "mean density error", "largest density error",
               "largest density", "energy rise", "outside", "density iterations", "velocity iterations"});
  for (const std::string& solver : solvers) {
    for (const double factor : {0.035, 0.07, 0.105, 0.14, 0.2, 0.28}) table.add(sweep_row(solver, factor, 0.0));
    for (const double cfl : {0.2, 0.4, 0.8, 1.6}) table.add(sweep_row(solver, 0.28, cfl));
    std::vector<std::string> usual = sweep_row(solver, 0.07, 0.4);
    // The server's own choice of steps has to hold for every solver that is not a literal rendering.
    if (usual[3] != "yes" && solver.find("paper") == std::string::npos) ++failures;
    table.add(std::move(usual));
  }
  return table;
}

namespace {

/// A row of the table of deep water: 56 sqrt(d/g) of it.
std::vector<std::string> deep_row(const std::string& where, const std::string& solver, int layers, HardWater& water,
                                  int& failures) {
  water.run(800 * 0.07 * water.step_unit(), 0.07, 0.4);
  const Outcome out = water.outcome();
  const bool held = out.sound() && out.energy_rise < 0.05 && out.density_error < 0.01;
  failures += held || solver != "corrected" ? 0 : 1;
  return {where,
          solver,
          text("%.0f", layers),
          held ? "yes" : "NO",
          text("%.1f", out.density_iterations),
          text("%.1f", out.velocity_iterations),
          text("%.4f", out.rms_speed),
          text("%.4f", out.rms_speed / std::sqrt(9.81 * 0.05)),
          text("%.1e", out.energy_rise),
          text("%.2e", out.density_error),
          text("%.3f", out.largest_density)};
}

}  // namespace

Table deep_water(const std::vector<std::string>& solvers, int& failures) {
  Table table({"where", "solver", "layers", "held", "density iterations", "velocity iterations", "rms speed, m/s",
               "rms / sqrt(g d)", "energy rise", "largest density error", "largest density"});
  for (const std::string& solver : solvers) {
    for (const int layers : {15, 30, 60}) {
      HardWater water(still_column(solver, layers, 1e-4));
      water.settle(100);
      table.add(deep_row("column", solver, layers, water, failures));
    }
    for (const int layers : {30, 60, 120}) {
      HardWater water(still_sea(solver, layers, 3e-4));
      table.add(deep_row("sea", solver, layers, water, failures));
    }
  }
  return table;
}

Table long_runs(const std::vector<std::string>& solvers, int steps, int& failures) {
  Table table({"case", "solver", "held", "steps", "kinetic energy early, J", "late, J", "rms speed, m/s",
               "drift of the mean height, d", "energy rise", "largest density error", "outside"});
  for (const bool slosh : {false, true})
    for (const std::string& solver : solvers) table.add(long_row(solver, slosh, steps, failures));
  return table;
}

Table oil_runs(const std::vector<std::string>& solvers, int steps, int& failures) {
  Table table({"solver", "density ratio", "held", "steps", "oil over water, d", "rms speed, m/s", "energy rise",
               "largest density error", "largest density", "outside", "density iterations", "velocity iterations"});
  for (const std::string& solver : solvers)
    for (const double ratio : {0.99, 0.1}) table.add(oil_row(solver, ratio, steps, failures));
  return table;
}

Table crowds(int& failures) {
  Table table({"coincident particles", "neighbour list, MB", "gradients, MB", "rows cut", "ms a step"});
  for (const std::size_t count : {500U, 2000U, 8000U}) {
    HardWater water(tank_with("corrected", {1, 1, 1}, 0.05), std::vector<Float4>(count, Float4{0.5F, 0.5F, 0.5F, 0}));
    const auto begin = std::chrono::steady_clock::now();
    StepReport report;
    for (int n = 0; n < 3; ++n) report = water.step(0.004);
    const double ms = 1e3 / 3.0 * std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const FluidState& state = water.state();
    const double list = 1e-6 * static_cast<double>(state.fluid_list.slots.capacity() * sizeof(std::int32_t));
    const double cached = 1e-6 * static_cast<double>(sizeof(std::uint32_t) * (state.gradients.own.words.capacity() +
                                                                              state.gradients.other.words.capacity()));
    failures += report.not_finite > 0 ? 1 : 0;
    table.add({text("%.0f", static_cast<double>(count)), text("%.1f", list), text("%.1f", cached),
               text("%.0f", report.cut_rows), text("%.0f", ms)});
  }
  return table;
}

}  // namespace pelagos::hard
