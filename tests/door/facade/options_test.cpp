#include "planner/door/facade/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <set>

#include "planner/door/service/options.h"
#include "tests/support/corpus.h"
#include "tests/support/scratch.h"

namespace capstan::facade {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

service::Request request(const PlanOptions& options) {
  auto r = request_of(options);
  EXPECT_TRUE(r) << (r ? "" : to_text(r.error()));
  return r ? *std::move(r) : service::Request{};
}

TEST(RequestOf, OptionsThatNobodySetIsTheRequestThatNobodySet) {
  const service::Request r = request({}), none;
  for (const auto& text : {r.machine, r.tools, r.material, r.rules, r.cases, r.general_tolerance,
                           r.workholding, r.feeds, r.margin})
    EXPECT_EQ(text, std::nullopt);
  EXPECT_FALSE(r.stock || r.stock_allowance_mm || r.objective || r.solver || r.revenue || r.deadline);
  EXPECT_EQ(r.batch, none.batch);
  EXPECT_EQ(r.edge_break_mm, none.edge_break_mm);
  EXPECT_EQ(r.reopen, none.reopen);
  EXPECT_EQ(r.bind, none.bind);
  EXPECT_FALSE(r.strict || r.allow_findings || r.schema);
  EXPECT_EQ(r.threads, none.threads);
  EXPECT_TRUE(r.backends[optimise::Solver::kIpopt]) << "the library brings Ipopt where it is built";
}

TEST(RequestOf, EachFieldSetsWhatItsNameSays) {
  const std::string states = capstan::testing::scratch_file("options.state");
  std::ofstream(states) << "T3 broken\n";
  PlanOptions o;
  o.machine = "a machine";
  o.tools = "some tools";
  o.material = "C45";
  o.rules = capstan::testing::source_dir() + "/rules";
  o.cases = "cases.db";
  o.general_tolerance = "ISO 2768-m";
  o.workholding = "auto";
  o.mesh_unit = "inch";
  o.body = "2";
  o.feeds = "constant";
  o.margin = "bold";
  o.objective = "profit";
  o.revenue = 12.5;
  o.solver = "ipopt";
  o.stock = "box:0,0,-30,120,80,1";
  o.batch = 7;
  o.edge_break_mm = 0.2;
  o.reopen = "tools";
  o.bind = "strategy";
  o.deadline = "200ms";
  o.strict = true;
  o.schema = true;
  o.without = "sections";
  o.profile = "grbl";
  o.next = 2;
  o.from = 3;
  o.stop_at_deadline = true;
  o.spindle_power_kw = 5.5;
  o.feed_override = 80;
  o.axis_limits = "X=0:350";
  o.work_offset = "X=1,Y=2,Z=3";
  o.tool_state = states;
  o.threads = 3;
  const service::Request r = request(o);
  EXPECT_EQ(r.machine, "a machine");
  EXPECT_EQ(r.tools, "some tools");
  EXPECT_EQ(r.material, "C45");
  EXPECT_EQ(r.rules, o.rules);
  EXPECT_EQ(r.cases, "cases.db");
  EXPECT_EQ(r.general_tolerance, "ISO 2768-m");
  EXPECT_EQ(r.workholding, "auto");
  EXPECT_EQ(r.mesh_unit, "inch");
  EXPECT_EQ(r.body, "2");
  EXPECT_FALSE(r.features_only);
  EXPECT_EQ(r.feeds, "constant");
  EXPECT_EQ(r.margin, "bold");
  EXPECT_EQ(r.objective, pipeline::Objective::kProfit);
  EXPECT_EQ(r.revenue, 12.5);
  EXPECT_EQ(r.solver, optimise::Solver::kIpopt);
  ASSERT_TRUE(r.stock);
  EXPECT_EQ(*r.stock, (geometry::Box3{.lo = {0, 0, -30}, .hi = {120, 80, 1}}));
  EXPECT_EQ(r.batch, 7);
  EXPECT_EQ(r.edge_break_mm, 0.2);
  EXPECT_EQ(r.reopen, pipeline::Reopen::kTools);
  EXPECT_EQ(r.bind, pipeline::Bind::kStrategy);
  EXPECT_EQ(r.deadline, std::chrono::milliseconds(200));
  EXPECT_TRUE(r.strict && r.schema);
  EXPECT_FALSE(r.sections);
  EXPECT_EQ(r.profile, "grbl");
  EXPECT_EQ(r.next, 2u);
  EXPECT_EQ(r.from, 3u);
  EXPECT_TRUE(r.stop_at_deadline);
  EXPECT_EQ(r.state.spindle_power_kw, 5.5);
  EXPECT_EQ(r.state.feed_override, 80U);
  ASSERT_EQ(r.state.axis_limits.size(), 1U);
  EXPECT_EQ(r.state.axis_limits[0].most_mm, 350.0);
  ASSERT_EQ(r.state.work_offsets.size(), 1U);
  EXPECT_EQ(r.state.work_offsets[0].at_mm, (geometry::Vec3{1.0, 2.0, 3.0}));
  ASSERT_EQ(r.state.tools.size(), 1U);
  EXPECT_TRUE(r.state.tools[0].broken);
  EXPECT_FALSE(r.allow_findings);
  EXPECT_EQ(r.threads, 3U);
  PlanOptions edited;
  edited.set = {"POCKET/tool=T5", "feed=900"};
  edited.pin = {"SLOT/tool"};
  edited.limit = {"feed<=2000"};
  edited.forbid = {"operation=reaming"};
  edited.order = {"A<B"};
  edited.edits = "part.edits.yaml";
  const service::Request with_edits = request(edited);
  EXPECT_EQ(with_edits.edits.size(), 6U);
  EXPECT_EQ(words_of(with_edits.edits.front()), "set: set POCKET/tool=T5");
  EXPECT_EQ(with_edits.edits_file, "part.edits.yaml");
  PlanOptions all_the_same;
  all_the_same.allow_findings = true;
  EXPECT_TRUE(request(all_the_same).allow_findings);
  PlanOptions features;
  features.features_only = true;
  EXPECT_TRUE(request(features).features_only);
  PlanOptions tapped;
  tapped.tapped = {"HOLE 1=M8", "#12=M10x1:8"};
  ASSERT_EQ(request(tapped).tapped.size(), 2U);
  EXPECT_EQ(request(tapped).tapped[1].holes, "#12");
}

TEST(RequestOf, AnAllowanceOfZeroIsOneAndTheStocksTextIsTakenBeforeIt) {
  PlanOptions o;
  o.stock_allowance_mm = 0.0;
  EXPECT_EQ(request(o).stock_allowance_mm, 0.0);
  o.stock_allowance_mm = 3.25;
  EXPECT_EQ(request(o).stock_allowance_mm, 3.25);
  o.stock = "block:+2";
  EXPECT_EQ(request(o).stock_allowance_mm, 2.0);
}

TEST(RequestOf, ThreadsAreAsManyAsTheServiceTakes) {
  const service::Option* threads = nullptr;
  for (const service::Option& o : service::options()) {
    if (o.name == "threads") threads = &o;
  }
  ASSERT_NE(threads, nullptr);
  PlanOptions o;
  o.threads = 0;
  EXPECT_EQ(request(o).threads, threads->least);
  o.threads = threads->most + 1;
  EXPECT_EQ(request(o).threads, threads->most);
}

TEST(RequestOf, AnOptionThatIsNoneIsRefusedByItsNameWithoutTheCommandsDashes) {
  const auto refused = [](auto change, const char* name) {
    PlanOptions o;
    change(o);
    const auto r = request_of(o);
    ASSERT_FALSE(r) << name;
    EXPECT_EQ(r.error().code, "OPTION-VALUE");
    EXPECT_THAT(r.error().message, HasSubstr(name));
    EXPECT_THAT(r.error().message, Not(HasSubstr("--")));
  };
  refused([](PlanOptions& o) { o.reopen = "everything"; }, "reopen");
  refused([](PlanOptions& o) { o.deadline = "soon"; }, "deadline");
  refused([](PlanOptions& o) { o.batch = 0; }, "batch");
  refused([](PlanOptions& o) { o.edge_break_mm = -1.0; }, "edges");
  refused([](PlanOptions& o) { o.objective = "profit"; }, "revenue");
  refused([](PlanOptions& o) { o.strict = o.allow_findings = true; }, "allow-findings");
}

TEST(RequestOf, ANumberThatIsNotFiniteIsRefused) {
  for (const double bad :
       {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    for (double PlanOptions::*field :
         {&PlanOptions::revenue, &PlanOptions::edge_break_mm, &PlanOptions::stock_allowance_mm}) {
      PlanOptions o;
      o.objective = "profit";
      o.revenue = 5.0;
      o.*field = bad;
      const auto r = request_of(o);
      ASSERT_FALSE(r) << bad;
      EXPECT_EQ(r.error().code, "OPTION-VALUE");
    }
  }
}

TEST(OptionNames, StandOnce) {
  const auto names = option_names();
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
}

}  // namespace
}  // namespace capstan::facade
