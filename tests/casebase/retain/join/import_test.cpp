#include "casebase/retain/join/import.h"

#include <gtest/gtest.h>

#include <sstream>

#include "tests/casebase/sample.h"

namespace capstan::casebase::retain {
namespace {

// Two tools; tool 2 mills a bore of which a characteristic is measured.
std::vector<Step> two_steps() {
  std::vector<Step> out;
  for (const int tool : {1, 2}) {
    Case planned = sample();
    planned.observed = {};
    planned.asked.teeth = 2;
    planned.bound = {};
    planned.bound.path_length_mm = 100.0;
    planned.from.workingstep = tool == 1 ? "DRILL" : "BORE";
    out.push_back(
        {.id = planned.from.workingstep,
         .tool = tool,
         .planned = planned,
         .characteristics = tool == 2 ? std::vector<std::string>{"DIAMETER5"} : std::vector<std::string>{},
         .parts = {}});
  }
  return out;
}

const std::string kLog =
    "time_s,tool,feed_mm_min,spindle_rpm,lag_mm\n"
    "0,1,600,3000,0.01\n8,1,600,3000,0.02\n10,2,0,3000,0\n12,2,300,3000,0.06\n18,2,300,3000,0.01\n25,2,300,"
    "3000,0.01\n"
    "32,2,0,3000,0\n";

Result<std::vector<Case>> import(const std::string& text, LogFormat format, const ImportOptions& options,
                                 Job& job, const std::string& part = "7") {
  std::istringstream in(text);
  const auto steps = two_steps();
  return import_log(in, format, steps, {.part = part, .machine = "M1", .file = "log"}, options, job);
}

TEST(Import, TimeSpeedAndFeedOfAStepAreThoseOfTheLog) {
  Job job;
  const auto cases = import(kLog, LogFormat::kCsv, {}, job);
  ASSERT_TRUE(cases) << to_text(cases.error());
  ASSERT_EQ(cases->size(), 2U);
  const Case& drill = cases->front();
  EXPECT_EQ(drill.from.workingstep, "DRILL");
  EXPECT_EQ(drill.from.part, "7");
  EXPECT_EQ(drill.from.machine, "M1");
  EXPECT_EQ(drill.origin, Origin::kMeasured);
  EXPECT_DOUBLE_EQ(drill.observed.time_s->value, 10.0);
  EXPECT_NEAR(drill.bound.fz_mm, 0.1, 1e-9);  // 600 / 3000 / 2
  EXPECT_NEAR(drill.observed.executed_fz_mm->value, 0.1, 1e-9);
  EXPECT_NEAR(drill.observed.executed_vc_m_min->value, 94.2478, 1e-3);  // 10 mm at 3000 1/min
  EXPECT_NEAR(drill.predicted.time_s, 10.0, 1e-9);                      // 100 mm at 600 mm/min
  EXPECT_NEAR(drill.bound.vc_m_min, 94.2478, 1e-3);                     // 10 mm at 3000 1/min
  EXPECT_DOUBLE_EQ(cases->back().observed.time_s->value, 20.0);  // not the two seconds of standing still
  EXPECT_EQ(cases->back().observed.verdict, Verdict::kUnknown);
}

TEST(Import, WhatWasExecutedIsWhatHeldLongestInAllStaysAtTheStep) {
  Job job;
  // Tool 1 begins at 600 mm/min and 3000 1/min, and comes back for longer at 900 and 2500.
  const auto cases = import(
      "time_s,tool,feed_mm_min,spindle_rpm\n0,1,600,3000\n2,2,300,3000\n9,1,900,2500\n17,2,300,3000\n"
      "18,2,0,3000\n",
      LogFormat::kCsv, {}, job);
  ASSERT_TRUE(cases) << to_text(cases.error());
  ASSERT_EQ(cases->size(), 2U);
  EXPECT_NEAR(cases->front().observed.executed_fz_mm->value, 0.18, 1e-9);        // 900 / 2500 / 2
  EXPECT_NEAR(cases->front().observed.executed_vc_m_min->value, 78.5398, 1e-3);  // 10 mm at 2500 1/min
}

TEST(Import, AFeedFarFromThePlannedOneIsTold) {
  // Planned 0.08 mm per tooth; 480 mm/min at 3000 1/min with two teeth, in a column that says inches.
  auto steps = two_steps();
  steps.front().planned.bound.vc_m_min = 94.2478;
  steps.front().planned.bound.fz_mm = 0.08;
  const auto told = [&](const std::string& column) {
    std::istringstream in("time_s,tool," + column +
                          ",spindle_rpm\n0,1,480,3000\n8,1,480,3000\n10,1,0,3000\n");
    Job job;
    const auto cases =
        import_log(in, LogFormat::kCsv, steps, {.part = "7", .machine = "M1", .file = "log"}, {}, job);
    EXPECT_TRUE(cases) << (cases ? std::string() : to_text(cases.error()));
    std::string out;
    for (const Diagnostic& d : job.diagnostics()) out += to_text(d) + '\n';
    return out;
  };
  EXPECT_EQ(told("feed_mm_min").find("LOG-FEED"), std::string::npos);
  const std::string inches = told("feed_in_min");
  EXPECT_NE(inches.find("2.032 mm per tooth, 25.4 times the planned 0.08"), std::string::npos) << inches;
  EXPECT_NE(inches.find("[LOG-FEED]"), std::string::npos) << inches;
}

TEST(Import, AToolsSerialNumberNamesTheEdgeOfItsSteps) {
  Job job;
  // Tool 1 says its number a moment after it was loaded; tool 2 never does.
  const auto cases = import(
      "time_s,tool,tool_serial,feed_mm_min,spindle_rpm\n"
      "0,1,,600,3000\n1,1,DR-0815,600,3000\n10,2,,300,3000\n18,2,,300,3000\n25,2,,300,3000\n32,2,,0,3000\n",
      LogFormat::kCsv, {}, job);
  ASSERT_TRUE(cases) << to_text(cases.error());
  ASSERT_EQ(cases->size(), 2U);
  EXPECT_EQ(cases->front().from.tool_instance, "DR-0815");
  EXPECT_DOUBLE_EQ(cases->front().observed.time_s->value, 10.0);
  EXPECT_EQ(cases->back().from.tool_instance, "");
}

TEST(Import, StepInWhichALimitIsExceededIsABadCase) {
  Job job;
  const auto cases = import(kLog, LogFormat::kCsv, {.triggers = {*trigger_of("lag_mm>0.05")}}, job);
  ASSERT_TRUE(cases);
  EXPECT_EQ(cases->front().observed.verdict, Verdict::kUnknown);
  EXPECT_EQ(cases->back().observed.verdict, Verdict::kBad);
  Job shorter;
  const auto patient = import(kLog, LogFormat::kCsv, {.triggers = {*trigger_of("lag_mm>0.05:7")}}, shorter);
  ASSERT_TRUE(patient);
  EXPECT_EQ(patient->back().observed.verdict, Verdict::kUnknown);
}

TEST(Import, MeasuredSizesGoToTheStepOfTheirCharacteristicAndPart) {
  Job job;
  const auto row = [](const char* part, double value) {
    return Inspected{.part = part,
                     .characteristic = "DIAMETER5",
                     .type = "Diameter",
                     .has_nominal = true,
                     .nominal_mm = 10.0,
                     .upper_mm = 0.2,
                     .lower_mm = -0.2,
                     .value_mm = value,
                     .toleranced = true};
  };
  const auto cases =
      import(kLog, LogFormat::kCsv, {.inspection = {row("7", 10.1), row("7", 10.3), row("8", 15.0)}}, job);
  ASSERT_TRUE(cases);
  EXPECT_FALSE(cases->front().observed.size_deviation_mm);
  ASSERT_TRUE(cases->back().observed.size_deviation_mm);
  EXPECT_NEAR(cases->back().observed.size_deviation_mm->value, 0.2, 1e-12);
  EXPECT_EQ(cases->back().observed.verdict, Verdict::kBad);
}

TEST(Import, TableOfTimesMakesCasesOfEachOfItsParts) {
  Job job;
  const std::string table =
      "part,tool,spindle_rpm,feed_mm_min,executed_active_s,executed_feeding_s\n"
      "1,1,3000,600,12,10\n1,2,3000,300,25,20\n2,1,3000,600,12,11\n2,2,3000,300,25,21\n";
  const auto all = import(table, LogFormat::kTimes, {}, job, "");
  ASSERT_TRUE(all) << to_text(all.error());
  EXPECT_EQ(all->size(), 4U);
  EXPECT_FALSE(all->front().observed.executed_fz_mm);  // somebody noted them
  EXPECT_FALSE(all->front().observed.executed_vc_m_min);
  const auto one = import(table, LogFormat::kTimes, {}, job, "2");
  ASSERT_TRUE(one);
  ASSERT_EQ(one->size(), 2U);
  EXPECT_DOUBLE_EQ(one->front().observed.time_s->value, 11.0);
}

TEST(Import, RunOfAnotherProgramWithAToolThatIsLeftMakesNoCase) {
  Job job;
  std::vector<Step> steps = two_steps();
  steps.push_back(steps.front());
  steps.back().tool = 3;
  steps.back().id = steps.back().planned.from.workingstep = "ENGRAVE";
  const std::string log =
      "2017-02-01T10:00:00Z|execution|ACTIVE|tool|1|spindle_speed|3000|feed_rate|10\n"
      "2017-02-01T10:00:05Z|tool|2\n2017-02-01T10:00:09Z|tool|3\n2017-02-01T10:00:12Z|execution|STOPPED\n"
      "2017-02-04T10:00:00Z|execution|ACTIVE\n2017-02-04T10:00:30Z|execution|STOPPED\n";
  std::istringstream in(log);
  const auto cases = import_log(in, LogFormat::kTrace, steps, {.part = "1", .file = "log"}, {}, job);
  ASSERT_TRUE(cases) << to_text(cases.error());
  ASSERT_EQ(cases->size(), 3U);
  EXPECT_DOUBLE_EQ(cases->back().observed.time_s->value, 3.0);
  EXPECT_EQ(cases->back().from.time_utc, "2017-02-01T10:00:12Z");
}

TEST(Import, NameOfTwoStepsThatTheLogDoesNotTellApartMakesNoCase) {
  std::vector<Step> steps = two_steps();
  steps.push_back(steps.front());
  steps.back().id = steps.back().planned.from.workingstep = "DRILL~2";
  const auto cases = [&](const std::string& second) {
    Job job;
    std::istringstream in(
        "time_s,workingstep,feed_mm_min,spindle_rpm\n0,DRILL,600,3000\n10,BORE,300,3000\n20," + second +
        ",600,3000\n29,,0,0\n");
    const auto out = import_log(in, LogFormat::kCsv, steps, {.part = "1", .file = "log"}, {}, job);
    EXPECT_TRUE(out) << to_text(out.error());
    return out ? out->size() : 0;
  };
  EXPECT_EQ(cases("DRILL~2"), 3U);
  EXPECT_EQ(cases("DRILL"), 1U);
}

TEST(Import, OneStayAtANameOfTwoStepsMayBeAtBothThatFollowEachOther) {
  std::vector<Step> steps = two_steps();
  steps.push_back(steps.front());
  steps.back().id = steps.back().planned.from.workingstep = "DRILL~2";
  Job job;
  std::istringstream in(
      "time_s,workingstep,feed_mm_min,spindle_rpm\n0,DRILL,600,3000\n10,DRILL,600,3000\n"
      "20,BORE,300,3000\n29,,0,0\n");
  const auto cases = import_log(in, LogFormat::kCsv, steps, {.part = "1", .file = "log"}, {}, job);
  ASSERT_TRUE(cases) << to_text(cases.error());
  ASSERT_EQ(cases->size(), 1U);
  EXPECT_EQ(cases->front().from.workingstep, "BORE");
}

// A complete log in each format; `cut` rows of it are left at its beginning.
struct Log {
  LogFormat format;
  std::string head;
  std::vector<std::string> rows;
};
const Log kWholeLogs[] = {
    {LogFormat::kCsv,
     "time_s,tool,feed_mm_min,spindle_rpm\n",
     {"0,1,600,3000\n", "8,1,600,3000\n", "10,2,300,3000\n", "18,2,300,3000\n", "25,2,300,3000\n",
      "32,2,0,3000\n"}},
    {LogFormat::kTrace,
     "2017-02-01T10:00:00Z|execution|ACTIVE|tool|1|spindle_speed|3000|feed_rate|10\n",
     {"2017-02-01T10:00:08Z|feed_rate|11\n", "2017-02-01T10:00:10Z|tool|2\n",
      "2017-02-01T10:00:18Z|feed_rate|5\n", "2017-02-01T10:00:25Z|feed_rate|0\n",
      "2017-02-01T10:00:26Z|feed_rate|6\n", "2017-02-01T10:00:32Z|execution|STOPPED\n"}},
    {LogFormat::kLinuxcnc,
     "",
     {"0 0 0 0 10 1 3000\n", "8000 50 0 0 10 1 3000\n", "10000 60 0 0 5 2 3000\n", "18000 70 0 0 5 2 3000\n",
      "25000 80 0 0 5 2 3000\n", "32000 80 0 0 0 2 3000\n"}}};

Result<std::vector<Case>> import_rows(const Log& log, std::size_t rows, Job& job) {
  std::string text = log.head;
  for (std::size_t i = 0; i < rows; ++i) text += log.rows[i];
  ImportOptions options;
  if (log.format == LogFormat::kLinuxcnc)
    options.columns = {"x", "y", "z", "feed_mm_s", "tool", "spindle_rpm"};
  return import(text, log.format, options, job);
}

TEST(Import, StepThatTheLogEndsWithinMakesNoCaseAndTheStepsBeforeItDo) {
  for (const Log& log : kWholeLogs) {
    const std::size_t all = log.rows.size(), second = log.format == LogFormat::kTrace ? 2 : 3;
    Job whole;
    const auto both = import_rows(log, all, whole);
    ASSERT_TRUE(both) << to_text(both.error());
    ASSERT_EQ(both->size(), 2U) << log.head;
    EXPECT_EQ(whole.count(Severity::kWarning), 0U) << log.head;
    for (std::size_t rows = second; rows < all; ++rows) {
      Job job;
      const auto cases = import_rows(log, rows, job);
      ASSERT_TRUE(cases) << log.head << rows;
      ASSERT_EQ(cases->size(), 1U) << log.head << rows;
      EXPECT_EQ(cases->front().from.workingstep, "DRILL");
      EXPECT_EQ(*cases, std::vector<Case>{both->front()}) << log.head << rows;
      ASSERT_EQ(job.count(Severity::kWarning), 1U) << log.head << rows;
      for (const Diagnostic& d : job.diagnostics()) {
        if (d.severity != Severity::kWarning) continue;
        EXPECT_EQ(d.code, "LOG-STEP");
        EXPECT_EQ(d.path, "BORE");
        EXPECT_EQ(d.line, rows + (log.head.empty() ? 0 : 1)) << log.head;
        EXPECT_NE(d.message.find("the log ends within it"), std::string::npos);
      }
    }
  }
}

TEST(Import, LogThatEndsWithinItsFirstStepIsRefused) {
  for (const Log& log : kWholeLogs) {
    Job job;
    const auto none = import_rows(log, log.format == LogFormat::kTrace ? 1 : 2, job);
    ASSERT_FALSE(none) << log.head;
    EXPECT_EQ(none.error().code, "LOG-JOIN");
    EXPECT_EQ(job.count(Severity::kWarning), 1U);
  }
}

TEST(Import, StepThatIsShownToItsLastLineIsWholeThoughTheMachineMovesThen) {
  const ProgramMarks marks = program_marks(
      "(CAPSTAN STEP id=\"DRILL\" n=1 tool=1 setup=1)\nG1 X1\nG1 X2\n"
      "(CAPSTAN STEP id=\"BORE\" n=2 tool=2 setup=1)\nG1 X3\nG1 X4\n");
  const std::string head = "time_s,line,feed_mm_min,spindle_rpm\n0,2,600,3000\n8,3,600,3000\n10,5,300,3000\n";
  for (const auto& [more, steps] :
       {std::pair("18,6,300,3000\n25,6,300,3000\n", 2U), std::pair("18,5,300,3000\n25,5,300,3000\n", 1U)}) {
    Job job;
    const auto cases = import(head + more, LogFormat::kCsv, {.marks = &marks}, job);
    ASSERT_TRUE(cases) << to_text(cases.error());
    EXPECT_EQ(cases->size(), steps);
  }
}

TEST(Import, LogThatShowsNoStepIsRefused) {
  Job job;
  const auto none =
      import("time_s,tool,feed_mm_min,spindle_rpm\n0,9,600,3000\n9,9,600,3000\n", LogFormat::kCsv, {}, job);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, "LOG-JOIN");
  EXPECT_FALSE(job.diagnostics().empty());  // what was left out, and why
}

TEST(Import, TriggersAndFormatsAreReadFromText) {
  const auto t = trigger_of("load_percent>90:0.5");
  ASSERT_TRUE(t);
  EXPECT_EQ(t->item, Item::kLoad);
  EXPECT_DOUBLE_EQ(t->above, 90.0);
  EXPECT_DOUBLE_EQ(t->for_s, 0.5);
  for (const char* wrong : {"", "lag_mm", "lag_mm>", "colour>3", "lag_mm>x", "lag_mm>-1", "lag_mm>1:x"})
    EXPECT_FALSE(trigger_of(wrong)) << wrong;
  EXPECT_EQ(log_format_of("trace"), LogFormat::kTrace);
  EXPECT_EQ(log_format_of("wear"), LogFormat::kWear);
  EXPECT_FALSE(log_format_of("qif"));
}

}  // namespace
}  // namespace capstan::casebase::retain
