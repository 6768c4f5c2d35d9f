#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "../support/output_folder.hpp"
#include "command_line/number_check.hpp"
#include "command_line/parse.hpp"
#include "hard_tables.hpp"
#include "solver_names.hpp"
#include "version/version.hpp"

namespace {

/// A long run compares the kinetic energy of its last tenth with that of its second. A tenth has to hold a period of
/// the sloshing slab (1.36 s by linear theory for 1.2 m of water 0.45 m deep: 272 steps of 0.005 s), and the first has
/// to hold the settling.
constexpr int kLeastLongSteps = 3000;

}  // namespace

/// The hard cases that take minutes, and the tables of docs/hard_cases.md. Exit status 1 where a case does not pass, 2
/// for a wrong command line or tables that cannot be written.
int main(int argc, char** argv) {
  CLI::App app("Hard cases of the water: step sweeps, deep water, long runs, oil, crowds. Writes NAME.csv and NAME.md.",
               "pelagos-hard");
  app.set_version_flag("--version", std::string("pelagos-hard ") + pelagos::kVersion);
  std::string folder = "out/hard", mode = "all";
  int steps = 100000;
  std::vector<std::string> solvers;
  app.add_option("case", mode, "Which")
      ->check(pelagos::OneOf({"sweep", "deep", "long", "oil", "crowd", "all"}))
      ->capture_default_str();
  app.add_option("--out", folder, "Folder for the tables (made where missing)")->capture_default_str();
  app.add_option("--solver", solvers, "Only these solvers (default: all that the case is for)")
      ->check(pelagos::OneOf(pelagos::solver_names()));
  app.add_option("--steps", steps, "Steps of the long runs")
      ->check(pelagos::WholeFrom(kLeastLongSteps, 10000000))
      ->capture_default_str();
  if (const auto status = pelagos::parse_command_line(app, argc, argv)) return *status;
  int failures = 0;
  const auto chosen = [&](const std::vector<std::string>& usual) { return solvers.empty() ? usual : solvers; };
  const auto wanted = [&](const char* name) { return mode == "all" || mode == name; };
  try {
    pelagos::test::make_output_folder(folder);
    if (wanted("sweep"))
      pelagos::hard::sweep_steps(chosen(pelagos::hard::kSweepSolvers), failures).write(folder, "hard_sweep");
    if (wanted("deep"))
      pelagos::hard::deep_water(chosen({"hybrid", "dfsph", "corrected"}), failures).write(folder, "hard_deep");
    if (wanted("crowd")) pelagos::hard::crowds(failures).write(folder, "hard_crowd");
    if (wanted("oil"))
      pelagos::hard::oil_runs(chosen({"hybrid", "dfsph", "pbf", "corrected"}), steps, failures)
          .write(folder, "hard_oil");
    if (wanted("long"))
      pelagos::hard::long_runs(chosen({"hybrid", "dfsph", "pbf", "corrected"}), steps, failures)
          .write(folder, "hard_long");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pelagos-hard: %s\n", error.what());
    return 2;
  }
  if (failures == 0)
    std::printf("all cases passed; the tables are in %s\n", folder.c_str());
  else
    std::printf("did not pass: %d\n", failures);
  return failures == 0 ? 0 : 1;
}
