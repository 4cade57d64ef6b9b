#include "planner/door/late/tools/tool_life.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>

#include "planner/door/late/late.h"
#include "planner/door/late/next.h"
#include "planner/door/service/session.h"
#include "tests/door/late/brought.h"

// Plans bound with tools that are broken, worn or near the end of their life.

namespace capstan::late {
namespace {

using ::testing::HasSubstr;

constexpr int kSister = 24;      // the last pocket of the magazine, which no tool of the bracket has
constexpr double kTrace = 1e-9;  // min, rounding of sums

const Brought& bracket() {
  static const Brought kBrought =
      brought(capstan::testing::source_dir() + "/examples/bracket.p21", pipeline::Format::kJson);
  return kBrought;
}

std::string line_of(const std::string& table, int tool) {
  std::istringstream lines(table);
  for (std::string one; std::getline(lines, one);)
    if (one.starts_with("T" + std::to_string(tool) + " ")) return one;
  return {};
}

/// The table with a second tool that is as this one.
std::string with_sister(const std::string& table, int tool) {
  const std::string number = std::to_string(tool), line = line_of(table, tool);
  std::string own = "T" + number + " P" + number;
  EXPECT_TRUE(line.starts_with(own)) << line;
  const std::string sister = std::to_string(kSister);
  return table + "T" + sister + " P" + sister + line.substr(own.size()) + "\n";
}

std::string state(int tool, const std::string& words) { return "T" + std::to_string(tool) + " " + words; }
std::string life(int tool, double min) { return state(tool, "life-left " + std::to_string(min)); }

LatePolicy told(const std::string& states, std::optional<Next> next = std::nullopt) {
  LatePolicy out;
  out.deadline = std::nullopt;
  auto tools = parse_tool_states(states, "states");
  EXPECT_TRUE(tools) << (tools ? "" : to_text(tools.error()));
  if (tools) out.tools = *std::move(tools);
  out.next = next;
  return out;
}

int tool_of(const model::Plan& plan, std::size_t k) {
  const model::Cutter* c = model::find_cutter(plan, plan.steps.at(k).cutter_id);
  return c == nullptr ? 0 : c->pocket;
}
std::map<int, double> minutes(const model::Plan& plan) { return minutes_of(plan, 0, plan.steps.size()); }
/// Tools that the program calls.
std::set<int> called(const std::string& program) {
  std::set<int> out;
  std::istringstream lines(program);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("T") && line.find("M6") != std::string::npos) out.insert(std::stoi(line.substr(1)));
  }
  return out;
}

/// The tool of the bracket's plan that cuts more than one step, and longest; where its steps are.
struct Busy {
  int tool = 0;
  std::vector<std::size_t> steps;
  std::vector<double> min;  ///< of each
};
Busy busiest() {
  const model::Plan& plan = bracket().plan;
  std::map<int, Busy> all;
  for (std::size_t k = 0; k < plan.steps.size(); ++k) {
    Busy& b = all[tool_of(plan, k)];
    b.tool = tool_of(plan, k);
    b.steps.push_back(k);
    b.min.push_back(plan.steps[k].cutting_s / 60.0);
  }
  const auto by = minutes(plan);
  Busy out;
  for (const auto& [tool, b] : all)
    if (b.steps.size() > 1 && (out.tool == 0 || by.at(tool) > by.at(out.tool))) out = b;
  EXPECT_GT(out.tool, 0);
  return out;
}

const model::Provenance* row(const model::Plan& plan, const std::string& what) {
  for (const auto& p : plan.provenance)
    if (p.what == what) return &p;
  return nullptr;
}

// A tool whose sizes are others now cut under a name of its own, out of the magazine (joined): it is its life
// all the same.
TEST(ToolLife, MinutesOfAToolThatWasAnotherWhenItCutAreItsOwn) {
  model::Plan plan;
  model::Cutter now;
  now.id = "em10";
  now.pocket = 3;
  model::Cutter before = now;
  before.id = now.id + std::string(kAsCut) + " before";
  before.pocket = 0;
  plan.cutters = {now, before};
  for (const auto& [id, s] : {std::pair<std::string, double>{before.id, 90.0}, {now.id, 30.0}}) {
    model::StepResult step;
    step.cutter_id = id;
    step.cutting_s = s;
    plan.steps.push_back(std::move(step));
  }
  EXPECT_EQ(minutes(plan), (std::map<int, double>{{3, 2.0}}));
}

TEST(LateTools, ABrokenOneIsNotCalledWhereAnotherLikeItIsLoaded) {
  const Busy b = busiest();
  Job job;
  const auto bound =
      bind(bracket().plan, shop_of(with_sister(bracket().table, b.tool)), told(state(b.tool, "broken")), job);
  ASSERT_TRUE(bound) << to_text(bound.error());
  EXPECT_FALSE(minutes(bound->plan).contains(b.tool));
  EXPECT_TRUE(minutes(bound->plan).contains(kSister));
  const auto tools = called(bound->program.text);
  EXPECT_FALSE(tools.contains(b.tool));
  EXPECT_TRUE(tools.contains(kSister)) << bound->program.text.substr(0, 2000);
  const auto* why = row(bound->plan, "tool-state T" + std::to_string(b.tool));
  ASSERT_NE(why, nullptr);
  EXPECT_EQ(why->value, "broken");
}

TEST(LateTools, ABrokenOneThatNoOtherReplacesGivesNothingAndSaysWhy) {
  // Nobody but the file chose to ream the plate's hole.
  const std::string reamer = "T5";
  Job job;
  const auto bound = bind(plate(), shop(kMagazine), told(reamer + " broken"), job);
  ASSERT_FALSE(bound);
  EXPECT_THAT(bound.error().message, HasSubstr("T5 (is broken)"));
}

TEST(LateTools, ABrokenOneThatThePlanDoesNotNeedChangesNothing) {
  const Busy b = busiest();
  Job job;
  const auto bound = bind(bracket().plan, shop_of(with_sister(bracket().table, b.tool)),
                          told(state(kSister, "broken")), job);
  ASSERT_TRUE(bound) << to_text(bound.error());
  EXPECT_TRUE(bound->kept);
  EXPECT_TRUE(bound->reopened.empty());
}

TEST(LateTools, AReopenedToolIsToldByWhatBecameOfIt) {
  const int mill = eight_mill(bracket().plan);
  Job job;
  const auto bound = bind(bracket().plan, shop_of(bracket().table), told(state(mill, "broken")), job);
  // Another mill does its steps, or nothing does: the reason is told in both.
  std::string said = bound ? "" : bound.error().message;
  if (bound) {
    for (const std::string& r : bound->reopened) said += r + "\n";
    EXPECT_FALSE(minutes(bound->plan).contains(mill));
  }
  EXPECT_THAT(said, HasSubstr("broken"));
  EXPECT_THAT(said, HasSubstr("T" + std::to_string(mill)));
}

TEST(LateTools, AWornOneOffsetsItsPathAndKeepsItsTime) {
  const int mill = eight_mill(bracket().plan);
  const double before = machining_s(bracket().plan);
  Job job;
  const auto worn = bind(bracket().plan, shop_of(bracket().table), told(state(mill, "wear 0.05")), job);
  ASSERT_TRUE(worn) << to_text(worn.error());
  EXPECT_NEAR(worn->machining_s, before, 0.05 * before);  // issue 16
  const auto c = std::find_if(worn->plan.cutters.begin(), worn->plan.cutters.end(),
                              [&](const model::Cutter& x) { return x.pocket == mill; });
  ASSERT_NE(c, worn->plan.cutters.end());
  EXPECT_DOUBLE_EQ(c->cutting_diameter_mm, 8.0 - 2.0 * 0.05);
  // As a table that measures it.
  Job again;
  const auto measured =
      bind(bracket().plan, shop_of(with(bracket().table, mill, "D", -0.1)), told(""), again);
  ASSERT_TRUE(measured) << to_text(measured.error());
  EXPECT_EQ(worn->program.text, measured->program.text);
  EXPECT_NE(worn->program.text,
            bind(bracket().plan, shop_of(bracket().table), told(""), again)->program.text);
  // Told beside a table that has it, it counts once.
  Job once;
  const auto carried = bind(bracket().plan, shop_of(with(bracket().table, mill, "D", -0.1)),
                            told(state(mill, "wear 0.05")), once);
  ASSERT_TRUE(carried) << to_text(carried.error());
  EXPECT_EQ(carried->program.text, measured->program.text);
}

TEST(LateTools, OfALifeThatLastsNothingChanges) {
  const Busy b = busiest();
  Job job;
  const auto bound = bind(bracket().plan, shop_of(bracket().table),
                          told(life(b.tool, minutes(bracket().plan).at(b.tool) + 0.001)), job);
  ASSERT_TRUE(bound) << to_text(bound.error());
  EXPECT_TRUE(bound->kept);
  EXPECT_TRUE(bound->reopened.empty());
}

TEST(LateTools, WhereALifeEndsWithinThePlanASisterTakesTheStepsThatAreLeft) {
  const Busy b = busiest();
  // Enough for the first of its steps, and for half of the second.
  const double left = b.min[0] + 0.5 * b.min[1];
  Job job;
  const auto bound =
      bind(bracket().plan, shop_of(with_sister(bracket().table, b.tool)), told(life(b.tool, left)), job);
  ASSERT_TRUE(bound) << to_text(bound.error());
  EXPECT_TRUE(bound->kept);  // paths and feeds stand
  const auto by = minutes(bound->plan);
  EXPECT_LE(by.at(b.tool), left + kTrace);
  EXPECT_NEAR(by.at(b.tool), b.min[0], kTrace);
  EXPECT_EQ(tool_of(bound->plan, b.steps[0]), b.tool);
  for (std::size_t i = 1; i < b.steps.size(); ++i) EXPECT_EQ(tool_of(bound->plan, b.steps[i]), kSister) << i;
  EXPECT_TRUE(called(bound->program.text).contains(kSister));
  ASSERT_FALSE(bound->reopened.empty());
  EXPECT_THAT(bound->reopened.front(), HasSubstr("T24 of the same kind takes it"));
  EXPECT_THAT(bound->words, HasSubstr("T24"));
  // The ledger says it, too.
  bool in_ledger = false;
  for (const model::Reason& r : bound->plan.ledger.reasons()) in_ledger = in_ledger || r.id == "tool-state";
  EXPECT_TRUE(in_ledger);
  EXPECT_NE(row(bound->plan, "tool-state T" + std::to_string(b.tool)), nullptr);
}

TEST(LateTools, ASisterThatIsNearItsEndToo) {
  const Busy b = busiest();
  double all = 0.0;
  for (const double m : b.min) all += m;
  // Both together last for less than all of the steps.
  Job job;
  const auto bound = bind(bracket().plan, shop_of(with_sister(bracket().table, b.tool)),
                          told(life(b.tool, b.min[0]) + "\n" + life(kSister, 0.5 * (all - b.min[0]))), job);
  if (bound) {
    const auto by = minutes(bound->plan);
    EXPECT_LE(by.contains(b.tool) ? by.at(b.tool) : 0.0, b.min[0] + 1e-6);
    EXPECT_LE(by.contains(kSister) ? by.at(kSister) : 0.0, 0.5 * (all - b.min[0]) + 1e-6);
  } else {
    EXPECT_EQ(bound.error().code, "LATE-LIFE") << to_text(bound.error());
  }
}

TEST(LateTools, AStepLongerThanAnyLifeIsRefusedByItsNumbers) {
  // The plate's hole is reamed by T5 and by nothing else.
  Job job;
  const auto bound = bind(plate(), shop(kMagazine), told("T5 life-left 0.001"), job);
  ASSERT_FALSE(bound);
  EXPECT_EQ(bound.error().code, "LATE-LIFE") << to_text(bound.error());
  EXPECT_THAT(bound.error().message, HasSubstr("T5 has left"));
  EXPECT_THAT(bound.error().message, HasSubstr("it cuts"));
}

TEST(LateTools, WhatAControlMayNotChooseNoSisterReplaces) {
  const Busy b = busiest();
  LatePolicy policy = told(life(b.tool, b.min[0]));
  policy.may = *Decisions::parse("feeds,depths");
  Job job;
  const auto bound = bind(bracket().plan, shop_of(with_sister(bracket().table, b.tool)), policy, job);
  ASSERT_FALSE(bound);
  EXPECT_EQ(bound.error().code, "LATE-POLICY") << to_text(bound.error());
}

/// A session with the bracket's plan in the shop of a table.
void open(service::Session& s, const std::string& table) {
  const std::string path = capstan::testing::scratch_file("late_life.tbl");
  std::ofstream(path) << table;
  ASSERT_EQ(s.set("tools", path), service::Code::kDone) << s.message();
  Job job;
  const auto text = pipeline::write_plan(bracket().plan, pipeline::Format::kJson, job);
  ASSERT_TRUE(text);
  ASSERT_EQ(s.take(*text), service::Code::kDone) << s.message();
}

/// The tools that the program of one workingstep calls, numbered from 0.
std::set<int> bound_step(service::Session& s, std::size_t k) {
  EXPECT_EQ(s.bind_next({}, k + 1, 1, std::chrono::hours(1)), service::Code::kDone) << s.message();
  const std::string* program = s.output("linuxcnc");
  return program == nullptr ? std::set<int>{} : called(*program);
}

TEST(LateTools, OfStepsThatAreBoundOneByOneTheEarlierOnesCountSinceItWasTold) {
  const Busy b = busiest();
  for (const bool told_anew : {false, true}) {
    service::Session s;
    open(s, with_sister(bracket().table, b.tool));
    ASSERT_EQ(s.tell_tools(life(b.tool, b.min[0] + 0.5 * b.min[1])), service::Code::kDone) << s.message();
    for (std::size_t k = 0; k < b.steps[1]; ++k) {
      const auto tools = bound_step(s, k);
      if (k == b.steps[0]) {
        EXPECT_TRUE(tools.contains(b.tool));
      }
    }
    // Told anew, it counts from here on.
    if (told_anew) {
      ASSERT_EQ(s.tell_tools(life(b.tool, b.min[1] + 0.001)), service::Code::kDone);
    }
    const auto tools = bound_step(s, b.steps[1]);
    EXPECT_EQ(tools.contains(b.tool), told_anew);
    EXPECT_EQ(tools.contains(kSister), !told_anew);
  }
}

TEST(LateTools, ASessionGivesNothingThatWasBoundBeforeTheyWereTold) {
  service::Session s;
  open(s, bracket().table);
  Job job;
  const auto text = pipeline::write_plan(bracket().plan, pipeline::Format::kJson, job);
  ASSERT_EQ(s.bind(*text, std::chrono::hours(1)), service::Code::kDone) << s.message();
  ASSERT_NE(s.output("linuxcnc"), nullptr);
  // What cannot be read changes nothing.
  EXPECT_EQ(s.tell_tools("T1 blunt"), service::Code::kUsage);
  EXPECT_THAT(s.message(), HasSubstr("'blunt' is no word"));
  EXPECT_NE(s.output("linuxcnc"), nullptr);
  ASSERT_EQ(s.tell_tools("T99 broken"), service::Code::kDone);
  EXPECT_EQ(s.output("linuxcnc"), nullptr);
  ASSERT_EQ(s.bind(*text, std::chrono::hours(1)), service::Code::kDone) << s.message();
  EXPECT_THAT(s.message(), HasSubstr("T99 has a state and is not in the tool table"));
}

TEST(LateTools, WithoutAToolTableAStateIsRefused) {
  service::Session s;
  Job job;
  const auto text = pipeline::write_plan(bracket().plan, pipeline::Format::kJson, job);
  ASSERT_TRUE(text);
  ASSERT_EQ(s.tell_tools("T5 broken"), service::Code::kDone);
  EXPECT_EQ(s.bind(*text, std::chrono::hours(1)), service::Code::kUsage);
  EXPECT_THAT(s.message(), HasSubstr("APP-TOOL-STATE"));
}

TEST(LateTools, AFileTellsTheSameAsTheCall) {
  const std::string file = capstan::testing::scratch_file("late.state");
  const auto bound = [&](bool by_file) {
    service::Session s;
    (void)s.set("tools", kMagazine);
    std::ofstream(file) << "T8 broken\n";
    EXPECT_EQ(by_file ? s.set("tool-state", file) : s.tell_tools("T8 broken\n"), service::Code::kDone)
        << s.message();
    EXPECT_EQ(s.bind(testing::slurp(kPlate), std::chrono::hours(1)), service::Code::kDone) << s.message();
    const std::string* json = s.output("json");
    return json == nullptr ? std::string() : *json;
  };
  const std::string by_file = bound(true);
  EXPECT_THAT(by_file, HasSubstr("tool-state T8"));
  EXPECT_EQ(by_file, bound(false));
  service::Session s;
  std::ofstream(file) << "T8 broken\nT8 wear 0.1\n";
  EXPECT_EQ(s.set("tool-state", file), service::Code::kUsage);
  EXPECT_THAT(s.message(), HasSubstr(file + ":2"));
  EXPECT_EQ(s.set("tool-state", file + ".none"), service::Code::kUsage);
  EXPECT_THAT(s.message(), HasSubstr("cannot be read"));
}

}  // namespace
}  // namespace capstan::late
