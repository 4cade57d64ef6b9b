#include <gtest/gtest.h>

#include "tests/casebase/retain/reading_logs.h"

namespace capstan::casebase::retain {
namespace {

const std::string kLog =
    "time_s,workingstep,line,x_mm,y_mm,z_mm,lag_mm,feed_mm_min,asked_feed_mm_min,spindle_rpm,load_percent\n"
    "0,A,10,0,0,5,0,600,600,9000,10\n"
    "1,A,11,10,0,5,0.004,600,600,9000,35\n"
    "2,A,12,20,0,5,-0.03,600,600,9000,35\n"
    "3,B,20,20,0,5,0.001,1200,1200,9000,20\n"
    "4,B,21,40,0,5,0.002,0,1200,9000,5\n";

TEST(TableOfReadings, SplitsByWorkingstep) {
  const Split s = split_table(kLog);
  ASSERT_TRUE(s.end) << to_text(s.end.error());
  ASSERT_EQ(s.steps.size(), 2U);
  EXPECT_EQ(s.steps[0].workingstep, "A");
  EXPECT_DOUBLE_EQ(s.steps[0].moving_s, 3.0);
  EXPECT_EQ(s.steps[0].first_line, 10);
  EXPECT_EQ(s.steps[0].last_line, 12);
  EXPECT_DOUBLE_EQ(s.steps[0].of(Item::kLag).peak, -0.03);
  EXPECT_EQ(s.steps[1].workingstep, "B");
  EXPECT_DOUBLE_EQ(s.steps[1].path_mm, 20.0);  // 1200 mm/min for a second
}

TEST(TableOfReadings, TakesInchesByTheNamesOfTheColumns) {
  const Split inch = split_table("time_s;tool;feed_ipm;x_in\n0;1;10;0\n6;1;10;1\n");
  ASSERT_TRUE(inch.end) << to_text(inch.end.error());
  ASSERT_EQ(inch.steps.size(), 1U);
  EXPECT_NEAR(inch.steps[0].of(Item::kFeed).held, 254.0, 1e-9);
  // The same unit for all that do not say: `units`.
  const Split by_option =
      split_table("time_s,tool,feed\n0,1,10\n6,1,10\n", {.runs_unless_said = true}, {}, {25.4, 25.4});
  EXPECT_NEAR(by_option.steps[0].of(Item::kFeed).held, 254.0, 1e-9);
}

TEST(TableOfReadings, TakesColumnsFromTheCallerAndDates) {
  const Split s = split_table("2020-01-01T00:00:00Z 5 100\n2020-01-01T00:00:02Z 5 100\n",
                              {.runs_unless_said = true}, {"time", "tool", "feed_mm_min"});
  ASSERT_TRUE(s.end) << to_text(s.end.error());
  EXPECT_TRUE(s.end->dated);
  EXPECT_DOUBLE_EQ(s.steps.at(0).moving_s, 2.0);
}

TEST(TableOfReadings, TellsColumnsThatSayNothingThatIsKnown) {
  const Split s = split_table("time_s,tool,feed_mm_min,foo,lagg,x_rpm\n0,1,10,7,0.1,3\n6,1,10,7,0.1,3\n");
  ASSERT_TRUE(s.end) << to_text(s.end.error());
  ASSERT_EQ(s.said.size(), 1U);
  EXPECT_EQ(s.said[0].code, "LOG-COLUMNS");
  EXPECT_EQ(s.said[0].severity, Severity::kNote);
  EXPECT_EQ(s.said[0].line, 1U);
  for (const char* words : {"3 columns say", "'foo'", "'lagg' (is it 'lag'?)", "'x_rpm'"})
    EXPECT_NE(s.said[0].message.find(words), std::string::npos) << s.said[0].message;
  EXPECT_TRUE(split_table("time_s,tool,feed\n0,1,10\n6,1,10\n").said.empty());
}

TEST(TableOfReadings, MovesByPositionsWhereThereIsNoFeed) {
  const Split s = split_table("time_s,tool,x,y,z\n0,1,0,0,0\n1,1,3,4,0\n2,1,3,4,0\n3,1,3,4,2\n");
  EXPECT_DOUBLE_EQ(s.steps.at(0).path_mm, 7.0);
  EXPECT_DOUBLE_EQ(s.steps.at(0).moving_s, 2.0);
  EXPECT_DOUBLE_EQ(s.steps.at(0).active_s, 3.0);
}

TEST(TableOfReadings, RefusesATableWithoutTimeOrWithAColumnTwice) {
  EXPECT_EQ(split_table("x,y\n1,2\n").end.error().code, "LOG-COLUMNS");
  const Split twice = split_table("time_s,x_mm,x_in\n1,2,3\n");
  ASSERT_FALSE(twice.end);
  EXPECT_EQ(twice.end.error().code, "LOG-COLUMNS");
  EXPECT_EQ(twice.end.error().line, 1U);
}

TEST(TableOfReadings, DoesNotTakeAColumnInAUnitOfAnotherKind) {
  const Split s = split_table("time_s,tool,feed_rpm\n0,1,10\n1,1,10\n");
  ASSERT_TRUE(s.end);
  EXPECT_EQ(s.steps.at(0).of(Item::kFeed).seconds, 0.0);
}

TEST(LinuxCncLog, IsSplitByTheMarkersOfItsProgram) {
  const ProgramMarks marks = program_marks(
      "(header)\n(CAPSTAN STEP id=\"drill 1\" n=1 tool=3 setup=1)\nG0 X0\nG1 X1\n"
      "(CAPSTAN STEP id=\"mill\" n=2 tool=4 setup=1)\nG1 X2\n");
  ASSERT_EQ(marks.marks.size(), 2U);
  EXPECT_EQ(marks.last_line(0), 4);
  EXPECT_EQ(marks.at(1), nullptr);
  std::istringstream in(
      "0 0 0 0 0 1\n1000 0 0 0 0 3\n2000 1 0 0 5 4\noverrun\n5000 2 0 0 5 6\n6000 3 0 0 0 6\n");
  Job job;
  Splitter splitter({.marks = &marks, .runs_unless_said = true});
  const auto end = read_linuxcnc(
      in, "samples", {}, {}, 0.001, [&](const Reading& r) { splitter.take(r); }, job);
  ASSERT_TRUE(end) << to_text(end.error());
  const auto steps = splitter.end();
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_EQ(steps[0].workingstep, "drill 1");
  EXPECT_EQ(steps[0].tool, 3);
  EXPECT_DOUBLE_EQ(steps[0].active_s, 4.0);  // from line 3 at 1 s until line 6 at 5 s
  EXPECT_DOUBLE_EQ(steps[0].moving_s, 3.0);
  EXPECT_DOUBLE_EQ(steps[0].of(Item::kFeed).held, 300.0);  // 5 mm/s
  EXPECT_EQ(steps[1].workingstep, "mill");
  EXPECT_DOUBLE_EQ(steps[1].moving_s, 1.0);
}

TEST(LinuxCncLog, HasAsManyOfTheMachinesPinsAsItsFirstRow) {
  // x y z speed line rpm tool mark lag kind, as examples/linuxcnc/machine/machine.hal adds them; then as it
  // did before it had the last two, and without the mark.
  for (const std::string mark : {" 0 0.0125 2", " 0", ""}) {
    std::string text;
    for (int i = 0; i < 20; ++i) text += std::to_string(1000 * i) + " 1 2 3 5 4 1200 7" + mark + "\n";
    std::istringstream in(text + "20000 1 2 3\n");
    Job job;
    std::vector<Reading> read;
    const auto end = read_linuxcnc(
        in, "samples", {}, {}, 0.001, [&](const Reading& r) { read.push_back(r); }, job);
    ASSERT_TRUE(end) << to_text(end.error());
    ASSERT_EQ(read.size(), 20U);
    EXPECT_EQ(read[19].tool, 7);
    EXPECT_EQ(read[19].program_line, 4);
    EXPECT_EQ(read[19].says(Item::kLag), mark.size() > 2);
    EXPECT_EQ(read[19].number[index_of(Item::kLag)], mark.size() > 2 ? 0.0125 : 0.0);
    ASSERT_EQ(job.diagnostics().size(), 1U);  // the row that is cut short
    EXPECT_EQ(job.diagnostics()[0].severity, Severity::kWarning);
  }
}

TEST(Splitter, KeepsAnEventWhereALimitIsExceededForLongEnough) {
  SplitOptions options{.triggers = {{Item::kLag, 0.01, 0.0}, {Item::kLoad, 30.0, 1.5}},
                       .runs_unless_said = true};
  const Split s = split_table(kLog, options);
  ASSERT_EQ(s.steps[0].events.size(), 2U);
  const auto of = [&](std::string_view item) {
    for (const Event& e : s.steps[0].events) {
      if (e.item == item) return e;
    }
    return Event{};
  };
  EXPECT_DOUBLE_EQ(of("lag_mm").peak, 0.03);
  EXPECT_EQ(of("lag_mm").program_line, 12);
  EXPECT_DOUBLE_EQ(of("load_percent").t_s, 1.0);
  options.triggers[1].for_s = 2.5;  // it was two seconds
  EXPECT_EQ(split_table(kLog, options).steps[0].events.size(), 1U);
}

TEST(Splitter, KnowsAStepThatTheLogEndsWithin) {
  const auto cut_off = [](const std::string& rows, const std::string& head) {
    const Split s = split_table(head + rows);
    return s.steps.empty() ? std::optional<bool>() : s.steps.back().cut_off;
  };
  const std::string fed = "time_s,tool,feed_mm_min\n", placed = "time_s,tool,x,y,z\n",
                    run = "time_s,tool,feed_mm_min,running\n";
  EXPECT_EQ(cut_off("0,1,100\n1,1,100\n", fed), true);
  EXPECT_EQ(cut_off("0,1,100\n1,1,0\n", fed), false);
  EXPECT_EQ(cut_off("0,1,100\n1,2,100\n", fed), true);  // of the second tool there is one reading
  EXPECT_EQ(cut_off("0,1,0,0,0\n1,1,5,0,0\n", placed), true);
  EXPECT_EQ(cut_off("0,1,0,0,0\n1,1,5,0,0\n2,1,5,0,0\n", placed), false);
  // Where the log says whether the program runs, it stands still within a step, too.
  EXPECT_EQ(cut_off("0,1,100,1\n1,1,0,1\n", run), true);
  EXPECT_EQ(cut_off("0,1,100,1\n1,1,0,0\n", run), false);
}

TEST(Splitter, CountsTimeWithoutReadingsWhileMovingAsAGap) {
  const Split s = split_table("time_s,tool,feed_mm_min\n0,1,100\n1,1,100\n61,1,100\n62,1,0\n500,1,0\n");
  EXPECT_DOUBLE_EQ(s.steps.at(0).gap_s, 60.0);
  EXPECT_DOUBLE_EQ(s.steps.at(0).longest_stop_s, 438.0);  // standing still is no gap
}

TEST(Splitter, ThinsLoadsByChangeAndKeepsTheirNumberBounded) {
  std::string text = "time_s,tool,feed_mm_min,load_percent\n";
  for (int i = 0; i < 20000; ++i) text += std::to_string(i) + ",1,100," + std::to_string(i % 7 * 10) + "\n";
  const Split s = split_table(text);
  const auto& load = s.steps.at(0).load;
  EXPECT_LE(load.size(), SplitOptions{}.most_kept);
  EXPECT_GE(load.size(), SplitOptions{}.most_kept / 4);
  EXPECT_GT(load.back().t_s, 19000.0);
  const Split flat =
      split_table("time_s,tool,feed_mm_min,load_percent\n0,1,100,50\n1,1,100,50.5\n2,1,100,60\n3,1,100,60\n");
  EXPECT_EQ(flat.steps.at(0).load.size(), 2U);
}

TEST(Splitter, FindsTheValueThatHeldLongest) {
  const Split s = split_table("time_s,tool,feed_mm_min\n0,1,5000\n1,1,600\n4,1,601\n8,1,40\n10,1,0\n");
  const Statistic& feed = s.steps.at(0).of(Item::kFeed);
  EXPECT_NEAR(feed.held, 600.0, 2.0);
  EXPECT_DOUBLE_EQ(feed.held_s, 7.0);
  EXPECT_DOUBLE_EQ(feed.peak, 5000.0);
}

}  // namespace
}  // namespace capstan::casebase::retain
