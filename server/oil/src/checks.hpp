#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

namespace pelagos {

[[nodiscard]] std::string number_text(double value);

/// "field = value; allowed: what".
[[nodiscard]] std::string describe_fault(const std::string& field, double value, const std::string& allowed);

/// The same, if `holds` is false; a value that is not finite never holds.
[[nodiscard]] std::optional<std::string> check(const std::string& field, double value, bool holds,
                                               const std::string& allowed);

[[nodiscard]] std::optional<std::string> check_mass(double kilograms);
[[nodiscard]] std::optional<std::string> check_place(const Eigen::Vector2d& position);
[[nodiscard]] std::optional<std::string> check_radius(double radius);

}  // namespace pelagos
