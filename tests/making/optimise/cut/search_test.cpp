#include "planner/making/optimise/cut/search.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/making/optimise/cut/questions.h"

// What a search leaves out before any solver runs.

namespace capstan::optimise {
namespace {

constexpr double kLevelMm = 2.0;

/// A slot of the mill's width in titanium, whose bending is limited: two variables, speed and feed. The lowest
/// feed makes no chip.
CutQuestion slot(double deflection_limit_mm) {
  CutQuestion q = questions::roughing();
  q.slot = true;
  q.material.iso_group = "S";
  q.least_feed_ratio = 0.01;
  q.deflection_limit_mm = deflection_limit_mm;
  return q;
}

Measures measured(const CutQuestion& q, const CutPoint& p) {
  const auto loads = loads_of(q, p.ap_mm, p.ae_mm, p.n_rpm, p.feed_mm_min);
  EXPECT_TRUE(loads);
  return measures(q, *loads, p.ap_mm, p.n_rpm, p.feed_mm_min);
}

double bending_mm(const CutQuestion& q, const CutPoint& p) {
  return measured(q, p)[model::Limit::kToolDeflection].value;
}

/// Whether any of the points on a grid over a piece keeps all limits that vary.
bool any_kept(const CutQuestion& q, const Search& search, const std::vector<Variable>& piece) {
  constexpr int kSteps = 9;
  std::vector<int> at(piece.size(), 0);
  for (;;) {
    std::vector<double> x;
    for (std::size_t j = 0; j < piece.size(); ++j)
      x.push_back(piece[j].lower + (piece[j].upper - piece[j].lower) * at[j] / kSteps);
    const Measures m = measured(q, search.at(x));
    const bool kept = std::all_of(model::kLimitRows.begin(), model::kLimitRows.end(), [&](const auto& r) {
      return !r.varies || !m[r.value].stated() || m[r.value].excess() <= 1e-6;
    });
    if (kept) return true;
    std::size_t j = 0;
    while (j < piece.size() && ++at[j] > kSteps) at[j++] = 0;
    if (j == piece.size()) return false;
  }
}

TEST(CutSearch, APieceIsHopelessWhereTheThinnestChipBendsTheMillTooFar) {
  const CutQuestion wide = slot(1.0);
  const double chip_mm = least_chip_mm(wide);
  const Search search(wide, kLevelMm);
  const auto pieces = search.pieces();
  CutPoint thin = search.gentlest(pieces.front()).front();
  // In a slot the chip is the feed per tooth.
  const double per_tooth = thin.n_rpm * wide.cutter.teeth;
  thin.feed_mm_min = chip_mm * per_tooth;
  const double bends_mm = bending_mm(wide, thin);
  CutPoint lowest = thin;
  lowest.feed_mm_min = pieces.front().back().lower * per_tooth;
  ASSERT_LT(lowest.feed_mm_min, thin.feed_mm_min);
  ASSERT_LT(bending_mm(wide, lowest), 0.9 * bends_mm);

  const CutQuestion stiff = slot(1.02 * bends_mm), soft = slot(0.98 * bends_mm);
  for (const auto& piece : pieces) {
    EXPECT_FALSE(Search(stiff, kLevelMm).hopeless(piece));
    EXPECT_TRUE(Search(soft, kLevelMm).hopeless(piece));
  }
}

TEST(CutSearch, ACutOfWhichNoFeedKeepsChipAndBendingIsAnsweredWithoutASolver) {
  const CutQuestion q = slot(1.0);
  const Search search(q, kLevelMm);
  const auto gentlest = search.gentlest(search.pieces().front());
  CutQuestion soft = slot(0.98 * bending_mm(q, gentlest.front()));
  soft.ap_mm = kLevelMm;
  Job job;
  Options none;  // brings no solver: any search would be refused
  none.fall_back = false;
  const auto answer = cut(soft, none, job);
  ASSERT_TRUE(answer) << answer.error().message;
  EXPECT_FALSE(answer->feasible);
  EXPECT_EQ(answer->method, "least");
  EXPECT_FALSE(answer->violated.empty());
}

TEST(CutSearch, NoPointOfAHopelessPieceKeepsItsLimits) {
  int hopeless = 0, others = 0;
  for (const bool is_slot : {true, false}) {
    for (double limit_mm = 0.0005; limit_mm < 0.2; limit_mm *= 1.5) {
      for (const double fz_mm : {0.01, 0.03, 0.06}) {
        CutQuestion q = slot(limit_mm);
        q.slot = is_slot;
        q.fz_start_mm = fz_mm;
        const Search search(q, kLevelMm);
        for (const auto& piece : search.pieces()) {
          const bool none = search.hopeless(piece);
          ++(none ? hopeless : others);
          EXPECT_FALSE(none && any_kept(q, search, piece)) << limit_mm << " " << fz_mm;
        }
      }
    }
  }
  EXPECT_GT(hopeless, 10);
  EXPECT_GT(others, 10);
}

}  // namespace
}  // namespace capstan::optimise
