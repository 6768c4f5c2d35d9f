#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "values/air_reading.hpp"
#include "values/status.hpp"
#include "wind/air.hpp"

namespace pelagos {

/// What is told of the run, for whoever asks, on any thread. The simulation puts a new copy up ten times a second and
/// after every command; nobody who reads holds it up.
class StatusBoard {
 public:
  /// @param air  at status.simulation_time; nothing: no wind
  void put_up(ServerStatus status, std::optional<Air> air);

  [[nodiscard]] std::shared_ptr<const ServerStatus> status() const;
  /// The air as it moves now at each place (m, world).
  [[nodiscard]] AirReading read_air(const std::vector<Eigen::Vector3d>& position) const;

 private:
  struct Sheet {
    ServerStatus status;
    std::optional<Air> air;
  };
  [[nodiscard]] std::shared_ptr<const Sheet> sheet() const;

  mutable std::mutex mutex_;  ///< of the pointer alone
  std::shared_ptr<const Sheet> sheet_ = std::make_shared<Sheet>();
};

}  // namespace pelagos
