#include "planner/model/plan/cutter/ramp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace capstan::model {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kRounding = 1e-12;

Cutter mill(double most_deg) {
  Cutter c;
  c.cutting_diameter_mm = 10.0;
  c.centre_cutting = true;
  c.maximum_ramp_angle_rad = most_deg * kDegree;
  c.sources = {{"maximum_ramp_angle_rad", "default: generic series, unsourced"}};
  return c;
}

WorkMaterial of(const std::string& iso_group) {
  WorkMaterial m;
  m.iso_group = iso_group;
  return m;
}

double degrees(const Cutter& c, const std::string& iso_group) {
  return ramp_of(c, of(iso_group)).angle_rad / kDegree;
}

TEST(Ramp, IsThatOfTheTableByMaterialAndSubstrate) {
  Cutter c = mill(45.0);
  EXPECT_NEAR(degrees(c, "N"), 10.0, kRounding);
  EXPECT_NEAR(degrees(c, "P"), 5.0, kRounding);
  EXPECT_NEAR(degrees(c, "K"), 5.0, kRounding);
  for (const char* group : {"M", "S", "H", "", "?"}) EXPECT_NEAR(degrees(c, group), 3.0, kRounding) << group;
  c.substrate = Substrate::kHss;
  EXPECT_NEAR(degrees(c, "N"), 10.0, kRounding);
  for (const char* group : {"P", "M", "K", "S", "H"}) EXPECT_NEAR(degrees(c, group), 3.0, kRounding) << group;
}

TEST(Ramp, IsNeverSteeperThanTheCutterMay) {
  for (const char* group : {"P", "M", "K", "N", "S", "H", ""}) {
    for (const double most : {0.0, 0.5, 2.0, 4.0, 7.0}) {
      EXPECT_LE(degrees(mill(most), group), most + kRounding) << group;
    }
  }
  EXPECT_EQ(ramp_of(mill(0.0), of("N")).angle_rad, 0.0);
}

TEST(Ramp, AStatedSlopeIsTakenAtHalfTheFeedWhereItGoesDownFaster) {
  Cutter c = mill(15.0);
  c.sources = {{"maximum_ramp_angle_rad", "stated: the maker"}};
  EXPECT_NEAR(degrees(c, "P"), 15.0, kRounding);
  EXPECT_EQ(ramp_of(c, of("P")).feed_share, 0.5);
  // Half the feed at 15 degrees goes down more slowly than three quarters of it at 10.
  EXPECT_NEAR(degrees(c, "N"), 10.0, kRounding);
  EXPECT_EQ(ramp_of(c, of("N")).feed_share, 0.75);
}

TEST(Ramp, OfACutterWhoseEdgesDoNotReachTheCentreHasHalfTheFeed) {
  Cutter c = mill(5.0);
  c.centre_cutting = false;
  for (const char* group : {"P", "N", "M"}) EXPECT_EQ(ramp_of(c, of(group)).feed_share, 0.5);
}

TEST(Ramp, ABoreMayBeAsDeepAsTheMaterialsChipsComeOut) {
  EXPECT_EQ(ramp_of(mill(5.0), of("P")).bore_depth_mm, 20.0);
  EXPECT_EQ(ramp_of(mill(5.0), of("M")).bore_depth_mm, 10.0);
  EXPECT_EQ(ramp_of(mill(5.0), of("H")).bore_depth_mm, 5.0);
  EXPECT_EQ(ramp_of(mill(0.0), of("M")).bore_depth_mm, 10.0);
}

TEST(Ramp, ASlotIsNoDeeperThanABoreNorThanAnySlotIsMilled) {
  for (const char* group : {"P", "M", "K", "N", "S", "H", ""}) {
    for (const double own_deg : {0.0, 5.0}) {
      const Cutter c = mill(own_deg);
      const Ramp r = ramp_of(c, of(group));
      EXPECT_GT(r.slot_depth_mm, 0.0) << group;
      const double deepest = std::min(r.bore_depth_mm, kDeepestSlotRatio * c.cutting_diameter_mm);
      EXPECT_EQ(r.slot_depth_mm, std::min(deepest, hard_level_mm(c, of(group)))) << group;
    }
  }
  EXPECT_EQ(ramp_of(mill(5.0), of("P")).slot_depth_mm, 15.0);
}

// Above 50 HRC makers of mills name slots of a twentieth of the diameter, not of half of it. A card of the group
// that states no hardness is taken for as hard.
TEST(Ramp, ASlotInSteelAboveFiftyHrcIsShallow) {
  WorkMaterial m = of("H");
  for (const double hb : {421.0, 481.0}) {  // 45 HRC, 50 HRC
    m.hardness_hb = hb;
    EXPECT_EQ(ramp_of(mill(5.0), m).slot_depth_mm, 5.0) << hb;
  }
  for (const double hb : {0.0, 560.0, 654.0}) {  // not known, 55 HRC, 60 HRC
    m.hardness_hb = hb;
    EXPECT_NEAR(ramp_of(mill(5.0), m).slot_depth_mm, 0.5, 1e-12) << hb;
    EXPECT_EQ(ramp_of(mill(5.0), m).bore_depth_mm, 5.0) << hb;
  }
  Cutter small = mill(5.0);
  small.cutting_diameter_mm = 1.0;
  EXPECT_EQ(ramp_of(small, m).slot_depth_mm, kThinnestHardMm);
}

}  // namespace
}  // namespace capstan::model
