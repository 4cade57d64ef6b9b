#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "planner/model/plan/preset_feeds.h"
#include "tests/tooling/selection/shipped.h"
#include "tooling/library/cutters/complete.h"
#include "tooling/selection/select.h"

namespace capstan::tooling {
namespace {

using model::Cutter;
using model::CutterClass;
using model::ToolRequirement;

TEST(StartValues, OfTheShopAreLoweredByNothingThatNobodyStated) {
  Cutter c;
  c.id = "shop";
  c.cutting_diameter_mm = c.shank_diameter_mm = 8.0;
  c.teeth = 3;
  c.presets = {{"P", 140.0, 0.12, "stated: the shop"}};
  complete(c, library());
  // A generic cutter of 8 mm bears 0.08 mm; this one was said to run at 0.12.
  EXPECT_DOUBLE_EQ(c.fz_max_mm, 0.08);
  EXPECT_DOUBLE_EQ(model::largest_tooth_feed_mm(c, material("low_alloy_steel")), 0.18);
  const auto start = start_values(c, material("low_alloy_steel"), machine());
  EXPECT_DOUBLE_EQ(start.fz_mm, 0.12);
  EXPECT_NEAR(start.vc_m_min, 140.0, 1e-9);
  EXPECT_EQ(start.why.text.find("lowered"), std::string::npos) << start.why.text;
  // What it does state is a limit, and is named.
  c.fz_max_mm = 0.1;
  c.sources.clear();
  c.sources.emplace_back("fz_max_mm", "stated: fz_max");
  const auto held = start_values(c, material("low_alloy_steel"), machine());
  EXPECT_DOUBLE_EQ(held.fz_mm, 0.1);
  EXPECT_NE(held.why.text.find("largest, 0.1 mm (stated: fz_max)"), std::string::npos) << held.why.text;
}

TEST(StartValues, OfOneMaterialSayNothingOfWhatTheCutterBearsInAnother) {
  Cutter c;
  c.id = "for aluminium";
  c.cutting_diameter_mm = c.shank_diameter_mm = 8.0;
  c.teeth = 3;
  c.presets = {{"N", 300.0, 0.2, "stated: the shop"}};
  complete(c, library());
  // 1.5 x 0.2 in aluminium; in steel what a generic cutter of 8 mm bears, 0.08.
  EXPECT_NEAR(model::largest_tooth_feed_mm(c, material("wrought_aluminium")), 0.3, 1e-12);
  EXPECT_DOUBLE_EQ(model::largest_tooth_feed_mm(c, material("c45")), 0.08);
  // A preset for a material of the group says what the group bears and no more, and nothing of others.
  Cutter d = c;
  d.presets = {{"en_aw_2024", 200.0, 0.24, "stated: the maker"}};
  d.fz_max_mm = 0.0;
  d.sources.clear();
  complete(d, library());
  EXPECT_NEAR(model::largest_tooth_feed_mm(d, material("wrought_aluminium")), 0.24, 1e-12);
  EXPECT_NEAR(model::largest_tooth_feed_mm(d, material("en_aw_2024")), 0.36, 1e-12);
  EXPECT_DOUBLE_EQ(model::largest_tooth_feed_mm(d, material("c45")), 0.08);
  // Of a preset for the group and one for the material itself, that of the material counts.
  c.presets.insert(c.presets.begin(), {"c45", 100.0, 0.06, "stated: the shop"});
  EXPECT_NEAR(model::largest_tooth_feed_mm(c, material("c45")), 0.09, 1e-12);
}

TEST(StartValues, OfAGroupDoNotMakeHssCutWhatTheCardSaysItDoesNot) {
  Cutter c;
  c.id = "em8";
  c.substrate = model::Substrate::kHss;
  c.cutting_diameter_mm = c.shank_diameter_mm = 8.0;
  c.teeth = 4;
  c.presets = {{"H", 150.0, 0.5, "stated: the shop"}};
  complete(c, library());
  const auto hard = material("hardened_steel_60");
  const auto why = not_cut_with(c, start_values(c, hard, machine()), hard);
  ASSERT_TRUE(why);
  EXPECT_NE(why->find("hardened_steel_60 is not cut with hss"), std::string::npos) << *why;
  ToolRequirement r;
  r.classes = {CutterClass::kEndmill};
  r.diameter_min_mm = r.diameter_max_mm = 8.0;
  const auto none = select(r, {c}, hard, machine());
  ASSERT_TRUE(none.ranked.empty());
  EXPECT_NE(none.would_fit.find(", not of hss (em8: hardened_steel_60 is not cut with hss"),
            std::string::npos)
      << none.would_fit;
  // Who names this very material has tried it.
  c.presets.insert(c.presets.begin(), {"hardened_steel_60", 15.0, 0.02, "stated: the shop"});
  EXPECT_FALSE(not_cut_with(c, start_values(c, hard, machine()), hard));
  // What is carbide is cut by its group.
  c.presets.erase(c.presets.begin());
  c.substrate = model::Substrate::kCarbide;
  EXPECT_NEAR(start_values(c, hard, machine()).wanted_vc_m_min, 150.0, 1e-9);
}

TEST(StartValues, OfACoatedEdgeAreTakenOnlyWhereItIsSaidToBeCoated) {
  // The generic mills are coated: 1.7 times the card's 60 m/min. A mill that states nothing is held bare.
  const auto all = library();
  const auto generic = std::find_if(all.begin(), all.end(),
                                    [](const Cutter& c) { return c.id == "generic/endmill_4f_short/10"; });
  ASSERT_NE(generic, all.end());
  EXPECT_NEAR(start_values(*generic, material("low_alloy_steel"), machine()).vc_m_min, 102.0, 1e-9);
  Cutter c;
  c.id = "shop";
  c.cutting_diameter_mm = c.shank_diameter_mm = 10.0;
  c.teeth = 4;
  complete(c, all);
  EXPECT_NEAR(start_values(c, material("low_alloy_steel"), machine()).vc_m_min, 60.0, 1e-9);
  EXPECT_NEAR(start_values(*generic, material("wrought_aluminium"), machine()).vc_m_min, 270.0, 1e-9);
}

TEST(StartValues, FollowFromSpeedAndFeedPerTooth) {
  const Cutter& c = *std::find_if(library().begin(), library().end(),
                                  [](const Cutter& k) { return k.id == "generic/endmill_4f_short/10"; });
  const auto s = start_values(c, material("mild_steel"), machine());
  // 70 m/min of the card times 1.7 for the coated edge on 10 mm: 3788 1/min; fz 0.005 x 10 mm; four teeth.
  EXPECT_NEAR(s.spindle_rpm, 1.7 * 70000.0 / (10.0 * std::numbers::pi), 1e-9);
  EXPECT_NEAR(s.feed_mm_min, 4 * 0.05 * s.spindle_rpm, 1e-9);
  EXPECT_EQ(s.why.id, "tooling.start.mild_steel");
}

TEST(StartValues, AreClampedToTheSpindleAndSaySo) {
  const Cutter& c = *std::find_if(library().begin(), library().end(),
                                  [](const Cutter& k) { return k.id == "generic/endmill_2f_short/2"; });
  const auto s = start_values(c, material("wrought_aluminium"), machine());
  EXPECT_DOUBLE_EQ(s.spindle_rpm, 10000.0);  // 270 m/min would need 42972
  EXPECT_NE(s.why.text.find("lowered from 42972 to 10000 1/min by the spindle"), std::string::npos)
      << s.why.text;
}

TEST(StartValues, StayWithinMachineAndToolForEveryCutterAndMaterial) {
  const auto materials = shipped_materials().value();
  for (const std::string& id : shipped_machines()) {
    const auto m = machine(id);
    for (const auto& w : materials) {
      for (const Cutter& c : library()) {
        if (c.cutter_class == CutterClass::kTouchProbe) continue;
        const auto s = start_values(c, w, m);
        EXPECT_GE(s.spindle_rpm, m.spindle.rpm_min * (1 - 1e-12)) << c.id;
        EXPECT_LE(s.spindle_rpm, m.spindle.rpm_max * (1 + 1e-12)) << c.id;
        EXPECT_GT(s.fz_mm, 0.0) << c.id;
        EXPECT_LE(s.fz_mm, c.fz_max_mm * (1 + 1e-12)) << c.id;
        if (c.cutter_class == CutterClass::kTap) {
          EXPECT_NEAR(s.feed_mm_min, c.thread_pitch_mm * s.spindle_rpm, 1e-9);
        }
      }
    }
  }
}

TEST(StartValues, OfAShopsOwnMaterialAreItsSpeedTimesTheSeriesFactor) {
  model::WorkMaterial own = material("c45");
  own.id = "shop_steel";
  own.names.clear();
  own.vc_carbide_m_min = 100.0;
  own.vc_hss_m_min = 30.0;
  auto all = library();
  ASSERT_TRUE(add_start_values(own, all));
  const auto of = [&](const std::string& id) {
    return *std::find_if(all.begin(), all.end(), [&](const Cutter& c) { return c.id == id; });
  };
  // Coated: 1.7 times, as for the shipped ones; drills of high-speed steel at the 0.8 of their series.
  EXPECT_NEAR(start_values(of("generic/endmill_4f_short/10"), own, machine()).vc_m_min, 170.0, 1e-3);
  EXPECT_NEAR(start_values(of("generic/drill_hss/8"), own, machine()).vc_m_min, 24.0, 1e-3);
  // Without that, the slowest of its group would stand for it.
  EXPECT_LT(start_values(*std::find_if(library().begin(), library().end(),
                                       [](const Cutter& c) { return c.id == "generic/endmill_4f_short/10"; }),
                         own, machine())
                .vc_m_min,
            80.0);
}

TEST(StartValues, OfAChangedCardStandInPlaceOfThoseThatItHadBefore) {
  model::WorkMaterial own = material("c45");
  own.id = "shop_steel";
  own.names.clear();
  own.vc_carbide_m_min = 100.0;
  own.vc_hss_m_min = 30.0;
  auto all = library();
  ASSERT_TRUE(add_start_values(own, all));
  own.vc_carbide_m_min = 50.0;
  own.vc_hss_m_min = 0.0;  // not cut with it any more
  ASSERT_TRUE(add_start_values(own, all));
  auto afresh = library();
  ASSERT_TRUE(add_start_values(own, afresh));
  EXPECT_TRUE(all == afresh);
  const auto mill = std::find_if(all.begin(), all.end(),
                                 [](const Cutter& c) { return c.id == "generic/endmill_4f_short/10"; });
  EXPECT_NEAR(start_values(*mill, own, machine()).vc_m_min, 85.0, 1e-3);  // coated: 1.7 times
}

TEST(StartValues, OfAShippedMaterialAreTheLibrarys) {
  auto all = library();
  model::WorkMaterial shipped = material("c45");
  shipped.vc_carbide_m_min *= 0.5;
  ASSERT_TRUE(add_start_values(shipped, all));
  EXPECT_TRUE(all == library());
}

TEST(StartValues, NameTheSourceOfTheMaterialsSpeed) {
  const auto start = start_values(library().front(), material("c45"), machine());
  EXPECT_NE(start.why.source.find("; the material's speed: "), std::string::npos) << start.why.source;
}

}  // namespace
}  // namespace capstan::tooling
