#include "planner/controls/gcode/writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "planner/ground/base/number.h"
#include "tests/support/empty_plan.h"

// A control that nobody has, with words unlike any other's: what the shared pieces take from a control, and
// what they say themselves.

namespace capstan::controls::gcode {
namespace {

using model::CutterPath;
using model::MoveRole;
using model::Plan;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr std::array<std::string_view, 2> kOffsets = {"G54", "G54.1"};

const Words kWords{
    .work_offsets = kOffsets,
    .longest_line = 80,
    .speed_decimals = 0,
    .dwell_decimals = 1,
    .first = "%",
    .last = "M30",
    .number =
        [](double value, int decimals) {
          const std::string text = trimmed(value, decimals);
          return text.find('.') == std::string::npos ? text + "." : text;
        },
    .path_mode = [](const std::string& p,
                    bool /*finishes*/) { return p.empty() ? std::string("G9") : "G5.1 R" + p; },
    .retract = [](const std::string& z) { return "G28 Z" + z; },
    .message = [](const std::string& text) { return "(SHOW " + text + ")"; },
    .dwell = [](const std::string& seconds) { return "G4 X" + seconds; },
    .tap =
        [](const HoleCycle& h) {
          return "M29\nG84 Z" + kWords.number(h.bottom_z, 1) + " R" + kWords.number(h.r_z, 1) + " F" +
                 kWords.number(h.pitch_mm, 2);
        },
};

std::string program_of(const Plan& plan, const std::vector<model::Condemnation>& condemned = {}) {
  Job job;
  const auto text = write(plan, kWords, condemned, job);
  EXPECT_TRUE(text) << (text ? "" : to_text(text.error()));
  return text.value_or("");
}

CutterPath cut() {
  CutterPath p;
  p.start({0, 0, 5});
  p.line({0, 0, -3}, MoveRole::kPlunge);
  p.line({10.25, 0, -3}, MoveRole::kCut);
  p.rapid({10.25, 0, 5}, MoveRole::kRetract);
  return p;
}

TEST(GcodeWriter, SaysInTheControlsWordsWhatControlsSayDifferently) {
  Plan plan = testing::empty_plan();
  testing::add_step(plan, "a", "em18", cut(), 3000.4);
  const std::string text = program_of(plan);
  EXPECT_THAT(text, StartsWith("%\n(CAPSTAN PROGRAM version=1)\n"));
  EXPECT_THAT(text, EndsWith("(end)\nG28 Z0.\nM5\nM9\nM30\n"));
  EXPECT_THAT(text, HasSubstr("G21 G17 G90 G94 G40 G80\nG5.1 R0.01\nG54\nT1 M6\nG43 H1\nS3000. M3\nG4 X1.5\n"
                              "G0 X0. Y0.\nM8\nG0 Z5.\nG1 Z-3. F600.\nG1 X10.25\nG0 Z5.\n"));
  for (const char* linuxcnc : {"G64", "G53", "MSG", "G4 P", "M2\n"})
    EXPECT_THAT(text, Not(HasSubstr(linuxcnc)));
}

TEST(GcodeWriter, TakesCommentsStatesAndToolChangesFromAControlThatHasItsOwn) {
  constexpr std::string_view kBegin = "; ";
  Words words = kWords;
  words.comment_begin = kBegin;
  words.comment_end = "";
  words.first_state = "G71 D0";
  words.step_state = "G71";
  words.change_tool = [](const std::string& tool, const std::string& /*id*/, const std::string& /*speed*/) {
    return "T=" + tool + "\nM6";
  };
  words.length_offset = [](const std::string& tool) { return "D" + tool; };
  Plan plan = testing::empty_plan();
  testing::add_step(plan, "a", "em18", cut());
  Job job;
  const auto text = write(plan, words, {}, job);
  ASSERT_TRUE(text) << to_text(text.error());
  EXPECT_THAT(*text, StartsWith("%\n; CAPSTAN PROGRAM version=1\n"));
  EXPECT_THAT(*text, HasSubstr("\nG71 D0\nG5.1 R0.01\n"));
  EXPECT_THAT(*text,
              HasSubstr("\n; CAPSTAN STEP id=\"a\" n=1 tool=1 setup=1\nG71\nG5.1 R0.01\nG54\nT=1\nM6\nD1\n"));
  EXPECT_THAT(*text, Not(HasSubstr("(")));
  for (const char* other : {"G21", "G43", "G49"}) EXPECT_THAT(*text, Not(HasSubstr(other)));
}

TEST(GcodeWriter, StopsExactlyWhereTheMachineHasNoPathTolerance) {
  Plan plan = testing::empty_plan();
  plan.machine.control.path_tolerance_mm = 0.0;
  testing::add_step(plan, "a", "em18", cut()).contour_tolerance_mm = 0.05;
  EXPECT_THAT(program_of(plan), HasSubstr("\nG9\n"));
  EXPECT_THAT(program_of(plan), Not(HasSubstr("G5.1")));
}

TEST(GcodeWriter, TapsInTheControlsWords) {
  Plan plan = testing::empty_plan();
  CutterPath p;
  p.start({10, 10, 5});
  p.rapid({10, 10, 2});
  p.line({10, 10, -8}, MoveRole::kTap);
  p.line({10, 10, 2}, MoveRole::kTap);
  p.rapid({10, 10, 5}, MoveRole::kRetract);
  testing::add_step(plan, "thread", "tap_m6", std::move(p), 500.0, 500.0);
  EXPECT_THAT(program_of(plan), HasSubstr("G0 Z2.\nM29\nG84 Z-8. R2. F1.\nG0 Z5.\n"));
}

TEST(GcodeWriter, NoCommentOrMessageIsLongerThanTheControlsLine) {
  Plan plan = testing::empty_plan();
  plan.file_name = std::string(300, 'f');
  testing::add_step(plan, "a", "em18", cut());
  const std::string text =
      program_of(plan, {{"a", "CHK-GOUGE", std::string(300, 'g')}, {"", "CHK-ORDER", std::string(300, 'o')}});
  for (std::size_t at = 0, end = 0; (end = text.find('\n', at)) != std::string::npos; at = end + 1)
    EXPECT_LE(end - at, kWords.longest_line) << text.substr(at, end - at);
}

TEST(GcodeWriter, RefusesAWorkOffsetThatTheControlDoesNotHave) {
  Plan plan = testing::empty_plan();
  plan.setups[0].work_offset = "G55";
  testing::add_step(plan, "a", "em18", cut());
  Job job;
  const auto text = write(plan, kWords, {}, job);
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().code, "OUT-SETUP");
  EXPECT_EQ(text.error().hint, "G54 to G54.1");
}

}  // namespace
}  // namespace capstan::controls::gcode
