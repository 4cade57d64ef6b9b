#include "planner/proof/verify/told/raw_piece.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "planner/proof/verify/verify.h"
#include "tests/proof/verify/checked.h"
#include "tests/proof/verify/told/two_setups.h"

namespace capstan::verify {
namespace {

using testing::replaced;
using testing::text_of_two;
using testing::told;
using testing::two_setups;

std::vector<model::Finding> alone(const std::string& text) {
  const model::Plan plan = two_setups();
  Job job;
  return check_program({"part.ngc", text, testing::tool_table_of(plan)}, nullptr, plan.machine, plan.cutters,
                       job);
}

/// A program with one marker behind this comment.
Program with_comment(const std::vector<std::string>& comments, long setup = 1) {
  Program out;
  long line = 0;
  for (const std::string& c : comments) keep_told(c, ++line, false, out);
  out.markers.push_back({"a", 1, ++line, setup, 1, false});
  out.lines = line;
  return out;
}

TEST(ToldRaw, IsReadAsEachControlWritesIt) {
  for (const std::string& text :
       {std::string("set-up 1: the raw piece reaches from X0 Y-2.5 Z-30 to X120 Y80 Z1"),
        std::string("SET-UP 1: THE RAW PIECE REACHES FROM X0. Y-2.5 Z-30. TO X120. Y80. Z1.")}) {
    const auto raw = told_raw(with_comment({"part: A", text, "set-up 1: held by vise"}));
    ASSERT_TRUE(raw) << text;
    EXPECT_EQ(raw->setup, 1);
    EXPECT_EQ(raw->box.lo, (geometry::Vec3{0, -2.5, -30}));
    EXPECT_EQ(raw->box.hi, (geometry::Vec3{120, 80, 1}));
  }
  const auto split = told_raw(
      with_comment({"set-up 1: the raw piece reaches from X0 Y0 Z-30 to", "   X120 Y80 Z1", "end of it"}));
  ASSERT_TRUE(split);
  EXPECT_EQ(split->box.hi, (geometry::Vec3{120, 80, 1}));
}

TEST(ToldRaw, IsNoneOfAPieceThatWasCutBeforeOrOfNoSize) {
  EXPECT_FALSE(
      told_raw(with_comment({"set-up 1: the raw piece reaches from X0 Y0 Z0 to X9 Y9 Z9; a side that was cut "
                             "before stands back"})));
  EXPECT_FALSE(told_raw(with_comment({"set-up 1: the raw piece reaches from X0 Y0 Z0 to X9 Y9 Z0"})));
  EXPECT_FALSE(told_raw(with_comment({"set-up 1: the raw piece reaches from X0 Y0 Z0 to X9 Y9 Z9"}, 2)));
  EXPECT_FALSE(told_raw(with_comment({"stock: 120 x 80 x 31 mm"})));
}

TEST(ToldRaw, ASoundProgramAloneIsNotBlamed) {
  const auto findings = alone(text_of_two());
  for (const auto& f : findings) EXPECT_EQ(f.severity, Severity::kNote) << told(findings);
}

TEST(ToldRaw, ARapidThroughWhatStandsOfItIsFoundWithoutThePlan) {
  const struct {
    const char *from, *to, *code;
  } kFaults[] = {
      // 5 mm below the top of a piece that nothing has cut there.
      {"G0 X35 Y35 Z10\n", "G0 X10 Y35 Z-5\nG0 X35 Y35 Z10\n", "CHK-RAPID"},
      // The first plunge of the pocket.
      {"G1 X50 Y50 Z-5 F600", "G0 X50 Y50 Z-5", "CHK-RAPID-DOWN"},
  };
  for (const auto& f : kFaults) {
    const std::string text = replaced(text_of_two(), f.from, f.to);
    ASSERT_FALSE(text.empty()) << f.from;
    const auto findings = alone(text);
    const auto found =
        std::find_if(findings.begin(), findings.end(), [&](const auto& x) { return x.code == f.code; });
    ASSERT_NE(found, findings.end()) << told(findings);
    EXPECT_EQ(found->severity, Severity::kWarning);
    EXPECT_EQ(found->step, "pocket");
    EXPECT_TRUE(found->unproved);
  }
}

TEST(ToldRaw, TheNoteSaysWhatIsHeldAgainstIt) {
  const auto note = [](const std::string& text) {
    for (const auto& f : alone(text)) {
      if (f.code == "CHK-NOT-JUDGED") return f.message;
    }
    return std::string();
  };
  EXPECT_NE(note(text_of_two()).find("rapids of set-up 1 are held against the raw piece"), std::string::npos);
  const std::string line = "(set-up 1: the raw piece reaches from X0 Y0 Z-50 to X100 Y100 Z0)\n";
  EXPECT_NE(note(replaced(text_of_two(), line, "")).find("but not where it lies"), std::string::npos);
}

}  // namespace
}  // namespace capstan::verify
