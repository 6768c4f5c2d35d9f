#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

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
