// pelagos-ctl: oil, what is done about it, and probes.

#include <nlohmann/json.hpp>
#include <sstream>

#include "ctl_test.hpp"

namespace pelagos {
namespace {

using test::Outcome;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class CtlOil : public test::CtlTest {
 protected:
  /// The command that the server was given, if it was one of this kind.
  template <class Kind>
  Kind given(const std::vector<std::string>& arguments) {
    const Outcome outcome = ask(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const auto all = commands();
    const auto* oil = all.empty() ? nullptr : std::get_if<OilCommand>(&all.back());
    const auto* kind = oil == nullptr ? nullptr : std::get_if<Kind>(oil);
    EXPECT_NE(kind, nullptr) << testing::PrintToString(arguments);
    return kind == nullptr ? Kind{} : *kind;
  }
};

TEST_F(CtlOil, SendsReleases) {
  const auto line = given<ReleaseOil>(
      {"release", "hose", "--from", "1", "2", "8", "--to", "3", "4", "7.5", "--rate", "60", "--duration", "30"});
  EXPECT_EQ(line.name, "hose");
  EXPECT_EQ(line.from, Eigen::Vector3d(1, 2, 8));
  EXPECT_EQ(line.to, Eigen::Vector3d(3, 4, 7.5));
  EXPECT_EQ(line.body, 0U);
  EXPECT_EQ(line.rate, 60.0);
  EXPECT_EQ(line.duration, 30.0);
  const auto hull = given<ReleaseOil>({"release", "tank 3", "--from", "-5", "-2", "-1", "--body", "2", "--rate", "5"});
  EXPECT_EQ(hull.from, Eigen::Vector3d(-5, -2, -1));
  EXPECT_EQ(hull.to, hull.from);
  EXPECT_EQ(hull.body, 2U);
  EXPECT_TRUE(std::isinf(hull.duration));
  EXPECT_EQ(given<StopRelease>({"release", "hose", "--stop"}).name, "hose");
}

TEST_F(CtlOil, SendsSpillsBoomsAndSkimmers) {
  const auto spill = given<SpillOil>({"spill", "12", "20", "--volume", "2", "--radius", "3"});
  EXPECT_EQ(spill.position, Eigen::Vector2d(12, 20));
  EXPECT_EQ(spill.volume, 2.0);
  EXPECT_EQ(spill.radius, 3.0);
  const auto boom = given<SetBoom>(
      {"boom", "north", "-34", "8", "40", "20", "34", "32", "--draft", "0.6", "--critical-speed", "0.4"});
  EXPECT_EQ(boom.name, "north");
  EXPECT_THAT(boom.line, ElementsAre(Eigen::Vector2d(-34, 8), Eigen::Vector2d(40, 20), Eigen::Vector2d(34, 32)));
  EXPECT_EQ(boom.draft, 0.6);
  EXPECT_EQ(boom.critical_speed, 0.4);
  EXPECT_EQ(given<RemoveBoom>({"boom", "north", "--remove"}).name, "north");
  const auto skimmer = given<SetSkimmer>({"skimmer", "rig", "37.5", "20", "--radius", "3", "--rate", "0"});
  EXPECT_EQ(skimmer.position, Eigen::Vector2d(37.5, 20));
  EXPECT_EQ(skimmer.radius, 3.0);
  EXPECT_EQ(skimmer.rate, 0.0);
  EXPECT_EQ(given<SetSkimmer>({"skimmer", "rig", "1", "2"}).rate, 20.0) << "the contract's default";
  EXPECT_EQ(given<RemoveSkimmer>({"skimmer", "rig", "--remove"}).name, "rig");
}

TEST_F(CtlOil, SendsProbes) {
  EXPECT_EQ(ask({"probe", "7", "30", "5"}).code, 0);
  EXPECT_EQ(ask({"probe", "8", "-21", "0", "-2", "--body", "1"}).code, 0);
  EXPECT_EQ(ask({"probe", "7", "--remove"}).code, 0);
  const auto all = commands();
  ASSERT_EQ(all.size(), 3U);
  const ProbeSettings staff = std::get<SetProbe>(all[0]).probe, bow = std::get<SetProbe>(all[1]).probe;
  EXPECT_EQ(staff.id, 7U);
  EXPECT_TRUE(staff.at_surface) << "no Z is given";
  EXPECT_EQ(bow.position, Eigen::Vector3d(-21, 0, -2));
  EXPECT_EQ(bow.body, 1U);
  EXPECT_EQ(std::get<RemoveProbe>(all[2]).id, 7U);
}

TEST_F(CtlOil, CanBeGivenForATime) {
  now_ = 50.0;
  EXPECT_EQ(ask({"spill", "12", "20", "--volume", "2", "--at", "60"}).out, "scheduled as 1\n");
  EXPECT_EQ(ask({"boom", "north", "--remove", "--at", "70"}).out, "scheduled as 2\n");
  ASSERT_EQ(scheduled().size(), 2U);
  EXPECT_EQ(scheduled()[0].at, 60.0);
  const Outcome past = ask({"skimmer", "rig", "1", "2", "--at", "49"});
  EXPECT_EQ(past.code, 1);
  EXPECT_THAT(past.err, HasSubstr("command.at: 49 s has passed; the present simulated time is 50 s"));
}

TEST_F(CtlOil, FailsWithTheServersWords) {
  EXPECT_THAT(ask({"release", "a", "--from", "1", "2", "3", "--rate", "0"}).err,
              HasSubstr("command.release_oil.rate: 0 is out of range; allowed: 0.001 to 1000000 m^3/h"));
  EXPECT_THAT(ask({"boom", "b", "1", "1", "1.05", "1"}).err,
              HasSubstr("command.set_boom.point[1]: is 0.05 m from the point before; allowed: at least 0.1 m"));
  EXPECT_TRUE(commands().empty());
}

TEST_F(CtlOil, IsToldAtOnceWhatDoesNotFitTheScene) {
  EXPECT_THAT(ask({"release", "a", "--from", "70", "20", "8", "--rate", "1"}).err,
              HasSubstr("command.release_oil.from: (70, 20, 8) m is outside the patch; allowed: (0, 0, 0) to "
                        "(60, 40, 16) m [INVALID_VALUE]"));
  EXPECT_THAT(ask({"release", "a", "--from", "70", "20", "8", "--rate", "1", "--body", "9"}).err,
              HasSubstr("command.release_oil.body: the scene has no body 9; allowed: 1, 2"));
  EXPECT_THAT(ask({"probe", "1", "70", "20"}).err, HasSubstr("command.set_probe.position: (70, 20) m is outside"));
  const Outcome timed = ask({"spill", "1", "-20", "--volume", "1", "--at", "60", "--json"});
  EXPECT_EQ(timed.code, 1);
  EXPECT_EQ(nlohmann::json::parse(timed.out)["error"]["field"], "command.spill_oil.position");
  EXPECT_TRUE(commands().empty());
  EXPECT_TRUE(scheduled().empty());
}

TEST_F(CtlOil, IsToldThatTheSceneHasNoOil) {
  around_.oil.reset();
  EXPECT_THAT(ask({"spill", "1", "20", "--volume", "1"}).err, HasSubstr("the scene has no oil"));
}

TEST(CtlOilAlone, RefusesWrongCommandLines) {
  const std::vector<std::vector<std::string>> wrong{
      {"release"},
      {"release", "hose"},
      {"release", "hose", "--rate", "3"},
      {"release", "hose", "--from", "1", "2", "3"},
      {"release", "hose", "--from", "1", "2", "--rate", "3"},
      {"release", "hose", "--stop", "--rate", "3"},
      {"spill", "1", "2"},
      {"spill", "1", "--volume", "3"},
      {"spill", "1", "2", "3", "--volume", "3"},
      {"boom"},
      {"boom", "north"},
      {"boom", "north", "1", "2"},
      {"boom", "north", "1", "2", "3"},
      {"boom", "north", "1", "2", "3", "4", "5"},
      {"boom", "north", "1", "2", "3", "x"},
      {"boom", "north", "1", "2", "3", "4", "--remove"},
      {"skimmer", "rig"},
      {"skimmer", "rig", "1"},
      {"skimmer", "rig", "1", "2", "3"},
      {"skimmer", "rig", "--remove", "--radius", "2"},
      {"probe", "1"},
      {"probe", "1", "2"},
      {"probe", "1", "2", "3", "4", "5"},
      {"probe", "-1", "2", "3"},
      {"probe", "1", "--remove", "--body", "2"},
  };
  for (const auto& arguments : wrong) {
    std::vector<const char*> argv{"pelagos-ctl"};
    for (const std::string& argument : arguments) argv.push_back(argument.c_str());
    std::ostringstream out, err;
    EXPECT_EQ(run_ctl(static_cast<int>(argv.size()), argv.data(), out, err), 2) << testing::PrintToString(arguments);
    EXPECT_FALSE(err.str().empty()) << testing::PrintToString(arguments);
  }
}

OilBudget some_budget() {
  OilBudget oil;
  oil.ledger = {12'345'678'901'000, 10'345'678'900'500, 1'000'000'000'000, 0, 999'999'500'000, 500'500, 0};
  EXPECT_EQ(oil.ledger.balance(), 0);
  oil.elements = 12;
  oil.area = 456.7;
  oil.mean_thickness = 2.5e-3;
  oil.largest_thickness = 0.031;
  oil.emulsion_water = 0.5;
  oil.held_back = 3.25;
  oil.sources = {{"hose", SourceWait::kNone, 0.0, 1.0}, {"keel", SourceWait::kNoWater, 12.0, 33.0}};
  oil.skimmers = {{"rig", 999'999'500'000, 18.5, false}, {"spare", 0, 0.0, true}};
  oil.booms = {"north", "south", "west"};
  return oil;
}

TEST_F(CtlOil, StatusPrintsTheLedgerForPeople) {
  status_.oil = some_budget();
  const Outcome outcome = ask({"status"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("oil        12346 t released: 10346 t afloat, 1000 t contained, 0 kg submerged, "
                                     "1000 t recovered, 500 g evaporated, 0 kg left the patch\n"));
  EXPECT_THAT(outcome.out, HasSubstr("slick of 456.7 m^2, 2.5 mm thick in the mean, at most 31 mm, 0.5 m^3 of water in "
                                     "it\n"));
  EXPECT_THAT(outcome.out, HasSubstr("3.25 kg could not flow out\n"));
  EXPECT_THAT(outcome.out, HasSubstr("release hose: flows\n"));
  EXPECT_THAT(outcome.out, HasSubstr("release keel: waits for 12 s, no water near it, 33 kg held back\n"));
  EXPECT_THAT(outcome.out, HasSubstr("skimmer rig: 1000 t, now 18.5 m^3/h\n"));
  EXPECT_THAT(outcome.out, HasSubstr("skimmer spare: 0 kg, now 0 m^3/h, dry\n"));
  EXPECT_THAT(outcome.out, HasSubstr("3 of 100 booms (4000 points in all), 2 of 100 skimmers"));
}

TEST_F(CtlOil, StatusSaysThinFilmsInMicrometres) {
  status_.oil = some_budget();
  status_.oil->mean_thickness = 4.5e-6;
  EXPECT_THAT(ask({"status"}).out, HasSubstr("4.5 um thick"));
}

TEST_F(CtlOil, StatusPrintsTheLedgerForMachines) {
  status_.oil = some_budget();
  const auto oil = nlohmann::json::parse(ask({"status", "--json"}).out)["oil"];
  EXPECT_NEAR(oil["released"].get<double>(), 12345678.901, 1e-6);
  EXPECT_NEAR(oil["evaporated"].get<double>(), 0.5005, 1e-9);
  EXPECT_EQ(oil["held_back"], 3.25);
  EXPECT_EQ(oil["release"][1]["wait"], "NO_WATER");
  EXPECT_EQ(oil["skimmer"][1]["dry"], true);
}

TEST_F(CtlOil, StatusSaysNothingOfOilWhereThereIsNone) {
  EXPECT_THAT(ask({"status"}).out, Not(HasSubstr("oil")));
  EXPECT_FALSE(nlohmann::json::parse(ask({"status", "--json"}).out).contains("oil"));
}

}  // namespace
}  // namespace pelagos
