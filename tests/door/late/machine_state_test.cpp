#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "planner/door/service/session.h"
#include "planner/ground/base/number.h"
#include "tests/door/late/brought.h"

// What a control says of its running machine, by the options that C and `capstan bind` share.

namespace capstan::late {
namespace {

using ::testing::HasSubstr;

/// A part bound with one option more.
struct Bound {
  service::Code code = service::Code::kFault;
  std::string message, program;
  double machining_s = 0.0;
};
Bound bound(const std::string& option, const std::string& value, const std::string& part = kPlate,
            const std::string& tools = kMagazine) {
  service::Session session;
  Bound out;
  (void)session.set("tools", tools);
  if (!option.empty() && session.set(option, value) != service::Code::kDone)
    return {session.code(), session.message(), {}, 0.0};
  out.code = session.bind(testing::slurp(part), std::chrono::hours(1));
  out.message = session.message();
  if (const std::string* program = session.output("linuxcnc")) out.program = *program;
  out.machining_s = session.machining_s();
  return out;
}

TEST(LateState, OfASpindleThatMayGiveLessTheStepsTakeLonger) {
  const std::string part = testing::source_dir() + "/examples/bracket.p21";
  const std::string tools = testing::scratch_file("bracket.tbl");
  std::ofstream(tools) << brought(part, pipeline::Format::kJson).table;
  const Bound whole = bound({}, {}, part, tools), less = bound("spindle-power", "1.5", part, tools);
  ASSERT_EQ(whole.code, service::Code::kDone) << whole.message;
  ASSERT_EQ(less.code, service::Code::kDone) << less.message;
  EXPECT_GT(less.machining_s, whole.machining_s);
}

TEST(LateState, AnOverrideAboveTheWholeFeedIsRefusedAndALowerOneIsTold) {
  EXPECT_EQ(bound("feed-override", "120").code, service::Code::kUsage);
  const Bound lower = bound("feed-override", "50");
  ASSERT_EQ(lower.code, service::Code::kDone) << lower.message;
  EXPECT_THAT(lower.message, HasSubstr("50 % of the programmed feeds"));
  EXPECT_EQ(lower.program, bound({}, {}).program);
}

/// Where the work offset of these tests lies.
constexpr double kOffsetX = 210.5, kOffsetY = 120.25, kOffsetZ = -95.125;
const std::string kOffset = "X=210.5,Y=120.25,Z=-95.125";

/// An arc between two rounded ends may reach beyond them by their last digit, 0.0001 mm.
constexpr double kDigit = 1e-3, kLittle = 0.01;

/// How far the axes go with a program, machine coordinates, and at which step Z is lowest: read from its
/// lines. The plate's paths have no arc that reaches beyond its ends by more than kDigit.
struct Reach {
  double x_least = 1e9, x_most = -1e9, y_least = 1e9, y_most = -1e9, z_least = 1e9, top = -1e9;
  std::string deepest;
};
Reach reach_of(const std::string& program) {
  std::map<int, double> lengths;
  std::istringstream table(testing::slurp(kMagazine));
  for (std::string line; std::getline(table, line);)
    lengths[std::stoi(line.substr(1))] = std::stod(line.substr(line.find('Z') + 1));
  Reach out;
  std::string step;
  double length = 0.0;
  std::istringstream lines(program);
  for (std::string line; std::getline(lines, line);) {
    const auto word = [&](char letter) -> std::optional<double> {
      const auto at = line.find(std::string(" ") + letter);
      return at == std::string::npos ? std::nullopt : std::optional(std::stod(line.substr(at + 2)));
    };
    if (const auto id = line.find("STEP id=\""); id != std::string::npos)
      step = line.substr(id + 9, line.find('"', id + 9) - id - 9);
    if (line.empty() || line[0] != 'G') continue;
    if (line.starts_with("G53")) out.top = std::max(out.top, word('Z').value());
    if (line.starts_with("G43 H")) length = lengths.at(std::stoi(line.substr(5)));
    const std::string code = line.substr(0, line.find(' '));
    if (code != "G0" && code != "G1" && code != "G2" && code != "G3") continue;
    if (const auto x = word('X')) {
      out.x_least = std::min(out.x_least, kOffsetX + *x);
      out.x_most = std::max(out.x_most, kOffsetX + *x);
    }
    if (const auto y = word('Y')) {
      out.y_least = std::min(out.y_least, kOffsetY + *y);
      out.y_most = std::max(out.y_most, kOffsetY + *y);
    }
    const auto z = word('Z');
    if (!z || kOffsetZ + *z + length >= out.z_least) continue;
    out.z_least = kOffsetZ + *z + length;
    out.deepest = step;
  }
  std::replace(out.deepest.begin(), out.deepest.end(), '%', ' ');
  return out;
}

/// Bound within limits of the axes.
Bound within(const std::string& limits, const std::string& offset = kOffset) {
  service::Session session;
  Bound out;
  (void)session.set("tools", kMagazine);
  EXPECT_EQ(session.set("axis-limits", limits), service::Code::kDone) << session.message();
  if (!offset.empty()) {
    EXPECT_EQ(session.set("work-offset", offset), service::Code::kDone) << session.message();
  }
  out.code = session.bind(testing::slurp(kPlate), std::chrono::hours(1));
  out.message = session.message();
  if (const std::string* program = session.output("linuxcnc")) out.program = *program;
  return out;
}
std::string range(const char* axis, double least, double most) {
  return std::string(axis) + "=" + fixed(least, 4) + ":" + fixed(most, 4);
}

TEST(LateState, LimitsOfAxesThatTheProgramKeepsMoveNothing) {
  const std::string whole = bound({}, {}).program;
  const Reach r = reach_of(whole);
  ASSERT_LT(r.x_least, r.x_most);
  ASSERT_LT(r.z_least, r.top);
  const Bound out =
      within(range("X", r.x_least - kDigit, r.x_most + kDigit) + "," +
             range("Y", r.y_least - kDigit, r.y_most + kDigit) + "," + range("Z", r.z_least, r.top));
  ASSERT_EQ(out.code, service::Code::kDone) << out.message;
  EXPECT_EQ(out.program, whole);
}

TEST(LateState, AProgramThatTakesAnAxisBeyondALimitIsNotGiven) {
  const Reach r = reach_of(bound({}, {}).program);
  constexpr double kFar = 1e4;
  const std::vector<std::pair<std::string, std::string>> cases = {
      {range("X", r.x_least + kLittle, kFar), "axis X to " + trimmed(r.x_least, 3) + " mm"},
      {range("X", -kFar, r.x_most - kLittle), "axis X to " + trimmed(r.x_most, 3) + " mm"},
      {range("Y", r.y_least + kLittle, kFar), "axis Y to " + trimmed(r.y_least, 3) + " mm"},
      {range("Y", -kFar, r.y_most - kLittle), "axis Y to " + trimmed(r.y_most, 3) + " mm"},
      {range("Z", r.z_least + kLittle, kFar), "axis Z to " + trimmed(r.z_least, 3) + " mm"},
      {range("Z", -kFar, r.top - kLittle), "axis Z to " + trimmed(r.top, 3) + " mm"}};
  for (const auto& [limits, says] : cases) {
    const Bound out = within(limits);
    EXPECT_EQ(out.code, service::Code::kImpossible) << limits;
    EXPECT_EQ(out.program, "") << limits;
    EXPECT_THAT(out.message, HasSubstr(says)) << limits;
    EXPECT_THAT(out.message, HasSubstr("LATE-PLACE"));
  }
}

/// The travels of the machine that the plate is planned for, as its file states them.
std::vector<model::LinearAxis> travels() {
  const auto plan = brought(kPlate, pipeline::Format::kJson).plan;
  return {plan.machine.axes.begin(), plan.machine.axes.end()};
}

TEST(LateState, LimitsWiderThanTheTravelOfTheMachineAreNoLeaveToGoBeyondIt) {
  const Reach r = reach_of(bound({}, {}).program);
  const double most = travels()[0].travel_max_mm;
  const double length = r.x_most - r.x_least;
  // The farthest place of X ends at the travel's end, and beyond it by a little.
  const double at_end = kOffsetX + most - r.x_most;
  ASSERT_LT(length, most - travels()[0].travel_min_mm);
  const auto offset = [](double x) { return "X=" + fixed(x, 4) + ",Y=0,Z=-95.125"; };
  const Bound kept = within("X=-10000:10000", offset(at_end - kLittle));
  EXPECT_EQ(kept.code, service::Code::kDone) << kept.message;
  const Bound beyond = within("X=-10000:10000", offset(at_end + kLittle));
  EXPECT_EQ(beyond.code, service::Code::kImpossible);
  EXPECT_EQ(beyond.program, "");
  EXPECT_THAT(beyond.message, HasSubstr("axis X to " + trimmed(most + kLittle, 3) + " mm"));
}

TEST(LateState, AnAxisWithoutALimitOfItsOwnKeepsToItsTravel) {
  const Reach r = reach_of(bound({}, {}).program);
  const double at_end = kOffsetX + travels()[0].travel_max_mm - r.x_most;
  const auto y_only = [](double x) { return within("Y=-1000:1000", "X=" + fixed(x, 4) + ",Y=0,Z=-95.125"); };
  const Bound kept = y_only(at_end - kLittle);
  EXPECT_EQ(kept.code, service::Code::kDone) << kept.message;
  const Bound beyond = y_only(at_end + kLittle);
  EXPECT_EQ(beyond.code, service::Code::kImpossible);
  EXPECT_EQ(beyond.program, "");
  EXPECT_THAT(beyond.message, HasSubstr("LATE-PLACE"));
}

TEST(LateState, LimitsThatDoNotMeetTheTravelOfTheMachineAreRefused) {
  const double most = travels()[0].travel_max_mm;
  const Bound out = within(range("X", most + 1.0, most + 500.0));
  EXPECT_EQ(out.code, service::Code::kImpossible);
  EXPECT_EQ(out.program, "");
  EXPECT_THAT(out.message, HasSubstr("nowhere is within both"));
}

TEST(LateState, ALimitNamesTheStepThatLeavesIt) {
  const Reach r = reach_of(bound({}, {}).program);
  ASSERT_NE(r.deepest, "");
  const Bound out = within(range("Z", r.z_least + kLittle, 1e4));
  const std::string name = r.deepest.substr(0, r.deepest.find(' '));
  EXPECT_THAT(out.message, HasSubstr("step '" + name));
}

TEST(LateState, LimitsOfAxesWantTheWorkOffsetThatTheProgramNames) {
  const Bound out = within("X=-1000:1000", "");
  EXPECT_EQ(out.code, service::Code::kImpossible);
  EXPECT_EQ(out.program, "");
  EXPECT_THAT(out.message, HasSubstr("where G54 lies is not told"));
  EXPECT_EQ(within("X=-1000:1000", "G55:" + kOffset).code, service::Code::kImpossible);
  EXPECT_EQ(within("X=-1000:1000", "G55:" + kOffset + ";G54:" + kOffset).code, service::Code::kDone);
  EXPECT_EQ(within("W=-1000:1000").code, service::Code::kImpossible);
}

TEST(LateState, WithLimitsOfAxesAProgramForAnotherControlIsNotGiven) {
  service::Session session;
  (void)session.set("tools", kMagazine);
  (void)session.set("axis-limits", "X=-1000:1000");
  (void)session.set("work-offset", kOffset);
  ASSERT_EQ(session.bind(testing::slurp(kPlate), std::chrono::hours(1)), service::Code::kDone);
  EXPECT_NE(session.output("linuxcnc"), nullptr);
  EXPECT_EQ(session.output("fanuc"), nullptr);
  EXPECT_THAT(session.message(), HasSubstr("LATE-PLACE"));
}

TEST(LateState, WhatWasBoundBeforeLimitsOfAxesAreSetIsNotGiven) {
  for (const auto& [option, value] : {std::pair{"axis-limits", "X=-1:1"}, {"work-offset", "X=1,Y=2,Z=3"}}) {
    service::Session session;
    (void)session.set("tools", kMagazine);
    ASSERT_EQ(session.bind(testing::slurp(kPlate), std::chrono::hours(1)), service::Code::kDone);
    ASSERT_NE(session.output("linuxcnc"), nullptr);
    ASSERT_EQ(session.set(option, value), service::Code::kDone);
    EXPECT_EQ(session.output("linuxcnc"), nullptr) << option;
    EXPECT_EQ(session.output("json"), nullptr) << option;
  }
}

TEST(LateState, AStepByStepBindGoesOnAfterLimitsOfAxesAreSet) {
  service::Session session;
  (void)session.set("tools", kMagazine);
  (void)session.take(testing::slurp(kPlate));
  ASSERT_EQ(session.bind_next({}, 0, 1, std::chrono::hours(1)), service::Code::kDone) << session.message();
  ASSERT_EQ(session.set("work-offset", kOffset), service::Code::kDone);
  ASSERT_EQ(session.set("axis-limits", "X=-1000:1000"), service::Code::kDone);
  ASSERT_EQ(session.bind_next({}, 0, 1, std::chrono::hours(1)), service::Code::kDone) << session.message();
  EXPECT_NE(session.output("linuxcnc"), nullptr);
}

TEST(LateState, AStepAloneIsHeldToTheLimitsOfAxes) {
  const auto next = [](const std::string& limits) {
    service::Session session;
    (void)session.set("tools", kMagazine);
    (void)session.set("axis-limits", limits);
    (void)session.set("work-offset", kOffset);
    (void)session.take(testing::slurp(kPlate));
    const auto code = session.bind_next({}, 0, 1, std::chrono::hours(1));
    const std::string* program = session.output("linuxcnc");
    return std::pair(code, program == nullptr ? std::string() : *program);
  };
  const auto [code, program] = next("X=-1000:1000");
  ASSERT_EQ(code, service::Code::kDone);
  const Reach r = reach_of(program);
  EXPECT_EQ(next(range("X", r.x_least - kDigit, r.x_most + kDigit)).second, program);
  const auto narrow = next(range("X", r.x_least + kLittle, r.x_most + kDigit));
  EXPECT_EQ(narrow.first, service::Code::kImpossible);
  EXPECT_EQ(narrow.second, "");
}

}  // namespace
}  // namespace capstan::late
