// What commands do to a world.

#include <fmt/format.h>

#include <algorithm>
#include <type_traits>
#include <utility>

#include "simulation/growing_sea.hpp"
#include "simulation/scene_sea.hpp"
#include "simulation/world.hpp"
#include "values/command_surroundings.hpp"
#include "wind_surroundings.hpp"

namespace pelagos {

namespace {

/// Relaxation times for which water is slowed down after the current was cleared: e^-10 of its speed is left then.
constexpr double kSlowingTimes = 10.0;

/// Commands that speak of what bears a name, or make something that does.
bool uses_names(const Command& command) {
  return std::holds_alternative<OilCommand>(command) || std::holds_alternative<SetProbe>(command) ||
         std::holds_alternative<RemoveProbe>(command);
}

}  // namespace

std::vector<CommandOutcome> World::take(const StepInputs& inputs) {
  std::vector<CommandOutcome> outcomes;
  for (const GivenPose& given : inputs.poses) bodies_.accept(given.pose, clock_.time());
  for (const GivenCommand& given : inputs.commands) outcomes.push_back(apply(given.command));
  if (recovery_ && !inputs.empty()) copy_what_inputs_change(*recovery_);  // a state that comes back has it too
  return outcomes;
}

CommandOutcome World::apply(const Command& command) {
  CommandOutcome outcome{command, find_refusal(command, around_)};
  if (!outcome.refusal && uses_names(command)) {
    const GivenNames given = names();
    outcome.refusal = find_unknown_name(command, given);
    if (!outcome.refusal) outcome.refusal = find_no_room(command, given);
  }
  if (!outcome.refusal) outcome.refusal = apply_valid(command);
  if (!outcome.refusal && std::holds_alternative<SetWind>(command))
    outcome.done = SetWind{wind_->air().target(), std::get<SetWind>(command).ramp_seconds};
  return outcome;
}

std::optional<Refusal> World::apply_valid(const Command& command) {
  using Answer = std::optional<Refusal>;
  struct Visitor {
    World& world;
    Answer operator()(const SetWind& c) const { return world.set_wind(c); }
    Answer operator()(const ClearWind&) const {
      world.wind_.reset();
      return {};
    }
    Answer operator()(const SetCurrent& c) const {
      world.set_current(c.current, c.ramp_seconds);
      return {};
    }
    Answer operator()(const ClearCurrent&) const {
      world.clear_current();
      return {};
    }
    Answer operator()(const SetWaves& c) const {
      Answer refusal =
          world.exchange_sea(wave_components(c.waves, world.around_.gravity, world.sea_.depth()), c.blend_seconds, {});
      if (!refusal) world.growing_sea_.reset();
      return refusal;
    }
    Answer operator()(const SetSea& c) const { return world.set_sea(c); }
    Answer operator()(const SetEffort& c) const {
      world.set_effort(c.effort);
      return {};
    }
    Answer operator()(const PauseSimulation&) const { return {}; }
    Answer operator()(const ResumeSimulation&) const { return {}; }
    Answer operator()(const StepSimulation&) const { return {}; }
    Answer operator()(const SetProbe& c) const {
      world.probes_.set(c.probe);
      return {};
    }
    Answer operator()(const RemoveProbe& c) const {
      world.probes_.remove(c.id);
      return {};
    }
    Answer operator()(const OilCommand& c) const { return world.apply_to_oil(c); }
  };
  return std::visit(Visitor{*this}, command);
}

GivenNames World::names() const {
  GivenNames given;
  for (const auto& [id, probe] : probes_.settings()) given.probes.insert(id);
  if (!spill_) return given;
  for (const std::string& name : spill_->sources()) given.sources.insert(name);
  for (const auto& [name, skimmer] : spill_->film().skimmers) given.skimmers.insert(name);
  for (const auto& [name, boom] : spill_->film().booms) {
    given.booms.insert(name);
    given.boom_points[name] = boom.boom.line.size();
  }
  return given;
}

std::optional<Refusal> World::apply_to_oil(const OilCommand& command) {
  return std::visit(
      [&](const auto& c) -> std::optional<Refusal> {
        if constexpr (std::is_same_v<std::decay_t<decltype(c)>, ReleaseOil>)
          return spill_->apply(c, bodies_);
        else
          return spill_->apply(c);
      },
      command);
}

void World::advance_oil(double dt, double time, StepReport& report) {
  if (!spill_) return;
  const StageScope scope(report.times, options_.clock, Stage::kOil);
  static const SurfaceGrid nothing;
  const SurfaceGrid& surface = spill_->asks_surface() ? water_surface_.grid_with_velocities(fluid_) : nothing;
  const SpillSea sea{bodies_, surface, wind_ ? &wind_->air() : nullptr, current_.running ? &*current_.running : nullptr,
                     time};
  spill_->advance(dt, sea, fluid_);
}

std::optional<Refusal> World::set_wind(const SetWind& command) {
  WindSettings wind;
  const auto present = wind_ ? std::optional(wind_->air().target()) : std::nullopt;
  if (auto refusal = merge_wind(command, present, wind)) return refusal;
  if (!wind_) {  // from calm: the same wind without speed, ramped up
    WindSettings calm = wind;
    calm.velocity.setZero();
    calm.amplitude = 0.0;
    wind_.emplace(wind_surroundings(scene_, frame_, water_level_), calm, clock_.time());
  }
  wind_->set(wind, clock_.time(), command.ramp_seconds);
  return {};
}

std::optional<Refusal> World::exchange_sea(std::vector<WaveComponent> waves, double blend_seconds,
                                           std::optional<SeaRequest> request) {
  if (sea_.exchange(std::move(waves), clock_.time(), blend_seconds)) {
    sea_request_ = std::move(request);
    return {};
  }
  return Refusal{"",
                 fmt::format("the sea is already changing into {} others, one after the other; allowed: {} changes at "
                             "a time. The next one can begin at {:.1f} s of simulated time, when one of them ends",
                             WaveField::kMostLayers - 1, WaveField::kMostLayers - 1, sea_.open_from())};
}

std::optional<Refusal> World::set_sea(const SetSea& command) {
  const double gravity = around_.gravity, time = clock_.time();
  std::optional<GrowingSea> growing;
  if (const std::optional<WindSeaSettings>& wind_sea = command.sea.wind_sea) {
    const SteadyWind wind = steady_wind(wind_ ? wind_->air().settings_at(time).velocity : Eigen::Vector3d::Zero());
    const bool goes_on = growing_sea_ && !wind_sea->blown_for;
    growing = start_growing(command.sea, goes_on ? growing_sea_->now : start_wind_sea(*wind_sea, wind, gravity), time);
    growing->renewal = time + std::max(kSeaRenewal, command.blend_seconds);
  }
  MadeSea made = make_sea(scene_, growing ? present_sea(*growing, gravity) : command.sea);
  if (auto refusal = exchange_sea(std::move(made.waves), command.blend_seconds, std::move(made.request)))
    return refusal;
  growing_sea_ = std::move(growing);
  return {};
}

bool World::grow_sea() {
  if (!growing_sea_) return false;
  GrowingSea& sea = *growing_sea_;
  const double time = clock_.time();
  if (time >= sea.looked_at + kSeaGrowth) {
    const SteadyWind wind = steady_wind(wind_ ? wind_->air().settings_at(time).velocity : Eigen::Vector3d::Zero());
    sea.now = wind_sea_after(sea.now, *sea.asked.wind_sea, wind, time - sea.looked_at, around_.gravity);
    sea.looked_at = time;
  }
  if (time < sea.renewal) return false;
  sea.renewal = time + kSeaRenewal;
  if (!needs_renewal(sea)) return false;
  MadeSea made = make_sea(scene_, present_sea(sea, around_.gravity));
  if (exchange_sea(std::move(made.waves), kSeaRenewal, std::move(made.request))) return false;  // other blends run
  sea.shown = sea.now;
  return true;
}

std::optional<WindSettings> World::wind() const {
  if (!wind_) return std::nullopt;
  return wind_->air().settings_at(clock_.time());
}

std::optional<Air> World::air() const {
  if (!wind_) return std::nullopt;
  return wind_->air();
}

void World::set_effort(const Effort& effort) {
  max_step_ = effort.max_step;
  fluid_.parameters.density.tolerance = effort.density_tolerance;
  fluid_.parameters.divergence.tolerance = effort.divergence_tolerance;
}

Effort World::effort() const {
  return {max_step_, fluid_.parameters.density.tolerance, fluid_.parameters.divergence.tolerance};
}

void World::set_current(const CurrentSettings& current, double ramp_seconds) {
  if (!current_.running) current_.running.emplace(water_level_, drive_.moves_water());
  current_.running->set(current, clock_.time(), ramp_seconds);
  current_.slowing.reset();
}

void World::clear_current() {
  if (!current_.running) return;
  CurrentSettings none = current_.running->target();
  none.velocity.setZero();
  current_.slowing = *std::exchange(current_.running, std::nullopt);
  current_.slowing->set(none, clock_.time(), 0.0);
  current_.slowing_until = clock_.time() + kSlowingTimes * none.relaxation;
}

std::optional<CurrentSettings> World::current() const {
  if (!current_.running) return std::nullopt;
  return current_.running->settings_at(clock_.time());
}

void World::start_current() {
  FluidParticles& p = fluid_.particles;
  if (drive_.any()) drive_.start(*pool_, *current_.running, clock_.time(), p.position, p.count, p.velocity);
  bodies_.start_drift(*current_.running, clock_.time(), water_level_, fluid_.parameters.rest_density);
  if (!bodies_.empty()) bodies_.place(frame_, fluid_);
  largest_speed_ = measure().largest_speed;
}

/// With a current all rotation is kept: its shear is slow rotation and no noise, and what drifted in it came 6 % off.
void World::choose_filter() {
  const bool flows = current_.running || current_.slowing;
  fluid_.parameters.weak_rotation = flows ? 0.0 : kWeakRotation;
}

void World::drive_current(double time, StepReport& report) {
  if (current_.slowing && clock_.time() >= current_.slowing_until) current_.slowing.reset();
  const std::optional<Current>& current = current_.running ? current_.running : current_.slowing;
  if (!current || !drive_.any()) return;
  const StageScope scope(report.times, options_.clock, Stage::kCurrent);
  FluidParticles& p = fluid_.particles;
  drive_.add_acceleration(*pool_, *current, time, p.position, p.velocity, p.count, p.acceleration);
}

}  // namespace pelagos
