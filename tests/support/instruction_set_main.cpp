#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "physics/neighbor_search.hpp"

/// Runs the tests with at most the instruction set named as the first argument; 77 where the machine does not have it.
int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (argc > 1) {
    const std::string set = argv[1];
    if (!pelagos::limit_instruction_set(set.c_str())) {
      std::printf("instruction set %s: not on this machine\n", set.c_str());
      return 77;
    }
    const std::string runs = pelagos::instruction_set();
    if (set == "baseline" && (runs == "AVX3" || runs == "AVX2" || runs == "SSE4")) return 1;  // limited in name only
  }
  std::printf("instruction set in use: %s\n", pelagos::instruction_set());
  return RUN_ALL_TESTS();
}
