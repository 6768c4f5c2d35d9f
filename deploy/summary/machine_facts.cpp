#include "machine_facts.hpp"

#include <sched.h>
#include <sys/utsname.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

namespace pelagos {
namespace {

/// The rest of the first line of `file` that begins with `key` and a colon or an equals sign; empty if there is none.
std::string line_value(const char* file, const std::string& key) {
  std::ifstream input(file);
  for (std::string line; std::getline(input, line);) {
    if (line.compare(0, key.size(), key) != 0) continue;
    const std::size_t mark = line.find_first_of(":=", key.size());
    if (mark == std::string::npos) continue;
    const std::size_t begin = line.find_first_not_of(" \t\"", mark + 1);
    if (begin == std::string::npos) return "";
    return line.substr(begin, line.find_last_not_of(" \t\"") + 1 - begin);
  }
  return "";
}

int usable_cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  return sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 0;
}

double memory_gib() {
  try {
    return std::round(std::stod(line_value("/proc/meminfo", "MemTotal")) / 1024.0 / 1024.0 * 10.0) / 10.0;
  } catch (const std::exception&) {
    return 0.0;  // no such line
  }
}

}  // namespace

nlohmann::ordered_json machine_facts() {
  utsname system{};
  uname(&system);
  return {{"processor", line_value("/proc/cpuinfo", "model name")},
          {"architecture", system.machine},
          {"cores", usable_cores()},
          {"memory_gib", memory_gib()},
          {"system", line_value("/etc/os-release", "PRETTY_NAME")},
          {"kernel", system.release}};
}

}  // namespace pelagos
