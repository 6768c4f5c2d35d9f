#pragma once

#include <Eigen/Core>
#include <vector>

#include "control.pb.h"
#include "messages/field_reader.hpp"
#include "values/surface_query.hpp"

namespace pelagos {

/// The places of a `QueryWind`, m, world frame; to be used only if no fault was noted.
[[nodiscard]] std::vector<Eigen::Vector3d> read_places(const FieldReader& query);

/// A query of the surface as it is given; find_fault tells whether its numbers are allowed.
/// @param reader  of the same message: notes fields that it does not have
[[nodiscard]] SurfaceQuery read_surface_query(const proto::v1::QuerySurface& query, const FieldReader& reader);

}  // namespace pelagos
