#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "oil/response.hpp"
#include "oil/slick_element.hpp"
#include "oil/slick_frame.hpp"
#include "oil/slick_settings.hpp"
#include "oil/slick_state.hpp"
#include "oil/slick_surroundings.hpp"
#include "text/refusal.hpp"
#include "values/oil_ledger.hpp"

namespace pelagos {

/// Oil that is too thick for the slick and goes back to the particles.
struct ReturnedOil {
  Eigen::Vector2d position;  ///< m, world: centre of what was taken
  std::size_t particles;     ///< >= 1
  double mass;               ///< kg, particles times the mass of one
};

/// What happened in a step.
struct SlickReport {
  std::size_t elements = 0;          ///< after the step
  std::size_t bad_surroundings = 0;  ///< elements that kept their place: what they met was not finite
  std::size_t stranded = 0;          ///< elements that lie dry
  std::size_t pushed_out = 0;        ///< elements moved out from under hulls and walls
  std::size_t left_patch = 0;        ///< elements taken out beyond the patch
};

/// Oil thinner than any particle: a film on the water, carried by it and by the wind, that spreads, evaporates, takes
/// up water, piles up at booms and is skimmed. One layer holds one kind of oil; it never sees the fluid.
///
/// Drift: the surface water's velocity plus a share of the wind's (SlickSettings::wind_share).
///
/// Spreading is a thin film's flow, dh/dt = div(kappa h grad h), with the mobility that Fay's forces give the oil at
/// its age t (time since its release):
///   kappa = min( c_I g' t ,  c_V g' sqrt(t / nu) h ) ,   g' = g (rho_w - rho_o) / rho_w
/// Gravity against the oil's own inertia lets a front reach u ~ g' t grad h; against the friction of the water below,
/// whose boundary layer has grown to sqrt(nu t), u ~ g' h grad h sqrt(t / nu). The film obeys whichever is slower; they
/// cross where the oil is as thick as the boundary layer, which is Fay's criterion. The similarity solutions are Fay's:
///   round    R = k_I (g' V t^2)^(1/4) ,  then R = k_v (g' V^2 t^(3/2) / nu^(1/2))^(1/6)      (Fay 1969, 1971)
///   a strip  L ~ (g' A t^2)^(1/3)     ,  then L ~ (g' A^2 t^(3/2) / nu^(1/2))^(1/4)
/// with k_I = 1.14 and k_v = 1.45 (Fay 1971; 1.14 is also the similarity solution's with a front Froude number of 1;
/// PyGNOME uses 1.45 and has 1.53 and 1.21 beside it). So slicks need not be told apart: a round spill, the long plume
/// of a leaking ship and two slicks that meet all spread by their own shape. Elements carry the film as bells and move
/// and grow down its energy (film.hpp), which makes one element spread as hundreds do: the covered area of a round
/// release keeps within 13 % of Fay's in the inertial regime and within 18 % in the viscous one, for 1 to 4000
/// elements. Spreading ends at the terminal thickness. Fay's third regime, surface tension, R = 2.30 (sigma^2 t^3 /
/// (rho^2 nu))^(1/4), is left out: it drives films that are thinner than the terminal thickness, and so is the oil's
/// own viscosity.
///
/// At hulls, walls and closed sides of the patch (SlickSurroundings::go, SlickPatch::closed) elements stop and keep the
/// part of their way along them; none is lost there.
///
/// At booms (Boom) the film piles up. Held oil rests on water that passes below, whose boundary layer does not grow
/// with time; there it spreads against the current at most as fast as a front of Froude number 1, sqrt(g' h), so that a
/// pile thickens until g' h = U^2.
///
/// Deterministic: the same calls give the same bits; one thread does it all. Mass is exact to the milligram.
///
/// Functions that return an optional refusal change nothing where they return one.
class SlickLayer {
 public:
  /// Throws std::invalid_argument naming field, value and what is allowed.
  explicit SlickLayer(const SlickSettings& settings);
  ~SlickLayer();
  SlickLayer(SlickLayer&&) noexcept;
  SlickLayer& operator=(SlickLayer&&) noexcept;

  [[nodiscard]] const SlickSettings& settings() const { return settings_; }

  /// New oil on the water, as a disc.
  /// @param mass    kg, 1e-6 to 1e9
  /// @param radius  m, 0.001 to 1e6
  [[nodiscard]] std::optional<Refusal> release(double mass, const Eigen::Vector2d& position, double radius);
  /// New oil in the particle phase. The ledger counts it; the particles are the caller's.
  [[nodiscard]] std::optional<Refusal> release_submerged(double mass);
  /// Oil of the particle phase becomes film: for particles that the water has drawn out thinner than themselves. It is
  /// fresh oil to the layer, whatever it went through before. Refused beyond what is submerged.
  [[nodiscard]] std::optional<Refusal> take(double mass, const Eigen::Vector2d& position, double radius);
  /// Film above settings().exchange->thickness becomes particles again; nothing without an exchange.
  [[nodiscard]] std::vector<ReturnedOil> give_back();
  /// Oil of the particle phase that left the patch.
  [[nodiscard]] std::optional<Refusal> drop_submerged(double mass);

  /// Places a boom or skimmer, or replaces the one of that name (a boom's leaking oil surfaces first; a skimmer keeps
  /// what it has recovered). Refused if find_fault(...) says so. A boom laid through oil parts it. How many there may
  /// be is the caller's to check (find_no_room of values/given_names.hpp).
  [[nodiscard]] std::optional<Refusal> set_boom(const std::string& name, const Boom& boom);
  [[nodiscard]] std::optional<Refusal> set_skimmer(const std::string& name, const Skimmer& skimmer);
  /// Nothing happens where there is none of that name.
  void remove_boom(const std::string& name);
  void remove_skimmer(const std::string& name);

  /// One step. dt: s, finite, > 0; else nothing happens. Any size; drift is first order, so steps of a wave period's
  /// tenth or less follow waves.
  SlickReport advance(double dt, const SlickSurroundings& surroundings);

  [[nodiscard]] std::span<const SlickElement> elements() const { return state_.elements; }
  [[nodiscard]] OilLedger ledger() const;
  [[nodiscard]] SlickStatistics statistics() const;
  [[nodiscard]] SlickFrame frame() const { return make_frame(state_.elements); }
  /// Report of each skimmer by name: state().skimmers.
  [[nodiscard]] const SlickState& state() const { return state_; }
  /// Goes on from a state of a layer with the same settings.
  void restore(SlickState state);

 private:
  struct Workspace;

  void add(Milligrams mass, const Eigen::Vector2d& position, double radius);
  void keep_within_bound();
  [[nodiscard]] Eigen::Vector2d stop_at_walls(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                                              const SurfaceState& state, const SlickSurroundings& surroundings) const;
  void move(double dt, const SlickSurroundings& surroundings, SlickReport& report);
  void weather(double dt);
  void drop_beyond_patch(SlickReport& report);
  void refresh_film();
  void surface_leaks(BoomState& boom);

  SlickSettings settings_;
  SlickState state_;
  std::unique_ptr<Workspace> work_;  ///< scratch, and what follows from the state
};

}  // namespace pelagos
