// pelagos-ctl surface.

#include <nlohmann/json.hpp>

#include "ctl_test.hpp"

namespace pelagos {
namespace {

using test::Outcome;
using testing::HasSubstr;

class CtlSurface : public test::CtlTest {};

TEST_F(CtlSurface, PrintsATable) {
  status_.simulation_time = 7.5;
  const Outcome people = ask({"surface", "--at", "8,0", "--at", "60,-3.5", "--at=-2000,1", "--at=-4,2"});
  EXPECT_EQ(people.code, 0) << people.err;
  EXPECT_EQ(people.out,
            "at 7.500 s\n"
            "       x m        y m  height m  slope deg  falls to  east m/s  north m/s  up m/s  from\n"
            "      8.00       0.00     2.000       14.0       270      1.50      -0.25    0.12  particles\n"
            "     60.00      -3.50    15.000       14.0       270      1.50      -0.25    0.12  blended\n"
            "  -2000.00       1.00                                                              no water\n"
            "     -4.00       2.00    -1.000       14.0       270      1.50      -0.25    0.12  particles\n");
  EXPECT_THAT(ask({"surface", "--at", "400,0", "--ahead", "2.5"}).out,
              testing::AllOf(HasSubstr("at 10.000 s, 2.5 s ahead\n"), HasSubstr("wave field\n")));
}

TEST_F(CtlSurface, PrintsJson) {
  const Outcome machines = ask({"surface", "--json", "--at", "8,0", "--at", "400,0"});
  EXPECT_EQ(machines.code, 0) << machines.err;
  const auto json = nlohmann::json::parse(machines.out);
  ASSERT_EQ(json["place"].size(), 2u);
  EXPECT_EQ(json["place"][0]["source"], "PARTICLES");
  EXPECT_EQ(json["place"][1]["height"], 100.0);
}

TEST_F(CtlSurface, RefusesWhatIsNoPlace) {
  for (const std::string wrong : {"8", "8,9,10", "8;9", "a,b", "8,"}) {
    const Outcome outcome = ask({"surface", "--at", wrong});
    EXPECT_EQ(outcome.code, 2) << wrong;
    EXPECT_THAT(outcome.err, HasSubstr("--at " + wrong + " is no place; allowed: X,Y"));
  }
  EXPECT_EQ(ask({"surface"}).code, 2);
  EXPECT_THAT(ask({"surface", "--at", "1e9,0"}).err, HasSubstr("query_surface.place[0].x: 1000000000 is out of range"));
  EXPECT_THAT(ask({"surface", "--at", "1,0", "--ahead", "7"}).err, HasSubstr("query_surface.ahead: 7 is out of range"));
}

TEST_F(CtlSurface, TheStatusCountsQueries) {
  EXPECT_THAT(ask({"status"}).out, testing::Not(HasSubstr("queries")));
  stop();
  status_.surface_queries = {120, 3};
  EXPECT_THAT(ask({"status"}).out, HasSubstr("queries    120 of the surface answered, 3 refused\n"));
}

}  // namespace
}  // namespace pelagos
