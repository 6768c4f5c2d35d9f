#include <atomic>
#include <limits>

#include "loopback.hpp"
#include "pelagos_dds/entities.hpp"
#include "wire/convert.hpp"
#include "wire/topics.hpp"

namespace pelagos {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A thick and a thin element, in the world of test_snapshot().
OilSnapshot test_oil() {
  OilSnapshot oil;
  oil.discs = {{1003.0F, -1995.0F, 1.5F, 2.5F, 2e-3F, 40.0F, 0.25F, OilAppearance::kContinuousTrue, true},
               {998.0F, -2000.0F, 1.25F, 0.75F, 1e-6F, 0.01F, 0.0F, OilAppearance::kRainbow, false}};
  return oil;
}

void expect_test_oil(const OceanSlick& slick) {
  EXPECT_EQ(slick.origin, Eigen::Vector3d(1000.0, -2000.0, 0.5));
  ASSERT_EQ(slick.discs.size(), 2U);
  const SlickDisc &thick = slick.discs[0], &thin = slick.discs[1];
  EXPECT_EQ(thick.x, 3.0F);
  EXPECT_EQ(thick.y, 5.0F);
  EXPECT_EQ(thick.z, 1.0F);
  EXPECT_EQ(thick.radius, 2.5F);
  EXPECT_EQ(thick.thickness, 2e-3F);
  EXPECT_EQ(thick.mass, 40.0F);
  EXPECT_EQ(thick.water, 0.25F);
  EXPECT_EQ(thick.appearance, OilAppearance::kContinuousTrue);
  EXPECT_TRUE(thick.contained);
  EXPECT_EQ(thin.x, -2.0F);
  EXPECT_EQ(thin.appearance, OilAppearance::kRainbow);
  EXPECT_FALSE(thin.contained);
}

/// Publisher and receiver of a scene with oil.
class SlickLoopback : public Loopback {
 protected:
  /// Publishes frames with `oil` until `done`; the first slicks go out before the reader has matched their writer.
  template <class Condition>
  [[nodiscard]] bool publish_until(const OilSnapshot& oil, Condition&& done) {
    return eventually([&] {
      auto snapshot = test_snapshot(*publisher_, frame_++, 10);
      snapshot->oil = oil;
      publisher_->submit(std::move(snapshot));
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      return done();
    });
  }

  std::uint64_t frame_ = 0;
};

TEST_F(SlickLoopback, SlickComesThrough) {
  start();
  ASSERT_TRUE(publish_until(test_oil(), [this] { return receiver_->slick() != nullptr; }));
  const std::shared_ptr<const OceanSlick> slick = receiver_->slick();
  EXPECT_LT(slick->frame, frame_);
  EXPECT_DOUBLE_EQ(slick->simulation_time, static_cast<double>(slick->frame) / 30.0);
  expect_test_oil(*slick);
  EXPECT_GE(receiver_->counters().slicks, 1U);
  EXPECT_EQ(receiver_->counters().slicks_refused, 0U);
}

TEST_F(SlickLoopback, NewestSlickIsKept) {
  start();
  ASSERT_TRUE(publish_until(test_oil(), [this] { return receiver_->slick() != nullptr; }));
  OilSnapshot gone = test_oil();
  gone.discs.clear();  // all of it has been skimmed
  EXPECT_TRUE(publish_until(gone, [this] { return receiver_->slick()->discs.empty(); }));
}

TEST_F(SlickLoopback, SceneWithoutOilHasNoSlick) {
  start();
  for (std::uint64_t frame = 0; frame < 5; ++frame) ASSERT_TRUE(pass(frame, 10));
  EXPECT_EQ(receiver_->slick(), nullptr);
  EXPECT_EQ(receiver_->counters().slicks, 0U);
}

TEST_F(SlickLoopback, SlickGoesWithItsServer) {
  start();
  ASSERT_TRUE(publish_until(test_oil(), [this] { return receiver_->slick() != nullptr; }));
  publisher_ = std::make_unique<FramePublisher>(participant_, test_scene());  // a server of a scene without oil
  std::uint64_t next = 0;
  EXPECT_TRUE(eventually([&] {  // it is followed once the old one has been silent for 2 s
    publisher_->submit(test_snapshot(*publisher_, next++, 10));
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return receiver_->slick() == nullptr;
  }));
}

/// A sample of test_oil() to spoil.
class SlickOnTheWire : public testing::Test {
 protected:
  SlickOnTheWire() : oil_(test_oil()) {
    snapshot_.frame = 3;
    snapshot_.simulation_time = 0.1;
    snapshot_.origin = {1000.0, -2000.0, 0.5};
    sample_ = std::make_unique<wire::OilSample>(snapshot_, oil_, 99);
    slick_ = sample_->slick();
    elements_.assign(slick_.elements._buffer, slick_.elements._buffer + slick_.elements._length);
    slick_.elements._buffer = elements_.data();
  }

  Snapshot snapshot_;
  OilSnapshot oil_;
  std::unique_ptr<wire::OilSample> sample_;
  pelagos_SlickV1 slick_{};
  std::vector<pelagos_SlickElementV1> elements_;
};

TEST_F(SlickOnTheWire, RoundTrip) {
  EXPECT_FALSE(wire::find_fault(slick_));
  OceanSlick back;
  back.origin = wire::from_wire(slick_.origin);
  for (const pelagos_SlickElementV1& element : elements_) back.discs.push_back(wire::from_wire(element));
  expect_test_oil(back);
}

TEST_F(SlickOnTheWire, EveryValueIsChecked) {
  const auto fault_with = [this](auto&& change) {
    const auto good = elements_;
    change(elements_[1]);
    const bool found = wire::find_fault(slick_).has_value();
    elements_ = good;
    return found;
  };
  for (const float bad : {kNaN, kInfinity, -kInfinity}) {
    EXPECT_TRUE(fault_with([&](auto& e) { e.position.x = bad; })) << bad;
    EXPECT_TRUE(fault_with([&](auto& e) { e.position.y = bad; })) << bad;
    EXPECT_TRUE(fault_with([&](auto& e) { e.position.z = bad; })) << bad;
    EXPECT_TRUE(fault_with([&](auto& e) { e.radius = bad; })) << bad;
    EXPECT_TRUE(fault_with([&](auto& e) { e.thickness = bad; })) << bad;
    EXPECT_TRUE(fault_with([&](auto& e) { e.mass = bad; })) << bad;
    EXPECT_TRUE(fault_with([&](auto& e) { e.water = bad; })) << bad;
  }
  EXPECT_TRUE(fault_with([](auto& e) { e.position.y = 2e6F; }));
  EXPECT_TRUE(fault_with([](auto& e) { e.radius = 0.0F; }));
  EXPECT_TRUE(fault_with([](auto& e) { e.radius = -1.0F; }));
  EXPECT_TRUE(fault_with([](auto& e) { e.radius = 1e9F; }));
  EXPECT_TRUE(fault_with([](auto& e) { e.thickness = -1e-6F; }));
  EXPECT_TRUE(fault_with([](auto& e) { e.thickness = 1e4F; }));
  EXPECT_TRUE(fault_with([](auto& e) { e.mass = -1.0F; }));
  EXPECT_TRUE(fault_with([](auto& e) { e.water = -0.01F; }));
  EXPECT_TRUE(fault_with([](auto& e) { e.water = 1.01F; }));
  EXPECT_TRUE(fault_with([](auto& e) { e.appearance = 6; }));
  EXPECT_FALSE(fault_with([](auto& e) { e.thickness = 0.0F; }));
  EXPECT_FALSE(fault_with([](auto& e) { e.water = 1.0F; }));
  EXPECT_FALSE(fault_with([](auto& e) { e.mass = 0.0F; }));
}

TEST_F(SlickOnTheWire, HeaderIsChecked) {
  pelagos_SlickV1 bad = slick_;
  bad.origin.y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(wire::find_fault(bad));
  bad = slick_;
  bad.simulation_time = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(wire::find_fault(bad));
}

TEST_F(SlickOnTheWire, ElementsAreBounded) {
  elements_.resize(200'001, elements_[0]);
  slick_.elements._buffer = elements_.data();
  slick_.elements._length = 200'000;
  EXPECT_FALSE(wire::find_fault(slick_));
  slick_.elements._length = 200'001;
  EXPECT_TRUE(wire::find_fault(slick_));
}

TEST_F(SlickOnTheWire, BadSlicksAreRefusedCountedAndLeaveTheLastOne) {
  std::atomic<int> lines{0};
  const auto participant = join_dds(test_settings());
  const DdsWriter writer(*participant, topics::slick());
  const FrameReceiver receiver(test_settings([&lines](std::string_view line) {
    if (line.find("slick refused") != std::string_view::npos) ++lines;
  }));
  ASSERT_TRUE(eventually([&] { return writer.matched_readers() == 1; }));
  ASSERT_TRUE(writer.write(&slick_));
  ASSERT_TRUE(eventually([&] { return receiver.slick() != nullptr; }));
  const std::shared_ptr<const OceanSlick> last = receiver.slick();
  elements_[1].radius = kNaN;
  constexpr std::uint64_t kBad = 50;
  for (std::uint64_t i = 1; i <= kBad; ++i) {
    ASSERT_TRUE(writer.write(&slick_));
    ASSERT_TRUE(eventually([&] { return receiver.counters().slicks_refused == i; }));
  }
  EXPECT_EQ(receiver.slick(), last);
  EXPECT_EQ(receiver.counters().slicks, 1U);
  EXPECT_GE(lines, 1);
  EXPECT_LE(lines, 10) << "five lines in 10 s";
  elements_[1].radius = 1.0F;
  ASSERT_TRUE(writer.write(&slick_));
  EXPECT_TRUE(eventually([&] { return receiver.slick() != last; })) << "a good slick after the bad ones";
}

TEST_F(SlickOnTheWire, SlickOfASecondServerIsIgnored) {
  const auto participant = join_dds(test_settings());
  const DdsWriter writer(*participant, topics::slick());
  const FrameReceiver receiver(test_settings());
  ASSERT_TRUE(eventually([&] { return writer.matched_readers() == 1; }));
  ASSERT_TRUE(writer.write(&slick_));
  ASSERT_TRUE(eventually([&] { return receiver.slick() != nullptr; }));
  const std::shared_ptr<const OceanSlick> last = receiver.slick();
  pelagos_SlickV1 other = slick_;
  other.source = 98;
  ASSERT_TRUE(writer.write(&other));
  // Of one writer samples come in order: once two more rounds have been refused, this one has been looked at.
  slick_.simulation_time = std::numeric_limits<double>::quiet_NaN();
  for (std::uint64_t refused = 1; refused <= 2; ++refused) {
    ASSERT_TRUE(writer.write(&slick_));
    ASSERT_TRUE(eventually([&] { return receiver.counters().slicks_refused == refused; }));
  }
  EXPECT_EQ(receiver.slick(), last);
}

}  // namespace
}  // namespace pelagos
