#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "text/refusal.hpp"

namespace pelagos {

[[nodiscard]] std::string number_text(double value);

/// "value; allowed: what" of a field.
[[nodiscard]] Refusal refuse(const std::string& field, double value, const std::string& allowed);

/// The same, if `holds` is false; a value that is not finite never holds.
[[nodiscard]] std::optional<Refusal> check(const std::string& field, double value, bool holds,
                                           const std::string& allowed);

[[nodiscard]] std::optional<Refusal> check_mass(double kilograms);
[[nodiscard]] std::optional<Refusal> check_place(const Eigen::Vector2d& position);
[[nodiscard]] std::optional<Refusal> check_radius(double radius);

}  // namespace pelagos
