// How oil comes into the water and goes from particles to film and back.

#include <algorithm>
#include <cmath>

#include "scales/angles.hpp"
#include "simulation/oil_particles.hpp"
#include "simulation/oil_spill.hpp"
#include "spill_surroundings.hpp"

namespace pelagos {

namespace {

constexpr double kFilmInterval = 0.5;       // s between the discs that a source feeds to the film
constexpr double kExchangeInterval = 0.25;  // s between exchanges of particles and film
constexpr double kReach = 4.0;              // spacings from a source to the water that it flows into
constexpr int kFullCell = 4;                // particles that cover a column of (2 d)^2 with one layer
constexpr double kTopLayer = 1.2;   // spacings below the surface: particles of the topmost layer, rough as it is
constexpr int kThinNeighbours = 5;  // in the 3 x 3 columns around, of which a layer has 36

ParticlePhases phases_of(const FluidParticles& p) {
  const std::size_t count = std::min(p.count, p.phase.size());  // none where the scene has no phases
  return {std::span(p.position).first(count), std::span(p.phase).first(count)};
}

/// All that is within reach of the places between two points, rounding included; local.
Eigen::AlignedBox3f box_around(const Eigen::Vector3d& one, const Eigen::Vector3d& other, double reach) {
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(1.01 * reach);
  return {(one.cwiseMin(other) - margin).cast<float>(), (one.cwiseMax(other) + margin).cast<float>()};
}

/// In each of the boxes. No particle moves farther than a cell in the step since the sort.
std::vector<std::vector<std::uint32_t>> water_in(std::span<const Eigen::AlignedBox3f> boxes, const FluidState& fluid) {
  const auto cell = static_cast<float>(fluid.parameters.support_radius);
  return collect_water(phases_of(fluid.particles), fluid.fluid_grid, cell, boxes);
}

}  // namespace

void OilSpill::advance(double dt, const SpillSea& sea, FluidState& fluid) {
  if (empty() && layer_.state().skimmers.empty()) return;
  run_sources(dt, sea, fluid);
  if (model_ == OilModel::kParticles) return;
  static_cast<void>(layer_.advance(
      dt, SpillSurroundings(sea, frame_, *layer_.settings().patch, frame_.world_height(fallback_level_), spacing_)));
  since_exchange_ += dt;
  if (model_ != OilModel::kBoth || since_exchange_ < kExchangeInterval) return;
  since_exchange_ = 0.0;
  thin_to_film(sea.surface, fluid);
  pile_to_particles(sea.surface, fluid);
}

void OilSpill::run_sources(double dt, const SpillSea& sea, FluidState& fluid) {
  since_film_ += dt;
  const bool film_due = since_film_ >= kFilmInterval;
  for (auto& [name, source] : sources_) {
    source.pending += source.settings.rate / 3600.0 * std::min(dt, source.left);
    source.left -= dt;
  }
  const std::vector<WaterNearby> water = water_in(source_boxes(sea), fluid);
  std::size_t index = 0;
  for (auto at = sources_.begin(); at != sources_.end();) {
    Source& source = at->second;
    const bool over = source.left <= 0.0;
    SourceStatus& status = source.status;
    status.wait = bring_out(source, film_due || over, over, sea, water[index++], fluid);
    status.waiting = status.wait == SourceWait::kNone ? 0.0 : status.waiting + dt;
    status.pending = source.pending * oil_density_;
    if (over && to_milligrams(status.pending) > 0) held_back_ += status.pending;
    at = over ? sources_.erase(at) : std::next(at);
  }
  if (film_due) since_film_ = 0.0;
}

/// Where each source's oil comes out; empty for sources that have no whole particle to bring out.
std::vector<Eigen::AlignedBox3f> OilSpill::source_boxes(const SpillSea& sea) const {
  std::vector<Eigen::AlignedBox3f> boxes;
  for (const auto& [name, source] : sources_) {
    Eigen::AlignedBox3f& box = boxes.emplace_back();
    if (model_ == OilModel::kSlick || source.pending < particle_volume()) continue;
    const auto local = [&, &settings = source.settings](const Eigen::Vector3d& end) {
      return frame_.to_local(world_place(settings, end, sea));
    };
    box = box_around(local(source.settings.from), local(source.settings.to), kReach * spacing_);
  }
  return boxes;
}

SourceWait OilSpill::bring_out(Source& source, bool film_due, bool over, const SpillSea& sea, const WaterNearby& water,
                               FluidState& fluid) {
  if (model_ != OilModel::kSlick) {
    const SourceWait wait = make_particles(source, sea, water, fluid);
    const bool to_film = over || wait == SourceWait::kFull || wait == SourceWait::kNoWater;  // all of it oil by now
    if (model_ != OilModel::kBoth || !to_film) return wait;
  }
  return film_due ? feed_film(source, sea) : source.status.wait;  // as it was when last tried
}

Eigen::Vector3d OilSpill::next_place(Source& source, const SpillSea& sea) const {
  const double part = std::fmod(kGoldenPart * static_cast<double>(source.made++), 1.0);
  return world_place(source.settings, source.settings.from + part * (source.settings.to - source.settings.from), sea);
}

Eigen::Vector3d OilSpill::world_place(const ReleaseOil& settings, const Eigen::Vector3d& place,
                                      const SpillSea& sea) const {
  if (settings.body == 0) return place;
  for (const BodyState& body : sea.bodies.states())
    if (body.body == settings.body) return body.position + body.orientation * place;
  return place;
}

/// A disc of film where the oil surfaces, right above its source. Under a hull it comes out beside it.
SourceWait OilSpill::feed_film(Source& source, const SpillSea& sea) {
  const double mass = source.pending * oil_density_;
  if (!(mass >= 1e-6)) return SourceWait::kNone;
  const Eigen::Vector3d place = next_place(source, sea);
  if (!frame_.covers(place.head<2>())) return SourceWait::kOutside;
  if (dry(place, sea)) return SourceWait::kNoWater;
  if (!layer_.release(mass, place.head<2>(), spacing_)) source.pending = 0.0;
  return SourceWait::kNone;
}

bool OilSpill::dry(const Eigen::Vector3d& world, const SpillSea& sea) const {
  return !sample_at(sea.surface, frame_.to_local(world).head<2>()) && !sea.bodies.covers(world, 0.0);
}

SourceWait OilSpill::make_particles(Source& source, const SpillSea& sea, const WaterNearby& water, FluidState& fluid) {
  const double volume = particle_volume();
  while (source.pending >= volume) {
    if (particles_ >= most_particles_) return SourceWait::kFull;
    const Eigen::Vector3d place = next_place(source, sea);
    if (!turn_to_oil(fluid, water, place))
      return frame_.covers(place.head<2>()) ? SourceWait::kNoWater : SourceWait::kOutside;
    source.pending -= volume;
    static_cast<void>(layer_.release_submerged(particle_mass()));
  }
  return SourceWait::kNone;
}

/// @param water  in a box_around that holds the place
bool OilSpill::turn_to_oil(FluidState& fluid, const WaterNearby& water, const Eigen::Vector3d& world) {
  const auto found = nearest_water(phases_of(fluid.particles), water, frame_.to_local(world).cast<float>(),
                                   static_cast<float>(kReach * spacing_));
  if (!found) return false;
  fluid.particles.phase[*found] = kOilPhase;
  ++particles_;
  ++displaced_;
  return true;
}

void OilSpill::thin_to_film(const SurfaceGrid& surface, FluidState& fluid) {
  FluidParticles& p = fluid.particles;
  const std::vector<int> oil = count_oil(phases_of(p), surface.grid);
  const double radius = spacing_ / std::sqrt(M_PI);
  for (const std::size_t i : find_thin_oil(phases_of(p), surface.grid, oil, kFullCell / 2, kThinNeighbours)) {
    const Float4& x = p.position[i];
    const auto water = sample_at(surface, {static_cast<double>(x.x), static_cast<double>(x.y)});
    if (!water || static_cast<double>(x.z) < water->height - kTopLayer * spacing_) continue;  // on its way up
    const Eigen::Vector2d place = frame_.to_world(Eigen::Vector2d(Eigen::Vector2f(x.x, x.y).cast<double>()));
    if (!frame_.covers(place) || layer_.take(particle_mass(), place, radius)) continue;
    p.phase[i] = kWaterPhase;
    --particles_;
    --displaced_;
  }
}

void OilSpill::pile_to_particles(const SurfaceGrid& surface, FluidState& fluid) {
  const std::vector<ReturnedOil> returned = layer_.give_back();
  std::vector<Eigen::Vector3d> places;  // m, world
  std::vector<Eigen::AlignedBox3f> boxes;
  for (const ReturnedOil& oil : returned) {
    const auto water = sample_at(surface, frame_.to_local(oil.position));
    const double height = frame_.world_height(water ? water->height : fallback_level_) - 0.5 * spacing_;
    places.emplace_back(oil.position.x(), oil.position.y(), height);
    const Eigen::Vector3d local = frame_.to_local(places.back());
    boxes.push_back(box_around(local, local, kReach * spacing_));
  }
  const std::vector<WaterNearby> water = water_in(boxes, fluid);
  for (std::size_t k = 0; k < returned.size(); ++k) {
    std::size_t left = returned[k].particles;
    while (left > 0 && particles_ < most_particles_ && turn_to_oil(fluid, water[k], places[k])) --left;
    if (left == 0) continue;
    // What finds no room or no water goes back to the film, in one piece however much it is.
    const auto pieces = static_cast<double>(left);
    static_cast<void>(layer_.take(pieces * particle_mass(), returned[k].position, spacing_ * std::sqrt(pieces)));
  }
}

}  // namespace pelagos
