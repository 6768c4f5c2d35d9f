// pelagos-ctl: the waves around the patch.

#include <filesystem>
#include <fstream>

#include "ctl_test.hpp"

namespace pelagos {
namespace {

using test::Outcome;
using testing::HasSubstr;

class CtlWaves : public test::CtlTest {
 protected:
  SetWaves given(const std::vector<std::string>& arguments) {
    const Outcome outcome = ask(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const auto all = commands();
    const auto* waves = all.empty() ? nullptr : std::get_if<SetWaves>(&all.back());
    EXPECT_NE(waves, nullptr);
    return waves == nullptr ? SetWaves{} : *waves;
  }
  /// A file with this text, removed at the end.
  std::string file_with(const std::string& text) {
    std::ofstream(file_) << text;
    return file_.string();
  }
  void TearDown() override {
    std::filesystem::remove(file_);
    ControlTest::TearDown();
  }

 private:
  std::filesystem::path file_ =
      std::filesystem::temp_directory_path() / ("pelagos_waves_" + std::to_string(getpid()) + ".txt");
};

TEST_F(CtlWaves, SendsThemByLengthAndByPeriod) {
  const SetWaves set = given({"waves", "--wave", "1.2,60,270", "--wave", "0.4,5s,250,-90", "--blend", "30"});
  ASSERT_EQ(set.waves.size(), 2U);
  EXPECT_EQ(set.waves[0].amplitude, 1.2);
  EXPECT_EQ(set.waves[0].length, 60.0);
  EXPECT_EQ(set.waves[0].to_deg, 270.0);
  EXPECT_EQ(set.waves[0].phase_deg, 0.0);
  EXPECT_EQ(set.waves[1].period, 5.0);
  EXPECT_EQ(set.waves[1].length, 0.0);
  EXPECT_EQ(set.waves[1].phase_deg, -90.0);
  EXPECT_EQ(set.blend_seconds, 30.0);
  const SetWaves flat = given({"waves", "--off", "--blend", "60"});
  EXPECT_TRUE(flat.waves.empty());
  EXPECT_EQ(flat.blend_seconds, 60.0);
  EXPECT_EQ(ask({"waves", "--off", "--at", "60"}).out, "scheduled as 1\n");
}

TEST_F(CtlWaves, TakesThemFromAFile) {
  const std::string file = file_with("# a swell\nwave { amplitude: 1.5 length: 120 to_deg: 300 }\nblend: 20\n");
  const SetWaves set = given({"waves", "--file", file});
  ASSERT_EQ(set.waves.size(), 1U);
  EXPECT_EQ(set.waves[0].length, 120.0);
  EXPECT_EQ(set.blend_seconds, 20.0);
  EXPECT_EQ(given({"waves", "--file", file, "--blend", "7"}).blend_seconds, 7.0) << "the command line's";
}

TEST_F(CtlWaves, RefusesWhatIsNoWaveOrNoFile) {
  for (const char* text : {"1.2", "1.2,60", "1.2,60,270,0,1", "1.2,60,west", "1.2,60m,270", ",,", "1.2,s,270"}) {
    const Outcome outcome = ask({"waves", std::string("--wave=") + text});
    EXPECT_EQ(outcome.code, 2) << text;
    EXPECT_THAT(outcome.err, HasSubstr("AMPLITUDE,LENGTH,TO")) << text;
  }
  EXPECT_EQ(ask({"waves", "--wave="}).code, 2);
  EXPECT_THAT(ask({"waves"}).err, HasSubstr("say which"));
  EXPECT_EQ(ask({"waves", "--blend", "5"}).code, 2);
  EXPECT_EQ(ask({"waves", "--off", "--wave", "1,60,0"}).code, 2);
  EXPECT_THAT(ask({"waves", "--file", "/nowhere/swell"}).err, HasSubstr("/nowhere/swell: no such waves file"));
  EXPECT_THAT(ask({"waves", "--file", "/"}).err, HasSubstr("is a folder"));
  const Outcome unknown = ask({"waves", "--file", file_with("wave { amplitude: 1 }\nwave { height: 1 }\n")});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, HasSubstr(".txt:2"));
  EXPECT_THAT(ask({"waves", "--file", file_with(std::string(70'000, '#'))}).err, HasSubstr("at most 65,536 bytes"));
  EXPECT_TRUE(commands().empty());
}

TEST_F(CtlWaves, FailWithTheServersWords) {
  EXPECT_THAT(ask({"waves", "--wave", "nan,60,0"}).err, HasSubstr("AMPLITUDE"));
  EXPECT_THAT(ask({"waves", "--wave=-1,60,0"}).err,
              HasSubstr("command.set_waves.wave[0].amplitude: -1 is out of range; allowed: 0.001 to 15 m"));
  EXPECT_THAT(ask({"waves", "--wave", "5,20,0"}).err,
              HasSubstr("command.set_waves.wave[0].amplitude: 5 m is too steep for a wave of 20 m"));
  EXPECT_THAT(ask({"waves", "--off", "--blend", "4000"}).err, HasSubstr("command.set_waves.blend: 4000 is out of"));
  EXPECT_THAT(ask({"command", "set_waves { }"}).err, HasSubstr("command.set_waves.wave: is missing"));
  std::string many = "set_waves { ";
  for (int n = 0; n < 513; ++n) many += "wave { amplitude: 0.01 length: 60 to_deg: 0 } ";
  EXPECT_THAT(ask({"command", many + "}"}).err, HasSubstr("has 513 entries; allowed: at most 512"));
  EXPECT_TRUE(commands().empty());
}

TEST_F(CtlWaves, StatusTellsTheSeaAndItsBlend) {
  EXPECT_THAT(ask({"status"}).out, HasSubstr("waves      flat\n"));
  WaveField sea({{1.0F, 0.1F, 0.99F, 0.0F, 0.0F}}, 0.0);
  status_.sea = sea_status(sea, 3.0);
  EXPECT_THAT(
      ask({"status"}).out,
      HasSubstr("waves      1, significant height 2.83 m, to 090 on average, the highest of 6.3 s (62.83 m)\n"));
  ASSERT_TRUE(sea.exchange({}, 10.0, 20.0));
  status_.sea = sea_status(sea, 20.0);
  EXPECT_THAT(ask({"status"}).out, HasSubstr("waves      flat; change to it: 50 % done, 10.0 s left\n"));
  EXPECT_THAT(ask({"status", "--json"}).out, HasSubstr("\"share\":0.5,\"blend_left\":10.0,\"earlier\":1"));
  ASSERT_TRUE(sea.exchange({}, 20.0, 20.0));
  status_.sea = sea_status(sea, 25.0);
  EXPECT_THAT(ask({"status"}).out,
              HasSubstr("waves      flat; change to it: 10 % done, 15.0 s left; 2 seas before it still show\n"));
}

}  // namespace
}  // namespace pelagos
