#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "physics/fluid.hpp"
#include "rigid/body_contacts.hpp"
#include "rigid/body_shape.hpp"
#include "rigid/driven_body.hpp"
#include "rigid/free_body.hpp"
#include "simulation/body_drift.hpp"
#include "simulation/hold.hpp"
#include "simulation/load_meter.hpp"
#include "simulation/placed_shape.hpp"
#include "simulation/sea_push.hpp"
#include "simulation/water_surface.hpp"
#include "values/body.hpp"
#include "values/current.hpp"
#include "values/hold_reading.hpp"
#include "values/patch_frame.hpp"
#include "values/scene.hpp"
#include "values/scene_info.hpp"

namespace pelagos {

/// The sea that carries free bodies, at one instant.
struct BodySea {
  const Current* current = nullptr;  ///< null: none runs
  bool wind_drags = false;           ///< the wind drags the surface along as a real one does (WindLaw::kStress)
  double time = 0.0;                 ///< s
  double water_level = 0.0;          ///< m, world, at rest
  WaterSurface* surface = nullptr;   ///< never null in a world
};

/// What changes about a body.
struct BodyDynamics {
  BodyState state;
  std::optional<DrivenBody> driven;  ///< follows poses
  std::optional<FreeBody> free;      ///< is pushed; with `driven` too, that leads its place and heading
  LoadMeter meter;
  BodyDrift drift;
  Eigen::Vector2d drift_force = Eigen::Vector2d::Zero();  ///< N, of a current that the particles do not make
  bool held = false;                                      ///< free, but not yet

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("state", self.state);
    visit("driven", self.driven);
    visit("free", self.free);
    visit("meter", self.meter);
    visit("drift", self.drift);
    visit("drift_force", self.drift_force);
    visit("held", self.held);
  }
};

/// The sea's drift at the surface that bodies share, looked at now and then.
struct SurfaceDrift {
  bool acts = false;                                   ///< on some body
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< m/s, as last looked at
  double due = 0.0;                                    ///< s, when to look again

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("acts", self.acts);
    visit("velocity", self.velocity);
    visit("due", self.due);
  }
};

/// All that changes about the bodies of a world, in the order of the scene.
struct BodiesState {
  std::vector<BodyDynamics> bodies;
  ContactState contacts;
  SurfaceDrift drift;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("bodies", self.bodies);
    visit("contacts", self.contacts);
    visit("drift", self.drift);
  }
};

/// The rigid bodies of a world and what the water meets of them. The corrected solver meets the distance fields of
/// their surfaces (see physics/solids.hpp). Of bodies with thin plates, and with the other solvers, it meets boundary
/// samples: those of STATIC bodies among the walls that never move, the others among the moving ones.
class Bodies {
 public:
  Bodies() = default;

  /// Loads and samples all shapes, and looks whether each has its place (body_faults).
  /// @param faults  out: what is wrong with which body; then nothing can be used
  Bodies(TaskPool& pool, const Scene& scene, double support_radius, Refusals& faults);

  /// What a person should know of the bodies' meshes: cavities, parts that overlap (BodyShape::notes).
  [[nodiscard]] std::vector<std::string> mesh_notes() const;

  /// What viewers are told of a body's mesh; null for a primitive. Reads the file again, for its digest.
  [[nodiscard]] std::shared_ptr<const BodySurface> surface_of(std::uint32_t id) const;

  /// Where the scene puts them; valid as long as these bodies.
  [[nodiscard]] std::vector<PlacedShape> placed() const;

  [[nodiscard]] bool empty() const { return bodies_.empty(); }
  [[nodiscard]] std::size_t sample_count() const { return volumes_.size() + static_.size(); }
  [[nodiscard]] std::size_t moving_sample_count() const { return volumes_.size(); }

  /// The samples of STATIC bodies, local coordinates, V_b in w; those out of the water's reach, a support radius beyond
  /// the patch, are left out.
  [[nodiscard]] std::vector<Float4> static_samples(const PatchFrame& frame) const;

  /// The surfaces of STATIC bodies that the water meets by their distance.
  [[nodiscard]] std::vector<Solid> standing_solids(const PatchFrame& frame) const;

  /// Whether a point (m, world) is inside a hull or closer to it than `clearance`.
  [[nodiscard]] bool covers(const Eigen::Vector3d& point, double clearance) const;

  /// Whether no particle of water starts at a point (m, world): inside a hull, or nearer to one whose samples the water
  /// meets than they have to stand.
  [[nodiscard]] bool leaves_no_room(const Eigen::Vector3d& point, double spacing) const;

  /// Of each body, in order: the distance of a point (m, world) to its surface, m, negative inside; no farther than
  /// +-limit.
  void signed_distances(const Eigen::Vector3d& point, double limit, std::vector<double>& each) const;

  /// Whether a point (m, world) lies in a hold that starts dry: no water starts there.
  [[nodiscard]] bool keeps_dry(const Eigen::Vector3d& point) const;
  /// The holds, with the water that was in them when loads were last taken.
  [[nodiscard]] std::vector<HoldReading> holds() const;
  /// Counts the water in the holds; `take_loads` does it too.
  void measure_holds(const PatchFrame& frame, const FluidState& fluid);
  /// What becomes of the holds at the start, one line for each that water could stand in.
  /// @param level  m, world: of the water at rest
  [[nodiscard]] std::vector<std::string> hold_notes(double level) const;

  /// Free bodies whose convex hull, as which they touch others, is much larger than their mesh, one a line.
  [[nodiscard]] std::vector<std::string> contact_notes() const;

  /// Takes a validated pose. False if no body follows poses under its id or it is not newer than the last one.
  bool accept(const BodyPose& pose, double now);

  /// Moves all bodies from `now` to `now + dt`, free ones as they would go without the water's push, and places their
  /// samples. Water that a jumping body lands on is carried to where that body was: nothing is lost, nothing is
  /// trapped.
  /// @param around  the sea beyond open edges at the end of the step, which carries what is out of the particles'
  /// reach (sea_push.hpp); null: all edges are closed
  void advance(double now, double dt, const PatchFrame& frame, const CarryingSea* around, FluidState& fluid);

  /// m, world: the boxes around the bodies that are not wholly where particles alone carry them.
  [[nodiscard]] std::vector<Eigen::AlignedBox3d> boxes_at_edges(const PatchFrame& frame,
                                                                const CouplingFade& fade) const;

  /// After the water's step of dt: free bodies take its push and keep out of each other, of scenery and of walls; loads
  /// are metered.
  void receive(double dt, const FluidState& fluid);

  /// After the water's step of dt, before `receive`: free bodies in the water are carried by the part of a current that
  /// the particles do not make (BodyDrift). Not those that follow poses, in whole or in part: their poses say how they
  /// drift. Costs nothing without such a part.
  void drift(double dt, const BodySea& at, FluidState& fluid);

  /// At a scene's start, where the sea has its current at once: what floats has it too, beside its own velocity.
  void start_drift(const Current& current, double time, double water_level, double rest_density);

  /// At a scene's start: what floats on the sea beyond open edges has the motion of its waves, beside its own velocity.
  void start_at_sea(const PatchFrame& frame, const CouplingFade& fade, const CarryingSea& around);

  /// What the water did to each body that moves or may move, averaged since the last call.
  /// The surface that tells what still water would do is the particles' alone, for they make the loads; around bodies
  /// that the sea beyond open edges carries, in part or as a whole, it is the sea's and the particles'.
  [[nodiscard]] std::vector<BodyLoad> take_loads(const PatchFrame& frame, const FluidState& fluid,
                                                 WaterSurface& surface, const CarryingSea* around, double still_level);

  /// Whether all places and velocities are numbers.
  [[nodiscard]] bool finite() const;

  /// Places the samples of the present states; once before the first step.
  void place(const PatchFrame& frame, FluidState& fluid) const;

  /// Largest speed of any sample, m/s: the time step must respect it.
  [[nodiscard]] double largest_speed() const;

  [[nodiscard]] std::vector<BodyState> states() const;
  /// Nothing where no body has that id.
  [[nodiscard]] std::optional<BodyState> state_of(std::uint32_t id) const;

  [[nodiscard]] BodiesState state() const;
  /// Whether these can be states of these bodies.
  [[nodiscard]] bool accepts(const BodiesState& state) const;
  /// Goes on from a state of bodies of the same scene.
  void restore(const BodiesState& state, const PatchFrame& frame, FluidState& fluid);

 private:
  struct Body : BodyDynamics {
    BodySettings settings;
    BodyShape shape;
    std::size_t first_sample = 0;                           ///< among the moving ones
    std::vector<std::shared_ptr<const SolidField>> fields;  ///< of its surface; empty: the water meets its samples
    std::size_t hull = 0;                                   ///< in `contacts_`, where there are any
    Hold hold;
    PartVolume hold_water;                    ///< when loads were last taken
    std::optional<SeaBody> sea_body;          ///< of what moves in a patch with open edges
    Vector6d sea_impulse = Vector6d::Zero();  ///< N s, N m s, of the sea around in this step

    [[nodiscard]] bool moves() const { return driven || free; }
    [[nodiscard]] bool gives_way() const { return free && !held; }
    /// Samples among the moving ones.
    [[nodiscard]] std::size_t sample_count() const { return moves() && fields.empty() ? shape.samples.size() : 0; }
    [[nodiscard]] bool drifts() const { return gives_way() && !driven; }
  };
  struct StaticSample {
    Eigen::Vector3d position;  ///< m, world
    float volume;              ///< V_b, m^3
  };
  void make_contacts(const Scene& scene);
  [[nodiscard]] Refusals contact_faults(const Scene& scene);
  /// A body as the water's solves see it: a driven one about its origin, and it gives way to nothing.
  [[nodiscard]] static CoupledBody coupled_body(const Body& body, const PatchFrame& frame);
  /// Adds the body's fields to solids.
  /// @param coupled  index of its coupled body, or -1
  static void place_fields(const Body& body, const PatchFrame& frame, std::int32_t coupled, std::vector<Solid>& solids);
  void open_hold(const Scene& scene, Body& body) const;
  void touch(double dt);
  void make_sea_bodies(double density);
  [[nodiscard]] SeaLoad sea_load(const Body& body, const PatchFrame& frame, const CouplingFade& fade,
                                 const CarryingSea& around);
  /// Whether particles alone carry it.
  [[nodiscard]] static bool is_inside(const Body& body, const PatchFrame& frame, const CouplingFade& fade);
  void feel_sea(double dt, const PatchFrame& frame, const CouplingFade& fade, const CarryingSea& around, Body& body);
  [[nodiscard]] DriftSea sea_of(const Body& body, double time, const Current& current, double water_level) const;
  void place_contacts();
  void add_surface(TaskPool& pool, const Scene& scene, double support_radius, Body& body);
  void add_samples(TaskPool& pool, const Scene& scene, double support_radius, Body& body);
  void relocate_water(const Body& body, const BodyState& before, const PatchFrame& frame, FluidState& fluid) const;

  double spacing_ = 0.0;
  std::vector<Body> bodies_;
  std::vector<float> volumes_;  ///< V_b of the moving samples, m^3
  std::vector<StaticSample> static_;
  std::optional<BodyContacts> contacts_;  ///< only where a body is free
  SurfaceDrift surface_drift_;
  SeaLoader sea_loader_;
};

}  // namespace pelagos
