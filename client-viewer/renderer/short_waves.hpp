#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/fourier.hpp"
#include "waves/wave_moment.hpp"

namespace pelagos {

/// A square of short waves that repeats in x (east) and y (north).
struct ShortWaveTile {
  struct Texel {
    float slope_x = 0, slope_y = 0;
    float square = 0;  ///< slope_x^2 + slope_y^2: its mean over an area tells the variance of what the area blurs
    float foam = 0;    ///< 0..1, of crests that break or broke
  };
  static constexpr int kSide = 128;  ///< texels
  double length = 1.0;               ///< m, of a side
  std::vector<Texel> texels;         ///< row by row from the south-west
};
inline constexpr std::size_t kShortWaveTiles = 3;

/// Waves that are drawn and that nothing feels: those too short for the wave components, down to ripples; and stand-ins
/// for components that the grid of the far sea is too coarse for at a distance, with their spectrum but not their
/// phases. All of it follows from seed, time, components and wind, so that every channel draws the same.
class ShortWaves {
 public:
  explicit ShortWaves(std::uint64_t seed);

  /// The sea from now on: components and wind (m/s, towards). Cheap where nothing has changed.
  void set_sea(std::span<const MomentWave> components, const Eigen::Vector2d& wind);
  /// Tiles at a simulation time, s.
  void evaluate(double time);

  [[nodiscard]] const std::array<ShortWaveTile, kShortWaveTiles>& tiles() const { return tiles_; }
  /// m; longer waves of the tiles stand in for components. Infinite without components.
  [[nodiscard]] double shortest_component() const { return shortest_component_; }
  /// Slope variance of the waves that are too short for the tiles.
  [[nodiscard]] double variance_below() const { return variance_below_; }

 private:
  struct Cell {
    std::uint32_t index = 0, opposite = 0;  ///< of the wave number in the grid, and of its negative
    float kx = 0, ky = 0, number = 0;       ///< rad/m; number: their length
    double omega = 0;                       ///< rad/s
    std::complex<float> height;             ///< m, amplitude with its phase at time zero
  };
  using Power = std::vector<double>;  ///< slope variance of each wave number

  void deposit(std::span<const MomentWave> components, std::size_t tile, Power& power) const;
  void add_wind_sea(std::size_t tile, const Eigen::Vector2d& wind, double per_octave, double shortest_component,
                    Power& power) const;
  void fill_cells(std::size_t tile, const Power& power);
  void evaluate_tile(std::size_t tile, double time);

  std::array<ShortWaveTile, kShortWaveTiles> tiles_;
  std::array<std::vector<std::complex<float>>, kShortWaveTiles> random_;  ///< of each wave number, mean square 1
  std::array<std::vector<Cell>, kShortWaveTiles> cells_;
  std::array<double, kShortWaveTiles> folding_ = {};  ///< root mean square of the crests' folding
  FourierSquare fourier_;
  std::vector<std::complex<float>> slopes_, folds_;
  std::vector<std::int32_t> key_;  ///< of the sea that the cells are for
  double shortest_component_ = HUGE_VAL;
  double variance_below_ = 0.0;
  double whitecaps_ = 0.0;
};

/// Mean square slope of the sea by Cox & Munk (1954). @param wind  m/s, at 10 m
[[nodiscard]] double mean_square_slope(double wind);
/// Share of the sea that whitecaps cover by Monahan & O'Muircheartaigh (1980). @param wind  m/s, at 10 m
[[nodiscard]] double whitecap_cover(double wind);
/// Height of the envelope of the crests' folding, in its standard deviations, above which crests break, so that trails
/// and patterns leave about the whitecaps that the wind asks for.
[[nodiscard]] double breaking_envelope(double wind);

}  // namespace pelagos
