#include "checks.hpp"

#include <array>
#include <cmath>
#include <cstdio>

#include "oil/response.hpp"
#include "oil/slick_settings.hpp"
#include "values/oil_limits.hpp"
#include "values/oil_mass.hpp"

namespace pelagos {

namespace {

/// A place farther out than this is a fault of the caller; cells of the neighbour search still fit in 32 bits.
constexpr double kFarthest = 1e8;

std::optional<Refusal> check_above_zero(const std::string& field, double value) {
  return check(field, value, value > 0.0, "finite and above 0");
}

template <std::size_t N>
std::optional<Refusal> first_of(const std::array<std::optional<Refusal>, N>& faults) {
  for (const auto& fault : faults)
    if (fault) return fault;
  return {};
}

std::optional<Refusal> check_patch(const SlickPatch& patch) {
  for (int axis = 0; axis < 2; ++axis) {
    const std::string name = axis == 0 ? "patch.min.x" : "patch.min.y";
    if (auto fault = check(name, patch.min[axis], std::isfinite(patch.max[axis]) && patch.min[axis] < patch.max[axis],
                           "finite and below patch.max"))
      return fault;
  }
  return {};
}

}  // namespace

std::string number_text(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.9g", value);
  return text.data();
}

/// For what was computed: a person needs its size, not its digits.
std::string short_number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2g", value);
  return text.data();
}

Refusal refuse(const std::string& field, double value, const std::string& allowed) {
  return {field, number_text(value) + "; allowed: " + allowed};
}

std::optional<Refusal> check(const std::string& field, double value, bool holds, const std::string& allowed) {
  if (holds && std::isfinite(value)) return {};
  return refuse(field, value, allowed);
}

std::optional<Refusal> check_mass(double kilograms) {
  return check("mass", kilograms, kilograms > 0.0 && kilograms <= kMostOilMass && to_milligrams(kilograms) > 0,
               "1e-6 kg to 1e9 kg");
}

std::optional<Refusal> check_place(const Eigen::Vector2d& position) {
  for (int axis = 0; axis < 2; ++axis)
    if (auto fault = check(axis == 0 ? "position.x" : "position.y", position[axis],
                           std::abs(position[axis]) <= kFarthest, "-1e8 m to 1e8 m"))
      return fault;
  return {};
}

std::optional<Refusal> check_radius(double radius) {
  return check("radius", radius, radius >= 1e-3 && radius <= 1e6, "0.001 m to 1e6 m");
}

std::optional<Refusal> find_fault(const SlickSettings& s) {
  const auto share = [](const std::string& field, double value) {
    return check(field, value, value >= 0.0 && value <= 0.1, "0 to 0.1");
  };
  auto fault = first_of(std::array{
      check_above_zero("oil.density", s.oil.density),
      check_above_zero("oil.viscosity", s.oil.viscosity),
      check("oil.api_gravity", s.oil.api_gravity, s.oil.api_gravity >= 0.0 && s.oil.api_gravity <= 70.0, "0 to 70"),
      check("oil.most_water_content", s.oil.most_water_content,
            s.oil.most_water_content >= 0.0 && s.oil.most_water_content <= 0.9, "0 to 0.9"),
      check("water_density", s.water_density, s.water_density > s.oil.density,
            "finite and above the oil's density: oil must float"),
      check_above_zero("water_viscosity", s.water_viscosity),
      check("water_temperature", s.water_temperature, s.water_temperature >= -2.0 && s.water_temperature <= 50.0,
            "-2 to 50 degrees C"),
      check_above_zero("gravity", s.gravity),
      share("wind_share", s.wind_share),
      share("wind_share_in_waves", s.wind_share_in_waves),
      check_above_zero("inertial_constant", s.inertial_constant),
      check_above_zero("viscous_constant", s.viscous_constant),
      check_above_zero("terminal_thickness", s.terminal_thickness.value_or(1.0)),
      check("most_elements", static_cast<double>(s.most_elements), s.most_elements >= 1 && s.most_elements <= 1000000,
            "1 to 1000000"),
      check_above_zero("largest_radius", s.largest_radius),
  });
  if (!fault && s.patch) fault = check_patch(*s.patch);
  if (!fault && s.exchange) fault = check_above_zero("exchange.thickness", s.exchange->thickness);
  if (!fault && s.exchange)
    fault = check("exchange.particle_mass", s.exchange->particle_mass, !check_mass(s.exchange->particle_mass),
                  "1e-6 kg to 1e9 kg");
  return fault;
}

std::optional<Refusal> find_fault(const Boom& boom) {
  if (boom.line.size() < 2 || boom.line.size() > kMostPointsPerBoom)
    return refuse("line", static_cast<double>(boom.line.size()),
                  "2 to " + std::to_string(kMostPointsPerBoom) + " points");
  for (std::size_t i = 0; i < boom.line.size(); ++i) {
    if (auto fault = check_place(boom.line[i])) {
      fault->field = "line[" + std::to_string(i) + "]." + fault->field;
      return fault;
    }
    if (i == 0) continue;
    const double length = (boom.line[i] - boom.line[i - 1]).norm();
    if (length < 0.1)
      return Refusal{"line", "points " + std::to_string(i - 1) + " and " + std::to_string(i) + " are " +
                                 short_number(length) + " m apart; allowed: at least 0.1"};
  }
  return first_of(std::array{
      check_above_zero("draft", boom.draft),
      check_above_zero("critical_speed", boom.critical_speed),
      check("entrainment", boom.entrainment, boom.entrainment >= 0.0 && boom.entrainment <= 10.0, "0 to 10"),
  });
}

std::optional<Refusal> find_fault(const Skimmer& skimmer) {
  return first_of(std::array{
      check_place(skimmer.position),
      check("radius", skimmer.radius, skimmer.radius > 0.0 && skimmer.radius <= 1e6, "above 0 m, up to 1e6 m"),
      check("rate", skimmer.rate, skimmer.rate >= 0.0 && skimmer.rate <= 1e6, "0 m3/h to 1e6 m3/h"),
  });
}

}  // namespace pelagos
