#include "status_board.hpp"

#include <utility>

namespace pelagos {

void StatusBoard::put_up(ServerStatus status, std::optional<Air> air) {
  auto sheet = std::make_shared<const Sheet>(Sheet{std::move(status), std::move(air)});
  const std::scoped_lock lock(mutex_);
  sheet_.swap(sheet);
}

std::shared_ptr<const StatusBoard::Sheet> StatusBoard::sheet() const {
  const std::scoped_lock lock(mutex_);
  return sheet_;
}

std::shared_ptr<const ServerStatus> StatusBoard::status() const {
  const auto present = sheet();
  return {present, &present->status};
}

AirReading StatusBoard::read_air(const std::vector<Eigen::Vector3d>& position) const {
  const auto present = sheet();
  AirReading reading;
  reading.simulation_time = present->status.simulation_time;
  reading.velocity.assign(position.size(), Eigen::Vector3d::Zero());
  if (!present->air) return reading;
  for (std::size_t i = 0; i < position.size(); ++i)
    reading.velocity[i] = present->air->velocity_at(position[i], reading.simulation_time);
  return reading;
}

}  // namespace pelagos
