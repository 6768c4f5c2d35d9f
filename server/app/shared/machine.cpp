#include "machine.hpp"

#include <sys/resource.h>

#include <fstream>
#include <string_view>
#include <thread>

#include "physics/neighbor_search.hpp"

namespace pelagos {

namespace {

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("model name", 0) != 0) continue;
    const std::size_t colon = line.find(':');
    if (colon != std::string::npos) return line.substr(line.find_first_not_of(" \t", colon + 1));
  }
  return "unknown";
}

std::string plain_name(std::string_view target) {
  if (target == "AVX3") return "avx512";
  if (target == "AVX2") return "avx2";
  if (target == "SSE4") return "sse4";
  return "baseline";
}

}  // namespace

Machine describe_machine() {
  return {processor_name(), static_cast<int>(std::thread::hardware_concurrency()), plain_name(instruction_set())};
}

std::uint64_t peak_memory() {
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024U;
}

}  // namespace pelagos
