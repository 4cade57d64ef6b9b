#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "planner/door/late/late.h"
#include "planner/door/service/session.h"
#include "planner/files/json/json.h"
#include "planner/making/draft/draft.h"
#include "planner/making/given/listed_steps.h"
#include "tests/door/late/brought.h"
#include "tests/support/plate.h"
#include "tests/support/scratch.h"

// A call that is given up at its deadline is late by what it does between two looks at the clock. What it
// does there is counted in pieces of memory that it asks for, which depend on no machine and on no load: a
// copy of a plan asks for thousands.

namespace {
thread_local std::size_t g_pieces = 0, g_bytes = 0;
}

[[gnu::noinline]] void* operator new(std::size_t size) {
  ++g_pieces;
  g_bytes += size;
  if (void* p = std::malloc(size == 0 ? 1 : size)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }

namespace capstan::late {
namespace {

/// Pieces of memory that were asked for between looks at the clock, in the order of the looks.
struct Looks {
  std::vector<std::size_t> between;
  std::size_t seen = 0;
  [[nodiscard]] Job::Clock clock(std::chrono::steady_clock::time_point at) {
    return [this, at] {
      between.push_back(g_pieces - seen);
      seen = g_pieces;
      return at;
    };
  }
};

/// How many pieces a copy of the plan asks for.
std::size_t pieces_of_copy(const model::Plan& plan) {
  const std::size_t before = g_pieces;
  const model::Plan copy = plan;
  return g_pieces - before + (copy.steps.empty() ? 1 : 0);
}

TEST(LateLooks, BetweenTwoLooksAtTheClockNoMoreIsDoneThanTwoCopiesOfThePlan) {
  const Brought early =
      brought(capstan::testing::source_dir() + "/examples/bracket.p21", pipeline::Format::kJson);
  const pipeline::Inputs in = shop_of(early.table);
  const std::size_t most = 2 * pieces_of_copy(early.plan);
  const auto began = std::chrono::steady_clock::now();
  for (const bool next : {false, true}) {
    Job job;
    Looks looks;
    job.set_clock(looks.clock(began));
    LatePolicy policy;
    policy.began = began;
    policy.deadline = std::chrono::hours(1);
    policy.stop_at_deadline = true;
    policy.budget = policy.fallback_budget;
    if (next) policy.next = Next{1, 5};
    model::Plan plan = early.plan;
    pipeline::Inputs inputs = in;
    looks.seen = g_pieces;
    const auto out = bind(std::move(plan), std::move(inputs), policy, job);
    ASSERT_TRUE(out) << to_text(out.error());
    ASSERT_GT(looks.between.size(), 1000U);
    for (std::size_t i = 0; i < looks.between.size(); ++i)
      EXPECT_LE(looks.between[i], most) << (next ? "of a workingstep" : "of all") << ", before look " << i;
  }
}

TEST(LateLooks, ASessionGivesUpBeforeItCopiesAPlanWhereTheDeadlineIsPast) {
  const Brought early =
      brought(capstan::testing::source_dir() + "/examples/bracket.p21", pipeline::Format::kJson);
  const std::string json = json::write_json(early.plan);
  const std::string path = capstan::testing::scratch_file("late_looks.tbl");
  std::ofstream(path) << early.table;
  service::Session session;
  ASSERT_EQ(session.set("tools", path), service::Code::kDone);
  ASSERT_EQ(session.set("stop-at-deadline", "yes"), service::Code::kDone);
  ASSERT_EQ(session.open(), service::Code::kDone) << session.message();
  ASSERT_EQ(session.take(json), service::Code::kDone) << session.message();
  const std::size_t most = pieces_of_copy(early.plan) / 4, before = g_pieces;
  EXPECT_EQ(session.bind_next(json, 5, 1, std::chrono::milliseconds(0)), service::Code::kImpossible);
  EXPECT_LT(g_pieces - before, most);
  EXPECT_NE(session.message().find("LATE-NONE"), std::string::npos) << session.message();
}

/// The first workingstep of an open plate, in pieces of memory; those of a copy of its plan; and the bytes
/// that listing its steps asks for.
struct FirstStep {
  double bind = 0.0, copy = 0.0;
  std::size_t steps = 0, listing = 0;
};
FirstStep first_step(std::size_t holes, const std::string& table) {
  Job job;
  const auto read = pipeline::read_plan(testing::plate_of_holes(holes).text, "plate.p21", job);
  EXPECT_TRUE(read) << to_text(read.error());
  const auto open = pipeline::bind(*read, shop_of(table), {.bind = pipeline::Bind::kStrategy}, job);
  EXPECT_TRUE(open) << to_text(open.error());
  const std::string path = testing::scratch_file("first_step.tbl");
  std::ofstream(path) << table;
  service::Session session;
  EXPECT_EQ(session.set("tools", path), service::Code::kDone);
  EXPECT_EQ(session.open(), service::Code::kDone) << session.message();
  EXPECT_EQ(session.take(json::write_json(*open)), service::Code::kDone) << session.message();
  FirstStep out;
  out.copy = static_cast<double>(pieces_of_copy(*open));
  std::size_t before = g_bytes;
  out.steps = given::steps_in_order(*open).size();
  out.listing = g_bytes - before;
  before = g_pieces;
  EXPECT_EQ(session.bind_next({}, 0, 1, std::chrono::minutes(10)), service::Code::kDone) << session.message();
  out.bind = static_cast<double>(g_pieces - before);
  return out;
}

// Two copies are needed: the plan that is made, for the one that came is kept should the call fail, and the
// whole plan beside the part. Beside them the features that stand around are read, by planning and by both
// checks: less than two copies more. Listing the steps asks for their handles, and for no draft of any.
TEST(LateLooks, AFurtherStepOfAPlanCostsTheFirstOneLessThanFourCopiesOfThatStepAndNoDraft) {
  constexpr std::size_t kHoles = 60, kMore = 60;
  const std::string part = testing::scratch_file("few_holes.p21");
  std::ofstream(part) << testing::plate_of_holes(4).text;
  const std::string table = brought(part, pipeline::Format::kJson).table;
  const FirstStep few = first_step(kHoles, table), many = first_step(kHoles + kMore, table);
  ASSERT_GE(many.steps, few.steps + kMore);
  EXPECT_LT(many.bind - few.bind, 4.0 * (many.copy - few.copy));
  EXPECT_LT(many.listing, many.steps * sizeof(draft::StepDraft) / 4);
}

}  // namespace
}  // namespace capstan::late
