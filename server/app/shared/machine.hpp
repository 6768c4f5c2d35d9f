#pragma once

#include <cstdint>
#include <string>

namespace pelagos {

/// What the numbers of a run depend on.
struct Machine {
  std::string processor;        ///< model name, as the kernel gives it
  int hardware_threads = 1;     ///< that this process may use
  std::string instruction_set;  ///< that the physics kernels use: "avx512", "avx2", "sse4", "baseline"
};
[[nodiscard]] Machine describe_machine();

/// Largest resident memory of this process so far, bytes; 0 if unknown.
[[nodiscard]] std::uint64_t peak_memory();

}  // namespace pelagos
