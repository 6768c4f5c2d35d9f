#include <algorithm>
#include <cassert>
#include <cstddef>
#include <vector>

#include "waves/wave_moment.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wave_batches.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pelagos {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kMostLanes = 16;
using Tag = hn::CappedTag<float, kMostLanes>;
using V = hn::Vec<Tag>;

HWY_INLINE V set(float value) { return hn::Set(Tag(), value); }

struct SinCos {
  V sine, cosine;
};

/// sin(2 pi y), |y| <= 1/4: interpolated in y^2 at Chebyshev's points, error 1.5e-7.
HWY_INLINE V sine_of_quarter(V y) {
  const V u = hn::Mul(y, y);
  V p = hn::MulAdd(u, set(39.75982666015625F), set(-76.58116912841797F));
  p = hn::MulAdd(u, p, set(81.60247802734375F));
  p = hn::MulAdd(u, p, set(-41.34168243408203F));
  p = hn::MulAdd(u, p, set(6.2831854820251465F));
  return hn::Mul(y, p);
}

HWY_INLINE SinCos sin_cos_of_turns(V turns) {
  const V r = hn::Sub(turns, hn::Round(turns));
  const V size = hn::Abs(r), quarter = set(0.25F);
  const V folded = hn::Sub(hn::CopySign(set(0.5F), r), r);
  return {sine_of_quarter(hn::IfThenElse(hn::Gt(size, quarter), folded, r)), sine_of_quarter(hn::Sub(quarter, size))};
}

/// e^x for x <= 0: 2^n 2^f, |f| <= 1/2; the second interpolated at Chebyshev's points, absolute error 1e-7.
HWY_INLINE V decay(V x) {
  const V binary = hn::Mul(hn::Max(x, set(-87.0F)), set(1.4426950408889634F));
  const V n = hn::Round(binary), f = hn::Sub(binary, n);
  V p = hn::MulAdd(f, set(0.00015461444854736328F), set(0.0013400427997112274F));
  p = hn::MulAdd(f, p, set(0.009618056938052177F));
  p = hn::MulAdd(f, p, set(0.05550327152013779F));
  p = hn::MulAdd(f, p, set(0.24022650718688965F));
  p = hn::MulAdd(f, p, set(0.6931471824645996F));
  p = hn::MulAdd(f, p, set(1.0F));
  const hn::RebindToSigned<Tag> integers;
  const auto exponent = hn::ShiftLeft<23>(hn::Add(hn::ConvertTo(integers, n), hn::Set(integers, 127)));
  return hn::Mul(p, hn::BitCast(Tag(), exponent));
}

HWY_INLINE SinCos angle_of(const MomentWave& wave, V x, V y) {
  return sin_cos_of_turns(hn::MulAdd(set(wave.turns_x), x, hn::MulAdd(set(wave.turns_y), y, set(wave.phase))));
}

/// cosh k(z + h) / sinh kh and sinh k(z + h) / sinh kh, -h <= z <= 0.
struct Profile {
  V even, odd;
};
HWY_INLINE Profile profile_of(const MomentWave& wave, V z, float depth) {
  const V down = decay(hn::Mul(set(wave.wavenumber), z));
  if (wave.echo == 0.0F) return {down, down};
  const V up = decay(hn::Mul(set(-wave.wavenumber), hn::Add(z, set(2.0F * depth))));
  return {hn::Mul(set(wave.bed), hn::Add(down, up)), hn::Mul(set(wave.bed), hn::Sub(down, up))};
}

struct SurfaceBlock {
  V elevation, slope_x, slope_y, rate;
};
HWY_INLINE SurfaceBlock surface_block(const WaveMoment& moment, V x, V y) {
  const V zero = hn::Zero(Tag());
  SurfaceBlock sum{zero, zero, zero, zero};
  for (const MomentWave& wave : moment.waves) {
    const SinCos angle = angle_of(wave, x, y);
    const V steep = hn::Mul(set(-wave.amplitude * wave.wavenumber), angle.sine);
    sum.elevation = hn::MulAdd(set(wave.amplitude), angle.cosine, sum.elevation);
    sum.slope_x = hn::MulAdd(set(wave.along_x), steep, sum.slope_x);
    sum.slope_y = hn::MulAdd(set(wave.along_y), steep, sum.slope_y);
    sum.rate = hn::MulAdd(set(wave.amplitude * wave.omega), angle.sine, sum.rate);
    sum.rate = hn::MulAdd(set(wave.amplitude_rate), angle.cosine, sum.rate);
  }
  return sum;
}

/// z of the theory, between bottom and mean level.
HWY_INLINE V theory_height(const WaveMoment& moment, V z, V elevation, Stretching stretching) {
  const auto depth = static_cast<float>(moment.depth);
  const bool deep = !(depth < 1e30F);
  if (stretching == Stretching::kWheeler) {
    z = hn::Sub(z, elevation);
    const V water = hn::Max(hn::Add(set(deep ? 1.0F : depth), elevation), set(deep ? 1.0F : 0.01F * depth));
    if (!deep) z = hn::Mul(z, hn::Div(set(depth), water));
  }
  z = hn::Min(z, hn::Zero(Tag()));
  return deep ? z : hn::Max(z, set(-depth));
}

struct MotionBlock {
  V velocity[3], acceleration[3], pressure;
};
/// @param angles  scratch: sine and cosine of each component, one vector each
template <bool kAll>
HWY_INLINE MotionBlock motion_block(const WaveMoment& moment, V x, V y, V z, Stretching stretching, float* angles) {
  const Tag d;
  const std::size_t lanes = hn::Lanes(d);
  V elevation = hn::Zero(d);
  float* angle = angles;
  for (const MomentWave& wave : moment.waves) {
    const SinCos a = angle_of(wave, x, y);
    hn::StoreU(a.sine, d, angle);
    hn::StoreU(a.cosine, d, angle + lanes);
    angle += 2 * lanes;
    elevation = hn::MulAdd(set(wave.amplitude), a.cosine, elevation);
  }
  const V height = theory_height(moment, z, elevation, stretching);
  MotionBlock sum{};
  for (int axis = 0; axis < 3; ++axis) sum.velocity[axis] = sum.acceleration[axis] = hn::Zero(d);
  sum.pressure = hn::Zero(d);
  angle = angles;
  for (const MomentWave& wave : moment.waves) {
    const V sine = hn::LoadU(d, angle), cosine = hn::LoadU(d, angle + lanes);
    angle += 2 * lanes;
    const Profile profile = profile_of(wave, height, static_cast<float>(moment.depth));
    const V even_cosine = hn::Mul(profile.even, cosine), odd_sine = hn::Mul(profile.odd, sine);
    const float speed = wave.amplitude * wave.omega;
    const V ahead = hn::Mul(set(speed), even_cosine);
    sum.velocity[0] = hn::MulAdd(set(wave.along_x), ahead, sum.velocity[0]);
    sum.velocity[1] = hn::MulAdd(set(wave.along_y), ahead, sum.velocity[1]);
    sum.velocity[2] = hn::MulAdd(set(speed), odd_sine, sum.velocity[2]);
    if constexpr (kAll) {
      const float pull = speed * wave.omega, growth = wave.amplitude_rate * wave.omega;
      const V forward = hn::MulAdd(set(pull), hn::Mul(profile.even, sine), hn::Mul(set(growth), even_cosine));
      sum.acceleration[0] = hn::MulAdd(set(wave.along_x), forward, sum.acceleration[0]);
      sum.acceleration[1] = hn::MulAdd(set(wave.along_y), forward, sum.acceleration[1]);
      sum.acceleration[2] = hn::MulAdd(set(-pull), hn::Mul(profile.odd, cosine), sum.acceleration[2]);
      sum.acceleration[2] = hn::MulAdd(set(growth), odd_sine, sum.acceleration[2]);
      sum.pressure = hn::MulAdd(set(pull / wave.wavenumber), even_cosine, sum.pressure);
    }
  }
  return sum;
}

struct ShiftBlock {
  V x, y, z;
};
HWY_INLINE ShiftBlock shift_block(const WaveMoment& moment, V x, V y, V z) {
  const V zero = hn::Zero(Tag());
  ShiftBlock sum{zero, zero, zero};
  const V height = theory_height(moment, z, zero, Stretching::kNone);
  for (const MomentWave& wave : moment.waves) {
    const SinCos angle = angle_of(wave, x, y);
    const Profile profile = profile_of(wave, height, static_cast<float>(moment.depth));
    const V back = hn::Mul(set(-wave.amplitude), hn::Mul(profile.even, angle.sine));
    sum.x = hn::MulAdd(set(wave.along_x), back, sum.x);
    sum.y = hn::MulAdd(set(wave.along_y), back, sum.y);
    const V mean = hn::Mul(set(0.5F * wave.wavenumber * wave.amplitude * wave.amplitude), profile.even);
    sum.z = hn::MulAdd(profile.odd, hn::MulAdd(set(wave.amplitude), angle.cosine, mean), sum.z);
  }
  return sum;
}

/// The horizontal displacement of a surface particle and its gradient.
struct Stretch {
  V x, y, xx, xy, yy;

  /// The solution of (1 + gradient) way = (a, b); (a, b) itself where the surface is about to fold.
  HWY_INLINE void solve(V a, V b, V& way_x, V& way_y) const {
    const V one = set(1.0F), p = hn::Add(one, xx), q = hn::Add(one, yy);
    const V determinant = hn::Sub(hn::Mul(p, q), hn::Mul(xy, xy));
    const auto folds = hn::Lt(determinant, set(0.15F));
    const V inverse = hn::Div(one, hn::IfThenElse(folds, one, determinant));
    way_x = hn::IfThenElse(folds, a, hn::Mul(inverse, hn::Sub(hn::Mul(q, a), hn::Mul(xy, b))));
    way_y = hn::IfThenElse(folds, b, hn::Mul(inverse, hn::Sub(hn::Mul(p, b), hn::Mul(xy, a))));
  }
};

/// At the mean level: cosh kh / sinh kh.
HWY_INLINE float even_at_level(const MomentWave& wave) { return (1.0F + wave.echo) * wave.bed; }

HWY_INLINE void add_stretch(const MomentWave& wave, const SinCos& angle, Stretch& sum) {
  const float reach = wave.amplitude * even_at_level(wave);
  const V back = hn::Mul(set(-reach), angle.sine), steep = hn::Mul(set(-reach * wave.wavenumber), angle.cosine);
  sum.x = hn::MulAdd(set(wave.along_x), back, sum.x);
  sum.y = hn::MulAdd(set(wave.along_y), back, sum.y);
  sum.xx = hn::MulAdd(set(wave.along_x * wave.along_x), steep, sum.xx);
  sum.xy = hn::MulAdd(set(wave.along_x * wave.along_y), steep, sum.xy);
  sum.yy = hn::MulAdd(set(wave.along_y * wave.along_y), steep, sum.yy);
}

struct DisplacedBlock {
  V height, slope_x, slope_y, velocity[3];
};
HWY_INLINE DisplacedBlock displaced_block(const WaveMoment& moment, V x, V y) {
  constexpr int kNewtonSteps = 4;
  const V zero = hn::Zero(Tag());
  V rest_x = x, rest_y = y;
  for (int step = 0; step < kNewtonSteps; ++step) {
    Stretch stretch{zero, zero, zero, zero, zero};
    for (const MomentWave& wave : moment.waves) add_stretch(wave, angle_of(wave, rest_x, rest_y), stretch);
    V way_x, way_y;
    stretch.solve(hn::Sub(hn::Add(rest_x, stretch.x), x), hn::Sub(hn::Add(rest_y, stretch.y), y), way_x, way_y);
    rest_x = hn::Sub(rest_x, way_x);
    rest_y = hn::Sub(rest_y, way_y);
  }
  Stretch stretch{zero, zero, zero, zero, zero};
  DisplacedBlock sum{zero, zero, zero, {zero, zero, zero}};
  for (const MomentWave& wave : moment.waves) {
    const SinCos angle = angle_of(wave, rest_x, rest_y);
    add_stretch(wave, angle, stretch);
    const float even = even_at_level(wave), speed = wave.amplitude * wave.omega;
    const V mean = set(0.5F * wave.wavenumber * wave.amplitude * wave.amplitude * even);
    sum.height = hn::Add(sum.height, hn::MulAdd(set(wave.amplitude), angle.cosine, mean));
    const V steep = hn::Mul(set(-wave.amplitude * wave.wavenumber), angle.sine);
    sum.slope_x = hn::MulAdd(set(wave.along_x), steep, sum.slope_x);
    sum.slope_y = hn::MulAdd(set(wave.along_y), steep, sum.slope_y);
    const V ahead = hn::Mul(set(speed * even), angle.cosine);
    sum.velocity[0] = hn::MulAdd(set(wave.along_x), ahead, sum.velocity[0]);
    sum.velocity[1] = hn::MulAdd(set(wave.along_y), ahead, sum.velocity[1]);
    sum.velocity[2] = hn::MulAdd(set(speed), angle.sine, sum.velocity[2]);
  }
  stretch.solve(sum.slope_x, sum.slope_y, sum.slope_x, sum.slope_y);
  return sum;
}

/// Some values of an array as a vector; the lanes past the end are 0.
HWY_INLINE V load_some(const float* from, std::size_t count) {
  if (count >= hn::Lanes(Tag())) return hn::LoadU(Tag(), from);
  float padded[kMostLanes] = {};
  std::copy_n(from, count, padded);
  return hn::LoadU(Tag(), padded);
}
HWY_INLINE void store_some(V value, float* to, std::size_t count) {
  if (count >= hn::Lanes(Tag())) return hn::StoreU(value, Tag(), to);
  float padded[kMostLanes];
  hn::StoreU(value, Tag(), padded);
  std::copy_n(padded, count, to);
}

void surface_impl(const WaveMoment& moment, const float* x, const float* y, std::size_t count,
                  const WaveSurfaceArrays& out) {
  const std::size_t lanes = hn::Lanes(Tag());
  for (std::size_t i = 0; i < count; i += lanes) {
    const std::size_t some = std::min(lanes, count - i);
    const SurfaceBlock block = surface_block(moment, load_some(x + i, some), load_some(y + i, some));
    store_some(block.elevation, out.elevation.data() + i, some);
    store_some(block.slope_x, out.slope_x.data() + i, some);
    store_some(block.slope_y, out.slope_y.data() + i, some);
    store_some(block.rate, out.rate.data() + i, some);
  }
}

template <bool kAll>
void motion_with(const WaveMoment& moment, const float* x, const float* y, const float* z, std::size_t count,
                 Stretching stretching, const WaveMotionArrays& out) {
  const std::size_t lanes = hn::Lanes(Tag());
  std::vector<float> angles(2 * lanes * moment.waves.size());
  for (std::size_t i = 0; i < count; i += lanes) {
    const std::size_t some = std::min(lanes, count - i);
    const MotionBlock block = motion_block<kAll>(moment, load_some(x + i, some), load_some(y + i, some),
                                                 load_some(z + i, some), stretching, angles.data());
    store_some(block.velocity[0], out.velocity_x.data() + i, some);
    store_some(block.velocity[1], out.velocity_y.data() + i, some);
    store_some(block.velocity[2], out.velocity_z.data() + i, some);
    if constexpr (kAll) {
      store_some(block.acceleration[0], out.acceleration_x.data() + i, some);
      store_some(block.acceleration[1], out.acceleration_y.data() + i, some);
      store_some(block.acceleration[2], out.acceleration_z.data() + i, some);
      store_some(block.pressure, out.pressure.data() + i, some);
    }
  }
}

void motion_impl(const WaveMoment& moment, const float* x, const float* y, const float* z, std::size_t count,
                 Stretching stretching, const WaveMotionArrays& out) {
  if (out.pressure.empty())
    motion_with<false>(moment, x, y, z, count, stretching, out);
  else
    motion_with<true>(moment, x, y, z, count, stretching, out);
}

void shift_impl(const WaveMoment& moment, const float* x, const float* y, const float* z, std::size_t count,
                float* shift_x, float* shift_y, float* shift_z) {
  const std::size_t lanes = hn::Lanes(Tag());
  for (std::size_t i = 0; i < count; i += lanes) {
    const std::size_t some = std::min(lanes, count - i);
    const ShiftBlock block =
        shift_block(moment, load_some(x + i, some), load_some(y + i, some), load_some(z + i, some));
    store_some(block.x, shift_x + i, some);
    store_some(block.y, shift_y + i, some);
    store_some(block.z, shift_z + i, some);
  }
}

void displaced_impl(const WaveMoment& moment, const float* x, const float* y, std::size_t count,
                    const DisplacedSurfaceArrays& out) {
  const std::size_t lanes = hn::Lanes(Tag());
  for (std::size_t i = 0; i < count; i += lanes) {
    const std::size_t some = std::min(lanes, count - i);
    const DisplacedBlock block = displaced_block(moment, load_some(x + i, some), load_some(y + i, some));
    store_some(block.height, out.height.data() + i, some);
    store_some(block.slope_x, out.slope_x.data() + i, some);
    store_some(block.slope_y, out.slope_y.data() + i, some);
    store_some(block.velocity[0], out.velocity_x.data() + i, some);
    store_some(block.velocity[1], out.velocity_y.data() + i, some);
    store_some(block.velocity[2], out.velocity_z.data() + i, some);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace pelagos
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pelagos {

HWY_EXPORT(surface_impl);
HWY_EXPORT(motion_impl);
HWY_EXPORT(shift_impl);
HWY_EXPORT(displaced_impl);

void evaluate_surface(const WaveMoment& moment, std::span<const float> x, std::span<const float> y,
                      const WaveSurfaceArrays& out) {
  assert(y.size() == x.size() && out.elevation.size() == x.size() && out.slope_x.size() == x.size() &&
         out.slope_y.size() == x.size() && out.rate.size() == x.size());
  HWY_DYNAMIC_DISPATCH(surface_impl)(moment, x.data(), y.data(), x.size(), out);
}

void evaluate_motion(const WaveMoment& moment, std::span<const float> x, std::span<const float> y,
                     std::span<const float> z, Stretching stretching, const WaveMotionArrays& out) {
  assert(y.size() == x.size() && z.size() == x.size() && out.velocity_x.size() == x.size() &&
         out.velocity_y.size() == x.size() && out.velocity_z.size() == x.size());
  assert(out.pressure.empty() ? out.acceleration_x.empty() : out.pressure.size() == x.size());
  HWY_DYNAMIC_DISPATCH(motion_impl)(moment, x.data(), y.data(), z.data(), x.size(), stretching, out);
}

void evaluate_displacement(const WaveMoment& moment, std::span<const float> x, std::span<const float> y,
                           std::span<const float> z, std::span<float> shift_x, std::span<float> shift_y,
                           std::span<float> shift_z) {
  assert(y.size() == x.size() && z.size() == x.size() && shift_x.size() == x.size() && shift_y.size() == x.size() &&
         shift_z.size() == x.size());
  HWY_DYNAMIC_DISPATCH(shift_impl)
  (moment, x.data(), y.data(), z.data(), x.size(), shift_x.data(), shift_y.data(), shift_z.data());
}

void evaluate_displaced_surface(const WaveMoment& moment, std::span<const float> x, std::span<const float> y,
                                const DisplacedSurfaceArrays& out) {
  assert(y.size() == x.size() && out.height.size() == x.size() && out.velocity_z.size() == x.size());
  HWY_DYNAMIC_DISPATCH(displaced_impl)(moment, x.data(), y.data(), x.size(), out);
}

WavePoint surface_at(const WaveMoment& moment, float x, float y) {
  WavePoint point;
  evaluate_surface(moment, {&x, 1}, {&y, 1},
                   {{&point.elevation, 1}, {&point.slope_x, 1}, {&point.slope_y, 1}, {&point.rate, 1}});
  return point;
}

WaveMotion motion_at(const WaveMoment& moment, const Eigen::Vector3f& place, Stretching stretching) {
  WaveMotion motion;
  const auto one = [](float& value) { return std::span<float>(&value, 1); };
  evaluate_motion(
      moment, {&place.x(), 1}, {&place.y(), 1}, {&place.z(), 1}, stretching,
      {one(motion.velocity.x()), one(motion.velocity.y()), one(motion.velocity.z()), one(motion.acceleration.x()),
       one(motion.acceleration.y()), one(motion.acceleration.z()), one(motion.pressure)});
  return motion;
}

}  // namespace pelagos
#endif
