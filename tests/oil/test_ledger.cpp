#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "slick_fixture.hpp"

namespace pelagos {
namespace {

SlickSettings busy_settings() {
  SlickSettings settings;
  settings.most_elements = 120;
  settings.largest_radius = 6.0;
  settings.patch = SlickPatch{{-60.0, -60.0}, {60.0, 60.0}};
  settings.exchange = ParticleExchange{0.02, 0.37};
  return settings;
}

/// One operation of a random kind; refusals are among them.
class RandomHandler {
 public:
  explicit RandomHandler(unsigned seed) : random_(seed) {}

  void operate(SlickLayer& layer) {
    const Eigen::Vector2d place{number(-40.0, 40.0), number(-40.0, 40.0)};
    switch (random_() % 10) {
      case 0:
        (void)layer.release(number(0.0, 5.0), place, number(0.05, 2.0));
        break;
      case 1:
        (void)layer.release_submerged(number(0.0, 5.0));
        break;
      case 2:
        (void)layer.take(number(0.0, 3.0), place, number(0.05, 2.0));
        break;
      case 3:
        (void)layer.drop_submerged(number(0.0, 1.0));
        break;
      case 4:
        (void)layer.give_back();
        break;
      case 5:
        (void)layer.set_skimmer("s" + std::to_string(random_() % 2), {place, number(-1.0, 5.0), 50.0});
        break;
      case 6:
        if (random_() % 20 == 0)
          (void)layer.set_boom("b" + std::to_string(random_() % 2),
                               {{place, place + Eigen::Vector2d(number(-20.0, 20.0), 10.0)}, 0.5, 0.2, 1.0});
        break;
      case 7:
        if (random_() % 20 == 0) layer.remove_boom("b" + std::to_string(random_() % 2));
        break;
      default:
        layer.advance(number(0.0, 2.0), PlacedSurroundings(moving({number(-1.0, 1.0), number(-1.0, 1.0)},
                                                                  {number(-15.0, 15.0), number(-15.0, 15.0)})));
    }
  }

 private:
  double number(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 8) / 0x1000000;
  }
  std::mt19937 random_;
};

TEST(Ledger, BalancesToTheMilligramAfterEachOfAHundredThousandOperations) {
  SlickLayer layer(busy_settings());
  RandomHandler handler(7);
  for (int i = 0; i < 100000; ++i) {
    handler.operate(layer);
    const OilLedger ledger = layer.ledger();
    ASSERT_EQ(ledger.balance(), 0) << "after operation " << i;
    ASSERT_GE(ledger.submerged, 0);
    ASSERT_LE(layer.elements().size(), 120u + 40u);  // leaks surface between steps
  }
  const OilLedger ledger = layer.ledger();
  for (const Milligrams part :
       {ledger.afloat, ledger.submerged, ledger.recovered, ledger.evaporated, ledger.left_patch})
    EXPECT_GT(part, 0);  // all of it was tried
  for (const SlickElement& e : layer.elements()) {
    EXPECT_GT(e.mass, 0);
    EXPECT_TRUE(e.position.allFinite() && std::isfinite(e.size) && std::isfinite(e.film));
  }
}

TEST(Ledger, TheSameOperationsGiveTheSameBits) {
  SlickLayer a(busy_settings()), b(busy_settings());
  RandomHandler handle_a(3), handle_b(3);
  for (int i = 0; i < 3000; ++i) handle_a.operate(a), handle_b.operate(b);
  ASSERT_EQ(a.elements().size(), b.elements().size());
  for (std::size_t i = 0; i < a.elements().size(); ++i) {
    EXPECT_EQ(a.elements()[i].position, b.elements()[i].position);
    EXPECT_EQ(a.elements()[i].size, b.elements()[i].size);
    EXPECT_EQ(a.elements()[i].mass, b.elements()[i].mass);
  }
}

TEST(Ledger, AStateTakenUpAgainGoesOnAlike) {
  SlickLayer first(busy_settings()), second(busy_settings());
  RandomHandler handler(5);
  for (int i = 0; i < 2000; ++i) handler.operate(first);
  second.restore(first.state());
  RandomHandler next_a(9), next_b(9);
  for (int i = 0; i < 500; ++i) next_a.operate(first), next_b.operate(second);
  EXPECT_EQ(first.ledger(), second.ledger());
  ASSERT_EQ(first.elements().size(), second.elements().size());
  for (std::size_t i = 0; i < first.elements().size(); ++i)
    EXPECT_EQ(first.elements()[i].position, second.elements()[i].position);
}

TEST(Exchange, TakesOilFromTheParticles) {
  SlickLayer layer(plain_settings());
  ASSERT_FALSE(layer.release_submerged(10.0));
  ASSERT_FALSE(layer.take(4.0, {1.0, 2.0}, 0.5));
  EXPECT_EQ(layer.ledger().submerged, to_milligrams(6.0));
  EXPECT_EQ(layer.ledger().afloat, to_milligrams(4.0));
  EXPECT_EQ(text_of(layer.take(7.0, {0.0, 0.0}, 0.5)), "mass: 7; allowed: at most the 6 kg that are submerged");
  ASSERT_FALSE(layer.drop_submerged(6.0));
  EXPECT_EQ(layer.ledger().left_patch, to_milligrams(6.0));
  EXPECT_EQ(layer.ledger().balance(), 0);
}

TEST(Exchange, GivesBackWholeParticlesWhereItIsThick) {
  SlickSettings settings = plain_settings();
  settings.exchange = ParticleExchange{0.01, 2.0};
  SlickLayer layer(settings);
  ASSERT_FALSE(layer.release(100.0, {5.0, 0.0}, 1.0));  // 3.6 cm of oil
  ASSERT_FALSE(layer.release(1.0, {500.0, 0.0}, 1.0));  // 0.4 mm: stays
  const auto returned = layer.give_back();
  ASSERT_EQ(returned.size(), 1u);
  const double film = 100.0 / settings.oil.density / std::numbers::pi;
  EXPECT_EQ(returned[0].particles, static_cast<std::size_t>(100.0 * (1.0 - 0.01 / film) / 2.0));
  EXPECT_EQ(returned[0].mass, 2.0 * static_cast<double>(returned[0].particles));
  EXPECT_NEAR((returned[0].position - Eigen::Vector2d(5.0, 0.0)).norm(), 0.0, 1e-9);
  EXPECT_EQ(layer.ledger().submerged, to_milligrams(returned[0].mass));
  EXPECT_EQ(layer.ledger().balance(), 0);
  EXPECT_TRUE(layer.give_back().empty());  // what is left fills no particle
}

TEST(Exchange, APileOfSmallElementsCountsAsOne) {
  SlickSettings settings = plain_settings();
  settings.exchange = ParticleExchange{0.01, 2.0};
  SlickLayer layer(settings);
  release_disc(layer, 100.0, {0.0, 0.0}, 1.0, 100);  // 1 kg each: none would fill a particle
  double mass = 0.0;
  for (const ReturnedOil& oil : layer.give_back()) mass += oil.mass;
  EXPECT_GT(mass, 30.0);
  EXPECT_EQ(layer.ledger().balance(), 0);
}

TEST(Exchange, NothingComesBackWithoutAnExchange) {
  SlickLayer layer(plain_settings());
  ASSERT_FALSE(layer.release(1e6, {0.0, 0.0}, 1.0));
  EXPECT_TRUE(layer.give_back().empty());
}

TEST(Resampling, KeepsTheNumberOfElementsWithinItsBound) {
  SlickSettings settings = plain_settings();
  settings.most_elements = 50;
  SlickLayer layer(settings);
  double mass = 0.0;
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector2d place(7.0 * (i % 23), 11.0 * (i % 17));
    ASSERT_FALSE(layer.release(1.0 + i % 3, place, 0.5));
    ASSERT_LE(layer.elements().size(), 50u);
    mass += 1.0 + i % 3;
    moment += (1.0 + i % 3) * place;
  }
  EXPECT_EQ(layer.ledger().afloat, to_milligrams(mass));
  EXPECT_NEAR((centre_of_mass(layer) - moment / mass).norm(), 0.0, 1e-6);
}

TEST(Resampling, OneElementCanBeAll) {
  SlickSettings settings = plain_settings();
  settings.most_elements = 1;
  settings.largest_radius = 0.1;
  SlickLayer layer(settings);
  for (int i = 0; i < 10; ++i) ASSERT_FALSE(layer.release(1.0, {1e4 * i, 0.0}, 0.5));
  run(layer, PlacedSurroundings(), 10.0, 1.0);
  EXPECT_EQ(layer.elements().size(), 1u);
  EXPECT_EQ(layer.ledger().afloat, to_milligrams(10.0));
}

TEST(Resampling, SplitsUnevenMassesExactly) {
  SlickSettings settings = plain_settings();
  settings.largest_radius = 0.5;
  SlickLayer layer(settings);
  ASSERT_FALSE(layer.release(7e-6, {0.0, 0.0}, 0.6));  // 7 mg in four
  layer.advance(0.1, PlacedSurroundings());
  ASSERT_EQ(layer.elements().size(), 4u);
  EXPECT_EQ(layer.ledger().afloat, 7);
}

TEST(Resampling, MergesElementsThatCoverEachOther) {
  SlickLayer layer(plain_settings());
  for (int i = 0; i < 8; ++i) ASSERT_FALSE(layer.release(1.0, {0.01 * i, 0.0}, 1.0));
  run(layer, PlacedSurroundings(), 2.0, 0.1);
  EXPECT_LE(layer.elements().size(), 2u);
  EXPECT_EQ(layer.ledger().afloat, to_milligrams(8.0));
}

}  // namespace
}  // namespace pelagos
