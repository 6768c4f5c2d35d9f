#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace pelagos {

/// The stages of a time step, in order; the profile and the algorithm share their names.
enum class Stage : std::uint8_t {
  kBodies,            ///< place the samples of moving bodies
  kPredict,           ///< v* = v + dt a, x* = x + dt v*
  kSort,              ///< cell sort of fluid and moving samples
  kNeighbors,         ///< neighbour lists
  kDensity,           ///< delta, alpha and gradients at x*
  kDensitySolve,      ///< position-based density constraint
  kCorrectGradients,  ///< plain gradients to corrected ones
  kDivergenceSolve,   ///< divergence-free velocity
  kFilter,            ///< noise of single particles out of the velocities
  kAcceleration,      ///< gravity and viscosity
  kWind,
  kCurrent,  ///< a current's hold on the water
  kEdges,    ///< rim, floor and zones of an open sea
  kOil,      ///< sources, slick layer, exchange of particles and film
  kMeasure,  ///< errors, energy, largest speed
  kSurface,  ///< surface set and anisotropy, on frame steps only
  kCount
};
inline constexpr std::size_t kStageCount = static_cast<std::size_t>(Stage::kCount);
inline constexpr std::array<const char*, kStageCount> kStageNames = {
    "bodies", "predict",      "sort", "neighbors", "density", "density_solve", "correct_gradients", "divergence_solve",
    "filter", "acceleration", "wind", "current",   "edges",   "oil",           "measure",           "surface"};

/// Wall time for each stage. Physics has no clock of its own: the caller gives one (null: nothing is timed).
using Clock = std::int64_t (*)();  ///< ns from any fixed origin, monotonic

struct StageTimes {
  std::array<std::int64_t, kStageCount> ns{};
};

/// Adds the time of a scope to its stage.
class StageScope {
 public:
  StageScope(StageTimes& times, Clock clock, Stage stage)
      : times_(times), clock_(clock), stage_(stage), begin_(clock ? clock() : 0) {}
  ~StageScope() {
    if (clock_) times_.ns[static_cast<std::size_t>(stage_)] += clock_() - begin_;
  }
  StageScope(const StageScope&) = delete;
  StageScope& operator=(const StageScope&) = delete;

 private:
  StageTimes& times_;
  Clock clock_;
  Stage stage_;
  std::int64_t begin_;
};

/// How one constraint was solved.
struct SolveReport {
  int iterations = 0;
  double residual = 0.0;  ///< mean over particles: |r| under pressure, max(r, 0) else; fraction of the rest density
  bool converged = true;  ///< false: the iteration bound was met first
};

/// What a step did and what it cost in accuracy. Physics never logs: whoever advances it reads this.
struct StepReport {
  double dt = 0.0;  ///< s
  SolveReport density;
  SolveReport divergence;
  SolveReport viscosity;          ///< implicit viscosity of scenes with oil; residual relative to the first
  double density_error = 0.0;     ///< mean of max(delta - 1, 0) at the final positions
  double largest_density = 0.0;   ///< max of delta
  double kinetic_energy = 0.0;    ///< J
  double potential_energy = 0.0;  ///< J, from z = 0
  double largest_speed = 0.0;     ///< m/s, of |v + dt a|: what the next step's size must respect; finite particles only
  std::uint64_t pairs = 0;        ///< directed fluid pairs
  std::uint32_t pair_passes = 0;  ///< passes over all pairs
  std::uint32_t long_rows = 0;    ///< particles whose neighbours took the slow path
  std::uint32_t cut_rows = 0;     ///< particles with so many neighbours that only the nearest are kept
  std::uint32_t capped = 0;       ///< particles whose correction met the bound of d/4
  std::uint32_t outside = 0;      ///< particles beyond a wall of the patch
  std::uint32_t not_finite = 0;   ///< particles with a value that is not finite
  StageTimes times;
};

}  // namespace pelagos
