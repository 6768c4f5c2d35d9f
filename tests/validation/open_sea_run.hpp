#pragma once

#include <Eigen/Core>
#include <vector>

#include "harness.hpp"
#include "world_run.hpp"

namespace pelagos::validation {

/// A patch of an open sea, its middle at the origin at the start.
struct SeaPatch {
  double spacing = 1.0;                                ///< m
  double length = 80.0, width = 80.0, depth = 6.0;     ///< m, along x, y; simulated
  bool slice = false;                                  ///< periodic along y
  double zone = 15.0;                                  ///< m
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< m/s, of the patch
};
[[nodiscard]] Scene open_sea_scene(const SeaPatch& patch);

/// Waves of a JONSWAP sea with gamma 3.3, one by one.
/// @param spread_deg  directions are even over +- this about the mean; 0: long-crested
[[nodiscard]] std::vector<WaveSettings> jonswap_waves(double height, double peak_period, double to_deg,
                                                      double spread_deg, std::uint64_t seed, int count = 40);

/// A height of the water and what the wave field says, at one place and time.
struct SurfaceSample {
  double time = 0.0, x = 0.0;           ///< s; m, world
  double measured = 0.0, theory = 0.0;  ///< m above the mean level
};

/// Reads the water's surface and the wave field's at places about the middle of the patch.
class SurfaceGauges {
 public:
  /// @param places  m, from the middle of the patch
  explicit SurfaceGauges(std::vector<Eigen::Vector2d> places) : places_(std::move(places)) {}
  void read(World& world);
  [[nodiscard]] const std::vector<SurfaceSample>& samples() const { return samples_; }
  void clear() { samples_.clear(); }

 private:
  std::vector<Eigen::Vector2d> places_;
  std::vector<SurfaceSample> samples_;
  TaskPool pool_{1};
};

/// `columns` x `rows` places evenly over +- the half lengths.
[[nodiscard]] std::vector<Eigen::Vector2d> gauge_grid(double half_x, int columns, double half_y, int rows);

/// Reads gauges at equal times from `from` on, until `end`; s.
void record(Session& session, const Subject& subject, WorldRun& run, SurfaceGauges& gauges, double from, double every,
            double end);

/// How the samples follow the theory.
struct SeaAgreement {
  double gain = 0.0;         ///< sum h h_theory / sum h_theory^2, about the means
  double correlation = 0.0;  ///< Pearson's
  double level = 0.0;        ///< m, mean height less the theory's
  double deviation = 0.0;    ///< m, rms of the difference about the means
};
[[nodiscard]] SeaAgreement agreement(const std::vector<SurfaceSample>& samples);

/// A regular wave along +x, fitted by least squares with an incident, a second-order and a returning part.
struct RegularFit {
  double amplitude = 0.0;  ///< over theory
  double phase_deg = 0.0;  ///< ahead of theory
  double reflected = 0.0;  ///< over the theory's amplitude
};
/// @param wavenumber  rad/m   @param omega  rad/s
[[nodiscard]] RegularFit fit_regular(const std::vector<SurfaceSample>& samples, double wavenumber, double omega);

/// m, amplitudes of the parts of the measured heights that run along +x and against it, fitted as fit_regular does.
struct WayAmplitudes {
  double out = 0.0, back = 0.0;
};
[[nodiscard]] WayAmplitudes fit_ways(const std::vector<SurfaceSample>& samples, double wavenumber, double omega);

}  // namespace pelagos::validation
