#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "oil/slick_layer.hpp"
#include "physics/fluid.hpp"
#include "simulation/bodies.hpp"
#include "simulation/water_surface.hpp"
#include "text/refusal.hpp"
#include "values/current.hpp"
#include "values/oil_budget.hpp"
#include "values/patch_frame.hpp"
#include "values/scene.hpp"
#include "values/slick.hpp"
#include "values/spill.hpp"
#include "wind/air.hpp"

namespace pelagos {

/// What the oil meets in a step.
struct SpillSea {
  const Bodies& bodies;
  const SurfaceGrid& surface;        ///< with velocities; empty where nobody asks (OilSpill::asks_surface)
  const Air* air = nullptr;          ///< null: no wind
  const Current* current = nullptr;  ///< null: none
  double time = 0.0;                 ///< s
};

/// A source that runs.
struct OilSource {
  ReleaseOil settings;
  double left = 0.0;     ///< s
  double pending = 0.0;  ///< m^3 that has flowed out and is not in the water yet
  std::uint64_t made = 0;
  SourceStatus status;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("settings", self.settings);
    visit("left", self.left);
    visit("pending", self.pending);
    visit("made", self.made);
    visit("status", self.status);
  }
};

/// All that changes about the oil, but for the phases of the particles.
struct OilSpillState {
  SlickState layer;
  std::map<std::string, OilSource> sources;
  std::uint32_t particles = 0;
  std::int64_t displaced = 0;   ///< particles of water
  double held_back = 0.0;       ///< kg
  double since_exchange = 0.0;  ///< s
  double since_film = 0.0;      ///< s

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("layer", self.layer);
    visit("sources", self.sources);
    visit("particles", self.particles);
    visit("displaced", self.displaced);
    visit("held_back", self.held_back);
    visit("since_exchange", self.since_exchange);
    visit("since_film", self.since_film);
  }
};

/// The oil of a world: sources, the particle phase's part in it, the slick layer, and the ledger over both.
///
/// Oil comes and goes in the particle phase by turning particles of water into oil and back, where they are: at rest
/// density, so no pressure jumps, and nothing is pushed aside. What is kept is volume, as in an open sea, whose level a
/// spill does not raise: the water that made room is booked as displaced. Mass of oil is exact: a particle of oil is
/// to_milligrams(rho_oil d^3).
///
/// With OilModel::kBoth an oil particle that lies at the surface with less than a layer of oil around it becomes film
/// (a disc of its d^2), and film thicker than a particle becomes particles again. With kSlick there is no particle
/// phase and every source feeds the film above it; with kParticles the film stays empty but the ledger is kept.
class OilSpill {
 public:
  /// Counts the oil that the scene starts with. @param frame  of the patch
  OilSpill(const Scene& scene, const FluidState& fluid, const PatchFrame& frame, double water_level);

  // Each returns why it is refused, or nothing. They fit the scene (find_refusal).
  [[nodiscard]] std::optional<Refusal> apply(const ReleaseOil& command, const Bodies& hulls);
  [[nodiscard]] std::optional<Refusal> apply(const StopRelease& command);
  [[nodiscard]] std::optional<Refusal> apply(const SpillOil& command);
  [[nodiscard]] std::optional<Refusal> apply(const SetBoom& command);
  [[nodiscard]] std::optional<Refusal> apply(const RemoveBoom& command);
  [[nodiscard]] std::optional<Refusal> apply(const SetSkimmer& command);
  [[nodiscard]] std::optional<Refusal> apply(const RemoveSkimmer& command);

  /// One step after the water's: sources, film, exchange. Changes phases of particles only.
  void advance(double dt, const SpillSea& sea, FluidState& fluid);

  [[nodiscard]] OilBudget budget() const;
  [[nodiscard]] std::vector<SlickDisc> discs() const { return layer_.frame().discs; }
  /// The film, booms and skimmers.
  [[nodiscard]] const SlickState& film() const { return layer_.state(); }
  /// Names of the sources that run.
  [[nodiscard]] std::vector<std::string> sources() const;
  /// Whether `advance` looks at the water's surface.
  [[nodiscard]] bool asks_surface() const {
    return model_ != OilModel::kParticles && !(empty() && layer_.state().skimmers.empty());
  }
  [[nodiscard]] bool empty() const { return layer_.elements().empty() && sources_.empty() && particles_ == 0; }

  [[nodiscard]] OilSpillState state() const;
  /// Goes on from a state of the same scene's oil.
  void restore(const OilSpillState& state);

 private:
  using Source = OilSource;
  using WaterNearby = std::vector<std::uint32_t>;  ///< particles of water near a source
  void run_sources(double dt, const SpillSea& sea, FluidState& fluid);
  // Each returns what keeps the rest of the oil back, if anything does.
  [[nodiscard]] SourceWait bring_out(Source& source, bool film_due, bool over, const SpillSea& sea,
                                     const WaterNearby& water, FluidState& fluid);
  [[nodiscard]] SourceWait feed_film(Source& source, const SpillSea& sea);
  [[nodiscard]] SourceWait make_particles(Source& source, const SpillSea& sea, const WaterNearby& water,
                                          FluidState& fluid);
  [[nodiscard]] bool dry(const Eigen::Vector3d& world, const SpillSea& sea) const;
  void thin_to_film(const SurfaceGrid& surface, FluidState& fluid);
  void pile_to_particles(const SurfaceGrid& surface, FluidState& fluid);
  [[nodiscard]] bool turn_to_oil(FluidState& fluid, const WaterNearby& water, const Eigen::Vector3d& world);
  [[nodiscard]] std::vector<Eigen::AlignedBox3f> source_boxes(const SpillSea& sea) const;
  [[nodiscard]] Eigen::Vector3d next_place(Source& source, const SpillSea& sea) const;
  [[nodiscard]] Eigen::Vector3d world_place(const ReleaseOil& settings, const Eigen::Vector3d& place,
                                            const SpillSea& sea) const;
  [[nodiscard]] double particle_volume() const { return spacing_ * spacing_ * spacing_; }  ///< m^3
  [[nodiscard]] double particle_mass() const;  ///< kg, a whole number of milligrams

  OilModel model_;
  PatchFrame frame_;
  double spacing_, oil_density_, water_density_;
  std::uint32_t most_particles_;
  SlickLayer layer_;
  double fallback_level_;
  double since_exchange_ = 0.0;  ///< s
  double since_film_ = 0.0;      ///< s

  std::map<std::string, Source> sources_;
  std::uint32_t particles_ = 0;
  std::int64_t displaced_ = 0;  ///< particles of water
  double held_back_ = 0.0;      ///< kg
};

}  // namespace pelagos
