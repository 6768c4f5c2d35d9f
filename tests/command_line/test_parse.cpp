#include <gmock/gmock.h>

#include <sstream>

#include "command_line/number_check.hpp"
#include "command_line/parse.hpp"

namespace pelagos {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

/// A program with options of every kind, run with some words.
struct Program {
  int domain = 0;
  std::uint32_t sender = 0;
  std::uint64_t frames = 0;
  double speed = 0.0, duration = 0.0;
  std::optional<double> spacing;
  std::vector<double> place;
  std::vector<std::string> assets;
  std::string scene, law = "gust";
  bool loud = false;
  std::ostringstream out, err;
  std::optional<int> status;

  explicit Program(const std::vector<const char*>& words) {
    CLI::App app("Does nothing.", "program");
    app.set_version_flag("--version", "program 1");
    app.add_option("--scene", scene)->required();
    app.add_option("--domain", domain)->check(WholeFrom(0, 230));
    app.add_option("--sender", sender);
    app.add_option("--frames", frames);
    app.add_option("--speed", speed);
    app.add_option("--duration", duration)->check(NumberFrom(0.0, 1e6));
    app.add_option("--spacing", spacing)->check(NumberFrom(1e-3, 100.0));
    app.add_option("--place", place)->expected(3);
    app.add_option("--law", law)->check(OneOf({"gust", "stress", "paper"}));
    app.add_option("--assets", assets)->allow_extra_args(false)->check(FolderThatExists());
    app.add_flag("--loud", loud);
    std::vector<const char*> argv{"./program"};
    argv.insert(argv.end(), words.begin(), words.end());
    status = parse_command_line(app, static_cast<int>(argv.size()), argv.data(), out, err);
  }
};

/// The same with commands of its own.
struct Station {
  double speed = 0.0;
  std::vector<double> places;
  std::uint64_t id = 0;
  bool json = false;
  std::ostringstream out, err;
  std::optional<int> status;

  explicit Station(const std::vector<const char*>& words) {
    CLI::App app("Does nothing.", "station");
    app.fallthrough();
    app.require_subcommand(1);
    app.add_flag("--json", json);
    app.add_subcommand("status");
    app.add_subcommand("wind")->add_option("--speed", speed);
    app.add_subcommand("cancel")->add_option("id", id)->required();
    app.add_subcommand("wind-at")->add_option("places", places)->expected(3, 300)->required();
    std::vector<const char*> argv{"./station"};
    argv.insert(argv.end(), words.begin(), words.end());
    status = parse_command_line(app, static_cast<int>(argv.size()), argv.data(), out, err);
  }
};

TEST(CommandLine, ReadsNumbersAsDecimal) {
  const Program p({"--scene", "010", "--domain", "010", "--sender", "0077", "--frames", "+09", "--speed", "007.5",
                   "--duration", "090", "--spacing=00.1", "--place", "-010", "-.5", "08"});
  EXPECT_EQ(p.status, std::nullopt) << p.err.str();
  EXPECT_EQ(p.scene, "010");
  EXPECT_EQ(p.domain, 10);
  EXPECT_EQ(p.sender, 77u);
  EXPECT_EQ(p.frames, 9u);
  EXPECT_EQ(p.speed, 7.5);
  EXPECT_EQ(p.duration, 90.0);
  EXPECT_EQ(p.spacing, 0.1);
  EXPECT_THAT(p.place, testing::ElementsAre(-10.0, -0.5, 8.0));
}

TEST(CommandLine, ReadsNumbersOfCommandsAsDecimal) {
  EXPECT_EQ(Station({"cancel", "010"}).id, 10u);
  EXPECT_EQ(Station({"wind", "--speed", "010", "--json"}).speed, 10.0);
  EXPECT_THAT(Station({"wind-at", "010", "-07", "0"}).places, testing::ElementsAre(10.0, -7.0, 0.0));
}

TEST(CommandLine, TakesNegativeNumbersWithAndWithoutAMark) {
  const auto places = testing::ElementsAre(-9.0, 3.0, -0.5);
  EXPECT_THAT(Station({"wind-at", "-9", "3", "-.5"}).places, places);
  EXPECT_THAT(Station({"wind-at", "--", "-9", "3", "-.5"}).places, places);
  EXPECT_THAT(Station({"wind-at", "-9", "--", "3", "-.5"}).places, places);
  EXPECT_EQ(Station({"wind-at", "--", "-9", "3", "--jsn"}).status, 2);
}

struct Refusal {
  std::vector<const char*> words;
  const char* says;
};

TEST(CommandLine, NamesOptionValueAndWhatIsAllowed) {
  const Refusal refusals[] = {
      {{"--domain", "0x10"}, "--domain: is 0x10 (hexadecimal); allowed: 0 to 230"},
      {{"--domain", "231"}, "--domain: is 231; allowed: 0 to 230"},
      {{"--domain", "-1"}, "--domain: is -1; allowed: 0 to 230"},
      {{"--domain", "1.5"}, "--domain: is 1.5 (not a whole number); allowed: 0 to 230"},
      {{"--domain", "99999999999999999999"}, "--domain: is 99999999999999999999; allowed: 0 to 230"},
      {{"--domain", "seven"}, "--domain: is seven; allowed: 0 to 230"},
      {{"--domain", ""}, "--domain: is empty; allowed: 0 to 230"},
      {{"--domain="}, "--domain: is empty; a value is needed"},
      {{"--domain"}, "--domain: its value is missing"},
      {{"--domain", "--loud"}, "--domain: its value is missing"},
      {{"--domain", "1", "--domain", "2"}, "--domain: is given 2 times; allowed: once"},
      {{"--duration", "nan"}, "--duration: is nan; allowed: 0 to 1e+06"},
      {{"--duration", "inf"}, "--duration: is inf; allowed: 0 to 1e+06"},
      {{"--duration", "-inf"}, "--duration: is -inf; allowed: a decimal number"},
      {{"--duration", "0,5"}, "--duration: is 0,5 (a decimal comma; write 0.5); allowed: 0 to 1e+06"},
      {{"--duration", "5s"}, "--duration: is 5s (\"s\" follows the number; write 5); allowed: 0 to 1e+06"},
      {{"--spacing", "−1"}, "minus sign, U+2212); write - instead"},
      {{"--sender", "-1"}, "--sender: is -1 (negative); allowed: a whole number from 0 on"},
      {{"--frames", "-1"}, "--frames: is -1 (negative); allowed: a whole number from 0 on"},
      {{"--speed", "nan"}, "--speed: is nan (not finite); allowed: a decimal number"},
      {{"--place", "1", "2"}, "--place: needs 3 values, 2 are given"},
      {{"--place", "1", "2", "x"}, "--place: is x (no number); allowed: a decimal number"},
      {{"--law", "strss"}, "--law: is strss; did you mean stress? Allowed: gust, stress, paper"},
      {{"--law", ""}, "--law: is empty"},
      {{"--assets", "/nowhere"}, "--assets: is /nowhere; there is no such folder"},
      {{"more"}, "unexpected argument \"more\""},
  };
  for (const Refusal& refusal : refusals) {
    std::vector<const char*> words{"--scene", "a.scene"};
    words.insert(words.end(), refusal.words.begin(), refusal.words.end());
    const Program p(words);
    EXPECT_EQ(p.status, 2) << refusal.says;
    EXPECT_THAT(p.err.str(),
                AllOf(StartsWith("program: "), HasSubstr(refusal.says), HasSubstr("(see program --help)")));
    EXPECT_EQ(p.out.str(), "");
  }
  EXPECT_THAT(Program({"--scene", ""}).err.str(), HasSubstr("--scene: is empty; a value is needed"));
  EXPECT_THAT(Program({}).err.str(), HasSubstr("--scene is required"));
}

TEST(CommandLine, NamesTheUnknownOptionAndTheNearest) {
  EXPECT_EQ(Program({"--sceen", "a.scene"}).err.str(),
            "program: unknown option --sceen; did you mean --scene? (see program --help)\n");
  EXPECT_THAT(Program({"--sceen=a.scene"}).err.str(), HasSubstr("unknown option --sceen; did you mean --scene?"));
  EXPECT_THAT(Program({"-domain", "3"}).err.str(), HasSubstr("unknown option -domain; did you mean --domain?"));
  EXPECT_THAT(Program({"—domain", "3"}).err.str(),
              AllOf(HasSubstr("unknown option —domain"), HasSubstr("em dash"), HasSubstr("did you mean --domain?")));
  EXPECT_THAT(Program({"--quiet"}).err.str(),
              AllOf(HasSubstr("unknown option --quiet; allowed: "), HasSubstr("--scene"), HasSubstr("--help")));
  EXPECT_THAT(Program({"-x"}).err.str(), HasSubstr("unknown option -x; allowed: "));
}

TEST(CommandLine, NamesTheUnknownCommandAndTheNearest) {
  EXPECT_EQ(Station({"stauts"}).err.str(),
            "station: unknown command stauts; did you mean status? Allowed: status, wind, cancel, wind-at (see station "
            "--help)\n");
  EXPECT_THAT(Station({"frobnicate"}).err.str(), HasSubstr("unknown command frobnicate; allowed: status, wind"));
  EXPECT_THAT(Station({"wind", "--sped", "3"}).err.str(),
              HasSubstr("unknown option --sped of wind; did you mean --speed? (see station wind --help)"));
  EXPECT_THAT(Station({"wind", "--jsn"}).err.str(), HasSubstr("unknown option --jsn of wind; did you mean --json?"));
  EXPECT_THAT(Station({}).err.str(), HasSubstr("a command is missing; allowed: status, wind"));
  EXPECT_THAT(Station({"--json"}).err.str(), HasSubstr("a command is missing"));
  EXPECT_THAT(Station({"status", "now"}).err.str(), HasSubstr("unexpected argument \"now\""));
  EXPECT_THAT(Station({"cancel"}).err.str(), HasSubstr("id is required"));
  EXPECT_THAT(Station({"cancel", "-1"}).err.str(), HasSubstr("id: is -1 (negative)"));
}

TEST(CommandLine, HelpAndVersionGoToStandardOutput) {
  const Program help({"--help"});
  EXPECT_EQ(help.status, 0);
  EXPECT_THAT(help.out.str(), AllOf(HasSubstr("Does nothing."), HasSubstr("INT in [0 to 230]")));
  EXPECT_EQ(help.err.str(), "");
  EXPECT_THAT(Program({"--version"}).out.str(), StartsWith("program 1"));
}

}  // namespace
}  // namespace pelagos
