#include "planner/making/step/cut/ranking.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "planner/model/nouns/all.h"

namespace capstan::step {
namespace {

model::Candidate mill(const std::string& id, double diameter_mm, double corner_mm) {
  model::Candidate out;
  out.cutter.id = id;
  const bool ball = 2.0 * corner_mm >= diameter_mm;
  out.cutter.cutter_class = ball ? model::CutterClass::kBallEndmill : model::CutterClass::kBullnoseEndmill;
  out.cutter.cutting_diameter_mm = diameter_mm;
  out.cutter.corner_radius_mm = corner_mm;
  out.cutter.maximum_depth_of_cut_mm = 20.0;
  out.cutter.teeth = 2;
  return out;
}

/// A step that roughs a surface; what each mill makes of it is told by its id.
struct Asked {
  model::Plan plan;
  std::vector<draft::StepDraft> steps{1};
  std::map<std::string, Roughed> of;
  std::vector<std::string> tried, best;

  explicit Asked(const std::vector<model::Candidate>& mills) {
    plan.machine.tool_change_s = 10.0;
    draft::StepDraft& s = steps.front();
    const auto operation = plan.model.add(model::FreeformRoughMilling{});
    s.operation = operation;
    s.step = plan.model.add(model::MachiningWorkingstep{});
    draft::CandidatePool pool;
    s.candidates = pool.list(mills);
    s.cutter = mills.front().cutter;
  }
  bool rank(bool rest) {
    const auto roughed = [&](std::size_t i) -> std::optional<Roughed> {
      tried.push_back(steps.front().candidates[i].cutter.id);
      const auto at = of.find(tried.back());
      if (at == of.end()) return std::nullopt;
      return at->second;
    };
    return rank_by_rest(plan, steps, steps.front(), {}, rest, roughed, [&] { best.push_back(tried.back()); });
  }
};

using Ids = std::vector<std::string>;

// What is left takes a quarter of the mill's rate, and another change: 100 s with 100 of 1000 mm3 left are
// 100 + 10 + 100 100 / 250 + 10 = 160 s.
TEST(RankByRest, EndsWithTheMillThatLeavesNextToNothing) {
  Asked a({mill("20r1", 20, 1), mill("20r4", 20, 4), mill("16r3", 16, 3), mill("10r2", 10, 2)});
  a.of = {{"20r1", {90, 1000, 100}}, {"20r4", {100, 1000, 100}}, {"16r3", {120, 1000, 1}}};
  ASSERT_TRUE(a.rank(false));
  EXPECT_EQ(a.tried, (Ids{"20r4", "16r3"})) << "of a diameter the roundest corner";
  EXPECT_EQ(a.best, a.tried) << "160 s, then 130 s";
  EXPECT_EQ(a.steps.front().cutter.id, "16r3");
  EXPECT_EQ(a.steps.front().candidates.front().cutter.id, "16r3");
}

TEST(RankByRest, EndsWhereANarrowerMillTakesLonger) {
  Asked a({mill("20r4", 20, 4), mill("16r3", 16, 3), mill("10r2", 10, 2)});
  a.of = {{"20r4", {100, 1000, 100}}, {"16r3", {200, 1000, 50}}, {"10r2", {50, 1000, 0}}};
  ASSERT_TRUE(a.rank(false));
  EXPECT_EQ(a.tried, (Ids{"20r4", "16r3"}));
  EXPECT_EQ(a.best, (Ids{"20r4"}));
  EXPECT_EQ(a.steps.front().cutter.id, "20r4");
}

TEST(RankByRest, OfARestTriesABallOfEachDiameterToo) {
  Asked a({mill("10r2", 10, 2), mill("10b", 10, 5), mill("8r2", 8, 2), mill("8b", 8, 4), mill("6b", 6, 3)});
  a.of = {{"10r2", {100, 1000, 100}},
          {"10b", {300, 1000, 100}},
          {"8r2", {150, 1000, 100}},
          {"8b", {200, 1000, 100}},
          {"6b", {10, 1000, 100}}};
  ASSERT_TRUE(a.rank(true));
  EXPECT_EQ(a.tried, (Ids{"10b", "10r2", "8b", "8r2"})) << "the quickest of 8 is slower than that of 10";
  EXPECT_EQ(a.steps.front().cutter.id, "10r2");
}

TEST(RankByRest, TriesABallElsewhereOnlyWhereADiameterHasNoOtherMill) {
  Asked a({mill("10r2", 10, 2), mill("10b", 10, 5), mill("8b", 8, 4)});
  a.of = {{"10r2", {100, 1000, 100}}, {"8b", {100, 1000, 100}}};
  ASSERT_TRUE(a.rank(false));
  EXPECT_EQ(a.tried, (Ids{"10r2", "8b"}));
}

TEST(RankByRest, SaysNoWhereNoneTakesAnything) {
  Asked a({mill("10r2", 10, 2), mill("8r2", 8, 2)});
  a.of = {{"10r2", {100, 0, 100}}};
  EXPECT_FALSE(a.rank(true));
  EXPECT_EQ(a.tried, (Ids{"10r2", "8r2"}));
  EXPECT_TRUE(a.best.empty());
  EXPECT_EQ(a.steps.front().cutter.id, "10r2") << "as it was";
}

}  // namespace
}  // namespace capstan::step
