#include "governor.hpp"

#include <algorithm>
#include <cmath>

namespace pelagos {

namespace {

constexpr double kStepFactor = 1.189207115002721;  ///< 2^(1/4)
constexpr double kToleranceFactor = 2.0;
constexpr double kDefaultBudget = 0.8;  ///< of the frame interval; the rest is for publishing and others on the machine
constexpr double kRoom = 0.75;          ///< of the budget: under it there is room for more accuracy
constexpr double kRelief = 0.95;        ///< of the budget: under it the top of the ladder is enough again
constexpr double kSmoothing = 0.2;      ///< share of the newest frame
constexpr int kSettleFrames = 8;        ///< before a change shows in the smoothed time
constexpr double kFarOver = 2.0;        ///< times the budget: no frame is lucky or unlucky by so much
constexpr int kHastyFrames = 3;         ///< before a climb where the time is far over the budget
constexpr int kShortestPatience = 30, kLongestPatience = 3600;  ///< frames
constexpr int kRelapseFrames = 120;  ///< a climb within so many after a descent means that the descent was a mistake

std::vector<Effort> make_ladder(const GovernorSettings& bounds, const Effort& exact) {
  std::vector<Effort> ladder{exact};
  const double longest = std::max(bounds.largest_step, exact.max_step);
  while (ladder.back().max_step < longest * (1.0 - 1e-9)) {
    Effort next = ladder.back();
    next.max_step *= kStepFactor;
    if (next.max_step > longest * (1.0 - 1e-9)) next.max_step = longest;
    ladder.push_back(next);
  }
  const auto raise = [&](double tolerance) {
    return std::max(tolerance, std::min(tolerance * kToleranceFactor, bounds.largest_tolerance));
  };
  for (;;) {
    Effort next = ladder.back();
    next.density_tolerance = raise(next.density_tolerance);
    next.divergence_tolerance = raise(next.divergence_tolerance);
    if (next == ladder.back()) return ladder;
    ladder.push_back(next);
  }
}

}  // namespace

Governor::Governor(const Scene& scene, const Effort& exact)
    : ladder_(make_ladder(scene.governor, exact)),
      budget_(scene.governor.frame_budget > 0.0 ? scene.governor.frame_budget : kDefaultBudget * scene.frame_interval),
      patience_(kShortestPatience) {}

std::optional<Effort> Governor::observe(double frame_seconds) {
  smoothed_ = frames_ == 0 ? frame_seconds : smoothed_ + kSmoothing * (frame_seconds - smoothed_);
  ++frames_;
  calm_frames_ = smoothed_ < kRoom * budget_ ? calm_frames_ + 1 : 0;
  if (smoothed_ < kRelief * budget_) over_budget_ = false;
  if (frames_ < (smoothed_ > kFarOver * budget_ ? kHastyFrames : kSettleFrames)) return std::nullopt;
  if (smoothed_ > budget_) return climb();
  return consider_descent();
}

std::string Governor::advice(std::optional<double> frame_interval) const {
  const std::string remedy = "more threads, a larger spacing, or wider bounds in the scene's governor";
  if (frame_interval && smoothed_ > *frame_interval) return "this machine cannot keep up: " + remedy;
  return (frame_interval ? "real time is held, the budget is missed" : "the budget is missed") +
         (": a larger governor.frame_budget, " + remedy);
}

std::optional<Effort> Governor::climb() {
  if (rung_ + 1 == ladder_.size()) {
    over_budget_ = true;
    return std::nullopt;
  }
  const bool relapse = descended_ && frames_ < kRelapseFrames;
  patience_ = relapse ? std::min(2 * patience_, kLongestPatience) : patience_;
  descended_ = false;
  return move_to(std::min(rung_ + rungs_needed(), ladder_.size() - 1));
}

/// At least so many: a rung saves no more than its step is longer.
std::size_t Governor::rungs_needed() const {
  return static_cast<std::size_t>(std::max(1.0, std::floor(std::log(smoothed_ / budget_) / std::log(kStepFactor))));
}

std::optional<Effort> Governor::consider_descent() {
  if (rung_ == 0 || calm_frames_ < patience_) return std::nullopt;
  // Two descents in a row: the last one held, so there is no need to wait longer than at first.
  if (descended_) patience_ = kShortestPatience;
  descended_ = true;
  return move_to(rung_ - 1);
}

std::optional<Effort> Governor::move_to(std::size_t rung) {
  rung_ = rung;
  frames_ = calm_frames_ = 0;
  return ladder_[rung_];
}

}  // namespace pelagos
