#include "run_parts.hpp"

#include "fields/field_hash.hpp"

namespace pelagos {

namespace {

struct AddHash {
  template <class T>
  void operator()(const char* name, const T& value) {
    parts[name + std::string(" at the start")] = hash_fields(value);
  }
  SceneParts& parts;
};

}  // namespace

SceneParts run_parts(const World& world) {
  SceneParts parts = world.scene_parts();
  const WorldState state = world.state();
  AddHash add{parts};
  WorldState::visit_fields(state, add);
  return parts;
}

}  // namespace pelagos
