#include "simulation/world.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "fields/field_hash.hpp"
#include "mirrored_faces.hpp"
#include "physics/water_step.hpp"
#include "scales/scales.hpp"
#include "simulation/enclosed_waters.hpp"
#include "simulation/fluid_setup.hpp"
#include "slanted_faces.hpp"
#include "version/version.hpp"
#include "wind_surroundings.hpp"

namespace pelagos {

namespace {

/// After a numerical fault steps are shorter for so long, s of simulated time; so many faults before that end the run.
constexpr double kCarefulTime = 1.0;
constexpr int kMostFaults = 3;

constexpr std::size_t kMostNotes = 32;  ///< about the start

constexpr std::uint64_t kRenewalSteps = 32;  ///< between renewals of open edges
constexpr double kLongestLag = 0.25;         ///< of the patch's shorter side, that the patch catches up by moving
constexpr int kSettleChunk = 10;             ///< steps between reports of progress

Bodies make_bodies(TaskPool& pool, const Scene& scene) {
  Refusals faults;
  Bodies bodies(pool, scene, fluid_parameters(scene, patch_frame(scene)).support_radius, faults);
  if (faults.empty()) return bodies;
  std::string text;
  for (const Refusal& fault : faults) text += (text.empty() ? "" : "\n") + to_string(fault);
  throw std::invalid_argument(text);
}

std::optional<OpenSea> make_open_sea(const Scene& scene, const PatchFrame& frame) {
  const std::optional<OpenSeaShape> shape = open_sea_shape(scene, frame);
  return shape ? std::optional<OpenSea>(std::in_place, *shape) : std::nullopt;
}

StartingParticles place_water(TaskPool& pool, const Scene& scene, const Bodies& bodies, const PatchFrame& frame,
                              const std::optional<OpenSea>& open, const SceneSea& sea) {
  if (!open) return place_blocks(scene, bodies, frame);
  const WaveField around = sea.at_level(frame.world_height(open->shape().level));
  return place_open_sea(open->fill(pool, around, frame.origin.head<2>(), 0.0, largest_time_step(scene)),
                        scene.particle_spacing, bodies, frame);
}

FluidState make_start(TaskPool& pool, const Scene& scene, const Bodies& bodies, const PatchFrame& frame,
                      const std::optional<OpenSea>& open, const SceneSea& sea) {
  StartingParticles start = place_water(pool, scene, bodies, frame, open, sea);
  FluidParameters parameters = fluid_parameters(scene, frame);
  const std::vector<Solid> faces = take_slanted_faces(bodies.standing_solids(frame), parameters);
  FluidState fluid = make_fluid(pool, parameters, start.position, start.phase);
  fluid.solids = faces;
  fluid.face_count = faces.size();
  std::copy(start.velocity.begin(), start.velocity.end(), fluid.particles.velocity.begin());
  if (open) {
    fluid.particles.label = start.label;
    fluid.particles.label.resize(padded_count(fluid.particles.count));
    find_held(fluid);
    fluid.floor = open->shape().bed;  // for the settling
  }
  return fluid;
}

double start_level(TaskPool& pool, const Scene& scene, const Bodies& bodies, const FluidState& fluid,
                   const PatchFrame& frame, const std::optional<OpenSea>& open) {
  if (open) return frame.world_height(open->shape().level);
  return rest_level(pool, scene, bodies, std::span(fluid.particles.position).first(fluid.particles.count), frame);
}

/// Open edges blend into the sea around them; walls part the two.
PatchBlend blend_of(const std::optional<OpenSea>& open) {
  if (!open) return {};
  const Region& patch = open->shape().patch;
  return rim_blend(open->shape().spacing,
                   static_cast<double>(std::min(patch.max[0] - patch.min[0], patch.max[1] - patch.min[1])));
}

SurfaceInput surface_input(const FluidState& fluid, double time) {
  const bool solids = !fluid.solids.empty() && fluid.solid_planes.group.size() >= fluid.fluid_list.groups.size();
  return {fluid.particles, fluid.walls, fluid.fluid_list,
          fluid.wall_list, time,        solids ? &fluid.solid_planes : nullptr};
}

SurfaceScales surface_scales(const FluidParameters& parameters) {
  return {parameters.spacing, parameters.support_radius, parameters.gravity};
}

}  // namespace

World::World(const Scene& scene, const WorldOptions& options)
    : World(scene, options, options.sea ? *options.sea : make_scene_sea(scene)) {}

World::World(const Scene& scene, const WorldOptions& options, const SceneSea& sea)
    : scene_(scene),
      around_(command_surroundings(scene)),
      options_(options),
      pool_(std::make_unique<TaskPool>(std::max(1, options.threads))),
      frame_(patch_frame(scene)),
      clock_(scene.frame_interval),
      bodies_(make_bodies(*pool_, scene)),
      open_sea_(make_open_sea(scene, frame_)),
      fluid_(make_start(*pool_, scene, bodies_, frame_, open_sea_, sea)),
      free_particles_(fluid_.particles.count - fluid_.held.rows.size()),
      water_level_(start_level(*pool_, scene, bodies_, fluid_, frame_, open_sea_)),
      sea_(sea.at_level(water_level_)),
      sea_request_(sea.request),
      growing_sea_(sea.growing),
      water_surface_(*pool_, {frame_, fluid_.parameters.patch, blend_of(open_sea_)}),
      drive_(scene, frame_, water_level_, fluid_.particles.count),
      surface_(scene.surface, surface_scales(fluid_.parameters)),
      max_step_(largest_time_step(scene)) {
  options_.sea.reset();
  if (!bodies_.empty()) {
    add_static_walls(*pool_, fluid_, bodies_.static_samples(frame_));
    bodies_.place(frame_, fluid_);
  }
  if (open_sea_) fluid_.coupling.fade = open_sea_->coupling_fade();
  keep_rim_clear(max_step_);
  for (const ProbeSettings& probe : scene_.probes)
    if (const auto outcome = apply(SetProbe{probe}); outcome.refusal)
      throw std::invalid_argument("probe " + std::to_string(probe.id) + ": " + to_string(*outcome.refusal));
  if (scene_.wind) wind_.emplace(wind_surroundings(scene_, frame_, water_level_), *scene_.wind);
  if (scene_.current) set_current(*scene_.current, 0.0);
  if (scene_.oil) spill_.emplace(scene_, fluid_, frame_, water_level_);
  note_start();
  if (options_.placed) options_.placed(*this);
  choose_filter();
  settle();
  for (std::size_t i = 0; i < fluid_.particles.count; ++i)
    fluid_.particles.acceleration[i] = {0.0F, 0.0F, static_cast<float>(-scene_.gravity), 0.0F};
  if (scene_.current) start_current();
  if (std::optional<CarryingSea> around = carrying_sea(0.0)) {
    around->current = nullptr;  // start_current has given it
    bodies_.start_at_sea(frame_, fluid_.coupling.fade, *around);
    bodies_.place(frame_, fluid_);
  }
  keep_recovery_point();
}

void World::keep_recovery_point() {
  if (scene_.on_fault == FaultPolicy::kRestore) recovery_ = state();
}

StepFault World::recover() {
  if (!recovery_ || ++faults_.in_row == kMostFaults) return StepFault::kFatal;
  FaultState faults = faults_;
  const std::uint64_t made = step_;
  restore(*recovery_);
  step_ = made;
  faults.careful_until = clock_.time() + kCarefulTime;
  ++faults.restored;
  faults_ = faults;
  return StepFault::kRestored;
}

void World::note_start() {
  if (bodies_.empty()) return;
  bodies_.measure_holds(frame_, fluid_);
  start_notes_ = bodies_.hold_notes(water_level_);
  for (std::string& note : bodies_.contact_notes()) start_notes_.push_back(std::move(note));
  for (std::string& note :
       mirrored_face_notes(scene_, fluid_.parameters.support_radius, water_level_, bodies_.placed()))
    start_notes_.push_back(std::move(note));
  if (start_notes_.size() <= kMostNotes) return;
  const std::size_t more = start_notes_.size() - kMostNotes;
  start_notes_.resize(kMostNotes);
  start_notes_.push_back("and " + std::to_string(more) + " more of the same kinds");
}

void World::settle() {
  const int steps = scene_.water.settle_steps;
  if (steps == 0) {  // what looks at the start needs neighbours all the same
    StepReport report;
    refresh_neighbors(*pool_, fluid_, report);
  }
  for (int done = 0; done < steps; done += kSettleChunk) {
    settle_fluid(*pool_, fluid_, std::min(kSettleChunk, steps - done));
    if (options_.progress && !options_.progress(static_cast<double>(done) / steps)) return;
  }
}

WorldStep World::advance(const StepInputs& inputs) {
  WorldStep step;
  step.outcomes = take(inputs);
  step.sea_renewed = grow_sea();
  choose_filter();
  renew_edges();
  const double dt = choose_step();
  follow(dt);
  keep_rim_clear(dt);
  step.report = step_water(*pool_, fluid_, dt, options_.clock, step_parts(clock_.time(), dt));
  ++step_;
  if (step.report.not_finite > 0 || !bodies_.finite()) {
    step.fault = recover();
    if (step.fault == StepFault::kRestored) return step;
  }
  largest_speed_ = step.report.largest_speed;
  step.frame_reached = clock_.advance(dt, scene_.frame_times);
  if (step.fault == StepFault::kFatal) return step;
  if (clock_.time() >= faults_.careful_until) faults_.in_row = 0;
  keep_recovery_point();
  return step;
}

/// What acts on the water in the step from `now` on beside its own pressure; nothing for what the scene has not.
WaterStepParts World::step_parts(double now, double dt) {
  WaterStepParts parts;
  parts.place_bodies = [this, now, dt](StepReport& report) {
    give_edges(now, dt, report);
    if (bodies_.empty()) return;
    const StageScope scope(report.times, options_.clock, Stage::kBodies);
    const std::optional<CarryingSea> around = carrying_sea(now + dt);
    bodies_.advance(now, dt, frame_, around ? &*around : nullptr, fluid_);
  };
  parts.receive_bodies = [this, now, dt](StepReport& report) {
    water_surface_.forget();
    if (bodies_.empty()) return;
    const StageScope scope(report.times, options_.clock, Stage::kBodies);
    bodies_.drift(dt, body_sea(now + dt), fluid_);
    bodies_.receive(dt, fluid_);
  };
  parts.add_forces = [this, now, dt](StepReport& report) {
    draw_edges(now, dt, report);
    blow(now + dt, report);
    drive_current(now + dt, report);
    advance_oil(dt, now + dt, report);
  };
  return parts;
}

void World::give_edges(double now, double dt, StepReport& report) {
  if (!open_sea_) return;
  const StageScope scope(report.times, options_.clock, Stage::kEdges);
  open_sea_->give(*pool_, sea_, frame_.origin.head<2>(), now, dt, fluid_);
}

void World::draw_edges(double now, double dt, StepReport& report) {
  if (!open_sea_) return;
  const StageScope scope(report.times, options_.clock, Stage::kEdges);
  edge_watch_.add_zones(open_sea_->draw(*pool_, sea_, frame_.origin.head<2>(), now + dt, dt, fluid_), dt);
  if (step_ % kRenewalSteps == 0)
    edge_watch_.add_heights(
        open_sea_->shape(), water_surface_.grid(fluid_), open_sea_->moment(sea_, frame_.origin.head<2>(), now + dt),
        kRenewalSteps * dt, [this](const Eigen::Vector3d& place) {
          return !bodies_.empty() && bodies_.covers(frame_.to_world(place), scene_.particle_spacing);
        });
}

void World::renew_edges() {
  if (!open_sea_ || step_ % kRenewalSteps != 0 || step_ == 0) return;
  const Renewal renewal = open_sea_->renew(*pool_, free_particles_, fluid_);
  edge_watch_.count(renewal);
  if (renewal.deleted > 0) water_surface_.forget();
}

std::optional<EdgeQuality> World::edge_quality() const {
  if (!open_sea_) return std::nullopt;
  return edge_watch_.quality(open_sea_->shape(), fluid_.particles.count - fluid_.held.rows.size(), free_particles_,
                             open_sea_->moment(sea_, frame_.origin.head<2>(), clock_.time()));
}

/// Keeps the patch within a spacing of what it follows.
void World::follow(double dt) {
  if (!open_sea_ || !scene_.open_sea.follows()) return;
  const double d = scene_.particle_spacing;
  const Eigen::Vector2d lag = followed_place() - frame_.middle();
  if (lag.cwiseAbs().maxCoeff() > kLongestLag * (frame_.box.max - frame_.box.min).head<2>().minCoeff()) {
    const Eigen::Vector2d whole = d * (lag / d).array().round();
    move_patch(frame_.moved({whole.x(), whole.y(), 0.0}));
    return refill_patch();
  }
  for (int axis = 0; axis < 2; ++axis) {
    if (std::abs(lag[axis]) < d) continue;
    const int way = lag[axis] > 0.0 ? 1 : -1;
    move_patch(frame_.moved(way * d * Eigen::Vector3d::Unit(axis)));
    edge_watch_.count(open_sea_->shift(*pool_, sea_, frame_.origin.head<2>(), clock_.time(), dt,
                                       static_cast<std::size_t>(axis), way, fluid_));
    rim_gaps_.shift(*open_sea_, static_cast<std::size_t>(axis), way);
  }
}

/// Hulls in the rim put its water out; it comes back behind them.
void World::keep_rim_clear(double dt) {
  if (!open_sea_ || bodies_.empty()) return;
  const std::vector<Eigen::AlignedBox3d> boxes = bodies_.boxes_at_edges(frame_, fluid_.coupling.fade);
  if (boxes.empty() && rim_gaps_.empty()) return;
  const HullsAtRim hulls{boxes, [this](const Eigen::Vector3f& local) {
                           const Eigen::Vector3d x = frame_.to_world(Eigen::Vector3d(local.cast<double>()));
                           return is_in_hull(bodies_, x, scene_.particle_spacing);
                         }};
  const RimMotion motion{open_sea_->moment(sea_, frame_.origin.head<2>(), clock_.time()),
                         open_sea_->moment(sea_, frame_.origin.head<2>(), clock_.time() + 0.5 * dt)};
  if (rim_gaps_.renew(*pool_, *open_sea_, frame_, hulls, motion, fluid_)) water_surface_.forget();
}

std::optional<CarryingSea> World::carrying_sea(double time) const {
  if (!open_sea_) return std::nullopt;
  return CarryingSea{&sea_, current_.running ? &*current_.running : nullptr, time, scene_.water.rest_density,
                     scene_.gravity};
}

Eigen::Vector2d World::followed_place() const {
  const OpenSeaSettings& open = scene_.open_sea;
  if (open.follow_body == 0) return patch_frame(scene_).middle() + clock_.time() * open.follow_velocity;
  for (const BodyState& body : bodies_.states())
    if (body.body == open.follow_body) return body.position.head<2>();
  return frame_.middle();
}

void World::move_patch(const PatchFrame& frame) {
  frame_ = frame;
  water_surface_.follow(frame);
  if (wind_) wind_->follow(frame);
}

/// The undisturbed sea in the patch as it lies now.
void World::refill_patch() {
  const OpenSeaWater water =
      open_sea_->fill(*pool_, sea_, frame_.origin.head<2>(), clock_.time(), largest_time_step(scene_));
  const StartingParticles start = place_open_sea(water, scene_.particle_spacing, bodies_, frame_);
  (void)remove_particles(*pool_, fluid_, [](std::size_t) { return true; });
  add_particles(fluid_, start.position, start.velocity, kWaterPhase, start.label);
  find_held(fluid_);
  rim_gaps_ = {};
}

void World::blow(double time, StepReport& report) {
  if (!wind_) return;
  const StageScope scope(report.times, options_.clock, Stage::kWind);
  FluidParticles& p = fluid_.particles;
  const SurfaceGrid* surface = wind_->asks_surface(time) ? &water_surface_.grid(fluid_) : nullptr;
  wind_->act(*pool_, surface, p.position, p.count, time, p.acceleration, p.velocity);
}

BodySea World::body_sea(double time) const {
  const bool drags = wind_ && wind_->air().settings_at(time).law == WindLaw::kStress;
  return {current_.running ? &*current_.running : nullptr, drags, time, water_level_, &water_surface_};
}

double World::choose_step() const {
  const double speed = std::max(largest_speed_, bodies_.largest_speed());
  const double longest = std::ldexp(max_step_, -faults_.in_row);  // half for each fault in a row
  const double cfl = std::ldexp(scene_.time_step.cfl, -faults_.in_row);
  return clock_.choose_step(choose_time_step(fluid_.parameters, cfl, longest, speed), scene_.frame_times);
}

void World::take_frame(Snapshot& snapshot, StepReport& report) {
  const StageScope scope(report.times, options_.clock, Stage::kSurface);
  fill(snapshot);
  const std::optional<CarryingSea> around = carrying_sea(clock_.time());
  snapshot.loads = bodies_.take_loads(frame_, fluid_, water_surface_, around ? &*around : nullptr,
                                      frame_.local_height(water_level_));
  const SurfaceInput input = surface_input(fluid_, clock_.time());
  surface_.detect(input, *pool_);
  surface_.shape(input, *pool_, snapshot.particles);
}

void World::look(Snapshot& snapshot) const {
  fill(snapshot);
  snapshot.loads.clear();
  FluidState fluid = fluid_;
  StepReport report;
  refresh_neighbors(*pool_, fluid, report);
  SurfaceExtractor surface = surface_;
  const SurfaceInput input = surface_input(fluid, clock_.time());
  surface.detect(input, *pool_);
  surface.shape(input, *pool_, snapshot.particles);
}

void World::fill(Snapshot& snapshot) const {
  snapshot.frame = clock_.frame();
  snapshot.simulation_time = clock_.time();
  snapshot.origin = frame_.origin;
  snapshot.total_particles = static_cast<std::uint32_t>(fluid_.particles.count);
  snapshot.bodies = bodies_.states();
  snapshot.probes = read_probes();
  snapshot.oil.reset();
  if (spill_) snapshot.oil.emplace(OilSnapshot{spill_->budget(), spill_->discs()});
}

std::vector<ProbeReading> World::read_probes() const {
  std::vector<ProbeReading> readings =
      probes_.read(fluid_, water_surface_, sea_, bodies_, frame_, current_.running, clock_.time());
  if (wind_)
    for (ProbeReading& reading : readings) reading.air = wind_->air().velocity_at(reading.position, clock_.time());
  return readings;
}

SeaAround World::sea_around() const { return {water_surface_.around(), sea_, current_.running, clock_.time()}; }

std::vector<SurfaceReading> World::read_particles(std::span<const Eigen::Vector2d> places) const {
  std::vector<SurfacePlace> local(places.size());
  for (std::size_t k = 0; k < places.size(); ++k) local[k].local = frame_.to_local(places[k]);
  return water_surface_.read_shared(fluid_, local);
}

/// The parts of the state that inputs change between two steps. The water is none of them.
void World::copy_what_inputs_change(WorldState& state) const {
  state.bodies = bodies_.state();
  if (spill_) state.oil = spill_->state();
  state.wind = wind_ ? std::optional(wind_->air()) : std::nullopt;
  state.current = current_;
  state.sea = sea_;
  state.sea_request = sea_request_;
  state.growing_sea = growing_sea_;
  state.probes = probes_.settings();
  state.effort = effort();
}

WorldState World::state() const {
  WorldState state;
  copy_what_inputs_change(state);
  state.step = step_;
  state.clock = clock_;
  state.patch = frame_;
  state.water = fluid_;
  state.rim_gaps = rim_gaps_;
  state.foam = surface_.foam();
  state.faults = faults_;
  state.largest_speed = largest_speed_;
  return state;
}

bool World::accepts(const WorldState& state) const {
  return state.sea.sound() && state.oil.has_value() == spill_.has_value() && bodies_.accepts(state.bodies) &&
         state.water.particles.phase.empty() == fluid_.particles.phase.empty() &&
         state.water.particles.label.empty() == fluid_.particles.label.empty();
}

void World::restore(const WorldState& state) {
  step_ = state.step;
  clock_ = state.clock;
  frame_ = state.patch;
  water_surface_.follow(frame_);
  restore_water(fluid_, state.water);
  rim_gaps_ = state.rim_gaps;
  bodies_.restore(state.bodies, frame_, fluid_);
  if (spill_) spill_->restore(*state.oil);
  wind_.reset();
  if (state.wind) wind_.emplace(wind_surroundings(scene_, frame_, water_level_), *state.wind);
  current_ = state.current;
  sea_ = state.sea;
  sea_request_ = state.sea_request;
  growing_sea_ = state.growing_sea;
  probes_.restore(state.probes);
  surface_.restore_foam(state.foam);
  set_effort(state.effort);
  water_surface_.forget();
  faults_ = state.faults;
  largest_speed_ = state.largest_speed;
}

SceneInfo World::describe() const {
  SceneInfo info;
  info.scene = scene_.name;
  info.build = kVersion;
  info.seed = scene_.seed;
  info.frame_interval = scene_.frame_interval;
  info.particle_spacing = scene_.particle_spacing;
  info.water_level = water_level_;
  info.patch = scene_.patch;
  info.tank_walls_visible = scene_.tank_walls_visible;
  info.origin = scene_.origin;
  info.sea = sea_;
  for (const BodySettings& body : scene_.bodies)
    info.bodies.push_back(
        {body.id, body.name,
         wire_name({body.primitive, body.mesh_axes, std::filesystem::path(body.mesh_file).filename().string()}),
         body.mesh_scale, bodies_.surface_of(body.id)});
  return info;
}

double World::energy(const StepReport& report) const {
  return report.kinetic_energy + report.potential_energy;  // local z starts at the patch's floor
}

StepReport World::measure() const {
  StepReport report;
  measure_fluid(*pool_, fluid_, 0.0, report);
  return report;
}

}  // namespace pelagos
