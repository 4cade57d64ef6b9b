// Speeds by the grade of an edge, as a tool's words state it.

#include "tooling/library/cutters/edges.h"

#include <gtest/gtest.h>

#include <string>

#include "tooling/library/cutters/complete.h"
#include "tooling/library/cutters/generic.h"
#include "tooling/library/library.h"
#include "tooling/selection/select.h"
#include "tooling/shop/machine/machine.h"
#include "tooling/shop/material/material.h"

namespace capstan::tooling {
namespace {

using model::Cutter;
using model::CutterClass;
using model::Substrate;

model::WorkMaterial material(const std::string& name) {
  Job job;
  return find_material(name, shipped_materials().value(), job).value();
}

Cutter cutter(CutterClass kind, Substrate substrate, const std::string& words) {
  Cutter c;
  c.id = "shop";
  c.description = words;
  c.cutter_class = kind;
  c.substrate = substrate;
  c.cutting_diameter_mm = c.shank_diameter_mm = 10.0;
  c.teeth = kind == CutterClass::kTwistDrill ? 2 : 4;
  c.sources.emplace_back("substrate", "stated");
  complete(c, shared_generic_library().value());
  return c;
}

StartValues start(const Cutter& c, const std::string& name) {
  Job job;
  model::Machine m = load_machine("generic_vmc", job).value();
  m.spindle.rpm_max = 100000.0;
  return start_values(c, material(name), m);
}

TEST(Grade, IsReadFromWholeWordsOnly) {
  const auto of = [](Substrate s, const std::string& words) {
    Cutter c;
    c.substrate = s;
    c.description = words;
    return grade_of(c);
  };
  EXPECT_TRUE(of(Substrate::kHss, "HSS-E TiAlN drill 8.5").cobalt);
  EXPECT_TRUE(of(Substrate::kHss, "HSS-E TiAlN drill 8.5").coated);
  EXPECT_TRUE(of(Substrate::kHss, "Spiralbohrer HSSE, unbeschichtet").cobalt);
  EXPECT_FALSE(of(Substrate::kHss, "Spiralbohrer HSSE, unbeschichtet").coated);
  EXPECT_FALSE(of(Substrate::kHss, "drill for setting out, HSS").coated);  // no TiN in "setting"
  EXPECT_FALSE(of(Substrate::kCarbide, "cobalt-bonded carbide").cobalt);
  EXPECT_TRUE(of(Substrate::kCarbide, "end mill VHM AlTiN").coated);
  EXPECT_FALSE(of(Substrate::kCarbide, "uncoated end mill").coated);
  EXPECT_FALSE(of(Substrate::kHss, "drill, assumed hss, coated").coated);
}

TEST(Grade, IsNotReadFromWhatIsSaidOfTheWork) {
  const auto of = [](Substrate s, const std::string& words) {
    Cutter c;
    c.substrate = s;
    c.description = words;
    return grade_of(c);
  };
  EXPECT_FALSE(of(Substrate::kCarbide, "carbide end mill, steel, brass and tin").coated);
  EXPECT_TRUE(of(Substrate::kCarbide, "carbide end mill TiN").coated);
  EXPECT_FALSE(of(Substrate::kHss, "HSS drill for coated sheet").coated);
  EXPECT_FALSE(of(Substrate::kHss, "HSS-Bohrer für beschichtet verzinkte Bleche").coated);
  EXPECT_FALSE(of(Substrate::kHss, "HSS drill, core of M42").cobalt);
  EXPECT_TRUE(of(Substrate::kHss, "HSS M42 drill").cobalt);
  EXPECT_TRUE(of(Substrate::kHss, "M35 HSS drill 8.5").cobalt);
}

TEST(Grade, OfHighSpeedSteelRaisesItsSpeedByWhatItsMakersTableSays) {
  const double plain = start(cutter(CutterClass::kTwistDrill, Substrate::kHss, "HSS drill"), "c45").vc_m_min;
  const auto times = [&](const char* words) {
    return start(cutter(CutterClass::kTwistDrill, Substrate::kHss, words), "c45").vc_m_min / plain;
  };
  EXPECT_NEAR(times("HSS-Co5 drill"), 1.2, 1e-3);
  EXPECT_NEAR(times("HSS drill, TiN"), 1.25, 1e-3);
  EXPECT_NEAR(times("HSS-E drill, TiN"), 1.5, 1e-3);
}

TEST(Grade, RaisesAMillOfHssOfWhichNoGenericOneIsThereByTheMaterialsSpeed) {
  const auto s = start(cutter(CutterClass::kEndmill, Substrate::kHss, "HSS-E end mill"), "c45");
  EXPECT_NEAR(s.vc_m_min, 1.2 * material("c45").vc_hss_m_min, 1e-3);
  EXPECT_NE(s.why.source.find("as 'hss-e' says"), std::string::npos) << s.why.source;
}

TEST(Grade, OfCarbideThatIsStatedToBeCoatedIsTheGenericOnes) {
  const double bare =
      start(cutter(CutterClass::kEndmill, Substrate::kCarbide, "carbide end mill"), "c45").vc_m_min;
  const double coated =
      start(cutter(CutterClass::kEndmill, Substrate::kCarbide, "carbide end mill, TiAlN"), "c45").vc_m_min;
  EXPECT_NEAR(bare, material("c45").vc_carbide_m_min, 1e-3);
  EXPECT_NEAR(coated / bare, shipped_edges().at("coated_mill").over_bare.at("P"), 1e-3);
}

TEST(Grade, WithoutAFigureForTheGroupStaysBareAndSaysSo) {
  const auto s = start(cutter(CutterClass::kTwistDrill, Substrate::kHss, "HSS-E drill, TiN"), "EN AW-6061");
  const auto plain = start(cutter(CutterClass::kTwistDrill, Substrate::kHss, "HSS drill"), "EN AW-6061");
  EXPECT_DOUBLE_EQ(s.vc_m_min, plain.vc_m_min);
  EXPECT_NE(s.why.source.find("as bare: no figure for hss-e, tin in group N"), std::string::npos)
      << s.why.source;
}

// Scientific Cutting Tools, solid carbide boring bars in titanium, AlTiN: 120 to 275 feet a minute, 0.0005 to
// 0.005 inch a turn.
TEST(BoringBars, CutTitaniumWithinAMakersSpeedsAndFeeds) {
  constexpr double kFootM = 0.3048, kInchMm = 25.4;
  int bars = 0;
  for (const Cutter& c : shared_generic_library().value()) {
    if (c.cutter_class != CutterClass::kBoringTool) continue;
    ++bars;
    const StartValues s = start(c, "ti6al4v");
    EXPECT_GE(s.vc_m_min, 120.0 * kFootM) << c.id;
    EXPECT_LE(s.vc_m_min, 275.0 * kFootM) << c.id;
    EXPECT_GE(s.fz_mm, (c.cutting_diameter_mm < 20.0 ? 0.0005 : 0.002) * kInchMm) << c.id;
    EXPECT_LE(s.fz_mm, 0.005 * kInchMm) << c.id;
  }
  EXPECT_GT(bars, 0);
}

// The same chart: cast iron, carbon, alloy, tool and 300 stainless steel.
TEST(BoringBars, CutSteelAndCastIronWithinAMakersSpeeds) {
  constexpr double kFootM = 0.3048;
  struct Row {
    const char* material;
    double least_ft, most_ft;
  };
  const Cutter* bar = nullptr;
  for (const Cutter& c : shared_generic_library().value()) {
    if (c.cutter_class == CutterClass::kBoringTool) bar = &c;
  }
  ASSERT_NE(bar, nullptr);
  for (const Row& row : {Row{"GG25", 200, 550}, Row{"C45", 200, 450}, Row{"42CrMo4", 200, 425},
                         Row{"1.2379", 175, 300}, Row{"AISI 304", 175, 350}}) {
    const StartValues s = start(*bar, row.material);
    EXPECT_GE(s.vc_m_min, row.least_ft * kFootM) << row.material;
    EXPECT_LE(s.vc_m_min, row.most_ft * kFootM) << row.material;
  }
}

TEST(Grade, LeavesWhatTheShopStatesAlone) {
  Cutter c = cutter(CutterClass::kTwistDrill, Substrate::kHss, "HSS-E drill, TiN");
  c.presets.insert(c.presets.begin(), {"c45", 22.0, 0.08, "stated: the shop"});
  EXPECT_NEAR(start(c, "c45").wanted_vc_m_min, 22.0, 1e-9);
}

TEST(Grade, IsReadFromTheCoatingColumnOfATable) {
  Job job;
  const auto read = read_library(
      "Tool Number,Type,Diameter [mm],Number of "
      "Flutes,Substrate,Coating\n1,drill,10,2,HSS-E,TiN\n2,drill,10,2,HSS,\n",
      "t.csv", job);
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->size(), 2U);
  EXPECT_TRUE(grade_of(read->at(0)).coated && grade_of(read->at(0)).cobalt);
  EXPECT_FALSE(grade_of(read->at(1)).coated || grade_of(read->at(1)).cobalt);
}

}  // namespace
}  // namespace capstan::tooling
