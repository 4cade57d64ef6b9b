#include "casebase/tune/card.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "casebase/casebase.h"
#include "planner/model/plan/resources/specific_force.h"

namespace capstan::casebase::tune {
namespace {

constexpr double kSpread = 1.5;    // of the card
constexpr double kMargin = 1.7;    // of the plans that the cases are of
constexpr double kPlannedN = 850;  // with that margin: 500 N are expected of a sharp edge

model::WorkMaterial card() {
  model::WorkMaterial m;
  m.id = "c45";
  m.iso_group = "P";
  m.kc11_n_mm2 = 1800.0;
  m.mc = 0.2;
  model::ToolLifeLaw& law = m.life.emplace_back();
  law.substrate = "carbide";
  law.v0_m_min = 200.0;
  law.life_min = 30.0;
  law.n = 0.25;
  law.scatter = 0.3;
  return m;
}

model::Cutter mill(const std::string& kind) {
  model::Cutter c;
  c.substrate = model::Substrate::kCarbide;
  c.cutter_class = model::cutter_class_from_text(kind).value();
  return c;
}

/// A cut whose force was `factor` of what the card's law expects; three on each edge, 4 % from cut to cut.
Case cut(int i, double factor) {
  Case c;
  c.origin = Origin::kMeasured;
  c.asked.material_group = material_group_of(card());
  c.asked.tool_class = "carbide/endmill";
  c.bound.vc_m_min = 200.0 + i;
  c.bound.fz_mm = 0.1;
  c.bound.ap_mm = 2.0;
  c.bound.mean_chip_mm = 0.05;
  c.predicted.peak_force_n = kPlannedN;
  c.predicted.force_margin = kMargin;
  c.predicted.specific_force_n_mm2 = model::specific_force_n_mm2(card(), mill("endmill"), 0.05);
  c.observed.peak_force_n = Figure{.value = factor * kPlannedN / kMargin * (1.0 + 0.04 * (i % 3 - 1))};
  c.from.tool_instance = "E" + std::to_string(i / 3);
  c.from.source = "log";
  return c;
}
std::vector<Case> cuts(int count, double factor) {
  std::vector<Case> out;
  for (int i = 0; i < count; ++i) out.push_back(cut(i, factor));
  return out;
}
std::vector<CardCorrection> corrections(const std::vector<Case>& cases,
                                        const model::WorkMaterial& of = card()) {
  return card_corrections(cases, of, [](model::Substrate) { return kSpread; });
}

TEST(CardCorrections, FindTheFactorOfTheForceAndNarrowItsSpread) {
  const auto found = corrections(cuts(18, 0.8));
  ASSERT_EQ(found.size(), 1U);
  const CardCorrection& c = found.front();
  EXPECT_TRUE(c.taken()) << c.why_not;
  EXPECT_EQ(c.edges, 6U);
  EXPECT_EQ(c.cases, 18U);
  EXPECT_NEAR(c.factor, 0.8, 0.02);
  EXPECT_GE(c.spread, kLeastForceSpread);
  EXPECT_LT(c.spread, 0.5 * (1.0 + kSpread));
  EXPECT_NEAR(c.chip_mm, 0.05, 1e-9);
}

TEST(CardCorrections, AreTheSameWhateverThePlansOfTheCasesExpected) {
  // The later half was planned with what the earlier half had corrected, at another margin.
  auto cases = cuts(18, 0.8);
  const double share = model::kienzle_share(card(), mill("endmill"));  // the corrected law is for no rake
  for (std::size_t i = 9; i < cases.size(); ++i) {
    cases[i].predicted.specific_force_n_mm2 *= 0.8 / share;
    cases[i].predicted.force_margin = 1.3;
    cases[i].predicted.peak_force_n = 0.8 / share * 1.3 * kPlannedN / kMargin;
  }
  EXPECT_NEAR(corrections(cases).front().factor, corrections(cuts(18, 0.8)).front().factor, 1e-9);
}

TEST(CardCorrections, RakedMillsSayNothingTooLittleOfMillsWithout) {
  // Each as its own law expects: the factor is of the law, not of the rake.
  auto cases = cuts(9, 1.0);
  for (int i = 9; i < 18; ++i) {
    Case c = cut(i, 1.0);
    c.asked.tool_class = "carbide/facemill";
    c.predicted.specific_force_n_mm2 = model::specific_force_n_mm2(card(), mill("facemill"), 0.05);
    cases.push_back(c);
  }
  EXPECT_NEAR(corrections(cases).front().factor, 1.0, 0.01);
}

TEST(CardCorrections, OfTwoEdgesAreToldAndNotTaken) {
  const auto found = corrections(cuts(6, 0.8));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_FALSE(found.front().taken());
  EXPECT_EQ(found.front().why_not, "measured on 2 edges, and 3 are needed");
}

TEST(CardCorrections, AForceTenTimesTooLowIsNotBelievedAndOneTooHighIs) {
  EXPECT_FALSE(corrections(cuts(30, 0.1)).front().taken());
  const auto high = corrections(cuts(30, 10.0));
  EXPECT_TRUE(high.front().taken());
  EXPECT_GT(high.front().factor, 5.0);
}

TEST(CardCorrections, AThousandCopiesUnderOtherNamesAreOne) {
  std::vector<Case> copies;
  for (int i = 0; i < 1000; ++i) {
    copies.push_back(cut(1, 0.7));
    copies.back().from.tool_instance = "E" + std::to_string(i);
  }
  const auto found = corrections(copies);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.front().cases, 1U);
  EXPECT_FALSE(found.front().taken());
}

TEST(CardCorrections, HearOnlyMeasuredForcesOfThisMaterialWhoseEdgeAndExpectationAreKnown) {
  const auto none = [](void (*change)(Case&)) {
    auto cases = cuts(18, 0.8);
    for (Case& c : cases) change(c);
    return corrections(cases).empty();
  };
  EXPECT_TRUE(none([](Case& c) { c.origin = Origin::kEntered; }));
  EXPECT_TRUE(none([](Case& c) { c.observed.peak_force_n->origin = Origin::kSimulated; }));
  EXPECT_TRUE(none([](Case& c) { c.asked.material_group = "N/6061"; }));
  EXPECT_TRUE(none([](Case& c) { c.from.tool_instance.clear(); }));
  EXPECT_TRUE(none([](Case& c) { c.predicted.force_margin = 0.0; }));
  EXPECT_TRUE(none([](Case& c) { c.predicted.specific_force_n_mm2 = 0.0; }));
}

TEST(CardCorrections, OneSensorThatReadsATenthMovesTheFactorLittle) {
  auto cases = cuts(30, 1.0);
  for (int i = 0; i < 3; ++i) cases[static_cast<std::size_t>(i)] = cut(i, 0.1);  // all cuts of one edge
  EXPECT_NEAR(corrections(cases).front().factor, 1.0, 0.1);
}

TEST(CardCorrections, FindTheLifeOfFollowedEdges) {
  std::vector<Case> cases;
  for (int edge = 0; edge < 5; ++edge) {
    Case c = cut(3 * edge, 1.0);
    c.observed.peak_force_n.reset();
    c.bound.vc_m_min = 200.0;
    // Worn to 0.3 mm after 20 min, 5 % from edge to edge.
    for (double t = 2.0; t <= 24.0; t += 2.0)
      c.observed.wear_series_mm.samples.push_back(
          {60.0 * t * (1.0 + 0.05 * (edge - 2)), 0.3 * std::pow(t / 20.0, 0.7)});
    cases.push_back(c);
  }
  const auto found = corrections(cases);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.front().model, CardModel::kLife);
  EXPECT_TRUE(found.front().taken()) << found.front().why_not;
  EXPECT_NEAR(found.front().factor, 20.0 / 30.0, 0.05);
  EXPECT_LT(found.front().spread, found.front().spread_before);
}

}  // namespace
}  // namespace capstan::casebase::tune
