#include "planner/late/late.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "capstan/capstan_late.h"
#include "planner/model/nouns/all.h"
#include "planner/pipeline/shop.h"
#include "tests/support/corpus.h"

namespace capstan::late {
namespace {

const std::string kPlate = std::string(CAPSTAN_SOURCE_DIR) + "/examples/plate_bound.p21";
const std::string kMagazine = std::string(CAPSTAN_SOURCE_DIR) + "/tests/late/magazine.tbl";
const std::string kOneTool = std::string(CAPSTAN_SOURCE_DIR) + "/tests/late/one_tool.tbl";

pipeline::Inputs shop(const std::string& tools) {
  Job job;
  auto in = pipeline::load_shop({.machine = {}, .tools = tools, .rules = {}, .material = {}}, job);
  EXPECT_TRUE(in) << (in ? "" : to_text(in.error()));
  return in ? *std::move(in) : pipeline::Inputs{};
}

model::Plan plate() {
  Job job;
  auto plan = pipeline::read_plan(testing::slurp(kPlate), kPlate, job);
  EXPECT_TRUE(plan) << (plan ? "" : to_text(plan.error()));
  return plan ? *std::move(plan) : model::Plan{};
}

std::string texts(Job& job) {
  std::string out;
  for (const auto& d : job.diagnostics()) out += to_text(d) + "\n";
  return out;
}

TEST(Late, BindsWithWhatTheMagazineHoldsAndNothingElse) {
  Job job;
  const auto bound = bind(plate(), shop(kMagazine), {.deadline = std::chrono::seconds(20)}, job);
  ASSERT_TRUE(bound) << to_text(bound.error()) << "\n" << texts(job);
  EXPECT_TRUE(bound->plan.unplanned.empty());
  ASSERT_FALSE(bound->plan.steps.empty());
  for (const auto& c : bound->plan.cutters) {
    const bool loaded =
        c.pocket == 2 || c.pocket == 3 || c.pocket == 4 || c.pocket == 5 || c.pocket == 7 || c.pocket == 8;
    EXPECT_TRUE(loaded) << c.id << " in pocket " << c.pocket;
  }
  for (const auto& f : bound->findings) EXPECT_NE(f.severity, Severity::kError) << f.message;
}

TEST(Late, TakesTheLengthOfAToolFromTheTable) {
  Job job;
  const auto bound = bind(plate(), shop(kMagazine), {.deadline = std::chrono::seconds(20)}, job);
  ASSERT_TRUE(bound) << to_text(bound.error());
  const auto mill = std::find_if(bound->plan.cutters.begin(), bound->plan.cutters.end(),
                                 [](const auto& c) { return c.pocket == 7; });
  ASSERT_NE(mill, bound->plan.cutters.end());
  EXPECT_EQ(mill->functional_length_mm, 115.0);  // the file says 75, the table what was measured
}

TEST(Late, RefusesWhenSomethingStaysOpen) {
  Job job;
  const auto bound = bind(plate(), shop(kOneTool), {.deadline = std::chrono::seconds(20)}, job);
  ASSERT_FALSE(bound);
  EXPECT_EQ(bound.error().code, "LATE-OPEN");
}

TEST(Late, GivesTheFallbackWhenTheDeadlineIsPast) {
  Job job;
  const auto bound = bind(plate(), shop(kMagazine), {.deadline = std::chrono::milliseconds(0)}, job);
  ASSERT_TRUE(bound) << to_text(bound.error());
  EXPECT_FALSE(bound->improved);
  EXPECT_EQ(bound->machining_s, bound->fallback_s);
}

TEST(Late, ReopensAToolThatIsNotInTheMagazine) {
  model::Plan plan = plate();
  pipeline::Inputs in = shop(kMagazine);
  std::erase_if(in.library, [](const auto& c) { return c.pocket == 7; });
  Job job;
  const auto reopened = pipeline::match_loaded(plan, in, job);
  ASSERT_TRUE(reopened);
  ASSERT_FALSE(reopened->empty());
  EXPECT_NE(reopened->front().find("END MILL 12"), std::string::npos) << reopened->front();
}

TEST(Late, FeedsOfAGivenPathComeFromTheSectionsThatItsFileStates) {
  // The plan as another system would bring it: path and sections given, speed and feed open.
  Job job;
  const auto planned = pipeline::bind(plate(), shop(kMagazine), {}, job);
  ASSERT_TRUE(planned) << to_text(planned.error());
  const auto text = pipeline::write_plan(*planned, pipeline::Format::kAp238, job);
  ASSERT_TRUE(text);
  const auto opened = [&](double factor) {
    Job quiet;
    auto plan = *pipeline::read_plan(*text, "plate.stpnc", quiet);
    auto& m = plan.model;
    for (const auto at : m.all(model::TypeId::kMillingTechnology)) {
      m.at<model::MillingTechnology>(at).feedrate.reset();
      m.at<model::MillingTechnology>(at).spindle.reset();
    }
    plan.ledger = model::Ledger{};
    for (const auto at : m.all(model::TypeId::kCutterLocationTrajectory)) {
      const auto* line = m.get<model::Polyline>(m.at<model::Trajectory>(at).cross_section_area_parameters);
      if (line == nullptr) continue;
      for (const auto p : line->points.items) {
        auto& c = m.at<model::CartesianPoint>(p).coordinates.items;
        if (c.size() == 7) c[4] *= factor;
      }
    }
    return plan;
  };
  const auto warned = [&](double factor) {
    Job said;
    pipeline::Policy policy;
    policy.only_loaded_cutters = true;
    const auto bound = pipeline::bind(opened(factor), shop(kMagazine), policy, said);
    EXPECT_TRUE(bound) << (bound ? "" : to_text(bound.error()));
    if (bound) {
      for (const auto& s : bound->steps) {
        if (!(s.cutting_s > 0.0)) continue;
        EXPECT_GT(s.feed_mm_min, 0.0) << model::step_id(*bound, s);
        EXPECT_NE(s.spindle_rpm, 0.0);
      }
    }
    const auto all = texts(said);
    const auto at = all.find("PIP-SECTIONS");
    if (factor == 1.0) {
      EXPECT_EQ(at, std::string::npos) << all;
    }
    return at != std::string::npos;
  };
  EXPECT_FALSE(warned(1.0));
  EXPECT_TRUE(warned(0.3));
  EXPECT_TRUE(warned(3.0));
}

TEST(LateInterface, SaysWhatIsWrongAndNeverThrows) {
  EXPECT_EQ(capstan_late_bind(nullptr, "x", 1, 10), CAPSTAN_LATE_USAGE);
  EXPECT_EQ(capstan_late_output(nullptr, CAPSTAN_LATE_JSON, nullptr), nullptr);
  capstan_late* broken = capstan_late_open("no such machine", kMagazine.c_str());
  ASSERT_NE(broken, nullptr);
  EXPECT_EQ(capstan_late_status(broken), CAPSTAN_LATE_UNREADABLE);
  EXPECT_NE(std::string(capstan_late_message(broken)).find("no such machine"), std::string::npos);
  EXPECT_EQ(capstan_late_bind(broken, "x", 1, 10), CAPSTAN_LATE_USAGE);
  capstan_late_close(broken);
  capstan_late* open = capstan_late_open("generic_vmc", kMagazine.c_str());
  EXPECT_EQ(capstan_late_status(open), CAPSTAN_LATE_OK) << capstan_late_message(open);
  EXPECT_EQ(capstan_late_bind(open, "not a plan", 10, 10), CAPSTAN_LATE_UNREADABLE);
  EXPECT_EQ(capstan_late_output(open, CAPSTAN_LATE_JSON, nullptr), nullptr);
  capstan_late_close(open);
  capstan_late_close(nullptr);
}

}  // namespace
}  // namespace capstan::late
