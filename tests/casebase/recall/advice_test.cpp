#include "casebase/recall/advice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace capstan::casebase {
namespace {

constexpr Values kTable = {.vc_m_min = 200.0, .fz_mm = 0.1};

/// A measured cut of its own at these shares of the table's values.
Evidence cut(Verdict verdict, double share = 1.0, double distance = 0.0) {
  static int count = 0;
  const std::string name = "part " + std::to_string(++count);
  Evidence e;
  e.id = name;
  e.run = name;
  e.origin = Origin::kMeasured;
  e.verdict = verdict;
  e.blame = {.speed = true, .feed = true};
  e.distance = distance;
  e.cut = {.vc_m_min = share * kTable.vc_m_min, .fz_mm = share * kTable.fz_mm};
  return e;
}

std::vector<Evidence> cuts(std::size_t n, Verdict verdict, double share = 1.0, double distance = 0.0) {
  std::vector<Evidence> out;
  for (std::size_t i = 0; i < n; ++i) out.push_back(cut(verdict, share, distance));
  return out;
}

std::vector<Evidence> operator+(std::vector<Evidence> a, const std::vector<Evidence>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST(Advice, IsTheTableWhereNothingIsNear) {
  const Advice a = advise({}, kTable);
  EXPECT_FALSE(a.any());
  EXPECT_FALSE(a.leads);
  EXPECT_EQ(a.start, kTable);
}

TEST(Advice, StartsAtTheCentreOfGoodCuts) {
  const Advice a = advise(cuts(2, Verdict::kGood, 0.8) + cuts(3, Verdict::kGood, 0.9), kTable);
  EXPECT_TRUE(a.leads);
  EXPECT_DOUBLE_EQ(a.start.vc_m_min, 0.9 * kTable.vc_m_min);
  EXPECT_DOUBLE_EQ(a.start.fz_mm, 0.9 * kTable.fz_mm);
  EXPECT_EQ(a.good, 5);
}

TEST(Advice, OneBadCutAmongManyGoodOnesSilencesNobody) {
  const Advice a = advise(cuts(9, Verdict::kGood) + cuts(1, Verdict::kBad), kTable);
  EXPECT_TRUE(a.leads);
  EXPECT_FALSE(a.lowered);
  EXPECT_EQ(a.start.vc_m_min, kTable.vc_m_min);
  EXPECT_GE(a.success, kLeastSuccess);
}

TEST(Advice, ThirteenFailedCutsLowerTheTableBelowThem) {
  const Advice a = advise(cuts(13, Verdict::kBad), kTable);
  EXPECT_FALSE(a.leads);
  EXPECT_TRUE(a.lowered);
  EXPECT_LT(a.start.vc_m_min, kTable.vc_m_min);
  EXPECT_LT(a.start.fz_mm, kTable.fz_mm);
  EXPECT_LT(a.success_asked, 0.5);
  EXPECT_GE(a.success, kLeastSuccess);
}

TEST(Advice, IsLowerTheMoreFailedAndTheSofterTheyWereCut) {
  double before = kTable.vc_m_min;
  for (const std::size_t n : {1, 3, 13, 100}) {
    const double vc = advise(cuts(n, Verdict::kBad), kTable).start.vc_m_min;
    EXPECT_LT(vc, before) << n;
    before = vc;
  }
  const Advice soft = advise(cuts(13, Verdict::kBad, 0.7), kTable);
  EXPECT_LT(soft.start.vc_m_min, 0.7 * kTable.vc_m_min);
  EXPECT_LT(soft.start.fz_mm, 0.7 * kTable.fz_mm);
}

TEST(Advice, WhatFailedWhenCutMuchHarderBindsNothing) {
  const Advice a = advise(cuts(13, Verdict::kBad, 2.0), kTable);
  EXPECT_FALSE(a.lowered);
  EXPECT_EQ(a.start, kTable);
}

TEST(Advice, LaterGoodRepeatsLiftIt) {
  const auto bad = cuts(2, Verdict::kBad);
  EXPECT_TRUE(advise(bad, kTable).lowered);
  double before = 0.0;
  for (const std::size_t n : {1, 2, 4}) {
    const double vc = advise(bad + cuts(n, Verdict::kGood), kTable).start.vc_m_min;
    EXPECT_GT(vc, before) << n;
    before = vc;
  }
  EXPECT_EQ(advise(bad + cuts(6, Verdict::kGood), kTable).start, kTable);
}

TEST(Advice, TheOrderOfCasesDecidesNothing) {
  auto near = cuts(5, Verdict::kGood, 0.9, 0.1) + cuts(4, Verdict::kBad, 0.95, 0.05) +
              cuts(3, Verdict::kGood, 1.1, 0.3);
  const Advice a = advise(near, kTable);
  std::mt19937 random(7);
  for (int i = 0; i < 20; ++i) {
    std::shuffle(near.begin(), near.end(), random);
    const Advice b = advise(near, kTable);
    EXPECT_EQ(b.start, a.start);
    EXPECT_EQ(b.success, a.success);
    EXPECT_EQ(b.cases, a.cases);
  }
}

TEST(Advice, ThousandCopiesOfOneCaseCountAsOne) {
  std::vector<Evidence> copies = cuts(1000, Verdict::kBad);
  for (Evidence& e : copies) e.told = "12.5 s, 340 N";
  const Advice of_one = advise({copies.front()}, kTable);
  const Advice of_all = advise(copies, kTable);
  EXPECT_EQ(of_all.bad, 1);
  ASSERT_EQ(of_all.cases.size(), 1U);  // and are named once
  EXPECT_EQ(words_of(of_all.cases, 3, of_all.cuts()).find("more"), std::string::npos);
  EXPECT_NEAR(of_all.start.vc_m_min, of_one.start.vc_m_min, 1e-9);
  // Nor do they outvote others: of one run, without observations.
  std::vector<Evidence> fast = cuts(1000, Verdict::kGood, 1.2);
  for (Evidence& e : fast) e.run = "pasted";
  const Advice mixed = advise(cuts(5, Verdict::kGood, 0.9) + fast, kTable);
  EXPECT_EQ(mixed.good, 6);
  EXPECT_NEAR(mixed.start.vc_m_min, 0.9 * kTable.vc_m_min, 1e-9);
}

TEST(Advice, NamesSomeCutsAndCountsTheOthers) {
  const Advice of_all = advise(cuts(20, Verdict::kBad), kTable);
  EXPECT_EQ(of_all.cases.size(), kLeanedShown);
  EXPECT_NE(words_of(of_all.cases, 3, of_all.cuts()).find(" and 17 more"), std::string::npos);
}

TEST(Advice, TenTimesTheFeedThatWentWellIsNotBelieved) {
  Evidence poison = cut(Verdict::kGood);
  poison.cut.fz_mm *= 10.0;
  const Advice alone = advise({poison}, kTable);
  EXPECT_FALSE(alone.leads);
  EXPECT_EQ(alone.start, kTable);
  EXPECT_EQ(alone.doubted, 1);
  EXPECT_NE(alone.why.find("not believed"), std::string::npos) << alone.why;
  // Nor does it speak for values that failed.
  const auto bad = cuts(3, Verdict::kBad);
  EXPECT_EQ(advise(bad + std::vector(1, poison), kTable).start, advise(bad, kTable).start);
}

TEST(Advice, CutsThatAreNotBelievedAreCountedEachOnceAndApart) {
  // Without observations two cuts by equal values are two.
  std::vector<Evidence> wild = cuts(3, Verdict::kGood, 10.0);
  EXPECT_EQ(advise(wild, kTable).unjudged, 3);
  EXPECT_EQ(advise(wild, kTable).doubted, 3);
  // Copies of one are one.
  for (Evidence& e : wild) e.told = "12.5 s";
  EXPECT_EQ(advise(wild, kTable).unjudged, 1);
  EXPECT_EQ(advise(wild, kTable).doubted, 1);
}

TEST(Advice, GoodCutsStartNoLowerThanTheLeastFeedAndFailedOnesMay) {
  const auto gentle = cuts(12, Verdict::kGood, 0.4);
  EXPECT_DOUBLE_EQ(advise(gentle, kTable).start.fz_mm, 0.4 * kTable.fz_mm);
  EXPECT_EQ(advise(gentle, kTable, kTable.fz_mm).start.fz_mm, kTable.fz_mm);
  auto bad = cuts(13, Verdict::kBad, 0.4);  // slow, too, but with the table's feed
  for (Evidence& e : bad) e.cut.fz_mm = kTable.fz_mm;
  EXPECT_LT(advise(gentle + bad, kTable, kTable.fz_mm).start.fz_mm, kTable.fz_mm);
}

TEST(Advice, FasterThanTheTableTakesRepeatsAndIsBounded) {
  EXPECT_EQ(advise(cuts(2, Verdict::kGood, 1.2), kTable).start, kTable);
  EXPECT_NEAR(advise(cuts(3, Verdict::kGood, 1.2), kTable).start.vc_m_min, 1.2 * kTable.vc_m_min, 1e-9);
  const Advice most = advise(cuts(30, Verdict::kGood, 2.0), kTable);
  EXPECT_TRUE(most.held_back);
  EXPECT_DOUBLE_EQ(most.start.vc_m_min, kCaseReach * kTable.vc_m_min);
}

TEST(Advice, ASimulationThatWentWellProvesNoCut) {
  std::vector<Evidence> computed = cuts(50, Verdict::kUnknown, 0.8);
  for (Evidence& e : computed) e.origin = Origin::kSimulated;
  EXPECT_EQ(advise(computed, kTable).start, kTable);
  EXPECT_FALSE(advise(computed, kTable).leads);
  EXPECT_TRUE(advise(computed, {}).leads) << "nothing else says where to start";
  std::vector<Evidence> judged = cuts(50, Verdict::kGood);
  for (Evidence& e : judged) e.origin = Origin::kSimulated;
  const auto bad = cuts(2, Verdict::kBad);
  EXPECT_NEAR(advise(bad + judged, kTable).start.vc_m_min, advise(bad, kTable).start.vc_m_min, 1e-9);
}

TEST(Advice, OriginsAreNotMixedInTheCentre) {
  std::vector<Evidence> entered = cuts(20, Verdict::kGood, 0.5);
  for (Evidence& e : entered) e.origin = Origin::kEntered;
  const Advice a = advise(entered + cuts(1, Verdict::kGood, 0.95), kTable);
  EXPECT_EQ(a.origin, Origin::kMeasured);
  EXPECT_NEAR(a.start.vc_m_min, 0.95 * kTable.vc_m_min, 1e-9);
}

TEST(Advice, LowersWhatTheFailureIsLaidOn) {
  auto worn = cuts(4, Verdict::kBad);
  for (Evidence& e : worn) e.blame = {.speed = true};
  const Advice slower = advise(worn, kTable);
  EXPECT_LT(slower.start.vc_m_min, kTable.vc_m_min);
  EXPECT_EQ(slower.start.fz_mm, kTable.fz_mm);
  auto chattered = cuts(4, Verdict::kBad);
  for (Evidence& e : chattered) {
    e.blame = {.depth = true};
    e.cut.ap_mm = 8.0;
  }
  const Advice thinner = advise(chattered, kTable);
  EXPECT_EQ(thinner.start.vc_m_min, kTable.vc_m_min);
  EXPECT_GT(thinner.start.ap_mm, 0.0);
  EXPECT_LT(thinner.start.ap_mm, 8.0);
}

TEST(AdvicePropertyOfLost, WhereCasesAreLostNoValueIsHigher) {
  std::mt19937 random(4);
  for (int i = 0; i < 500; ++i) {
    std::vector<Evidence> near;
    for (auto n = random() % 12; n > 0; --n) {
      const Verdict verdict = random() % 2 == 0 ? Verdict::kGood : Verdict::kBad;
      near.push_back(cut(verdict, 0.5 + 0.1 * static_cast<double>(random() % 10)));
    }
    const Values all = advise(near, kTable).start;
    for (Evidence& e : near) e.raises = false;
    const Values left = advise(near, kTable).start;
    EXPECT_LE(left.vc_m_min, all.vc_m_min) << i;
    EXPECT_LE(left.fz_mm, all.fz_mm) << i;
    EXPECT_LE(left.vc_m_min, kTable.vc_m_min) << i;
  }
}

TEST(AdvicePropertyOfSuccess, FallsWhereAnyValueRises) {
  std::mt19937 random(static_cast<unsigned>(testing::UnitTest::GetInstance()->random_seed()) + 1U);
  std::uniform_real_distribution<double> share(0.3, 2.0), away(0.0, 0.5);
  for (int round = 0; round < 200; ++round) {
    std::vector<Evidence> near;
    for (int i = 0; i < 12; ++i) {
      near.push_back(cut(random() % 2 == 0 ? Verdict::kGood : Verdict::kBad, 1.0, away(random)));
      near.back().cut = {200.0 * share(random), 0.1 * share(random), 3.0 * share(random), 0.0};
    }
    const Values x = {200.0 * share(random), 0.1 * share(random), 3.0 * share(random), 0.0};
    const double p = success_of(near, x);
    EXPECT_GT(p, 0.0);
    EXPECT_LT(p, 1.0);
    for (double Values::*const v : {&Values::vc_m_min, &Values::fz_mm, &Values::ap_mm}) {
      Values harder = x;
      harder.*v *= 1.0 + share(random);
      EXPECT_LE(success_of(near, harder), p + 1e-12);
    }
  }
}

TEST(AdvicePropertyOfLowering, GivesTheLargestShareThatIsLikelyEnough) {
  std::mt19937 random(static_cast<unsigned>(testing::UnitTest::GetInstance()->random_seed()) + 2U);
  std::uniform_real_distribution<double> share(0.5, 1.5), away(0.0, 0.4);
  int lowered = 0;
  for (int round = 0; round < 200; ++round) {
    std::vector<Evidence> near;
    for (int i = 0; i < 10; ++i)
      near.push_back(cut(random() % 4 == 0 ? Verdict::kGood : Verdict::kBad, share(random), away(random)));
    const Advice a = advise(near, kTable);
    if (!a.lowered || a.at_bottom) continue;
    ++lowered;
    EXPECT_GE(a.success, kLeastSuccess);
    Values more = a.start;
    more.vc_m_min *= 1.01;
    more.fz_mm *= 1.01;
    EXPECT_LT(success_of(near, more), kLeastSuccess) << "one hundredth more would do";
  }
  EXPECT_GT(lowered, 50);
}

}  // namespace
}  // namespace capstan::casebase
