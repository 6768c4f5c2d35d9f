#include "wind/gust_wind.hpp"

#include <algorithm>
#include <cmath>

#include "column_grid.hpp"
#include "waves/splitmix.hpp"
#include "wind/perlin_noise.hpp"

namespace pelagos {

// The depth profile f.
//
// The paper's wind adds to a particle at height z above the bottom, every step (eq. 33, 34),
//   dv = beta (rho_air / rho) v_ref ln(z / z0) / ln(h_ref / z0) ,   z0 = 0.01 m, h_ref = 10 m.
// Its wind scene (section VI.B with L = 1 m, d = 0.05 m, water 0.5 m deep) has nine layers of particles, z = d .. 9 d,
// so the push averaged over a column is, per step and in units of beta (rho_air / rho) v_ref,
//   m = 1/9 sum_{i=1..9} ln(i d / z0) / ln(h_ref / z0) = 0.43891 .
// Taking the step as t_ref = 0.07 sqrt(d / g), the largest the scene may use, turns dv / dt into an acceleration.
// Ours is to fall from 1 at the surface. The simplest law that does is f = exp(-depth / D). With the surface half a
// spacing above the top layer the depths are (i + 1/2) d, and the same mean push asks for
//   1/9 sum_{i=0..8} exp(-(i + 1/2) d / D) = m   ->   D = 4.6139 d .
// D is tied to the spacing and not to the water's depth: the law is scale-free like everything else, a deep column
// takes the same push through its surface as this one (17 % more than its nine layers), and the wind does not act
// like tilted gravity.

namespace {

constexpr double kStepFactor = 0.07;       ///< t_ref = 0.07 sqrt(d / g)
constexpr float kNegligibleDecays = 7.0f;  ///< deeper than so many decay depths f is below 1e-3 and left out
constexpr std::size_t kParticlesPerBlock = 2048;

double pulse_value(const std::optional<WindPulse>& pulse, double time) {
  if (!pulse) return 1.0;
  const double phase = time - pulse->period * std::floor(time / pulse->period);
  return phase < pulse->width ? 1.0 : 0.0;
}

/// Integral over [0, tau] of (u0 + du s) / (l0 + dl s).
Eigen::Vector3d integrate_ratio(const Eigen::Vector3d& u0, const Eigen::Vector3d& du, double l0, double dl,
                                double tau) {
  if (std::abs(dl) * tau < 1e-6 * l0) return (u0 * tau + du * (0.5 * tau * tau)) / (l0 + 0.5 * dl * tau);
  const double growth = std::log1p(dl * tau / l0) / dl;
  return du * (tau / dl) + (u0 - du * (l0 / dl)) * growth;
}

}  // namespace

GustWind::GustWind(const GustSite& site, const WindSettings& wind, double time)
    : site_(site), from_(wind), to_(wind), ramp_start_(time) {
  SplitMix64 random(site.seed);
  for (Eigen::Vector3d& offset : offset_)
    for (int axis = 0; axis < 3; ++axis) offset[axis] = 256.0 * random.next_unit();
}

void GustWind::set(const WindSettings& wind, double time, double ramp_seconds) {
  const Blend present = blend_at(time);
  carried_ = carried_at(time);
  from_ = present.wind;
  from_pulse_ = present.pulse;
  to_ = wind;
  ramp_start_ = time;
  ramp_seconds_ = std::max(ramp_seconds, 0.0);
}

GustWind::Blend GustWind::blend_at(double time) const {
  const double since = time - ramp_start_;
  const double part = since < ramp_seconds_ ? std::max(since, 0.0) / ramp_seconds_ : 1.0;
  if (part >= 1.0) return {1.0, pulse_value(to_.pulse, time), to_};
  Blend blend{part, from_pulse_ + part * (pulse_value(to_.pulse, time) - from_pulse_), to_};
  blend.wind.velocity = from_.velocity + part * (to_.velocity - from_.velocity);
  blend.wind.amplitude = from_.amplitude + part * (to_.amplitude - from_.amplitude);
  blend.wind.length = from_.length + part * (to_.length - from_.length);
  blend.wind.beta = from_.beta + part * (to_.beta - from_.beta);
  return blend;
}

WindSettings GustWind::settings_at(double time) const { return blend_at(time).wind; }

Eigen::Vector3d GustWind::carried_at(double time) const {
  const double since = std::max(time - ramp_start_, 0.0);
  const double ramped = std::min(since, ramp_seconds_);
  Eigen::Vector3d carried = carried_ + to_.velocity * ((since - ramped) / to_.length);
  if (ramped > 0.0)
    carried += integrate_ratio(from_.velocity, (to_.velocity - from_.velocity) / ramp_seconds_, from_.length,
                               (to_.length - from_.length) / ramp_seconds_, ramped);
  return carried;
}

Eigen::Vector3d GustWind::disturbance(const Eigen::Vector3d& position, double length,
                                      const Eigen::Vector3d& carried) const {
  const Eigen::Vector3d s = position / length - carried;
  Eigen::Vector3d noise;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d p = s + offset_[static_cast<std::size_t>(axis)];
    noise[axis] = perlin_noise(p.x(), p.y(), p.z());
  }
  return noise;
}

Eigen::Vector3d GustWind::velocity_at(const Eigen::Vector3d& position, double time) const {
  const Blend blend = blend_at(time);
  if (blend.wind.amplitude == 0.0) return blend.pulse * blend.wind.velocity;
  return blend.pulse *
         (blend.wind.velocity + blend.wind.amplitude * disturbance(position, blend.wind.length, carried_at(time)));
}

void GustWind::add_acceleration(TaskPool& pool, std::span<const Float4> position, std::size_t count, double time,
                                std::span<Float4> acceleration) {
  const Blend blend = blend_at(time);
  const double reference_time = kStepFactor * std::sqrt(site_.spacing / site_.gravity);  // infinite without gravity
  const double scale = blend.pulse * blend.wind.beta * kAirDensity / site_.rest_density / reference_time;
  if (!(scale > 0.0) || (blend.wind.velocity.isZero() && blend.wind.amplitude == 0.0)) return;

  const auto spacing = static_cast<float>(site_.spacing);
  const ColumnGrid grid = make_column_grid(position.first(count), 2.0f * spacing);
  if (grid.columns == 0) return;
  find_highest(grid, position.first(count), height_);

  // The push at the surface and the surface's height, column by column.
  const Eigen::Vector3d carried = carried_at(time);
  column_.resize(grid.cell_count());
  pool.for_each_range(static_cast<std::size_t>(grid.rows), 4, [&](std::size_t begin, std::size_t end) {
    for (int j = static_cast<int>(begin); j < static_cast<int>(end); ++j)
      for (int i = 0; i < grid.columns; ++i) {
        const Eigen::Vector3d centre(static_cast<double>(grid.origin_x) + (i + 0.5) * static_cast<double>(grid.cell),
                                     static_cast<double>(grid.origin_y) + (j + 0.5) * static_cast<double>(grid.cell),
                                     site_.water_level);
        Eigen::Vector3d air = blend.wind.velocity;
        if (blend.wind.amplitude > 0.0) air += blend.wind.amplitude * disturbance(centre, blend.wind.length, carried);
        const Eigen::Vector3f push = (scale * air).cast<float>();
        const float surface =
            surface_height(grid, height_, i, j, 2.0f * spacing, static_cast<float>(site_.water_level) - 0.5f * spacing);
        column_[grid.index(i, j)] = {push.x(), push.y(), push.z(), surface + 0.5f * spacing};
      }
  });

  const float inverse_cell = 1.0f / grid.cell;
  const float inverse_decay = 1.0f / (static_cast<float>(kDecaySpacings) * spacing);
  pool.for_each_range(count, kParticlesPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      const Float4& p = position[n];
      // Place between the four cell centres around; beyond the outermost centres the nearest values hold.
      const float gx = (p.x - grid.origin_x) * inverse_cell - 0.5f, gy = (p.y - grid.origin_y) * inverse_cell - 0.5f;
      if (!std::isfinite(gx + gy + p.z)) continue;
      const float cx = std::clamp(gx, 0.0f, static_cast<float>(grid.columns - 1));
      const float cy = std::clamp(gy, 0.0f, static_cast<float>(grid.rows - 1));
      const int i = std::min(static_cast<int>(cx), std::max(grid.columns - 2, 0));
      const int j = std::min(static_cast<int>(cy), std::max(grid.rows - 2, 0));
      const float u = cx - static_cast<float>(i), v = cy - static_cast<float>(j);
      const int right = std::min(i + 1, grid.columns - 1), upper = std::min(j + 1, grid.rows - 1);
      const Float4 &a = column_[grid.index(i, j)], &b = column_[grid.index(right, j)];
      const Float4 &c = column_[grid.index(i, upper)], &d = column_[grid.index(right, upper)];
      const float wa = (1 - u) * (1 - v), wb = u * (1 - v), wc = (1 - u) * v, wd = u * v;
      const float depth = wa * a.w + wb * b.w + wc * c.w + wd * d.w - p.z;
      const float decays = std::max(depth, 0.0f) * inverse_decay;
      if (decays > kNegligibleDecays) continue;
      const float f = std::exp(-decays);
      acceleration[n].x += f * (wa * a.x + wb * b.x + wc * c.x + wd * d.x);
      acceleration[n].y += f * (wa * a.y + wb * b.y + wc * c.y + wd * d.y);
      acceleration[n].z += f * (wa * a.z + wb * b.z + wc * c.z + wd * d.z);
    }
  });
}

}  // namespace pelagos
