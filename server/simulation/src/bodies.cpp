#include "simulation/bodies.hpp"

#include <algorithm>
#include <cassert>

#include <fmt/format.h>

#include "body_faults.hpp"
#include "physics/boundary.hpp"
#include "rigid/convex_hull.hpp"
#include "rigid/distance_field.hpp"
#include "simulation/wetted_body.hpp"

namespace pelagos {

namespace {

Eigen::Vector3d to_body(const BodyState& state, const Eigen::Vector3d& world) {
  return state.orientation.conjugate() * (world - state.position);
}

Eigen::Vector3d to_world(const BodyState& state, const Eigen::Vector3d& body) {
  return state.orientation * body + state.position;
}

/// Whether a place (m, local) is in the patch or above or below it.
bool is_over(const Region& patch, const Eigen::Vector3d& place) {
  for (int axis = 0; axis < 2; ++axis)
    if (!(place[axis] >= static_cast<double>(patch.min[axis]) && place[axis] <= static_cast<double>(patch.max[axis])))
      return false;
  return true;
}

/// The body's shape from its file or primitive.
BodyShape shape_of(const BodySettings& settings, double spacing) {
  const MeshKind kind = settings.open ? MeshKind::kOpen : MeshKind::kClosed;
  if (settings.primitive) return make_body_shape(make_mesh(*settings.primitive), spacing, settings.sample_inset, kind);
  return load_body_shape(settings.mesh_file, {settings.mesh_scale, settings.mesh_axes, kind}, spacing,
                         settings.sample_inset);
}

/// A jump may land on water that stands where the body was before: mapped again, at most so many times.
constexpr int kRelocations = 8;

constexpr double kLeastHollow = 1e-3;  ///< share of a convex hull: what fills more of it has no hold
/// Plates of 1.2 spacings or more have a layer of samples on each side (rigid/body_shape.hpp). The mean over a boat
/// with such plates is 1.1 spacings or more, as edges count in it.
constexpr double kThinPlates = 1.1;

/// Whether a block of water lies in a hold altogether: the scene pours it there.
bool lies_in(const Box& block, double spacing, const Hold& hold, const BodyState& state) {
  const Eigen::Vector3d middle = 0.5 * (block.min + block.max);
  const Eigen::Vector3d half = (0.5 * block.size() - Eigen::Vector3d::Constant(0.5 * spacing)).cwiseMax(0.0);
  for (int corner = 0; corner < 9; ++corner) {
    const Eigen::Vector3d way((corner & 1) ? 1.0 : -1.0, (corner & 2) ? 1.0 : -1.0, (corner & 4) ? 1.0 : -1.0);
    if (!hold.contains(to_body(state, middle + (corner < 8 ? 1.0 : 0.0) * way.cwiseProduct(half)))) return false;
  }
  return true;
}

/// Spacings from a surface within which no particle starts. Of a field just so much that no place on the surface
/// counts: the particles outside then fill the water's volume, whatever its slope. Samples lie 0.6 inside, one spacing
/// away.
constexpr double kFieldClearance = 0.01, kSampleClearance = 0.4;

constexpr double kLargerHull = 0.1;      ///< than the mesh: worth a note
constexpr double kWaterClearance = 1.0;  ///< spacings of water at rest from a hull's samples

/// A surface is met by its distance field where at most so large a share of it is thinner than so many spacings: water
/// on the two sides of a thinner plate would act through it.
constexpr double kThinForFields = 1.5, kMostThin = 0.1;

Eigen::AlignedBox3d everywhere() {
  constexpr double kFar = 1e9;
  return {Eigen::Vector3d::Constant(-kFar), Eigen::Vector3d::Constant(kFar)};
}

/// The patch and `margin` around it, as a box in the body's axes.
Eigen::AlignedBox3d patch_around(const Scene& scene, const BodyState& state, double margin) {
  Eigen::AlignedBox3d box;
  for (int corner = 0; corner < 8; ++corner) {
    Eigen::Vector3d x;
    for (int axis = 0; axis < 3; ++axis)
      x[axis] = (corner >> axis & 1) != 0 ? scene.patch.max[axis] + margin : scene.patch.min[axis] - margin;
    box.extend(to_body(state, x));
  }
  return box;
}

constexpr double kHullOverlap = 0.5;  ///< spacings that a body may stand in another's hull at the start

Freedoms freedoms_of(const BodySettings& body) {
  return body.drive == BodyDrive::kFree ? body.freedoms : Freedoms::heave_roll_pitch();
}

}  // namespace

Bodies::Bodies(TaskPool& pool, const Scene& scene, double support_radius, Refusals& faults)
    : spacing_(scene.particle_spacing) {
  for (const BodySettings& settings : scene.bodies) {
    Body body;
    body.settings = settings;
    body.shape = shape_of(settings, scene.particle_spacing);
    body.state.body = settings.id;
    body.state.position = settings.position;
    body.state.orientation = settings.orientation;
    body.state.pose_age = -1.0;
    if (is_led(settings.drive)) body.driven.emplace(body.state, scene.particle_spacing, body.shape.reach);
    if (is_free(settings.drive)) {
      body.state.velocity = settings.velocity;
      body.held = settings.free_from > 0.0;
      body.free.emplace(body.state, body_mass(settings.mass, body.shape.solid), freedoms_of(settings));
    }
    add_surface(pool, scene, support_radius, body);
    bodies_.push_back(std::move(body));
  }
  faults = body_faults(scene, support_radius, placed());
  if (!faults.empty()) return;
  for (Body& body : bodies_) open_hold(scene, body);
  if (is_open(scene.patch_edges)) make_sea_bodies(scene.water.rest_density);
  make_contacts(scene);
  faults = contact_faults(scene);
}

std::vector<PlacedShape> Bodies::placed() const {
  std::vector<PlacedShape> placed;
  for (const Body& body : bodies_) placed.push_back({&body.settings, &body.shape});
  return placed;
}

std::vector<std::string> Bodies::mesh_notes() const {
  std::vector<std::string> notes;
  for (const PlacedShape& body : placed())
    for (const std::string& note : body.shape->notes) notes.push_back(body.name() + ": " + note);
  return notes;
}

void Bodies::make_contacts(const Scene& scene) {
  if (std::none_of(bodies_.begin(), bodies_.end(), [](const Body& body) { return body.free.has_value(); })) return;
  BodyContacts& contacts = contacts_.emplace(scene.particle_spacing);
  for (int axis = 0; axis < 3; ++axis) {
    const PatchEdge edge = scene.patch_edges[static_cast<std::size_t>(axis)];
    if (edge == PatchEdge::kPeriodic || edge == PatchEdge::kOpen) continue;
    const bool is_symmetric = axis < 2 && scene.patch_edges[static_cast<std::size_t>(axis)] == PatchEdge::kMirror;
    const auto face = is_symmetric ? BodyContacts::Face::kSmooth : BodyContacts::Face::kRough;
    contacts.add_plane(scene.patch.min, Eigen::Vector3d::Unit(axis), face);
    contacts.add_plane(scene.patch.max, -Eigen::Vector3d::Unit(axis), face);
  }
  for (Body& body : bodies_) {
    if (body.free)
      body.hull = contacts.add_free(body.shape.mesh, body.free->mass(), body.free->freedoms());
    else if (body.driven)
      body.hull = contacts.add_driven(body.shape.mesh);
    else
      contacts.add_scenery(body.shape.mesh, body.state.position, body.state.orientation);
  }
}

void Bodies::add_surface(TaskPool& pool, const Scene& scene, double support_radius, Body& body) {
  const bool fields = scene.solver.kind == SolverKind::kCorrected && body.shape.faults.empty() &&
                      !body.settings.sample_inset && thin_share(body.shape, kThinForFields * spacing_) < kMostThin;
  if (fields) {
    FieldExtent extent{spacing_, support_radius, {}};
    extent.within = body.moves() ? everywhere() : patch_around(scene, body.state, support_radius);
    body.fields = make_distance_fields(pool, body.shape, extent);
  }
  if (body.fields.empty()) add_samples(pool, scene, support_radius, body);
}

void Bodies::add_samples(TaskPool& pool, const Scene& scene, double support_radius, Body& body) {
  body.first_sample = volumes_.size();
  std::vector<Float4> samples;
  for (const Eigen::Vector3f& sample : body.shape.samples) samples.push_back({sample.x(), sample.y(), sample.z(), 0});
  assign_boundary_volumes(pool, support_radius, body.shape.inward, kWaterClearance * spacing_, samples);
  for (const Float4& sample : samples) {
    if (body.moves()) {
      volumes_.push_back(sample.w);
      continue;
    }
    const Eigen::Vector3d x = to_world(body.state, {sample.x, sample.y, sample.z});
    if (is_within_reach(scene.patch, x, support_radius)) static_.push_back({x, sample.w});
  }
}

std::vector<Float4> Bodies::static_samples(const PatchFrame& frame) const {
  std::vector<Float4> samples;
  samples.reserve(static_.size());
  for (const StaticSample& sample : static_) {
    const Eigen::Vector3f local = frame.to_local(sample.position).cast<float>();
    samples.push_back({local.x(), local.y(), local.z(), sample.volume});
  }
  return samples;
}

bool Bodies::covers(const Eigen::Vector3d& point, double clearance) const {
  constexpr double kLeastLimit = 1e-6;  // m: within a limit of 0 every distance is 0, inside too
  const double limit = std::max(2.0 * clearance, kLeastLimit);
  return std::any_of(bodies_.begin(), bodies_.end(), [&](const Body& body) {
    return body.shape.signed_distance(to_body(body.state, point), limit) < clearance;
  });
}

bool Bodies::leaves_no_room(const Eigen::Vector3d& point, double spacing) const {
  return std::any_of(bodies_.begin(), bodies_.end(), [&](const Body& body) {
    const double clearance = (body.fields.empty() ? kSampleClearance : kFieldClearance) * spacing;
    return body.shape.signed_distance(to_body(body.state, point), 2.0 * clearance) < clearance;
  });
}

void Bodies::signed_distances(const Eigen::Vector3d& point, double limit, std::vector<double>& each) const {
  each.clear();
  for (const Body& body : bodies_) each.push_back(body.shape.signed_distance(to_body(body.state, point), limit));
}

/// Finds the body's hold and dries what the sea does not reach.
void Bodies::open_hold(const Scene& scene, Body& body) const {
  if (body.shape.kind != MeshKind::kClosed || hollow_share(body.shape.mesh) < kLeastHollow) return;
  body.hold = Hold(body.shape, scene.particle_spacing);
  const bool flooded = body.settings.hold == HoldStart::kFlooded ||
                       (body.settings.hold == HoldStart::kDefault && body.settings.drive == BodyDrive::kStatic);
  if (body.hold.empty() || flooded) return;
  std::vector<Box> blocks = scene.water.blocks, poured;
  if (scene.oil) blocks.insert(blocks.end(), scene.oil->blocks.begin(), scene.oil->blocks.end());
  for (const Box& block : blocks)
    if (lies_in(block, scene.particle_spacing, body.hold, body.state)) poured.push_back(block);
  const auto is_in = [&](const std::vector<Box>& boxes) {
    return [&boxes, &body](const Eigen::Vector3d& point) {
      const Eigen::Vector3d x = to_world(body.state, point);
      return std::any_of(boxes.begin(), boxes.end(), [&](const Box& box) {
        return (x.array() >= box.min.array()).all() && (x.array() <= box.max.array()).all();
      });
    };
  };
  body.hold.dry_out(is_in(blocks), is_in(poured));
}

bool Bodies::keeps_dry(const Eigen::Vector3d& point) const {
  return std::any_of(bodies_.begin(), bodies_.end(), [&](const Body& body) {
    return !body.hold.empty() && body.hold.is_dry(to_body(body.state, point));
  });
}

std::vector<HoldReading> Bodies::holds() const {
  std::vector<HoldReading> holds;
  for (const Body& body : bodies_)
    if (!body.hold.empty()) holds.push_back({body.settings.id, body.hold.volume(), body.hold_water.volume});
  return holds;
}

void Bodies::measure_holds(const PatchFrame& frame, const FluidState& fluid) {
  const double volume = fluid.parameters.volume();
  for (Body& body : bodies_) {
    if (body.hold.empty()) continue;
    body.hold_water = {};
    const FluidParticles& p = fluid.particles;
    for (std::size_t i = 0; i < p.count; ++i) {
      const Eigen::Vector3d x =
          to_body(body.state, frame.to_world(Eigen::Vector3d(p.position[i].x, p.position[i].y, p.position[i].z)));
      if (!body.hold.contains(x)) continue;
      body.hold_water.volume += volume;
      body.hold_water.moment += volume * x;
    }
  }
}

std::vector<std::string> Bodies::hold_notes(double level) const {
  std::vector<std::string> notes;
  for (const Body& body : bodies_) {
    if (body.hold.empty()) continue;
    const Eigen::Vector3d up = body.state.orientation.conjugate() * Eigen::Vector3d::UnitZ();
    const double below = body.hold.below({up, level - body.state.position.z()}).volume;
    const std::string name = PlacedShape{&body.settings, &body.shape}.name();
    if (body.hold_water.volume > 0.0)
      notes.push_back(fmt::format("{}: its hold of {:.3g} m^3 starts with {:.3g} m^3 of water in it", name,
                                  body.hold.volume(), body.hold_water.volume));
    else if (below > 0.0)
      notes.push_back(
          fmt::format("{}: its hold of {:.3g} m^3 starts dry, {:.3g} m^3 of it below the level of the water (hold: "
                      "FLOODED fills it)",
                      name, body.hold.volume(), below));
    else if (body.moves())
      notes.push_back(
          fmt::format("{}: its hold of {:.3g} m^3 starts dry, above the level of the water", name, body.hold.volume()));
    else
      continue;
    const double plating = 2.0 * body.shape.displacement / mesh_area(body.shape.mesh);
    if (plating < kThinPlates * spacing_)
      notes.back() += fmt::format(
          ". Its plating, {:.2g} m thick in the mean, is thinner than {:g} spacings ({:.3g} m) and has one layer of "
          "boundary samples instead of two: draft and trim are coarse, and water may seep in",
          plating, kThinPlates, kThinPlates * spacing_);
  }
  return notes;
}

std::vector<std::string> Bodies::contact_notes() const {
  std::vector<std::string> notes;
  if (bodies_.size() < 2) return notes;  // of the patch's faces a hull touches what its mesh touches
  for (const Body& body : bodies_) {
    const double hollow = body.free && body.shape.kind == MeshKind::kClosed ? hollow_share(body.shape.mesh) : 0.0;
    const double larger = hollow / (1.0 - hollow);
    if (larger < kLargerHull) continue;
    notes.push_back(
        fmt::format("{}: it touches other bodies as the convex hull of its mesh, {:.0f} % larger than the mesh: what "
                    "comes into its hollows is pushed out (drive STATIC or POSE touches as the mesh is)",
                    PlacedShape{&body.settings, &body.shape}.name(), 100.0 * larger));
  }
  return notes;
}

bool Bodies::accept(const BodyPose& pose, double now) {
  for (Body& body : bodies_)
    if (body.settings.id == pose.body && body.driven) return body.driven->accept(pose, now);
  return false;
}

void Bodies::advance(double now, double dt, const PatchFrame& frame, const CarryingSea* around, FluidState& fluid) {
  const FreeBody::Order order =
      fluid.parameters.scheme == Scheme::kCorrected ? FreeBody::Order::kDriftFirst : FreeBody::Order::kGravityFirst;
  for (Body& body : bodies_) {
    const BodyState before = body.state;
    const std::uint64_t jumps = body.driven ? body.driven->jumps() : 0;
    if (body.driven) body.state = body.driven->advance(dt, now);
    body.held = body.free && now < body.settings.free_from;
    if (body.gives_way()) {
      if (around == nullptr && body.driven && !is_over(fluid.parameters.patch, frame.to_local(body.state.position)))
        body.free->rest();
      else
        body.free->predict(dt, fluid.parameters.gravity, order);
      if (body.driven) body.free->lead(body.state);
      body.free->write_to(body.state);
    }
    if (around != nullptr) feel_sea(dt, frame, fluid.coupling.fade, *around, body);
    if (body.driven && body.driven->jumps() != jumps) relocate_water(body, before, frame, fluid);
  }
  place(frame, fluid);
}

void Bodies::receive(double dt, const FluidState& fluid) {
  std::size_t coupled = 0;
  for (Body& body : bodies_) {
    if (!body.moves()) continue;
    const CoupledBody& push = fluid.coupling.bodies[coupled++];
    const Eigen::Vector3d drift(dt * body.drift_force.x(), dt * body.drift_force.y(), 0.0);
    body.meter.add(body.state, push.impulse + drift + body.sea_impulse.head<3>(),
                   push.angular_impulse + body.sea_impulse.tail<3>(), dt);
    if (body.gives_way())
      body.free->take(push.displacement, push.turn, push.velocity + body.free->inverse_mass().cwiseProduct(drift),
                      push.angular_velocity);
  }
  touch(dt);
  for (Body& body : bodies_)
    if (body.gives_way()) body.free->write_to(body.state);
}

/// A body that starts in the hollow of another is apart from its mesh, but not from its convex hull.
Refusals Bodies::contact_faults(const Scene& scene) {
  Refusals faults;
  if (!contacts_) return faults;
  place_contacts();
  const std::vector<PlacedShape> shapes = placed();
  for (const auto& [pair, depth] : contacts_->hull_overlaps(kHullOverlap * scene.particle_spacing)) {
    const bool first = bodies_[pair[0]].free && hollow_share(shapes[pair[0]].shape->mesh) > 0.0;
    const PlacedShape &hollow = shapes[pair[first ? 0 : 1]], &other = shapes[pair[first ? 1 : 0]];
    faults.push_back(
        {hollow.name(),
         fmt::format(
             "a body that is free touches others as the convex hull of its mesh, and {} stands {:.2g} m deep in that "
             "hull: the two would be thrown apart; allowed: hulls apart at the start, or drive STATIC or POSE for {}, "
             "which "
             "then touches as its mesh is",
             other.name(), depth, hollow.name())});
  }
  return faults;
}

void Bodies::place_contacts() {
  for (const Body& body : bodies_) {
    if (body.free)
      contacts_->place_free(body.hull, *body.free);
    else if (body.driven)
      contacts_->place_driven(body.hull, body.state);
  }
}

void Bodies::touch(double dt) {
  if (!contacts_ || !finite()) return;
  place_contacts();
  if (!contacts_->resolve(dt)) return;
  const Eigen::Vector3d still = Eigen::Vector3d::Zero();
  for (Body& body : bodies_)
    if (body.gives_way())
      body.free->take(still, still, contacts_->velocity(body.hull), contacts_->angular_velocity(body.hull));
}

std::vector<BodyLoad> Bodies::take_loads(const PatchFrame& frame, const FluidState& fluid, WaterSurface& surface,
                                         const CarryingSea* around, double still_level) {
  std::vector<BodyLoad> loads;
  measure_holds(frame, fluid);
  if (std::none_of(bodies_.begin(), bodies_.end(), [](const Body& body) { return body.moves(); })) return loads;
  std::vector<SurfacePlace> places;
  for (const Body& body : bodies_)
    if (body.moves())
      for (const SurfacePlace& place : ring_around(body.shape, body.state, frame)) places.push_back(place);
  const std::vector<SurfaceReading> readings = surface.read_particles(fluid, places);
  std::vector<SurfaceReading> at_sea;
  if (around != nullptr && !boxes_at_edges(frame, fluid.coupling.fade).empty())
    at_sea = surface.read(fluid, *around->waves, around->time, places);
  const std::size_t ring = places.size() / fluid.coupling.bodies.size();
  std::size_t first = 0;
  for (Body& body : bodies_) {
    if (!body.moves()) continue;
    BodyLoad& load = loads.emplace_back();
    load.body = body.settings.id;
    if (body.free) load.point = body.free->mass().centre;
    body.meter.take(load);
    const bool inside = at_sea.empty() || is_inside(body, frame, fluid.coupling.fade);
    const WaterPlane water =
        water_around(std::span(places).subspan(first, ring), std::span(inside ? readings : at_sea).subspan(first, ring),
                     body.state, frame, still_level);
    first += ring;
    const double weight_density = fluid.parameters.rest_density * fluid.parameters.gravity;
    measure_buoyancy(body.shape, water, weight_density, load);
    if (!body.hold.empty()) add_hold(body.hold.below(water), body.hold_water, water, weight_density, load);
  }
  return loads;
}

bool Bodies::finite() const {
  return std::all_of(bodies_.begin(), bodies_.end(), [](const Body& body) {
    return body.state.position.allFinite() && body.state.velocity.allFinite() &&
           body.state.angular_velocity.allFinite() && body.state.orientation.coeffs().allFinite();
  });
}

void Bodies::place(const PatchFrame& frame, FluidState& fluid) const {
  fluid.moving_position.resize(volumes_.size());
  fluid.moving_velocity.resize(volumes_.size());
  fluid.coupling.bodies.clear();
  fluid.solids.resize(fluid.face_count);
  for (const Body& body : bodies_) {
    place_fields(body, frame, body.moves() ? static_cast<std::int32_t>(fluid.coupling.bodies.size()) : -1,
                 fluid.solids);
    if (!body.moves()) continue;
    if (const std::size_t count = body.sample_count(); count > 0)
      place_samples(body.shape, body.state, frame, std::span(fluid.moving_position).subspan(body.first_sample, count),
                    std::span(fluid.moving_velocity).subspan(body.first_sample, count));
    fluid.coupling.bodies.push_back(coupled_body(body, frame));
  }
  for (std::size_t k = 0; k < volumes_.size(); ++k) fluid.moving_position[k].w = volumes_[k];
}

void Bodies::place_fields(const Body& body, const PatchFrame& frame, std::int32_t coupled, std::vector<Solid>& solids) {
  Solid solid;
  solid.turn = body.state.orientation.toRotationMatrix().cast<float>();
  solid.place = frame.to_local(body.state.position).cast<float>();
  solid.body = coupled;
  for (const auto& field : body.fields) {
    solid.field = field;
    solids.push_back(solid);
  }
}

std::vector<Solid> Bodies::standing_solids(const PatchFrame& frame) const {
  std::vector<Solid> solids;
  for (const Body& body : bodies_)
    if (!body.moves()) place_fields(body, frame, -1, solids);
  return solids;
}

CoupledBody Bodies::coupled_body(const Body& body, const PatchFrame& frame) {
  CoupledBody coupled;
  coupled.first_sample = body.first_sample;
  coupled.sample_count = body.sample_count();
  coupled.centre = frame.to_local(body.free ? body.free->centre() : body.state.position);
  if (body.held) return coupled;
  coupled.velocity = body.free ? body.free->velocity() : body.state.velocity;
  coupled.angular_velocity = body.state.angular_velocity;
  if (!body.free) return coupled;
  coupled.inverse_mass = body.free->inverse_mass();
  coupled.inverse_inertia = body.free->inverse_inertia();
  return coupled;
}

double Bodies::largest_speed() const {
  double largest = 0.0;
  for (const Body& body : bodies_)
    if (body.moves())
      largest = std::max(largest, body.state.velocity.norm() + body.state.angular_velocity.norm() * body.shape.reach);
  return largest;
}

std::optional<BodyState> Bodies::state_of(std::uint32_t id) const {
  for (const Body& body : bodies_)
    if (body.settings.id == id) return body.state;
  return std::nullopt;
}

std::vector<BodyState> Bodies::states() const {
  std::vector<BodyState> states;
  for (const Body& body : bodies_) states.push_back(body.state);
  return states;
}

void Bodies::relocate_water(const Body& body, const BodyState& before, const PatchFrame& frame,
                            FluidState& fluid) const {
  FluidParticles& p = fluid.particles;
  for (std::size_t i = 0; i < p.count; ++i) {
    Eigen::Vector3d x = frame.to_world(Eigen::Vector3d(p.position[i].x, p.position[i].y, p.position[i].z));
    bool moved = false;
    for (int k = 0; k < kRelocations && body.shape.inside(to_body(body.state, x)); ++k, moved = true)
      x = to_world(before, to_body(body.state, x));
    if (!moved) continue;
    const Eigen::Vector3f local = frame.to_local(x).cast<float>();
    p.position[i] = {local.x(), local.y(), local.z(), 0.0F};
    p.velocity[i] = p.acceleration[i] = {};
    p.density_pressure[i] = p.divergence_pressure[i] = 0.0F;
  }
}

BodiesState Bodies::state() const {
  BodiesState state;
  state.bodies.assign(bodies_.begin(), bodies_.end());
  if (contacts_) state.contacts = contacts_->state();
  state.drift = surface_drift_;
  return state;
}

bool Bodies::accepts(const BodiesState& state) const {
  return std::equal(bodies_.begin(), bodies_.end(), state.bodies.begin(), state.bodies.end(),
                    [](const Body& body, const BodyDynamics& motion) {
                      return body.state.body == motion.state.body && body.free.has_value() == motion.free.has_value() &&
                             body.driven.has_value() == motion.driven.has_value();
                    });
}

void Bodies::restore(const BodiesState& state, const PatchFrame& frame, FluidState& fluid) {
  assert(accepts(state));
  for (std::size_t i = 0; i < bodies_.size(); ++i) static_cast<BodyDynamics&>(bodies_[i]) = state.bodies[i];
  surface_drift_ = state.drift;
  if (bodies_.empty()) return;
  place(frame, fluid);
  measure_holds(frame, fluid);
  if (!contacts_) return;
  place_contacts();
  contacts_->restore(state.contacts);
}

}  // namespace pelagos
