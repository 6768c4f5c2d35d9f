#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "pelagos_dds/configuration.hpp"
#include "running_program.hpp"

namespace pelagos {

inline constexpr std::chrono::seconds kPatience{60};  // for what takes a second, on a machine with other work

template <class Condition>
bool eventually(Condition&& done) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!done()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return true;
}

/// A server with still water that runs, in a domain of this process, and pelagos-ctl to ask it.
class StillWaterServer : public testing::Test {
 protected:
  StillWaterServer()
      : server_({program("pelagos-server"), "--scene", scene("still_water"), "--domain", own_domain(), "--control",
                 "127.0.0.1:0"}) {
    const std::string before = "control: listening on ";
    EXPECT_TRUE(eventually([&] {
      const std::string log = server_.errors();
      const std::size_t place = log.find(before);
      if (place == std::string::npos || log.find(" started") == std::string::npos) return false;
      address_ = log.substr(place + before.size(), log.find('\n', place) - place - before.size());
      return true;
    })) << server_.errors();
  }
  static DdsSettings settings() {
    DdsSettings settings;
    settings.domain = static_cast<std::uint32_t>(std::stoul(own_domain()));
    return settings;
  }
  /// What pelagos-ctl prints, errors behind the rest. @param status  that it ends with
  std::string ask(std::vector<std::string> words, int status = 0) {
    words.insert(words.begin(), {program("pelagos-ctl"), "--server", address_});
    RunningProgram ctl(words);
    EXPECT_EQ(ctl.wait(kPatience), status) << ctl.errors();
    return ctl.output() + ctl.errors();
  }

  RunningProgram server_;
  std::string address_;
};

}  // namespace pelagos
