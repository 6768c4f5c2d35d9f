#include "packing/particle_codec.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace pelagos {
namespace {

constexpr float kPositionSteps = 65535.0F;
constexpr int kSignedHalf = 511;  // 10 bit fields hold 0..1022; 511 is exactly zero
constexpr float kSqrtHalf = 0.70710678118654752F;
constexpr float kScaleSteps = 32.0F;  // for each doubling
constexpr float kScaleZero = 128.0F;

void put_u16(std::uint8_t* out, std::uint32_t value) {
  out[0] = static_cast<std::uint8_t>(value);
  out[1] = static_cast<std::uint8_t>(value >> 8);
}
void put_u32(std::uint8_t* out, std::uint32_t value) {
  put_u16(out, value);
  put_u16(out + 2, value >> 16);
}
std::uint32_t get_u16(const std::uint8_t* in) { return in[0] | static_cast<std::uint32_t>(in[1]) << 8; }
std::uint32_t get_u32(const std::uint8_t* in) { return get_u16(in) | get_u16(in + 2) << 16; }

/// -1..1 to 0..1022, rounded to the nearest.
std::uint32_t quantize_signed(float value) {
  const float clamped = std::clamp(value, -1.0F, 1.0F);
  return static_cast<std::uint32_t>(clamped * kSignedHalf + kSignedHalf + 0.5F);
}
float dequantize_signed(std::uint32_t bits) {
  return static_cast<float>(static_cast<int>(bits & 0x3FFU) - kSignedHalf) / kSignedHalf;
}

std::uint32_t pack_quaternion(const Eigen::Quaternionf& orientation) {
  const Eigen::Vector4f q = orientation.coeffs().normalized();  // x, y, z, w
  int largest = 0;
  for (int i = 1; i < 4; ++i) {
    if (std::abs(q[i]) > std::abs(q[largest])) largest = i;
  }
  const float scale = (q[largest] < 0.0F ? -1.0F : 1.0F) / kSqrtHalf;
  auto bits = static_cast<std::uint32_t>(largest);
  for (int i = 0; i < 4; ++i) {
    if (i != largest) bits = bits << 10 | quantize_signed(q[i] * scale);
  }
  return bits;
}

Eigen::Quaternionf unpack_quaternion(std::uint32_t bits) {
  const int largest = static_cast<int>(bits >> 30);
  Eigen::Vector4f q;
  float sum = 0.0F;
  for (int i = 3; i >= 0; --i) {
    if (i == largest) continue;
    q[i] = dequantize_signed(bits) * kSqrtHalf;
    sum += q[i] * q[i];
    bits >>= 10;
  }
  // Rounding, or a hostile sender, may push the sum over 1; then the length is put right below.
  q[largest] = std::sqrt(std::max(0.0F, 1.0F - sum));
  return Eigen::Quaternionf(q.normalized());
}

std::uint8_t pack_scale(float length, float inverse_spacing) {
  const float steps = std::log2(length * inverse_spacing) * kScaleSteps + kScaleZero;
  return static_cast<std::uint8_t>(std::clamp(steps + 0.5F, 0.0F, 255.0F));
}

/// Lengths for each octet, in spacings.
const std::array<float, 256>& scale_table() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = std::exp2((static_cast<float>(i) - kScaleZero) / kScaleSteps);
    }
    return values;
  }();
  return table;
}

/// False for NaN as well.
bool is_bounded(float value) { return std::abs(value) <= kLargestPackedMagnitude; }
bool is_bounded(const Eigen::Vector3f& v) { return is_bounded(v.x()) && is_bounded(v.y()) && is_bounded(v.z()); }

bool is_fit(const SurfaceParticle& particle) {
  const float quaternion_squared = particle.orientation.squaredNorm();
  return is_bounded(particle.position) && is_bounded(particle.velocity) && is_bounded(particle.semi_axes) &&
         particle.semi_axes.x() > 0.0F && particle.semi_axes.y() > 0.0F && particle.semi_axes.z() > 0.0F &&
         quaternion_squared > 0.5F && quaternion_squared < 2.0F;
}

PackingScales find_scales(std::span<const SurfaceParticle> particles) {
  constexpr float kFar = 2.0F * kLargestPackedMagnitude;
  Eigen::Vector3f low = Eigen::Vector3f::Constant(kFar);
  Eigen::Vector3f high = -low;
  float speed_squared = 0.0F;
  for (const SurfaceParticle& particle : particles) {
    if (!is_fit(particle)) continue;
    low = low.cwiseMin(particle.position);
    high = high.cwiseMax(particle.position);
    speed_squared = std::max(speed_squared, particle.velocity.squaredNorm());
  }
  PackingScales scales;
  if (low.x() <= high.x()) {
    scales.box_min = low;
    scales.box_size = high - low;
  }
  scales.largest_speed = std::sqrt(speed_squared);
  return scales;
}

/// Zero for what is so small that its inverse would overflow: a flat box, water at rest.
float inverse_or_zero(float value) { return value > 1e-30F ? 1.0F / value : 0.0F; }

}  // namespace

bool are_plausible(const PackingScales& scales) {
  // The box may be twice as wide as its corners are far; a speed is the length of three components.
  constexpr float kWidest = 2.0F * kLargestPackedMagnitude;
  const Eigen::Vector3f& size = scales.box_size;
  return is_bounded(scales.box_min) && size.x() >= 0.0F && size.y() >= 0.0F && size.z() >= 0.0F &&
         size.x() <= kWidest && size.y() <= kWidest && size.z() <= kWidest && scales.largest_speed >= 0.0F &&
         scales.largest_speed <= kWidest && scales.particle_spacing > 0.0F &&
         scales.particle_spacing <= kLargestPackedMagnitude;
}

PackReport pack_particles(std::span<const SurfaceParticle> particles, float particle_spacing,
                          std::vector<std::uint8_t>& records) {
  PackReport report;
  records.clear();
  report.scales.particle_spacing = particle_spacing;
  if (!are_plausible(report.scales)) {
    report.refused = static_cast<std::uint32_t>(particles.size());
    return report;
  }
  report.scales = find_scales(particles);
  report.scales.particle_spacing = particle_spacing;

  const Eigen::Vector3f to_steps = report.scales.box_size.unaryExpr(&inverse_or_zero) * kPositionSteps;
  const float inverse_speed = inverse_or_zero(report.scales.largest_speed);
  const float inverse_spacing = inverse_or_zero(particle_spacing);
  records.resize(particles.size() * kRecordBytes);
  std::uint8_t* out = records.data();
  for (const SurfaceParticle& particle : particles) {
    if (!is_fit(particle)) {
      ++report.refused;
      continue;
    }
    for (int axis = 0; axis < 3; ++axis) {
      const float steps = (particle.position[axis] - report.scales.box_min[axis]) * to_steps[axis];
      put_u16(out + 2 * axis, static_cast<std::uint32_t>(std::clamp(steps + 0.5F, 0.0F, kPositionSteps)));
      out[10 + axis] = pack_scale(particle.semi_axes[axis], inverse_spacing);
    }
    put_u32(out + 6, pack_quaternion(particle.orientation));
    std::uint32_t velocity = 0;
    for (int axis = 0; axis < 3; ++axis)
      velocity = velocity << 10 | quantize_signed(particle.velocity[axis] * inverse_speed);
    put_u32(out + 13, velocity);
    out[17] = particle.phase;
    out[18] = particle.foam;
    out[19] = particle.spray;
    out += kRecordBytes;
    ++report.packed;
  }
  records.resize(report.packed * kRecordBytes);
  return report;
}

bool unpack_particles(std::span<const std::uint8_t> records, const PackingScales& scales,
                      std::vector<SurfaceParticle>& particles) {
  particles.clear();
  if (records.size() % kRecordBytes != 0 || !are_plausible(scales)) return false;
  const std::array<float, 256>& lengths = scale_table();
  const Eigen::Vector3f step = scales.box_size / kPositionSteps;
  particles.resize(records.size() / kRecordBytes);
  const std::uint8_t* in = records.data();
  for (SurfaceParticle& particle : particles) {
    std::uint32_t velocity = get_u32(in + 13);
    for (int axis = 2; axis >= 0; --axis) {
      particle.position[axis] = scales.box_min[axis] + step[axis] * static_cast<float>(get_u16(in + 2 * axis));
      particle.semi_axes[axis] = scales.particle_spacing * lengths[in[10 + axis]];
      particle.velocity[axis] = scales.largest_speed * std::clamp(dequantize_signed(velocity), -1.0F, 1.0F);
      velocity >>= 10;
    }
    particle.orientation = unpack_quaternion(get_u32(in + 6));
    particle.phase = in[17];
    particle.foam = in[18];
    particle.spray = in[19];
    in += kRecordBytes;
  }
  return true;
}

}  // namespace pelagos
