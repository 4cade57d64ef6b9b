#include "tooling/selection/selections.h"

#include <gtest/gtest.h>

#include "tests/tooling/selection/shipped.h"

namespace capstan::tooling {
namespace {

using model::CutterClass;
using model::ToolRequirement;

ToolRequirement drill(double diameter_mm) {
  ToolRequirement r;
  r.classes = {CutterClass::kTwistDrill};
  r.diameter_exact_mm = diameter_mm;
  r.reach_mm = 20.0;
  return r;
}

void expect_same(const model::Selection& a, const model::Selection& b) {
  EXPECT_EQ(a.ranked, b.ranked);
  EXPECT_EQ(a.rejected, b.rejected);
  EXPECT_EQ(a.would_fit, b.would_fit);
}

class SelectionsOfSteel : public ::testing::Test {
 protected:
  model::WorkMaterial steel_ = material("mild_steel");
  model::Machine machine_ = machine();
  Selections selections_{library(), steel_, machine_};
};

TEST_F(SelectionsOfSteel, AreWhatSelectAnswers) {
  for (const double d : {6.8, 8.0, 6.8, 500.0}) {
    SCOPED_TRACE(d);
    expect_same(selections_.of(drill(d), {}), select(drill(d), library(), steel_, machine_, {}));
  }
}

TEST_F(SelectionsOfSteel, AnswerTheSameQuestionOnce) {
  const model::Selection* first = &selections_.of(drill(6.8), {});
  EXPECT_EQ(&selections_.of(drill(6.8), {}), first);
}

TEST_F(SelectionsOfSteel, TellPreferencesApart) {
  const std::string free = selections_.of(drill(6.8), {}).ranked.at(0).cutter.id;
  Preferences used;
  used.used = {selections_.of(drill(6.8), {}).ranked.at(1).cutter.id};
  used.depth_mm = 15.0;
  expect_same(selections_.of(drill(6.8), used), select(drill(6.8), library(), steel_, machine_, used));
  EXPECT_EQ(selections_.of(drill(6.8), {}).ranked.at(0).cutter.id, free);
}

TEST_F(SelectionsOfSteel, StayRightWhenThereAreManyQuestions) {
  for (int i = 0; i < 600; ++i) (void)selections_.of(drill(1.0 + 0.01 * i), {});
  expect_same(selections_.of(drill(6.8), {}), select(drill(6.8), library(), steel_, machine_, {}));
}

}  // namespace
}  // namespace capstan::tooling
