#include "tests/door/app/command/edits/edits.h"

#include <gmock/gmock.h>

#include <sstream>

// A person's own decisions: examples/bracket.p21 planned with one thing set, held, bounded, ruled out or put
// first, end to end.

namespace capstan::app {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(Edits, AToolThatIsSetIsBoundByTheOperatorAndWhatDependsOnItIsPlannedAnew) {
  ASSERT_EQ(plan("before", "").code, 0);
  const Ran r = plan("after", std::string("--set 'POCKET area_rough/tool=") + kEm8 + "'");
  ASSERT_EQ(r.code, 0) << r.err;
  auto before = steps_of("before"), after = steps_of("after");
  ASSERT_EQ(before.size(), 14U);
  ASSERT_EQ(after.size(), 14U);
  const json& rough = after.at("POCKET area_rough");
  EXPECT_EQ(rough["cutter_id"], kEm8);
  EXPECT_NE(rough["feed_mm_min"], before.at("POCKET area_rough")["feed_mm_min"]);
  const std::string said = why("after", "POCKET area_rough", "its_tool");
  EXPECT_THAT(said, HasSubstr("operator"));
  EXPECT_THAT(said, HasSubstr("--set: set POCKET area_rough/tool=generic/endmill_3f_short/8"));
  EXPECT_THAT(said, Not(HasSubstr("tool_selection")));
  // Of its feature's later step tool and operation stay; of all others everything.
  EXPECT_EQ(after.at("POCKET area_finish")["cutter_id"], before.at("POCKET area_finish")["cutter_id"]);
  for (auto& [name, step] : before) {
    if (name.starts_with("POCKET")) continue;
    EXPECT_EQ(kept(after.at(name)), kept(step)) << name;
  }
  EXPECT_EQ(run("check after.json after.ngc").code, 0);
}

TEST_F(Edits, FeedSpeedAndDepthThatAreSetStandInTheProgram) {
  const Ran r = plan("a",
                     "--set 'SLOT area_rough/feed=1111' --set 'SLOT area_finish/speed=7777' "
                     "--set 'POCKET area_rough/depth=4'");
  ASSERT_EQ(r.code, 0) << r.err;
  auto steps = steps_of("a");
  EXPECT_EQ(steps.at("SLOT area_rough")["feed_mm_min"], 1111.0);
  EXPECT_EQ(steps.at("SLOT area_finish")["spindle_rpm"], 7777.0);
  EXPECT_EQ(steps.at("POCKET area_rough")["axial_depth_mm"], 4.0);
  const std::string program = slurp(folder_ / "a.ngc");
  EXPECT_THAT(program, HasSubstr("S7777"));
  const auto f = feeds("a");
  EXPECT_NE(std::find(f.begin(), f.end(), 1111.0), f.end());
  EXPECT_THAT(why("a", "SLOT area_rough", "feedrate"), HasSubstr("--set: set SLOT area_rough/feed=1111"));
  EXPECT_EQ(run("check a.json a.ngc").code, 0);
}

// LinuxCNC's holes are moves where nothing else is said.
TEST_F(Edits, TheCyclesOfAStepAreWhatIsSaidOfItAndAllElseStays) {
  const auto steps_with_cycles = [&](const std::string& file) {
    std::vector<std::string> out;
    std::string step;
    std::istringstream lines(slurp(folder_ / file));
    for (std::string l; std::getline(lines, l);) {
      if (l.starts_with("(CAPSTAN STEP ")) step = l.substr(0, l.find(" n="));
      if (l.starts_with("G98 G8") && (out.empty() || out.back() != step)) out.push_back(step);
    }
    return out;
  };
  const Ran r = plan("a", "--set 'DOWEL*/cycles=feature' -o a.edits.yaml");
  ASSERT_EQ(r.code, 0) << r.err;
  const auto made = steps_with_cycles("a.ngc");
  ASSERT_FALSE(made.empty());
  for (const std::string& step : made) EXPECT_THAT(step, HasSubstr("DOWEL"));
  EXPECT_EQ(run("check a.json a.ngc").code, 0);
  ASSERT_EQ(plan("plain", "").code, 0);
  EXPECT_THAT(steps_with_cycles("plain.ngc"), ::testing::IsEmpty());
  auto before = steps_of("plain"), after = steps_of("a");
  for (auto& [name, step] : before) EXPECT_EQ(kept(after.at(name)), kept(step)) << name;
  // Kept beside the plan and in it.
  EXPECT_THAT(slurp(folder_ / "a.edits.yaml"), HasSubstr("cycles=feature"));
  ASSERT_EQ(plan("b", "--edits a.edits.yaml").code, 0);
  EXPECT_EQ(slurp(folder_ / "b.ngc"), slurp(folder_ / "a.ngc"));
}

TEST_F(Edits, CyclesAreRefusedForAControlThatHasNone) {
  const Ran r = plan("a", "--control grbl --set 'DOWEL*/cycles=feature'");
  EXPECT_NE(r.code, 0);
  EXPECT_THAT(r.err, HasSubstr("EDIT-VALUE"));
  EXPECT_THAT(r.err, HasSubstr("has no cycles"));
}

TEST_F(Edits, APinHoldsWhatWasPlannedAndIsWrittenWithIt) {
  const Ran r = plan("a", "--pin 'SLOT*/tool' --pin 'SLOT area_rough/feed' -o a.edits.yaml");
  ASSERT_EQ(r.code, 0) << r.err;
  ASSERT_EQ(plan("b", "").code, 0);
  EXPECT_EQ(slurp(folder_ / "a.ngc"), slurp(folder_ / "b.ngc")) << "the plan is as without it";
  const std::string edits = slurp(folder_ / "a.edits.yaml");
  EXPECT_THAT(edits, HasSubstr("pin: \"SLOT area_rough/tool=" + std::string(kEm8) + "\""));
  EXPECT_THAT(edits, HasSubstr("pin: \"SLOT area_finish/tool="));
  EXPECT_THAT(edits, HasSubstr("pin: \"SLOT area_rough/feed="));
  EXPECT_THAT(why("a", "SLOT area_rough", "its_tool"), HasSubstr("operator"));
}

TEST_F(Edits, LimitsHoldOnEveryMoveAndAreNamedInTheReasons) {
  const Ran r = plan("a", "--limit 'feed<=800' --limit 'speed<=6000' --limit 'POCKET*/tool.diameter<=8'");
  ASSERT_EQ(r.code, 0) << r.err;
  for (const double f : feeds("a")) EXPECT_LE(f, 800.0);
  for (const auto& [name, step] : steps_of("a")) {
    EXPECT_LE(std::abs(step["spindle_rpm"].get<double>()), 6000.0) << name;
    if (name.starts_with("POCKET")) {
      EXPECT_NE(step["cutter_id"].get<std::string>().find("/8"), std::string::npos)
          << name << step["cutter_id"];
    }
  }
  EXPECT_THAT(why("a", "SLOT area_rough", "feedrate"), HasSubstr("--limit: limit feed<=800"));
  EXPECT_EQ(run("check a.json a.ngc").code, 0);
}

TEST_F(Edits, WhatIsForbiddenIsNotChosen) {
  const Ran r = plan("a", "--forbid 'DOWEL*/operation=reaming' --forbid 'tool=" + std::string(kEm8) +
                              "' --forbid 'POCKET*/strategy=constant_engagement'");
  // Without a reamer the dowel holes may find another way or none; nothing is reamed.
  EXPECT_LE(r.code, 1) << r.err;
  const json without = read("a");
  for (const auto& s : without["steps"]) EXPECT_NE(s["cutter_id"], kEm8);
  EXPECT_THAT(run("explain a.json").out, Not(HasSubstr("REAMING")));
}

TEST_F(Edits, AnOrderIsKept) {
  const auto place = [&](const std::string& name, const std::string& step) {
    const std::string text = run("explain " + name + ".json").out;
    const auto from = text.find("Steps, in order");
    return text.find(step, from);
  };
  ASSERT_EQ(plan("before", "").code, 0);
  ASSERT_LT(place("before", "POCKET area_rough"), place("before", "SLOT area_rough"));
  const Ran r = plan("a", "--order 'SLOT*<POCKET*'");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_LT(place("a", "SLOT area_finish"), place("a", "POCKET area_rough"));
  // One that contradicts itself is no plan.
  const Ran both = plan("b", "--order 'SLOT*<POCKET*' --order 'POCKET*<SLOT*'");
  EXPECT_GT(both.code, 1);
  EXPECT_THAT(both.err, HasSubstr("order POCKET*<SLOT*"));
}

TEST_F(Edits, AFileOfThemBesideThePartOrAnOutputIsToldAndNotUsed) {
  put("bracket.edits.yaml", "capstan_edits: 1\nedits:\n  - limit: \"feed<=1500\"\n");
  put("a.edits.yaml", slurp(folder_ / "bracket.edits.yaml"));
  const Ran r = run("plan bracket.p21 --bind none -o a.json");
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_THAT(
      r.err,
      HasSubstr("bracket.edits.yaml: note: this file of edits lies beside bracket.p21 and is not used; "
                "--edits bracket.edits.yaml plans with it [EDIT-BESIDE]"));
  EXPECT_THAT(r.err, HasSubstr("a.edits.yaml: note:"));
  EXPECT_THAT(slurp(folder_ / "a.json"), Not(HasSubstr("feed<=1500")));
  const Ran named = run("plan bracket.p21 --edits a.edits.yaml --bind none -o b.json");
  EXPECT_THAT(named.err, Not(HasSubstr("EDIT-BESIDE")));
}

TEST_F(Edits, AnOrderThatLeavesAFeatureOutIsNamedWithIt) {
  const Ran r = plan("a", "--order 'M6<M6 CORE'");
  EXPECT_EQ(r.code, 1) << r.err;
  const std::regex unplanned(R"([^\n]*'M6'[^\n]*is not planned[^\n]*wanted is --order: order M6<M6 CORE)");
  EXPECT_TRUE(std::regex_search(r.err, unplanned)) << r.err;
  EXPECT_THAT(r.err, HasSubstr("order M6<M6 CORE orders nothing: it names 'M6', which is not planned"));
}

TEST_F(Edits, AnOrderWhoseStepItMadeImpossibleSaysSo) {
  const Ran r = plan("a", "--order 'M6 tap<M6 CORE'");
  EXPECT_GT(r.code, 1);
  EXPECT_THAT(r.err, HasSubstr("order M6 tap<M6 CORE: 'M6 tap' names no feature and no workingstep"));
  EXPECT_THAT(r.err, HasSubstr("the step 'M6 tap' was planned, and is no longer, because the check found"));
  EXPECT_THAT(r.err, HasSubstr("leave the order out, or turn it round"));
}

TEST_F(Edits, OneThatBreaksALimitIsNamedBesideItAndNoProgramIsWritten) {
  const Ran r = plan("a", "--set 'SLOT area_rough/feed=9000'");
  EXPECT_EQ(r.code, 1) << r.err;
  EXPECT_THAT(r.err, HasSubstr("--set: set SLOT area_rough/feed=9000"));
  const std::regex both(R"([^\n]*SLOT area_rough[^\n]* of [^\n]*set SLOT area_rough/feed=9000)");
  EXPECT_TRUE(std::regex_search(r.err, both)) << r.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.ngc"));
}

TEST_F(Edits, ThatContradictEachOtherAreRefusedWithBoth) {
  const Ran r = plan("a", "--set 'SLOT*/feed=1500' --limit 'feed<=1000'");
  EXPECT_EQ(r.code, 2) << r.err;
  EXPECT_THAT(r.err, HasSubstr("set SLOT*/feed=1500"));
  EXPECT_THAT(r.err, HasSubstr("limit feed<=1000"));
  EXPECT_TRUE(files() == std::vector<std::string>{"bracket.p21"});
}

TEST_F(Edits, UnknownNamesAndPatternsThatMeanNothingAreRefused) {
  for (const auto& [options, word] :
       {std::pair("--set 'POCKET/tool=generic/endmil_3f_short/8'", "generic/endmill_3f_short/8"),
        std::pair("--set 'POCKET/fed=5'", "feed"), std::pair("--forbid operation=reeming", "reaming"),
        std::pair("--set 'PCKET*/feed=500'", "POCKET"), std::pair("--limit 'SLIT/feed<=500'", "SLOT"),
        std::pair("--set 'SLOT*/tool=T77'", "T8"), std::pair("--set 'M6 tap/feed=100'", "pitch"),
        std::pair("--set 'M6 tap/depth=1'", "no depth")}) {
    const Ran r = plan("a", options);
    EXPECT_EQ(r.code, 2) << options << r.err;
    EXPECT_THAT(r.err, HasSubstr(word)) << options;
  }
  EXPECT_EQ(files(), std::vector<std::string>{"bracket.p21"});
}

TEST_F(Edits, AFileOfThemSurvivesPlanningAgain) {
  ASSERT_EQ(plan("a", "--set 'POCKET area_rough/tool=T4' --limit 'feed<=1500' -o a.edits.yaml").code, 0);
  EXPECT_THAT(slurp(folder_ / "a.edits.yaml"), HasSubstr(std::string("POCKET area_rough/tool=") + kEm8))
      << "a number of the plan is written as the tool's name";
  ASSERT_EQ(plan("b", "--edits a.edits.yaml -o b.edits.yaml").code, 0);
  EXPECT_EQ(slurp(folder_ / "a.ngc"), slurp(folder_ / "b.ngc"));
  EXPECT_EQ(slurp(folder_ / "a.edits.yaml"), slurp(folder_ / "b.edits.yaml"));
  EXPECT_THAT(why("b", "POCKET area_rough", "its_tool"), HasSubstr("edit 1 of a.edits.yaml"));
  // Byte for byte the same with the same edits, and the same as ever without.
  ASSERT_EQ(plan("c", "--edits a.edits.yaml").code, 0);
  EXPECT_EQ(slurp(folder_ / "b.json"), slurp(folder_ / "c.json"));
}

TEST_F(Edits, OfAPlanHoldWhenItIsPlannedOrBoundAgainWithoutAFile) {
  ASSERT_EQ(plan("a", "--set 'POCKET area_rough/tool=T4' --limit 'feed<=1500'").code, 0);
  const Ran again = run("plan a.json -o b.json -o b.ngc");
  EXPECT_LE(again.code, 1) << again.err;
  for (const double f : feeds("b")) EXPECT_LE(f, 1500.0);
  EXPECT_THAT(why("b", "POCKET area_rough", "its_tool"), HasSubstr("operator"));
  const Ran bound = run("bind a.json --limit 'feed<=1000' -o c.json -o c.ngc");
  EXPECT_LE(bound.code, 1) << bound.err;
  for (const double f : feeds("c")) EXPECT_LE(f, 1000.0);
  EXPECT_THAT(why("c", "POCKET area_rough", "its_tool"), HasSubstr("operator"));
}

TEST_F(Edits, AnEditThatIsTakenBackIsPlannedAnewInAPlanThatHeldIt) {
  put("none.yaml", "capstan_edits: 1\nedits: []\n");
  ASSERT_EQ(plan("a", "--set 'POCKET area_rough/tool=T4'").code, 0);
  const Ran r = run("plan a.json --edits none.yaml -o b.json");
  EXPECT_LE(r.code, 1) << r.err;
  EXPECT_THAT(why("b", "POCKET area_rough", "its_tool"), Not(HasSubstr("operator")));
}

}  // namespace
}  // namespace capstan::app
