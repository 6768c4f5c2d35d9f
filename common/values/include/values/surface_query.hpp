#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "text/refusal.hpp"

namespace pelagos {

/// A question about the water's surface at some places, now or a little later. It is no command: nothing changes by it.
struct SurfaceQuery {
  double ahead = 0.0;                   ///< s of simulated time after now, 0..kLongestAhead
  std::vector<Eigen::Vector2d> places;  ///< m, world

  static constexpr double kLongestAhead = 5.0;  ///< s
  static constexpr std::size_t kMostPlaces = 1000;
  static constexpr double kReach = 100e3;  ///< m: largest coordinate, as of poses
};

/// Why it cannot be answered: the first fault, with the field by the names of the contracts ("ahead", "place[3].x").
[[nodiscard]] std::optional<Refusal> find_fault(const SurfaceQuery& query);

/// What a reading of the surface comes from.
enum class SurfaceSource : std::uint8_t {
  kParticles,
  kBlended,    ///< of both, over the rim of a patch with open edges
  kWaveField,  ///< outside the patch, and everywhere ahead of time
  kNoWater     ///< there is none at the place, and the rest means nothing
};

struct SurfaceAtPlace {
  SurfaceSource source = SurfaceSource::kNoWater;
  double height = 0.0;                                 ///< m, world z
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();   ///< unit, world, out of the water
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< m/s, world, of the water at the surface
};

struct SurfaceAnswer {
  double simulation_time = 0.0;        ///< s: of the readings, `ahead` included
  std::vector<SurfaceAtPlace> places;  ///< in the order of the query
};

/// What became of a query that was taken.
struct SurfaceNews {
  SurfaceAnswer answer;
  std::string refusal;  ///< why there is no answer; empty: there is one
};
using TakeSurface = std::function<void(const SurfaceNews&)>;

/// How those who take queries are asked, from any thread. `client` tells those who ask from each other, e.g.
/// "bridge 3". @return nothing, or why the query is not taken: then `take` is not called
using AskSurface =
    std::function<std::optional<Refusal>(const SurfaceQuery& query, const std::string& client, TakeSurface take)>;

/// Since the start.
struct SurfaceQueryCounts {
  std::uint64_t answered = 0;
  std::uint64_t refused = 0;  ///< for a value, or beyond the limits
};

}  // namespace pelagos
