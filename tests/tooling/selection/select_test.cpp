#include "tooling/selection/select.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>

#include "planner/model/plan/preset_feeds.h"
#include "tests/tooling/selection/shipped.h"
#include "tooling/library/cutters/complete.h"

namespace capstan::tooling {
namespace {

using model::Cutter;
using model::CutterClass;
using model::ToolRequirement;

model::Selection choose(const ToolRequirement& r, const Preferences& p = {}) {
  return select(r, library(), material("mild_steel"), machine(), p);
}

TEST(Select, TakesTheDrillOfTheSizeWanted) {
  ToolRequirement r;
  r.classes = {CutterClass::kTwistDrill};
  r.diameter_exact_mm = 6.8;
  r.reach_mm = 20;
  const auto s = choose(r);
  ASSERT_FALSE(s.ranked.empty());
  for (const auto& k : s.ranked) EXPECT_DOUBLE_EQ(k.cutter.cutting_diameter_mm, 6.8);
  EXPECT_GT(s.ranked[0].vc_m_min, 0.0);
  EXPECT_FALSE(s.ranked[0].why.source.empty());
  EXPECT_TRUE(s.would_fit.empty());
}

TEST(Select, ComesToAToolWithoutALengthLast) {
  // Two drills alike; the table of the first by name has a Z of 0.
  ToolRequirement r;
  r.classes = {CutterClass::kTwistDrill};
  r.diameter_exact_mm = 6.8;
  r.reach_mm = 20;
  Cutter measured = choose(r).ranked.at(0).cutter, unmeasured = measured;
  unmeasured.id = "a";
  measured.id = "b";
  model::ToolTableLine line;
  line.words = {{"Z", 0.0}};
  unmeasured.table_line = line;
  const auto s = select(r, {unmeasured, measured}, material("mild_steel"), machine(), {});
  ASSERT_EQ(s.ranked.size(), 2U);
  EXPECT_EQ(s.ranked[0].cutter.id, "b");
}

TEST(Select, TakesNoLargerCountersinkThanTheConeNeeds) {
  // 13 mm over a hole of 6.6 mm: 16.5 and 20.5 mm are fed alike, wider ones more slowly, for their feed ends
  // at 0.1 mm.
  ToolRequirement r;
  r.classes = {CutterClass::kCountersink, CutterClass::kChamferMill};
  r.point_angle_rad = 0.5 * std::numbers::pi;
  r.diameter_min_mm = 13.0;
  r.tip_diameter_max_mm = 6.6;
  r.depth_of_cut_mm = 3.2;
  r.reach_mm = 8.5;
  const auto s = select(r, library(), material("wrought_aluminium"), machine(), {});
  ASSERT_GT(s.ranked.size(), 1U);
  EXPECT_EQ(s.ranked[0].cutter.id, "generic/countersink_90/16.5");
}

TEST(Select, TakesTheLargestEndMillThatTheCornersAllow) {
  ToolRequirement r;
  r.classes = {CutterClass::kEndmill};
  r.diameter_max_mm = 11.9;
  r.depth_of_cut_mm = 5;
  r.reach_mm = 15;
  r.centre_cutting = true;
  const auto s = choose(r);
  ASSERT_FALSE(s.ranked.empty());
  EXPECT_DOUBLE_EQ(s.ranked[0].cutter.cutting_diameter_mm, 10.0);
  EXPECT_EQ(s.ranked[0].cutter.teeth, 4);  // steel
}

TEST(Select, PrefersFewerTeethInAluminium) {
  ToolRequirement r;
  r.classes = {CutterClass::kEndmill};
  r.diameter_max_mm = r.diameter_min_mm = 10;
  const auto s = select(r, library(), material("wrought_aluminium"), machine());
  ASSERT_FALSE(s.ranked.empty());
  EXPECT_LE(s.ranked[0].cutter.teeth, 3);
}

TEST(Select, RefusesEveryToolThatIsTooShortAndSaysWhatWouldFit) {
  ToolRequirement r;
  r.classes = {CutterClass::kEndmill};
  r.diameter_exact_mm = 6;
  r.reach_mm = 80;
  Preferences all;
  all.most_rejected = library().size();
  const auto s = choose(r, all);
  EXPECT_TRUE(s.ranked.empty());
  EXPECT_EQ(s.would_fit, "a 6 mm end mill with 80 mm reach");
  const auto it = std::find_if(s.rejected.begin(), s.rejected.end(),
                               [](const auto& x) { return x.what == "generic/endmill_4f_short/6"; });
  ASSERT_NE(it, s.rejected.end());
  // DIN 6527 L: 57 long, 36 held, 2 clear of the chuck; the nut's front is 0.8 x 32.
  EXPECT_EQ(it->why, "reach 19 mm is below 80 mm, and its holder (32 mm) would meet the walls");
}

TEST(Select, NamesTheNearestSizesWhenThereIsNoneOfTheSizeWanted) {
  ToolRequirement r;
  r.classes = {CutterClass::kReamer};
  r.diameter_exact_mm = 17;
  const auto s = choose(r);
  EXPECT_TRUE(s.ranked.empty());
  ASSERT_EQ(s.rejected.size(), 1u);
  EXPECT_NE(s.rejected[0].why.find("16 mm and 18 mm"), std::string::npos) << s.rejected[0].why;
}

TEST(Select, HoldsEveryHardLimitForAnyRequirement) {
  std::mt19937 rng(20240229);
  std::uniform_real_distribution<double> size(1.0, 40.0), reach(0.0, 60.0), unit(0.0, 1.0);
  int found = 0;
  for (int i = 0; i < 300; ++i) {
    ToolRequirement r;
    r.classes = {unit(rng) < 0.5 ? CutterClass::kEndmill : CutterClass::kBullnoseEndmill,
                 CutterClass::kBallEndmill};
    r.diameter_max_mm = size(rng);
    r.reach_mm = reach(rng);
    r.depth_of_cut_mm = 0.5 * reach(rng);
    r.corner_radius_limited = unit(rng) < 0.5;
    r.corner_radius_max_mm = unit(rng) * 3.0;
    r.centre_cutting = unit(rng) < 0.5;
    const auto s = choose(r);
    EXPECT_EQ(s.ranked.empty(), !s.would_fit.empty());
    double last = -1e9;
    for (const auto& k : s.ranked) {
      const Cutter& c = k.cutter;
      EXPECT_LE(c.cutting_diameter_mm, r.diameter_max_mm + 1e-6);
      EXPECT_GE(c.usable_length_mm, r.reach_mm - 1e-6);
      EXPECT_GE(c.maximum_depth_of_cut_mm, r.depth_of_cut_mm - 1e-6);
      if (r.corner_radius_limited) {
        EXPECT_LE(c.corner_radius_mm, r.corner_radius_max_mm + 1e-6);
      }
      if (r.centre_cutting) {
        EXPECT_TRUE(c.centre_cutting || c.maximum_ramp_angle_rad > 0.0);
      }
      EXPECT_GE(k.score, last);
      last = k.score;
      ++found;
    }
  }
  EXPECT_GT(found, 300);
}

TEST(Select, DoesNotDependOnTheOrderOfTheLibrary) {
  ToolRequirement r;
  r.classes = {CutterClass::kEndmill};
  r.diameter_max_mm = 16;
  auto shuffled = library();
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(7));
  const auto a = choose(r), b = select(r, shuffled, material("mild_steel"), machine());
  ASSERT_EQ(a.ranked.size(), b.ranked.size());
  for (std::size_t i = 0; i < a.ranked.size(); ++i) EXPECT_EQ(a.ranked[i].cutter.id, b.ranked[i].cutter.id);
  EXPECT_EQ(a.rejected, b.rejected);
}

TEST(Select, PrefersWhatIsLoadedThenWhatIsInUse) {
  ToolRequirement r;
  r.classes = {CutterClass::kEndmill};
  r.diameter_max_mm = 16;
  r.diameter_min_mm = 12;
  Preferences p;
  p.used = {"generic/endmill_4f_short/14"};
  EXPECT_EQ(choose(r, p).ranked[0].cutter.id, "generic/endmill_4f_short/14");
  auto loaded = library();
  for (Cutter& c : loaded)
    if (c.id == "generic/endmill_4f_short/12") {
      c.pocket = 5;
      c.loaded = true;
    }
  const auto s = select(r, loaded, material("mild_steel"), machine(), p);
  EXPECT_EQ(s.ranked[0].cutter.id, "generic/endmill_4f_short/12");
  EXPECT_NE(s.ranked[0].why.text.find("loaded as T5"), std::string::npos);
}

TEST(Select, SetsABoringToolToTheBore) {
  ToolRequirement r;
  r.classes = {CutterClass::kBoringTool};
  r.diameter_exact_mm = 20.0105;  // the middle of 20 H7
  r.reach_mm = 30;
  const auto s = choose(r);
  ASSERT_EQ(s.ranked.size(), 1u);
  EXPECT_DOUBLE_EQ(s.ranked[0].cutter.cutting_diameter_mm, 20.0105);
}

TEST(Select, RefusesAToolThatTheSpindleCannotTurnSlowlyEnoughFor) {
  ToolRequirement r;
  r.classes = {CutterClass::kTwistDrill};
  r.diameter_exact_mm = 12;
  // 6000 1/min at 12 mm is 226.2 m/min; HSS in mild steel bears 20.
  const auto s = select(r, library(), material("mild_steel"), machine("small_router"));
  EXPECT_TRUE(s.ranked.empty());
  ASSERT_FALSE(s.rejected.empty());
  EXPECT_NE(s.rejected[0].why.find("6000 1/min gives 226.2 m/min"), std::string::npos) << s.rejected[0].why;
}

TEST(Select, RefusesWhatTheMagazineCannotHold) {
  ToolRequirement r;
  r.classes = {CutterClass::kFacemill};
  r.diameter_min_mm = 80;
  const auto s = select(r, library(), material("mild_steel"), machine("tormach_1100mx"));
  EXPECT_TRUE(s.ranked.empty());
  EXPECT_NE(s.rejected[0].why.find("the magazine's 75 mm"), std::string::npos) << s.rejected[0].why;
}

Cutter endmill(const std::string& id, double d) {
  Cutter c;
  c.id = id;
  c.cutting_diameter_mm = c.shank_diameter_mm = d;
  c.teeth = 4;
  c.centre_cutting = true;
  c.maximum_depth_of_cut_mm = 20;
  c.usable_length_mm = 28;
  c.stick_out_mm = 30;
  c.functional_length_mm = 100;
  c.fz_min_mm = 0.01;
  c.fz_max_mm = 0.1;
  c.presets = {{"P", 70.0, 0.05, "test"}};
  return c;
}
model::Selection choose_of(const ToolRequirement& r, const std::vector<Cutter>& tools,
                           const Preferences& p = {}) {
  return select(r, tools, material("mild_steel"), machine(), p);
}
std::string why_not(const ToolRequirement& r, const Cutter& c, const model::Machine& m = machine(),
                    const Preferences& p = {}) {
  const auto s = select(r, {c}, material("mild_steel"), m, p);
  return s.ranked.empty() && !s.rejected.empty() ? s.rejected[0].why : "";
}

TEST(Select, ReachesPastTheUsableLengthOnlyWhereTheHolderClearsTheWalls) {
  ToolRequirement r;
  r.classes = {CutterClass::kEndmill};
  r.diameter_max_mm = 20;
  r.reach_mm = 45;
  Cutter c = endmill("a", 20);
  c.holder = {{40, 16, 18}, {30, 40, 40}};
  EXPECT_DOUBLE_EQ(reach_of(c), 70.0);  // 30 out of a slim extension of 40
  EXPECT_EQ(choose_of(r, {c}).ranked.size(), 1u);
  c.holder = {{40, 16, 22}, {30, 40, 40}};
  EXPECT_DOUBLE_EQ(reach_of(c), 28.0);
  EXPECT_NE(why_not(r, c).find("holder (22 mm) would meet the walls"), std::string::npos) << why_not(r, c);
  c.holder = {{40, 16, 18}};
  c.shank_diameter_mm = 25;  // a thicker shank is met before
  EXPECT_DOUBLE_EQ(reach_of(c), 28.0);
}

TEST(Select, HoldsFlutesAgainstWallsThatAreCutInOneDepth) {
  ToolRequirement r;
  r.classes = {CutterClass::kEndmill};
  r.diameter_max_mm = 10;
  r.depth_of_cut_mm = 22;
  EXPECT_EQ(why_not(r, endmill("a", 10)), "flutes 20 mm are shorter than 22 mm");
  r.depth_of_cut_mm = 20;
  EXPECT_EQ(why_not(r, endmill("a", 10)), "");
}

TEST(Select, HoldsThreadsBySizeFormAndHand) {
  ToolRequirement r;
  r.classes = {CutterClass::kTap};
  r.diameter_exact_mm = r.thread_size_mm = 8;
  r.thread_pitch_mm = 1.25;
  r.thread_form = "M";
  for (const auto& k : choose(r).ranked) EXPECT_EQ(k.cutter.hand, model::Hand::kRight) << k.cutter.id;
  r.left_hand = true;
  const auto left = choose(r);
  ASSERT_EQ(left.ranked.size(), 1u);
  EXPECT_EQ(left.ranked[0].cutter.id, "generic/tap_left/M8LH");
  r.left_hand = false;
  r.thread_form = "UN";
  const auto none = choose(r);
  EXPECT_TRUE(none.ranked.empty());
  EXPECT_NE(none.would_fit.find("form UN"), std::string::npos) << none.would_fit;
}

TEST(Select, TakesAThreadMillMadeForSmallerThreadsOfThePitchNeverForLargerOnes) {
  ToolRequirement r;
  r.classes = {CutterClass::kThreadMill};
  r.thread_pitch_mm = 2.0;
  r.thread_size_mm = 20.0;
  EXPECT_FALSE(choose(r).ranked.empty());  // made for M16
  r.thread_size_mm = 14.0;
  EXPECT_TRUE(choose(r).ranked.empty());
}

TEST(Select, HoldsTheNeckOfATSlotCutterAndTheWidthOfItsHead) {
  ToolRequirement r;
  r.classes = {CutterClass::kTSlotMill};
  r.diameter_max_mm = 18;
  r.cutting_width_max_mm = 8;
  r.neck_diameter_max_mm = 8;
  const auto s = choose(r);
  ASSERT_FALSE(s.ranked.empty());
  for (const auto& k : s.ranked) {
    EXPECT_LE(k.cutter.neck_diameter_mm, 8.0);
    EXPECT_LE(k.cutter.cutting_width_mm, 8.0);
  }
  r.neck_diameter_max_mm = 3;
  EXPECT_TRUE(choose(r).ranked.empty());
}

TEST(Select, RefusesWhatTheSpindleCannotTurnInItsLeastUsefulCut) {
  ToolRequirement r;
  r.classes = {CutterClass::kTwistDrill};
  r.diameter_exact_mm = 16;
  // At 0.032 mm per tooth kc is some 8500 N/mm2 and the torque kc f D^2 / 8 = 17 Nm.
  auto weak = machine();
  for (auto& p : weak.spindle.curve) p.torque_nm = std::min(p.torque_nm, 5.0);
  const auto s = select(r, library(), material("tool_steel"), weak);
  EXPECT_TRUE(s.ranked.empty());
  ASSERT_FALSE(s.rejected.empty());
  EXPECT_NE(s.rejected[0].why.find("least useful cut takes"), std::string::npos) << s.rejected[0].why;
  EXPECT_FALSE(choose(r).ranked.empty());
  // With most of the hole there, little is left to turn for.
  Preferences p;
  p.pre_hole_mm = 15;
  EXPECT_FALSE(select(r, library(), material("tool_steel"), weak, p).ranked.empty());
}

TEST(Select, NamesTheGearThatWouldTurnSlowlyEnough) {
  ToolRequirement r;
  r.classes = {CutterClass::kReamer};
  r.diameter_exact_mm = 16;
  // 250 1/min at 16 mm is 12.6 m/min; HSS reamers in tool steel bear 7.5.
  const auto s = select(r, library(), material("tool_steel"), machine("tormach_1100mx"));
  ASSERT_FALSE(s.rejected.empty());
  EXPECT_NE(s.rejected[0].why.find("gear 'low' turns 70 to 1500"), std::string::npos) << s.rejected[0].why;
}

TEST(Select, RefusesMoreToolsThanTheMagazineHasPocketsAndTooHeavyOnes) {
  ToolRequirement r;
  r.classes = {CutterClass::kEndmill};
  r.diameter_max_mm = 10;
  auto m = machine();
  m.magazine_pockets = 3;
  Preferences p;
  p.used = {"x", "y", "z", "x"};
  EXPECT_NE(why_not(r, endmill("a", 10), m, p).find("magazine has 3 pockets"), std::string::npos);
  p.used = {"x", "y", "a"};
  EXPECT_EQ(why_not(r, endmill("a", 10), m, p), "");
  m.abilities.magazine_mass_max_kg = 0.5;
  Cutter heavy = endmill("a", 10);
  heavy.holder = {{70, 60, 60}};  // pi/4 60^2 70 mm3 of steel: 1.55 kg
  EXPECT_NE(why_not(r, heavy, m).find("its mass is at least 1.5"), std::string::npos) << why_not(r, heavy, m);
}

TEST(Select, WeighsTheToolsPriceAgainstItsTime) {
  ToolRequirement r;
  r.classes = {CutterClass::kEndmill};
  r.diameter_max_mm = 10;
  Preferences p;
  p.volume_mm3 = 50000;
  Cutter dear = endmill("dear", 10), cheap = endmill("cheap", 10);
  dear.presets[0].vc_m_min = 84;  // a fifth faster
  EXPECT_EQ(choose_of(r, {dear, cheap}, p).ranked[0].cutter.id, "dear");
  dear.life_min = cheap.life_min = 30;
  dear.price = 300;
  cheap.price = 10;
  EXPECT_EQ(choose_of(r, {dear, cheap}, p).ranked[0].cutter.id, "cheap");
}

TEST(Select, CountsTheLifeOfSistersBeforeItAsksForAnotherEdge) {
  ToolRequirement r;
  r.classes = {CutterClass::kEndmill};
  r.diameter_max_mm = 10;
  Preferences p;
  p.volume_mm3 = 200000;
  Cutter worn = endmill("a worn", 10), shared = endmill("b shared", 10);
  worn.life_min = shared.life_min = 60;
  worn.life_used_min = shared.life_used_min = 59.5;
  shared.sisters = {{"b2", 7, 60.0}};
  EXPECT_EQ(choose_of(r, {worn, shared}, p).ranked[0].cutter.id, "b shared");
}

TEST(Select, TakesALoadedToolUnlessLoadingTheFasterOnePays) {
  ToolRequirement r;
  r.classes = {CutterClass::kEndmill};
  r.diameter_max_mm = 16;
  Cutter small = endmill("small", 6), large = endmill("large", 16);
  small.pocket = 4;
  small.loaded = true;
  for (Cutter* c : {&small, &large}) c->presets[0].fz_mm = 0.005 * c->cutting_diameter_mm;
  Preferences p;
  p.volume_mm3 = 500;
  EXPECT_EQ(choose_of(r, {small, large}, p).ranked[0].cutter.id, "small");
  p.volume_mm3 = 500000;
  EXPECT_EQ(choose_of(r, {small, large}, p).ranked[0].cutter.id, "large");
}

TEST(WordsOf, SayWhatIsNeeded) {
  ToolRequirement r;
  r.classes = {CutterClass::kEndmill};
  r.diameter_max_mm = 12;
  r.reach_mm = 22;
  r.centre_cutting = true;
  EXPECT_EQ(words_of(r), "an end mill of at most 12 mm with 22 mm reach, cutting to centre or ramping");
}

TEST(AssignPockets, KeepsGivenNumbersAndFillsTheLowestFree) {
  std::vector<Cutter> cutters(5);
  cutters[1].pocket = 1;
  cutters[3].pocket = 4;
  cutters[4].pocket = 4;  // claimed already
  assign_pockets(cutters);
  std::vector<int> pockets;
  for (const Cutter& c : cutters) pockets.push_back(c.pocket);
  EXPECT_EQ(pockets, (std::vector<int>{2, 1, 3, 4, 5}));
}

TEST(Select, TakesNoHighSpeedSteelWhereTheMaterialHasNoSpeedForIt) {
  ToolRequirement r;
  r.classes = {CutterClass::kTwistDrill};
  r.diameter_exact_mm = 8;
  const auto s = select(r, library(), material("hardened_steel_55"), machine());
  ASSERT_FALSE(s.ranked.empty());
  for (const auto& c : s.ranked) EXPECT_EQ(c.cutter.substrate, model::Substrate::kCarbide) << c.cutter.id;
  r.classes = {CutterClass::kTap};
  r.thread_pitch_mm = 1.25;
  const auto tap = select(r, library(), material("hardened_steel_55"), machine());
  EXPECT_TRUE(tap.ranked.empty());
  ASSERT_FALSE(tap.rejected.empty());
  EXPECT_NE(tap.rejected[0].why.find("hardened_steel_55 is not cut with hss: its card has no speed for it"),
            std::string::npos)
      << tap.rejected[0].why;
}

}  // namespace
}  // namespace capstan::tooling
