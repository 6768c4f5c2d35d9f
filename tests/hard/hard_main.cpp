#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>

#include "hard_tables.hpp"

/// The hard cases that take minutes, and the tables of docs/hard_cases.md. Exit status 1 where a case does not pass.
int main(int argc, char** argv) {
  CLI::App app("Hard cases of the water: step sweeps, deep water, long runs, crowds. Writes NAME.csv and NAME.md.");
  std::string folder = ".", mode = "all";
  int steps = 100000;
  app.add_option("case", mode, "Which")
      ->check(CLI::IsMember({"sweep", "deep", "long", "crowd", "all"}))
      ->capture_default_str();
  app.add_option("--out", folder, "Folder for the tables (made where missing)")->capture_default_str();
  app.add_option("--steps", steps, "Steps of the long runs")->check(CLI::Range(100, 10000000))->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  int failures = 0;
  const auto wanted = [&](const char* name) { return mode == "all" || mode == name; };
  try {
    std::filesystem::create_directories(folder);
    if (wanted("sweep")) pelagos::hard::sweep_steps(failures).write(folder, "hard_sweep");
    if (wanted("deep")) pelagos::hard::deep_water(failures).write(folder, "hard_deep");
    if (wanted("crowd")) pelagos::hard::crowds(failures).write(folder, "hard_crowd");
    if (wanted("long")) pelagos::hard::long_runs(steps, failures).write(folder, "hard_long");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pelagos-hard: %s\n", error.what());
    return 2;
  }
  std::printf("%d cases did not pass\n", failures);
  return failures == 0 ? 0 : 1;
}
