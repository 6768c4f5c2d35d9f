// The oil on the wire: what the samples of a frame say, and that every number arrives.

#include <gtest/gtest.h>

#include "loopback.hpp"
#include "pelagos_dds/entities.hpp"
#include "wire/convert.hpp"
#include "wire/topics.hpp"

namespace pelagos {
namespace {

/// Masses beyond 2^53 mg, which no double holds to the milligram; the sum closes.
OilBudget some_budget() {
  OilBudget budget;
  budget.ledger.afloat = 9'007'199'254'740'993;
  budget.ledger.contained = 1'000'000'000'000'007;
  budget.ledger.submerged = 3'000'000'001;
  budget.ledger.recovered = 20'000'000'000'003;
  budget.ledger.evaporated = 5;
  budget.ledger.left_patch = 7;
  budget.ledger.released = 9'007'199'254'740'993 + 1'000'000'000'000'007 + 3'000'000'001 + 20'000'000'000'003 + 5 + 7;
  budget.particles = 77;
  budget.elements = 2;
  budget.area = 1234.5;
  budget.mean_thickness = 2.5e-4;
  budget.largest_thickness = 0.0125;
  budget.emulsion_water = 0.75;
  budget.displaced_water = 1025.0;
  budget.held_back = 33.25;
  budget.skimmers = {{"rig", 20'000'000'000'003, 18.5, false}, {"spare", 0, 0.0, true}};
  return budget;
}

OilSnapshot some_oil() {
  return {some_budget(),
          {{1003.5F, -1998.0F, 0.75F, 2.5F, 1e-3F, 17.0F, 0.25F, OilAppearance::kContinuousTrue, true},
           {990.0F, -2001.5F, 0.5F, 0.125F, 1e-6F, 0.5F, 0.0F, OilAppearance::kRainbow, false}}};
}

void expect_budget(const pelagos_OilBudgetV1& wire, const OilBudget& sent) {
  EXPECT_EQ(wire.released_mg, sent.ledger.released);
  EXPECT_EQ(wire.afloat_mg, sent.ledger.afloat);
  EXPECT_EQ(wire.contained_mg, sent.ledger.contained);
  EXPECT_EQ(wire.submerged_mg, sent.ledger.submerged);
  EXPECT_EQ(wire.recovered_mg, sent.ledger.recovered);
  EXPECT_EQ(wire.evaporated_mg, sent.ledger.evaporated);
  EXPECT_EQ(wire.left_patch_mg, sent.ledger.left_patch);
  EXPECT_EQ(wire.released_mg, wire.afloat_mg + wire.contained_mg + wire.submerged_mg + wire.recovered_mg +
                                  wire.evaporated_mg + wire.left_patch_mg)
      << "to the milligram";
  EXPECT_EQ(wire.particles, sent.particles);
  EXPECT_EQ(wire.elements, sent.elements);
  EXPECT_EQ(wire.area, sent.area);
  EXPECT_EQ(wire.mean_thickness, sent.mean_thickness);
  EXPECT_EQ(wire.largest_thickness, sent.largest_thickness);
  EXPECT_EQ(wire.emulsion_water, sent.emulsion_water);
  EXPECT_EQ(wire.displaced_water, sent.displaced_water);
  EXPECT_EQ(wire.held_back, sent.held_back);
  ASSERT_EQ(wire.skimmers._length, 2U);
  EXPECT_STREQ(wire.skimmers._buffer[0].name, "rig");
  EXPECT_EQ(wire.skimmers._buffer[0].recovered_mg, sent.skimmers[0].recovered);
  EXPECT_EQ(wire.skimmers._buffer[0].present_rate, 18.5);
  EXPECT_FALSE(wire.skimmers._buffer[0].dry);
  EXPECT_STREQ(wire.skimmers._buffer[1].name, "spare");
  EXPECT_TRUE(wire.skimmers._buffer[1].dry);
}

/// Places are told relative to the origin that the same sample carries.
void expect_slick(const pelagos_SlickV1& wire) {
  EXPECT_EQ(wire.origin.x, 1000.0);
  EXPECT_EQ(wire.origin.y, -2000.0);
  EXPECT_EQ(wire.origin.z, 0.5);
  ASSERT_EQ(wire.elements._length, 2U);
  const pelagos_SlickElementV1 &thick = wire.elements._buffer[0], &thin = wire.elements._buffer[1];
  EXPECT_EQ(thick.position.x, 3.5F);
  EXPECT_EQ(thick.position.y, 2.0F);
  EXPECT_EQ(thick.position.z, 0.25F);
  EXPECT_EQ(thick.radius, 2.5F);
  EXPECT_EQ(thick.thickness, 1e-3F);
  EXPECT_EQ(thick.mass, 17.0F);
  EXPECT_EQ(thick.water, 0.25F);
  EXPECT_EQ(thick.appearance, 5);
  EXPECT_TRUE(thick.contained);
  EXPECT_EQ(thin.position.x, -10.0F);
  EXPECT_EQ(thin.position.y, -1.5F);
  EXPECT_EQ(thin.appearance, 2);
  EXPECT_FALSE(thin.contained);
}

TEST(OilSample, HoldsEveryValueInTheUnitsOfTheContract) {
  Snapshot snapshot;
  snapshot.frame = 12;
  snapshot.simulation_time = 0.4;
  snapshot.origin = {1000.0, -2000.0, 0.5};
  const OilSnapshot oil = some_oil();
  const wire::OilSample sample(snapshot, oil, 17);
  for (const auto source : {sample.slick().source, sample.budget().source}) EXPECT_EQ(source, 17U);
  for (const auto frame : {sample.slick().frame, sample.budget().frame}) EXPECT_EQ(frame, 12U);
  for (const double time : {sample.slick().simulation_time, sample.budget().simulation_time}) EXPECT_EQ(time, 0.4);
  expect_slick(sample.slick());
  expect_budget(sample.budget(), oil.budget);
}

TEST(OilSample, OfNoOilYetIsEmpty) {
  const OilSnapshot none;
  const wire::OilSample sample({}, none, 17);
  EXPECT_EQ(sample.slick().elements._length, 0U);
  EXPECT_EQ(sample.budget().skimmers._length, 0U);
  EXPECT_EQ(sample.budget().released_mg, 0);
}

TEST_F(Loopback, TheOilOfAFrameIsReadByAnyone) {
  start();
  const DdsReader slicks(*participant_, topics::slick()), budgets(*participant_, topics::oil_budget());
  int slicks_heard = 0, budgets_heard = 0;
  std::uint64_t frame = 0;
  ASSERT_TRUE(eventually([&] {
    auto snapshot = test_snapshot(*publisher_, ++frame, 10);
    snapshot->oil.emplace(some_oil());
    publisher_->submit(std::move(snapshot));
    slicks.take_all<pelagos_SlickV1>([&](const pelagos_SlickV1& sample) {
      if (slicks_heard++ == 0) expect_slick(sample);
    });
    budgets.take_all<pelagos_OilBudgetV1>([&](const pelagos_OilBudgetV1& sample) {
      if (budgets_heard++ == 0) expect_budget(sample, some_budget());
    });
    return slicks_heard > 0 && budgets_heard > 0;
  }));
}

TEST_F(Loopback, AReaderThatComesLateGetsTheLastLedger) {
  start();
  auto snapshot = test_snapshot(*publisher_, 1, 10);
  snapshot->oil.emplace(some_oil());
  publisher_->submit(std::move(snapshot));
  const DdsReader early(*participant_, topics::oil_budget());
  const auto heard = [](const DdsReader& reader) {
    bool any = false;
    reader.take_all<pelagos_OilBudgetV1>([&](const pelagos_OilBudgetV1&) { any = true; });
    return any;
  };
  ASSERT_TRUE(eventually([&] { return heard(early); }));
  const DdsReader late(*participant_, topics::oil_budget());
  EXPECT_TRUE(eventually([&] { return heard(late); })) << "nothing was written after it came";
}

}  // namespace
}  // namespace pelagos
