#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "simulation/world.hpp"
#include "text/refusal.hpp"

namespace pelagos {

/// What a state belongs to: bits are the same only where all of it is.
struct StateOrigin {
  std::string version;          ///< of the server
  std::string instruction_set;  ///< of the physics
  std::string scene;            ///< name
  SceneParts scene_parts;       ///< what the scene has made of water, walls and bodies

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("version", self.version);
    visit("instruction_set", self.instruction_set);
    visit("scene", self.scene);
    visit("scene_parts", self.scene_parts);
  }
};

/// That of this build, this machine and a world.
[[nodiscard]] StateOrigin state_origin(const World& world);

/// A state as a file:
///   bytes 0 to 7    "PELAGOS" and the format's number, 3
///   bytes 8 to 15   size of the whole file, bytes
///   bytes 16 to 23  XXH3 of all that follows
///   bytes 24 to 31  hash of the names and types of the state's fields
///   then the origin and the state, each field as fields/field_bytes.hpp writes it
/// Numbers are in the byte order of this machine.
[[nodiscard]] std::vector<std::byte> save_state(const World& world);

/// Puts the world into a saved state. A file that is cut off or changed, or of another version, instruction set or
/// scene is refused, and then nothing has changed.
/// @return why it is refused, with what is allowed; nothing where it was done
[[nodiscard]] std::optional<Refusal> load_state(std::span<const std::byte> file, World& world);

}  // namespace pelagos
