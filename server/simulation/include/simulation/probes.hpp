#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "physics/fluid.hpp"
#include "simulation/bodies.hpp"
#include "values/current.hpp"
#include "values/patch_frame.hpp"
#include "values/probe.hpp"

namespace pelagos {

/// The probes of a world: they read the same particles that the screens show, and cost nothing where there are none.
class Probes {
 public:
  void set(const ProbeSettings& probe) { probes_[probe.id] = probe; }
  void remove(std::uint32_t id) { probes_.erase(id); }
  [[nodiscard]] const std::map<std::uint32_t, ProbeSettings>& settings() const { return probes_; }
  void restore(const std::map<std::uint32_t, ProbeSettings>& probes) { probes_ = probes; }

  /// By id. @param frame  of the patch; @param current  adds what the water does not make itself
  [[nodiscard]] std::vector<ProbeReading> read(const FluidState& fluid, WaterSurface& surface, const WaveField& sea,
                                               const Bodies& bodies, const PatchFrame& frame,
                                               const std::optional<Current>& current, double time) const;

 private:
  std::map<std::uint32_t, ProbeSettings> probes_;
};

}  // namespace pelagos
