#include <algorithm>
#include <cmath>
#include <vector>

#include "harness.hpp"
#include "measures.hpp"
#include "physics/pressure.hpp"

namespace pelagos::validation {

namespace {

constexpr double kDepth = 1.0;                    // m
constexpr double kEnd = 5.0, kAverageFrom = 4.0;  // s
constexpr int kColumns = 20, kSlice = 4;          // spacings along x (between mirrors), along y (periodic)

struct Setup {
  const char* name;
  int layers;
  bool sampled;  ///< the bottom is a wall of samples, else a mirror
  bool quick;
};

// Aim: what a good code reaches. The bound of the bottom's pressure is half a spacing of water at 20 layers, that of
// the side's force what one layer too heavy by half adds there.
constexpr Goal kBottom{Goal::Kind::kAtMost, 0.2, 2.5}, kSide{Goal::Kind::kAtMost, 1.0, 5.0};
constexpr Setup kSetups[] = {
    {"H/d 20, mirror", 20, false, true},
    {"H/d 40, mirror", 40, false, false},
    {"H/d 20, samples", 20, true, true},
    {"H/d 40, samples", 40, true, false},
};

/// Means over the last second.
struct Means {
  LineFit profile;  ///< pressure over height, all particles but those within two spacings of surface and bottom
  std::vector<LineFit> layers;  ///< the same by layers of one spacing from the bottom
  double kinetic = 0, level = 0, force = 0;
  int samples = 0;
};

class Column {
 public:
  Column(const Session& session, const Setup& setup, const std::string& solver)
      : d_(kDepth / setup.layers),
        parameters_(patch_parameters({kColumns * d_, kSlice * d_, 1.3 * kDepth}, d_,
                                     {Edge::kMirror, Edge::kPeriodic, setup.sampled ? Edge::kWall : Edge::kMirror})),
        bottom_(setup.sampled ? 0.5 * d_ : 0.0),
        run_(session.options().threads, parameters_, {solver},
             fill_block(parameters_, {kColumns * d_, kSlice * d_, kDepth + (setup.sampled ? d_ : 0.0)})) {}

  WaterRun& run() { return run_; }

  void sample(Means& means) {
    pressure_.resize(run_.state().particles.count);
    compute_pressure(run_.state(), pressure_);
    means.layers.resize(static_cast<std::size_t>(std::lround(kDepth / d_)));
    for (std::size_t i = 0; i < pressure_.size(); ++i) {
      const double height = static_cast<double>(run_.state().particles.position[i].z) - bottom_;
      const auto pressure = static_cast<double>(pressure_[i]);
      if (height < kDepth - 2.0 * d_ && height > 2.0 * d_) means.profile.add(height, pressure);
      const double layer = std::clamp(height / d_, 0.0, static_cast<double>(means.layers.size()) - 1.0);
      means.layers[static_cast<std::size_t>(layer)].add(height, pressure);
    }
    means.kinetic += run_.last().kinetic_energy;
    means.level += surface_level(run_.state()) - bottom_;
    means.force += side_force();
    ++means.samples;
  }

  /// Mean pressure of each layer of one spacing over the samples.
  void write_profile(const Means& means, Series series) const {
    for (std::size_t k = 0; k < means.layers.size(); ++k)
      series.add({(static_cast<double>(k) + 0.5) * d_ / kDepth, means.layers[k].mean() / weight()});
  }

  /// rho g H, Pa.
  [[nodiscard]] double weight() const { return parameters_.rest_density * parameters_.gravity * kDepth; }
  [[nodiscard]] double energy_scale() const {
    return static_cast<double>(run_.state().particles.count) * parameters_.rest_density * parameters_.volume() *
           parameters_.gravity * kDepth;
  }
  [[nodiscard]] double spacing() const { return d_; }

 private:
  /// Pressure along the side, by probes half a spacing off it, N a metre of width.
  double side_force() {
    double force = 0.0;
    for (double z = 0.5 * d_; z < kDepth; z += d_)
      force += d_ * probe_pressure(run_.state(), pressure_, 0.5 * d_, bottom_ + z, kSlice * d_);
    return force;
  }

  double d_;
  FluidParameters parameters_;
  double bottom_;  ///< m: where the water ends below, half a spacing above wall samples
  WaterRun run_;
  std::vector<float> pressure_;
};

void run_one(Session& session, const Setup& setup, const Subject& subject) {
  Column column(session, setup, subject.solver);
  Means means;
  column.run().advance_to(kAverageFrom, [&] { session.progress(subject, column.run().time() / kEnd); });
  int steps = 0;
  column.run().advance_to(kEnd, [&] {
    session.progress(subject, column.run().time() / kEnd);
    if (steps++ % 5 == 0) column.sample(means);
  });
  const double weight = column.weight(), n = means.samples;
  session.add(subject,
              {"bottom pressure error", 100.0 * (means.profile.at(0.0) / weight - 1.0), "%", "rho g H", kBottom});
  session.add(subject,
              {"pressure gradient error", 100.0 * (means.profile.slope() / (-weight / kDepth) - 1.0), "%", "rho g"});
  session.add(subject, {"force on the side error", 100.0 * (means.force / n / (0.5 * weight * kDepth) - 1.0), "%",
                        "rho g H^2 / 2", setup.sampled ? Goal{} : kSide});
  session.add(subject, {"pressure of the lowest layer error",
                        100.0 * (means.layers[0].mean() / (weight * (1.0 - 0.5 * column.spacing() / kDepth)) - 1.0),
                        "%", "rho g (H - d/2)"});
  session.add(subject,
              {"surface level error", (means.level / n - kDepth) / column.spacing(), "d", "H", at_most(0.25, 0.5)});
  session.add(subject, {"kinetic energy left after 5 s", means.kinetic / n / column.energy_scale(), "m g H", "0",
                        at_most(1e-5, 1e-3)});
  session.add_cost(subject, column.run().cost());
  column.write_profile(means, session.series(subject, "profile", "height,pressure"));
}

}  // namespace

void run_hydrostatic(Session& session) {
  for (const Setup& setup : kSetups) {
    if (session.quick() && !setup.quick) continue;
    for (const std::string& solver : session.solvers({"corrected", "hybrid", "dfsph", "pbf"})) {
      const Subject subject{"hydrostatic", setup.name, solver, kDepth / setup.layers};
      session.attempt(subject, [&] { run_one(session, setup, subject); });
    }
  }
}

}  // namespace pelagos::validation
