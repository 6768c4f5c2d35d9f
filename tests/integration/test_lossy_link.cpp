// A chain of programs whose links lose packets: nothing ends, hangs or misleads.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "pelagos_dds/configuration.hpp"
#include "running_program.hpp"

namespace pelagos {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr std::chrono::seconds kPatience{30};

/// The default configuration with so many of a thousand packets lost by each sender.
std::string lossy_configuration(const std::filesystem::path& folder, int per_mille) {
  std::string text(loopback_configuration());
  const std::string mark = "<Internal>";
  text.insert(text.find(mark) + mark.size(),
              "<Test><XmitLossiness>" + std::to_string(per_mille) + "</XmitLossiness></Test>");
  const std::filesystem::path file = folder / "lossy.xml";
  std::ofstream(file) << text;
  return file.string();
}

TEST(LossyLink, FramesAreMissedAndNothingEnds) {
  const TemporaryFolder folder;
  const std::string lossy = lossy_configuration(folder.path(), 300);
  const std::vector<std::string> link = {"--dds-config", lossy, "--domain", own_domain()};
  const auto with_link = [&](std::vector<std::string> words) {
    words.insert(words.end(), link.begin(), link.end());
    return words;
  };
  const std::string of_server = (folder.path() / "server.json").string();
  RunningProgram server(with_link(
      {program("pelagos-server"), "--scene", scene("still_water"), "--control", "127.0.0.1:0", "--report", of_server}));
  RunningProgram bridge(with_link({program("pelagos-example-bridge"), "--probe-forward", "1"}));
  RunningProgram viewer(with_link({program("pelagos-viewer"), "--channel", "centre", "--headless", "--size", "160x90",
                                   "--wait", "20", "--duration", "6", "--out", folder.path().string()}));
  EXPECT_EQ(viewer.wait(kPatience), 0) << viewer.errors();
  EXPECT_THAT(viewer.errors(), Not(HasSubstr("no server"))) << "a lossy link is no dead one";
  EXPECT_EQ(bridge.wait(std::chrono::milliseconds(0)), std::nullopt) << bridge.errors();
  EXPECT_EQ(server.wait(std::chrono::milliseconds(0)), std::nullopt) << server.errors();
  bridge.signal(SIGTERM);
  server.signal(SIGTERM);
  EXPECT_EQ(bridge.wait(kPatience), 0) << bridge.errors();
  EXPECT_EQ(server.wait(kPatience), 0) << server.errors();

  const auto seen = nlohmann::json::parse(read_text(folder.path() / "centre.json"));
  EXPECT_GT(seen.at("frames_received").get<int>(), 60) << "of 180";
  EXPECT_GT(seen.at("gaps").get<int>(), 0) << "and counted";
  EXPECT_LT(seen.at("gaps").get<int>(), 150);
}

}  // namespace
}  // namespace pelagos
