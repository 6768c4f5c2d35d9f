#pragma once

#include <map>
#include <string>
#include <vector>

#include "describe_command.hpp"
#include "values/oil_budget.hpp"

namespace pelagos {

/// Tells once, not each step, when a source waits and flows again or has ended, and when a skimmer runs dry and finds
/// oil again. What lasts less than `kPatience` is not told.
class SpillWatch {
 public:
  static constexpr double kPatience = 5.0;  ///< s of simulated time

  /// @param time  s, simulated
  /// @return what has changed since the last call
  [[nodiscard]] std::vector<CommandNews> observe(const OilBudget& oil, double time);

 private:
  struct SkimmerView {
    bool dry = false;    ///< as last seen
    double since = 0.0;  ///< s, of that
    bool told_dry = false;
  };
  void watch_sources(const OilBudget& oil, std::vector<CommandNews>& news);
  void watch_skimmers(const OilBudget& oil, double time, std::vector<CommandNews>& news);
  static void watch(const SkimmerStatus& skimmer, double time, SkimmerView& view, std::vector<CommandNews>& news);

  std::map<std::string, bool> told_waiting_;  ///< by source
  std::map<std::string, SkimmerView> skimmers_;
  double held_back_ = 0.0;  ///< kg, as last seen
};

}  // namespace pelagos
