#include <array>
#include <cstdint>
#include <vector>

#include "fields/field_hash.hpp"
#include "rigid/body_mass.hpp"
#include "simulation/world.hpp"

namespace pelagos {

namespace {

/// Of several values together.
template <class... Values>
std::uint64_t hash_together(const Values&... values) {
  ByteHash hash;
  const auto add = [&hash](const auto& value) {
    const std::uint64_t part = hash_fields(value);
    hash.add(&part, sizeof part);
  };
  (add(values), ...);
  return hash.value();
}

/// What a scene says of a body that acts on every step: its shape, its mass, and how it may move.
std::uint64_t hash_of(const PlacedShape& body) {
  const BodySettings& settings = *body.settings;
  const BodyShape& shape = *body.shape;
  const std::uint64_t own = hash_together(settings.id, settings.drive, settings.freedoms.along, settings.freedoms.about,
                                          settings.free_from, settings.hold, settings.open);
  const std::uint64_t form = hash_together(shape.mesh.vertices, shape.samples, shape.inset);
  if (is_free(settings.drive)) return hash_together(own, form, body_mass(settings.mass, shape.solid));
  if (settings.drive != BodyDrive::kStatic) return hash_together(own, form);
  return hash_together(own, form, settings.position, settings.orientation);
}

std::vector<std::uint64_t> hashes_of_bodies(const Bodies& bodies) {
  std::vector<std::uint64_t> hashes;
  for (const PlacedShape& body : bodies.placed()) hashes.push_back(hash_of(body));
  return hashes;
}

std::uint64_t hash_of_oil(const std::optional<OilSettings>& oil) {
  if (!oil) return 0;
  const OilProperties& p = oil->properties;
  return hash_together(std::array{p.density, p.viscosity, p.api_gravity, p.most_water_content, oil->water_temperature},
                       std::array{p.refined ? 1 : 0, oil->evaporation ? 1 : 0, oil->emulsification ? 1 : 0}, oil->model,
                       oil->most_particles);
}

}  // namespace

SceneParts World::scene_parts() const {
  const FluidParameters& p = fluid_.parameters;
  const OpenSeaSettings& open = scene_.open_sea;
  const auto walls = fluid_.walls.position.begin();
  return {{"seed", hash_together(scene_.seed)},
          {"frame rate", hash_together(scene_.frame_interval, scene_.frame_times)},
          {"gravity", hash_together(scene_.gravity)},
          {"particle spacing", hash_together(std::array{scene_.particle_spacing, p.support_radius})},
          {"water", hash_together(std::array{p.viscosity, p.filter, p.rest_density})},
          {"solver", hash_together(p.scheme)},
          {"patch", hash_together(scene_.patch_edges, scene_.patch.min, scene_.patch.max)},
          {"open sea", hash_together(std::array{open.zone_width, open.depth}, open.follow_body, open.follow_velocity)},
          {"sea bed", hash_together(open.bed.heights.height, open.bed.blend_width)},
          {"walls", hash_together(std::vector(walls, walls + static_cast<std::ptrdiff_t>(fluid_.static_walls)))},
          {"bodies", hash_together(hashes_of_bodies(bodies_))},
          {"oil", hash_of_oil(scene_.oil)}};
}

}  // namespace pelagos
