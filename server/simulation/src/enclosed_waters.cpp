#include "simulation/enclosed_waters.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>

#include "values/lattice.hpp"

namespace pelagos {

namespace {

/// Places nearer to a body, in spacings, are left out: just so many that no row of places reaches through a thin plate.
constexpr double kClearance = 0.499;
constexpr double kMostPlaces = 1e8;  ///< beyond, bodies are not looked at
constexpr std::size_t kPlacesPerBlock = 512;

/// The places of particles in the patch, up to the highest that starts.
struct Places {
  std::size_t columns = 0, rows = 0, layers = 0;    ///< along x, y, z
  Eigen::Vector3d first = Eigen::Vector3d::Zero();  ///< m, world
  double spacing = 0.0;
  std::array<bool, 2> periodic{false, false};
  std::vector<std::uint8_t> free;  ///< layer by layer, row by row

  [[nodiscard]] std::size_t layer_size() const { return columns * rows; }
  [[nodiscard]] Eigen::Vector3d at(std::size_t place) const {
    const std::size_t in_layer = place % layer_size();
    return first + spacing * Eigen::Vector3d(static_cast<double>(in_layer % columns),
                                             static_cast<double>(in_layer / columns),
                                             static_cast<double>(place / layer_size()));
  }
  /// The one nearest to a point (m, world).
  [[nodiscard]] std::size_t nearest(const Eigen::Vector3d& x) const {
    const Eigen::Vector3d g = (x - first) / spacing;
    const auto index = [](double value, std::size_t count) {
      return static_cast<std::size_t>(std::clamp(std::round(value), 0.0, static_cast<double>(count - 1)));
    };
    return (index(g.z(), layers) * rows + index(g.y(), rows)) * columns + index(g.x(), columns);
  }
};

double highest(std::span<const Float4> position, const PatchFrame& frame) {
  float top = 0.0F;
  for (const Float4& x : position) top = std::max(top, x.z);
  return frame.world_height(static_cast<double>(top));
}

/// Whether a particle has room at each place from `first` on.
void mark_free(const Places& places, const Bodies& bodies, std::size_t first, std::span<std::uint8_t> free) {
  for (std::size_t k = 0; k < free.size(); ++k) {
    const Eigen::Vector3d x = places.at(first + k);
    free[k] = bodies.covers(x, kClearance * places.spacing) || bodies.keeps_dry(x) ? 0 : 1;
  }
}

/// Without places where the patch has none or too many.
Places find_places(TaskPool& pool, const Scene& scene, const Bodies& bodies, double top) {
  Places places;
  const double d = scene.particle_spacing;
  const auto counts = lattice_counts(scene.patch, d, water_edges(scene));
  places.spacing = d;
  for (int axis = 0; axis < 3; ++axis)
    places.first[axis] = scene.patch.min[axis] + d * lattice_offset(water_edges(scene)[static_cast<std::size_t>(axis)]);
  for (std::size_t axis = 0; axis < 2; ++axis) places.periodic[axis] = scene.patch_edges[axis] == PatchEdge::kPeriodic;
  const double layers = std::min(static_cast<double>(counts[2]), std::floor((top - places.first.z()) / d + 1.5));
  const double all = static_cast<double>(counts[0]) * static_cast<double>(counts[1]) * layers;
  if (!(all >= 1.0 && all <= kMostPlaces)) return places;
  places.columns = static_cast<std::size_t>(counts[0]);
  places.rows = static_cast<std::size_t>(counts[1]);
  places.layers = static_cast<std::size_t>(layers);
  places.free.resize(places.layer_size() * places.layers);
  pool.for_each_range(places.free.size(), kPlacesPerBlock, [&](std::size_t begin, std::size_t end) {
    mark_free(places, bodies, begin, std::span(places.free).subspan(begin, end - begin));
  });
  return places;
}

/// For each particle in a free place the lowest free place of its column below it; sorted.
std::vector<std::uint32_t> drain(const Places& places, std::span<const Float4> position, const PatchFrame& frame) {
  std::vector<std::uint32_t> bottoms;
  bottoms.reserve(position.size());
  for (const Float4& x : position) {
    std::size_t place = places.nearest(frame.to_world(Eigen::Vector3d(x.x, x.y, x.z)));
    if (!places.free[place]) continue;
    while (place >= places.layer_size() && places.free[place - places.layer_size()]) place -= places.layer_size();
    bottoms.push_back(static_cast<std::uint32_t>(place));
  }
  std::sort(bottoms.begin(), bottoms.end());
  return bottoms;
}

/// Connected free places up to a layer, and the water that drains into them.
struct Hollow {
  std::vector<std::size_t> capacity;  ///< places in each layer
  std::size_t places = 0, water = 0;
  std::vector<std::size_t> waters;  ///< the enclosed waters in it, by number
  [[nodiscard]] bool overflows() const { return water > places; }
};

/// Fills the hollows of the patch layer by layer.
class Filling {
 public:
  explicit Filling(const Places& places, std::vector<std::uint32_t> bottoms)
      : places_(places), bottoms_(std::move(bottoms)), below_(places.layer_size(), kSolid), here_(below_) {}

  std::vector<EnclosedWater> fill() {
    for (std::size_t layer = 0; layer < places_.layers; ++layer) add(layer);
    for (std::uint32_t k = 0; k < hollows_.size(); ++k)  // blocks off the lattice may hold a little more than it
      if (root(k) == k && hollows_[k].overflows()) close(hollows_[k]);
    std::erase_if(waters_, [](const EnclosedWater& water) { return water.particles == 0; });
    return waters_;
  }

 private:
  static constexpr std::uint32_t kSolid = ~0U;

  void add(std::size_t layer) {
    open_places(layer);
    join_neighbours();
    std::vector<std::uint32_t> touched;
    for (std::uint32_t& hollow : here_) {
      if (hollow == kSolid) continue;
      hollow = root(hollow);
      Hollow& h = hollows_[hollow];
      h.capacity.resize(layer + 1);
      ++h.capacity[layer];
      ++h.places;
      touched.push_back(hollow);
    }
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    for (const std::uint32_t hollow : touched) {
      Hollow& h = hollows_[hollow];
      if (h.water > 0 && !h.overflows() && h.waters.empty()) close(h);
    }
    std::swap(below_, here_);
  }

  /// Each free place of a layer belongs to the hollow below it, or begins a new one.
  void open_places(std::size_t layer) {
    for (std::size_t k = 0; k < places_.layer_size(); ++k) {
      const std::size_t place = layer * places_.layer_size() + k;
      here_[k] = kSolid;
      if (!places_.free[place]) continue;
      here_[k] = below_[k];
      if (here_[k] != kSolid) continue;
      here_[k] = static_cast<std::uint32_t>(hollows_.size());
      parent_.push_back(here_[k]);
      hollows_.emplace_back();
      for (; next_ < bottoms_.size() && bottoms_[next_] == place; ++next_) ++hollows_.back().water;
    }
  }

  void join_neighbours() {
    for (std::size_t row = 0; row < places_.rows; ++row)
      for (std::size_t column = 0; column < places_.columns; ++column) {
        const std::size_t k = row * places_.columns + column;
        if (column > 0) join(here_[k], here_[k - 1]);
        if (row > 0) join(here_[k], here_[k - places_.columns]);
        if (column == 0 && places_.periodic[0]) join(here_[k], here_[k + places_.columns - 1]);
        if (row == 0 && places_.periodic[1]) join(here_[k], here_[k + (places_.rows - 1) * places_.columns]);
      }
  }

  std::uint32_t root(std::uint32_t hollow) {
    while (parent_[hollow] != hollow) hollow = parent_[hollow] = parent_[parent_[hollow]];
    return hollow;
  }

  void join(std::uint32_t one, std::uint32_t other) {
    if (one == kSolid || other == kSolid) return;
    const std::uint32_t a = std::min(root(one), root(other)), b = std::max(root(one), root(other));
    if (a == b) return;
    parent_[b] = a;
    Hollow &into = hollows_[a], &from = hollows_[b];
    if (into.overflows() || from.overflows()) empty(into), empty(from);
    into.capacity.resize(std::max(into.capacity.size(), from.capacity.size()));
    for (std::size_t k = 0; k < from.capacity.size(); ++k) into.capacity[k] += from.capacity[k];
    into.places += from.places;
    into.water += from.water;
    into.waters.insert(into.waters.end(), from.waters.begin(), from.waters.end());
    from = {};
  }

  /// What flows in mixes with the waters in it.
  void empty(Hollow& hollow) {
    for (const std::size_t water : hollow.waters) waters_[water].particles = 0;
    hollow.waters.clear();
  }

  /// Its water is at rest: it fills the lowest places.
  void close(Hollow& hollow) {
    const double d = places_.spacing;
    std::size_t rest = hollow.water, layer = 0;
    while (layer + 1 < hollow.capacity.size() && rest > hollow.capacity[layer]) rest -= hollow.capacity[layer++];
    const auto top = static_cast<double>(hollow.capacity[layer]);
    const double layers = static_cast<double>(layer) + (top > 0.0 ? static_cast<double>(rest) / top : 0.0);
    hollow.waters.push_back(waters_.size());
    waters_.push_back({places_.first.z() + (layers - 0.5) * d, top * d * d, hollow.water});
  }

  const Places& places_;
  std::vector<std::uint32_t> bottoms_, below_, here_, parent_;
  std::vector<Hollow> hollows_;
  std::vector<EnclosedWater> waters_;
  std::size_t next_ = 0;
};

double level_without_bodies(const Scene& scene) {
  const double d = scene.particle_spacing;
  const auto floor = lattice_counts(scene.patch, d, water_edges(scene));
  const double layers = particle_count(scene) / static_cast<double>(floor[0] * floor[1]);
  return scene.patch.min.z() + (layers - 0.5 + lattice_offset(water_edges(scene)[2])) * d;
}

}  // namespace

std::vector<EnclosedWater> find_enclosed_waters(TaskPool& pool, const Scene& scene, const Bodies& bodies,
                                                std::span<const Float4> position, const PatchFrame& frame) {
  const Places places = find_places(pool, scene, bodies, highest(position, frame));
  if (places.free.empty()) return {};
  return Filling(places, drain(places, position, frame)).fill();
}

double rest_level(TaskPool& pool, const Scene& scene, const Bodies& bodies, std::span<const Float4> position,
                  const PatchFrame& frame) {
  if (bodies.empty()) return level_without_bodies(scene);
  const std::vector<EnclosedWater> waters = find_enclosed_waters(pool, scene, bodies, position, frame);
  if (waters.empty()) return level_without_bodies(scene);
  return std::max_element(waters.begin(), waters.end(),
                          [](const EnclosedWater& a, const EnclosedWater& b) {
                            return a.surface != b.surface ? a.surface < b.surface : a.particles < b.particles;
                          })
      ->level;
}

}  // namespace pelagos
