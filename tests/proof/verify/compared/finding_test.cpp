#include <gtest/gtest.h>

#include "planner/ground/memo/memo.h"
#include "planner/proof/verify/compared/compare.h"
#include "planner/proof/verify/compared/feature_readings.h"
#include "planner/proof/verify/verify.h"
#include "tests/proof/verify/plans.h"

// What the check says of a feature that is read in two ways, on the small plan that is right.

namespace capstan::verify {
namespace {

using testing::PlanMaker;

std::vector<model::Finding> meaning(const model::Plan& plan, const std::vector<PlannersReading>& part) {
  Findings findings;
  check_meaning(plan, part, findings);
  return findings.take();
}

TEST(MeaningFinding, OfAPlanThatIsRightThereIsNone) {
  const PlanMaker k = testing::good_plan();
  EXPECT_TRUE(meaning(k.plan, planners_readings(k.plan.model)).empty());
}

TEST(MeaningFinding, NamesFeatureStepPlaceAndBothReadings) {
  const PlanMaker k = testing::good_plan();
  std::vector<PlannersReading> part = planners_readings(k.plan.model);
  for (auto& e : part) {
    if (e.shapes.at(0).kind == model::ShapeKind::kHole) e.shapes[0].frame.origin = {0, 0, 0};  // at X15 Y15
  }
  const auto findings = meaning(k.plan, part);
  ASSERT_EQ(findings.size(), 1u);
  const model::Finding& f = findings[0];
  EXPECT_EQ(f.code, "CHK-MEANING");
  EXPECT_EQ(f.property, 38);
  EXPECT_EQ(f.severity, Severity::kError);
  EXPECT_EQ(f.step, "drill");
  for (const char* part_of :
       {"is read in two ways", "of the workpiece", "ROUND_HOLE at X15 Y15 Z0, 20 mm deep",
        "hole at X0 Y0 Z0, 20 mm deep", "do not cut it"})
    EXPECT_NE(f.message.find(part_of), std::string::npos) << f.message;
}

TEST(MeaningFinding, ReadingsThatAgreedBeforeAreKnownAndOneThatDiffersIsFoundEachTime) {
  const PlanMaker k = testing::good_plan();
  memo::Memo known;
  Findings right;
  std::vector<PlannersReading> part = planners_readings(k.plan.model);
  check_meaning(k.plan, part, right, &known);
  EXPECT_TRUE(right.take().empty());
  EXPECT_EQ(known.counts(memo::Stage::kPart).made, part.size());
  for (auto& e : part) {
    if (e.shapes.at(0).kind == model::ShapeKind::kHole) e.shapes[0].frame.origin = {0, 0, 0};
  }
  for (int i = 0; i < 2; ++i) {
    Findings findings;
    check_meaning(k.plan, part, findings, &known);
    EXPECT_EQ(findings.take(), meaning(k.plan, part)) << "time " << i + 1;
  }
  EXPECT_EQ(known.counts(memo::Stage::kPart).found, 2 * (part.size() - 1));
}

TEST(MeaningFinding, WhatNoStepCutsIsAWarning) {
  PlanMaker k = testing::good_plan();
  k.pocket("other", 80, 80, 20, 5);
  std::vector<PlannersReading> part = planners_readings(k.plan.model);
  ASSERT_TRUE(meaning(k.plan, part).empty());
  for (auto& e : part) {
    if (e.shapes.at(0).name == "other") e.shapes[0].depth_mm = 9;
  }
  const auto findings = meaning(k.plan, part);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].severity, Severity::kWarning);
}

}  // namespace
}  // namespace capstan::verify
