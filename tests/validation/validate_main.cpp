#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iostream>
#include <stdexcept>

#include "command_line/number_check.hpp"
#include "command_line/parse.hpp"
#include "harness.hpp"
#include "machine.hpp"
#include "solver_names.hpp"
#include "version/version.hpp"

namespace pelagos::validation {
namespace {

std::vector<std::string> case_names() {
  std::vector<std::string> names;
  for (const Case& c : all_cases()) names.emplace_back(c.name);
  return names;
}

void list_cases() {
  for (const Case& c : all_cases()) std::printf("%-20s %s\n", c.name, c.title);
}

/// Names, titles and texts of the cases, one file each way: what the page is made from besides the numbers.
void write_cases(const Options& options) {
  std::ofstream file(options.out / "cases.txt");
  for (const Case& c : all_cases()) file << c.name << '\n' << c.title << '\n' << c.what << '\n' << c.against << "\n\n";
}

void write_machine(const Options& options) {
  const Machine machine = describe_machine();
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  char date[32];
  std::strftime(date, sizeof date, "%Y-%m-%d", std::gmtime(&now));
  std::ofstream file(options.out / "machine.txt");
  file << "date: " << date << "\nprocessor: " << machine.processor << "\nthreads: " << options.threads
       << "\ninstruction set: " << machine.instruction_set << "\nversion: " << kVersion
       << "\nquick: " << (options.quick ? "yes" : "no") << '\n';
}

/// How long the whole suite took: what time steps took stands in runs.csv.
void write_duration(const Options& options, double seconds) {
  std::ofstream file(options.out / "machine.txt", std::ios::app);
  file << "minutes: " << seconds / 60.0 << '\n';
}

int run(const Options& options, const std::vector<std::string>& wanted) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  Session session(options);
  write_cases(options);
  write_machine(options);
  for (const Case& c : all_cases()) {
    const bool all = std::find(wanted.begin(), wanted.end(), "all") != wanted.end();
    if (!all && std::find(wanted.begin(), wanted.end(), c.name) == wanted.end()) continue;
    const Clock::time_point begin = Clock::now();
    c.run(session);
    const std::chrono::duration<double> took = Clock::now() - begin;
    std::fprintf(stderr, "%svalidate: %-18s done in %.0f s\n", "\r", c.name, took.count());
  }
  write_duration(options, std::chrono::duration<double>(Clock::now() - start).count());
  if (session.failures() > 0) std::fprintf(stderr, "validate: %d numbers are out of bounds\n", session.failures());
  return session.failures() > 0 ? 1 : 0;
}

int main_checked(int argc, char** argv) {
  Options options;
  options.threads = describe_machine().hardware_threads;
  std::vector<std::string> cases{"all"}, names = case_names();
  names.emplace_back("all");
  bool list = false;
  CLI::App app{"Runs Pelagos against closed forms and experiments. Exit status 1 if a number is out of bounds.",
               "pelagos-validate"};
  app.set_version_flag("--version", std::string("pelagos-validate ") + kVersion);
  app.add_option("--case", cases, "Case to run, repeatable (default: all)")->check(OneOf(names));
  app.add_option("--solver", options.solvers, "Solver, repeatable (default: each case's own choice)")
      ->check(OneOf(solver_names()));
  app.add_option("--out", options.out, "Folder for the results (default: out/validate)");
  app.add_option("--threads", options.threads, "Threads (default: all)")->check(WholeFrom(1, 256));
  app.add_flag("--quick", options.quick, "Coarse runs only");
  app.add_flag("--list", list, "Only name the cases");
  if (const auto status = parse_command_line(app, argc, argv)) return *status;
  if (list) {
    list_cases();
    return 0;
  }
  return run(options, cases);
}

}  // namespace
}  // namespace pelagos::validation

int main(int argc, char** argv) {
  try {
    return pelagos::validation::main_checked(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "pelagos-validate: error: " << error.what() << '\n';
    return 2;
  }
}
