#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "physics/fluid.hpp"
#include "simulation/bodies.hpp"
#include "simulation/current_drive.hpp"
#include "simulation/frame_clock.hpp"
#include "simulation/oil_spill.hpp"
#include "simulation/probes.hpp"
#include "simulation/water_surface.hpp"
#include "simulation/world_state.hpp"
#include "surface/surface_extractor.hpp"
#include "values/command.hpp"
#include "values/effort.hpp"
#include "values/scene.hpp"
#include "values/scene_info.hpp"
#include "values/snapshot.hpp"
#include "wind/wind.hpp"

namespace pelagos {

struct WorldOptions {
  int threads = 1;        ///< that advance the world, >= 1
  Clock clock = nullptr;  ///< for the profile of the stages; null: none is kept
  /// Called now and then while the start is relaxed, with the part done, 0..1; false ends the relaxation early.
  std::function<bool(double)> progress;
};

/// What became of values that are not finite.
enum class StepFault {
  kNone,
  kRestored,  ///< there were some; the state before the step is back, and smaller steps are made for a while
  kFatal,     ///< there are some, and nothing is left to try
};

/// A step and whether it reached a frame. After a restored fault the report tells of the step that failed.
struct WorldStep {
  StepReport report;
  bool frame_reached = false;
  StepFault fault = StepFault::kNone;
};

/// A scene in motion: water, walls, bodies, wind, current and time. No I/O beyond the mesh files read at the start.
/// The same scene, seed, poses and commands at the same steps give the same bits for any number of threads.
class World {
 public:
  /// Throws std::invalid_argument naming what is wrong with which body, one a line.
  World(const Scene& scene, const WorldOptions& options);

  /// Advances by one step, no further than the next frame. Where the scene asks for it (FaultPolicy::kRestore), a step
  /// that ends with values that are not finite is taken back, and the next second of simulated time is made with half
  /// the step (a quarter after a second fault); a third fault before such a second is over is fatal.
  WorldStep advance();

  /// Takes a validated pose; false if no body follows it.
  bool accept_pose(const BodyPose& pose) { return bodies_.accept(pose, clock_.time()); }

  /// Does what a command asks, from the next step on. Those that steer the clock (pause, resume, single steps) are for
  /// whoever advances the world and do nothing here. The scene's events are not applied by the world itself either.
  /// @return why it cannot be done, and then nothing has changed; nothing where it was done
  [[nodiscard]] std::optional<std::string> apply(const Command& command);
  void set_wind(const WindSettings& wind, double ramp_seconds);
  void clear_wind() { wind_.reset(); }
  [[nodiscard]] std::optional<WindSettings> wind() const;
  /// The air as it moves now and from now on, to be asked anywhere; nothing without wind.
  [[nodiscard]] std::optional<Air> air() const;

  /// Along periodic axes the water follows (see CurrentDrive); along the others only what drifts is carried.
  void set_current(const CurrentSettings& current, double ramp_seconds);
  /// Nothing drifts any more; water that moves is slowed down for ten relaxation times, then left alone.
  void clear_current();
  /// As running now; nothing without one.
  [[nodiscard]] std::optional<CurrentSettings> current() const;
  /// For x, y: whether the water itself moves with a current.
  [[nodiscard]] const std::array<bool, 2>& current_moves_water() const { return drive_.moves_water(); }
  /// m/s at `position` (m, world) and `time` (s, simulated): zero without a current. What drifts starts here: things
  /// that go with the air and the sea as a whole take `current_at`; things that already move with the water around them
  /// (slicks, booms, floating bodies) add `unresolved_current_at`, the part that this water does not make itself. For
  /// many positions, copy `current_field()` once a step: it is a small value with the same questions.
  [[nodiscard]] Eigen::Vector3d current_at(const Eigen::Vector3d& position, double time) const {
    return current_.running ? current_.running->velocity_at(position, time) : Eigen::Vector3d::Zero();
  }
  [[nodiscard]] Eigen::Vector3d unresolved_current_at(const Eigen::Vector3d& position, double time) const {
    return current_.running ? current_.running->unresolved_velocity_at(position, time) : Eigen::Vector3d::Zero();
  }
  [[nodiscard]] const std::optional<Current>& current_field() const { return current_.running; }

  /// What the coming steps may cost. The scene's own until it is set; warm starts and states are kept.
  void set_effort(const Effort& effort);
  [[nodiscard]] Effort effort() const;

  /// Fills time, frame, origin, bodies and the particles that travel. Its cost is a stage of the last step.
  void fill_snapshot(Snapshot& snapshot, StepReport& report);

  /// All that the future depends on: a copy. `restore` goes on from it, with the same bits.
  [[nodiscard]] WorldState state() const;
  /// Whether a state can be one of this world's scene: as many bodies, oil where the scene has it.
  [[nodiscard]] bool accepts(const WorldState& state) const;
  /// Goes on from a state of a world of the same scene.
  void restore(const WorldState& state);
  /// Of the settings and samples that the scene has made: worlds of which it differs have other states.
  [[nodiscard]] std::uint64_t scene_hash() const;

  [[nodiscard]] SceneInfo describe() const;
  /// What whoever runs the scene should know about its start, one line each: what is allowed, but hardly meant.
  [[nodiscard]] const std::vector<std::string>& start_notes() const { return start_notes_; }
  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] double time() const { return clock_.time(); }  ///< s
  [[nodiscard]] std::uint64_t frame() const { return clock_.frame(); }
  [[nodiscard]] std::uint64_t step() const { return step_; }  ///< steps made so far
  [[nodiscard]] const FluidState& fluid() const { return fluid_; }
  [[nodiscard]] const Eigen::Vector3d& origin() const { return origin_; }  ///< m, world
  [[nodiscard]] const Bodies& bodies() const { return bodies_; }
  /// The waves around the patch.
  [[nodiscard]] const WaveField& sea() const { return sea_; }
  /// What the probes read now, by id.
  [[nodiscard]] std::vector<ProbeReading> read_probes() const;
  [[nodiscard]] std::vector<std::uint32_t> probe_ids() const { return probes_.ids(); }
  /// The oil; nothing in a scene without.
  [[nodiscard]] const std::optional<OilSpill>& spill() const { return spill_; }
  [[nodiscard]] double water_level() const { return water_level_; }  ///< m, world, at rest
  /// Kinetic and potential energy in J, the latter from the tank's floor.
  [[nodiscard]] double energy(const StepReport& report) const;
  [[nodiscard]] StepReport measure() const;  ///< of the present state, no step made

 private:
  friend struct WorldTestAccess;  // tests of faults put them into the water
  [[nodiscard]] double choose_time_step() const;
  void settle();
  void note_start();
  void start_current();
  void drive_current(double time, StepReport& report);
  [[nodiscard]] BodySea body_sea(double time) const;
  [[nodiscard]] std::optional<std::string> apply_to_oil(const OilCommand& command);
  void advance_oil(double dt, double time, StepReport& report);
  void keep_recovery_point();
  StepFault recover();

  Scene scene_;
  WorldOptions options_;
  std::unique_ptr<TaskPool> pool_;
  Eigen::Vector3d origin_;
  FrameClock clock_;
  Bodies bodies_;
  Probes probes_;
  FluidState fluid_;
  double water_level_ = 0.0;
  WaveField sea_;
  mutable WaterSurface water_surface_;  ///< of the particles as they are; mutable: it measures when asked
  std::optional<Wind> wind_;
  CurrentDrive drive_;
  CurrentState current_;
  std::optional<OilSpill> spill_;
  SurfaceExtractor surface_;
  double max_step_ = 0.0;
  double largest_speed_ = 0.0;
  std::uint64_t step_ = 0;
  std::optional<WorldState> recovery_;  ///< only where the scene asks for it
  std::vector<std::string> start_notes_;
  FaultState faults_;
};

}  // namespace pelagos
