#include "simulation/open_sea.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <span>

#include "labelled_waves.hpp"
#include "sea_bed.hpp"
#include "smooth_step.hpp"
#include "waves/patch_blend.hpp"

namespace pelagos {

namespace {

constexpr double kDrawRate = 2.0;  ///< 1/s, g: how fast water at the rim follows the theory
/// Labels of free water may lie a little above the mean level, where drops and disorder have put it.
constexpr float kHighestLabel = 0.5F;  ///< spacings
/// Spacings between nodes of the floor, and how far its grid reaches beyond the patch.
constexpr double kFloorCell = 2.0, kFloorMargin = 4.0;
/// m: what waves move less than this at the floor does not bend it.
constexpr float kLeastAtFloor = 1e-5F;
/// Particles within a block of pointwise work.
constexpr std::size_t kBlock = 2048;
/// Of what is too much, the part that one renewal takes out, and where: labels above this many spacings, and drawn by
/// more than this.
constexpr std::size_t kSurplusShare = 10;
constexpr float kSurplusDepth = 0.4F;
constexpr double kSurplusDraw = 0.1;
/// Free water that comes into the rim of the edge behind with a label above this many spacings is taken out.
constexpr double kHighestHeld = 0.3;

/// The waves below a material surface: the theory at the labels Z <= -by is that of these waves at Z + by.
WaveMoment lowered(const WaveMoment& moment, double by) {
  WaveMoment low = moment;
  low.level = moment.level - by;
  low.depth = moment.depth - by;
  low.waves.clear();
  for (MomentWave wave : moment.waves) {
    const double k = wave.wavenumber, echo = wave.echo;
    // S(-by) = sinh k(h - by) / sinh kh
    const double share =
        (std::exp(-k * by) - (echo > 0.0 ? std::exp(-k * (2.0 * moment.depth - by)) : 0.0)) / (1.0 - echo);
    wave.amplitude = static_cast<float>(static_cast<double>(wave.amplitude) * share);
    wave.amplitude_rate = static_cast<float>(static_cast<double>(wave.amplitude_rate) * share);
    if (std::abs(wave.amplitude) < kLeastAtFloor) continue;
    wave.echo = echo > 0.0 ? static_cast<float>(std::exp(-2.0 * k * low.depth)) : 0.0F;
    wave.bed = 1.0F / (1.0F - wave.echo);
    low.waves.push_back(wave);
  }
  return low;
}

/// Runs f(begin, end) over a range in blocks of LabelBatch::kMost or less.
template <class F>
void for_each_batch(TaskPool& pool, std::size_t count, F&& f) {
  pool.for_each_range(count, LabelBatch::kMost, f);
}

Float4 shifted(const Float4& label, float x, float y, float z) { return {label.x + x, label.y + y, label.z + z, 0.0F}; }

/// Places and velocities of labels.
void place_labels(TaskPool& pool, const WaveMoment& at_place, const WaveMoment& at_velocity, double level,
                  std::size_t count, const std::function<Float4(std::size_t)>& label, std::vector<Float4>& position,
                  std::vector<Float4>& velocity) {
  position.resize(count);
  velocity.resize(count);
  const auto up = static_cast<float>(level);
  for_each_batch(pool, count, [&](std::size_t begin, std::size_t end) {
    LabelBatch batch;
    for (std::size_t k = begin; k < end; ++k) batch.add(label(k));
    batch.displace(at_place);
    for (std::size_t k = begin, n = 0; k < end; ++k, ++n)
      position[k] = shifted(label(k), batch.a[n], batch.b[n], batch.c[n] + up);
    batch.move(at_velocity);
    for (std::size_t k = begin, n = 0; k < end; ++k, ++n) velocity[k] = {batch.a[n], batch.b[n], batch.c[n], 0.0F};
  });
}

/// Heights, slopes and rise of a material surface at the nodes of a floor.
class FloorMaker {
 public:
  FloorMaker(const WaveMoment& at_place, const WaveMoment& at_velocity, double height, Floor& floor)
      : place_(at_place), velocity_(at_velocity), height_(static_cast<float>(height)), floor_(floor) {}

  void make(TaskPool& pool) {
    const auto columns = static_cast<std::size_t>(floor_.columns);
    floor_.nodes.resize(columns * static_cast<std::size_t>(floor_.rows));
    pool.for_each_range(floor_.nodes.size(), kMost, [&](std::size_t begin, std::size_t end) { fill(begin, end); });
  }

 private:
  static constexpr std::size_t kMost = 128;
  using Row = std::array<float, kMost>;

  void fill(std::size_t begin, std::size_t end) {
    Row x, y, height, slope_x, slope_y, u, v, w;
    const std::size_t count = end - begin;
    for (std::size_t k = begin; k < end; ++k) {
      const auto columns = static_cast<std::size_t>(floor_.columns);
      x[k - begin] = floor_.x + floor_.cell * static_cast<float>(k % columns);
      y[k - begin] = floor_.y + floor_.cell * static_cast<float>(k / columns);
    }
    const auto span = [count](Row& row) { return std::span<float>(row.data(), count); };
    const DisplacedSurfaceArrays out{span(height), span(slope_x), span(slope_y), span(u), span(v), span(w)};
    evaluate_displaced_surface(place_, span(x), span(y), out);
    for (std::size_t n = 0; n < count; ++n)
      floor_.nodes[begin + n] = {height_ + height[n], slope_x[n], slope_y[n], 0.0F};
    evaluate_displaced_surface(velocity_, span(x), span(y), out);
    for (std::size_t n = 0; n < count; ++n) floor_.nodes[begin + n].w = w[n] - slope_x[n] * u[n] - slope_y[n] * v[n];
  }

  const WaveMoment &place_, &velocity_;
  float height_;
  Floor& floor_;
};

/// A grid of nodes that covers the patch and what lies around it.
void lay_floor(const OpenSeaShape& shape, Floor& floor) {
  const auto cell = static_cast<float>(kFloorCell * shape.spacing);
  const auto margin = static_cast<float>(kFloorMargin * shape.spacing);
  const auto nodes = [&](std::size_t axis) {
    return static_cast<int>(std::ceil((shape.patch.max[axis] - shape.patch.min[axis] + 2.0F * margin) / cell)) + 1;
  };
  floor.x = shape.patch.min[0] - margin;
  floor.y = shape.patch.min[1] - margin;
  floor.cell = cell;
  floor.columns = nodes(0);
  floor.rows = nodes(1);
}

}  // namespace

OpenSea::OpenSea(const OpenSeaShape& shape) : shape_(shape) {}

double OpenSea::inside(double x, double y) const {
  double least = std::numeric_limits<double>::max();
  const auto take = [&](std::size_t axis, double at) {
    if (!shape_.open[axis]) return;
    least = std::min(
        {least, at - static_cast<double>(shape_.patch.min[axis]), static_cast<double>(shape_.patch.max[axis]) - at});
  };
  take(0, x);
  take(1, y);
  return least;
}

double OpenSea::inside_of(std::size_t axis, int way, float at) const {
  return static_cast<double>(way > 0 ? shape_.patch.max[axis] - at : at - shape_.patch.min[axis]);
}

double OpenSea::draw_share(double x, double y) const {
  return shape_.zone > 0.0 ? smooth_step((shape_.zone - (inside(x, y) - rim())) / shape_.zone) : 0.0;
}

OpenSeaWater OpenSea::fill(TaskPool& pool, const WaveField& sea, const Eigen::Vector2d& anchor, double time,
                           double next_dt) const {
  OpenSeaWater water;
  const double d = shape_.spacing;
  std::array<int, 2> n{};
  for (std::size_t axis = 0; axis < 2; ++axis)
    n[axis] = static_cast<int>(std::lround(static_cast<double>(shape_.patch.max[axis] - shape_.patch.min[axis]) / d));
  const auto most = static_cast<int>(std::lround(shape_.depth / d));
  for (int k = 0; k < most; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i) {
        const double x = static_cast<double>(shape_.patch.min[0]) + (i + 0.5) * d;
        const double y = static_cast<double>(shape_.patch.min[1]) + (j + 0.5) * d;
        const double below = (k + 0.5) * d;
        if (below >= depth_at(x, y)) continue;  // so that the water fills its volume, whatever the slope
        water.label.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(-below),
                               inside(x, y) < rim() ? kHeld : 0.0F});
      }
  place_labels(
      pool, moment(sea, anchor, time), moment(sea, anchor, time + 0.5 * next_dt), shape_.level, water.label.size(),
      [&](std::size_t k) { return water.label[k]; }, water.position, water.velocity);
  return water;
}

double OpenSea::depth_at(double x, double y) const {
  if (shape_.bed.empty()) return shape_.depth;
  return std::max(0.0,
                  shape_.level - static_cast<double>(shape_.bed.at(static_cast<float>(x), static_cast<float>(y)).x));
}

void OpenSea::give(TaskPool& pool, const WaveField& sea, const Eigen::Vector2d& anchor, double time, double dt,
                   FluidState& fluid) const {
  const WaveMoment at_place = moment(sea, anchor, time + dt), at_velocity = moment(sea, anchor, time + 1.5 * dt);
  HeldWater& held = fluid.held;
  place_labels(
      pool, at_place, at_velocity, shape_.level, held.rows.size(),
      [&](std::size_t k) { return fluid.particles.label[held.rows[k]]; }, held.position, held.velocity);
  if (!shape_.bed.empty()) return;  // it does not move
  lay_floor(shape_, fluid.floor);
  const WaveMoment low_place = lowered(at_place, shape_.depth), low_velocity = lowered(at_velocity, shape_.depth);
  FloorMaker(low_place, low_velocity, shape_.level - shape_.depth, fluid.floor).make(pool);
}

ZoneMismatch OpenSea::draw(TaskPool& pool, const WaveField& sea, const Eigen::Vector2d& anchor, double time, double dt,
                           FluidState& fluid) const {
  const WaveMoment at_place = moment(sea, anchor, time), at_velocity = moment(sea, anchor, time + 0.5 * dt);
  FluidParticles& p = fluid.particles;
  const auto level = static_cast<float>(shape_.level), highest = kHighestLabel * static_cast<float>(shape_.spacing);
  std::vector<ZoneMismatch> partial((p.count + kBlock - 1) / kBlock);
  pool.for_each_range(p.count, kBlock, [&](std::size_t begin, std::size_t end) {
    ZoneMismatch& sum = partial[begin / kBlock];
    LabelBatch batch;
    std::array<std::uint32_t, LabelBatch::kMost> row{};
    std::array<float, LabelBatch::kMost> share{};
    const auto pull = [&] {
      batch.displace(at_place);
      for (std::size_t n = 0; n < batch.count; ++n) {
        const Float4& x = p.position[row[n]];
        batch.x[n] = x.x - batch.a[n];
        batch.y[n] = x.y - batch.b[n];
        batch.z[n] = std::min(x.z - level - batch.c[n], highest);
        p.label[row[n]] = {batch.x[n], batch.y[n], batch.z[n], 0.0F};
      }
      batch.move(at_velocity);
      for (std::size_t n = 0; n < batch.count; ++n) {
        const Float4& v = p.velocity[row[n]];
        Float4& a = p.acceleration[row[n]];
        const float x = batch.a[n] - v.x, y = batch.b[n] - v.y, z = batch.c[n] - v.z;
        a.x += share[n] * x;
        a.y += share[n] * y;
        a.z += share[n] * z;
        sum.squares += static_cast<double>(x * x + y * y + z * z);
      }
      sum.count += static_cast<double>(batch.count);
      batch.clear();
    };
    for (std::size_t i = begin; i < end; ++i) {
      const Float4& x = p.position[i];
      if (p.label[i].w == kHeld) continue;
      const double s = draw_share(static_cast<double>(x.x), static_cast<double>(x.y));
      if (!(s > 0.0)) {
        p.label[i] = {x.x, x.y, std::min(x.z - level, highest), 0.0F};
        continue;
      }
      row[batch.count] = static_cast<std::uint32_t>(i);
      share[batch.count] = static_cast<float>((1.0 - std::exp(-s * kDrawRate * dt)) / dt);
      batch.add(p.label[i]);
      if (batch.full()) pull();
    }
    pull();
  });
  ZoneMismatch total;
  for (const ZoneMismatch& part : partial) total += part;
  return total;
}

Renewal OpenSea::renew(TaskPool& pool, std::size_t wanted, FluidState& fluid) const {
  FluidParticles& p = fluid.particles;
  Renewal done;
  std::vector<std::uint8_t> gone(p.count, 0);
  std::vector<std::uint32_t> surplus;
  std::size_t free = 0;
  for (std::size_t i = 0; i < p.count; ++i) {
    if (p.label[i].w == kHeld) continue;
    const Float4& x = p.position[i];
    const double in = inside(static_cast<double>(x.x), static_cast<double>(x.y));
    if (in < 0.0) {
      gone[i] = 1;
      ++done.spray;
      continue;
    }
    ++free;
    if (p.label[i].z > -kSurplusDepth * static_cast<float>(shape_.spacing) &&
        draw_share(static_cast<double>(x.x), static_cast<double>(x.y)) > kSurplusDraw)
      surplus.push_back(static_cast<std::uint32_t>(i));
  }
  if (free > wanted) {
    const std::size_t most = std::min((free - wanted + kSurplusShare - 1) / kSurplusShare, surplus.size());
    for (std::size_t k = 0; k < most; ++k) gone[surplus[k * surplus.size() / most]] = 1;
  }
  done.deleted = remove_particles(pool, fluid, [&](std::size_t i) { return gone[i] != 0; });
  if (done.deleted > 0) find_held(fluid);
  return done;
}

namespace {

float& component(Float4& record, std::size_t axis) { return axis == 0 ? record.x : record.y; }

/// Labels of a new column at an edge across an axis.
std::vector<Float4> edge_column(const OpenSeaShape& shape, std::size_t axis, int way) {
  const double d = shape.spacing;
  const std::size_t along = 1 - axis;
  const auto rows =
      static_cast<int>(std::lround(static_cast<double>(shape.patch.max[along] - shape.patch.min[along]) / d));
  const auto layers = static_cast<int>(std::lround(shape.depth / d));
  const double across = static_cast<double>(way > 0 ? shape.patch.max[axis] : shape.patch.min[axis]) - 0.5 * way * d;
  std::vector<Float4> labels;
  for (int k = 0; k < layers; ++k)
    for (int j = 0; j < rows; ++j) {
      Float4& label = labels.emplace_back(Float4{0.0F, 0.0F, static_cast<float>(-(k + 0.5) * d), kHeld});
      component(label, axis) = static_cast<float>(across);
      component(label, along) = static_cast<float>(static_cast<double>(shape.patch.min[along]) + (j + 0.5) * d);
    }
  return labels;
}

}  // namespace

Renewal OpenSea::shift(TaskPool& pool, const WaveField& sea, const Eigen::Vector2d& anchor, double time, double dt,
                       std::size_t axis, int way, FluidState& fluid) const {
  FluidParticles& p = fluid.particles;
  const double d = shape_.spacing;
  const auto step = static_cast<float>(way * d);
  const auto weight = static_cast<float>(fluid.parameters.gravity * dt * dt);
  const auto highest = static_cast<float>(kHighestHeld * d), lowest = static_cast<float>(-shape_.depth + 0.01 * d);
  std::vector<std::uint8_t> gone(p.count, 0);
  Renewal done;
  for (std::size_t i = 0; i < p.count; ++i) {
    Float4& label = p.label[i];
    component(p.position[i], axis) -= step;
    component(label, axis) -= step;
    const double ahead = inside_of(axis, way, component(label, axis));
    if (label.w == kHeld) {
      if (inside_of(axis, -way, component(label, axis)) < 0.0) {
        gone[i] = 1;
      } else if (ahead > 0.5 * static_cast<double>(shape_.patch.max[axis] - shape_.patch.min[axis])) {
        continue;  // of the edge behind
      } else if (inside(static_cast<double>(label.x), static_cast<double>(label.y)) > rim()) {
        label.w = 0.0F;
        p.acceleration[i] = {0.0F, 0.0F, static_cast<float>(-fluid.parameters.gravity), 0.0F};
        p.divergence_pressure[i] = weight * std::max(0.0F, -label.z);
      }
      continue;
    }
    if (inside_of(axis, -way, component(p.position[i], axis)) >= rim()) continue;
    if (label.z > highest) {
      gone[i] = 1;
      ++done.spray;
      continue;
    }
    label.z = std::clamp(label.z, lowest, 0.0F);
    label.w = kHeld;
  }
  done.deleted = remove_particles(pool, fluid, [&](std::size_t i) { return gone[i] != 0; });
  const std::vector<Float4> column = edge_column(shape_, axis, way);
  std::vector<Float4> position, velocity;
  place_labels(
      pool, moment(sea, anchor, time), moment(sea, anchor, time + 0.5 * dt), shape_.level, column.size(),
      [&](std::size_t k) { return column[k]; }, position, velocity);
  add_particles(fluid, position, velocity, kWaterPhase, column);
  done.created = column.size();
  find_held(fluid);
  return done;
}

CouplingFade OpenSea::coupling_fade() const {
  CouplingFade fade;
  for (std::size_t axis = 0; axis < 2; ++axis)
    if (shape_.open[axis]) fade.low[axis] = shape_.patch.min[axis], fade.high[axis] = shape_.patch.max[axis];
  fade.start = static_cast<float>(rim());
  fade.width = static_cast<float>(kFadeWidth * shape_.spacing);
  return fade;
}

WaveMoment OpenSea::moment(const WaveField& sea, const Eigen::Vector2d& anchor, double time) const {
  WaveMoment moment = sea.at(time, anchor);
  const auto most = static_cast<float>(2.0 * std::numbers::pi / (kShortestParticleWave * shape_.spacing));
  std::erase_if(moment.waves, [most](const MomentWave& wave) { return wave.wavenumber > most; });
  return moment;
}

std::optional<OpenSeaShape> open_sea_shape(const Scene& scene, const PatchFrame& frame) {
  if (!is_open(scene.patch_edges)) return std::nullopt;
  const Box patch = frame.local_box(), &block = scene.water.blocks[0];
  OpenSeaShape shape;
  shape.spacing = scene.particle_spacing;
  for (int axis = 0; axis < 3; ++axis) {
    shape.patch.min[axis] = static_cast<float>(patch.min[axis]);
    shape.patch.max[axis] = static_cast<float>(patch.max[axis]);
  }
  for (std::size_t axis = 0; axis < 2; ++axis) shape.open[axis] = scene.patch_edges[axis] == PatchEdge::kOpen;
  shape.level = frame.local_height(block.max.z());
  shape.depth = block.size().z();
  shape.zone = scene.open_sea.zone_width;
  if (!scene.open_sea.bed.heights.empty()) {
    lay_floor(shape, shape.bed);
    shape_bed(scene, frame, shape.bed);
  }
  return shape;
}

double sea_depth(const Scene& scene) { return scene.open_sea.depth > 0.0 ? scene.open_sea.depth : kInfiniteDepth; }

}  // namespace pelagos
