#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "physics/fluid.hpp"
#include "water_run.hpp"

namespace pelagos::validation {

// What the cases measure on particles. Slices are thin along y and mean along it.

/// Slope and value of a straight line through points, least squares.
class LineFit {
 public:
  void add(double x, double y);
  [[nodiscard]] double slope() const;
  [[nodiscard]] double at(double x) const;
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] double mean() const { return y_ / static_cast<double>(count_); }  ///< of y

 private:
  std::size_t count_ = 0;
  double x_ = 0, y_ = 0, xx_ = 0, xy_ = 0;
};

/// Pressure on a wall or in the water: the mean over particles within one support radius of (x, z), all along y,
/// weighted by the kernel of their distance in the plane. 0 where the particles fill less than a tenth of what the
/// kernel would see in full water: the place is dry. A particle at the wall stands half a spacing off it, so the value
/// is that of water about half a spacing off, too.
/// @param width  m, of the slice
[[nodiscard]] double probe_pressure(const FluidState& state, std::span<const float> pressure, double x, double z,
                                    double width);

/// Largest x of the water that hangs together, plus half a spacing. Particles hang together if their cells of one
/// spacing in the x, z plane touch, corners included; the largest such set counts, so that drops that fly ahead do not.
[[nodiscard]] double front_position(const FluidState& state);

/// Area of the convex hull of the particles in the x, z plane, m^2.
[[nodiscard]] double hull_area(std::span<const Float4> positions);

/// Area of the x, z plane within 0.75 spacings of a particle, m^2: what a lattice just covers without gaps. Counted on
/// cells of a tenth of a spacing.
[[nodiscard]] double covered_area(std::span<const Float4> positions, double spacing);

/// Smallest distance between two particles by the neighbour lists of the last step, m.
[[nodiscard]] double smallest_distance(const FluidState& state);

/// Height of the surface over the middle of columns one spacing wide: the highest particle of each plus half a
/// spacing, mean over columns, m.
[[nodiscard]] double surface_level(const FluidState& state);

/// Kinetic plus potential energy, J.
[[nodiscard]] double mechanical_energy(WaterRun& run);

/// sqrt(mean |v|^2), m/s.
[[nodiscard]] double rms_speed(const FluidParticles& particles);

/// A series of times and values, times rising.
struct Curve {
  std::vector<double> time, value;
  void add(double t, double v) {
    time.push_back(t);
    value.push_back(v);
  }
  /// Linear in between, the end values beyond.
  [[nodiscard]] double at(double t) const;
  /// First time at which the value reaches `level`, not a number if it never does.
  [[nodiscard]] double reaches(double level) const;
};

/// Columns of a CSV file of numbers: '#' comments, one line of names. With `series` only the rows whose first cell is
/// that, and the columns after it. Throws std::runtime_error naming file and line where a cell is no number.
[[nodiscard]] std::vector<std::vector<double>> read_columns(const std::string& file, const std::string& series = "");

}  // namespace pelagos::validation
