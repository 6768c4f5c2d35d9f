#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "physics/water_step.hpp"
#include "simulation/bodies.hpp"
#include "simulation/current_drive.hpp"
#include "simulation/edge_watch.hpp"
#include "simulation/frame_clock.hpp"
#include "simulation/oil_spill.hpp"
#include "simulation/open_sea.hpp"
#include "simulation/probes.hpp"
#include "simulation/rim_gaps.hpp"
#include "simulation/scene_sea.hpp"
#include "simulation/surface_query.hpp"
#include "simulation/water_surface.hpp"
#include "simulation/world_state.hpp"
#include "surface/surface_extractor.hpp"
#include "values/command_surroundings.hpp"
#include "values/effort.hpp"
#include "values/given_names.hpp"
#include "values/patch_frame.hpp"
#include "values/scene.hpp"
#include "values/scene_info.hpp"
#include "values/scene_parts.hpp"
#include "values/snapshot.hpp"
#include "values/step_inputs.hpp"
#include "wind/wind.hpp"

namespace pelagos {

class World;

struct WorldOptions {
  int threads = 1;        ///< that advance the world, >= 1
  Clock clock = nullptr;  ///< for the profile of the stages; null: none is kept
  /// Called now and then while the start is relaxed, with the part done, 0..1; false ends the relaxation early.
  std::function<bool(double)> progress;
  /// Called once, before the start is relaxed: all but the water's motion is as it will be at the first step.
  std::function<void(const World&)> placed = {};
  /// The scene's sea, where the caller has made it; else it is made.
  std::optional<SceneSea> sea = {};
};

/// What became of values that are not finite.
enum class StepFault {
  kNone,
  kRestored,  ///< there were some; the state before the step is back, and smaller steps are made for a while
  kFatal,     ///< there are some, and nothing is left to try
};

/// What became of a command: `done` is what took effect, with all that it left out, unless it was refused.
struct CommandOutcome {
  Command done;
  std::optional<Refusal> refusal;
};

/// A step and whether it reached a frame. After a restored fault the report tells of the step that failed.
struct WorldStep {
  std::vector<CommandOutcome> outcomes;  ///< of the commands, in their order
  StepReport report;
  bool frame_reached = false;
  bool sea_renewed = false;  ///< the wind has changed the sea: its waves are others from now on
  StepFault fault = StepFault::kNone;
};

/// A scene in motion: water, walls, bodies, wind, current and time. No I/O beyond the mesh files read at the start.
/// The same scene, seed and inputs of the same steps give the same bits for any number of threads.
class World {
 public:
  /// Throws std::invalid_argument naming what is wrong with which body, one a line.
  World(const Scene& scene, const WorldOptions& options);

  /// Advances by one step, no further than the next frame. Where the scene asks for it (FaultPolicy::kRestore), a step
  /// that ends with values that are not finite is taken back, and the next second of simulated time is made with half
  /// the step (a quarter after a second fault); a third fault before such a second is over is fatal.
  WorldStep advance(const StepInputs& inputs = {});

  /// Takes the inputs without a step, while time stands still: the next step starts from them. Poses that no body
  /// follows, or that are not newer than the last, change nothing. Commands that steer the clock (pause, resume, single
  /// steps) are for whoever advances the world and do nothing here; the scene's events come in as inputs too.
  std::vector<CommandOutcome> take(const StepInputs& inputs);

  [[nodiscard]] std::optional<WindSettings> wind() const;
  /// The air as it moves now and from now on, to be asked anywhere; nothing without wind.
  [[nodiscard]] std::optional<Air> air() const;

  /// As running now; nothing without one. Along periodic axes the water follows it (see CurrentDrive), along the others
  /// only what drifts is carried. Where it is cleared, water that moves is slowed down for ten relaxation times.
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
  [[nodiscard]] Effort effort() const;

  /// Takes the frame that the last step has reached: time, bodies, loads since the frame before, probes, oil, and the
  /// particles that travel. Foam goes on with it. Its cost is a stage of the last step.
  void take_frame(Snapshot& snapshot, StepReport& report);
  /// The sea as it is, for whoever looks at it while no step is made: nothing goes on. Costs a search of neighbours.
  void look(Snapshot& snapshot) const;

  /// All that the future depends on: a copy. `restore` goes on from it, with the same bits.
  [[nodiscard]] WorldState state() const;
  /// Whether a state can be one of this world's scene: as many bodies, oil where the scene has it, a sea.
  [[nodiscard]] bool accepts(const WorldState& state) const;
  /// Goes on from a state of a world of the same scene.
  void restore(const WorldState& state);
  /// A hash of each part of what the scene has made, by its name. States of worlds of which one differs do not fit.
  [[nodiscard]] SceneParts scene_parts() const;

  [[nodiscard]] SceneInfo describe() const;
  /// What whoever runs the scene should know about its start, one line each: what is allowed, but hardly meant.
  [[nodiscard]] const std::vector<std::string>& start_notes() const { return start_notes_; }
  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] double time() const { return clock_.time(); }  ///< s
  [[nodiscard]] std::uint64_t frame() const { return clock_.frame(); }
  [[nodiscard]] std::uint64_t step() const { return step_; }  ///< steps made so far
  /// Steps that ended with values that are not finite and were taken back.
  [[nodiscard]] std::uint64_t restored_faults() const { return faults_.restored; }
  [[nodiscard]] const FluidState& fluid() const { return fluid_; }
  [[nodiscard]] const PatchFrame& patch() const { return frame_; }  ///< m, world
  [[nodiscard]] const Bodies& bodies() const { return bodies_; }
  /// The waves around the patch.
  [[nodiscard]] const WaveField& sea() const { return sea_; }
  /// The sea that there is, or that is blended into, as it was asked for; nothing where that was not by systems.
  [[nodiscard]] const std::optional<SeaRequest>& sea_request() const { return sea_request_; }
  /// What the probes read now, by id.
  [[nodiscard]] std::vector<ProbeReading> read_probes() const;
  /// For queries of the surface (see answer_query): the sea around now, a copy, and what the particles make of the
  /// surface at places (m, world), dry where the waves alone count. Nothing changes by either.
  [[nodiscard]] SeaAround sea_around() const;
  [[nodiscard]] std::vector<SurfaceReading> read_particles(std::span<const Eigen::Vector2d> places) const;
  /// What bears a name that commands may speak of.
  [[nodiscard]] GivenNames names() const;
  /// The oil; nothing in a scene without.
  [[nodiscard]] const std::optional<OilSpill>& spill() const { return spill_; }
  /// How well the water follows the wave field; nothing where no edge is open.
  [[nodiscard]] std::optional<EdgeQuality> edge_quality() const;
  [[nodiscard]] double water_level() const { return water_level_; }  ///< m, world, at rest
  /// Kinetic and potential energy in J, the latter from the patch's floor.
  [[nodiscard]] double energy(const StepReport& report) const;
  [[nodiscard]] StepReport measure() const;  ///< of the present state, no step made

 private:
  World(const Scene& scene, const WorldOptions& options, const SceneSea& sea);
  friend struct WorldTestAccess;  // tests of faults put them into the water
  [[nodiscard]] double choose_step() const;
  [[nodiscard]] CommandOutcome apply(const Command& command);
  [[nodiscard]] std::optional<Refusal> apply_valid(const Command& command);
  [[nodiscard]] std::optional<Refusal> set_wind(const SetWind& command);
  [[nodiscard]] std::optional<Refusal> exchange_sea(std::vector<WaveComponent> waves, double blend_seconds,
                                                    std::optional<SeaRequest> request);
  [[nodiscard]] std::optional<Refusal> set_sea(const SetSea& command);
  void choose_filter();
  /// @return whether the waves around are others from now on
  bool grow_sea();
  void set_current(const CurrentSettings& current, double ramp_seconds);
  void clear_current();
  void set_effort(const Effort& effort);
  [[nodiscard]] WaterStepParts step_parts(double time, double dt);
  void settle();
  void note_start();
  void start_current();
  void give_edges(double now, double dt, StepReport& report);
  void draw_edges(double now, double dt, StepReport& report);
  void renew_edges();
  void follow(double dt);
  void keep_rim_clear(double dt);
  [[nodiscard]] std::optional<CarryingSea> carrying_sea(double time) const;
  void move_patch(const PatchFrame& frame);
  void refill_patch();
  [[nodiscard]] Eigen::Vector2d followed_place() const;
  void blow(double time, StepReport& report);
  void drive_current(double time, StepReport& report);
  [[nodiscard]] BodySea body_sea(double time) const;
  [[nodiscard]] std::optional<Refusal> apply_to_oil(const OilCommand& command);
  void advance_oil(double dt, double time, StepReport& report);
  void keep_recovery_point();
  void copy_what_inputs_change(WorldState& state) const;
  void fill(Snapshot& snapshot) const;
  StepFault recover();

  Scene scene_;
  CommandSurroundings around_;
  WorldOptions options_;
  std::unique_ptr<TaskPool> pool_;
  PatchFrame frame_;
  FrameClock clock_;
  Bodies bodies_;
  Probes probes_;
  std::optional<OpenSea> open_sea_;  ///< where edges are open
  EdgeWatch edge_watch_;
  RimGaps rim_gaps_;
  FluidState fluid_;
  std::size_t free_particles_ = 0;  ///< at the start: not held
  double water_level_ = 0.0;
  WaveField sea_;
  std::optional<SeaRequest> sea_request_;
  std::optional<GrowingSea> growing_sea_;
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
