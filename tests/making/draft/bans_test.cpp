#include "planner/making/draft/bans.h"

#include <gtest/gtest.h>

#include <string>

namespace capstan::draft {
namespace {

model::Cutter mill(const std::string& id, double diameter_mm) {
  model::Cutter c;
  c.id = id;
  c.cutting_diameter_mm = diameter_mm;
  return c;
}

TEST(Bans, OfACutterLeaveAnotherOfItsDiameter) {
  Bans bans;
  bans.ban_cutter({}, "chain", 0, "em25", "it breaks");
  ASSERT_NE(bans.cutter_banned({}, "chain", 0, mill("em25", 25.0)), nullptr);
  EXPECT_EQ(*bans.cutter_banned({}, "chain", 0, mill("em25", 25.0)), "it breaks");
  EXPECT_EQ(bans.cutter_banned({}, "chain", 0, mill("em25 long", 25.0)), nullptr);
  EXPECT_EQ(bans.cutter_banned({}, "chain", 1, mill("em25", 25.0)), nullptr);
}

TEST(Bans, WhereACutterLeavesMaterialItsEqualsAndWiderOnesAreBanned) {
  Bans bans;
  bans.ask_narrower({}, "chain", 0, {25.4, 0.0}, "4 mm are left");
  // One inch, from a list in inches.
  EXPECT_NE(bans.cutter_banned({}, "chain", 0, mill("one inch", 25.399999999999995)), nullptr);
  EXPECT_NE(bans.cutter_banned({}, "chain", 0, mill("em32", 32.0)), nullptr);
  EXPECT_EQ(bans.cutter_banned({}, "chain", 0, mill("em25", 25.0)), nullptr);
  EXPECT_EQ(bans.cutter_banned({}, "other", 0, mill("em32", 32.0)), nullptr);
}

TEST(Bans, WhereALargeCornerLeavesMaterialASmallerOneIsTried) {
  Bans bans;
  bans.ask_narrower({}, "chain", 0, {10.0, 2.0}, "0.3 mm are left");
  model::Cutter sharper = mill("bull 10 r0.5", 10.0);
  sharper.corner_radius_mm = 0.5;
  EXPECT_EQ(bans.cutter_banned({}, "chain", 0, sharper), nullptr);
  model::Cutter same = sharper;
  same.corner_radius_mm = 2.0;
  EXPECT_NE(bans.cutter_banned({}, "chain", 0, same), nullptr);
}

TEST(Bans, OfWidthOnlyNarrow) {
  Bans bans;
  bans.ask_narrower({}, "chain", 0, {20.0, 0.0}, "first");
  bans.ask_narrower({}, "chain", 0, {25.0, 0.0}, "later");
  ASSERT_NE(bans.cutter_banned({}, "chain", 0, mill("em20", 20.0)), nullptr);
  EXPECT_EQ(*bans.cutter_banned({}, "chain", 0, mill("em20", 20.0)), "first");
  bans.ask_narrower({}, "chain", 0, {16.0, 0.0}, "last");
  EXPECT_EQ(*bans.cutter_banned({}, "chain", 0, mill("em16", 16.0)), "last");
}

}  // namespace
}  // namespace capstan::draft
