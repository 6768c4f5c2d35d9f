#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "loopback.hpp"
#include "pelagos_dds/configuration.hpp"
#include "pelagos_dds/log_sink.hpp"
#include "pelagos_dds/participant.hpp"

namespace pelagos {
namespace {

using testing::HasSubstr;

std::string error_of(const DdsSettings& settings) {
  try {
    const auto participant = join_dds(settings);
  } catch (const DdsError& error) {
    return error.what();
  }
  return "no error";
}

class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& content)
      : path_(std::filesystem::temp_directory_path() / ("pelagos-test-" + std::to_string(getpid()) + ".xml")) {
    std::ofstream(path_) << content;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  [[nodiscard]] std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

TEST(DdsConfiguration, RefusesDomainOutOfRange) {
  DdsSettings settings = test_settings();
  settings.domain = 231;
  EXPECT_THAT(error_of(settings), HasSubstr("231 is out of range; allowed: 0 to 230"));
}

TEST(DdsConfiguration, RefusesMissingAndEmptyFile) {
  DdsSettings settings = test_settings();
  settings.config_file = "/nonexistent/dds.xml";
  EXPECT_THAT(error_of(settings), HasSubstr("/nonexistent/dds.xml"));
  const TemporaryFile empty("");
  settings.config_file = empty.path();
  EXPECT_THAT(error_of(settings), HasSubstr("empty"));
}

TEST(DdsConfiguration, UnusableInterfaceIsAClearErrorAndNotTheEnd) {
  const TemporaryFile file(
      "<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface name=\"nosuch0\"/></Interfaces></General>"
      "</Domain></CycloneDDS>");
  DdsSettings settings = test_settings();
  settings.config_file = file.path();
  const std::string error = error_of(settings);
  EXPECT_THAT(error, HasSubstr("nosuch0"));
  EXPECT_THAT(error, HasSubstr("Check the interface"));
  EXPECT_EQ(error_of(test_settings()), "no error");  // the domain can be joined afterwards
}

TEST(DdsConfiguration, MalformedFileIsAnError) {
  const TemporaryFile file(
      "<CycloneDDS><Domain><General><NoSuchElement>1</NoSuchElement></General></Domain></CycloneDDS>");
  DdsSettings settings = test_settings();
  settings.config_file = file.path();
  EXPECT_THAT(error_of(settings), HasSubstr("NoSuchElement"));
}

TEST(DdsConfiguration, FileOverridesTheEnvironmentAndThatTheDefault) {
  DdsSettings settings = test_settings();
  EXPECT_EQ(resolve_configuration(settings), loopback_configuration());
  setenv("CYCLONEDDS_URI", "<CycloneDDS/>", 1);
  EXPECT_EQ(resolve_configuration(settings), "<CycloneDDS/>");
  const TemporaryFile file("<CycloneDDS/>");
  settings.config_file = file.path();
  EXPECT_EQ(resolve_configuration(settings), "file://" + file.path());
  unsetenv("CYCLONEDDS_URI");
}

TEST(DdsConfiguration, SmallReceiveBufferIsWarnedOf) {
  const TemporaryFile small("212992\n");
  const auto warning = check_receive_buffer(small.path());
  ASSERT_TRUE(warning);
  EXPECT_THAT(*warning, HasSubstr("sysctl -w net.core.rmem_max=8388608"));
  const TemporaryFile large("8388608\n");
  EXPECT_FALSE(check_receive_buffer(large.path()));
  EXPECT_FALSE(check_receive_buffer("/nonexistent/rmem_max"));
}

/// Local addresses of this process's UDP sockets, as /proc/net writes them: hexadecimal, of the machine's byte order.
std::vector<std::string> udp_hosts() {
  std::set<std::string> own;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    std::error_code gone;
    const std::string link = std::filesystem::read_symlink(entry.path(), gone).string();
    if (link.starts_with("socket:[")) own.insert(link.substr(8, link.size() - 9));
  }
  std::vector<std::string> hosts;
  std::ifstream table("/proc/net/udp");
  std::string line;
  std::getline(table, line);  // titles
  while (std::getline(table, line)) {
    std::istringstream fields(line);
    std::string slot, local, field, inode;
    fields >> slot >> local;
    for (int skipped = 0; skipped < 7; ++skipped) fields >> field;
    fields >> inode;
    if (own.count(inode) > 0) hosts.push_back(local.substr(0, local.find(':')));
  }
  return hosts;
}

std::string in_table(in_addr_t host) {
  std::array<char, 9> text{};
  std::snprintf(text.data(), text.size(), "%08X", host);
  return text.data();
}

TEST(DdsDomain, OfTheBuiltInConfigurationListensOnLoopbackOnly) {
  const auto participant = join_dds(test_settings());
  const std::vector<std::string> hosts = udp_hosts();
  EXPECT_GE(hosts.size(), 2U);
  EXPECT_THAT(hosts, testing::Each(in_table(htonl(INADDR_LOOPBACK))));
  EXPECT_FALSE(reach_of(*participant).beyond_loopback());
  EXPECT_EQ(describe_reach(reach_of(*participant), test_settings()), "");
}

TEST(DdsDomain, OfAFileThatNamesLoopbackAloneDoesTheSame) {
  const TemporaryFile file(
      "<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface address=\"127.0.0.1\"/></Interfaces>"
      "<AllowMulticast>false</AllowMulticast></General></Domain></CycloneDDS>");
  DdsSettings settings = test_settings();
  settings.config_file = file.path();
  const auto participant = join_dds(settings);
  EXPECT_THAT(udp_hosts(), testing::Each(in_table(htonl(INADDR_LOOPBACK))));
  EXPECT_FALSE(reach_of(*participant).beyond_loopback());
}

TEST(DdsDomain, OpenToANetworkIsDescribed) {
  DdsReach reach;
  reach.interfaces = {"192.0.2.7"};
  reach.everywhere = true;
  DdsSettings settings = test_settings();
  settings.config_file = "lan.xml";
  EXPECT_THAT(describe_reach(reach, settings),
              testing::AllOf(HasSubstr("every machine that reaches 192.0.2.7"), HasSubstr("no password"),
                             HasSubstr("DDS Security"), HasSubstr("--dds-config lan.xml")));
  setenv("CYCLONEDDS_URI", "<CycloneDDS/>", 1);
  settings.config_file.clear();
  EXPECT_THAT(describe_reach(reach, settings), HasSubstr("CYCLONEDDS_URI"));
  unsetenv("CYCLONEDDS_URI");
}

TEST(DdsDomain, SocketsOfOthersAreBoundAsTheyAsk) {
  const auto participant = join_dds(test_settings());
  const int socket = ::socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in any{};
  any.sin_family = AF_INET;
  ASSERT_EQ(::bind(socket, reinterpret_cast<const sockaddr*>(&any), sizeof any), 0);
  EXPECT_THAT(udp_hosts(), testing::Contains(in_table(htonl(INADDR_ANY))));
  ::close(socket);
}

TEST(DdsDomain, ParticipantsMayComeAndGoInAnyOrder) {
  auto first = join_dds(test_settings());
  auto second = join_dds(test_settings());
  first.reset();
  FramePublisher publisher(second, test_scene());  // the domain still stands
  second.reset();
  EXPECT_EQ(publisher.counters().failed, 0U);
}

TEST(RateLimitedLogTest, HoldsBackAndCounts) {
  std::vector<std::string> lines;
  RateLimitedLog log([&](std::string_view line) { lines.emplace_back(line); }, 2, std::chrono::milliseconds(50));
  for (int i = 0; i < 10; ++i) log.write("fault");
  EXPECT_THAT(lines, testing::ElementsAre("fault", "fault"));
  EXPECT_EQ(log.suppressed(), 8U);
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  log.write("later");
  EXPECT_THAT(lines, testing::ElementsAre("fault", "fault", "8 similar messages held back", "later"));
}

}  // namespace
}  // namespace pelagos
