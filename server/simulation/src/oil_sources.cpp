// How oil comes into the water and goes from particles to film and back.

#include <algorithm>
#include <cmath>
#include <limits>

#include "scales/angles.hpp"
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
  for (auto at = sources_.begin(); at != sources_.end();) {
    Source& source = at->second;
    const double flowing = std::min(dt, source.left);
    source.left -= dt;
    source.pending += source.settings.rate / 3600.0 * flowing;
    const bool over = source.left <= 0.0;
    SourceStatus& status = source.status;
    status.wait = bring_out(source, film_due || over, over, sea, fluid);
    status.waiting = status.wait == SourceWait::kNone ? 0.0 : status.waiting + dt;
    status.pending = source.pending * oil_density_;
    if (over && to_milligrams(status.pending) > 0) held_back_ += status.pending;
    at = over ? sources_.erase(at) : std::next(at);
  }
  if (film_due) since_film_ = 0.0;
}

SourceWait OilSpill::bring_out(Source& source, bool film_due, bool over, const SpillSea& sea, FluidState& fluid) {
  if (model_ != OilModel::kSlick) {
    const SourceWait wait = make_particles(source, sea, fluid);
    const bool to_film = over || wait == SourceWait::kFull || wait == SourceWait::kNoWater;  // all of it oil by now
    if (model_ != OilModel::kBoth || !to_film) return wait;
  }
  return film_due ? feed_film(source, sea) : source.status.wait;  // as it was when last tried
}

Eigen::Vector3d OilSpill::next_place(Source& source, const SpillSea& sea) const {
  const double part = std::fmod(kGoldenPart * static_cast<double>(source.made++), 1.0);
  const Eigen::Vector3d place = source.settings.from + part * (source.settings.to - source.settings.from);
  if (source.settings.body == 0) return place;
  for (const BodyState& body : sea.bodies.states())
    if (body.body == source.settings.body) return body.position + body.orientation * place;
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

SourceWait OilSpill::make_particles(Source& source, const SpillSea& sea, FluidState& fluid) {
  const double volume = spacing_ * spacing_ * spacing_;
  while (source.pending >= volume) {
    if (particles_ >= most_particles_) return SourceWait::kFull;
    const Eigen::Vector3d place = next_place(source, sea);
    if (!turn_to_oil(fluid, place)) return frame_.covers(place.head<2>()) ? SourceWait::kNoWater : SourceWait::kOutside;
    source.pending -= volume;
    static_cast<void>(layer_.release_submerged(particle_mass()));
  }
  return SourceWait::kNone;
}

bool OilSpill::turn_to_oil(FluidState& fluid, const Eigen::Vector3d& world) {
  FluidParticles& p = fluid.particles;
  const Eigen::Vector3f place = frame_.to_local(world).cast<float>();
  auto nearest = static_cast<float>(std::pow(kReach * spacing_, 2));
  std::size_t found = p.count;
  for (std::size_t i = 0; i < p.count; ++i) {
    if (p.phase[i] != kWaterPhase) continue;
    const float distance = (Eigen::Vector3f(p.position[i].x, p.position[i].y, p.position[i].z) - place).squaredNorm();
    if (!(distance < nearest)) continue;
    nearest = distance;
    found = i;
  }
  if (found == p.count) return false;
  p.phase[found] = kOilPhase;
  ++particles_;
  ++displaced_;
  return true;
}

void OilSpill::thin_to_film(const SurfaceGrid& surface, FluidState& fluid) {
  FluidParticles& p = fluid.particles;
  const ColumnGrid& grid = surface.grid;
  std::vector<int> oil(grid.cell_count());
  const auto column = [&](const Float4& x) {
    return std::pair{std::clamp(static_cast<int>((x.x - grid.origin_x) / grid.cell), 0, grid.columns - 1),
                     std::clamp(static_cast<int>((x.y - grid.origin_y) / grid.cell), 0, grid.rows - 1)};
  };
  const auto usable = [&](std::size_t i) {
    return p.phase[i] == kOilPhase && std::isfinite(p.position[i].x + p.position[i].y + p.position[i].z);
  };
  for (std::size_t i = 0; i < p.count; ++i)
    if (usable(i)) ++oil[grid.index(column(p.position[i]).first, column(p.position[i]).second)];
  const double radius = spacing_ / std::sqrt(M_PI);
  for (std::size_t i = 0; i < p.count; ++i) {
    if (!usable(i)) continue;
    const Float4& x = p.position[i];
    const auto [a, b] = column(x);
    int around = 0;
    for (int v = std::max(b - 1, 0); v <= std::min(b + 1, grid.rows - 1); ++v)
      for (int u = std::max(a - 1, 0); u <= std::min(a + 1, grid.columns - 1); ++u) around += oil[grid.index(u, v)];
    if (oil[grid.index(a, b)] >= kFullCell / 2 || around >= kThinNeighbours) continue;
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
  for (const ReturnedOil& oil : layer_.give_back()) {
    const auto water = sample_at(surface, frame_.to_local(oil.position));
    const double height = frame_.world_height(water ? water->height : fallback_level_) - 0.5 * spacing_;
    std::size_t left = oil.particles;
    while (left > 0 && particles_ < most_particles_ && turn_to_oil(fluid, {oil.position.x(), oil.position.y(), height}))
      --left;
    if (left == 0) continue;
    // What finds no room or no water goes back to the film, in one piece however much it is.
    const auto pieces = static_cast<double>(left);
    static_cast<void>(layer_.take(pieces * particle_mass(), oil.position, spacing_ * std::sqrt(pieces)));
  }
}

}  // namespace pelagos
