#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "packing/particle_codec.hpp"

namespace pelagos {
namespace {

constexpr float kSpacing = 0.5F;
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

std::vector<SurfaceParticle> random_particles(std::size_t count, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
  std::normal_distribution<float> normal;
  std::uniform_int_distribution<int> octet(0, 255);
  std::vector<SurfaceParticle> particles(count);
  for (SurfaceParticle& particle : particles) {
    particle.position = {20.0F * unit(generator), 7.0F * unit(generator), 1.5F * unit(generator)};
    particle.orientation =
        Eigen::Quaternionf(normal(generator), normal(generator), normal(generator), normal(generator)).normalized();
    const float longest = kSpacing * std::exp2(2.0F * unit(generator));
    particle.semi_axes = {longest, 0.7F * longest, 0.3F * longest};
    particle.velocity = 6.0F * Eigen::Vector3f(unit(generator), unit(generator), unit(generator));
    particle.phase = static_cast<std::uint8_t>(octet(generator));
    particle.foam = static_cast<std::uint8_t>(octet(generator));
    particle.spray = static_cast<std::uint8_t>(octet(generator));
  }
  return particles;
}

std::vector<SurfaceParticle> round_trip(const std::vector<SurfaceParticle>& particles, PackReport* report = nullptr) {
  std::vector<std::uint8_t> records;
  const PackReport packed = pack_particles(particles, kSpacing, records);
  if (report != nullptr) *report = packed;
  std::vector<SurfaceParticle> result;
  EXPECT_TRUE(unpack_particles(records, packed.scales, result));
  return result;
}

TEST(ParticleCodec, RoundTripStaysWithinTheStatedErrors) {
  const auto sent = random_particles(20000, 7);
  PackReport report;
  const auto received = round_trip(sent, &report);
  ASSERT_EQ(received.size(), sent.size());
  EXPECT_EQ(report.refused, 0U);
  float angle = 0.0F;
  for (std::size_t i = 0; i < sent.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      // Half a step, and the rounding of float32 at coordinates of up to 40 m (4e-6 m).
      EXPECT_NEAR(received[i].position[axis], sent[i].position[axis], report.scales.box_size[axis] / 131070.0F + 8e-6F);
      // Half a step, and as above.
      EXPECT_NEAR(received[i].velocity[axis], sent[i].velocity[axis], report.scales.largest_speed / 1022.0F + 2e-6F);
      // Half a step of 2^(1/32) is 1.09 %.
      EXPECT_NEAR(received[i].semi_axes[axis] / sent[i].semi_axes[axis], 1.0F, 0.011F);
    }
    EXPECT_NEAR(received[i].orientation.norm(), 1.0F, 1e-6F);
    angle = std::max(angle, received[i].orientation.angularDistance(sent[i].orientation));
    EXPECT_EQ(received[i].phase, sent[i].phase);
    EXPECT_EQ(received[i].foam, sent[i].foam);
    EXPECT_EQ(received[i].spray, sent[i].spray);
  }
  RecordProperty("largest_angle_urad", static_cast<int>(angle * 1e6F));
  // The bound in the interface. float32's own angularDistance is good to 1e-3 of that.
  EXPECT_LT(angle, 0.0048F);
}

TEST(ParticleCodec, WorstQuaternionStaysWithinTheStatedError) {
  // All four components equal is where the one left out is least well determined by the other three.
  std::vector<SurfaceParticle> sent;
  std::mt19937 generator(3);
  std::normal_distribution<float> small(0.0F, 0.002F);
  for (int i = 0; i < 20000; ++i) {
    SurfaceParticle particle;
    const auto component = [&](int bit) { return ((i >> bit) % 2 == 0 ? 0.5F : -0.5F) + small(generator); };
    particle.orientation = Eigen::Quaternionf(component(0), component(1), component(2), component(3)).normalized();
    sent.push_back(particle);
  }
  const auto received = round_trip(sent);
  float angle = 0.0F;
  for (std::size_t i = 0; i < sent.size(); ++i) {
    angle = std::max(angle, received[i].orientation.angularDistance(sent[i].orientation));
  }
  RecordProperty("largest_angle_urad", static_cast<int>(angle * 1e6F));
  EXPECT_LT(angle, 0.0048F);
}

TEST(ParticleCodec, RecordHasTheDocumentedLayout) {
  SurfaceParticle low;  // at the lower corner of the box, so that the second one spans it
  low.position = {-1.0F, 0.0F, 2.0F};
  low.semi_axes.setConstant(kSpacing);
  SurfaceParticle high = low;
  high.position = {1.0F, 8.0F, 4.0F};
  high.velocity = {0.0F, -3.0F, 0.0F};
  high.semi_axes = {2.0F * kSpacing, kSpacing, 0.5F * kSpacing};
  high.phase = 1;
  high.foam = 200;
  high.spray = 3;
  std::vector<std::uint8_t> records;
  const PackReport report = pack_particles(std::vector{low, high}, kSpacing, records);
  ASSERT_EQ(report.packed, 2U);
  ASSERT_EQ(records.size(), 2 * kRecordBytes);
  EXPECT_FLOAT_EQ(report.scales.largest_speed, 3.0F);
  const std::vector<std::uint8_t> second(records.begin() + kRecordBytes, records.end());
  // w (3) is the largest, x = y = z = 0 are 511 each: 3<<30 | 511<<20 | 511<<10 | 511 = 0xDFF7FDFF.
  // Velocity 511, 0, 511: 511<<20 | 511 = 0x1FF001FF. Both little-endian.
  const std::vector<std::uint8_t> expected = {0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFD, 0xF7, 0xDF,
                                              160,  128,  96,   0xFF, 0x01, 0xF0, 0x1F, 1,    200,  3};
  EXPECT_EQ(second, expected);
}

TEST(ParticleCodec, DegenerateFramesComeThrough) {
  EXPECT_TRUE(round_trip({}).empty());

  SurfaceParticle still;
  still.position = {3.0F, -2.0F, 0.25F};
  const auto flat = round_trip({still, still, still});  // no extent, no speed
  ASSERT_EQ(flat.size(), 3U);
  for (const SurfaceParticle& particle : flat) {
    EXPECT_EQ(particle.position, still.position);
    EXPECT_EQ(particle.velocity, Eigen::Vector3f::Zero());
    EXPECT_LT(particle.orientation.angularDistance(still.orientation), 1e-6F);
  }

  SurfaceParticle moved = still;  // an extent and speed so small that their inverses overflow
  moved.position.x() = std::nextafter(still.position.x(), 4.0F);
  moved.velocity.x() = std::numeric_limits<float>::denorm_min();
  EXPECT_EQ(round_trip({still, moved}).size(), 2U);
}

TEST(ParticleCodec, ExtremeSemiAxesAreClamped) {
  SurfaceParticle particle;
  particle.semi_axes = {1e5F, kSpacing, 1e-20F};
  const auto received = round_trip({particle});
  ASSERT_EQ(received.size(), 1U);
  EXPECT_NEAR(received[0].semi_axes.x(), kSpacing * 15.65F, kSpacing * 0.01F);
  EXPECT_NEAR(received[0].semi_axes.z(), kSpacing / 16.0F, 1e-6F);
}

TEST(ParticleCodec, UnfitParticlesAreLeftOutAndCounted) {
  auto particles = random_particles(10, 11);
  particles[1].position.y() = kNaN;
  particles[3].velocity.z() = kInfinity;
  particles[4].orientation.coeffs().setZero();
  particles[5].orientation.w() = kNaN;
  particles[6].semi_axes.x() = -1.0F;
  particles[7].position.x() = 2e6F;
  PackReport report;
  const auto received = round_trip(particles, &report);
  EXPECT_EQ(report.refused, 6U);
  ASSERT_EQ(received.size(), 4U);
  EXPECT_NEAR(received[1].position.x(), particles[2].position.x(), 1e-3F);  // order is kept; a step is 0.6 mm
  for (const SurfaceParticle& particle : received) EXPECT_TRUE(particle.position.allFinite());
}

TEST(ParticleCodec, BadSpacingRefusesAll) {
  std::vector<std::uint8_t> records;
  for (const float spacing : {0.0F, -1.0F, kNaN, kInfinity}) {
    const PackReport report = pack_particles(random_particles(5, 1), spacing, records);
    EXPECT_EQ(report.packed, 0U);
    EXPECT_EQ(report.refused, 5U);
    EXPECT_TRUE(records.empty());
  }
}

TEST(ParticleCodec, UnpackRefusesWrongSizesAndScales) {
  std::vector<std::uint8_t> records;
  const PackReport report = pack_particles(random_particles(5, 1), kSpacing, records);
  std::vector<SurfaceParticle> result;
  for (const std::size_t size : {records.size() - 1, records.size() + 1, std::size_t{1}}) {
    std::vector<std::uint8_t> wrong(size);
    EXPECT_FALSE(unpack_particles(wrong, report.scales, result)) << size;
    EXPECT_TRUE(result.empty());
  }
  std::vector<PackingScales> bad(7, report.scales);
  bad[0].box_min.x() = kNaN;
  bad[1].box_size.y() = -1.0F;
  bad[2].box_size.z() = kInfinity;
  bad[3].largest_speed = kNaN;
  bad[4].largest_speed = -1.0F;
  bad[5].particle_spacing = 0.0F;
  bad[6].particle_spacing = kInfinity;
  for (const PackingScales& scales : bad) EXPECT_FALSE(unpack_particles(records, scales, result));
}

TEST(ParticleCodec, EveryRandomRecordDecodesToSomethingFinite) {
  std::mt19937 generator(5);
  std::vector<std::uint8_t> records(2000 * kRecordBytes);
  for (std::uint8_t& octet : records) octet = static_cast<std::uint8_t>(generator());
  PackingScales scales;
  scales.box_size = {10.0F, 10.0F, 10.0F};
  scales.largest_speed = 5.0F;
  scales.particle_spacing = kSpacing;
  std::vector<SurfaceParticle> result;
  ASSERT_TRUE(unpack_particles(records, scales, result));
  for (const SurfaceParticle& particle : result) {
    EXPECT_TRUE(particle.position.allFinite());
    EXPECT_TRUE(particle.semi_axes.minCoeff() > 0.0F);
    EXPECT_NEAR(particle.orientation.norm(), 1.0F, 1e-5F);  // float32 rounding
    EXPECT_LE(particle.velocity.cwiseAbs().maxCoeff(), scales.largest_speed);
  }
}

}  // namespace
}  // namespace pelagos
