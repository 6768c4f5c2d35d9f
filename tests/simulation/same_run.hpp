#pragma once

#include <gtest/gtest.h>

#include <functional>

#include "fields/field_difference.hpp"
#include "simulation/state_file.hpp"
#include "simulation/world.hpp"

namespace pelagos::test {

/// What is done to a world before a step; by the number of steps that the run has made.
using BeforeStep = std::function<void(World&, std::uint64_t)>;

/// Makes a step of a run as a server does it: frames are looked at, which moves foam and loads on.
inline void make_step(World& world, std::uint64_t number, const BeforeStep& before) {
  if (before) before(world, number);
  WorldStep step = world.advance();
  Snapshot snapshot;
  if (step.frame_reached) world.take_frame(snapshot, step.report);
}

inline std::string first_difference(const World& one, const World& other) {
  const auto difference = find_difference(one.state(), other.state());
  if (!difference) return "";
  return difference->field + ": " + difference->one + " and " + difference->other;
}

/// Runs a scene to `all` steps; and to `saved` steps, saves, loads into a new world, and goes on. The states have the
/// same bytes after every step.
inline void expect_same_run(const Scene& scene, std::uint64_t saved, std::uint64_t all, const BeforeStep& before = {},
                            int threads = 2) {
  World straight(scene, {threads, nullptr, {}});
  for (std::uint64_t n = 0; n < saved; ++n) make_step(straight, n, before);
  World loaded(scene, {threads, nullptr, {}});
  ASSERT_FALSE(load_state(save_state(straight), loaded));
  ASSERT_EQ(first_difference(straight, loaded), "") << "just loaded";
  for (std::uint64_t n = saved; n < all; ++n) {
    make_step(straight, n, before);
    make_step(loaded, n, before);
    ASSERT_EQ(first_difference(straight, loaded), "") << "first differing step " << n + 1;
  }
  EXPECT_EQ(save_state(straight), save_state(loaded));
}

}  // namespace pelagos::test
