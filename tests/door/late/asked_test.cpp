#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "capstan/capstan_late.h"
#include "planner/files/json/json.h"
#include "tests/door/late/brought.h"

// What a control asks through the interface for C beside binding: what no longer holds, what does not suit
// it, and which broadcasts are due.

namespace capstan::late {
namespace {

using namespace ::testing;

/// A session with the bracket's plan, bound to its end, and the tool table that it was made for.
class LateAsked : public Test {
 protected:
  static const Brought& bracket() {
    static const Brought kBracket =
        brought(capstan::testing::source_dir() + "/examples/bracket.p21", pipeline::Format::kJson);
    return kBracket;
  }
  void SetUp() override {
    tools(bracket().table);
    const std::string json = json::write_json(bracket().plan);
    ASSERT_EQ(capstan_late_take(s_, json.data(), json.size()), CAPSTAN_LATE_OK) << capstan_late_message(s_);
  }
  void TearDown() override { capstan_late_close(s_); }

  void set(const char* option, const std::string& value) {
    ASSERT_EQ(capstan_late_set(s_, option, value.c_str()), CAPSTAN_LATE_OK) << capstan_late_message(s_);
  }
  void tools(const std::string& table) {
    const std::string path = capstan::testing::scratch_file("late_asked.tbl");
    std::ofstream(path) << table;
    set("tools", path);
  }
  std::string no_longer() {
    const char* text = capstan_late_no_longer_valid(s_);
    EXPECT_NE(text, nullptr) << capstan_late_message(s_);
    return text == nullptr ? "" : text;
  }
  std::string unsuited() {
    const char* text = capstan_late_unsuited(s_);
    EXPECT_NE(text, nullptr) << capstan_late_message(s_);
    return text == nullptr ? "" : text;
  }
  static int lines(const std::string& text) {
    return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
  }

  capstan_late* s_ = capstan_late_create();
};

TEST_F(LateAsked, OfThePlanAsItWasMadeAllHolds) { EXPECT_EQ(no_longer(), ""); }

TEST_F(LateAsked, AToolThatWasSetAnewIsToldWithItsLengths) {
  const int mill = eight_mill(bracket().plan);
  tools(with(bracket().table, mill, "Z", 1.5));
  const std::string told = no_longer();
  EXPECT_EQ(lines(told), 1) << told;
  EXPECT_THAT(told, HasSubstr("tool T" + std::to_string(mill) + " (endmill 8 mm) has length "));
  EXPECT_THAT(told, HasSubstr("checked anew"));
}

TEST_F(LateAsked, AMissingAndABrokenToolAreToldWithTheirOperations) {
  const int mill = eight_mill(bracket().plan);
  tools(without(bracket().table, mill));
  EXPECT_THAT(no_longer(), HasSubstr("is not in the magazine; re-opened"));
  tools(bracket().table);
  const std::string state = "T" + std::to_string(mill) + " broken\n";
  ASSERT_EQ(capstan_late_tool_state(s_, state.data(), state.size()), CAPSTAN_LATE_OK);
  EXPECT_THAT(no_longer(), HasSubstr("which is broken; re-opened"));
}

TEST_F(LateAsked, AWornMillAnotherMaterialAndAnotherMachineAreTold) {
  tools(with(bracket().table, eight_mill(bracket().plan), "D", -0.05));
  EXPECT_THAT(no_longer(), HasSubstr("measures 7.95 mm"));
  tools(bracket().table);
  set("material", "42CrMo4+QT");
  EXPECT_THAT(no_longer(), StartsWith("the work is of 42crmo4_qt, the plan was made for "));
  set("material", bracket().plan.material.id);
  set("spindle-power", "2");
  EXPECT_THAT(no_longer(), HasSubstr(" is another than the plan was made for ("));
}

TEST_F(LateAsked, AMaterialThatNobodyKnowsIsAFaultAndNoAnswer) {
  set("material", "steeel");
  EXPECT_EQ(capstan_late_no_longer_valid(s_), nullptr);
  EXPECT_NE(capstan_late_status(s_), CAPSTAN_LATE_OK);
  EXPECT_THAT(capstan_late_message(s_), HasSubstr("steeel"));
}

TEST_F(LateAsked, OfStepsThatAreCutNothingIsAsked) {
  const std::string text = testing::slurp(kPlate);
  tools(testing::slurp(kMagazine));
  ASSERT_EQ(capstan_late_take(s_, text.data(), text.size()), CAPSTAN_LATE_OK);
  EXPECT_THAT(no_longer(), HasSubstr("DRILL PLAIN HOLE"));
  for (int step = 1; step <= 4; ++step) {
    ASSERT_EQ(capstan_late_bind_next(s_, nullptr, 0, 0, 1, 600000), CAPSTAN_LATE_OK)
        << capstan_late_message(s_);
    if (no_longer().empty()) return;
  }
  FAIL() << no_longer();
}

TEST_F(LateAsked, NothingIsBoundByAsking) {
  tools(without(bracket().table, eight_mill(bracket().plan)));
  const std::string open = capstan_late_left_open(s_);
  EXPECT_NE(no_longer(), "");
  EXPECT_EQ(capstan_late_left_open(s_), open);
  EXPECT_EQ(capstan_late_output(s_, CAPSTAN_LATE_LINUXCNC, nullptr), nullptr);
}

TEST_F(LateAsked, WithoutAPlanThereIsNoAnswer) {
  capstan_late* empty = capstan_late_open("generic_vmc", kMagazine.c_str());
  EXPECT_EQ(capstan_late_no_longer_valid(empty), nullptr);
  EXPECT_EQ(capstan_late_status(empty), CAPSTAN_LATE_USAGE);
  EXPECT_EQ(capstan_late_unsuited(empty), nullptr);
  EXPECT_EQ(capstan_late_measured(empty, "start", "x", nullptr, -1.0, nullptr, nullptr, 0), nullptr);
  EXPECT_THAT(capstan_late_message(empty), HasSubstr("BROADCAST-PLAN"));
  EXPECT_EQ(capstan_late_no_longer_valid(nullptr), nullptr);
  EXPECT_EQ(capstan_late_unsuited(nullptr), nullptr);
  EXPECT_EQ(capstan_late_measured(nullptr, "start", "x", nullptr, -1.0, nullptr, nullptr, 0), nullptr);
  capstan_late_close(empty);
}

TEST_F(LateAsked, AControlThatCannotIsToldBeforeTheFirstChipAndGetsNoProgram) {
  EXPECT_THAT(unsuited(), Not(HasSubstr("error: ")));
  set("profile", "grbl_alone");
  const std::string told = unsuited();
  EXPECT_THAT(told, StartsWith("error: "));
  EXPECT_THAT(told, HasSubstr("[FIT-TOOL-CHANGE]"));
  const std::string json = json::write_json(bracket().plan);
  EXPECT_EQ(capstan_late_bind(s_, json.data(), json.size(), 600000), CAPSTAN_LATE_IMPOSSIBLE);
  EXPECT_THAT(capstan_late_message(s_), HasSubstr("[LATE-UNSUITED]"));
  EXPECT_EQ(capstan_late_output(s_, CAPSTAN_LATE_LINUXCNC, nullptr), nullptr);
  set("profile", "linuxcnc");
  EXPECT_EQ(capstan_late_bind(s_, json.data(), json.size(), 600000), CAPSTAN_LATE_OK)
      << capstan_late_message(s_);
  set("profile", "grlb");
  EXPECT_EQ(capstan_late_unsuited(s_), nullptr);
  EXPECT_EQ(capstan_late_status(s_), CAPSTAN_LATE_USAGE);
}

TEST_F(LateAsked, WhatAPlanLeavesOpenIsUnderSpecified) {
  const std::string text = testing::slurp(kPlate);
  ASSERT_EQ(capstan_late_take(s_, text.data(), text.size()), CAPSTAN_LATE_OK);
  EXPECT_THAT(unsuited(), HasSubstr("[FIT-OPEN]"));
}

TEST_F(LateAsked, WhatIsMeasuredGivesTheBroadcastsThatAreDue) {
  const std::string text = testing::slurp(kPlate);
  tools(testing::slurp(kMagazine));
  ASSERT_EQ(capstan_late_take(s_, text.data(), text.size()), CAPSTAN_LATE_OK);
  const char* const names[] = {"spindle speed", "location"};
  const char* const values[] = {"1200.5", "[1, 2, 3]"};
  const auto told = [&](const char* event, const char* step, std::size_t count) {
    const char* lines = capstan_late_measured(s_, event, step, "12:00", 1.0, names, values, count);
    return lines == nullptr ? std::string(capstan_late_message(s_)) : std::string(lines);
  };
  const std::string start = told("start", "ROUGH POCKET", 2);
  EXPECT_EQ(lines(start), 1) << start;
  EXPECT_THAT(start, HasSubstr("1200.5"));
  // A bind of one step more is the same run: its end is due, and a second start is not a run's first line.
  EXPECT_EQ(lines(told("end", "ROUGH POCKET", 0)), 1);
  ASSERT_EQ(capstan_late_bind_next(s_, nullptr, 0, 1, 1, 600000), CAPSTAN_LATE_OK)
      << capstan_late_message(s_);
  const std::string second = told("start", "ROUGH POCKET", 1);
  EXPECT_EQ(lines(second), 1);
  EXPECT_THAT(second, HasSubstr("\"sequence\":3"));
  const std::string json = json::write_json(bracket().plan);
  ASSERT_EQ(capstan_late_take(s_, json.data(), json.size()), CAPSTAN_LATE_OK);
  EXPECT_THAT(told("start", "ROUGH POCKET", 0), HasSubstr("[BROADCAST-STEP]"));  // of the plan before
  ASSERT_EQ(capstan_late_take(s_, text.data(), text.size()), CAPSTAN_LATE_OK);
  EXPECT_THAT(told("start", "ROUGH POCKET", 0), HasSubstr("\"sequence\":1"));
  EXPECT_THAT(told("start", "NO SUCH STEP", 0), HasSubstr("[BROADCAST-STEP]"));
  EXPECT_THAT(told("pause", "ROUGH POCKET", 0), HasSubstr("expected start, at, end or finish"));
  const char* const wrong[] = {"12,5", "[1, 2]"};
  EXPECT_EQ(capstan_late_measured(s_, "at", "ROUGH POCKET", nullptr, -1.0, names, wrong, 1), nullptr);
  EXPECT_THAT(capstan_late_message(s_), HasSubstr("[BROADCAST-VALUE]"));
  EXPECT_EQ(capstan_late_measured(s_, "at", "ROUGH POCKET", nullptr, -1.0, names + 1, wrong + 1, 1), nullptr);
  EXPECT_THAT(capstan_late_message(s_), HasSubstr("expected [x, y, z] in mm"));
  EXPECT_EQ(capstan_late_measured(s_, "at", "ROUGH POCKET", nullptr, -1.0, nullptr, nullptr, 1), nullptr);
}

}  // namespace
}  // namespace capstan::late
