#include "tooling/library/cutters/generic.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <set>

#include "tests/support/corpus.h"
#include "tooling/library/cutters/check.h"
#include "tooling/library/cutters/complete.h"
#include "tooling/library/library.h"
#include "tooling/shop/data/data.h"
#include "tooling/shop/material/material.h"

namespace capstan::tooling {
namespace {

using model::Cutter;
using model::CutterClass;

const std::vector<Cutter>& library() {
  static const std::vector<Cutter> kLibrary = generic_library().value();
  return kLibrary;
}
const Cutter* by_id(const std::string& id) {
  for (const Cutter& c : library())
    if (c.id == id) return &c;
  return nullptr;
}

TEST(GenericLibrary, HoldsEveryClassAndToTheNextHundredAsManySizesAsTheReadmeSays) {
  const std::string readme = testing::slurp(testing::source_dir() + "/README.md");
  const std::size_t hundreds = 100 * ((library().size() + 50) / 100);
  EXPECT_NE(readme.find("some " + std::to_string(hundreds) + " sizes"), std::string::npos)
      << library().size();
  std::set<CutterClass> classes;
  for (const Cutter& c : library()) classes.insert(c.cutter_class);
  EXPECT_EQ(classes.size(), static_cast<std::size_t>(model::kLastCutterClass) + 1);
}

TEST(GenericLibrary, HasNoFaultAndNamesASourceForEverything) {
  for (const Cutter& c : library()) {
    EXPECT_THAT(faults_of(c), ::testing::IsEmpty()) << c.id;
    ASSERT_NE(source_of(c, "cutting_diameter_mm"), nullptr) << c.id;
    for (const auto& [field, source] : c.sources) EXPECT_TRUE(source.starts_with("default")) << c.id << field;
    for (const auto& p : c.presets) EXPECT_FALSE(p.source.empty()) << c.id;
    EXPECT_GT(c.usable_length_mm, 0.0) << c.id;
    EXPECT_GT(c.holder_diameter_mm, 0.0) << c.id;
  }
}

TEST(GenericLibrary, HasInchSizesBesideTheMetricOnesWhereTheyAreAskedFor) {
  Job job;
  const auto both = load_library(std::string(kGenericInch), job).value();
  EXPECT_GT(both.size(), library().size() + 300);
  std::map<std::string, const Cutter*> by;
  for (const Cutter& c : both) {
    EXPECT_TRUE(by.emplace(c.id, &c).second) << c.id;
    EXPECT_THAT(faults_of(c), ::testing::IsEmpty()) << c.id;
  }
  for (const Cutter& c : library()) EXPECT_EQ(by.count(c.id), 1U) << c.id;
  // A number drill, a letter drill, a half inch mill, a quarter inch mill with a corner of .06.
  for (const auto& [id, mm] : {std::pair("generic/drill_hss_inch/No7", 0.201 * 25.4),
                               {"generic/drill_hss_inch/F", 0.257 * 25.4},
                               {"generic/endmill_3f_inch/1-2in", 12.7},
                               {"generic/bull_inch/1-4inr1.524", 6.35}}) {
    ASSERT_EQ(by.count(id), 1U) << id;
    EXPECT_NEAR(by[id]->cutting_diameter_mm, mm, 1e-4) << id;
  }
}

TEST(GenericLibrary, LetsEndMillsOfFourFlutesRampAtThreeDegreesAtMost) {
  // Their core leaves less room to the chips than two or three flutes do; no maker's figure says more.
  int mills = 0;
  for (const Cutter& c : library()) {
    if (c.teeth < 4 || !model::has(c.cutter_class, model::CutterTrait::kEndMill)) continue;
    ++mills;
    EXPECT_LE(c.maximum_ramp_angle_rad, 3.0 * std::numbers::pi / 180.0 + 1e-12) << c.id;
  }
  EXPECT_GT(mills, 20);
}

TEST(GenericLibrary, GivesEveryCutterAPresetForEveryMaterialThatItsSubstrateCuts) {
  const auto materials = shipped_materials().value();
  for (const Cutter& c : library()) {
    if (c.cutter_class == CutterClass::kTouchProbe) continue;
    std::map<std::string, model::CuttingPreset> presets;
    for (const auto& p : c.presets) EXPECT_TRUE(presets.emplace(p.material_group.text(), p).second) << c.id;
    for (const auto& m : materials) {
      const bool cut = c.substrate == model::Substrate::kCarbide || m.vc_hss_m_min > 0.0;
      ASSERT_EQ(presets.count(m.id), cut ? 1u : 0u) << c.id << " " << m.id;
      if (!cut) continue;
      EXPECT_GE(presets[m.id].fz_mm, c.fz_min_mm) << c.id << " " << m.id;
      EXPECT_LE(presets[m.id].fz_mm, c.fz_max_mm) << c.id << " " << m.id;
      EXPECT_GT(presets[m.id].vc_m_min, 0.0) << c.id << " " << m.id;
    }
  }
}

TEST(GenericLibrary, HasADrillForEveryTenthToTenMillimetresAndTheTapDrills) {
  for (int tenths = 10; tenths <= 100; ++tenths) {
    const std::string size =
        std::to_string(tenths / 10) + (tenths % 10 == 0 ? "" : "." + std::to_string(tenths % 10));
    EXPECT_NE(by_id("generic/drill_hss/" + size), nullptr) << size;
  }
  EXPECT_NE(by_id("generic/drill_hss/10.2"), nullptr);  // M12
  EXPECT_NE(by_id("generic/drill_hss/32"), nullptr);
}

TEST(GenericLibrary, NeverLetsAThinToolReachPastItsThickerShank) {
  for (const Cutter& c : library()) {
    if (c.cutter_class != CutterClass::kEndmill || c.shank_diameter_mm <= c.cutting_diameter_mm) continue;
    // As deep as its flutes, or the neck behind them, that is thinner than they are.
    EXPECT_LT(c.neck_diameter_mm, c.cutting_diameter_mm) << c.id;
    EXPECT_DOUBLE_EQ(c.usable_length_mm, std::max(c.maximum_depth_of_cut_mm, c.neck_length_mm)) << c.id;
  }
}

TEST(GenericLibrary, ReachesTwentyMillimetresDownIntoInnerCornersOfR1Point5ToR3) {
  for (const double radius : {1.5, 2.0, 2.5, 3.0}) {
    const bool any = std::any_of(library().begin(), library().end(), [&](const Cutter& c) {
      return c.cutter_class == CutterClass::kEndmill && c.cutting_diameter_mm <= 2.0 * radius &&
             reach_of(c) >= 20.0;
    });
    EXPECT_TRUE(any) << radius;
  }
}

TEST(GenericLibrary, DrillsNineDiametersDeepFromThreeToThirteenMillimetres) {
  for (double d = 3.0; d <= 13.0; d += 0.5) {
    const bool any = std::any_of(library().begin(), library().end(), [&](const Cutter& c) {
      return c.cutter_class == CutterClass::kTwistDrill && c.cutting_diameter_mm == d &&
             reach_of(c) >= 9.0 * d;
    });
    EXPECT_TRUE(any) << d;
  }
}

TEST(GenericLibrary, AdvancesATapByItsPitchPerTurn) {
  const Cutter* m6 = by_id("generic/tap/M6");
  ASSERT_NE(m6, nullptr);
  for (const auto& p : m6->presets) EXPECT_NEAR(p.fz_mm * m6->teeth, 1.0, 1e-12);  // M6: pitch 1 mm
}

TEST(GenericLibrary, DescribesAHolderFromTheToolsFaceToTheGageLine) {
  for (const Cutter& c : library()) {
    ASSERT_FALSE(c.holder.empty()) << c.id;
    double height = 0.0, widest = 0.0;
    for (const auto& s : c.holder) {
      height += s.height_mm;
      widest = std::max({widest, s.lower_diameter_mm, s.upper_diameter_mm});
    }
    EXPECT_NEAR(height, c.functional_length_mm - c.stick_out_mm, 1e-9) << c.id;
    EXPECT_DOUBLE_EQ(widest, c.holder_diameter_mm) << c.id;
  }
}

TEST(GenericLibrary, SaysTheThreadOfEveryTapAndThreadMill) {
  int left = 0;
  for (const Cutter& c : library()) {
    if (c.cutter_class != CutterClass::kTap && c.cutter_class != CutterClass::kThreadMill) continue;
    EXPECT_EQ(c.thread_form, "M") << c.id;
    EXPECT_GT(c.thread_size_mm, 0.0) << c.id;
    EXPECT_GT(c.thread_pitch_mm, 0.0) << c.id;
    if (c.cutter_class == CutterClass::kTap) {
      EXPECT_GT(c.lead_threads, 0.0) << c.id;
      EXPECT_DOUBLE_EQ(c.thread_size_mm, c.cutting_diameter_mm) << c.id;
      left += c.hand == model::Hand::kLeft ? 1 : 0;
    } else {
      EXPECT_LT(c.cutting_diameter_mm, c.thread_size_mm) << c.id;
    }
  }
  EXPECT_GE(left, 5);
}

TEST(GenericLibrary, CornerRoundingMillsAreATipAndTwoRadiiWide) {
  for (const Cutter& c : library()) {
    if (c.cutter_class != CutterClass::kCornerRoundingMill) continue;
    EXPECT_DOUBLE_EQ(c.cutting_diameter_mm, c.tip_diameter_mm + 2.0 * c.corner_radius_mm) << c.id;
  }
}

TEST(GenericLibrary, CoversBoresWithoutAGapFromItsSmallestToItsLargestBoringTool) {
  double reached = 8.0;
  for (const Cutter& c : library()) {
    if (c.cutter_class != CutterClass::kBoringTool) continue;
    EXPECT_LE(c.cutting_diameter_mm, reached) << c.id;
    reached = std::max(reached, c.adjustable_to_mm);
  }
  EXPECT_GE(reached, 60.0);
}

TEST(GenericLibrary, IsTheSameEachTime) { EXPECT_EQ(generic_library().value(), library()); }

// A class of cutter brings its sizes in a file of its own.
TEST(ExpandSeries, TakesTheTablesOfTheFirstFileForSeriesOfOthers) {
  Job job;
  const std::string own =
      "capstan_cutter_series: 1\nsource: test\nseries:\n"
      "  - {name: mine, words: a mill, class: endmill, substrate: carbide, sizes: [7], teeth: 3, "
      "flute_length: 20,\n"
      "     shank: 8, stick_out: 30, feeds: mill_carbide, speed_factor: 1}\n";
  const SeriesFile first{"cutters.yaml", shipped_tree("cutters.yaml").value()};
  const auto got = expand_series({first, {"mine.yaml", parse_tree(own, "mine.yaml").value()}},
                                 shipped_materials().value(), job);
  ASSERT_TRUE(got) << to_text(got.error());
  EXPECT_EQ(got->back().id, "generic/mine/7");
  EXPECT_EQ(got->back().functional_length_mm, 100.0);  // 70 mm of the first file's chuck and 30 mm
  const auto twice = expand_series({first,
                                    {"mine.yaml", parse_tree(own, "mine.yaml").value()},
                                    {"again.yaml", parse_tree(own, "again.yaml").value()}},
                                   shipped_materials().value(), job);
  ASSERT_FALSE(twice);
  EXPECT_EQ(twice.error().file, "again.yaml");
  EXPECT_EQ(twice.error().code, "DATA-DUPLICATE");
}

TEST(ExpandSeries, SaysWhereATableEnds) {
  Job job;
  std::string text = shipped_text("cutters.yaml");
  const auto at = text.find("20, 25]\n    teeth: 2");
  ASSERT_NE(at, std::string::npos);
  text.replace(at, 7, "20, 26]");
  const auto got =
      expand_series({{"mine.yaml", parse_tree(text, "mine.yaml").value()}}, shipped_materials().value(), job);
  ASSERT_FALSE(got);
  EXPECT_EQ(got.error().code, "DATA-TABLE");
  EXPECT_EQ(got.error().file, "mine.yaml");
  EXPECT_GT(got.error().line, 0u);
}

}  // namespace
}  // namespace capstan::tooling
