#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace pelagos {

// What an instructor may do with oil. Names tell sources, booms and skimmers apart; a second one of the same name
// replaces the first. World frame, metres, unless a body is named.

/// A source: at a point, or evenly along a line, for a time.
struct ReleaseOil {
  std::string name;
  Eigen::Vector3d from = Eigen::Vector3d::Zero();  ///< m; where `body` is named in its axes (x forward, y port, z up)
  Eigen::Vector3d to = Eigen::Vector3d::Zero();    ///< m; the line's other end, `from` for a point
  std::uint32_t body = 0;                          ///< that it moves with; 0: none
  double rate = 0.0;                               ///< m^3/h, > 0
  double duration = std::numeric_limits<double>::infinity();  ///< s, > 0; without an end until it is stopped

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("name", self.name);
    visit("from", self.from);
    visit("to", self.to);
    visit("body", self.body);
    visit("rate", self.rate);
    visit("duration", self.duration);
  }
};
struct StopRelease {
  std::string name;
};
/// Oil that is there at once, as a round slick.
struct SpillOil {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m
  double volume = 0.0;                                 ///< m^3, > 0
  double radius = 1.0;                                 ///< m, > 0
};
/// A moored floating barrier along a line; see server/oil.
struct SetBoom {
  std::string name;
  std::vector<Eigen::Vector2d> line;  ///< m, 2 to 1000 points; closed where the last is the first
  double draft = 0.5;                 ///< m
  double critical_speed = 0.36;       ///< m/s of water across it, above which oil leaks underneath
};
struct RemoveBoom {
  std::string name;
};
/// A skimmer, which takes oil from the water at a place.
struct SetSkimmer {
  std::string name;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m
  double radius = 2.0;                                 ///< m
  double rate = 20.0;                                  ///< m^3/h; 0: off
};
struct RemoveSkimmer {
  std::string name;
};

}  // namespace pelagos
