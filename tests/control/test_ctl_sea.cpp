// pelagos-ctl: the sea around the patch by systems.

#include "ctl_test.hpp"
#include "values/sea_request.hpp"

namespace pelagos {
namespace {

using test::Outcome;
using testing::HasSubstr;

class CtlSea : public test::CtlTest {
 protected:
  SetSea given(const std::vector<std::string>& arguments) {
    const Outcome outcome = ask(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const auto all = commands();
    const auto* sea = all.empty() ? nullptr : std::get_if<SetSea>(&all.back());
    EXPECT_NE(sea, nullptr);
    return sea == nullptr ? SetSea{} : *sea;
  }
};

TEST_F(CtlSea, SendsAWindSeaWithItsSwells) {
  const SetSea set = given({"sea", "--hs",     "2",  "--tp",       "7",          "--to",    "250",       "--gamma",
                            "2",   "--spread", "12", "--swell",    "1.5,12,300", "--swell", "0.5,16,20", "--components",
                            "240", "--seed",   "9",  "--shortest", "1.5",        "--blend", "60"});
  ASSERT_EQ(set.sea.systems.size(), 3U);
  EXPECT_EQ(set.sea.systems[0].height, 2.0);
  EXPECT_EQ(set.sea.systems[0].period, 7.0);
  EXPECT_EQ(set.sea.systems[0].to_deg, 250.0);
  EXPECT_EQ(set.sea.systems[0].gamma, 2.0);
  EXPECT_EQ(set.sea.systems[0].spreading_kind, SpreadingKind::kConstant);
  EXPECT_EQ(set.sea.systems[0].spreading, 12.0);
  EXPECT_EQ(set.sea.systems[1].height, 1.5);
  EXPECT_EQ(set.sea.systems[1].period, 12.0);
  EXPECT_EQ(set.sea.systems[1].to_deg, 300.0);
  EXPECT_EQ(set.sea.systems[2].period, 16.0);
  EXPECT_EQ(set.sea.components, 240U);
  EXPECT_EQ(set.sea.seed, 9U);
  EXPECT_EQ(set.sea.shortest_length, 1.5);
  EXPECT_EQ(set.blend_seconds, 60.0);
}

TEST_F(CtlSea, SendsItByScaleBySpectrumAndFlat) {
  EXPECT_EQ(given({"sea", "--beaufort", "6", "--to", "90"}).sea.systems[0].beaufort, 6);
  EXPECT_EQ(given({"sea", "--douglas", "4", "--to", "90"}).sea.systems[0].douglas, 4);
  EXPECT_EQ(given({"sea", "--hs", "1", "--tz", "4", "--to", "9"}).sea.systems[0].period_kind,
            PeriodKind::kZeroCrossing);
  const SetSea broad =
      given({"sea", "--hs", "1", "--tm", "4", "--to", "9", "--spectrum", "ochi-hubble", "--shape", "2"});
  EXPECT_EQ(broad.sea.systems[0].spectrum, SpectrumKind::kOchiHubble);
  EXPECT_EQ(broad.sea.systems[0].shape, 2.0);
  EXPECT_EQ(given({"sea", "--hs", "1", "--tp", "6", "--to", "9", "--spectrum", "pm", "--long-crested"})
                .sea.systems[0]
                .spreading_kind,
            SpreadingKind::kLongCrested);
  EXPECT_EQ(given({"sea", "--swell", "1,12,300"}).sea.systems.size(), 1U);
  EXPECT_EQ(ask({"sea", "--off", "--blend", "60"}).code, 0);
  const auto flat = std::get<SetWaves>(commands().back());
  EXPECT_TRUE(flat.waves.empty());
  EXPECT_EQ(flat.blend_seconds, 60.0);
  EXPECT_EQ(ask({"sea", "--beaufort", "6", "--to", "90", "--at", "60"}).out, "scheduled as 1\n");
}

TEST_F(CtlSea, SendsOneThatTheWindRaises) {
  const SetSea alone = given({"sea", "--wind-sea"});
  EXPECT_TRUE(alone.sea.systems.empty());
  ASSERT_TRUE(alone.sea.wind_sea.has_value());
  EXPECT_EQ(alone.sea.wind_sea->fetch, 300e3);
  EXPECT_FALSE(alone.sea.wind_sea->blown_for.has_value());
  const SetSea both =
      given({"sea", "--wind-sea", "--fetch", "50000", "--blown-for", "7200", "--pace", "10", "--swell", "1,12,300"});
  EXPECT_EQ(both.sea.systems.size(), 1U);
  EXPECT_EQ(both.sea.wind_sea->fetch, 50e3);
  EXPECT_EQ(both.sea.wind_sea->blown_for, 7200.0);
  EXPECT_EQ(both.sea.wind_sea->pace, 10.0);
  EXPECT_THAT(ask({"sea", "--beaufort", "4", "--to", "0", "--fetch", "50000"}).err,
              HasSubstr("--fetch is given without --wind-sea"));
}

TEST_F(CtlSea, RefusesWhatIsNoSea) {
  for (const char* text : {"1", "1,12", "1,12,300,4", "1,12,west", ",,", "", "1 12 300", "nan,12,300"}) {
    const Outcome outcome = ask({"sea", std::string("--swell=") + text});
    EXPECT_EQ(outcome.code, 2) << text;
    EXPECT_THAT(outcome.err, HasSubstr("swell")) << text;
  }
  EXPECT_THAT(ask({"sea"}).err, HasSubstr("say which"));
  EXPECT_EQ(ask({"sea", "--blend", "5"}).code, 2);
  EXPECT_THAT(ask({"sea", "--tp", "7", "--swell", "1,12,300"}).err, HasSubstr("--tp is given without a height"));
  EXPECT_THAT(ask({"sea", "--off", "--hs", "2"}).err, HasSubstr("--off is given beside --hs"));
  EXPECT_EQ(ask({"sea", "--hs", "2", "--tp", "7", "--to", "0", "--spectrum", "bretschneider"}).code, 2);
  EXPECT_TRUE(commands().empty());
}

TEST_F(CtlSea, FailsWithTheServersWords) {
  EXPECT_THAT(ask({"sea", "--hs", "5", "--tp", "4", "--to", "0"}).err,
              HasSubstr("command.set_sea.system[0].height: 5 m is too steep for a peak period of 4 s"));
  EXPECT_THAT(ask({"sea", "--hs", "2", "--to", "0"}).err, HasSubstr("system[0].peak_period: is missing"));
  EXPECT_THAT(ask({"sea", "--hs", "2", "--beaufort", "4", "--to", "0"}).err, HasSubstr("system[0].beaufort: is given"));
  EXPECT_THAT(ask({"sea", "--hs", "2", "--tp", "7"}).err, HasSubstr("system[0].to_deg: is missing"));
  EXPECT_THAT(ask({"sea", "--beaufort", "4", "--to", "0", "--components", "600"}).err, HasSubstr("1 to 512"));
  EXPECT_TRUE(commands().empty());
}

TEST_F(CtlSea, IsToldByTheStatus) {
  WaveSystem system;
  system.height = 2.0;
  system.period = 7.0;
  system.to_deg = 250.0;
  const WaveField sea({{1.0F, 0.1F, 0.99F, 0.0F, 0.0F}}, 0.0);
  status_.sea = sea_status(sea, 3.0, SeaRequest{{{system}, 100, 4, 0.0, {}}, 0.25});
  EXPECT_THAT(
      ask({"status"}).out,
      HasSubstr("(62.83 m); asked for: wind sea JONSWAP, Hs 2 m, Tp 7 s, to 250 deg, gamma 3.3, spreading 10 at the "
                "peak, which leaves out 0.25 m\n"));
  const std::string json = ask({"status", "--json"}).out;
  EXPECT_THAT(json, HasSubstr("\"system\":[{\"spectrum\":\"JONSWAP\",\"height\":2.0,\"peak_period\":7.0"));
  EXPECT_THAT(json, HasSubstr("\"left_out_height\":0.25"));
}

}  // namespace
}  // namespace pelagos
