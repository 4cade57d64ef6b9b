// Drills and reamers of carbide: the sizes that a shop has of them, and the speeds that tables give.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "tooling/library/cutters/complete.h"
#include "tooling/library/cutters/generic.h"
#include "tooling/selection/select.h"
#include "tooling/shop/data/data.h"
#include "tooling/shop/machine/machine.h"
#include "tooling/shop/material/material.h"

namespace capstan::tooling {
namespace {

using model::Cutter;
using model::CutterClass;
using model::Substrate;

const std::vector<Cutter>& library() { return shared_generic_library().value(); }

model::WorkMaterial material(const std::string& name) {
  Job job;
  return find_material(name, shipped_materials().value(), job).value();
}
model::Machine machine(const std::string& id = "generic_vmc") {
  Job job;
  return load_machine(id, job).value();
}

const Cutter& generic(const std::string& id) {
  const auto at = std::find_if(library().begin(), library().end(), [&](const auto& c) { return c.id == id; });
  EXPECT_NE(at, library().end()) << id;
  return at == library().end() ? library().front() : *at;
}

/// At a spindle that turns any speed: what the edge is started at.
double start_m_min(const std::string& id, const std::string& name) {
  model::Machine m = machine();
  m.spindle.rpm_max = 100000.0;
  return start_values(generic(id), material(name), m).vc_m_min;
}

model::ToolRequirement hole(CutterClass kind, double diameter_mm, double reach_mm) {
  model::ToolRequirement r;
  r.classes = {kind};
  r.diameter_exact_mm = diameter_mm;
  r.reach_mm = r.depth_of_cut_mm = reach_mm;
  return r;
}

TEST(CarbideDrills, ComeInTheSizesOfCoreHolesClearanceHolesAndBeforeReamers) {
  // ISO 2306, M4 to M22 coarse, and the usual fine ones; ISO 273 fine, medium and coarse, M3 to M16.
  const double core[] = {3.3, 4.2, 5, 6.8, 8.5, 10.2, 12, 14, 15.5, 17.5, 19.5, 7, 9, 8.8, 10.8, 10.5, 12.5};
  const double clear[] = {3.2, 3.4, 3.6, 4.3, 4.5, 4.8, 5.3,  5.5, 5.8,  6.4, 6.6,  7,
                          8.4, 9,   10,  11,  12,  13,  13.5, 15,  14.5, 17,  18.5, 16.5};
  const double reamed[] = {3.9, 4.8, 5.8, 6.8, 7.8, 8.8, 9.8, 10.8, 11.8, 12.8, 13.8, 14.8, 15.8, 17.8, 19.8};
  std::vector<double> sizes(std::begin(core), std::end(core));
  sizes.insert(sizes.end(), std::begin(clear), std::end(clear));
  sizes.insert(sizes.end(), std::begin(reamed), std::end(reamed));
  for (const double d : sizes) {
    for (const char* series : {"generic/drill_carbide/", "generic/drill_carbide_short/"}) {
      std::string id = std::to_string(d);
      id.erase(id.find_last_not_of('0') + 1);
      if (id.ends_with('.')) id.pop_back();
      const Cutter& c = generic(series + id);
      EXPECT_DOUBLE_EQ(c.cutting_diameter_mm, d);
      EXPECT_EQ(c.substrate, Substrate::kCarbide);
      EXPECT_NEAR(c.point_angle_rad, 140.0 * std::numbers::pi / 180.0, 1e-12);
    }
  }
}

TEST(CarbideDrills, AreHeldByTheirShanksBehindTheFlutesThatTheStandardGives) {
  // DIN 6537: flutes of a 6.6 mm drill 34 (K) and 53 mm (L), of a 10 mm drill 47 and 61 mm, on shanks of 8
  // and 10.
  EXPECT_DOUBLE_EQ(generic("generic/drill_carbide_short/6.6").maximum_depth_of_cut_mm, 34.0);
  EXPECT_DOUBLE_EQ(generic("generic/drill_carbide/6.6").maximum_depth_of_cut_mm, 53.0);
  EXPECT_DOUBLE_EQ(generic("generic/drill_carbide_short/10").maximum_depth_of_cut_mm, 47.0);
  EXPECT_DOUBLE_EQ(generic("generic/drill_carbide/10").maximum_depth_of_cut_mm, 61.0);
  std::size_t usual_ones = 0;
  for (const Cutter& c : library()) {
    if (!c.id.starts_with("generic/drill_carbide")) continue;
    EXPECT_GE(c.shank_diameter_mm, c.cutting_diameter_mm) << c.id;
    EXPECT_LT(c.usable_length_mm, c.maximum_depth_of_cut_mm) << c.id;
    const bool usual = c.cutting_diameter_mm >= 3.0 && c.cutting_diameter_mm <= 10.0;
    if (usual && c.id.find("short") == std::string::npos) {
      ++usual_ones;
      EXPECT_GE(c.usable_length_mm, 4.5 * c.cutting_diameter_mm) << c.id;
    }
  }
  EXPECT_GT(usual_ones, 0U);
}

TEST(CarbideDrills, RunWithinWhatAMakersTableAndShopsSay) {
  // Tungaloy catalogue 2020-21 p. 1339: 100 m/min in carbon steel of 200 HB, 50 in 304. Shops
  // (myshopmetrics.com, drilling): 150 to 200 sfm (46 to 61 m/min) in general, 80 to 130 (24 to 40) in 304.
  for (const char* id : {"generic/drill_carbide/6.6", "generic/drill_carbide_short/10"}) {
    EXPECT_GE(start_m_min(id, "C45"), 46.0);
    EXPECT_LE(start_m_min(id, "C45"), 100.0);
    EXPECT_GE(start_m_min(id, "304"), 24.0);
    EXPECT_LE(start_m_min(id, "304"), 50.0);
    // Aluminium is cut with bare edges: 0.8 times the card's 270.
    EXPECT_NEAR(start_m_min(id, "6061"), 216.0, 1e-9);
  }
}

TEST(CarbideReamers, RunWithinWhatShopsSay) {
  // myshopmetrics.com, reaming, sfm: steel 100 to 150 (carbide), 304 40 to 80, cast iron 60 to 120, 6061 200
  // to 400.
  const char* id = "generic/reamer_carbide_h7/8";
  EXPECT_GE(start_m_min(id, "C45"), 30.0);
  EXPECT_LE(start_m_min(id, "C45"), 46.0);
  EXPECT_GE(start_m_min(id, "304"), 12.0);
  EXPECT_LE(start_m_min(id, "304"), 24.5);
  EXPECT_GE(start_m_min(id, "GG25"), 18.0);
  EXPECT_LE(start_m_min(id, "GG25"), 37.0);
  EXPECT_GE(start_m_min(id, "6061"), 61.0);
  EXPECT_LE(start_m_min(id, "6061"), 122.0);
  const auto s = start_values(generic(id), material("C45"), machine());
  EXPECT_THAT(s.why.source, ::testing::HasSubstr("0.4 (myshopmetrics.com"));
}

TEST(FaceMills, RunAtTheSpeedsOfInserts) {
  // Iscar, indexable milling user guide 2022 p. 226, its general grade: C45 140 to 230 m/min, 304 90 to 160;
  // cast iron 220 to 320, from which we stay away.
  EXPECT_NEAR(start_m_min("generic/face_mill/50", "C45"), 2.2 * 78.0, 1e-9);
  EXPECT_NEAR(start_m_min("generic/face_mill/50", "304"), 2.2 * 44.0, 1e-9);
  EXPECT_NEAR(start_m_min("generic/face_mill/50", "GG25"), 3.0 * 60.0, 1e-9);
}

TEST(CarbideDrills, AreTakenWhereTheyReachAndTheBottomMayBeTheirs) {
  // An open hole, 30 mm deep: the long carbide drill; 18 mm: the short one; 50 mm: only HSS reaches.
  const auto taken = [](double reach_mm, double point_deg) {
    auto r = hole(CutterClass::kTwistDrill, 6.6, reach_mm);
    r.point_angle_rad = point_deg * std::numbers::pi / 180.0;
    const auto s = select(r, library(), material("304"), machine());
    return s.ranked.empty() ? std::string() : s.ranked.front().cutter.id;
  };
  EXPECT_EQ(taken(30.0, 0.0), "generic/drill_carbide/6.6");
  EXPECT_EQ(taken(18.0, 0.0), "generic/drill_carbide_short/6.6");
  EXPECT_EQ(taken(50.0, 0.0), "generic/drill_hss/6.6");
  // A bottom of 118 degrees is not made by a point of 140: it would leave 0.24 radii more on the axis.
  EXPECT_EQ(taken(18.0, 118.0), "generic/drill_hss/6.6");
  EXPECT_EQ(taken(18.0, 140.0), "generic/drill_carbide_short/6.6");
}

TEST(Complete, TakesTheBareSpeedOfADrillOfWhichNothingSaysThatItIsCoated) {
  Cutter c;
  c.id = "shop";
  c.cutter_class = CutterClass::kTwistDrill;
  c.substrate = Substrate::kCarbide;
  c.cutting_diameter_mm = c.shank_diameter_mm = 8.0;
  complete(c, library());
  // 0.8 of the card's 78 and 44 m/min; the generic one, coated, 1.3 times as much.
  EXPECT_NEAR(start_values(c, material("C45"), machine()).vc_m_min, 62.4, 1e-9);
  EXPECT_NEAR(start_values(c, material("304"), machine()).vc_m_min, 35.2, 1e-9);
  EXPECT_NEAR(start_values(generic("generic/drill_carbide/8"), material("C45"), machine()).vc_m_min, 81.12,
              1e-9);
  for (const auto& p : c.presets) {
    EXPECT_EQ(p.source.find(kCoated), std::string::npos) << p.source.text();
    EXPECT_EQ(p.source.find("x x"), std::string::npos) << p.source.text();
    EXPECT_NE(p.source.find("fz: "), std::string::npos) << p.source.text();
  }
}

TEST(ExpandSeries, RefusesAnEdgeThatTheTableDoesNotName) {
  Job job;
  std::string text = shipped_text("cutters.yaml");
  const auto at = text.find("edge: coated_drill");
  ASSERT_NE(at, std::string::npos);
  text.replace(at, 18, "edge: coated_auger");
  const auto got =
      expand_series({{"mine.yaml", parse_tree(text, "mine.yaml").value()}}, shipped_materials().value(), job);
  ASSERT_FALSE(got);
  EXPECT_EQ(got.error().code, "DATA-UNKNOWN");
  EXPECT_NE(got.error().message.find("coated_auger"), std::string::npos);
}

}  // namespace
}  // namespace capstan::tooling
