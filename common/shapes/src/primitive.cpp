#include "shapes/primitive.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <span>
#include <vector>

namespace pelagos {

namespace {

constexpr double kLargestSize = 1e6;  ///< m, as for coordinates of meshes
constexpr std::size_t kMostNumbers = 3;

std::string join(const char* kind, std::initializer_list<double> numbers) {
  std::string text = std::string("primitive:") + kind;
  char mark = ':';
  for (const double number : numbers) {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number);  // the shortest exact text
    text += mark;
    text.append(digits.data(), end.ptr);
    mark = 'x';
  }
  return text;
}

/// Sizes separated by "x"; empty where one of them is no size.
std::vector<double> parse_sizes(std::string_view text) {
  std::vector<double> sizes;
  while (sizes.size() <= kMostNumbers) {
    double value = 0.0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    if (read.ec != std::errc() || !(value > 0.0) || !(value <= kLargestSize)) return {};
    sizes.push_back(value);
    text.remove_prefix(static_cast<std::size_t>(read.ptr - text.data()));
    if (text.empty()) return sizes;
    if (text.front() != 'x') return {};
    text.remove_prefix(1);
  }
  return {};
}

struct Volume {
  double operator()(const BoxShape& box) const { return box.size.prod(); }
  double operator()(const SphereShape& sphere) const {
    return 4.0 / 3.0 * std::numbers::pi * std::pow(sphere.radius, 3.0);
  }
  double operator()(const CylinderShape& c) const { return std::numbers::pi * c.radius * c.radius * c.length; }
  double operator()(const CapsuleShape& c) const {
    return std::numbers::pi * c.radius * c.radius * (c.length - 2.0 / 3.0 * c.radius);
  }
};

struct Name {
  std::string operator()(const BoxShape& box) const { return join("box", {box.size.x(), box.size.y(), box.size.z()}); }
  std::string operator()(const SphereShape& sphere) const { return join("sphere", {sphere.radius}); }
  std::string operator()(const CylinderShape& c) const { return join("cylinder", {c.radius, c.length}); }
  std::string operator()(const CapsuleShape& c) const { return join("capsule", {c.radius, c.length}); }
};

}  // namespace

double volume_of(const Primitive& primitive) { return std::visit(Volume{}, primitive); }

std::string name_of(const Primitive& primitive) { return std::visit(Name{}, primitive); }

std::optional<Primitive> parse_primitive(std::string_view name) {
  constexpr std::string_view kPrefix = "primitive:";
  if (!name.starts_with(kPrefix)) return std::nullopt;
  name.remove_prefix(kPrefix.size());
  const std::size_t colon = name.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  const std::string_view kind = name.substr(0, colon);
  const std::vector<double> sizes = parse_sizes(name.substr(colon + 1));
  if (kind == "box" && sizes.size() == 3) return BoxShape{{sizes[0], sizes[1], sizes[2]}};
  if (kind == "sphere" && sizes.size() == 1) return SphereShape{sizes[0]};
  if (kind == "cylinder" && sizes.size() == 2) return CylinderShape{sizes[0], sizes[1]};
  if (kind == "capsule" && sizes.size() == 2 && sizes[1] >= 2.0 * sizes[0]) return CapsuleShape{sizes[0], sizes[1]};
  return std::nullopt;
}

}  // namespace pelagos
