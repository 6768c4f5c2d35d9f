#include "places.hpp"

namespace pelagos::test {
namespace {

std::string below(const char* folder, const std::string& path) { return path.empty() ? folder : folder + ("/" + path); }

}  // namespace

std::string source_path(const std::string& path) { return below(PELAGOS_SOURCE_DIR, path); }

std::string build_path(const std::string& path) { return below(PELAGOS_BINARY_DIR, path); }

}  // namespace pelagos::test
