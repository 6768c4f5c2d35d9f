#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace pelagos {

/// What the physics needs to know of an oil.
struct OilProperties {
  std::string name;
  double density = 0.0;    ///< kg/m^3
  double viscosity = 0.0;  ///< Pa s, dynamic
};

/// Oils by name, at 15 C (bunker C at 10 C). Typical values for oils of these names: cargoes differ by some per cent in
/// density and severalfold in viscosity, so an exercise with a particular one gives its own numbers.
[[nodiscard]] inline std::array<OilProperties, 8> oil_types() {
  return {{{"gasoline", 732.0, 0.0007},
           {"diesel", 855.0, 0.0064},
           {"light crude", 829.0, 0.0064},
           {"medium crude", 877.0, 0.032},
           {"heavy crude", 963.0, 5.6},
           {"IFO 180", 967.0, 2.3},
           {"heavy fuel oil", 989.0, 8.7},
           {"bunker C", 986.0, 26.0}}};
}

/// What a scene means that says nothing else.
inline constexpr const char* kDefaultOil = "medium crude";

/// The oil of that very name; none if it is not in the table.
[[nodiscard]] inline std::optional<OilProperties> find_oil(std::string_view name) {
  for (const OilProperties& oil : oil_types())
    if (oil.name == name) return oil;
  return std::nullopt;
}

}  // namespace pelagos
