#pragma once

#include <gtest/gtest.h>

#include "simulation/world.hpp"
#include "small_patch.hpp"

namespace pelagos::test {

inline constexpr double kParticleVolume = 0.25 * 0.25 * 0.25;                    ///< m^3, of a particle of the patch
inline constexpr double kOilDensity = find_oil("medium crude").value().density;  ///< kg/m^3

/// A patch with room for oil, none of it there yet.
inline Scene oily_patch(OilModel model, Scene scene = small_patch()) {
  scene.oil.emplace();
  scene.oil->properties = find_oil("medium crude").value();
  scene.oil->model = model;
  return scene;
}

inline OilBudget budget_of(const World& world) { return world.spill()->budget(); }

/// Advances to `time` (s); the ledger has to close after every step.
inline void run_with_ledger(World& world, double time) {
  while (world.time() < time - 1e-9) {
    const WorldStep step = world.advance();
    ASSERT_EQ(step.report.not_finite, 0U);
    ASSERT_EQ(budget_of(world).ledger.balance(), 0) << "at " << world.time() << " s";
  }
}

}  // namespace pelagos::test
