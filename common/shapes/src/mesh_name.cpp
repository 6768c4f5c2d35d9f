#include "shapes/mesh_name.hpp"

#include <filesystem>

namespace pelagos {

namespace {

constexpr std::string_view kPrimitivePrefix = "primitive:";
constexpr std::string_view kYUpPrefix = "y-up:";

}  // namespace

Eigen::Matrix3d body_from_file(MeshAxes axes) {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  if (axes == MeshAxes::kZForwardYUp) rotation << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  return rotation;
}

std::string wire_name(const MeshName& name) {
  if (name.primitive) return name_of(*name.primitive);
  return (name.axes == MeshAxes::kZForwardYUp ? std::string(kYUpPrefix) : std::string()) + name.file;
}

MeshName parse_wire_name(std::string_view text) {
  MeshName name;
  name.primitive = parse_primitive(text);
  if (name.primitive) return name;
  if (text.starts_with(kYUpPrefix)) {
    name.axes = MeshAxes::kZForwardYUp;
    text.remove_prefix(kYUpPrefix.size());
  }
  name.file = std::filesystem::path(text).filename().string();
  return name;
}

bool is_reserved(std::string_view file_name) {
  return file_name.starts_with(kPrimitivePrefix) || file_name.starts_with(kYUpPrefix);
}

}  // namespace pelagos
