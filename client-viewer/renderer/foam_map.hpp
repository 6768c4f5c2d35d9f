#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <span>
#include <vector>

#include "packing/surface_particle.hpp"
#include "waves/patch_blend.hpp"

namespace pelagos {

/// A hull that moves through the water.
struct MovingHull {
  std::uint32_t body = 0;
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< m, world
  Eigen::Vector2d way = Eigen::Vector2d::UnitX();   ///< unit, along which she moves: from one end to the other
  double half_length = 1.0, half_beam = 1.0;        ///< m
  double speed = 0.0;                               ///< m/s, through the water, along `way`
  double curvature = 0.0;                           ///< 1/m, of her path, positive to port
  double slam = 0.0;       ///< m/s: how fast the water rises at her bow, or the bow comes down on it; < 0: they part
  double bow_water = 0.0;  ///< m, height of the water at her bow above its mean level
};

/// A hull between two instants. @param share  0: as `a`, 1: as `b`
[[nodiscard]] MovingHull between(const MovingHull& a, const MovingHull& b, double share);

/// Foam of the simulated water at an instant. Spans must outlive the call.
struct PatchFoam {
  std::span<const SurfaceParticle> particles;
  std::span<const std::uint8_t> loose;                  ///< of each particle, 1 for water in the air; may be empty
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();     ///< m, world, of the particles
  double spacing = 1.0;                                 ///< m
  Eigen::Vector2d half_size = Eigen::Vector2d::Zero();  ///< m, of the patch about the origin
  PatchBlend blend;                                     ///< foam outside of what is shown is not laid down
};

/// A square of the water, texel by texel. The lattice of the texels is fixed in the water; the square is a window on it
/// that goes along with the eye. A place of the lattice has the texel of its index modulo kSide.
struct FoamLevel {
  static constexpr int kSide = 512;  ///< texels
  struct Texel {
    float white = 0, churned = 0;  ///< at the time FoamMap::reference()
  };
  /// Texels from `low` up to before `high`, as indices of the lattice.
  struct Area {
    std::array<std::int64_t, 2> low{}, high{};
    [[nodiscard]] bool empty() const { return low[0] >= high[0] || low[1] >= high[1]; }
  };

  double texel = 1.0;                      ///< m
  std::array<std::int64_t, 2> first = {};  ///< lattice index of the window's south-west texel
  std::vector<Texel> texels;
  Area changed;  ///< since the last take_changed()

  [[nodiscard]] Texel& at(std::int64_t x, std::int64_t y) {
    return texels[static_cast<std::size_t>((y & (kSide - 1)) * kSide + (x & (kSide - 1)))];
  }
};
inline constexpr std::size_t kFoamLevels = 2;

/// Foam and bubbles that stay on the water: laid down by hulls that move through it, by foam of the particles and by
/// spray that falls, carried by the current, fading over minutes. Everything is laid down at whole multiples of kTick
/// of simulation time, between two instants that were shown by linear interpolation, so that viewers which show the
/// same frames have the same foam. A viewer that comes late has not seen where hulls came from: it assumes that they
/// have kept speed and turn rate. Deposits raise a texel to their amount; fading is a common factor (see faded()).
class FoamMap {
 public:
  static constexpr double kTick = 0.2;                              ///< s
  static constexpr double kFadeWhite = 40.0, kFadeChurned = 100.0;  ///< s, to 1 / e
  static constexpr double kLongestGap = 5.0;  ///< s: a longer one between two instants starts anew

  static constexpr std::ptrdiff_t kMostHulls = 32;  ///< the nearest to the eye

  FoamMap();

  /// Goes on to an instant, which may be the last one again. An instant more than a second earlier, or one more than
  /// kLongestGap later, starts anew.
  /// @param eye   m, world: the middle of the window from now on
  /// @param flow  m/s: how the water moves as a whole
  void advance(double time, const Eigen::Vector2d& eye, const Eigen::Vector2d& flow, std::span<const MovingHull> hulls,
               const PatchFoam& patch);

  /// Whether anything has been laid down.
  [[nodiscard]] bool present() const { return present_; }
  [[nodiscard]] const std::array<FoamLevel, kFoamLevels>& levels() const { return levels_; }
  /// What has changed of a level since the last call.
  [[nodiscard]] FoamLevel::Area take_changed(std::size_t level);
  [[nodiscard]] double reference() const { return reference_; }
  /// Share of white foam and of bubbles that is left of what the texels hold.
  [[nodiscard]] Eigen::Vector2d faded(double time) const;
  /// m, world: where the lattice's corner (index 0, 0) has drifted.
  [[nodiscard]] const Eigen::Vector2d& drift() const { return drift_; }
  /// White foam and bubbles, 0..1, at a place (m, world) as the texel there has them in the finest level that reaches
  /// so far; nothing outside.
  [[nodiscard]] Eigen::Vector2d at(const Eigen::Vector2d& place, double time) const;

 private:
  /// Where a stern was.
  struct TrailPoint {
    double time = 0.0;
    Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< m, lattice
    double wash = 0.0, half_width = 0.0;              ///< 0..1; m
  };
  struct Trail {
    MovingHull hull;  ///< at the last instant
    std::deque<TrailPoint> points;
  };
  struct Band {
    Eigen::Vector2d from, to;  ///< m, lattice
    double half_width = 1.0;   ///< m
    double white = 0.0, churned = 0.0, rims = 0.0;
    double time = 0.0;  ///< s, at which it is laid down
  };

  void restart(double time, const Eigen::Vector2d& flow);
  void move_window(const Eigen::Vector2d& eye);
  void tick(double time, double share, std::span<const MovingHull> hulls);
  void follow(Trail& trail, const MovingHull& hull, double time);
  void assume_past(Trail& trail, const MovingHull& hull, double time);
  void lay_sides(const MovingHull& hull, double time);
  void lay_wake(const Trail& trail, double time);
  void lay_patch(const PatchFoam& patch, double time);
  void lay(const Band& band);
  void lay(FoamLevel& level, const Band& band);
  void raise(FoamLevel& level, const Eigen::Vector2d& place, double radius, float white);
  void renew_reference(double time);

  std::array<FoamLevel, kFoamLevels> levels_;
  std::map<std::uint32_t, Trail> trails_;
  Eigen::Vector2d drift_ = Eigen::Vector2d::Zero();
  double reference_ = 0.0, shown_ = 0.0;  ///< s
  std::int64_t last_tick_ = 0;
  bool started_ = false, present_ = false;
};

/// How white a hull of that speed through the water leaves it astern, 0..1: at 4, 8, 14 and 20 knots 0.16, 0.49, 0.87
/// and 0.99.
[[nodiscard]] double wash_of(double speed);

}  // namespace pelagos
