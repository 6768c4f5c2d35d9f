#include "packing/particle_codec.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace pelagos {
namespace {

constexpr float kPositionSteps = 65535.0F;
constexpr int kSignedHalf = 511;  // 10 bit fields hold 0..1022; 511 is exactly zero
constexpr float kSqrtHalf = 0.70710678118654752F;
constexpr float kScaleSteps = 32.0F;  // for each doubling
constexpr int kScaleZero = 128;

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
  constexpr float kStep = 1.0F / kSignedHalf;
  return static_cast<float>(static_cast<int>(bits & 0x3FFU) - kSignedHalf) * kStep;
}

/// For each largest component the other three, in the order x, y, z, w.
constexpr int kOthers[4][3] = {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}};

std::uint32_t pack_quaternion(const Eigen::Quaternionf& orientation) {
  const float* q = orientation.coeffs().data();  // x, y, z, w
  const int first = std::abs(q[1]) > std::abs(q[0]) ? 1 : 0;
  const int second = std::abs(q[3]) > std::abs(q[2]) ? 3 : 2;
  const int largest = std::abs(q[second]) > std::abs(q[first]) ? second : first;
  const float inverse_length = 1.0F / std::sqrt(orientation.squaredNorm());
  const float scale = std::copysign(inverse_length / kSqrtHalf, q[largest]);
  const int* others = kOthers[largest];
  return static_cast<std::uint32_t>(largest) << 30 | quantize_signed(q[others[0]] * scale) << 20 |
         quantize_signed(q[others[1]] * scale) << 10 | quantize_signed(q[others[2]] * scale);
}

Eigen::Quaternionf unpack_quaternion(std::uint32_t bits) {
  const std::uint32_t largest = bits >> 30;
  const float a = dequantize_signed(bits >> 20) * kSqrtHalf;
  const float b = dequantize_signed(bits >> 10) * kSqrtHalf;
  const float c = dequantize_signed(bits) * kSqrtHalf;
  const float rest = 1.0F - (a * a + b * b + c * c);
  float q[4];
  q[kOthers[largest][0]] = a;
  q[kOthers[largest][1]] = b;
  q[kOthers[largest][2]] = c;
  q[largest] = std::sqrt(std::max(0.0F, rest));
  Eigen::Quaternionf result(q[3], q[0], q[1], q[2]);
  if (rest < 0.0F) result.normalize();  // rounding, or a hostile sender
  return result;
}

/// log2 in steps of 1/32, rounded to the nearest, by table. A 256th of an octave's mantissas holds at most one of the
/// 32 places where the rounding goes up by one.
struct LogTable {
  struct Cell {
    std::uint32_t step_at = 0;  ///< mantissa bits from which on the result is one more
    std::int32_t steps = 0;     ///< at the cell's lower end
  };
  std::array<Cell, 256> cells{};

  LogTable() {
    int next = 0;
    for (std::uint32_t i = 0; i < cells.size(); ++i) {
      const auto threshold =
          static_cast<std::uint32_t>(std::ceil((std::exp2((next + 0.5) / kScaleSteps) - 1.0) * 0x1p23));
      const bool inside = next < static_cast<int>(kScaleSteps) && threshold >> 15 == i;
      cells[i] = {inside ? threshold : 0x800000U, next};
      if (inside) ++next;
    }
  }

  /// For value > 0; infinity gives something above all finite ones.
  [[nodiscard]] int steps(float value) const {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t mantissa = bits & 0x7FFFFFU;
    const Cell& cell = cells[mantissa >> 15];
    const int octave = static_cast<int>(bits >> 23) - 127;
    return octave * static_cast<int>(kScaleSteps) + cell.steps + (mantissa >= cell.step_at ? 1 : 0);
  }
};

const LogTable& log_table() {
  static const LogTable table;
  return table;
}

/// Lengths for each octet, in spacings.
const std::array<float, 256>& scale_table() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = std::exp2(static_cast<float>(static_cast<int>(i) - kScaleZero) / kScaleSteps);
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

/// Counts those that are not fit.
PackingScales find_scales(std::span<const SurfaceParticle> particles, std::uint32_t& refused) {
  constexpr float kFar = 2.0F * kLargestPackedMagnitude;
  Eigen::Vector3f low = Eigen::Vector3f::Constant(kFar);
  Eigen::Vector3f high = -low;
  float speed_squared = 0.0F;
  for (const SurfaceParticle& particle : particles) {
    if (!is_fit(particle)) {
      ++refused;
      continue;
    }
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

/// Turns particles into records, for one frame's scales.
class Quantizer {
 public:
  explicit Quantizer(const PackingScales& scales)
      : low_(scales.box_min),
        to_steps_(scales.box_size.unaryExpr(&inverse_or_zero) * kPositionSteps),
        inverse_speed_(inverse_or_zero(scales.largest_speed)),
        inverse_spacing_(inverse_or_zero(scales.particle_spacing)),
        logs_(log_table()) {}

  /// Five words at `out`: see the table in idl/pelagos.idl for what lies where.
  void put(const SurfaceParticle& particle, std::uint8_t* out) const {
    const std::uint32_t rotation = pack_quaternion(particle.orientation);
    const std::uint32_t velocity = speed(particle, 0) << 20 | speed(particle, 1) << 10 | speed(particle, 2);
    put_u32(out, place(particle, 0) | place(particle, 1) << 16);
    put_u32(out + 4, place(particle, 2) | rotation << 16);
    put_u32(out + 8, rotation >> 16 | size(particle, 0) << 16 | size(particle, 1) << 24);
    put_u32(out + 12, size(particle, 2) | velocity << 8);
    put_u32(out + 16, velocity >> 24 | std::uint32_t{particle.phase} << 8 | std::uint32_t{particle.foam} << 16 |
                          std::uint32_t{particle.spray} << 24);
  }

 private:
  std::uint32_t place(const SurfaceParticle& particle, int axis) const {
    const float steps = (particle.position[axis] - low_[axis]) * to_steps_[axis];
    return static_cast<std::uint32_t>(std::clamp(steps + 0.5F, 0.0F, kPositionSteps));
  }
  std::uint32_t speed(const SurfaceParticle& particle, int axis) const {
    return quantize_signed(particle.velocity[axis] * inverse_speed_);
  }
  std::uint32_t size(const SurfaceParticle& particle, int axis) const {
    const int steps = logs_.steps(particle.semi_axes[axis] * inverse_spacing_);
    return static_cast<std::uint32_t>(std::clamp(steps + kScaleZero, 0, 255));
  }

  Eigen::Vector3f low_;
  Eigen::Vector3f to_steps_;
  float inverse_speed_;
  float inverse_spacing_;
  const LogTable& logs_;
};

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
  report.scales = find_scales(particles, report.refused);
  report.scales.particle_spacing = particle_spacing;

  const Quantizer quantize(report.scales);
  records.resize(particles.size() * kRecordBytes);
  std::uint8_t* out = records.data();
  for (const SurfaceParticle& particle : particles) {
    if (report.refused > 0 && !is_fit(particle)) continue;
    quantize.put(particle, out);
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
