#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "rules/facts/it_grade.h"
#include "rules/rules.h"
#include "tests/rules/shop.h"

// Holes whose sizes, bottoms and neighbours ask for more than a drill and a reamer.

namespace capstan::rules {
namespace {

using drawn::hole;
using drawn::toleranced;
using model::FeatureShape;
using model::HoleBottom;
using model::Proposal;
using model::ShapeKind;
using model::TypeId;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

/// 0.5 mm at 45 degrees around a hole.
FeatureShape edge(double d) {
  FeatureShape s = hole(d, 0.5, HoleBottom::kFlat);
  s.bottom_diameter_mm = d - 1.0;
  return s;
}
std::vector<std::vector<TypeId>> all(const Proposal& p) {
  std::vector<std::vector<TypeId>> out;
  for (const auto& chain : p.chains) out.push_back(kinds(chain));
  return out;
}

TEST(Countersink, WithATolerancedDiameterIsMilledAndFromIt8MeasuredBetweenTwoCuts) {
  // 26 +0.1: IT10 is 0.084 and IT11 0.13 (ISO 286-1, 18 to 30 mm).
  const Proposal it10 = propose(shipped(), toleranced(edge(26), 0.0, 0.1), iron(25));
  ASSERT_FALSE(it10.chains.empty()) << it10.cannot;
  EXPECT_EQ(it10.chains[0].front().why.id, "hole.countersink.milled");
  EXPECT_THAT(kinds(it10.chains[0]), ElementsAre(TypeId::kSideFinishMilling));
  // 26 +0.025: IT7 is 0.021; 11 +0.015: IT6 is 0.011.
  for (const auto& [d, upper] : {std::pair(26.0, 0.025), std::pair(11.0, 0.015)}) {
    const Proposal fine = propose(shipped(), toleranced(edge(d), 0.0, upper), iron(d - 1.0));
    ASSERT_FALSE(fine.chains.empty()) << fine.cannot;
    EXPECT_THAT(kinds(fine.chains[0]), ElementsAre(TypeId::kSideFinishMilling, TypeId::kWorkpieceProbing,
                                                   TypeId::kSideFinishMilling));
    EXPECT_GT(fine.chains[0][0].allowance_side_mm, 0.0);
    EXPECT_EQ(fine.chains[0][2].allowance_side_mm, 0.0);
  }
  // 26 +0.009: IT5, which is ground.
  EXPECT_THAT(propose(shipped(), toleranced(edge(26), 0.0, 0.009), iron(25)).cannot, HasSubstr("grinding"));
}

TEST(Countersink, WiderThanItsHoleAllRoundLeavesTheShoulderThatTheFeatureHas) {
  // The foot is 10 wide, the hole below 8.3: between them a ring stays that a countersink would cut away.
  const Proposal p = propose(shipped(), edge(11), iron(8.3));
  ASSERT_FALSE(p.chains.empty()) << p.cannot;
  EXPECT_THAT(kinds(p.chains[0]),
              ElementsAre(TypeId::kBottomAndSideRoughMilling, TypeId::kSideFinishMilling));
  EXPECT_THAT(all(propose(shipped(), edge(11), iron(10))), Contains(ElementsAre(TypeId::kCounterSinking)));
}

TEST(Hole, OfIt6IsBoredInTwoCutsAndMeasuredBetweenThem) {
  // 20 +0.013 is IT6, 20 +0.009 IT5.
  const Proposal p = propose(shipped(), toleranced(hole(20, 30), 0.0, 0.013), iron());
  ASSERT_FALSE(p.chains.empty()) << p.cannot;
  const auto& chain = p.chains[0];
  EXPECT_THAT(kinds(chain), ElementsAre(TypeId::kCenterDrilling, TypeId::kDrilling, TypeId::kBoring,
                                        TypeId::kWorkpieceProbing, TypeId::kBoring));
  EXPECT_NEAR(chain[2].tool.diameter_exact_mm, 20.0065 - 0.1, 1e-9);
  EXPECT_NEAR(chain[4].tool.diameter_exact_mm, 20.0065, 1e-9);
  EXPECT_NEAR(chain[4].start_diameter_mm, 20.0065 - 0.1, 1e-9)
      << "what is measured is what the first cut left";
  EXPECT_THAT(chain[4].why.text, HasSubstr("finer than IT6 takes honing or grinding"));
  EXPECT_THAT(propose(shipped(), toleranced(hole(20, 30), 0.0, 0.009), iron()).cannot,
              HasSubstr("honing or grinding"));
}

TEST(Walls, OfIt6AreMilledAndMeasuredBeforeTheLastPass) {
  FeatureShape s;
  s.name = "P";
  s.depth_mm = 10.0;
  s.corner_radius_mm = 6.0;
  s.area = s.reach = geometry::rounded_rectangle({-40, -20}, {40, 20}, 6.0);
  s.width = {.nominal_mm = 40.0, .lower_mm = 0.0, .upper_mm = 0.016, .given = true};  // IT6 of 30 to 50 mm
  for (const ShapeKind kind : {ShapeKind::kPocket, ShapeKind::kStep}) {
    s.kind = kind;
    s.open = kind == ShapeKind::kStep;
    const Proposal p = propose(shipped(), s, iron());
    ASSERT_FALSE(p.chains.empty()) << p.cannot;
    const auto& chain = p.chains[0];
    EXPECT_EQ(chain[chain.size() - 2].operation, TypeId::kWorkpieceProbing);
    EXPECT_GT(chain[chain.size() - 3].allowance_side_mm, 0.0);
    EXPECT_EQ(chain.back().allowance_side_mm, 0.0);
    EXPECT_THAT(chain.back().why.text, HasSubstr("grinding")) << "and says what a finer size takes";
  }
}

TEST(Step, WithADepthOfIt6LeavesItsFloorForAPassThatIsSetByWhatWasMeasured) {
  FeatureShape s;
  s.kind = ShapeKind::kStep;
  s.name = "S";
  s.open = true;
  s.depth_mm = 20.0;
  s.depth_tolerance = {.nominal_mm = 20.0, .lower_mm = 0.0, .upper_mm = 0.013, .given = true};  // IT6
  s.area = s.reach = geometry::rectangle({0, 0}, {30, 100});
  const Proposal p = propose(shipped(), s, iron());
  ASSERT_FALSE(p.chains.empty()) << p.cannot;
  const auto& chain = p.chains[0];
  EXPECT_GT(chain[chain.size() - 3].allowance_bottom_mm, 0.0);
  EXPECT_EQ(chain[chain.size() - 2].operation, TypeId::kWorkpieceProbing);
}

TEST(Hole, BetweenTheSizesOfDrillsIsDrilledNarrowerThenMilledOrBored) {
  // 8.3 with 0.09 (IT11 of 6 to 10 mm): where there is no 8.3, the next smaller drill opens it.
  const auto chains = all(propose(shipped(), toleranced(hole(8.3, 20), 0.0, 0.09), iron()));
  EXPECT_THAT(chains, Contains(ElementsAre(TypeId::kCenterDrilling, TypeId::kDrilling,
                                           TypeId::kBottomAndSideFinishMilling)));
  EXPECT_THAT(chains, Contains(ElementsAre(TypeId::kCenterDrilling, TypeId::kDrilling, TypeId::kBoring)));
}

TEST(Hole, ThatASpindleCannotDrillAtOnceIsDrilledInStepsOfGrowingDiameter) {
  const Proposal p = propose(shipped(), toleranced(hole(24, 20), 0.0, 0.2), iron());
  bool stepped = false;
  for (const auto& chain : p.chains) {
    if (kinds(chain) !=
        std::vector<TypeId>{TypeId::kCenterDrilling, TypeId::kDrilling, TypeId::kDrilling, TypeId::kDrilling})
      continue;
    stepped = true;
    EXPECT_LT(chain[1].tool.diameter_max_mm, chain[2].tool.diameter_max_mm);
    EXPECT_LT(chain[2].tool.diameter_max_mm, 24.0);
    EXPECT_GT(chain[3].start_diameter_mm, 0.0) << "its torque is that of the ring that is left";
  }
  EXPECT_TRUE(stepped);
}

TEST(MadeWithin, NamesTheHoleThatTakesAnotherAwayWhateverTheirOrder) {
  // A thread's length of the same diameter as its core hole, listed before or after it.
  const FeatureShape core = toleranced(hole(8.3, 25, HoleBottom::kConical), 0.0, 0.025);
  const FeatureShape length = toleranced(hole(8.3, 15.5, HoleBottom::kFlat), 0.0, 0.025);
  EXPECT_THAT(made_within(std::vector{core, length}), ElementsAre(0, 0));
  EXPECT_THAT(made_within(std::vector{length, core}), ElementsAre(1, 1));
  // What asks more of its size has still to be made.
  const FeatureShape seat = toleranced(hole(8.3, 15.5, HoleBottom::kFlat), 0.0, 0.009);
  EXPECT_THAT(made_within(std::vector{core, seat}), ElementsAre(0, 1));
  // Beside it, or deeper: no.
  FeatureShape beside = length;
  beside.frame.origin.x = 20.0;
  EXPECT_THAT(made_within(std::vector{core, beside}), ElementsAre(0, 1));
  EXPECT_THAT(made_within(std::vector{hole(8.3, 10, HoleBottom::kFlat),
                                      toleranced(hole(8.3, 15.5, HoleBottom::kFlat), 0, 0.1)}),
              ElementsAre(1, 1));
  EXPECT_THAT(made_within(std::vector{core, toleranced(hole(8.3, 30), 0.0, 0.1)}), ElementsAre(0, 1));
}

TEST(Members, AreProposedTheSameWhateverOrderTheCompoundListsThemIn) {
  const FeatureShape wide = toleranced(hole(25, 15, HoleBottom::kFlat), 0.0, 0.025);
  const FeatureShape narrow = toleranced(hole(15, 40), 0.0, 0.025);
  const FeatureShape cone = toleranced(edge(26), 0.0, 0.025);
  const auto row = [](const Proposal& p) { return p.chains.empty() ? p.cannot : p.chains[0].front().why.id; };
  const std::vector<FeatureShape> down{cone, wide, narrow}, up{narrow, wide, cone};
  const auto a = propose_members(shipped(), from_the_top(down), iron());
  const auto b = propose_members(shipped(), from_the_top(up), iron());
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(row(a[i]), row(b[2 - i]));
  EXPECT_EQ(row(a[0]), "hole.countersink.measured");
  EXPECT_EQ(row(a[1]), "hole.shoulder.it7");
  EXPECT_EQ(row(a[2]), "hole.ream.it7");
}

}  // namespace
}  // namespace capstan::rules
