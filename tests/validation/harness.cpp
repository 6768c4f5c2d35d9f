#include "harness.hpp"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "../support/output_folder.hpp"

namespace pelagos::validation {

namespace {

constexpr auto kShowOnScreen = std::chrono::milliseconds(200);
constexpr auto kShowInLog = std::chrono::seconds(20);

std::ofstream open(const std::filesystem::path& file, const std::string& columns) {
  std::ofstream stream(file);
  if (!stream) throw std::runtime_error("cannot write " + file.string());
  stream << columns << '\n';
  return stream;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string file_name(std::string name) {
  for (char& c : name)
    if (c == ' ' || c == '/' || c == ',') c = '-';
  return name + ".csv";
}

/// Cells of a table hold no commas.
std::string cell(std::string text) {
  for (char& c : text)
    if (c == ',' || c == '\n') c = ';';
  return text;
}

std::string lead(const Subject& subject) {
  return cell(subject.case_name) + ',' + cell(subject.setup) + ',' + subject.solver + ',' + number(subject.spacing);
}

const char* kind_name(Goal::Kind kind) {
  switch (kind) {
    case Goal::Kind::kNone:
      return "";
    case Goal::Kind::kAtMost:
      return "at most";
    case Goal::Kind::kAtLeast:
      return "at least";
  }
  return "";
}

}  // namespace

const char* verdict(const Goal& goal, double value) {
  if (goal.kind == Goal::Kind::kNone) return "-";
  const double size = std::abs(value);
  const bool most = goal.kind == Goal::Kind::kAtMost;
  if (most ? size <= goal.aim : size >= goal.aim) return "met";
  if (most ? size <= goal.bound : size >= goal.bound) return "missed";
  return "failed";
}

Metric energy_rise(double gained, double potential) {
  return {"rise of the mechanical energy", 100.0 * (gained < 0.0 ? 0.0 : gained / potential),
          "% of the potential energy", "0", at_most(0.2, 2.0)};
}

Series::Series(const std::filesystem::path& file, const std::string& columns) : file_(open(file, columns)) {}

void Series::add(std::initializer_list<double> row) {
  const char* separator = "";
  for (const double value : row) {
    file_ << separator << number(value);
    separator = ",";
  }
  file_ << '\n';
}

void Series::add(const std::string& words, std::initializer_list<double> row) {
  file_ << words << ',';
  add(row);
}

Session::Session(Options options) : options_(std::move(options)) {
  test::make_output_folder(options_.out);
  summary_ = open(options_.out / "summary.csv",
                  "case,setup,solver,spacing,metric,value,unit,reference,goal,aim,bound,verdict");
  runs_ = open(options_.out / "runs.csv",
               "case,setup,solver,spacing,particles,steps,simulated_s,wall_s,density_iterations,velocity_iterations,"
               "density_error,density_error_peak,largest_density,unconverged_steps");
}

std::vector<std::string> Session::solvers(std::vector<std::string> own) const {
  return options_.solvers.empty() ? std::move(own) : options_.solvers;
}

void Session::attempt(const Subject& subject, const std::function<void()>& body) {
  try {
    progress(subject, 0.0);
    body();
  } catch (const std::runtime_error& error) {
    const bool ours = subject.solver == kDefaultSolver;
    summary_ << lead(subject) << ",run,nan,," << cell(error.what()) << ",,,," << (ours ? "failed" : "broke down")
             << '\n'
             << std::flush;
    failures_ += ours ? 1 : 0;
    std::fprintf(stderr, "\nvalidate: %s, %s, %s: %s\n", subject.case_name.c_str(), subject.setup.c_str(),
                 subject.solver.c_str(), error.what());
  }
  shown_ = {};
}

void Session::progress(const Subject& subject, double share) {
  const bool screen = isatty(STDERR_FILENO) != 0;
  const auto now = std::chrono::steady_clock::now();
  if (now - shown_ < (screen ? std::chrono::steady_clock::duration(kShowOnScreen) : kShowInLog)) return;
  shown_ = now;
  std::fprintf(stderr, "%svalidate: %-18s %-14s %-28s %3.0f %%%s", screen ? "\r\033[K" : "", subject.case_name.c_str(),
               subject.solver.c_str(), subject.setup.c_str(), 100.0 * share, screen ? "" : "\n");
  std::fflush(stderr);
}

void Session::add(const Subject& subject, const Metric& metric) {
  const Goal goal = subject.solver == kDefaultSolver ? metric.goal : Goal{};
  const char* result = verdict(goal, metric.value);
  const bool judged = goal.kind != Goal::Kind::kNone;
  summary_ << lead(subject) << ',' << cell(metric.name) << ',' << number(metric.value) << ',' << metric.unit << ','
           << cell(metric.reference) << ',' << kind_name(goal.kind) << ',' << (judged ? number(goal.aim) : "") << ','
           << (judged ? number(goal.bound) : "") << ',' << result << '\n'
           << std::flush;
  if (std::string(result) != "failed") return;
  ++failures_;
  std::fprintf(stderr, "\nvalidate: out of bounds: %s, %s: %s is %g %s, bound %s %g\n", subject.case_name.c_str(),
               subject.setup.c_str(), metric.name.c_str(), metric.value, metric.unit.c_str(), kind_name(goal.kind),
               goal.bound);
}

void Session::add_cost(const Subject& subject, const RunCost& cost) {
  runs_ << lead(subject) << ',' << cost.particles << ',' << cost.steps << ',' << number(cost.simulated_s) << ','
        << number(cost.wall_s) << ',' << number(cost.density_iterations) << ',' << number(cost.velocity_iterations)
        << ',' << number(cost.density_error) << ',' << number(cost.density_error_peak) << ','
        << number(cost.largest_density) << ',' << cost.unconverged_steps << '\n'
        << std::flush;
}

Series Session::series(const Subject& subject, const std::string& name, const std::string& columns) const {
  const std::string file = subject.case_name + '_' + name + '_' + subject.setup + '_' + subject.solver;
  return {options_.out / file_name(file), columns};
}

}  // namespace pelagos::validation
