#include <gtest/gtest.h>

#include "tests/casebase/retain/reading_logs.h"

namespace capstan::casebase::retain {
namespace {

const std::string kRun =
    "2017-02-01T10:00:00.0Z|Program_Status|ACTIVE\n"
    "2017-02-01T10:00:01.0Z|Current_Tool|7.0\n"
    "2017-02-01T10:00:01.0Z|Feed_Rate|10\n"
    "2017-02-01T10:00:04.5Z|Feed_Rate|0\n"
    "2017-02-01T10:00:06.0Z|Current_Tool|0\n"
    "2017-02-01T10:00:08.0Z|Current_Tool|5\n"
    "2017-02-01T10:00:08.0Z|Feed_Rate|2.5\n"
    "2017-02-01T10:00:18.0Z|Program_Status|PROGRAM_COMPLETED\n";

TEST(Trace, SplitsARunByTheToolInTheSpindle) {
  const Split s = split_trace(kRun);
  ASSERT_TRUE(s.end) << to_text(s.end.error());
  ASSERT_EQ(s.steps.size(), 2U);
  EXPECT_EQ(s.steps[0].tool, 7);
  EXPECT_DOUBLE_EQ(s.steps[0].active_s, 5.0);
  EXPECT_DOUBLE_EQ(s.steps[0].moving_s, 3.5);
  EXPECT_DOUBLE_EQ(s.steps[0].path_mm, 35.0);  // 10 mm/s for 3.5 s
  EXPECT_DOUBLE_EQ(s.steps[0].longest_stop_s, 1.5);
  EXPECT_EQ(s.steps[1].tool, 5);
  EXPECT_DOUBLE_EQ(s.steps[1].active_s, 10.0);
  EXPECT_DOUBLE_EQ(s.steps[1].of(Item::kFeed).held, 150.0);  // 2.5 mm/s in mm/min
  EXPECT_TRUE(s.steps[0].tool_changed && s.steps[1].tool_changed);
}

TEST(Trace, TakesSeveralItemsOfALineAndUnknownOnesAndDevices) {
  const Split s = split_trace(
      "2017-02-01T10:00:00Z|execution|ACTIVE|m1:Tool_number|3|path_feedrate|UNAVAILABLE\n"
      "2017-02-01T10:00:01Z|weather|fine|path_feedrate|4|S1load|40\n"
      "2017-02-01T10:00:03Z|execution|READY\n");
  ASSERT_EQ(s.steps.size(), 1U);
  EXPECT_EQ(s.steps[0].tool, 3);
  EXPECT_DOUBLE_EQ(s.steps[0].moving_s, 2.0);
  EXPECT_DOUBLE_EQ(s.steps[0].of(Item::kLoad).mean, 40.0);
  EXPECT_TRUE(s.said.empty());
}

TEST(Trace, AProgramThatIsHeldAndGoesOnIsOneRun) {
  for (const std::string held :
       {"FEED_HOLD", "INTERRUPTED", "WAIT", "OPTIONAL_STOP", "PROGRAM_OPTIONAL_STOP"}) {
    const Split s = split_trace(
        "2017-02-01T10:00:00Z|execution|ACTIVE|tool|1|path_feedrate|10\n"
        "2017-02-01T10:00:05Z|execution|" +
        held +
        "|path_feedrate|0\n"
        "2017-02-01T10:00:08Z|execution|ACTIVE|path_feedrate|10\n"
        "2017-02-01T10:00:13Z|execution|READY\n");
    ASSERT_TRUE(s.end) << held;
    ASSERT_EQ(s.steps.size(), 1U) << held;
    EXPECT_DOUBLE_EQ(s.steps[0].active_s, 13.0) << held;
    EXPECT_DOUBLE_EQ(s.steps[0].moving_s, 10.0) << held;
  }
}

TEST(Trace, KeepsRunsApart) {
  const Split s = split_trace(kRun +
                              "2017-02-06T10:00:00Z|Program_Status|ACTIVE\n"
                              "2017-02-06T10:00:07Z|Program_Status|PROGRAM_COMPLETED\n");
  ASSERT_EQ(s.steps.size(), 3U);
  EXPECT_EQ(s.steps[2].run, 2);
  EXPECT_EQ(s.steps[2].tool, 5);  // it was still in the spindle
  EXPECT_FALSE(s.steps[2].tool_changed);
  EXPECT_DOUBLE_EQ(s.steps[2].active_s, 7.0);
}

TEST(Trace, ReadsByteOrderMarkAndCarriageReturnsAsNothing) {
  std::string windows = "\xEF\xBB\xBF";
  for (const char c : kRun) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const Split plain = split_trace(kRun), s = split_trace(windows);
  ASSERT_TRUE(s.end) << to_text(s.end.error());
  ASSERT_EQ(s.steps.size(), plain.steps.size());
  EXPECT_EQ(s.steps[1].active_s, plain.steps[1].active_s);
}

TEST(Trace, LeavesOutATruncatedLineAndSaysWhich) {
  const Split s = split_trace(kRun + "2017\n");
  ASSERT_TRUE(s.end) << to_text(s.end.error());
  EXPECT_EQ(s.steps.size(), 2U);
  ASSERT_EQ(s.said.size(), 1U);
  EXPECT_EQ(s.said[0].code, "LOG-LINES");
  EXPECT_EQ(s.said[0].line, 9U);
}

TEST(Trace, LeavesOutValuesThatAreNoNumbersOrBeyondAnyMachine) {
  for (const char* bad : {"Feed_Rate|nan", "Feed_Rate|inf", "Feed_Rate|1e9", "Current_Tool|1.5",
                          "Block_Number|-4", "Feed_Rate|12,5", "Spindle_Speed|1e400"}) {
    const Split s = split_trace(kRun + "2017-02-01T10:00:19Z|" + bad + "\n");
    ASSERT_TRUE(s.end) << bad;
    EXPECT_EQ(s.end->lost, 1U) << bad;
    EXPECT_TRUE(says(s.said, "LOG-LINES")) << bad;
  }
}

TEST(Trace, LeavesOutReadingsThatGoBackInTime) {
  const Split s = split_trace(kRun + "2017-02-01T09:00:00Z|Current_Tool|9\n");
  ASSERT_TRUE(s.end);
  EXPECT_EQ(s.end->lost, 1U);
  for (const Executed& e : s.steps) EXPECT_GE(e.active_s, 0.0);
}

TEST(Trace, RefusesWhatIsNoTrace) {
  std::string other;
  for (int i = 0; i < 50; ++i) other += "G1 X" + std::to_string(i) + "\n";
  const Split s = split_trace(other);
  ASSERT_FALSE(s.end);
  EXPECT_EQ(s.end.error().code, "LOG-FORMAT");
  EXPECT_EQ(s.end.error().line, 1U);
  EXPECT_FALSE(s.end.error().expected.empty());
  EXPECT_FALSE(s.end.error().hint.empty());
  EXPECT_EQ(split_trace("").end.error().code, "LOG-EMPTY");
  EXPECT_EQ(split_trace(std::string("a\0b", 3)).end.error().code, "LOG-TEXT");
  EXPECT_EQ(split_trace(std::string(Lines::kLongest + 1, 'x')).end.error().code, "LOG-TEXT");
}

TEST(Trace, RefusesALogOfWhichOneLineInTenIsDamaged) {
  std::string text;
  for (int i = 0; i < 40; ++i) {
    text += i % 10 == 3 ? "2017-02-0\n" : "2017-02-01T10:00:" + std::to_string(10 + i) + "Z|Feed_Rate|1\n";
  }
  const Split s = split_trace(text);
  ASSERT_FALSE(s.end);
  EXPECT_EQ(s.end.error().code, "LOG-FORMAT");
}

TEST(TimeStamp, IsReadToTheFractionAndWrittenToTheSecond) {
  EXPECT_DOUBLE_EQ(*seconds_of("1970-01-01T00:00:00Z"), 0.0);
  EXPECT_DOUBLE_EQ(*seconds_of("2017-02-01T14:59:58.5000000Z"), 1485961198.5);
  for (const char* s :
       {"1970-01-01T00:00:00Z", "2000-02-29T23:59:59Z", "2017-12-31T12:00:00Z", "2100-03-01T00:00:01Z"}) {
    EXPECT_EQ(stamp_of(*seconds_of(s)), s);
  }
}

TEST(TimeStamp, IsRefusedWhereThereIsNoSuchDay) {
  for (const char* s :
       {"2017-02-29T00:00:00Z", "2017-13-01T00:00:00Z", "2017-00-10T00:00:00Z", "2017-01-01T24:00:00Z",
        "2017-01-01T00:60:00Z", "2017-01-01", "2017-01-01T00:00:00+01:00", "2017-01-01T00:00:00.x",
        "-017-01-01T00:00:00Z", "1969-12-31T23:59:59Z"}) {
    EXPECT_FALSE(seconds_of(s)) << s;
  }
}

}  // namespace
}  // namespace capstan::casebase::retain
