// Late binding on a running control (examples/linuxcnc): where the machine ended, and what was cut. Each test
// is a scenario of scenarios.py; all are run once, on one machine.
#include <gtest/gtest.h>

#include "tests/examples/linuxcnc/cut_block.h"
#include "tests/examples/linuxcnc/scenarios.h"

namespace capstan::linuxcnc {
namespace {

/// Of the machine, and where it stands when it is retracted, mm. Source: machine/machine.ini, AXIS_Z.
constexpr double kRetracted = 101.6;
/// What a cut may differ from the pocket, mm: path tolerance of the last pass, 0.01 (G64), and as much for
/// rounding.
constexpr double kSame = 0.02;
/// The piece, and its top where G54 has it and where the probe finds it. Source: reference_pocket.p21,
/// scenarios.py.
constexpr double kWidth = 100.0, kDepth = 80.0, kTop = -50.0, kProbedTop = -49.3;

const Mill kMill8{80.0, 8.0}, kMill10{90.0, 10.0}, kWornAndShorter{78.5, 7.9}, kThinner{80.0, 7.9};

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

TEST_F(LateBindingAtTheControl, StandsRetractedAndStoppedWhereNoToolFits) {
  expect_refused("no_tool", "finds no cutter");
}

TEST_F(LateBindingAtTheControl, RefusesAWorkOffsetFromWhichAnAxisWouldLeaveItsTravel) {
  expect_refused("out_of_travel", "X would go from");
}

TEST_F(LateBindingAtTheControl, StopsWhenThePlannerFailsInMidPlan) {
  for (const auto& [fault, reason] : {std::pair("killed", "the planner ended before it answered"),
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
  // bad_alloc as the library's status, or glibc ends the process where it finds no memory itself.
  expect_refused("memory", "capstan: ");
}

TEST_F(LateBindingAtTheControl, StopsWhenTheDiskTakesNoWholeSubroutine) {
  expect_refused("disk", "1001.ngc cannot be written");
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
  // The power went while the second step was cut: bound, not cut.
  EXPECT_EQ(of("power_lost").bound, (std::vector{1, 2}));
  EXPECT_EQ(of("power_lost").cut, std::vector{1});
  EXPECT_LT(of("power_lost").z_mm, kRetracted);
  // The journal goes on: only the second is bound again, and cut.
  EXPECT_EQ(of("restarted").bound, (std::vector{1, 2, 2}));
  EXPECT_EQ(of("restarted").cut, (std::vector{1, 2}));
  EXPECT_EQ(of("restarted").said, std::vector<std::string>{});
  expect_stands_retracted("restarted");
  CutBlock cut = block("power_lost", {{1, kMill8}});
  EXPECT_GT(differs_from_pocket(cut), kSame);
  cut.cut(scenarios().record, of("restarted").mark, {{1, kMill8}});
  expect_pocket(cut);
}

}  // namespace
}  // namespace capstan::linuxcnc
