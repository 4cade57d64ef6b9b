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

Spread figure(const Group& group, std::string_view column) {
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    if (kColumns[i].name == column) return group.figures[i];
  }
  ADD_FAILURE() << "no column " << column;
  return {};
}

/// A bore 8 H7 (0 to 15 um), whose path aims at the middle of the zone and is expected to bend by 2 um.
Case bore(double off_nominal_mm) {
  Case c = sample();
  c.from.workingstep = "BORE";
  c.observed = {};
  c.observed.size_deviation_mm = Figure{off_nominal_mm};
  c.bound.aimed_over_mm = Figure{0.0075, 0.0, Origin::kSimulated};
  c.predicted.deflection_mm = 0.002;
  return c;
}
Parting size_parting(const std::vector<Case>& cases) {
  const auto groups = grouped(cases, By::kWorkingstep);
  const auto all = partings_of(groups.front().cases);
  return all.empty() ? Parting{} : all.front();
}

std::size_t count_of(std::string_view text, std::string_view what) {
  std::size_t n = 0;
  for (auto at = text.find(what); at != std::string_view::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

TEST(CaseReport, ABoreInTheMiddleOfItsZoneIsNotBent) {
  const Parting p = size_parting({bore(0.0074), bore(0.0075), bore(0.0076)});
  ASSERT_NE(p.quantity, nullptr);
  EXPECT_EQ(p.count, 3U);  // one of them is off by nothing
  EXPECT_FALSE(p.apart);
}

TEST(CaseReport, ABoreOffItsAimByMoreThanTheBendingIsLaidOnBending) {
  // 6 um off the aim, three times the 2 um of the bending; off the nominal size by 1.5 um alone.
  const Parting p = size_parting({bore(0.0014), bore(0.0015), bore(0.0016)});
  EXPECT_NEAR(p.ratio, 3.0, 0.01);
  EXPECT_TRUE(p.apart);
}

TEST(CaseReport, ASizeWhosePathDoesNotStateItsAimBlamesNobody) {
  Case c = bore(0.0014);
  c.bound.aimed_over_mm.reset();
  EXPECT_EQ(size_parting({c, c}).quantity, nullptr);
}

TEST(CaseReport, PictureShowsEachObservedFigureByWorkingstepToolAndFeature) {
  std::vector<Case> cases = some();
  for (Case& c : cases) {
    c.observed.lag_mm = Figure{0.02};
    c.observed.spindle_load_percent = Figure{40.0};
    c.observed.surface_ra_um = Figure{0.8};
  }
  const auto steps = grouped(cases, By::kWorkingstep), tools = grouped(cases, By::kTool),
             features = grouped(cases, By::kFeature);
  const std::string picture = picture_of("all", steps, tools, features);
  for (const char* by : {"workingstep", "tool", "feature"}) {
    for (const char* what : {"time s", "lag mm", "load %", "Ra um"})
      EXPECT_EQ(count_of(picture, std::string(">") + what + " by " + by + "<"), 1U) << what << " by " << by;
    EXPECT_EQ(count_of(picture, std::string("wear mm by ") + by), 0U);  // nobody measured it
  }
}

TEST(CaseReport, GroupsCasesAndTellsMeanAndSpread) {
  const std::vector<Case> cases = some();
  const auto groups = grouped(cases, By::kWorkingstep);
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].name, "A");
  EXPECT_EQ(groups[0].good, 2U);
  EXPECT_EQ(groups[0].bad, 1U);
  const Spread time = figure(groups[0], "time");
  EXPECT_EQ(time.count, 3U);
  EXPECT_DOUBLE_EQ(time.mean, 20.0);
  EXPECT_DOUBLE_EQ(time.std_dev, 1.0);
  EXPECT_DOUBLE_EQ(time.low, 19.0);
  EXPECT_DOUBLE_EQ(time.high, 21.0);
  EXPECT_EQ(figure(groups[0], "lag").count, 0U);
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

TEST(CaseReport, ATimeOfNothingBlamesNobody) {
  const std::vector<Case> cases = {cut("A", 10.0, 0.0), cut("A", 10.0, 0.0)};
  const auto groups = grouped(cases, By::kWorkingstep);
  EXPECT_TRUE(partings_of(groups.front().cases).empty());
}

TEST(CaseReport, DoesNotTakeASimulatedFigureForAnObservation) {
  std::vector<Case> cases = some();
  for (Case& c : cases) c.observed.time_s->origin = Origin::kSimulated;
  const auto groups = grouped(cases, By::kWorkingstep);
  EXPECT_EQ(figure(groups[0], "time").count, 0U);
  EXPECT_TRUE(partings_of(groups[0].cases).empty());
}

TEST(CaseReport, PictureHasAPointPerCaseAndItsTextEscaped) {
  const std::vector<Case> cases = some();
  const std::string picture = picture_of("all", grouped(cases, By::kWorkingstep), {}, {});
  EXPECT_EQ(count_of(picture, "<circle"), cases.size());
  EXPECT_THAT(picture, ::testing::HasSubstr("B&lt;&amp;&gt;"));
  EXPECT_THAT(picture_of("none", {}, {}, {}),
              ::testing::HasSubstr("no case was both predicted and observed"));
}

}  // namespace
}  // namespace capstan::casebase::report
