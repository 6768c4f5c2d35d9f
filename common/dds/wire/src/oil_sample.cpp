#include <cmath>

#include "wire/convert.hpp"

namespace pelagos::wire {

namespace {

pelagos_SlickElementV1 to_wire(const SlickDisc& disc, const Eigen::Vector3d& origin) {
  pelagos_SlickElementV1 element{};
  element.position = {static_cast<float>(static_cast<double>(disc.x) - origin.x()),
                      static_cast<float>(static_cast<double>(disc.y) - origin.y()),
                      static_cast<float>(static_cast<double>(disc.z) - origin.z())};
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

// What a viewer may be made to draw stays bounded: elements as many as the largest slicks have, sizes and places of a
// sea that a viewer can show.
constexpr std::uint32_t kMostElements = 200'000;
constexpr float kFarthest = 1e6F, kLargestRadius = 1e5F, kThickest = 100.0F, kMostMass = 1e12F;

bool is_within(float value, float low, float high) { return value >= low && value <= high; }  // false for NaN

const char* find_fault(const pelagos_SlickElementV1& element) {
  const pelagos_Vector3f& p = element.position;
  for (const float coordinate : {p.x, p.y, p.z})
    if (!is_within(coordinate, -kFarthest, kFarthest)) return "an element's position is beyond 1000 km";
  if (!(element.radius > 0.0F && element.radius <= kLargestRadius)) return "an element's radius is not in 0 to 100 km";
  if (!is_within(element.thickness, 0.0F, kThickest)) return "an element's thickness is not in 0 to 100 m";
  if (!is_within(element.mass, 0.0F, kMostMass)) return "an element's mass is not in 0 to 1e12 kg";
  if (!is_within(element.water, 0.0F, 1.0F)) return "an element's share of water is not in 0 to 1";
  if (element.appearance > static_cast<std::uint8_t>(OilAppearance::kContinuousTrue))
    return "an element's appearance is not in 0 to 5";
  return nullptr;
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

const char* find_fault(const pelagos_SlickV1& slick) {
  if (slick.elements._length > kMostElements) return "more than 200,000 elements";
  const auto finite = [](double value) { return std::isfinite(value); };
  const pelagos_Vector3& o = slick.origin;
  if (!finite(o.x) || !finite(o.y) || !finite(o.z) || !finite(slick.simulation_time))
    return "origin or time is not finite";
  for (std::uint32_t i = 0; i < slick.elements._length; ++i)
    if (const char* fault = find_fault(slick.elements._buffer[i])) return fault;
  return nullptr;
}

OilSample::OilSample(const Snapshot& snapshot, const OilSnapshot& oil, std::uint64_t source) {
  slick_.source = budget_.source = source;
  slick_.frame = budget_.frame = snapshot.frame;
  slick_.simulation_time = budget_.simulation_time = snapshot.simulation_time;
  slick_.origin = wire::to_wire(snapshot.origin);
  elements_.reserve(oil.discs.size());
  for (const SlickDisc& disc : oil.discs) elements_.push_back(to_wire(disc, snapshot.origin));
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
