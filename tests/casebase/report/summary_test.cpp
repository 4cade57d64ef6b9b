#include "casebase/report/summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "casebase/report/picture.h"
#include "tests/casebase/sample.h"

namespace capstan::casebase::report {
namespace {

Case cut(const std::string& step, double predicted_s, double observed_s, Verdict verdict = Verdict::kGood) {
  Case c = sample();
  c.from.workingstep = step;
  c.predicted.time_s = predicted_s;
  c.observed.time_s = Figure{observed_s};
  c.observed.verdict = verdict;
  return c;
}

std::vector<Case> some() {
  return {cut("A", 10.0, 20.0), cut("A", 10.0, 21.0), cut("A", 10.0, 19.0, Verdict::kBad),
          cut("B<&>", 10.0, 11.0), cut("B<&>", 10.0, 9.1)};
}

TEST(CaseReport, GroupsCasesAndTellsMeanAndSpread) {
  const std::vector<Case> cases = some();
  const auto groups = grouped(cases, By::kWorkingstep);
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].name, "A");
  EXPECT_EQ(groups[0].good, 2U);
  EXPECT_EQ(groups[0].bad, 1U);
  EXPECT_EQ(groups[0].time_s.count, 3U);
  EXPECT_DOUBLE_EQ(groups[0].time_s.mean, 20.0);
  EXPECT_DOUBLE_EQ(groups[0].time_s.std_dev, 1.0);
  EXPECT_DOUBLE_EQ(groups[0].time_s.low, 19.0);
  EXPECT_DOUBLE_EQ(groups[0].time_s.high, 21.0);
  EXPECT_EQ(groups[0].lag_mm.count, 0U);
  EXPECT_EQ(grouped(cases, By::kTool).size(), 1U);
  EXPECT_EQ(grouped(cases, By::kFeature).size(), 1U);
}

TEST(CaseReport, BlamesAModelThatIsOffByMoreThanChance) {
  const std::vector<Case> cases = some();
  const auto groups = grouped(cases, By::kWorkingstep);
  const auto a = partings_of(groups[0].cases), b = partings_of(groups[1].cases);
  ASSERT_EQ(a.size(), 1U);
  EXPECT_EQ(a.front().quantity->name, "time");
  EXPECT_NEAR(a.front().ratio, 2.0, 0.01);
  EXPECT_TRUE(a.front().apart);
  EXPECT_FALSE(b.front().apart);
  const Case single = cut("C", 10.0, 20.0);
  const Case* one = &single;
  EXPECT_FALSE(partings_of({&one, 1}).front().apart);
}

TEST(CaseReport, DoesNotTakeASimulatedFigureForAnObservation) {
  std::vector<Case> cases = some();
  for (Case& c : cases) c.observed.time_s->origin = Origin::kSimulated;
  const auto groups = grouped(cases, By::kWorkingstep);
  EXPECT_EQ(groups[0].time_s.count, 0U);
  EXPECT_TRUE(partings_of(groups[0].cases).empty());
}

TEST(CaseReport, PictureHasAPointPerCaseAndItsTextEscaped) {
  const std::vector<Case> cases = some();
  const std::string picture = picture_of("all", grouped(cases, By::kWorkingstep));
  std::size_t points = 0;
  for (auto at = picture.find("<circle"); at != std::string::npos; at = picture.find("<circle", at + 1))
    ++points;
  EXPECT_EQ(points, cases.size());
  EXPECT_THAT(picture, ::testing::HasSubstr("B&lt;&amp;&gt;"));
  EXPECT_THAT(picture_of("none", {}), ::testing::HasSubstr("no case was both predicted and observed"));
}

}  // namespace
}  // namespace capstan::casebase::report
