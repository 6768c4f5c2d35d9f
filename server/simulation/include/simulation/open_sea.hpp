#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "physics/fluid.hpp"
#include "values/open_edges.hpp"
#include "values/patch_frame.hpp"
#include "values/scene.hpp"
#include "waves/wave_field.hpp"

namespace pelagos {

// A patch of an open sea. Waves of the wave field run in and out through its edges, what the patch itself makes leaves
// through them, and its lower side is a material surface of the wave field, so the water is as deep as the field's.
//
// Theory: the solution of first order in Lagrange's coordinates. Water that rests at the label (X, Z) is at X + D(X, Z,
// t) (evaluate_displacement) with the velocity V(X, Z, t) (evaluate_motion at the label); Z = const are isobars.
//   rim    three columns of particles all around stand at X + D and move with V; their pressure is that of their labels
//   zone   inside the rim the water is drawn to V: a = (1 - e^(-s g dt)) / dt (V - v) with s = smoothstep from 0 at the
//          zone's inner edge to 1 at the rim. Places are not drawn, so a wave that leaves is not thrown back
//   floor  the material surface Z = -depth with its slopes and velocity; or a sea bed, which in rim and zones is level
// (Zones: relaxation zones as in Jacobsen et al. 2012; there by blending values, here as an acceleration. Particles
// that are prescribed at open boundaries: Lastiwka et al. 2009, there with the inner pressure, here with the theory's.)

/// What an open sea is cut out by. Local coordinates; the patch's sides across open axes are whole spacings long.
struct OpenSeaShape {
  double spacing = 1.0;        ///< m, d
  Region patch;                ///< m, the water's sides along x and y; z does not matter
  std::array<bool, 2> open{};  ///< whether the edges across x, y are open
  double level = 0.0;          ///< m, local z of the mean level
  double depth = 0.0;          ///< m, simulated, below the mean level; whole spacings
  double zone = 0.0;           ///< m, width of the zone inside the rim
  Floor bed;                   ///< the sea bed; empty: the floor is a material surface of the wave field
};

/// The water of an open sea at a time.
struct OpenSeaWater {
  std::vector<Float4> position, velocity, label;
};

/// What `renew` did.
struct Renewal {
  std::size_t created = 0;
  std::size_t deleted = 0;  ///< that left, or were too much
  std::size_t spray = 0;    ///< of these, drops that flew over the rim
};

/// How far the water of the zones is from the theory's motion.
struct ZoneMismatch {
  double squares = 0.0;  ///< m^2/s^2, sum of |v - V|^2
  double count = 0.0;    ///< particles
  ZoneMismatch& operator+=(const ZoneMismatch& other) {
    squares += other.squares;
    count += other.count;
    return *this;
  }
};

/// That of a scene with open edges; nothing of others. @param frame  of the patch
[[nodiscard]] std::optional<OpenSeaShape> open_sea_shape(const Scene& scene, const PatchFrame& frame);
/// m, of the scene's sea; kInfiniteDepth where it gives none.
[[nodiscard]] double sea_depth(const Scene& scene);

class OpenSea {
 public:
  explicit OpenSea(const OpenSeaShape& shape);

  /// The water as the wave field has it at `time`, on a lattice of labels. Over a bed that is not level the layers of a
  /// column are as thick as its depth asks for.
  /// @param anchor  m, world: where local x = y = 0 is
  [[nodiscard]] OpenSeaWater fill(TaskPool& pool, const WaveField& sea, const Eigen::Vector2d& anchor, double time,
                                  double next_dt) const;

  /// m, of the water at rest; 0 where the bed is dry.
  [[nodiscard]] double depth_at(double x, double y) const;

  /// Before a step from `time` over dt: where the rim will be, and the floor.
  void give(TaskPool& pool, const WaveField& sea, const Eigen::Vector2d& anchor, double time, double dt,
            FluidState& fluid) const;

  /// After a step that has reached `time`: draws the zones' water to the theory, into its acceleration.
  ZoneMismatch draw(TaskPool& pool, const WaveField& sea, const Eigen::Vector2d& anchor, double time, double dt,
                    FluidState& fluid) const;

  /// Between steps: takes out what has left, and some of what is too much near the surface of the zones.
  /// @param wanted  particles that are not held, at the mean level
  [[nodiscard]] Renewal renew(TaskPool& pool, std::size_t wanted, FluidState& fluid) const;

  /// Between steps: moves the patch by one spacing along an open axis, 0 or 1, up (`way` 1) or down it (-1). Local zero
  /// goes along, so all positions and labels shift. In front a column of the rim is new and the rim's last one becomes
  /// free; behind, water that is now in the rim is held from here on and what lies beyond it is taken out.
  /// @param anchor  m, world: where local x = y = 0 is after the move   @param dt  s, of the coming step, about
  [[nodiscard]] Renewal shift(TaskPool& pool, const WaveField& sea, const Eigen::Vector2d& anchor, double time,
                              double dt, std::size_t axis, int way, FluidState& fluid) const;

  [[nodiscard]] const OpenSeaShape& shape() const { return shape_; }
  [[nodiscard]] double rim() const { return kRimColumns * shape_.spacing; }  ///< m
  /// m, from the nearest open edge inwards; negative beyond it. Large without open edges.
  [[nodiscard]] double inside(double x, double y) const;
  /// m, from the upper (way 1) or lower (-1) edge across an axis inwards.
  [[nodiscard]] double inside_of(std::size_t axis, int way, float at) const;
  /// How strongly water at a place is drawn, 0..1.
  [[nodiscard]] double draw_share(double x, double y) const;

  /// Bodies do not meet the rim, and the water inside it more and more over this many spacings; what lacks, the wave
  /// field gives them.
  static constexpr double kFadeWidth = 4.0;
  [[nodiscard]] CouplingFade coupling_fade() const;

  /// The waves that the patch takes part in.
  [[nodiscard]] WaveMoment moment(const WaveField& sea, const Eigen::Vector2d& anchor, double time) const;

 private:
  OpenSeaShape shape_;
};

}  // namespace pelagos
