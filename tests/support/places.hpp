#pragma once

#include <string>

// Where the tests find the project's files.
namespace pelagos::test {

// The project's top folder, or `path` below it, e.g. source_path("scenes/bridge.scene").
std::string source_path(const std::string& path = "");

// The build's folder, or `path` below it, e.g. build_path("bin/pelagos-ctl").
std::string build_path(const std::string& path = "");

}  // namespace pelagos::test
