#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "planner/making/step/cut/ranking.h"
#include "planner/model/plan/decision/condemned.h"
#include "planner/proof/verify/verify.h"
#include "tests/door/pipeline/block.h"
#include "tests/support/corpus.h"

// Magazines with fewer pockets than the tools that a part is made with best.

namespace capstan::pipeline {
namespace {

using ::testing::IsEmpty;

block::Planned made_with(int pockets, const std::string& file, const Policy& policy = {}) {
  Inputs in = block::shop();
  in.machine.magazine_pockets = pockets;
  Job job;
  auto read = read_plan(testing::slurp(file), "part.p21", job);
  EXPECT_TRUE(read) << file;
  auto plan = bind(read.value(), in, policy, job);
  EXPECT_TRUE(plan) << (plan ? "" : to_text(plan.error()));
  std::string said;
  for (const auto& d : job.diagnostics()) said += d.code + ": " + d.message + "\n";
  return {plan ? *std::move(plan) : model::Plan{}, said};
}

block::Planned bracket_with(int pockets) {
  return made_with(pockets, testing::source_dir() + "/examples/bracket.p21");
}

class MagazineOfAnySize : public ::testing::TestWithParam<int> {};

TEST_P(MagazineOfAnySize, HoldsTheToolsOfThePlanWhateverFeaturesThatCosts) {
  const auto made = bracket_with(GetParam());
  EXPECT_LE(made.plan.cutters.size(), static_cast<std::size_t>(GetParam())) << made.said;
  Job job;
  const auto findings = verify::check_plan(made.plan, job);
  for (const auto& f : findings) EXPECT_NE(f.severity, Severity::kError) << f.message;
  EXPECT_THAT(model::condemned(made.plan, findings), IsEmpty()) << made.said;
  EXPECT_FALSE(made.plan.steps.empty());
}

INSTANTIATE_TEST_SUITE_P(OfPockets, MagazineOfAnySize, ::testing::Values(2, 3, 4, 5, 6, 8));

TEST(Magazine, OfNoPocketOrOneIsChangedByHandWithAsManyToolsAsItTakesAndThatIsTold) {
  const auto with_changer = bracket_with(24);
  ASSERT_THAT(with_changer.plan.unplanned, IsEmpty());
  for (const int pockets : {0, 1}) {
    const auto by_hand = bracket_with(pockets);
    EXPECT_THAT(by_hand.plan.unplanned, IsEmpty()) << by_hand.said;
    EXPECT_EQ(by_hand.plan.cutters.size(), with_changer.plan.cutters.size());
    EXPECT_THAT(by_hand.said, ::testing::HasSubstr("PIP-BY-HAND")) << pockets;
    Job job;
    for (const auto& f : verify::check_plan(by_hand.plan, job))
      EXPECT_NE(f.severity, Severity::kError) << f.message;
  }
  EXPECT_THAT(with_changer.said, ::testing::Not(::testing::HasSubstr("PIP-BY-HAND")));
}

TEST(Magazine, LosesNoFeatureThatFewerToolsMake) {
  // Best are nine tools; six make all of it: the face by the end mill, the counterbore and the slot by one.
  EXPECT_THAT(bracket_with(6).plan.unplanned, IsEmpty());
  // Four do not drill and tap M6: five tools for holes alone.
  const auto of_four = bracket_with(4);
  ASSERT_EQ(of_four.plan.unplanned.size(), 2U) << of_four.said;
  for (const auto& u : of_four.plan.unplanned)
    EXPECT_THAT(u.reason, ::testing::HasSubstr("the magazine has 4 pockets")) << u.reason;
}

TEST(MagazineCorpus, OfFourPocketsMakesNistsExampleOne) {
  CAPSTAN_CORPUS_FILE(file, "iso14649/nist_ex1.stp");
  EXPECT_THAT(made_with(4, file, {.reopen = Reopen::kOperations}).plan.unplanned, IsEmpty());
}

TEST(Magazine, ThatIsNotFullChangesNoPlan) {
  const auto few = bracket_with(9), many = bracket_with(24);
  ASSERT_EQ(few.plan.steps.size(), many.plan.steps.size());
  for (std::size_t i = 0; i < few.plan.steps.size(); ++i)
    EXPECT_EQ(few.plan.steps[i].cutter_id, many.plan.steps[i].cutter_id);
}

draft::StepDraft with_candidates(const std::vector<std::string>& ids) {
  std::vector<model::Candidate> all(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) all[i].cutter.id = ids[i];
  draft::CandidatePool pool;
  draft::StepDraft out;
  out.candidates = pool.list(all);
  out.cutter = out.candidates.front().cutter;
  return out;
}

TEST(Magazine, ThatIsFullLeavesAStepTheToolsInUse) {
  std::vector<draft::StepDraft> steps{with_candidates({"a"}), with_candidates({"b"}),
                                      with_candidates({"c", "d", "b"})};
  model::Machine machine;
  const auto left = [&](int pockets) {
    machine.magazine_pockets = pockets;
    auto all = steps;
    step::keep_in_magazine(machine, all, all.back());
    std::vector<std::string> out;
    for (const auto& c : all.back().candidates) out.push_back(c.cutter.id);
    return out;
  };
  using ::testing::ElementsAre;
  EXPECT_THAT(left(3), ElementsAre("c", "d", "b"));  // a, b and any
  EXPECT_THAT(left(2), ElementsAre("c", "b"));
  EXPECT_THAT(left(1), ElementsAre("c", "d", "b"));  // the spindle itself: changed by hand
}

}  // namespace
}  // namespace capstan::pipeline
