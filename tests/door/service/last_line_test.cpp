#include "planner/door/service/ending/last_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "planner/proof/verify/verify.h"

namespace capstan::service {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

Ending planned() { return {.steps = 21, .setups = 1, .tools = 10, .time_s = 269.0, .features = 12}; }

TEST(LastLine, OfASafePlanHasItsAmountsAndFiles) {
  Ending end = planned();
  EXPECT_EQ(last_line(end), "Safe: 21 steps, 10 tools, 4 min 29 s");
  end.setups = 2;
  end.to_load = 3;
  end.program = ProgramEnd::kWritten;
  end.wrote = {"plan.p21 (without 11 things, see the notes)", "x.ngc"};
  EXPECT_EQ(last_line(end),
            "Safe: 21 steps, 2 set-ups, 10 tools (3 to load), 4 min 29 s; "
            "wrote plan.p21 (without 11 things, see the notes), x.ngc");
}

TEST(LastLine, HasTheTimeByCasesBesideThePlannedOne) {
  Ending end = planned();
  end.time_by_cases = "4 min 51 s +- 9.4 s";
  EXPECT_EQ(last_line(end), "Safe: 21 steps, 10 tools, 4 min 29 s (by cases 4 min 51 s +- 9.4 s)");
}

TEST(LastLine, WarningsOfTheCheckStandInFront) {
  Ending end = planned();
  end.warned = 2;
  EXPECT_EQ(last_line(end), "Safe, with 2 warnings of the check: 21 steps, 10 tools, 4 min 29 s");
}

TEST(LastLine, OfACondemnedPlanSaysWhatBecameOfItsProgram) {
  Ending end = planned();
  end.condemned = 3;
  end.program = ProgramEnd::kWithheld;
  EXPECT_EQ(last_line(end), "NOT SAFE: 3 findings, no program written; 21 steps, 10 tools, 4 min 29 s");
  end.why = "step 5 SLOT: spindle torque 1.11 of 0.48 Nm (and 2 more)";
  EXPECT_THAT(last_line(end), StartsWith("NOT SAFE: 3 findings, no program written; step 5 SLOT: spindle "
                                         "torque 1.11 of 0.48 Nm (and 2 more); 21 steps"));
  end.program = ProgramEnd::kWithStops;
  EXPECT_THAT(last_line(end),
              StartsWith("NOT SAFE: 3 findings, the program stops before what is condemned; step 5"));
  end.program = ProgramEnd::kNotAsked;
  EXPECT_THAT(last_line(end), StartsWith("NOT SAFE: 3 findings, no program can be made of it; step 5"));
  end.condemned = 1;
  end.strict = true;
  EXPECT_THAT(last_line(end), StartsWith("NOT SAFE: 1 finding; step 5"));
  EXPECT_THAT(last_line(end), HasSubstr("; nothing written (--strict)"));
}

TEST(LastLine, FeaturesThatAreNotPlannedMakeItNotWhole) {
  Ending end = planned();
  end.unplanned = 1;
  EXPECT_EQ(last_line(end),
            "Safe, but not whole: 1 of 12 features is not planned; 21 steps, 10 tools, 4 min 29 s");
  end.unplanned = 2;
  end.warned = 1;
  EXPECT_THAT(last_line(end), StartsWith("Safe, but not whole, with 1 warning of the check: 2 of 12 features "
                                         "are not planned; 21 steps"));
}

TEST(LastLine, FacesOfTheCadShapeThatAreNotReachedMakeItNotWhole) {
  FileFinding said;
  said.finding.code = std::string(verify::kFacesLeft);
  said.finding.severity = Severity::kWarning;
  Verdict verdict;
  verdict.findings.push_back(said);
  Ending end = planned();
  take_verdict({}, verdict, end);
  EXPECT_EQ(
      last_line(end),
      "Safe, but not whole, with 1 warning of the check: faces of the CAD shape are not reached (see above); "
      "21 steps, 10 tools, 4 min 29 s");
  EXPECT_TRUE(calls_safe(end));
}

TEST(LastLine, OpenDecisionsAreNotChecked) {
  Ending end = planned();
  end.open = true;
  end.time_s.reset();
  end.unplanned = 1;
  EXPECT_EQ(last_line(end),
            "Not checked: decisions are left open; 1 of 12 features is not planned; 21 steps, 10 tools");
  end.steps = end.unplanned = 0;
  EXPECT_EQ(last_line(end), "Not checked: decisions are left open; 10 tools");
}

TEST(LastLine, WhatIsNotJudgedIsNotSafe) {
  Ending end = planned();
  end.unproved = 1;
  EXPECT_THAT(last_line(end), StartsWith("Not proven safe: 1 thing is not judged (see above); 21 steps"));
  end.warned = 2;
  EXPECT_THAT(last_line(end), HasSubstr("; 2 warnings of the check; 21 steps"));
  Ending unread = planned();
  unread.unread = 2;
  EXPECT_THAT(last_line(unread),
              StartsWith("Not proven safe: 2 errors in reading: what they are about is not in the plan; 21"));
}

TEST(LastLine, OfStoppedAndFailedCallsPromisesNothing) {
  EXPECT_EQ(last_line({.verb = Verb::kPlan, .done = false, .stopped = true}), "Stopped: no plan, no program");
  EXPECT_EQ(last_line({.verb = Verb::kBind, .done = false}), "Failed: no plan, no program");
  EXPECT_EQ(last_line({.verb = Verb::kCheck, .done = false}), "Failed: nothing is checked");
  Ending end = planned();
  end.stopped = true;
  EXPECT_THAT(last_line(end), StartsWith("Stopped, not proven safe: "));
  end.condemned = 1;
  end.program = ProgramEnd::kWithheld;
  EXPECT_THAT(last_line(end), StartsWith("Stopped, NOT SAFE: 1 finding, no program written; "));
}

TEST(LastLine, ALatePlanIsCalledThat) {
  Ending end = planned();
  end.verb = Verb::kBind;
  end.late = true;
  EXPECT_EQ(last_line(end),
            "Safe, too late: the deadline was past when the plan was there; 21 steps, 10 tools, 4 min 29 s");
}

TEST(LastLine, APlanWithoutStepsIsNotCalledSafe) {
  EXPECT_EQ(last_line({}), "Nothing to machine: no step, no tool");
}

TEST(LastLine, IsCalledSafeOnlyWhereItSaysSo) {
  std::vector<Ending> all(11, planned());
  all[1].condemned = 1;
  all[2].open = true;
  all[3].stopped = true;
  all[4].unproved = 1;
  all[5].unread = 1;
  all[6].steps = 0;
  all[7].warned = 1;
  all[8].unplanned = 1;
  all[9].late = true;
  all[10].done = false;
  for (const Ending& end : all)
    EXPECT_EQ(calls_safe(end), last_line(end).starts_with("Safe")) << last_line(end);
}

TEST(LastLine, OfACheckCountsFiles) {
  Ending end{.verb = Verb::kCheck, .files = 2};
  EXPECT_EQ(last_line(end), "Safe: 2 files checked");
  end.condemned = 4;
  EXPECT_EQ(last_line(end), "NOT SAFE: 4 findings; 2 files checked");
  end.condemned = 0;
  end.planned_anew = 1;
  EXPECT_EQ(
      last_line(end),
      "Not proven safe: 1 plan was planned anew to be checked: not all paths are in the file, or values "
      "were edited; 2 files checked");
  end = {.verb = Verb::kCheck, .files = 1, .compared = 1, .schema = 3};
  EXPECT_EQ(last_line(end),
            "Not proven safe: 1 file is compared with the schema only; 3 deviations from the schema; "
            "1 file checked");
}

TEST(LastLine, ErrorsOfPlanningAreToldByTheFeaturesThatItLeavesOut) {
  EXPECT_EQ(reading_errors({{.code = "EXC-REFERENCE", .message = ""},
                            {.code = "PIP-NO-PATH", .message = ""},
                            {.code = "EXC-SIZE", .severity = Severity::kWarning, .message = ""}}),
            1U);
}

FileFinding finding(Severity severity, std::string code = "CHK-X", bool unproved = false) {
  FileFinding out;
  out.finding.code = std::move(code);
  out.finding.severity = severity;
  out.finding.unproved = unproved;
  return out;
}

TEST(LastLine, FindingsOfACheckAreCountedByWhatTheySay) {
  CheckResult result;
  result.checked = 1;
  result.findings = {finding(Severity::kError),
                     finding(Severity::kWarning),
                     finding(Severity::kNote),
                     finding(Severity::kNote, "CHK-NOT-JUDGED", true),
                     finding(Severity::kWarning, "CHK-UNVERIFIABLE", true),
                     finding(Severity::kError, "CHK-STOPPED")};
  result.findings.push_back(finding(Severity::kError, "AIM-MISSING"));
  result.findings.back().schema = true;
  Ending end{.verb = Verb::kCheck};
  take_check(result, end);
  EXPECT_EQ(end.condemned, 2U);
  EXPECT_EQ(end.warned, 1U);
  EXPECT_EQ(end.unproved, 2U);
  EXPECT_TRUE(end.stopped);
}

// A program is checked with its plan: what it repeats is one thing, told once, but for the digits it rounds.
TEST(LastLine, WhatAProgramRepeatsOfItsPlanIsCountedOnce) {
  Verdict verdict;
  const auto add = [&](const char* file, bool program, const char* message, bool unproved = false) {
    FileFinding f = finding(Severity::kWarning, "CHK-X", unproved);
    f.file = file;
    f.program = program;
    f.finding.message = message;
    verdict.findings.push_back(std::move(f));
  };
  add("plan.p21", false, "12.3456 mm of way");
  add("plan.p21", false, "not seen", true);
  add("a.ngc", true, "12.346 mm of way");
  add("a.ngc", true, "not seen", true);
  add("a.ngc", true, "13.5 mm of way");
  Ending end;
  take_verdict({}, verdict, end);
  EXPECT_EQ(end.warned, 2U);
  EXPECT_EQ(end.unproved, 1U);
}

/// Whatever else is said: only where nothing is open, unchecked, unread or condemned does the line say
/// "Safe".
TEST(LastLine, SaysSafeOnlyWhereEverythingIsProved) {
  const auto with = [](auto change) {
    Ending end = planned();
    change(end);
    return last_line(end);
  };
  EXPECT_THAT(with([](Ending& e) { e.open = true; }), Not(StartsWith("Safe")));
  EXPECT_THAT(with([](Ending& e) { e.done = false; }), Not(StartsWith("Safe")));
  EXPECT_THAT(with([](Ending& e) { e.stopped = true; }), Not(StartsWith("Safe")));
  EXPECT_THAT(with([](Ending& e) { e.condemned = 1; }), Not(StartsWith("Safe")));
  EXPECT_THAT(with([](Ending& e) { e.unproved = 1; }), Not(StartsWith("Safe")));
  EXPECT_THAT(with([](Ending& e) { e.unread = 1; }), Not(StartsWith("Safe")));
  EXPECT_THAT(with([](Ending& e) { e.planned_anew = 1; }), Not(StartsWith("Safe")));
  EXPECT_THAT(with([](Ending& e) { e.compared = 1; }), Not(StartsWith("Safe")));
  EXPECT_THAT(with([](Ending& e) { e.steps = 0; }), Not(StartsWith("Safe")));
}

}  // namespace
}  // namespace capstan::service
