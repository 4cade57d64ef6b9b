#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/door/app/command/command.h"
#include "tests/door/app/programs.h"
#include "tests/support/corpus.h"
#include "tests/support/rs274.h"
#include "tests/support/stl_text.h"

// Plans of the examples with one thing changed, as users change them, end to end.

namespace capstan::app {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

class Planned : public ::testing::Test {
 protected:
  int run(const std::string& arguments) {
    const std::string line =
        "cd '" + folder_.string() + "' && " + command_quoted() + " " + arguments + " >out 2>&1";
    const int status = std::system(line.c_str());
    said_ = slurp(folder_ / "out");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  /// An example with texts replaced, as p.p21.
  void part(const std::string& example, const std::vector<std::pair<std::string, std::string>>& changes) {
    std::string text = slurp(fs::path(capstan::testing::source_dir()) / "examples" / example);
    for (const auto& [from, to] : changes) {
      const auto at = text.find(from);
      ASSERT_NE(at, std::string::npos) << from;
      text.replace(at, from.size(), to);
    }
    std::ofstream(folder_ / "p.p21", std::ios::binary) << text;
  }

  ::capstan::testing::ScratchFolder scratch_;
  fs::path folder_ = scratch_.path();
  std::string said_;
};

TEST_F(Planned, AHoleDeeperThanItsEndMillsFlutesIsMilledInTurnsThatTheyReach) {
  part("two_setups.p21",
       {{"#70=TOLERANCED_LENGTH_MEASURE(6.6,#25);",
         "#70=TOLERANCED_LENGTH_MEASURE(16.5,#225);\n#225=PLUS_MINUS_VALUE(0.043,0.,4);"},
        // Its counterbore from below is wider than it still.
        {"#95=TOLERANCED_LENGTH_MEASURE(11.,#25);", "#95=TOLERANCED_LENGTH_MEASURE(20.,#25);"}});
  EXPECT_EQ(run("plan p.p21 -o p.json -o p.ngc"), 0) << said_;
}

TEST_F(Planned, NoProgramIsWrittenThatTheCheckCondemnsAndAnOldOneIsPutAside) {
  part("bracket.p21", {});
  std::ofstream(folder_ / "x.ngc") << "(a program from before)\n";
  std::ofstream(folder_ / "x.tbl") << "T1 P1 Z+1 D+1 ;from before\n";
  // Operations, tools and depths of a strong machine are asked of a weak one.
  ASSERT_EQ(run("plan p.p21 -o strong.json"), 0) << said_;
  EXPECT_EQ(run("plan strong.json --machine small_router --reopen technology -o x.ngc -o x.tbl -o x.json -o "
                "x.p21 -o x.stpnc"),
            1)
      << said_;
  EXPECT_THAT(said_, HasSubstr("x.ngc: error: program not written: "));
  EXPECT_THAT(said_, HasSubstr("x.tbl: error: tool table not written: "));
  EXPECT_THAT(said_,
              ::testing::ContainsRegex("NOT SAFE: [0-9]+ findings?, no program written; .*; wrote x.json"));
  EXPECT_THAT(said_, HasSubstr("renamed to x.ngc.before"));
  EXPECT_THAT(said_, HasSubstr("tool table x.tbl from before is not of this plan, and stays"));
  EXPECT_FALSE(fs::exists(folder_ / "x.ngc"));
  EXPECT_EQ(slurp(folder_ / "x.ngc.before"), "(a program from before)\n");
  EXPECT_EQ(slurp(folder_ / "x.tbl"), "T1 P1 Z+1 D+1 ;from before\n");
  EXPECT_EQ(run("plan p.p21 --allow-findings --strict -o x.ngc"), 2) << said_;
}

TEST_F(Planned, ALimitThatNoFeedKeepsCondemnsTheProgramHoweverThePlanIsBrought) {
  part("bracket.p21", {});
  // Operations, tools and depths of a strong machine are asked of a weak one.
  ASSERT_EQ(run("plan p.p21 -o strong.json"), 0) << said_;
  const std::string weak = "--machine small_router --reopen technology ";
  EXPECT_EQ(run("plan strong.json " + weak + "-o x.ngc -o x.json"), 1) << said_;
  EXPECT_THAT(said_, ::testing::ContainsRegex("warning: step '.*': spindle (torque|power) [0-9.]+ of [0-9.]+ "
                                              "(Nm|W) at X[-0-9.]+ Y[-0-9.]+, even at the least feed; use a "
                                              "smaller tool or depth .PIP-EXCESS."));
  EXPECT_THAT(said_, HasSubstr("program not written: step "));
  EXPECT_FALSE(fs::exists(folder_ / "x.ngc"));
  EXPECT_EQ(run("check x.json"), 1);
  EXPECT_THAT(said_, ::testing::ContainsRegex(
                         "error: step '.*': spindle .* use a smaller tool or depth .PIP-EXCESS."));
  // The plan as it is, brought back: its limits are exceeded still.
  EXPECT_EQ(run("plan x.json --machine small_router -o y.ngc"), 1) << said_;
  EXPECT_THAT(said_, HasSubstr("PIP-EXCESS"));
  EXPECT_FALSE(fs::exists(folder_ / "y.ngc"));
}

TEST_F(Planned, AllowFindingsWritesTheProgramWithAStopBeforeEachCondemnedStep) {
  part("bracket.p21", {});
  ASSERT_EQ(run("plan p.p21 -o strong.json"), 0) << said_;
  EXPECT_EQ(run("plan strong.json --machine small_router --reopen technology --allow-findings -o x.ngc -o "
                "x.tbl -o x.json"),
            1)
      << said_;
  EXPECT_THAT(said_, HasSubstr("NOT SAFE: "));
  EXPECT_THAT(said_, HasSubstr("the program stops before what is condemned; step "));
  const std::string program = slurp(folder_ / "x.ngc");
  EXPECT_THAT(program, HasSubstr("(CONDEMNED: the check refuses this program"));
  const auto marker = program.find("condemned=\"PIP-EXCESS\")\n");
  ASSERT_NE(marker, std::string::npos);
  EXPECT_LT(program.find("\nM0\n", marker), program.find("\nG43", marker));
  // The check of such a program does not blame its stops: it finds of the text what it finds of the plan.
  (void)run("check x.json x.ngc x.tbl");
  EXPECT_THAT(said_, Not(HasSubstr("STOP"))) << said_;
  EXPECT_THAT(said_, Not(HasSubstr("CHK-TEXT"))) << said_;
  EXPECT_THAT(said_, Not(HasSubstr("CHK-RESTART"))) << said_;
  if (::capstan::testing::rs274_available()) {
    const auto ran = ::capstan::testing::run_rs274(slurp(folder_ / "x.tbl"), program);
    EXPECT_EQ(ran.status, 0) << ran.output;
    EXPECT_FALSE(ran.only({"PROGRAM_STOP"}).empty());
  }
}

TEST_F(Planned, BindPastItsDeadlineEndsWithFive) {
  const std::string source = capstan::testing::source_dir();
  const std::string bind = "bind '" + source + "/examples/plate_bound.p21' --tools '" + source +
                           "/tests/door/late/magazine.tbl' -o x.ngc -o x.json";
  EXPECT_EQ(run(bind + " --deadline 1ms"), 5) << said_;
  EXPECT_THAT(said_, HasSubstr("Safe, too late: the deadline was past"));
  EXPECT_TRUE(fs::exists(folder_ / "x.ngc"));  // checked, but late
  EXPECT_EQ(run(bind + " --deadline 600s"), 0) << said_;
  EXPECT_EQ(run(bind), 0) << said_;  // nobody waits
}

TEST_F(Planned, AMeasuredNameThatNoStatementReadsIsWrongUsage) {
  const std::string source = capstan::testing::source_dir();
  EXPECT_EQ(run("bind '" + source + "/examples/plate_bound.p21' --tools '" + source +
                "/tests/door/late/magazine.tbl' --measured wall=0.04 -o x.json"),
            2)
      << said_;
  EXPECT_THAT(said_, HasSubstr("unknown measured variable 'wall'"));
  EXPECT_FALSE(fs::exists(folder_ / "x.json"));
}

TEST_F(Planned, CoordinatesOfAKilometreAreAnErrorOfTheFileAndNoFaultOfTheProgram) {
  for (const char* point : {"#49=CARTESIAN_POINT('POCKET',(48.", "#24=CARTESIAN_POINT('RAW PIECE',(0.",
                            "#32=CARTESIAN_POINT('WORKPIECE',(0."}) {
    const std::string from = point;
    part("bracket.p21", {{from, from.substr(0, from.find('(', from.find('(') + 1) + 1) + "1.E6"}});
    EXPECT_EQ(run("plan p.p21 -o p.json"), 4) << said_;  // as a raw piece larger than any machine
    EXPECT_THAT(said_, HasSubstr("CARTESIAN_POINT.coordinates is 1000000; it can be -100000 to 100000"));
    EXPECT_THAT(said_, Not(HasSubstr("fault of the program itself")));
  }
}

TEST_F(Planned, BindWithoutToolsTakesThoseOfThePlanInTheirPockets) {
  part("two_setups.p21", {});
  ASSERT_EQ(run("plan p.p21 -o p.json -o p.o.p21 -o p.tbl"), 0) << said_;
  for (const char* form : {"p.json", "p.o.p21"}) {
    EXPECT_EQ(run(std::string("bind ") + form + " -o b.ngc -o b.tbl"), 0) << said_;
    EXPECT_THAT(said_, HasSubstr("count as loaded, in the plan's tool numbers"));
    EXPECT_EQ(slurp(folder_ / "b.tbl"), slurp(folder_ / "p.tbl")) << form;
  }
}

TEST_F(Planned, AWideFittedHoleIsRoughedWithinTheRampOfItsCutter) {
  part("two_setups.p21",
       {{"#70=TOLERANCED_LENGTH_MEASURE(6.6,#25);",
         "#70=TOLERANCED_LENGTH_MEASURE(20.,#225);\n#225=PLUS_MINUS_VALUE(0.021,0.,4);"},
        {"CARTESIAN_POINT('HOLE 1',(12.,30.,0.))", "CARTESIAN_POINT('HOLE 1',(14.,28.,0.))"}});
  (void)run("plan p.p21 -o p.json -o p.ngc");
  EXPECT_THAT(said_, Not(HasSubstr("CHK-"))) << said_;
}

TEST_F(Planned, AShoulderAroundAHoleOfAnotherFeatureNeedsNoCentring) {
  part("two_setups.p21", {});
  ASSERT_EQ(run("plan p.p21 -o p.json -o p.ngc"), 0) << said_;
  ASSERT_EQ(run("explain p.json"), 0) << said_;
  EXPECT_THAT(said_, HasSubstr("COUNTERBORE 1 mill_rough"));
  EXPECT_THAT(said_, Not(HasSubstr("COUNTERBORE 1 centre")));
  EXPECT_THAT(said_, Not(HasSubstr("COUNTERBORE 1 drill")));
}

TEST_F(Planned, EdgesThatNoRuleBreaksAreRefusedWithTheRange) {
  part("two_setups.p21", {});
  for (const char* width : {"2", "3", "0.01"}) {
    EXPECT_EQ(run(std::string("plan p.p21 -o p.json --edges ") + width), 2) << said_;
    EXPECT_THAT(said_, HasSubstr("from 0.05 to below 2 mm"));
  }
}

TEST_F(Planned, FeaturesWhoseEdgesStaySharpSaySoOnce) {
  part("two_setups.p21", {});
  (void)run("plan p.p21 -o p.json --edges 0.3");
  const auto first = said_.find("'TOP SLOT': its edges are not broken");
  ASSERT_NE(first, std::string::npos) << said_;
  EXPECT_EQ(said_.find("'TOP SLOT': its edges", first + 1), std::string::npos) << said_;
}

TEST_F(Planned, AToleranceWiderThanItsSizeIsDoubted) {
  part("two_setups.p21", {{"#70=TOLERANCED_LENGTH_MEASURE(6.6,#25);",
                           "#70=TOLERANCED_LENGTH_MEASURE(6.6,#225);\n#225=PLUS_MINUS_VALUE(100.,0.,4);"}});
  (void)run("plan p.p21 -o p.json");
  EXPECT_THAT(said_, HasSubstr("MDL-TOLERANCE")) << said_;
  part("two_setups.p21", {{"#70=TOLERANCED_LENGTH_MEASURE(6.6,#25);",
                           "#70=TOLERANCED_LENGTH_MEASURE(6.6,#225);\n#225=PLUS_MINUS_VALUE(0.,8.,4);"}});
  EXPECT_EQ(run("plan p.p21 -o p.json"), 1) << said_;
  EXPECT_THAT(said_, HasSubstr("the tolerance swallows the size")) << said_;
}

TEST_F(Planned, RulesOfAShopThatContradictEachOtherAreWarnedOf) {
  part("two_setups.p21", {});
  fs::create_directory(folder_ / "shop");
  std::ofstream(folder_ / "shop/a.yaml") << R"(table: hole
rows:
  - {id: shop.drill, priority: 50, when: {bottom: [through], diameter_mm: {from: 3, below: 4}, it_grade: {from: 11, to: 12}},
     cannot: "not here", source: shop}
)";
  (void)run("plan p.p21 -o p.json --rules shop");
  EXPECT_THAT(said_, HasSubstr("hole.drill and shop.drill conclude differently")) << said_;
}

TEST_F(Planned, WorkholdingThatCannotBeReadEndsWithThree) {
  part("two_setups.p21", {});
  EXPECT_EQ(run("plan p.p21 -o p.json --workholding nowhere.yaml"), 3) << said_;
  std::ofstream(folder_ / "bad.yaml") << "setups: 5\n";
  EXPECT_EQ(run("plan p.p21 -o p.json --workholding bad.yaml"), 3) << said_;
}

/// A paraboloid of 60 x 60 mm as a sheet.
geometry::Mesh dome() {
  constexpr std::uint32_t n = 24;
  geometry::Mesh m;
  for (std::uint32_t j = 0; j <= n; ++j) {
    for (std::uint32_t i = 0; i <= n; ++i) {
      const double x = 60.0 * i / n, y = 60.0 * j / n;
      m.vertices.push_back({x, y, -0.006 * ((x - 30) * (x - 30) + (y - 30) * (y - 30))});
      if (i == n || j == n) continue;
      const std::uint32_t a = j * (n + 1) + i;
      m.triangles.push_back({a, a + 1, a + n + 2});
      m.triangles.push_back({a, a + n + 2, a + n + 1});
    }
  }
  return m;
}

TEST_F(Planned, ASurfaceWhoseFinishNoBallMakesIsNotPlannedAndSaysWhichLimitHoldsIt) {
  std::ofstream(folder_ / "dome.stl") << ::capstan::testing::stl_text(dome());
  std::ofstream(folder_ / "t.yaml") << "capstan_tools: 1\nunit: mm\ntools:\n"
                                       "  - {id: em12, class: endmill, cutting_diameter: 12, teeth: 3, "
                                       "stick_out: 40, substrate: carbide}\n"
                                       "  - {id: ball3, class: ball_endmill, cutting_diameter: 3, teeth: 2, "
                                       "stick_out: 60, usable_length: 20, substrate: carbide}\n";
  EXPECT_NE(run("plan dome.stl --tools t.yaml --material C45 -o d.json"), 0);
  EXPECT_THAT(
      said_, HasSubstr("is not planned: no way to make it works; step 'surface freeform_finish' has no path: "
                       "ball3: tool deflection "));
  // The finish is not left out as a rest of roughing is, for the check to find that all of it stands.
  EXPECT_THAT(said_, Not(HasSubstr("CHK-LEFT")));
}

}  // namespace
}  // namespace capstan::app
