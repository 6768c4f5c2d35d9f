#include "read_places.hpp"

#include <string>

namespace pelagos {

std::vector<Eigen::Vector3d> read_places(const FieldReader& query) {
  constexpr std::size_t kMost = 100;
  constexpr Range kReach{-1e6, 1e6, "m"};
  std::vector<Eigen::Vector3d> places;
  const std::vector<FieldReader> given = query.children("position");
  if (given.empty() || given.size() > kMost) {
    query.fault("position", std::to_string(given.size()) + " places are given; allowed: 1 to " + std::to_string(kMost));
    return places;
  }
  for (const FieldReader& reader : given) {
    Eigen::Vector3d& place = places.emplace_back(Eigen::Vector3d::Zero());
    reader.read("x", kReach, place.x());
    reader.read("y", kReach, place.y());
    reader.read("z", kReach, place.z());
  }
  return places;
}

SurfaceQuery read_surface_query(const proto::v1::QuerySurface& query, const FieldReader& reader) {
  static_cast<void>(reader.children("place"));
  SurfaceQuery read;
  read.ahead = query.ahead();
  for (const proto::v1::Place& place : query.place()) read.places.emplace_back(place.x(), place.y());
  return read;
}

}  // namespace pelagos
