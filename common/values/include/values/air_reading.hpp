#pragma once

#include <Eigen/Core>
#include <vector>

namespace pelagos {

/// What anemometers at some places read at one time.
struct AirReading {
  double simulation_time = 0.0;           ///< s
  std::vector<Eigen::Vector3d> velocity;  ///< m/s, TOWARDS, one for each place; 0 where there is no wind
};

}  // namespace pelagos
