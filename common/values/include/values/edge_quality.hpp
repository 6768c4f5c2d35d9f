#pragma once

#include <cstdint>
#include <optional>

namespace pelagos {

/// How well the water of an open sea follows the wave field.
struct EdgeQuality {
  double level = 0.0;  ///< m, of the free water by its volume, above that at the start
  /// Heights inside over those of the wave field, sum h h_field / sum h_field^2 over the last minute or so; nothing in
  /// a flat sea.
  std::optional<double> height_ratio;
  double significant_height = 0.0;  ///< m, of the waves that the patch carries
  /// Difference of the water's velocity in the zones from the wave field's, rms over the last seconds, m/s: what the
  /// zones absorb. A wave that they throw back shows here first.
  double mismatch = 0.0;
  std::uint64_t created = 0, deleted = 0;  ///< particles at the edges, since the start
};

}  // namespace pelagos
