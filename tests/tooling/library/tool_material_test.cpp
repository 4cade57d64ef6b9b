// What a tool is made of whose file does not say it.

#include "tooling/library/nouns/tool_material.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "planner/model/nouns/tool.h"
#include "planner/model/nouns/workpiece.h"
#include "planner/model/plan/assumed_tool_material.h"
#include "tooling/library/cutters/complete.h"
#include "tooling/library/cutters/generic.h"
#include "tooling/library/nouns/nouns.h"
#include "tooling/library/words/comment_words.h"
#include "tooling/shop/material/material.h"

namespace capstan::tooling {
namespace {

using model::Cutter;
using model::CutterClass;
using model::Substrate;

constexpr double kHss = 20.0, kCarbide = 60.0;  // m/min

model::WorkMaterial steel() {
  model::WorkMaterial m;
  m.id = "steel";
  m.iso_group = "P";
  m.vc_hss_m_min = kHss;
  m.vc_carbide_m_min = kCarbide;
  return m;
}

Cutter cutter(CutterClass c, double diameter_mm) {
  Cutter out;
  out.cutter_class = c;
  out.cutting_diameter_mm = diameter_mm;
  return out;
}

Substrate likely(CutterClass c, double diameter_mm, double vc_m_min, const model::WorkMaterial& m = steel()) {
  ToolMaterialHints hints;
  hints.material = &m;
  hints.vc_m_min = vc_m_min;
  return likely_material(cutter(c, diameter_mm), hints).substrate;
}

TEST(LikelyMaterial, IsHssWhereTheFileRunsTheToolAsHss) {
  // An end mill of that size is carbide by today's practice: the speed says otherwise, and it is the safe
  // word.
  EXPECT_EQ(likely(CutterClass::kEndmill, 10.0, kHss), Substrate::kHss);
  EXPECT_EQ(likely(CutterClass::kFacemill, 63.0, kHss), Substrate::kHss);
}

TEST(LikelyMaterial, IsHssUpToTheSpeedOfACoatedEdge) {
  // 1.5 times the bare edge's, and a quarter more, as cards differ.
  EXPECT_EQ(likely(CutterClass::kEndmill, 10.0, 1.87 * kHss), Substrate::kHss);
  EXPECT_EQ(likely(CutterClass::kEndmill, 10.0, 1.88 * kHss), Substrate::kCarbide);
}

TEST(LikelyMaterial, IsCarbideWhereOnlyCarbideBearsTheSpeedOfTheFile) {
  EXPECT_EQ(likely(CutterClass::kTwistDrill, 10.0, kCarbide), Substrate::kCarbide);
  EXPECT_EQ(likely(CutterClass::kReamer, 22.0, 1.5 * kCarbide), Substrate::kCarbide);
}

TEST(LikelyMaterial, CountsTheCoatingThatTheGenericMillsOfCarbideHaveInSteel) {
  const auto materials = shipped_materials().value();
  const auto card = std::find_if(materials.begin(), materials.end(), [](const auto& m) {
    return m.iso_group == "P" && m.vc_carbide_m_min > 0.0;
  });
  ASSERT_NE(card, materials.end());
  const auto library = generic_library().value();
  const auto mill = std::find_if(library.begin(), library.end(),
                                 [](const Cutter& c) { return c.id == "generic/endmill_4f_short/10"; });
  ASSERT_NE(mill, library.end());
  const auto preset = std::find_if(mill->presets.begin(), mill->presets.end(),
                                   [&](const auto& p) { return p.material_group == card->id; });
  ASSERT_NE(preset, mill->presets.end());
  const double coating = preset->vc_m_min / card->vc_carbide_m_min;
  EXPECT_EQ(likely(CutterClass::kTwistDrill, 10.0, 1.24 * coating * kCarbide), Substrate::kCarbide);
  EXPECT_EQ(likely(CutterClass::kTwistDrill, 10.0, 1.26 * coating * kCarbide), Substrate::kHss);
}

TEST(LikelyMaterial, FollowsPracticeWhereTheFileGivesNoSpeedOrOneThatNeitherBears) {
  for (const double vc : {0.0, 10.0 * kCarbide}) {
    EXPECT_EQ(likely(CutterClass::kEndmill, 20.0, vc), Substrate::kCarbide) << vc;
    EXPECT_EQ(likely(CutterClass::kEndmill, 32.0, vc), Substrate::kHss) << vc;
    EXPECT_EQ(likely(CutterClass::kFacemill, 80.0, vc), Substrate::kCarbide) << vc;
    for (const CutterClass c : {CutterClass::kTwistDrill, CutterClass::kTap, CutterClass::kReamer,
                                CutterClass::kCountersink, CutterClass::kTSlotMill})
      EXPECT_EQ(likely(c, 10.0, vc), Substrate::kHss) << model::to_text(c) << vc;
  }
}

TEST(LikelyMaterial, IsNotCarbideOnlyBecauseHssDoesNotCutTheMaterial) {
  // Such a drill is refused, and the refusal says how to state what it is.
  model::WorkMaterial hard = steel(), soft = steel();
  hard.vc_hss_m_min = 0.0;
  soft.vc_carbide_m_min = 0.0;
  EXPECT_EQ(likely(CutterClass::kTwistDrill, 10.0, kHss, hard), Substrate::kHss);
  EXPECT_EQ(likely(CutterClass::kEndmill, 10.0, 0.0, hard), Substrate::kCarbide);
  EXPECT_EQ(likely(CutterClass::kEndmill, 10.0, kCarbide, soft), Substrate::kHss);
}

TEST(LikelyMaterial, IsWhatIsSettledWhateverElseTells) {
  const model::WorkMaterial m = steel();
  ToolMaterialHints hints;
  hints.material = &m;
  hints.vc_m_min = kCarbide;
  hints.settled = Substrate::kHss;
  hints.settled_by = settled_source("--assume tool-material=hss");
  Cutter c = cutter(CutterClass::kEndmill, 10.0);
  const ToolMaterial likely = likely_material(c, hints);
  EXPECT_EQ(likely.substrate, Substrate::kHss);
  c.sources.emplace_back("substrate", likely.source);
  EXPECT_TRUE(material_is_assumed(c));
  EXPECT_FALSE(material_is_open(c));
  EXPECT_EQ(reason_of_source(likely.source), "--assume tool-material=hss");
}

/// A reamer of 22 mm as files give one; `material` of its edge where it is not empty.
model::Ref<model::MachiningTool> reamer(model::Model& m, const std::string& material) {
  const auto dimension = m.add<model::MillingToolDimension>();
  m.at<model::MillingToolDimension>(dimension).diameter = 22.0;
  m.at<model::MillingToolDimension>(dimension).cutting_edge_length = 40.0;
  const auto body = m.add<model::Reamer>();
  m.at<model::Reamer>(body).dimension = dimension;
  const auto edge = m.add<model::CuttingComponent>();
  m.at<model::CuttingComponent>(edge).tool_offset_length = 90.0;
  if (!material.empty()) {
    model::Material stated;
    stated.material_identifier = material;
    m.at<model::CuttingComponent>(edge).its_material = m.add(stated);
  }
  const auto tool = m.add<model::MillingCuttingTool>();
  auto& t = m.at<model::MillingCuttingTool>(tool);
  t.its_id = "REAMER";
  t.its_tool_body = body;
  t.its_cutting_edge.push_back(edge);
  return tool;
}

TEST(CutterFromNouns, TakesTheStatedToolMaterialWhateverTellsOfAnother) {
  model::Model m;
  Job job;
  const model::WorkMaterial work = steel();
  ToolMaterialHints hints;
  hints.material = &work;
  hints.vc_m_min = kCarbide;
  const auto hss = cutter_from_nouns(m, reamer(m, "HSS"), job, {}, &hints).value();
  EXPECT_EQ(hss.substrate, Substrate::kHss);
  EXPECT_FALSE(material_is_assumed(hss));
  const auto likely = cutter_from_nouns(m, reamer(m, ""), job, {}, &hints).value();
  EXPECT_EQ(likely.substrate, Substrate::kCarbide);
  EXPECT_TRUE(material_is_open(likely));
}

TEST(CutterFromNouns, StartsACarbideReamerAsTheCarbideReamersOfTheSeriesAndNotAsAMill) {
  model::Model m;
  Job job;
  // No generic carbide reamer has 22 mm; the series runs at 0.4 of the card's speed for carbide.
  const auto c = cutter_from_nouns(m, reamer(m, "CARBIDE"), job).value();
  const auto p = std::find_if(c.presets.begin(), c.presets.end(),
                              [](const auto& x) { return x.material_group == "low_alloy_steel"; });
  ASSERT_NE(p, c.presets.end());
  EXPECT_NEAR(p->vc_m_min, 0.4 * 60.0, 1e-9);
}

TEST(NounsFromCutter, StateNoToolMaterialThatIsOnlyAssumed) {
  for (const bool assumed : {false, true}) {
    model::Model m;
    Job job;
    Cutter c = cutter_from_nouns(m, reamer(m, "CARBIDE"), job).value();
    if (assumed) {
      for (auto& [field, source] : c.sources)
        if (field == "substrate") source = assumed_source(c.substrate, "a guess");
    }
    const auto* tool = m.get<model::CuttingTool>(nouns_from_cutter(m, c));
    const auto* edge = m.get<model::CuttingComponent>(tool->its_cutting_edge.items.at(0));
    EXPECT_EQ(edge->its_material.set(), !assumed);
  }
}

TEST(ToolTable, StatesNothingByWhatItSaysThatAPlanAssumed) {
  const auto words = [](const std::string& comment) {
    return words_of_comment(comment, CutterClass::kEndmill, 10.0, 1.0).substrate;
  };
  EXPECT_EQ(words("MILL 10MM, carbide"), Substrate::kCarbide);
  EXPECT_EQ(words("MILL 10MM, assumed carbide"), std::nullopt);
  EXPECT_EQ(words("HSS MILL 10MM, assumed carbide"), Substrate::kHss);
}

TEST(AssumedToolMaterial, ComesBackFromItsRowOfProvenance) {
  for (const bool settled : {false, true}) {
    const model::AssumedToolMaterial a{"MILL 18MM", Substrate::kCarbide, "its speed", settled};
    const auto back = model::assumed_tool_material(model::provenance_of(a));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->tool, a.tool);
    EXPECT_EQ(back->substrate, a.substrate);
    EXPECT_EQ(back->why, a.why);
    EXPECT_EQ(back->settled, settled);
  }
  EXPECT_FALSE(model::assumed_tool_material({"material", "C45", "the file"}));
}

}  // namespace
}  // namespace capstan::tooling
