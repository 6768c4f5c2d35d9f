#pragma once

#include "rigid/added_mass.hpp"
#include "rigid/free_body.hpp"
#include "simulation/sea_load.hpp"

namespace pelagos {

// How the sea around carries a free body, in one step of dt (s). With u the motion of the water at the hull, v that of
// the body before the step, g gravity (which has acted already), and s the share of its displacement that the sea
// carries, 0..1:
//   (M + s A + dt (B + Q) + dt^2/4 K) dv = dt [F + s A (du/dt - g) + B (u - v) + D]
//   F  Froude-Krylov force and moment (sea_load.hpp)
//   A  added mass of the ellipsoid with the body's half length and half beam, and so deep that its lower half displaces
//      what the body does at rest
//   B  radiation: a share of the critical damping in heave, roll and pitch; along the surface and in yaw a slow decay
//   D  quadratic drag on the panels, Q its rate
//   K  rho g times the waterplane and its second moments. A quarter of it over dt^2 bounds the step's error of the
//      period as the trapezoidal rule does, and keeps what is small and light stable

/// What does not change about a body at sea.
struct SeaBody {
  SeaPanels panels;
  AddedMass added;            ///< of the half ellipsoid, as multiples of its displaced mass
  double displacement = 0.0;  ///< m^3, at rest; what it has at most
  double length = 0.0;        ///< m, of its box, the longer horizontal side
};

/// @param mesh  closed   @param mass  kg; 0: of a body that follows poses   @param density  kg/m^3, of the water
[[nodiscard]] SeaBody make_sea_body(const TriangleMesh& mesh, double mass, double density);

/// Shares of critical damping. Ships have 0.2 to 0.4 in heave and pitch, 0.05 to 0.1 in roll (Newman 1977,
/// section 6.19; Lloyd 1989, chapter 11).
inline constexpr double kHeaveDamping = 0.2, kPitchDamping = 0.2, kRollDamping = 0.1;
/// Of sqrt(g / length): how fast a motion along the surface, or a yaw rate, decays towards the water's.
inline constexpr double kSurgeDamping = 0.02;

/// Of its displacement, what the sea carries: s, 0..1.
[[nodiscard]] double carried_share(const SeaBody& sea_body, const SeaLoad& load, const CarryingSea& sea);

/// The velocity that the step adds to that of the centre, and the turn.
/// @param load  about the body's centre of mass
[[nodiscard]] Vector6d sea_push(const SeaBody& sea_body, const FreeBody& body, const SeaLoad& load,
                                const CarryingSea& sea, double dt);

/// N s, N m s: what gave the body that push; along what is led, the sea's own impulse on it.
[[nodiscard]] Vector6d impulse_of(const FreeBody& body, const Vector6d& push, const Vector6d& on_led);

}  // namespace pelagos
