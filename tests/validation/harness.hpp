#pragma once

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

#include "water_run.hpp"

namespace pelagos::validation {

/// The solver that a scene gets without naming one: aims and bounds are held against it; the others are shown beside.
inline constexpr const char* kDefaultSolver = "corrected";

/// Which run a number belongs to.
struct Subject {
  std::string case_name, setup, solver;
  double spacing = 0;  ///< m
};

/// What a number is held to, by magnitude. Beyond `aim` it is reported as missed; beyond `bound`, no worse than which
/// the suite accepts, the whole suite fails.
struct Goal {
  enum class Kind { kNone, kAtMost, kAtLeast } kind = Kind::kNone;
  double aim = 0, bound = 0;
};
[[nodiscard]] inline Goal at_most(double aim, double bound) { return {Goal::Kind::kAtMost, aim, bound}; }
[[nodiscard]] inline Goal at_least(double aim, double bound) { return {Goal::Kind::kAtLeast, aim, bound}; }

/// "met", "missed", "failed", or "-" without a goal. Not-a-number fails any goal.
[[nodiscard]] const char* verdict(const Goal& goal, double value);

struct Metric {
  std::string name;
  double value = 0;
  std::string unit, reference;
  Goal goal{};
};

/// By how much water gained energy, as a share of its potential energy above the floor: the corrected scheme's repair
/// of positions lifts particles. What was lost counts as 0. Aim: what a repair may lift; bound: ten times as much.
/// @param gained     mechanical energy at the end less that at the start, J
/// @param potential  J
[[nodiscard]] Metric energy_rise(double gained, double potential);

/// A CSV file of one run's series: a line of column names, then rows.
class Series {
 public:
  Series(const std::filesystem::path& file, const std::string& columns);
  void add(std::initializer_list<double> row);
  /// A row whose first cells are `words`, with commas between them.
  void add(const std::string& words, std::initializer_list<double> row);

 private:
  std::ofstream file_;
};

struct Options {
  std::filesystem::path out = "out/validate";
  std::vector<std::string> solvers;  ///< empty: each case's own choice
  int threads = 1;
  bool quick = false;  ///< the coarse runs only
};

/// One run of the suite: what was asked for, where results go, and the progress shown on the way.
/// Writes summary.csv (every number with its aim and verdict) and runs.csv (what every run cost), line by line, so that
/// an interrupted suite leaves what it has.
class Session {
 public:
  explicit Session(Options options);

  [[nodiscard]] const Options& options() const { return options_; }
  [[nodiscard]] bool quick() const { return options_.quick; }
  /// The solvers asked for, or the case's own.
  [[nodiscard]] std::vector<std::string> solvers(std::vector<std::string> own) const;

  /// Runs `body`; a run that breaks down is recorded as such and the suite goes on.
  void attempt(const Subject& subject, const std::function<void()>& body);
  /// Shows how far the present run is, at most a few times a second; `share` from 0 to 1.
  void progress(const Subject& subject, double share);

  void add(const Subject& subject, const Metric& metric);
  void add_cost(const Subject& subject, const RunCost& cost);
  /// The file CASE_NAME_SETUP_SOLVER.csv, blanks and slashes in it replaced.
  [[nodiscard]] Series series(const Subject& subject, const std::string& name, const std::string& columns) const;

  [[nodiscard]] int failures() const { return failures_; }

 private:
  Options options_;
  std::ofstream summary_, runs_;
  std::chrono::steady_clock::time_point shown_{};
  int failures_ = 0;
};

/// One case of the suite; `run` makes all its runs.
struct Case {
  const char* name;     ///< as on the command line and in file names
  const char* title;    ///< as on the page
  const char* what;     ///< what is run and what is measured
  const char* against;  ///< the reference, and what others reach
  void (*run)(Session&);
};

[[nodiscard]] const std::vector<Case>& all_cases();

void run_hydrostatic(Session& session);
void run_still_water(Session& session);
void run_standing_wave(Session& session);
void run_travelling_wave(Session& session);
void run_dam_break_front(Session& session);
void run_dam_break_pressure(Session& session);
void run_taylor_green(Session& session);
void run_solid_surfaces(Session& session);
void run_square_patch(Session& session);
void run_open_sea(Session& session);
void run_sea_bed(Session& session);
void run_paper_dam_break(Session& session);
void run_wind(Session& session);
void run_paper_wind(Session& session);
void run_floating(Session& session);
void run_interface_density(Session& session);
void run_oil_at_rest(Session& session);
void run_rayleigh_taylor(Session& session);
void run_lock_exchange(Session& session);
void run_oil_slump(Session& session);
void run_oil_drop(Session& session);
void run_oil_spill(Session& session);
void run_work_precision(Session& session);

}  // namespace pelagos::validation
