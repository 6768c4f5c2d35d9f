#pragma once

#include <Eigen/Core>
#include <vector>

#include "messages/field_reader.hpp"

namespace pelagos {

/// The places of a `QueryWind`, m, world frame; to be used only if no fault was noted.
[[nodiscard]] std::vector<Eigen::Vector3d> read_places(const FieldReader& query);

}  // namespace pelagos
