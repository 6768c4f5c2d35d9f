// A server tells who can reach it, at its start and in its status.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "../support/places.hpp"
#include "running_program.hpp"

namespace pelagos {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr std::chrono::seconds kPatience{60};

class OpenLinks : public testing::Test {
 protected:
  void start(const std::string& host, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {test::build_path("bin/pelagos-server"),
                                          "--scene",
                                          test::source_path("scenes/still_water.scene"),
                                          "--domain",
                                          std::to_string(101 + getpid() % 60),
                                          "--control",
                                          host + ":0"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    server_ = std::make_unique<RunningProgram>(arguments);
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (server_->errors().find(" started") == std::string::npos && std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }

  std::string status() {
    const std::string text = server_->errors(), mark = "listening on ";
    const std::size_t line = text.find(mark), colon = text.find('\n', line);
    const std::string port = text.substr(text.rfind(':', colon) + 1, colon - text.rfind(':', colon) - 1);
    RunningProgram ctl({test::build_path("bin/pelagos-ctl"), "--server", "127.0.0.1:" + port, "status"});
    EXPECT_EQ(ctl.wait(kPatience), 0) << ctl.errors();
    return ctl.output();
  }

  std::unique_ptr<RunningProgram> server_;
};

TEST_F(OpenLinks, ThereAreNoneByDefault) {
  unsetenv("CYCLONEDDS_URI");
  start("127.0.0.1");
  EXPECT_THAT(server_->errors(), Not(HasSubstr("is open")));
  EXPECT_THAT(status(), Not(HasSubstr("OPEN")));
}

TEST_F(OpenLinks, ControlOnEveryAddressIsWarnedOf) {
  unsetenv("CYCLONEDDS_URI");
  start("0.0.0.0");
  EXPECT_THAT(server_->errors(), AllOf(HasSubstr("warning control 0.0.0.0:"), HasSubstr("is open: every machine that"),
                                       HasSubstr("no password"), HasSubstr("--control 127.0.0.1:PORT")));
  EXPECT_THAT(status(), AllOf(HasSubstr("OPEN       control 0.0.0.0:"), HasSubstr("no password")));
}

}  // namespace
}  // namespace pelagos
