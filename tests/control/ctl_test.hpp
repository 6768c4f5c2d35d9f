#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "control_fixture.hpp"
#include "ctl.hpp"

namespace pelagos::test {

/// What pelagos-ctl ended with and printed.
struct Outcome {
  int code = -1;
  std::string out, err;
};

inline Outcome run_ctl_with(const std::vector<std::string>& arguments) {
  std::vector<const char*> argv{"pelagos-ctl"};
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  std::ostringstream out, err;
  const int code = run_ctl(static_cast<int>(argv.size()), argv.data(), out, err);
  return {code, out.str(), err.str()};
}

/// A server's control link, and pelagos-ctl to ask it.
class CtlTest : public ControlTest {
 protected:
  Outcome ask(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"--server", "127.0.0.1:" + std::to_string(port())});
    return run_ctl_with(arguments);
  }
};

}  // namespace pelagos::test
