// The second liquid of a scene.

#include <initializer_list>

#include "scene.pb.h"
#include "validate_scene.hpp"

namespace pelagos {

namespace {

/// Rest density of oil over that of water.
constexpr double kLeastRatio = 0.1, kLargestRatio = 2.0;

std::vector<std::string> type_names() {
  std::vector<std::string> names;
  for (const OilProperties& oil : kOils) names.emplace_back(oil.name);
  return names;
}

void refuse_type(const FieldReader& reader, const std::string& type) {
  const std::vector<std::string> names = type_names();
  const std::string nearest = nearest_name(type, names);
  std::string text = "\"" + type + "\" is no known oil;";
  if (!nearest.empty()) text += " did you mean \"" + nearest + "\"?";
  text += " allowed:";
  for (const std::string& name : names) text += " \"" + name + "\",";
  reader.fault("type", text + " or density and viscosity instead");
}

void read_values(const FieldReader& reader, double water_density, OilProperties& oil) {
  reader.require("density");
  reader.require("viscosity");
  reader.read("density",
              {kLeastRatio * water_density, kLargestRatio * water_density, "kg/m^3",
               "0.1 to 2 times the water's: beyond, steps are not known to be stable"},
              oil.density);
  reader.read("viscosity", {0.0, 1000.0, "Pa s"}, oil.viscosity);
  oil = own_oil(oil.density, oil.viscosity);
}

OilProperties read_properties(const FieldReader& reader, double water_density) {
  OilProperties oil = *find_oil(kDefaultOil);
  const bool values = reader.has("density") || reader.has("viscosity");
  if (reader.has("type") && values) {
    reader.fault("type", "says what the oil is, and so do density and viscosity; allowed: one of the two ways");
  } else if (values) {
    read_values(reader, water_density, oil);
  } else if (std::string type; reader.read("type", 64, type)) {
    if (const auto found = find_oil(type))
      oil = *found;
    else
      refuse_type(reader, type);
  }
  return oil;
}

OilModel read_model(const FieldReader& reader) {
  switch (reader.read_enum("model")) {
    case proto::v1::Oil::SLICK:
      return OilModel::kSlick;
    case proto::v1::Oil::BOTH:
      return OilModel::kBoth;
    default:
      return OilModel::kParticles;
  }
}

void refuse_unused(const FieldReader& reader, bool used, const char* by, std::initializer_list<const char*> names) {
  for (const char* name : names)
    if (!used && reader.has(name))
      reader.fault(name, std::string("goes with model ") + by + " only; allowed else: leave it out");
}

void read_film(const FieldReader& reader, double water_density, OilSettings& oil) {
  refuse_unused(reader, oil.model != OilModel::kParticles, "SLICK or BOTH",
                {"water_temperature", "evaporation", "emulsification"});
  refuse_unused(reader, oil.model != OilModel::kSlick, "PARTICLES or BOTH", {"block", "most_particles"});
  reader.read("most_particles", {1, kMostParticles}, oil.most_particles);
  reader.read("water_temperature", {-2.0, 50.0, "degrees C"}, oil.water_temperature);
  reader.read("evaporation", oil.evaporation);
  reader.read("emulsification", oil.emulsification);
  if (oil.model != OilModel::kParticles && !(oil.properties.density < water_density))
    reader.fault("model", "SLICK and BOTH need an oil that floats, but it has " +
                              format_number(oil.properties.density) + " kg/m^3 and the water " +
                              format_number(water_density) + "; allowed: a lighter oil, or PARTICLES");
}

}  // namespace

std::optional<OilSettings> validate_oil(const FieldReader& scene_reader, double water_density, BlockReader& blocks) {
  if (!scene_reader.has("oil")) return std::nullopt;
  const FieldReader reader = scene_reader.child("oil");
  OilSettings oil;
  oil.properties = read_properties(reader, water_density);
  oil.model = read_model(reader);
  read_film(reader, water_density, oil);
  oil.blocks = blocks.read(reader, "oil");
  return oil;
}

}  // namespace pelagos
