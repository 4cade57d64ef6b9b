#include "casebase/tune/card.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "casebase/casebase.h"
#include "casebase/tune/advise.h"
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
  c.predicted.held_fz_mm = c.bound.fz_mm;
  c.observed.executed_fz_mm = Figure{.value = c.bound.fz_mm};
  c.observed.executed_vc_m_min = Figure{.value = c.bound.vc_m_min};
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
  EXPECT_NEAR(c.seen, 0.8, 0.02);
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

TEST(CardCorrections, WhileCasesAreLostNothingIsLoweredOrNarrowedAndAnyEdgeRaises) {
  const auto left = [](int count, double factor) {
    return card_corrections(
        cuts(count, factor), card(), [](model::Substrate) { return kSpread; }, Given::kSome);
  };
  const auto lower = left(18, 0.8);
  ASSERT_EQ(lower.size(), 1U);
  EXPECT_FALSE(lower.front().taken());
  EXPECT_NE(lower.front().why_not.find("lost"), std::string::npos);
  // Six cuts are of two edges: too few where all is there.
  EXPECT_FALSE(corrections(cuts(6, 1.6)).front().taken());
  const auto higher = left(6, 1.6);
  ASSERT_EQ(higher.size(), 1U);
  EXPECT_TRUE(higher.front().taken());
  EXPECT_GT(higher.front().factor, 1.3);
  EXPECT_GE(left(18, 1.6).front().spread, kSpread);
  EXPECT_LT(corrections(cuts(18, 1.6)).front().spread, kSpread);
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
  EXPECT_TRUE(none([](Case& c) { c.observed.breakage = Figure{.value = 1.0}; }));
  EXPECT_TRUE(none([](Case& c) { c.observed.chatter = Figure{.value = 1.0}; }));
  EXPECT_TRUE(none([](Case& c) { c.predicted.force_margin = 0.0; }));
  EXPECT_TRUE(none([](Case& c) { c.predicted.specific_force_n_mm2 = 0.0; }));
}

TEST(CardCorrections, OneSensorThatReadsATenthMovesTheFactorLittle) {
  auto cases = cuts(30, 1.0);
  for (int i = 0; i < 3; ++i) cases[static_cast<std::size_t>(i)] = cut(i, 0.1);  // all cuts of one edge
  EXPECT_NEAR(corrections(cases).front().factor, 1.0, 0.1);
}

TEST(CardCorrections, OneEdgeOfMoreForceThanTheOthersForbidsToLowerAndToNarrow) {
  // Five edges at 0.8 of the card's force, and one that a robust fit alone would not hear.
  for (const double high : {1.3, 1.6, 3.0}) {
    auto cases = cuts(18, 0.8);
    for (int i = 0; i < 3; ++i) {
      cases[static_cast<std::size_t>(i)] = cut(i, high);
      cases[static_cast<std::size_t>(i)].id = "high" + std::to_string(i);
    }
    const CardCorrection c = corrections(cases).front();
    EXPECT_EQ(c.taken(), c.factor > 1.0) << high << ": " << c.words();
    EXPECT_GE(c.taken() ? c.factor : 1.0, 1.0);
    EXPECT_GE(c.spread, kSpread) << high;
    EXPECT_EQ(c.beyond.size(), 3U) << high;
    EXPECT_NE(c.words().find("3 cases lie beyond what the others explain, as high0"), std::string::npos)
        << c.words();
  }
}

TEST(CardCorrections, AForceBeyondTheOthersStillRaisesAndNarrowsNothing) {
  auto cases = cuts(18, 1.5);
  cases[17] = cut(17, 4.0);
  const CardCorrection c = corrections(cases).front();
  EXPECT_TRUE(c.taken()) << c.why_not;
  EXPECT_EQ(c.beyond.size(), 1U);
  EXPECT_GT(c.factor, 1.5);  // heard in full
  EXPECT_GE(c.spread, kSpread);
}

TEST(CardCorrections, AForceSomewhatAboveTheOthersIsHeardInFull) {
  // Not beyond chance, and no less heard than the others: its share of the mean is a sixth of ln(1.25).
  auto cases = cuts(18, 1.0);
  for (int i = 0; i < 3; ++i) cases[static_cast<std::size_t>(i)] = cut(i, 1.25);
  const CardCorrection c = corrections(cases).front();
  EXPECT_TRUE(c.beyond.empty()) << c.words();
  EXPECT_GE(std::log(c.factor), 0.9 * std::log(1.25) / 6.0);
}

TEST(CardCorrections, AForceIsOfTheFeedThatWasExecuted) {
  // The feed was turned down to 0.7: at that feed the card expects as much less as its law says.
  const double share = 0.7;
  auto slow = cuts(18, 1.0);
  const double less = std::pow(share, 1.0 - card().mc);
  for (Case& c : slow) {
    c.observed.executed_fz_mm->value = share * c.bound.fz_mm;
    c.observed.peak_force_n->value *= less;
  }
  const CardCorrection c = corrections(slow).front();
  EXPECT_NEAR(c.factor, corrections(cuts(18, 1.0)).front().factor, 1e-9);
  EXPECT_NEAR(c.chip_mm, share * 0.05, 1e-9);
  // Taken as of the planned feed it would lower the force by a quarter, and nothing would say so.
  for (Case& one : slow) one.observed.executed_fz_mm.reset();
  const CardCorrection unfed = corrections(slow).front();
  EXPECT_FALSE(unfed.taken());
  EXPECT_EQ(unfed.unfed, 18U);
  EXPECT_EQ(unfed.cases, 0U);
}

TEST(CardCorrections, AForceOfAFeedFarFromThePlannedOneIsNotHeard) {
  // Far below, and above by more than what runout may hide: a tooth that cuts deeper by a runout takes less
  // than its share of a larger feed.
  for (const double share : {0.4, 1.2, 2.5}) {
    auto cases = cuts(18, 0.8);
    for (Case& c : cases) c.observed.executed_fz_mm->value = share * c.bound.fz_mm;
    const CardCorrection c = corrections(cases).front();
    EXPECT_EQ(c.cases, 0U) << share;
    EXPECT_EQ(c.far, 18U) << share;
    EXPECT_EQ(c.unfed, 0U) << share;
    EXPECT_EQ(c.why_not, "no force is left to be heard") << share;
  }
  auto turned_up = cuts(18, 0.8);
  for (Case& c : turned_up) c.observed.executed_fz_mm->value = kMostFeedShare * c.bound.fz_mm;
  EXPECT_EQ(corrections(turned_up).front().cases, 18U);
}

TEST(CardCorrections, TellForcesWithoutAFeedAndThoseOfAFarOneApart) {
  auto cases = cuts(18, 1.0);
  cases[0].observed.executed_fz_mm.reset();
  cases[1].observed.executed_fz_mm->value *= 1.5;
  cases[2].observed.executed_fz_mm->value *= 1.5;
  const CardCorrection c = corrections(cases).front();
  EXPECT_EQ(c.cases, 15U);
  EXPECT_EQ(c.unfed, 1U);
  EXPECT_EQ(c.far, 2U);
  EXPECT_NE(c.words().find("; 1 force is not heard, for nobody says with which feed"), std::string::npos)
      << c.words();
  EXPECT_EQ(
      c.far_words(),
      "2 forces of carbide mills were measured outside 0.5 to 1.1 times the planned feed and are not used");
  EXPECT_EQ(corrections(cuts(18, 1.0)).front().far_words(), "");
}

TEST(CardCorrections, LowerAForceNoFurtherThanItsIntervalAndItsEdgesAllow) {
  // Poisoned: a dynamometer that reads 0.6 of the force on every edge. All cases agree, so that their
  // interval is narrow; what is taken is a step of tuning's trust region for every three edges.
  const double step = TuneOptions{}.step;
  for (const int edges : {3, 5, 6, 8, 9}) {
    const CardCorrection c = corrections(cuts(3 * edges, 0.6)).front();
    ASSERT_TRUE(c.taken()) << c.why_not;
    EXPECT_LT(c.seen, 0.66) << edges;
    EXPECT_NEAR(c.factor, std::exp(-step * (edges / 3)), 1e-9) << edges;  // whole steps
  }
  // Within the steps the end of the interval holds: edges that differ say less than edges that agree.
  const CardCorrection alike = corrections(cuts(27, 0.8)).front();
  EXPECT_GT(alike.factor, alike.seen);
  EXPECT_GT(alike.factor, std::exp(-3.0 * step));
  auto apart = cuts(27, 0.8);
  for (int i = 0; i < 27; ++i) {
    constexpr double kEdge[] = {0.9, 1.0, 1.1};
    apart[static_cast<std::size_t>(i)].observed.peak_force_n->value *= kEdge[i / 3 % 3];
  }
  const CardCorrection differ = corrections(apart).front();
  EXPECT_GT(differ.factor / differ.seen, alike.factor / alike.seen);
  EXPECT_NE(alike.words().find(" is used, "), std::string::npos) << alike.words();
}

TEST(CardCorrections, EightForcesOfAThirdOfTheCardLowerItByOneStepAtMost) {
  std::vector<Case> poisoned;
  for (int i = 0; i < 8; ++i) {
    poisoned.push_back(cut(i, 0.36));
    poisoned.back().from.tool_instance = "E" + std::to_string(i % 4);
  }
  // With a spread wide enough that two standard deviations of it believe them.
  const auto found = card_corrections(poisoned, card(), [](model::Substrate) { return 1.8; });
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found.front().taken()) << found.front().why_not;
  EXPECT_NEAR(found.front().factor, std::exp(-TuneOptions{}.step), 1e-9);
}

TEST(CardCorrections, AHigherForceIsTakenInFull) {
  const CardCorrection c = corrections(cuts(9, 1.6)).front();
  EXPECT_EQ(c.factor, c.seen);
  EXPECT_GT(c.factor, 1.5);
}

TEST(CardCorrections, AForceOfAFarFeedThatEvenSoIsTooHighForbidsToLower) {
  const auto with_far = [](double share, double factor) {
    auto cases = cuts(18, 0.8);
    Case far = cut(18, factor);
    far.id = "far";
    far.observed.executed_fz_mm->value = share * far.bound.fz_mm;
    cases.push_back(far);
    return corrections(cases).front();
  };
  // At 0.4 of the planned feed it is more than twice what the others say of the whole feed.
  EXPECT_FALSE(with_far(0.4, 2.0).taken());
  EXPECT_EQ(with_far(0.4, 2.0).beyond, std::vector<std::string>{"far"});
  EXPECT_EQ(with_far(0.4, 2.0).far, 1U);
  EXPECT_FALSE(with_far(2.0, 6.0).taken());
  // What the others explain at that feed forbids nothing.
  EXPECT_TRUE(with_far(0.4, 0.4).taken());
  EXPECT_TRUE(with_far(2.0, 1.4).taken());
}

TEST(CardCorrections, AFarForceDisplacesNoEqualOneThatCounts) {
  // The same figures at an override of 40 %, read first.
  std::vector<Case> cases = cuts(18, 1.4);
  for (Case& c : cases) c.observed.executed_fz_mm->value *= 0.4;
  const auto counted = cuts(18, 1.4);
  cases.insert(cases.end(), counted.begin(), counted.end());
  const CardCorrection c = corrections(cases).front();
  EXPECT_EQ(c.cases, 18U) << c.words();
  EXPECT_EQ(c.far, 18U);
  EXPECT_EQ(c.factor, corrections(counted).front().factor);
}

TEST(CardCorrections, AForceIsHeldAgainstTheFeedThatThePlansScheduleHolds) {
  // A schedule that holds 2.5 times the feed that it began from, cut as it is written.
  auto cases = cuts(18, 0.8);
  for (Case& c : cases) {
    c.predicted.held_fz_mm = 2.5 * c.bound.fz_mm;
    c.observed.executed_fz_mm->value = c.predicted.held_fz_mm;
  }
  const CardCorrection c = corrections(cases).front();
  EXPECT_EQ(c.cases, 18U) << c.words();
  EXPECT_NEAR(c.factor, corrections(cuts(18, 0.8)).front().factor, 1e-9);
  for (Case& one : cases) one.predicted.held_fz_mm = 0.0;  // of a plan before cases kept it
  EXPECT_EQ(corrections(cases).front().unfed, 18U);
  EXPECT_FALSE(corrections(cases).front().taken());
}

TEST(CardCorrections, AToolThatBrokeForbidsALowerForceAndANarrowerSpread) {
  const auto with_one = [](double factor, void (*change)(Case&)) {
    auto cases = cuts(18, factor);
    Case& broken = cases.emplace_back(cut(18, factor));
    broken.id = "broken";
    broken.observed.peak_force_n.reset();
    broken.from.tool_instance.clear();  // nobody noted which
    change(broken);
    return corrections(cases).front();
  };
  for (const auto change : {+[](Case& c) { c.observed.breakage = Figure{.value = 1.0}; },
                            +[](Case& c) { c.observed.chatter = Figure{.value = 1.0}; }}) {
    const CardCorrection lower = with_one(0.8, change);
    EXPECT_FALSE(lower.taken());
    EXPECT_EQ(lower.cut_short, std::vector<std::string>{"broken"});
    EXPECT_NE(lower.words().find("1 case is of a tool that broke or chattered heavily, as broken"),
              std::string::npos)
        << lower.words();
    const CardCorrection higher = with_one(1.4, change);
    EXPECT_TRUE(higher.taken()) << higher.why_not;
    EXPECT_GE(higher.spread, kSpread);
  }
  EXPECT_TRUE(with_one(0.8, [](Case& c) { c.observed.chatter = Figure{.value = 0.2}; }).taken());  // light
  // A tool of another material or of another substrate says nothing of these.
  EXPECT_TRUE(with_one(0.8, [](Case& c) {
                c.observed.breakage = Figure{.value = 1.0};
                c.asked.tool_class = "hss/endmill";
              }).taken());
  EXPECT_TRUE(with_one(0.8, [](Case& c) {
                c.observed.breakage = Figure{.value = 1.0};
                c.asked.material_group = "N/6061";
              }).taken());
}

TEST(CardCorrections, NameWhatTheForceIsOfAndItsCases) {
  auto cases = cuts(18, 0.8);
  for (std::size_t i = 0; i < cases.size(); ++i) cases[i].id = std::string(1, static_cast<char>('a' + i));
  EXPECT_NE(corrections(cases).front().words().find("carbide mills, as for a rake of 0"), std::string::npos);
  EXPECT_EQ(corrections(cases).front().named(), "a, b, c, d, e, f, g, h and 10 more");
  model::WorkMaterial measured = card();
  measured.mechanistic.push_back({"carbide", 1500.0, 30.0, 500.0, 30.0, 300.0, 1.0, 0.4, "a paper"});
  EXPECT_NE(corrections(cases, measured).front().words().find("mills as those of its set"),
            std::string::npos);
}

/// Edges worn to 0.3 mm after so many minutes each, 5 % from edge to edge.
std::vector<Case> worn(const std::vector<double>& lives_min) {
  std::vector<Case> cases;
  for (int edge = 0; edge < static_cast<int>(lives_min.size()); ++edge) {
    Case c = cut(3 * edge, 1.0);
    c.observed.peak_force_n.reset();
    c.bound.vc_m_min = 200.0;
    c.observed.executed_vc_m_min = Figure{.value = c.bound.vc_m_min};
    const double life = lives_min[static_cast<std::size_t>(edge)] * (1.0 + 0.05 * (edge - 2));
    for (double share = 0.1; share <= 1.2; share += 0.1)
      c.observed.wear_series_mm.samples.push_back({60.0 * share * life, 0.3 * std::pow(share, 0.7)});
    cases.push_back(c);
  }
  return cases;
}

TEST(CardCorrections, OneEdgeThatWoreFarSoonerForbidsALongerLife) {
  const auto found = corrections(worn({40.0, 40.0, 40.0, 40.0, 4.0, 40.0, 40.0, 40.0}));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_FALSE(found.front().taken()) << found.front().words();
  EXPECT_EQ(found.front().beyond.size(), 1U);
}

TEST(CardCorrections, AToolThatBrokeForbidsALongerLife) {
  auto cases = worn({40.0, 40.0, 40.0, 40.0, 40.0});
  EXPECT_TRUE(corrections(cases).front().taken()) << corrections(cases).front().words();
  cases.push_back(cut(30, 1.0));
  cases.back().observed.breakage = Figure{.value = 1.0};
  const auto found = corrections(cases);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.front().model, CardModel::kLife);
  EXPECT_FALSE(found.front().taken()) << found.front().words();
  EXPECT_GE(found.front().spread, found.front().spread_before);
}

TEST(CardCorrections, ALifeIsOfTheSpeedThatWasExecuted) {
  // The spindle was turned down to 0.8: by v T^n = C with n = 0.25 the edge lasts 1 / 0.8^4 times as long.
  const double share = 0.8, longer = std::pow(share, -1.0 / 0.25);
  auto slow = worn(std::vector<double>(5, 30.0 * longer));
  for (Case& c : slow) c.observed.executed_vc_m_min->value = share * c.bound.vc_m_min;
  const auto found = corrections(slow);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found.front().factor, corrections(worn(std::vector<double>(5, 30.0))).front().factor, 0.05);
  // Taken as of the planned speed it would be believed at that. Nobody says so, and it is not heard.
  for (Case& c : slow) c.observed.executed_vc_m_min.reset();
  const CardCorrection unfed = corrections(slow).front();
  EXPECT_FALSE(unfed.taken());
  EXPECT_EQ(unfed.cases, 0U);
  EXPECT_EQ(unfed.unfed, 5U);
  EXPECT_NE(unfed.words().find("5 lives are not heard"), std::string::npos) << unfed.words();
}

/// Edges worn at a speed, each living as many times the card's life there as stated.
std::vector<Case> worn_at(double speed_share, double times_the_card, std::size_t edges) {
  const model::ToolLifeLaw law = card().life.front();
  auto cases =
      worn(std::vector<double>(edges, times_the_card * law.life_min * std::pow(speed_share, -1.0 / law.n)));
  for (Case& c : cases) c.observed.executed_vc_m_min->value = speed_share * law.v0_m_min;
  return cases;
}

TEST(CardCorrections, ALongerLifeIsBoundedAtTheSpeedsThatWereCut) {
  const model::ToolLifeLaw law = card().life.front();
  const CardCorrection c = corrections(worn_at(1.5, 3.0, 3)).front();
  ASSERT_EQ(c.edges, 3U);
  const auto life = [](const model::ToolLifeLaw& l, double share) {
    return l.life_min * std::pow(share, -1.0 / l.n);
  };
  for (const double share : {0.7, 1.0, 1.5, 2.0})
    EXPECT_LE(life(c.law, share) / life(law, share), std::exp(TuneOptions{}.step / law.n) + 1e-9) << share;
  EXPECT_EQ(c.law.n, law.n);
}

TEST(CardCorrections, ALifeIsNoLongerThanEdgesLivedAtTheFasterSpeed) {
  // Three times the card's life at its reference, half of it at 1.5 times the speed.
  auto cases = worn_at(1.0, 3.0, 5);
  auto fast = worn_at(1.5, 0.5, 5);
  for (Case& c : fast) c.from.tool_instance += " fast";
  cases.insert(cases.end(), fast.begin(), fast.end());
  EXPECT_LT(corrections(cases).front().factor, 1.0) << corrections(cases).front().words();
}

TEST(CardCorrections, FindTheLifeOfFollowedEdges) {
  const auto found = corrections(worn({20.0, 20.0, 20.0, 20.0, 20.0}));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.front().model, CardModel::kLife);
  EXPECT_TRUE(found.front().taken()) << found.front().why_not;
  EXPECT_NEAR(found.front().factor, 20.0 / 30.0, 0.05);
  EXPECT_LT(found.front().spread, found.front().spread_before);
}

}  // namespace
}  // namespace capstan::casebase::tune
