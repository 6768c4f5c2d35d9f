#include "oil/slick_layer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "booms.hpp"
#include "checks.hpp"
#include "exchange.hpp"
#include "film.hpp"
#include "oil/weathering.hpp"
#include "resampling.hpp"
#include "skimmers.hpp"

namespace pelagos {

namespace {

/// Held elements keep this share of their disc's radius away from a boom, but at least a centimetre.
constexpr double kClearance = 0.5, kLeastClearance = 0.01;

/// Where the bound on elements is passed, so much of it is made free at once.
constexpr std::size_t kRoomPerBound = 20;

/// An element that has lost all but this share of its fresh oil has lost all of it.
constexpr double kLeastResidue = 1e-6;

bool is_usable(const SurfaceState& s) {
  return s.water_velocity.allFinite() && s.wind.allFinite() && std::isfinite(s.height) && s.way_out.allFinite();
}

SpreadLaw spread_law(const SlickSettings& s) {
  return make_spread_law(s.gravity * (s.water_density - s.oil.density) / s.water_density, s.water_viscosity,
                         s.inertial_constant, s.viscous_constant,
                         s.terminal_thickness.value_or(terminal_thickness(kinematic_viscosity(s.oil))));
}

std::optional<Refusal> check_submerged(double mass, Milligrams submerged) {
  return check("mass", mass, to_milligrams(mass) <= submerged,
               "at most the " + number_text(to_kilograms(submerged)) + " kg that are submerged");
}

}  // namespace

struct SlickLayer::Workspace {
  ElementGrid grid;
  Film film;
  SpreadLaw law;
  Barriers barriers;
  std::vector<Eigen::Vector2d> positions;
  std::vector<SurfaceState> states;
  std::vector<BoomContact> contacts;
  std::vector<std::uint8_t> stuck;
};

SlickLayer::SlickLayer(const SlickSettings& settings) : settings_(settings), work_(std::make_unique<Workspace>()) {
  if (const auto fault = find_fault(settings)) throw std::invalid_argument(to_string(*fault));
  work_->law = spread_law(settings_);
}

SlickLayer::~SlickLayer() = default;
SlickLayer::SlickLayer(SlickLayer&&) noexcept = default;
SlickLayer& SlickLayer::operator=(SlickLayer&&) noexcept = default;

void SlickLayer::add(Milligrams mass, const Eigen::Vector2d& position, double radius) {
  SlickElement element;
  element.position = position;
  element.size = radius / kDiscPerSize;
  element.mass = mass;
  element.film = film_volume(element, settings_.oil.density) / (std::numbers::pi * radius * radius);
  state_.elements.push_back(element);
  keep_within_bound();
}

void SlickLayer::keep_within_bound() {
  const std::size_t most = settings_.most_elements;
  if (state_.elements.size() > most) merge_down_to(most - most / kRoomPerBound, work_->barriers, state_.elements);
}

std::optional<Refusal> SlickLayer::release(double mass, const Eigen::Vector2d& position, double radius) {
  if (auto fault = check_mass(mass)) return fault;
  if (auto fault = check_place(position)) return fault;
  if (auto fault = check_radius(radius)) return fault;
  state_.booked.released += to_milligrams(mass);
  add(to_milligrams(mass), position, radius);
  return {};
}

std::optional<Refusal> SlickLayer::release_submerged(double mass) {
  if (auto fault = check_mass(mass)) return fault;
  state_.booked.released += to_milligrams(mass);
  state_.booked.submerged += to_milligrams(mass);
  return {};
}

std::optional<Refusal> SlickLayer::take(double mass, const Eigen::Vector2d& position, double radius) {
  if (auto fault = check_mass(mass)) return fault;
  if (auto fault = check_place(position)) return fault;
  if (auto fault = check_radius(radius)) return fault;
  const Milligrams taken = to_milligrams(mass);
  if (auto fault = check_submerged(mass, state_.booked.submerged)) return fault;
  state_.booked.submerged -= taken;
  add(taken, position, radius);
  return {};
}

std::optional<Refusal> SlickLayer::drop_submerged(double mass) {
  if (auto fault = check_mass(mass)) return fault;
  const Milligrams dropped = to_milligrams(mass);
  if (auto fault = check_submerged(mass, state_.booked.submerged)) return fault;
  state_.booked.submerged -= dropped;
  state_.booked.left_patch += dropped;
  return {};
}

std::vector<ReturnedOil> SlickLayer::give_back() {
  if (!settings_.exchange) return {};
  refresh_film();
  auto returned = take_surplus(*settings_.exchange, settings_.oil.density, state_.elements);
  for (const ReturnedOil& oil : returned) state_.booked.submerged += to_milligrams(oil.mass);
  return returned;
}

std::optional<Refusal> SlickLayer::set_boom(const std::string& name, const Boom& boom) {
  if (auto fault = find_fault(boom)) return fault;
  BoomState& state = state_.booms[name];
  surface_leaks(state);
  const std::size_t segments = boom.line.size() - 1;
  state = {boom, std::vector<SlickElement>(segments), std::vector<double>(segments, 1.0)};
  work_->barriers.set(name, boom);
  return {};
}

std::optional<Refusal> SlickLayer::set_skimmer(const std::string& name, const Skimmer& skimmer) {
  if (auto fault = find_fault(skimmer)) return fault;
  state_.skimmers[name].skimmer = skimmer;
  return {};
}

void SlickLayer::remove_boom(const std::string& name) {
  const auto boom = state_.booms.find(name);
  if (boom == state_.booms.end()) return;
  surface_leaks(boom->second);
  state_.booms.erase(boom);
  work_->barriers.remove(name);
  if (state_.booms.empty())
    for (SlickElement& e : state_.elements) e.contained = false;
}

void SlickLayer::remove_skimmer(const std::string& name) { state_.skimmers.erase(name); }

void SlickLayer::surface_leaks(BoomState& boom) {
  for (SlickElement& pool : boom.passing)
    if (pool.mass > 0) state_.elements.push_back(std::exchange(pool, {}));
}

void SlickLayer::restore(SlickState state) {
  state_ = std::move(state);
  work_->barriers.build(state_.booms);
}

void SlickLayer::refresh_film() {
  Workspace& w = *work_;
  w.grid.build(state_.elements);
  const bool booms = !w.barriers.empty();
  if (booms) w.barriers.mark_near(state_.elements);
  measure_film(state_.elements, settings_.oil.density, w.grid, booms ? &w.barriers : nullptr, w.film);
}

SlickReport SlickLayer::advance(double dt, const SlickSurroundings& surroundings) {
  SlickReport report;
  report.elements = state_.elements.size();
  if (!(std::isfinite(dt) && dt > 0.0)) return report;
  Workspace& w = *work_;
  w.positions.clear();
  for (const SlickElement& e : state_.elements) w.positions.push_back(e.position);
  w.states.assign(w.positions.size(), {});
  surroundings.sample(w.positions, w.states);

  refresh_film();
  move(dt, surroundings, report);
  weather(dt);
  leak_under_booms(w.barriers, w.contacts, settings_.oil.density, settings_.water_density, dt, state_.elements,
                   state_.booms);
  merge_covering(w.film.covering, state_.elements);
  drop_beyond_patch(report);
  std::erase_if(state_.elements, [](const SlickElement& e) { return e.mass <= 0; });
  state_.booked.recovered += skim(settings_.oil.density, dt, state_.elements, state_.skimmers);
  split_large(settings_.largest_radius, settings_.most_elements, w.barriers, state_.elements);
  if (settings_.patch)
    for (SlickElement& e : state_.elements) e.position = settings_.patch->keep(e.position);
  keep_within_bound();
  report.elements = state_.elements.size();
  return report;
}

/// Where oil ends that would go from one place to another, for the closed sides of the patch, hulls and walls.
Eigen::Vector2d SlickLayer::stop_at_walls(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const SurfaceState& s,
                                          const SlickSurroundings& surroundings) const {
  const Eigen::Vector2d kept = settings_.patch ? settings_.patch->keep(to) : to;
  return s.covered || (kept - from).norm() < s.room ? kept : surroundings.go(from, kept, s);
}

void SlickLayer::move(double dt, const SlickSurroundings& surroundings, SlickReport& report) {
  Workspace& w = *work_;
  w.contacts.clear();
  w.stuck.assign(state_.elements.size(), 0);
  for (std::uint32_t i = 0; i < state_.elements.size(); ++i) {
    SlickElement& e = state_.elements[i];
    const SurfaceState& s = w.states[i];
    if (!is_usable(s)) {
      ++report.bad_surroundings;
      continue;
    }
    e.height = s.height;
    if (!s.water) {
      ++report.stranded;
      continue;
    }
    const double share = s.waves_carry ? settings_.wind_share_in_waves : settings_.wind_share;
    const Eigen::Vector2d drift = dt * (s.water_velocity + share * s.wind);
    const Eigen::Vector2d push = spread(w.law, w.film.sample[i], w.film.volume[i], dt, e);
    Eigen::Vector2d to = e.position + drift + push;
    if (s.covered) {
      ++report.pushed_out;
      to = e.position + s.way_out;
    }
    to = stop_at_walls(e.position, to, s, surroundings);
    if (!w.barriers.empty()) {
      const HeldMove held = w.barriers.hold(e.position, to, std::max(kClearance * disc_radius(e), kLeastClearance));
      if (held.held) {
        w.contacts.push_back({i, held.boom, held.segment, held.side, s.water_velocity});
        to = stop_at_walls(e.position, held.position, s, surroundings);
        if (to != held.position && w.barriers.crossed(e.position, to)) to = e.position;
      }
      w.stuck[i] = (to - e.position).dot(drift) < 0.5 * drift.squaredNorm();
    }
    e.position = to;
  }
  if (!w.barriers.empty()) mark_contained(w.barriers, w.contacts, w.film.touching, w.stuck, state_.elements);
}

void SlickLayer::weather(double dt) {
  if (!settings_.evaporation && !settings_.emulsification) return;
  for (std::size_t i = 0; i < state_.elements.size(); ++i) {
    SlickElement& e = state_.elements[i];
    const SurfaceState& s = work_->states[i];
    if (!is_usable(s)) continue;
    const double wind = s.wind.norm();
    if (settings_.evaporation) {
      const double after = evaporated_share(settings_.oil, e.evaporated, e.film * (1.0 - e.water), wind,
                                            settings_.water_temperature, e.water, dt);
      const double lost = after >= 1.0 - kLeastResidue
                              ? static_cast<double>(e.mass)
                              : static_cast<double>(e.mass) * (after - e.evaporated) / (1.0 - e.evaporated);
      const double whole = std::floor(lost + e.evaporation_rest);
      const Milligrams gone = std::min(static_cast<Milligrams>(whole), e.mass);
      e.evaporation_rest += lost - whole;
      e.evaporated = after;
      e.mass -= gone;
      state_.booked.evaporated += gone;
    }
    if (settings_.emulsification && s.water) e.water = water_content(settings_.oil, e.water, wind, dt);
  }
}

void SlickLayer::drop_beyond_patch(SlickReport& report) {
  if (!settings_.patch) return;
  const SlickPatch& patch = *settings_.patch;
  for (SlickElement& e : state_.elements) {
    e.position = patch.keep(e.position);  // oil that has leaked under a boom
    if ((e.position.array() >= patch.min.array()).all() && (e.position.array() <= patch.max.array()).all()) continue;
    state_.booked.left_patch += e.mass;
    if (e.mass > 0) ++report.left_patch;
    e.mass = 0;
  }
}

OilLedger SlickLayer::ledger() const {
  OilLedger ledger = state_.booked;
  for (const SlickElement& e : state_.elements) (e.contained ? ledger.contained : ledger.afloat) += e.mass;
  for (const auto& [name, state] : state_.booms)
    for (const SlickElement& pool : state.passing) ledger.contained += pool.mass;
  return ledger;
}

}  // namespace pelagos
