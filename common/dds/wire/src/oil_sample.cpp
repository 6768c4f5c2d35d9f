#include "values/patch_frame.hpp"
#include "wire/convert.hpp"

namespace pelagos::wire {

namespace {

pelagos_SlickElementV1 to_wire(const SlickDisc& disc, const PatchFrame& patch) {
  const Eigen::Vector3d world = Eigen::Vector3f(disc.x, disc.y, disc.z).cast<double>();
  const Eigen::Vector3f local = patch.to_local(world).cast<float>();
  pelagos_SlickElementV1 element{};
  element.position = {local.x(), local.y(), local.z()};
  element.radius = disc.radius;
  element.thickness = disc.thickness;
  element.mass = disc.mass;
  element.water = disc.water;
  element.appearance = static_cast<std::uint8_t>(disc.appearance);
  element.contained = disc.contained;
  return element;
}

/// A sequence that lends the values' memory.
template <class Sequence, class Value>
void lend(Sequence& sequence, std::vector<Value>& values) {
  sequence._maximum = sequence._length = static_cast<std::uint32_t>(values.size());
  sequence._buffer = values.data();
  sequence._release = false;
}

}  // namespace

SlickDisc from_wire(const pelagos_SlickElementV1& element) {
  const pelagos_Vector3f& p = element.position;
  return {p.x,
          p.y,
          p.z,
          element.radius,
          element.thickness,
          element.mass,
          element.water,
          static_cast<OilAppearance>(element.appearance),
          element.contained};
}

OilSample::OilSample(const Snapshot& snapshot, const OilSnapshot& oil, std::uint64_t source) {
  slick_.source = budget_.source = source;
  slick_.frame = budget_.frame = snapshot.frame;
  slick_.simulation_time = budget_.simulation_time = snapshot.simulation_time;
  slick_.origin = wire::to_wire(snapshot.origin);
  elements_.reserve(oil.discs.size());
  const PatchFrame patch = PatchFrame::at(snapshot.origin);
  for (const SlickDisc& disc : oil.discs) elements_.push_back(to_wire(disc, patch));
  lend(slick_.elements, elements_);

  const OilBudget& b = oil.budget;
  budget_.released_mg = b.ledger.released;
  budget_.afloat_mg = b.ledger.afloat;
  budget_.contained_mg = b.ledger.contained;
  budget_.submerged_mg = b.ledger.submerged;
  budget_.recovered_mg = b.ledger.recovered;
  budget_.evaporated_mg = b.ledger.evaporated;
  budget_.left_patch_mg = b.ledger.left_patch;
  budget_.particles = b.particles;
  budget_.elements = b.elements;
  budget_.area = b.area;
  budget_.mean_thickness = b.mean_thickness;
  budget_.largest_thickness = b.largest_thickness;
  budget_.emulsion_water = b.emulsion_water;
  budget_.displaced_water = b.displaced_water;
  budget_.held_back = b.held_back;
  for (const SkimmerStatus& skimmer : b.skimmers)
    skimmers_.push_back(
        {const_cast<char*>(skimmer.name.c_str()), skimmer.recovered, skimmer.present_rate, skimmer.dry});
  lend(budget_.skimmers, skimmers_);
}

}  // namespace pelagos::wire
