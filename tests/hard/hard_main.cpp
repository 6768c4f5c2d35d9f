#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "../support/output_folder.hpp"
#include "hard_tables.hpp"
#include "solver_names.hpp"
#include "version/version.hpp"

/// The hard cases that take minutes, and the tables of docs/hard_cases.md. Exit status 1 where a case does not pass.
int main(int argc, char** argv) {
  CLI::App app(
      "Hard cases of the water: step sweeps, deep water, long runs, oil, crowds. Writes NAME.csv and NAME.md.");
  app.set_version_flag("--version", std::string("pelagos-hard ") + pelagos::kVersion);
  std::string folder = "out/hard", mode = "all";
  int steps = 100000;
  std::vector<std::string> solvers;
  app.add_option("case", mode, "Which")
      ->check(CLI::IsMember({"sweep", "deep", "long", "oil", "crowd", "all"}))
      ->capture_default_str();
  app.add_option("--out", folder, "Folder for the tables (made where missing)")->capture_default_str();
  app.add_option("--solver", solvers, "Only these solvers (default: all that the case is for)")
      ->check(CLI::IsMember(pelagos::solver_names()));
  app.add_option("--steps", steps, "Steps of the long runs")->check(CLI::Range(100, 10000000))->capture_default_str();
  CLI11_PARSE(app, argc, argv);
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
