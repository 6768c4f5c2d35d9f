#include "simulation/state_file.hpp"

#include <fmt/format.h>

#include <cstring>

#include "fields/field_bytes.hpp"
#include "fields/field_hash.hpp"
#include "version/version.hpp"

namespace pelagos {

namespace {

constexpr std::array<char, 8> kMark = {'P', 'E', 'L', 'A', 'G', 'O', 'S', 3};
constexpr std::size_t kSizeAt = 8, kHashAt = 16, kLayoutAt = 24, kHeader = 32;

std::uint64_t hash_of(std::span<const std::byte> bytes) {
  ByteHash hash;
  hash.add(bytes.data(), bytes.size());
  return hash.value();
}

std::uint64_t number_at(std::span<const std::byte> file, std::size_t place) {
  std::uint64_t number = 0;
  std::memcpy(&number, file.data() + place, sizeof number);
  return number;
}
void put_number(std::span<std::byte> file, std::size_t place, std::uint64_t number) {
  std::memcpy(file.data() + place, &number, sizeof number);
}

Refusal refuse(const std::string& what, const std::string& allowed) {
  return {"state file", what + "; allowed: " + allowed};
}

/// What is wrong with a file as bytes.
std::optional<Refusal> find_file_fault(std::span<const std::byte> file) {
  if (file.size() < kHeader)
    return refuse(fmt::format("it has {} bytes", file.size()),
                  fmt::format("a whole file, of at least {} bytes", kHeader));
  if (std::memcmp(file.data(), kMark.data(), kMark.size() - 1) != 0)
    return refuse("it does not begin with PELAGOS", "a file that a Pelagos server has saved");
  if (std::memcmp(file.data(), kMark.data(), kMark.size()) != 0)
    return refuse(fmt::format("its format is {}", static_cast<int>(file[kMark.size() - 1])),
                  fmt::format("format {}", static_cast<int>(kMark.back())));
  const std::uint64_t size = number_at(file, kSizeAt);
  if (size != file.size())
    return refuse(fmt::format("it has {} bytes and was saved with {}", file.size(), size), "the whole file, unchanged");
  if (hash_of(file.subspan(kLayoutAt)) != number_at(file, kHashAt))
    return refuse("its checksum is wrong: it was changed after it was saved", "the file as it was saved");
  return std::nullopt;
}

std::optional<Refusal> find_origin_fault(const StateOrigin& saved, const StateOrigin& now) {
  const auto differs = [](const char* what, const std::string& then, const std::string& here) {
    return refuse(fmt::format("it is of {} {}", what, then), fmt::format("{} {}, that of this run", what, here));
  };
  if (saved.version != now.version) return differs("version", saved.version, now.version);
  if (saved.instruction_set != now.instruction_set)
    return differs("instruction set", saved.instruction_set, now.instruction_set);
  if (saved.scene != now.scene) return differs("scene", saved.scene, now.scene);
  if (const std::string other = other_parts(saved.scene_parts, now.scene_parts); !other.empty())
    return refuse(fmt::format("it is of a scene {} that differs in: {}", saved.scene, other),
                  "the scene as it was when the state was saved");
  return std::nullopt;
}

}  // namespace

StateOrigin state_origin(const World& world) {
  return {kVersion, instruction_set(), world.scene().name, world.scene_parts()};
}

std::vector<std::byte> save_state(const World& world) {
  const WorldState state = world.state();
  FieldWriter writer;
  constexpr std::size_t kBytesPerParticle = 72;
  writer.reserve((state.water.particles.count + 1000) * kBytesPerParticle);
  writer.scalars(std::span<const char>(kMark));
  for (int k = 0; k < 2; ++k) writer.size(0);
  writer.size(layout_hash<WorldState>());
  walk_fields(state_origin(world), writer);
  walk_fields(state, writer);
  std::vector<std::byte> file = writer.take();
  put_number(file, kSizeAt, file.size());
  put_number(file, kHashAt, hash_of(std::span(file).subspan(kLayoutAt)));
  return file;
}

std::optional<Refusal> load_state(std::span<const std::byte> file, World& world) {
  if (auto fault = find_file_fault(file)) return fault;
  FieldDecoder reader(file.subspan(kHeader));
  StateOrigin saved;
  WorldState state;
  try {
    reader.read(saved);
    if (auto fault = find_origin_fault(saved, state_origin(world))) return fault;
    if (number_at(file, kLayoutAt) != layout_hash<WorldState>())
      return refuse("its fields are not those of this build", "a file that this build has saved");
    reader.read(state);
    reader.finish();
  } catch (const DecodeFault& fault) {
    return refuse(fault.what(), "a file that this build has saved");
  }
  if (!world.accepts(state))
    return refuse("its bodies, its oil or its sea are not those of the scene", "a state of this scene");
  world.restore(state);
  return std::nullopt;
}

}  // namespace pelagos
