#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace pelagos {

/// A place where the water is measured each frame.
struct ProbeSettings {
  std::uint32_t id = 0;  ///< unique, >= 1
  std::string name;
  std::uint32_t body = 0;                              ///< that carries it; 0: fixed in the world
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m: world, or the body's axes
  bool at_surface = true;  ///< the velocity is that of the surface below or above; else that at `position` itself

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("id", self.id);
    visit("name", self.name);
    visit("body", self.body);
    visit("position", self.position);
    visit("at_surface", self.at_surface);
  }
};

/// What a probe reads. World axes.
struct ProbeReading {
  std::uint32_t id = 0;
  std::string name;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m, world: where the probe is
  bool wet = false;                                    ///< false: no water in its column, and the rest means nothing
  double height = 0.0;                                 ///< m, world: of the water's surface there
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();   ///< unit, out of the water
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< m/s, of the water, a current that it does not make included
  std::optional<Eigen::Vector3d> air{};                ///< m/s, TOWARDS, of the wind at `position`; none without wind
};

/// Adds a probe, or replaces the one of the same id.
struct SetProbe {
  ProbeSettings probe;
};
struct RemoveProbe {
  std::uint32_t id = 0;
};

/// No world has more.
inline constexpr std::size_t kMostProbes = 256;

}  // namespace pelagos
