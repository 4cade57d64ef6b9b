// Late binding on a running control (examples/linuxcnc): where the machine ended, and what was cut. Each test
// is a scenario of scenarios.py; all are run once, on one machine.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "planner/ground/base/number.h"
#include "tests/examples/linuxcnc/cut_block.h"
#include "tests/examples/linuxcnc/scenarios.h"

namespace capstan::linuxcnc {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// What a cut may differ from the pocket, mm: path tolerance of the last pass, 0.01 (G64), and as much for
/// rounding.
constexpr double kSame = 0.02;
/// The piece, and its top where G54 has it and where the probe finds it. Source: reference_pocket.p21,
/// scenarios.py.
constexpr double kWidth = 100.0, kDepth = 80.0, kTop = -50.0, kProbedTop = -49.3, kPocketFloor = -10.0;
/// Of the tool setter, machine coordinates. Source: gcode.py, FACE.
constexpr double kSetterFace = -50.0;
constexpr int kProbing = 5;  // motion.motion-type of G38

const Mill kMill8{80.0, 8.0}, kMill10{90.0, 10.0}, kWornAndShorter{78.5, 7.9}, kThinner{80.0, 7.9};

/// The number that stands behind words; NaN where they do not stand there.
double number_behind(const std::string& text, const std::string& words) {
  const auto at = text.find(words);
  if (at == std::string::npos) return NAN;
  const auto begin = at + words.size();
  return parse_double(text.substr(begin, text.find_first_not_of("-+.0123456789e", begin) - begin))
      .value_or(NAN);
}

/// What `capstan cases trace` tells in its column "lag mm" of a workingstep: columns are set apart by two
/// blanks.
double lag_in(const std::string& trace, const std::string& step) {
  std::istringstream lines(trace);
  std::size_t from = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("part ")) from = line.find("lag mm");
    if (from > 0 && line.find("  " + step + "  ") != std::string::npos) {
      const auto end = line.find(' ', from);
      return parse_double(line.substr(from, end - from)).value_or(NAN);
    }
  }
  return NAN;
}

/// What the machine did with a tool of a scenario each time that its tip was in the piece, more than 1 mm
/// deep.
std::vector<Record> ways_in_piece(int mark, int tool, const Mill& mill) {
  const Record& r = scenarios().record;
  std::vector<Record> out;
  bool inside = false;
  for (std::size_t s = 0; s < r.size(); ++s) {
    const bool now = r.mark[s] == mark && r.tool[s] == tool && r.z_mm[s] - mill.length_mm < kTop - 1.0;
    if (now && !inside) out.emplace_back();
    inside = now;
    if (now) add_sample(r, s, out.back());
  }
  return out;
}

class LateBindingAtTheControl : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!scenarios().absent.empty()) GTEST_SKIP() << scenarios().absent;
    ASSERT_EQ(scenarios().failed, "");
  }

  static const Outcome& of(const std::string& name) { return scenarios().outcomes.at(name); }

  static CutBlock block(const std::string& name, const std::map<int, Mill>& tools, double top_mm = kTop) {
    CutBlock out(kWidth, kDepth, top_mm);
    out.cut(scenarios().record, of(name).mark, tools);
    return out;
  }

  static void expect_stands_retracted(const std::string& name) {
    EXPECT_NEAR(of(name).z_mm, kRetracted, 1e-6) << name;
    EXPECT_EQ(of(name).rpm, 0.0) << name;
    const Record& r = scenarios().record;
    double rpm = -1.0;
    for (std::size_t s = 0; s < r.size(); ++s)
      if (r.mark[s] == of(name).mark) rpm = r.rpm[s];
    EXPECT_NEAR(rpm, 0.0, 1e-6) << name;  // and not only commanded
  }

  static void expect_whole_program(const std::string& name) {
    EXPECT_EQ(of(name).said, std::vector<std::string>{}) << name;
    EXPECT_EQ(of(name).bound, (std::vector{1, 2})) << name;
    EXPECT_EQ(of(name).cut, (std::vector{1, 2})) << name;
    expect_stands_retracted(name);
  }

  static void expect_pocket(const CutBlock& cut) {
    EXPECT_LE(differs_from_pocket(cut), kSame);
    EXPECT_FALSE(cut.struck());
  }

  /// Stopped where nothing can happen, the reason on the screen.
  static void expect_stopped(const std::string& name, const std::string& reason) {
    expect_stands_retracted(name);
    ASSERT_EQ(of(name).said.size(), 1u) << name;
    EXPECT_NE(of(name).said[0].find(reason), std::string::npos) << of(name).said[0];
  }

  /// Stopped before the first chip.
  static void expect_refused(const std::string& name, const std::string& reason) {
    expect_stopped(name, reason);
    EXPECT_TRUE(of(name).cut.empty()) << name;
    EXPECT_TRUE(block(name, {{1, kMill8}, {3, kMill10}}).whole()) << name;
  }
};

TEST_F(LateBindingAtTheControl, CutsThePartWithTheToolsOfThePlan) {
  expect_whole_program("all_there");
  EXPECT_EQ(of("all_there").tool, 1);
  expect_pocket(block("all_there", {{1, kMill8}}));
}

TEST_F(LateBindingAtTheControl, GivesWhatWasCutToTheCaseBaseByWorkingstep) {
  const std::string& cases = scenarios().cases;
  EXPECT_FALSE(scenarios().cases_failed) << cases;
  EXPECT_NE(cases.find("2 cases, 2 of them new"), std::string::npos) << cases;
  for (const char* step : {"POCKET area_rough", "POCKET area_finish"})
    EXPECT_NE(cases.find(step), std::string::npos) << step << "\n" << cases;
}

TEST_F(LateBindingAtTheControl, GivesTheFollowingErrorOfEachWorkingstepToTheCaseBase) {
  // The drives of this scenario follow by speed * 1 ms / 9 (scenarios.py, LAG_GAIN), so that an axis is 3.4
  // um behind on a rapid, and three of them 5.9 um.
  const std::vector<Record> steps = workingsteps(scenarios().first, of("all_there").mark);
  ASSERT_EQ(steps.size(), 2u);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const double lag = *std::max_element(steps[i].lag_mm.begin(), steps[i].lag_mm.end());
    EXPECT_GT(lag, 0.003);
    EXPECT_LT(lag, 0.006);
    const std::string step = i == 0 ? "POCKET area_rough" : "POCKET area_finish";
    EXPECT_NEAR(lag_in(scenarios().cases, step), lag, 0.5e-4) << scenarios().cases;  // told to 0.1 um
  }
}

TEST_F(LateBindingAtTheControl, BroadcastsTheMeasuredPropertiesAtTheBeginningAndEndOfEachWorkingstep) {
  std::istringstream lines(scenarios().broadcast);
  std::vector<std::string> told;
  for (std::string line; std::getline(lines, line);) told.push_back(line);
  ASSERT_EQ(told.size(), 4u) << scenarios().broadcast;  // of one run, over both workingsteps:
  for (std::size_t i = 0; i < told.size(); ++i)
    EXPECT_EQ(number_behind(told[i], R"("sequence":)"), static_cast<double>(i + 1)) << told[i];
  const Outcome& o = of("all_there");
  for (std::size_t i = 0; i < told.size(); ++i) {
    EXPECT_THAT(told[i], HasSubstr(i < 2 ? R"("workingstep":"POCKET area_rough")"
                                         : R"("workingstep":"POCKET area_finish")"));
    EXPECT_THAT(told[i], HasSubstr(R"("spindle speed":0.0)"));  // it stands between two workingsteps
    EXPECT_THAT(told[i], HasSubstr(R"("feedrate":0.0)"));
    EXPECT_THAT(told[i], HasSubstr(R"("time":")"));
  }
  // Where the tip ended is where the machine ended.
  EXPECT_NEAR(number_behind(told[3], R"("location":[)"), o.x_mm, 1e-3);
}

TEST_F(LateBindingAtTheControl, ChoosesAnotherToolForOneThatIsMissing) {
  expect_whole_program("missing");
  EXPECT_EQ(of("missing").tool, 3);
  expect_pocket(block("missing", {{3, kMill10}}));
}

TEST_F(LateBindingAtTheControl, CutsTheSamePocketWithAToolWornAndShorter) {
  expect_whole_program("worn");
  expect_pocket(block("worn", {{1, kWornAndShorter}}));
}

TEST_F(LateBindingAtTheControl, CutsTheSamePocketWithTheWearThatIsToldOfATool) {
  expect_whole_program("worn_told");
  EXPECT_EQ(of("worn_told").tool, 1);
  expect_pocket(block("worn_told", {{1, kThinner}}));
}

TEST_F(LateBindingAtTheControl, ChoosesAnotherToolForOneThatIsToldToBeBroken) {
  expect_whole_program("broken_told");
  EXPECT_EQ(of("broken_told").tool, 3);
  expect_pocket(block("broken_told", {{3, kMill10}}));
}

TEST_F(LateBindingAtTheControl, BelievesAMeasuredDiameterAndNotTheTable) {
  expect_whole_program("measured");
  expect_pocket(block("measured", {{1, kThinner}}));
  // The setter was tripped by the real cutter, at its face and standing; 0.5 mm/s is 0.5 um of a servo
  // period.
  EXPECT_NEAR(of("measured").diameter_mm, kThinner.diameter_mm, 0.002);
  const Record& r = scenarios().record;
  double right = -1e9;
  for (std::size_t s = 0; s < r.size(); ++s) {
    if (r.mark[s] != of("measured").mark || r.x_mm[s] > kSetterFace || r.kind[s] != kProbing) continue;
    right = std::max(right, r.x_mm[s]);
    EXPECT_EQ(r.rpm[s], 0.0);
    EXPECT_EQ(r.tool[s], 1);
  }
  // The fast approach goes past the touch by what it needs to stop, and no more: from 5 mm/s with half of the
  // axis' 508 mm/s2, the other half being kept for a blend (LinuxCNC, tp.c), after three servo periods.
  const double stops = 5.0 * 5.0 / 508.0 + 3.0 * kServoPeriod * 5.0,
               touch = kSetterFace - 0.5 * kThinner.diameter_mm;
  EXPECT_GE(right, touch);
  EXPECT_LE(right, touch + stops);
  // The tool of the table would have left 0.05 mm on each wall.
  EXPECT_GT(differs_from_pocket(block("all_there", {{1, kThinner}})), kSame);
}

TEST_F(LateBindingAtTheControl, TurnsSlowerInAHarderMaterial) {
  expect_whole_program("harder");
  const CutBlock steel = block("harder", {{1, kMill8}});
  expect_pocket(steel);
  // At most 1.25 times 70 m/min of a carbide cutter in mild steel (capstan materials show mild_steel).
  EXPECT_LE(steel.fastest_rpm() * 3.14159265 * kMill8.diameter_mm / 1000.0, 1.25 * 70.0 + 0.1);
  EXPECT_GT(block("all_there", {{1, kMill8}}).fastest_rpm(), 2.0 * steel.fastest_rpm());
}

TEST_F(LateBindingAtTheControl, CutsFromTheSurfaceThatTheProbeFinds) {
  expect_whole_program("probed_surface");
  expect_pocket(block("probed_surface", {{1, kMill8}}, kProbedTop));
}

TEST_F(LateBindingAtTheControl, BindsAndCutsTheLastStepAgainWhileTheProbeFindsThatMaterialStands) {
  EXPECT_EQ(of("spring_pass").said, std::vector<std::string>{});
  EXPECT_EQ(of("spring_pass").bound, (std::vector{1, 2, 2}));
  EXPECT_EQ(of("spring_pass").cut, (std::vector{1, 2, 2}));
  EXPECT_EQ(of("spring_pass").tool, 9);  // the probe found nothing more
  expect_stands_retracted("spring_pass");
  expect_pocket(block("spring_pass", {{1, kMill8}}));
  // Each call goes once from above the piece into it: roughing, finishing, finishing again.
  const Record& r = scenarios().record;
  int entries = 0;
  bool above = true;
  for (std::size_t s = 0; s < r.size(); ++s) {
    if (r.mark[s] != of("spring_pass").mark || r.tool[s] != 1) continue;
    const bool now_above = r.z_mm[s] - kMill8.length_mm > kTop + 1.0;
    entries += above && !now_above;
    above = now_above;
  }
  EXPECT_EQ(entries, 3);
}

TEST_F(LateBindingAtTheControl, TheWhileStatementOfThePlanBindsAndCutsTheFinishAgainUntilNothingStands) {
  const Outcome& o = of("while_of_the_plan");
  EXPECT_EQ(o.said, std::vector<std::string>{});
  EXPECT_EQ(o.bound, (std::vector{1, 2, 3}));
  EXPECT_EQ(o.cut, (std::vector{1, 2, 3}));
  EXPECT_EQ(o.bound_ids,
            (std::vector<std::string>{"POCKET area_rough", "POCKET area_finish", "POCKET area_finish"}));
  expect_stands_retracted("while_of_the_plan");
  // Asked with 0.3 mm on the wall, with 0.05, and with nothing; each yes again when the step is bound.
  ASSERT_EQ(o.decided.size(), 5u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_THAT(o.decided[i], StartsWith(std::array{"0 ", "2 ", "0 ", "3 "}[i]));
    EXPECT_THAT(o.decided[i], HasSubstr("'SPRING PASS' is taken, for wall ("));
    EXPECT_NEAR(number_behind(o.decided[i], "wall ("), i < 2 ? 0.3 : 0.05, 0.005);
  }
  EXPECT_THAT(o.decided[4], StartsWith("0 "));
  EXPECT_THAT(o.decided[4], HasSubstr("does not hold any more"));
  expect_pocket(block("while_of_the_plan", {{1, kMill8}}));
  // Roughed, finished, and once more along all four walls: each a way into the piece and out of it.
  const std::vector<Record> ways = ways_in_piece(o.mark, 1, kMill8);
  ASSERT_EQ(ways.size(), 3u);
  for (const std::size_t pass : {1u, 2u}) {
    CutBlock alone(kWidth, kDepth, kTop);
    alone.cut(ways[pass], o.mark, {{1, kMill8}});
    const std::array walls = {20.0, 80.0, 20.0, 60.0};
    for (std::size_t w = 0; w < walls.size(); ++w) EXPECT_NEAR(alone.reached()[w], walls[w], kSame) << pass;
  }
  // Without the finish the wall stands as roughing leaves it.
  CutBlock rough(kWidth, kDepth, kTop);
  rough.cut(ways[0], o.mark, {{1, kMill8}});
  EXPECT_NEAR(differs_from_pocket(rough), 0.3, kSame);
}

TEST_F(LateBindingAtTheControl, StandsRetractedAndStoppedWhereNothingIsCheckedAtTheDeadline) {
  expect_refused("no_time", "no workingstep was bound and checked when the deadline of 1 ms came");
}

TEST_F(LateBindingAtTheControl, StandsRetractedAndStoppedWhereNoToolFits) {
  expect_refused("no_tool", "finds no cutter");
}

TEST_F(LateBindingAtTheControl, RefusesAWorkOffsetFromWhichAnAxisWouldLeaveItsTravel) {
  expect_refused("out_of_travel", "X would go from");
}

TEST_F(LateBindingAtTheControl, StopsWhenThePlannerFailsInMidPlan) {
  for (const auto& [fault, reason] : {std::pair("killed", "the planner was killed from outside (SIGKILL)"),
                                      std::pair("hung", "the planner did not answer within")}) {
    expect_stopped(fault, reason);
    // It fails at the second workingstep; the first was cut as bound, and nothing else.
    EXPECT_EQ(of(fault).bound, std::vector{1}) << fault;
    EXPECT_EQ(of(fault).cut, std::vector{1}) << fault;
    const CutBlock first = block(fault, {{1, kMill8}});
    EXPECT_FALSE(first.whole()) << fault;
    EXPECT_FALSE(first.struck()) << fault;
    EXPECT_GT(differs_from_pocket(first), kSame) << fault;
  }
}

TEST_F(LateBindingAtTheControl, StopsWhenPlanningTakesMoreMemoryThanItMay) {
  // By the library's answer, or by how the process ended, where it found no memory for one (program_test.py).
  expect_refused("memory", "8 MB of memory");
}

TEST_F(LateBindingAtTheControl, StopsWhenTheDiskTakesNoWholeSubroutine) {
  expect_refused("disk", "1001.ngc cannot be written: File too large");
}

TEST_F(LateBindingAtTheControl, StopsWhenTheFileSystemOfTheSubroutinesIsFull) {
  if (!of("disk_full").cannot.empty())
    GTEST_SKIP() << "no file system can be mounted here: " << of("disk_full").cannot;
  expect_refused("disk_full", "full/1001.ngc cannot be written: No space left on device");
}

TEST_F(LateBindingAtTheControl, StopsWhenTheAdapterItselfDoesNotAnswer) {
  expect_refused("adapter_hung", "the adapter does not answer: timed out");
  expect_refused("adapter_killed", "the adapter does not answer: ");
}

TEST_F(LateBindingAtTheControl, StaysStoppedWhenTheMCodeThatWaitsIsKilled) {
  // LinuxCNC ends the program and says nothing of it.
  expect_stands_retracted("asker_killed");
  EXPECT_TRUE(of("asker_killed").bound.empty());
  EXPECT_TRUE(block("asker_killed", {{1, kMill8}, {3, kMill10}}).whole());
}

TEST_F(LateBindingAtTheControl, RefusesASubroutineThatIsNotTheOneBound) {
  expect_refused("altered", "it was altered");
  expect_refused("cut_short", "it is cut short");
  expect_refused("stale", "it is stale");
  expect_refused("told_since", "what is told of the tools changed since it was bound");
  expect_refused("offset_moved", "tool table or work offset changed since it was bound");
}

TEST_F(LateBindingAtTheControl, GoesOnAtTheWorkingstepInWhichThePowerWasLost) {
  // LinuxCNC and the adapter were killed while the second step was cut: bound, not cut.
  EXPECT_EQ(of("power_lost").bound, (std::vector{1, 2}));
  EXPECT_EQ(of("power_lost").cut, std::vector{1});
  CutBlock cut = block("power_lost", {{1, kMill8}});
  const double floor = kPocketFloor, roughed = kPocketFloor + 0.2;
  EXPECT_NEAR(cut.at(200, 160), floor, kSame);    // the middle is finished,
  EXPECT_NEAR(cut.at(100, 160), roughed, kSame);  // the left not,
  EXPECT_GT(differs_from_pocket(cut), 0.2);       // nor the walls
  EXPECT_FALSE(cut.struck());

  // It stands in the pocket then, and is first lifted out of it, straight and standing.
  const Record& r = scenarios().record;
  double x = NAN, y = NAN, least = NAN;
  for (std::size_t s = 0; s < r.size(); ++s) {
    if (r.mark[s] == of("power_lost").mark) x = r.x_mm[s], y = r.y_mm[s], least = r.z_mm[s];
    if (r.mark[s] != of("lifted").mark) continue;
    EXPECT_EQ(r.rpm[s], 0.0);
    if (r.z_mm[s] < kRetracted - 1e-3) {
      EXPECT_NEAR(r.x_mm[s], x, 1e-4);
      EXPECT_NEAR(r.y_mm[s], y, 1e-4);
      EXPECT_GE(r.z_mm[s], least - 1e-4);
    }
  }
  EXPECT_NEAR(least - kMill8.length_mm, kTop + kPocketFloor, kSame);  // it stood on the floor
  expect_stands_retracted("lifted");

  // Only the second is bound again by what the journal has, and cut.
  EXPECT_EQ(of("restarted").bound, (std::vector{1, 2, 2}));
  EXPECT_EQ(of("restarted").cut, (std::vector{1, 2}));
  EXPECT_EQ(of("restarted").said, std::vector<std::string>{});
  expect_stands_retracted("restarted");
  EXPECT_EQ(ways_in_piece(of("restarted").mark, 1, kMill8).size(), 1u);
  cut.cut(r, of("restarted").mark, {{1, kMill8}});
  expect_pocket(cut);
}

TEST_F(LateBindingAtTheControl, GivesTheCaseBaseNothingOfTheWorkingstepInWhichThePowerWasLost) {
  std::istringstream rows(scenarios().cases_of_power_lost);
  std::string row;
  std::getline(rows, row);
  ASSERT_THAT(row, StartsWith("time_s,workingstep,tool,x_mm,")) << row;
  double last_s = -1.0, x = NAN, y = NAN;
  std::map<std::string, std::size_t> count;
  while (std::getline(rows, row)) {
    std::vector<std::string> word;
    std::istringstream words(row);
    for (std::string one; std::getline(words, one, ',');) word.push_back(one);
    ASSERT_EQ(word.size(), 9u) << row;
    const double now_s = parse_double(word[0]).value_or(NAN);
    ASSERT_GT(now_s, last_s) << row;
    last_s = now_s;
    x = parse_double(word[3]).value_or(NAN), y = parse_double(word[4]).value_or(NAN);
    ++count[word[1]];
  }
  // The finish is the one behind the restart, from its first move to where the machine ended.
  EXPECT_NEAR(x, of("restarted").x_mm, 1e-3);
  EXPECT_NEAR(y, of("restarted").y_mm, 1e-3);
  ASSERT_EQ(count.size(), 2u);
  EXPECT_TRUE(count.contains("\"POCKET area_rough\""));
  // It has as many samples as where nothing went wrong, but for the way there from another place.
  const std::vector<Record> whole = workingsteps(scenarios().first, of("all_there").mark);
  ASSERT_EQ(whole.size(), 2u);
  const auto samples = static_cast<double>(count["\"POCKET area_finish\""]);
  EXPECT_NEAR(samples / static_cast<double>(whole[1].size()), 1.0, 0.2);
}

}  // namespace
}  // namespace capstan::linuxcnc
