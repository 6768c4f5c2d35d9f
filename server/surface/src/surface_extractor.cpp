#include "surface/surface_extractor.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "neighborhood_kernel.hpp"

namespace pelagos {

namespace {

enum Mark : std::uint8_t { kInside, kSurface, kHalo, kOil, kNotFinite };

constexpr std::size_t kGroupsPerBlock = 32;
constexpr std::size_t kParticlesPerBlock = 256;
/// With fewer neighbours a particle is taken even where they surround it evenly: drops, threads and sheets one particle
/// thin (a sheet has 10). An edge of the water has 11, its flat surface 18.
constexpr float kFewNeighbors = 12.0f;

// Foam: closing speeds in units of sqrt(g d), the speed at which particles fall past each other. Restless still water
// stays below 0.2, the shear of unbroken waves below 0.1.
constexpr float kFoamFrom = 0.4f, kFoamFull = 1.6f;
constexpr float kFoamSeconds = 8.0f;                   ///< 1/e of its life, in sqrt(d/g): 2.6 s at d = 1 m
constexpr float kLeastFoam = 0.5f / 255.0f;            ///< less is not seen
constexpr float kSprayFrom = 8.0f, kSprayFull = 2.0f;  ///< neighbours; an edge of the water has 11, a corner 7

bool is_finite(const Float4& a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

std::uint8_t to_byte(float part) {
  return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(part, 0.0f, 1.0f)));
}

/// Moments about the weighted centre; the particle itself gives a weight of at least 1.
Neighborhood moments_of(const ParticleSums& sums) {
  Neighborhood result;
  const float inverse = 1.0f / std::max(sums.weight, 1.0f);
  result.weight = sums.weight;
  result.mean = inverse * Eigen::Vector3f(sums.x, sums.y, sums.z);
  result.covariance << sums.xx, sums.xy, sums.xz, sums.xy, sums.yy, sums.yz, sums.xz, sums.yz, sums.zz;
  result.covariance = inverse * result.covariance - result.mean * result.mean.transpose();
  return result;
}

/// The trapped-air potential of Ihmsen et al. (2012, "Unified spray, foam and air bubbles for particle-based fluids",
/// eq. 2), how fast neighbours run into each other:
///   v_diff = sum_j |v_ij| (1 - v^_ij . x^_ij) (1 - |x_ij|/h) ,   x_ij = x_i - x_j, v_ij = v_i - v_j ;
/// here divided by the sum of the weights, which makes it a mean speed, m/s, that does not depend on the resolution.
float closing_speed(const ParticleSums& sums) {
  return sums.closing_weight > 0.0f ? sums.closing / sums.closing_weight : 0.0f;
}

/// Where the neighbours of a particle lie, and how many they are.
struct Surroundings {
  Eigen::Vector3f sum;  ///< m, of their weighted ways from the particle
  float count;
};

/// The same with the room behind the surfaces of solids full of neighbours: a sum that points away from a surface is
/// due to it, and the count grows by the share of the support ball that is cut off.
Surroundings fill_solids(Surroundings around, const SolidPlanes& solids, std::size_t i, const Float4& x,
                         float support_radius) {
  for (const std::vector<Float4>& planes : solids.plane) {
    const Eigen::Vector3f normal = vector_of(planes[i]);
    if (normal.isZero(0.0f)) continue;
    around.sum -= std::max(0.0f, normal.dot(around.sum)) * normal;
    const float q = std::clamp((normal.dot(vector_of(x)) - planes[i].w) / support_radius, 0.0f, 1.0f);
    const float cut_off = 0.25f * (1.0f - q) * (1.0f - q) * (2.0f + q);  // of a ball, beyond a plane
    around.count /= 1.0f - cut_off;
  }
  return around;
}

}  // namespace

SurfaceExtractor::SurfaceExtractor(const SurfaceSettings& settings, const SurfaceScales& scales)
    : settings_(settings), scales_(scales) {
  scales_.gravity = scale_gravity(scales_.gravity);
}

void SurfaceExtractor::detect(const SurfaceInput& input, TaskPool& pool) {
  const FluidParticles& fluid = input.fluid;
  const auto support_radius = static_cast<float>(scales_.support_radius);
  const auto threshold = static_cast<float>(settings_.detection_threshold) * support_radius;
  const std::size_t groups = (fluid.count + kLanes - 1) / kLanes;
  mark_.assign(groups * kLanes, kInside);
  pool.for_each_range(groups, kGroupsPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t group = begin; group < end; ++group) {
      GroupSums sums{};
      const Float4* query = fluid.position.data() + group * kLanes;
      add_slots(query, fluid.position.data(), input.fluid_neighbors.slots.data(), input.fluid_neighbors.groups[group],
                support_radius, sums);
      if (group < input.boundary_neighbors.groups.size())
        add_slots(query, input.boundary.position.data(), input.boundary_neighbors.slots.data(),
                  input.boundary_neighbors.groups[group], support_radius, sums);
      const std::size_t lanes = std::min(kLanes, fluid.count - group * kLanes);
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const std::size_t i = group * kLanes + lane;
        Surroundings around{{sums.x[lane], sums.y[lane], sums.z[lane]}, smooth_neighbor_count(sums.weight[lane])};
        if (input.solids && input.solids->group[group] != 0)
          around = fill_solids(around, *input.solids, i, query[lane], support_radius);
        const float bound = threshold * sums.weight[lane];  // |sum / weight| > threshold without the division
        if (!is_finite(query[lane]) || !is_finite(fluid.velocity[i]))
          mark_[i] = kNotFinite;
        else if (around.sum.squaredNorm() > bound * bound || around.count < kFewNeighbors)
          mark_[i] = kSurface;
      }
    }
  });
  mark_halo(input, pool);
  if (!fluid.phase.empty())
    for (std::size_t i = 0; i < fluid.count; ++i)
      if (mark_[i] == kInside && fluid.phase[i] == kOilPhase) mark_[i] = kOil;
  collect(fluid.count);
}

void SurfaceExtractor::mark_halo(const SurfaceInput& input, TaskPool& pool) {
  const FluidParticles& fluid = input.fluid;
  const auto reach = static_cast<float>(settings_.halo * scales_.spacing);
  if (!(reach > 0.0f) || settings_.publish_all) return;
  pool.for_each_range(fluid.count, kParticlesPerBlock * 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (std::atomic_ref(mark_[i]).load(std::memory_order_relaxed) != kSurface) continue;
      const Eigen::Vector3f place = vector_of(fluid.position[i]);
      for_each_neighbor(input.fluid_neighbors, i, [&](std::size_t j) {
        if (j >= fluid.count) return;  // an image beyond a mirrored or periodic face
        if ((vector_of(fluid.position[j]) - place).squaredNorm() > reach * reach) return;
        // Several threads may mark the same neighbour: all write the same value, and only over kInside.
        const std::atomic_ref mark(mark_[j]);
        if (mark.load(std::memory_order_relaxed) == kInside) mark.store(kHalo, std::memory_order_relaxed);
      });
    }
  });
}

void SurfaceExtractor::collect(std::size_t count) {
  indices_.clear();
  counts_ = {};
  for (std::size_t i = 0; i < count; ++i) {
    counts_.surface += mark_[i] == kSurface;
    counts_.halo += mark_[i] == kHalo;
    counts_.oil += mark_[i] == kOil;
    counts_.not_finite += mark_[i] == kNotFinite;
    if (mark_[i] != kNotFinite && (mark_[i] != kInside || settings_.publish_all))
      indices_.push_back(static_cast<std::uint32_t>(i));
  }
}

void SurfaceExtractor::shape(const SurfaceInput& input, TaskPool& pool, std::vector<SurfaceParticle>& particles) {
  particles.resize(indices_.size());
  foam_now_.resize(indices_.size());
  pool.for_each_range(indices_.size(), kParticlesPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) particles[n] = shape_particle(input, indices_[n], foam_now_[n]);
  });
  remember_foam(input);
}

/// What is left at `time` of the foam that a particle had.
float SurfaceExtractor::foam_left(std::uint32_t id, double time) const {
  const auto before = std::lower_bound(foam_.begin(), foam_.end(), id,
                                       [](const FoamOfParticle& foam, std::uint32_t other) { return foam.id < other; });
  if (before == foam_.end() || before->id != id) return 0.0f;
  return faded(*before, time);
}

float SurfaceExtractor::faded(const FoamOfParticle& foam, double time) const {
  const auto time_unit = static_cast<float>(std::sqrt(scales_.spacing / scales_.gravity));
  const float since = std::max(static_cast<float>(time) - foam.time, 0.0f);
  return foam.amount * std::exp(-since / (kFoamSeconds * time_unit));
}

/// The foam of the particles at the surface as it is now, and of those that have left it as it was.
void SurfaceExtractor::remember_foam(const SurfaceInput& input) {
  const auto now = static_cast<float>(input.time);
  const auto by_id = [](const FoamOfParticle& one, const FoamOfParticle& other) { return one.id < other.id; };
  fresh_foam_.clear();
  for (std::size_t n = 0; n < indices_.size(); ++n)
    if (foam_now_[n] > kLeastFoam) fresh_foam_.push_back({input.fluid.id[indices_[n]], foam_now_[n], now});
  std::sort(fresh_foam_.begin(), fresh_foam_.end(), by_id);
  std::vector<FoamOfParticle> all;
  all.reserve(fresh_foam_.size() + foam_.size());
  for (const FoamOfParticle& foam : foam_)
    if (faded(foam, input.time) > kLeastFoam &&
        !std::binary_search(fresh_foam_.begin(), fresh_foam_.end(), foam, by_id))
      all.push_back(foam);
  const auto old = static_cast<std::ptrdiff_t>(all.size());
  all.insert(all.end(), fresh_foam_.begin(), fresh_foam_.end());
  std::inplace_merge(all.begin(), all.begin() + old, all.end(), by_id);
  foam_.swap(all);
}

SurfaceParticle SurfaceExtractor::shape_particle(const SurfaceInput& input, std::size_t i, float& foam) const {
  const FluidParticles& fluid = input.fluid;
  const auto support_radius = static_cast<float>(scales_.support_radius);
  const Eigen::Vector3f place = vector_of(fluid.position[i]);
  ParticleSums sums;
  add_neighbors(fluid.position[i], fluid.velocity[i], fluid.position.data(), fluid.velocity.data(),
                input.fluid_neighbors, i, support_radius, sums);
  if (i / kLanes < input.boundary_neighbors.groups.size())
    add_neighbors(fluid.position[i], fluid.velocity[i], input.boundary.position.data(), nullptr,
                  input.boundary_neighbors, i, support_radius, sums);
  const Neighborhood moments = moments_of(sums);
  const Ellipsoid ellipsoid = fit_ellipsoid(moments, static_cast<float>(scales_.spacing), support_radius, anisotropy_);
  SurfaceParticle particle;
  particle.position = place + ellipsoid.shift;
  particle.orientation = ellipsoid.orientation;
  particle.semi_axes = ellipsoid.semi_axes;
  particle.velocity = vector_of(fluid.velocity[i]);
  particle.phase = fluid.phase.empty() ? kWaterPhase : fluid.phase[i];
  const float count = smooth_neighbor_count(moments.weight);
  particle.spray = to_byte((kSprayFrom - count) / (kSprayFrom - kSprayFull));

  const auto speed_unit = static_cast<float>(std::sqrt(scales_.gravity * scales_.spacing));
  foam = std::clamp((closing_speed(sums) / speed_unit - kFoamFrom) / (kFoamFull - kFoamFrom), 0.0f, 1.0f);
  if (!foam_.empty()) foam = std::max(foam, foam_left(fluid.id[i], input.time));
  particle.foam = to_byte(foam);
  return particle;
}

}  // namespace pelagos
