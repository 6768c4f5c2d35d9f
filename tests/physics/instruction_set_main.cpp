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
    // The name is the library's own: the test must not pass by running another set than it says.
    const std::string runs = pelagos::instruction_set();
    const bool wide = runs == "AVX3" || runs == "AVX2" || runs == "SSE4";
    const std::string expected = set == "avx512" ? "AVX3" : set == "avx2" ? "AVX2" : set == "sse4" ? "SSE4" : runs;
    if (runs != expected || (set == "baseline" && wide)) {
      std::printf("instruction set %s: runs %s\n", set.c_str(), runs.c_str());
      return set == "baseline" ? 1 : 77;
    }
  }
  std::printf("instruction set in use: %s\n", pelagos::instruction_set());
  return RUN_ALL_TESTS();
}
