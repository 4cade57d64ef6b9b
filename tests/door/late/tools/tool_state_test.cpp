#include "planner/door/late/tools/tool_state.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "planner/model/plan/cutter/cutter.h"

// What a control tells of its tools: read, and taken into the tools that are loaded.

namespace capstan::late {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::vector<ToolState> read(const std::string& text) {
  auto out = parse_tool_states(text, "tools.state");
  EXPECT_TRUE(out) << (out ? "" : to_text(out.error()));
  return out ? *std::move(out) : std::vector<ToolState>{};
}

TEST(ToolStates, SayWhatBecameOfEachToolByItsNumber) {
  const auto all = read(
      "; of the mill in hall 2\n\nT3 broken # at 10:40\r\nT5 life-left 12.5 wear 0.02 length-wear 1e-2\n"
      "  T6 wear 0.05 in-table");
  ASSERT_THAT(all, SizeIs(3));
  EXPECT_EQ(all[0], (ToolState{.number = 3, .broken = true}));
  EXPECT_EQ(all[1], (ToolState{.number = 5, .wear_mm = 0.02, .length_wear_mm = 0.01, .life_left_min = 12.5}));
  EXPECT_EQ(all[2], (ToolState{.number = 6, .in_table = true, .wear_mm = 0.05}));
  EXPECT_THAT(read(""), IsEmpty());
  EXPECT_THAT(read("# none\n"), IsEmpty());
}

TEST(ToolStates, ThatCannotBeAreOneErrorWithItsLine) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"5 broken", "'5' is no tool number"},
      {"T broken", "'T' is no tool number"},
      {"T0 broken", "'T0' is no tool number"},
      {"T-5 broken", "'T-5' is no tool number"},
      {"T1.5 broken", "'T1.5' is no tool number"},
      {"T99999999999 broken", "a whole number from 1"},
      {"T5", "T5 has no state"},
      {"T5 blunt", "'blunt' is no word"},
      {"T5 wear", "wear of T5 is ''"},
      {"T5 wear nan", "wear of T5 is 'nan'"},
      {"T5 wear inf", "wear of T5 is 'inf'"},
      {"T5 wear -0.01", "wear of T5 is '-0.01'"},
      {"T5 wear 0,01", "wear of T5 is '0,01'"},
      {"T5 wear 0.01mm", "wear of T5 is '0.01mm'"},
      {"T5 length-wear 1e9", "length-wear of T5 is '1e9'"},
      {"T5 life-left 1e300", "life-left of T5 is '1e300'"},
      {"T5 wear 0.01 wear 0.02", "'wear' of T5 is there twice"},
      {"T5 broken broken", "'broken' of T5 is there twice"},
      {"T5 in-table", "none is told"},
      {"T3 broken\nT3 wear 0.1", "T3 has a line before"},
  };
  for (const auto& [text, says] : cases) {
    const auto out = parse_tool_states("T1 broken\n" + text, "tools.state");
    ASSERT_FALSE(out) << text;
    EXPECT_EQ(out.error().code, "TOOL-STATE");
    EXPECT_THAT(out.error().message, HasSubstr(says)) << text;
    EXPECT_EQ(out.error().line, text.find('\n') == std::string::npos ? 2U : 3U);
    EXPECT_EQ(out.error().file, "tools.state");
    EXPECT_THAT(out.error().expected, HasSubstr("T3 broken"));
  }
}

model::Cutter mill(int number, double z_mm = 115.0, double diameter_mm = 10.0) {
  model::Cutter c;
  c.id = "T" + std::to_string(number);
  c.cutter_class = model::CutterClass::kEndmill;
  c.cutting_diameter_mm = diameter_mm;
  c.maximum_depth_of_cut_mm = 20.0;
  c.usable_length_mm = c.stick_out_mm = 30.0;
  c.functional_length_mm = z_mm;
  c.pocket = number;
  c.loaded = true;
  c.table_line = model::ToolTableLine{};
  c.table_line->words = {{"P", 4.0}, {"Z", z_mm}, {"D", diameter_mm}};
  return c;
}

/// The loaded tools with what is told of them, for a plan that was brought.
struct Taken {
  std::vector<model::Cutter> library;
  ToldTools told;
  std::string said;
};
Taken take(const std::string& states, std::vector<model::Cutter> library, const model::Plan& brought = {}) {
  Job job;
  Taken out{std::move(library), {}, {}};
  auto told = take_tool_states(read(states), brought, out.library, job);
  EXPECT_TRUE(told) << (told ? "" : to_text(told.error()));
  if (told) out.told = *std::move(told);
  for (const Diagnostic& d : job.diagnostics()) out.said += to_text(d) + "\n";
  return out;
}

TEST(ToolStates, ThatLeaveNothingToCutWithTakeTheToolOut) {
  const Taken out = take("T3 broken\nT4 life-left 0\n", {mill(3), mill(4), mill(5)});
  ASSERT_THAT(out.library, SizeIs(1));
  EXPECT_EQ(out.library[0].pocket, 5);
  ASSERT_THAT(out.told.out_of_use, SizeIs(2));
  EXPECT_EQ(out.told.words(), "; out of use: T3 (is broken), T4 (has no life left)");
  EXPECT_THAT(out.told.life_left_min, IsEmpty());
  ASSERT_THAT(out.told.rows, SizeIs(2));
  EXPECT_EQ(out.told.rows[0].what, "tool-state T3");
  EXPECT_EQ(out.told.rows[0].value, "broken");
  EXPECT_TRUE(is_tool_state(out.told.rows[0]));
}

TEST(ToolStates, OfAToolThatIsNotThereAreTold) {
  const Taken out = take("T9 broken", {mill(3)});
  EXPECT_THAT(out.said, HasSubstr("LATE-TOOL-STATE"));
  EXPECT_THAT(out.said, HasSubstr("T9 has a state and is not in the tool table"));
  EXPECT_THAT(out.library, SizeIs(1));
  EXPECT_THAT(out.told.rows, IsEmpty());
}

TEST(ToolStates, TakeTwiceTheWearOffTheDiameterAndTheOtherOffTheLength) {
  const Taken out = take("T3 wear 0.05 length-wear 0.02", {mill(3)});
  EXPECT_DOUBLE_EQ(out.library[0].cutting_diameter_mm, 10.0 - 2.0 * 0.05);
  EXPECT_DOUBLE_EQ(out.library[0].functional_length_mm, 115.0 - 0.02);
  // What has to be in effect at the control.
  EXPECT_DOUBLE_EQ(model::table_word(out.library[0], "D").value(), 10.0 - 2.0 * 0.05);
  EXPECT_DOUBLE_EQ(model::table_word(out.library[0], "Z").value(), 115.0 - 0.02);
  EXPECT_EQ(model::table_word(out.library[0], "P"), 4.0);
  EXPECT_THAT(out.said, HasSubstr("T3: wear 0.05 mm, off D: 10 to 9.9 mm"));
  EXPECT_THAT(out.said, HasSubstr("T3: length-wear 0.02 mm, off Z: 115 to 114.98 mm"));
  EXPECT_EQ(out.told.rows.at(0).value,
            "wear 0.05 mm, off D: 10 to 9.9 mm; length-wear 0.02 mm, off Z: 115 to 114.98 mm");
}

TEST(ToolStates, OfWearThatTheTableHasTakeItOffOnce) {
  // By its word.
  const Taken said = take("T3 wear 0.05 length-wear 0.02 in-table", {mill(3, 114.98, 9.9)});
  EXPECT_EQ(said.library[0], mill(3, 114.98, 9.9));
  EXPECT_THAT(said.said, HasSubstr("T3: wear 0.05 mm, in D 9.9 mm of the tool table"));
  EXPECT_THAT(said.said, HasSubstr("T3: length-wear 0.02 mm, in Z 114.98 mm of the tool table"));
  // By the plan's tool, which measured more by just that.
  model::Plan planned;
  planned.cutters = {mill(3)};
  EXPECT_EQ(take("T3 wear 0.05", {mill(3, 115.0, 9.9)}, planned).library[0], mill(3, 115.0, 9.9));
  EXPECT_EQ(take("T3 wear 0.05", {mill(3)}, planned).library[0].cutting_diameter_mm, 9.9);
}

TEST(ToolStates, ToldAgainBehindABindingThatTookThemAreTakenOffOnce) {
  // The first binding took the wear off; the next is told the same with the old table, or with the one that
  // was given.
  const Taken first = take("T3 wear 0.05 length-wear 0.02", {mill(3)});
  model::Plan bound;
  bound.cutters = first.library;
  bound.provenance = first.told.rows;
  EXPECT_EQ(take("T3 wear 0.05 length-wear 0.02", {mill(3)}, bound).library[0], first.library[0]);
  const Taken given = take("T3 wear 0.05 length-wear 0.02", {mill(3, 114.98, 9.9)}, bound);
  EXPECT_DOUBLE_EQ(given.library[0].cutting_diameter_mm, 9.9);
  EXPECT_DOUBLE_EQ(given.library[0].functional_length_mm, 114.98);
  // Of a table that had it then, and still has it.
  bound.provenance = given.told.rows;
  EXPECT_EQ(take("T3 wear 0.05", {mill(3, 114.98, 9.9)}, bound).library[0].cutting_diameter_mm, 9.9);
  // A new edge: the table measures more than the tool was planned with.
  EXPECT_DOUBLE_EQ(take("T3 wear 0.01", {mill(3)}, bound).library[0].cutting_diameter_mm, 10.0 - 2.0 * 0.01);
}

// Wear is told as a whole since the edge was new: what the table has of it is not taken off again.
TEST(ToolStates, OfWearThatHasGrownTakeOffWhatItGrewBy) {
  model::Plan bound;
  const auto bind = [&](const std::string& states, double z_mm, double diameter_mm) {
    Taken out = take(states, {mill(3, z_mm, diameter_mm)}, bound);
    bound.cutters = out.library;
    bound.provenance = out.told.rows;
    return out;
  };
  (void)bind("T3 wear 0.05 length-wear 0.02", 115.0, 10.0);
  // The control loads the table that was given; twice, as of steps that are bound one by one.
  for (int i = 0; i < 2; ++i) {
    const Taken grown = bind("T3 wear 0.06 length-wear 0.03", 114.98, 9.9);
    EXPECT_NEAR(grown.library[0].cutting_diameter_mm, 10.0 - 2.0 * 0.06, 1e-9);
    EXPECT_NEAR(grown.library[0].functional_length_mm, 115.0 - 0.03, 1e-9);
    EXPECT_NEAR(model::table_word(grown.library[0], "D").value(), 10.0 - 2.0 * 0.06, 1e-9);
    EXPECT_THAT(grown.said, HasSubstr("T3: wear 0.06 mm, off D: 10 to 9.88 mm"));
    EXPECT_THAT(grown.said, HasSubstr("T3: length-wear 0.03 mm, off Z: 115 to 114.97 mm"));
  }
  // It is in the table now, and grows again.
  EXPECT_EQ(bind("T3 wear 0.06", 114.97, 9.88).library[0].cutting_diameter_mm, 9.88);
  EXPECT_EQ(bound.provenance.at(0).value, "wear 0.06 mm, in D 9.88 mm of the tool table");
  EXPECT_NEAR(bind("T3 wear 0.08", 114.97, 9.88).library[0].cutting_diameter_mm, 10.0 - 2.0 * 0.08, 1e-9);
  // The control's own table, of the new edge as ever: all comes off.
  EXPECT_NEAR(bind("T3 wear 0.09", 115.0, 10.0).library[0].cutting_diameter_mm, 10.0 - 2.0 * 0.09, 1e-9);
}

TEST(ToolStates, OfAnOffsetAgainstAReferenceToolGrowTheSame) {
  model::Cutter c = mill(3, -12.0);
  c.table_line->against_reference = true;
  c.functional_length_mm = 100.0;
  const Taken first = take("T3 length-wear 0.02", {c});
  model::Plan bound;
  bound.cutters = first.library;
  bound.provenance = first.told.rows;
  const Taken grown = take("T3 length-wear 0.03", first.library, bound);
  EXPECT_NEAR(model::table_word(grown.library[0], "Z").value(), -12.03, 1e-9);
}

// A table may have the wear still that an earlier binding was told.
TEST(ToolStates, OfWearStayKnownUntilTheyAreToldAnew) {
  model::Plan bound;
  bound.provenance = take("T3 wear 0.05\nT4 broken\nT5 life-left 3", {mill(3), mill(4), mill(5)}).told.rows;
  ASSERT_THAT(bound.provenance, SizeIs(3));
  const auto known = [&](const std::string& states) {
    return wear_known(bound, take(states, {mill(3, 115.0, 9.9)}, bound).told.rows);
  };
  for (const char* states : {"", "T3 life-left 2", "T3 length-wear 0.01"}) {
    ASSERT_THAT(known(states), SizeIs(1)) << states;
    EXPECT_EQ(known(states)[0].value, "wear 0.05 mm, off D: 10 to 9.9 mm");
  }
  EXPECT_THAT(known("T3 wear 0.05"), IsEmpty());
}

TEST(ToolStates, OfWearOfAToolThatIsTakenOutAreNotLookedAt) {
  const Taken out = take("T3 broken wear 5\nT4 life-left 0 length-wear 115", {mill(3), mill(4)});
  EXPECT_THAT(out.library, IsEmpty());
  EXPECT_EQ(out.told.words(), "; out of use: T3 (is broken), T4 (has no life left)");
}

TEST(ToolStates, OfAMoreThanWholeWearAreRefused) {
  for (const char* states : {"T3 wear 5", "T3 length-wear 115"}) {
    Job job;
    std::vector<model::Cutter> library = {mill(3)};
    const auto out = take_tool_states(read(states), {}, library, job);
    ASSERT_FALSE(out) << states;
    EXPECT_EQ(out.error().code, "LATE-TOOL-STATE");
    EXPECT_THAT(out.error().message, HasSubstr("T3"));
  }
}

TEST(ToolStates, OfAnOffsetAgainstAReferenceToolMayBeAnyNumber) {
  model::Cutter c = mill(3, -12.0);
  c.table_line->against_reference = true;
  c.functional_length_mm = 100.0;
  const Taken out = take("T3 length-wear 0.02", {c});
  EXPECT_DOUBLE_EQ(model::table_word(out.library[0], "Z").value(), -12.02);
  EXPECT_EQ(out.library[0].functional_length_mm, 100.0);
}

TEST(ToolStates, OfLifeCountInPlaceOfWhatTheLibraryKnew) {
  model::Cutter c = mill(3);
  c.life_min = 15.0;
  c.life_used_min = 14.9;
  const Taken out = take("T3 life-left 12", {c});
  EXPECT_DOUBLE_EQ(out.library[0].life_min - out.library[0].life_used_min, 12.0);
  EXPECT_EQ(out.told.life_left_min.at(3), 12.0);
  EXPECT_EQ(out.told.rows.at(0).value, "life left 12 min");
  const Taken more = take("T3 life-left 20", {c});
  EXPECT_DOUBLE_EQ(more.library[0].life_min - more.library[0].life_used_min, 20.0);
}

}  // namespace
}  // namespace capstan::late
