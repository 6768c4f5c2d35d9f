#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "values/effort.hpp"
#include "values/scene.hpp"

namespace pelagos {

/// Keeps the wall time of a frame within a budget by paying with accuracy, no more than needed.
///
/// The efforts it may choose are a ladder: the scene's own at the bottom, then longer steps (each 2^(1/4) longer) up to
/// the longest allowed, then tolerances (each twice) up to the largest allowed. Steps come first because they buy more
/// for the density error that they cost: still water of 0.05 m particles, corrected solver, tolerance 3e-4, makes 315
/// steps of 6.7 iterations in 1.5 s at a mean error of 0.021 %. With steps twice as long it is 180 steps of 11.5
/// iterations, in 0.74 of the time, at 0.023 %; with a tolerance of 1e-3 it is 315 steps of 3.7 iterations, in 0.80 of
/// the time, at 0.069 %.
///
/// It climbs a rung when the smoothed time is over the budget, several at once where it is far over, and comes down a
/// rung when it has been under 0.75 of the budget for a while; a rung seldom costs so much that this alone would send
/// it up again, and where it has to climb soon after coming down, the while doubles. It has no clock: the same times
/// give the same choices.
class Governor {
 public:
  /// @param scene  its governor's bounds; on or not is the caller's business
  /// @param exact  the scene's own effort
  Governor(const Scene& scene, const Effort& exact);

  /// Takes the wall time of one more frame, s. Returns the effort to change to, if any.
  std::optional<Effort> observe(double frame_seconds);

  [[nodiscard]] const Effort& effort() const { return ladder_[rung_]; }
  [[nodiscard]] bool over_budget() const { return over_budget_; }  ///< at the top, and it is not enough
  [[nodiscard]] double frame_seconds() const { return smoothed_; }
  [[nodiscard]] double budget() const { return budget_; }  ///< s

  /// What to do about a budget that is missed at the bounds. Says that the machine cannot keep up only where a frame
  /// takes longer than `frame_interval`, s: a budget may be smaller than that, and missed while real time is held.
  /// @param frame_interval  s; nothing where the run is not paced: there is no real time to hold
  [[nodiscard]] std::string advice(std::optional<double> frame_interval) const;

 private:
  std::optional<Effort> move_to(std::size_t rung);
  std::optional<Effort> climb();
  [[nodiscard]] std::size_t rungs_needed() const;
  std::optional<Effort> consider_descent();

  std::vector<Effort> ladder_;
  double budget_ = 0.0;
  std::size_t rung_ = 0;
  double smoothed_ = 0.0;  ///< s, over the frames since the last change
  bool over_budget_ = false;
  int frames_ = 0;          ///< since the last change
  int calm_frames_ = 0;     ///< in a row with room
  int patience_;            ///< calm frames before a descent
  bool descended_ = false;  ///< whether the last change was one
};

}  // namespace pelagos
