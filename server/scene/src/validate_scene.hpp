#pragma once

#include <filesystem>
#include <vector>

#include "messages/field_reader.hpp"
#include "scene/read_scene.hpp"
#include "values/command_surroundings.hpp"

namespace pelagos {

/// Where a scene came from and where its meshes may be.
struct SceneSource {
  std::string default_name;
  std::vector<std::filesystem::path> mesh_folders;  ///< in the order of search
  bool check_meshes = true;
  std::optional<double> particle_spacing;  ///< instead of the file's
};

/// The first place that has a file which a field names: beside the scene, then in the asset folders. Notes a fault
/// where none has. @return as written where files need not be there
[[nodiscard]] std::string find_asset(const FieldReader& reader, const char* field, const std::string& written,
                                     const SceneSource& source);

/// What later checks need to know of earlier fields; empty where those were faulty.
struct Basis {
  std::optional<double> spacing;
  std::optional<double> gravity;
  std::optional<double> default_step;  ///< s, 0.07 sqrt(d/g)
  double support_radius = 2.0;         ///< spacings
};

/// Particles of all blocks together.
inline constexpr double kMostParticles = 4e6;

/// A Box field, both corners required, min below max; none if it is faulty.
[[nodiscard]] std::optional<Box> read_box(const FieldReader& reader);

/// Reads the `block` entries of all liquids: inside the patch, not overlapping, not too many particles in all.
class BlockReader {
 public:
  BlockReader(const Basis& basis, const std::optional<Box>& patch, const PatchEdges& edges)
      : spacing_(basis.spacing), patch_(patch), edges_(edges) {}

  /// @param name  of the liquid's field in the scene, for refusals of later blocks
  std::vector<Box> read(const FieldReader& liquid, const char* name);

 private:
  void place(const FieldReader& entry, std::string name, const Box& block);

  std::optional<double> spacing_;
  std::optional<Box> patch_;
  PatchEdges edges_;
  std::vector<std::pair<std::string, Box>> placed_;
  double total_ = 0.0;  ///< particles
};

/// The `oil` entry; none where the scene has none.
[[nodiscard]] std::optional<OilSettings> validate_oil(const FieldReader& scene_reader, double water_density,
                                                      BlockReader& blocks);

/// Reads every field of a Scene message; faults are noted in the reader. The scene may be used only if none was.
[[nodiscard]] Scene validate_scene(const FieldReader& reader, const SceneSource& source);

/// The `body` entries.
[[nodiscard]] std::vector<BodySettings> validate_bodies(const FieldReader& scene_reader,
                                                        const std::optional<Box>& patch, const PatchEdges& edges,
                                                        const SceneSource& source);

/// What a body's surface is made of: mesh_file and what goes with it, or shape. Its drive must be read already.
void read_surface_of_body(const FieldReader& body_reader, const SceneSource& source, BodySettings& body);

/// What events build on and have to fit.
struct EventSurroundings {
  std::optional<WindSettings> wind;             ///< the scene's
  std::optional<CommandSurroundings> commands;  ///< none where the patch is faulty
  std::vector<std::uint32_t> probes;            ///< ids
  bool weightless = false;                      ///< no wind can blow
};

/// The `event` entries, in their order; each builds on the scene and the events before its time.
[[nodiscard]] std::vector<SceneEvent> validate_events(const FieldReader& scene_reader, const EventSurroundings& around);

/// The `open_sea` entry, and what open edges ask of the rest of the scene, which must be read already.
void validate_open_sea(const FieldReader& scene_reader, const SceneSource& source, Scene& scene);
/// The `open_sea.bed` entry; the rest of `open_sea` must be read already.
void read_sea_bed(const FieldReader& bed_reader, const SceneSource& source, Scene& scene);

/// The `solver` entry.
[[nodiscard]] SolverSettings validate_solver(const FieldReader& scene_reader);
/// The `time_step` entry; also whether there is a time scale at all.
[[nodiscard]] TimeStepSettings validate_time_step(const FieldReader& scene_reader, const Basis& basis);
/// The `governor` entry, checked against the scene's frame interval, solver and time step.
[[nodiscard]] GovernorSettings validate_governor(const FieldReader& scene_reader, const Basis& basis,
                                                 const Scene& scene);

}  // namespace pelagos
