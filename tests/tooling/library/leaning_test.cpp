// Cutters whose edges lean: face mills of 45 degrees, high-feed mills, drills with inserts.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/model/nouns/tool.h"
#include "tooling/library/cutters/complete.h"
#include "tooling/library/cutters/edge_kind.h"
#include "tooling/library/cutters/generic.h"
#include "tooling/library/formats/all.h"
#include "tooling/library/nouns/nouns.h"
#include "tooling/selection/select.h"
#include "tooling/shop/machine/machine.h"
#include "tooling/shop/material/material.h"

namespace capstan::tooling {
namespace {

using model::Cutter;
using model::CutterClass;
using ::testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180.0;

const std::vector<Cutter>& library() { return shared_generic_library().value(); }
const Cutter& generic(const std::string& id) {
  const auto at = std::find_if(library().begin(), library().end(), [&](const auto& c) { return c.id == id; });
  EXPECT_NE(at, library().end()) << id;
  return at == library().end() ? library().front() : *at;
}
model::WorkMaterial material(const std::string& name) {
  Job job;
  return find_material(name, shipped_materials().value(), job).value();
}
model::Machine machine() {
  Job job;
  return load_machine("generic_vmc", job).value();
}
double start_fz(const std::string& id, const std::string& name) {
  return start_values(generic(id), material(name), machine()).fz_mm;
}
model::Selection chosen(const model::ToolRequirement& r, const Preferences& p = {}) {
  return select(r, library(), material("C45"), machine(), p);
}
bool ranks(const model::Selection& s, const std::string& id) {
  return std::any_of(s.ranked.begin(), s.ranked.end(), [&](const auto& k) { return k.cutter.id == id; });
}
std::string why_not(const model::Selection& s, const std::string& id) {
  for (const auto& r : s.rejected)
    if (r.what == id) return r.why;
  return "";
}
Cutter read_back(const Cutter& c) {
  model::Model m;
  Job job;
  return cutter_from_nouns(m, nouns_from_cutter(m, c), job).value();
}

TEST(LeaningFaceMill, IsFedMoreByTheSineOfItsCuttingEdgeAngleAtTheSameChip) {
  for (const char* name : {"C45", "AISI 304", "EN-GJL-250", "EN AW-6061", "Ti6Al4V"}) {
    const double chip = start_fz("generic/face_mill/63", name);
    EXPECT_NEAR(start_fz("generic/face_mill_45/63", name) * std::sin(45.0 * kDegree), chip, 0.02 * chip)
        << name;
  }
  // Sandvik Coromant, milling, cutting data (scribd.com/document/148335613): steel of 180 HB, kappa 45
  // degrees, hex 0.17 mm: fz = 0.17 / sin 45 = 0.24 mm. Ours is no higher, and no less than three quarters of
  // it.
  EXPECT_LE(start_fz("generic/face_mill_45/125", "C45"), 0.24);
  EXPECT_GE(start_fz("generic/face_mill_45/125", "C45"), 0.75 * 0.24);
}

TEST(LeaningFaceMill, IsWiderAtTheTopOfItsEdgesThanAtItsTip) {
  // ISO 13399: DCX = DC + 2 APMX tan PSIR.
  EXPECT_NEAR(2.0 * model::profile_of(generic("generic/face_mill_45/63")).radius_mm, 63.0 + 2.0 * 5.0, 1e-9);
  EXPECT_NEAR(2.0 * model::profile_of(generic("generic/high_feed_mill/DCX63")).radius_mm, 63.0, 0.05);
  EXPECT_NEAR(2.0 * model::profile_of(generic("generic/high_feed_mill/DCX32")).radius_mm, 32.0, 0.05);
}

TEST(LeaningFaceMill, KeepsItsCuttingEdgeAngleInANoun) {
  for (const char* id :
       {"generic/face_mill_45/63", "generic/high_feed_mill/DCX63", "generic/high_feed_mill/DCX25"}) {
    const Cutter& c = generic(id);
    const Cutter read = read_back(c);
    EXPECT_EQ(read.cutter_class, CutterClass::kFacemill) << id;
    EXPECT_NEAR(read.lead_angle_rad, c.lead_angle_rad, 1e-12) << id;
  }
  EXPECT_EQ(read_back(generic("generic/face_mill/63")).lead_angle_rad, 0.0);
}

TEST(LeaningFaceMill, KeepsItsAngleInEachFormatThatIsReadAndWrittenAndHasFaceMills) {
  const std::vector<Cutter> mills = {generic("generic/face_mill_45/63"),
                                     generic("generic/high_feed_mill/DCX50")};
  for (const Format* f : {&fusion_format(), &fusion_json_format(), &csv_format(), &own_format(),
                          &store_format(), &iso13399_format()}) {
    Job job;
    const auto written = f->write(library_of(mills, "l"), {}, job);
    ASSERT_TRUE(written) << f->name;
    auto read = f->read(written->bytes, "library", {}, job);
    ASSERT_TRUE(read) << f->name << ": " << read.error().message;
    const auto cutters = cutters_of(read->library, read->report, job);
    ASSERT_TRUE(cutters) << f->name << ": " << cutters.error().message;
    ASSERT_EQ(cutters->size(), mills.size()) << f->name;
    for (std::size_t i = 0; i < mills.size(); ++i)
      EXPECT_NEAR(cutters->at(i).lead_angle_rad, mills[i].lead_angle_rad, 1e-9) << f->name << " " << i;
  }
}

TEST(HighFeedMill, TakesShallowLayersAtSeveralTimesTheFeedOfAnUprightEdge) {
  for (const char* name : {"C45", "AISI 304", "EN-GJL-250"}) {
    const double upright = start_fz("generic/face_mill/50", name),
                 leaning = start_fz("generic/high_feed_mill/DCX50", name);
    EXPECT_GT(leaning, 3.0 * upright) << name;
    EXPECT_LT(leaning * std::sin(12.0 * kDegree), upright) << name << ": and a thinner chip";
  }
  EXPECT_LE(generic("generic/high_feed_mill/DCX50").maximum_depth_of_cut_mm, 1.5);
}

TEST(HighFeedMill, RoughsAndNeverFinishes) {
  model::ToolRequirement r;
  r.classes = {CutterClass::kFacemill};
  r.reach_mm = 5;
  Preferences rough;
  rough.roughs = true;
  EXPECT_TRUE(ranks(chosen(r, rough), "generic/high_feed_mill/DCX50"));
  EXPECT_THAT(why_not(chosen(r), "generic/high_feed_mill/DCX50"), HasSubstr("lean by 78 deg"));
  EXPECT_TRUE(ranks(chosen(r), "generic/face_mill_45/50")) << "45 degrees leave a plane";
}

// A layer of a millimetre and a half is as deep as its edges; a deeper one is two of its layers and one of
// others.
TEST(HighFeedMill, IsTakenForAThinLayerWhereTheSpindleHasThePowerForItsFeed) {
  model::ToolRequirement r;
  r.classes = {CutterClass::kFacemill};
  r.reach_mm = 5;
  const auto first = [&](double depth_mm, double times) {
    Preferences p;
    p.roughs = true;
    p.depth_mm = depth_mm;
    p.volume_mm3 = 300.0 * 200.0 * depth_mm;
    model::Machine m = machine();
    for (auto& at : m.spindle.curve) {
      at.power_w *= times;
      at.torque_nm *= times;
    }
    return select(r, library(), material("C45"), m, p).ranked.at(0).cutter;
  };
  constexpr double kStrong = 4.0;  // 30 kW
  EXPECT_TRUE(feeds_high(first(1.5, kStrong)));
  EXPECT_FALSE(feeds_high(first(6.0, kStrong)));
}

TEST(DrillWithInserts, IsTakenWhereARequirementLetsAPointBeLevel) {
  model::ToolRequirement r;
  r.classes = {CutterClass::kTwistDrill};
  r.diameter_exact_mm = 22;
  r.reach_mm = r.depth_of_cut_mm = 40;
  EXPECT_THAT(why_not(chosen(r), "generic/drill_insert/22"), HasSubstr("IT13 and coarser"));
  r.point_angle_most_rad = std::numbers::pi;
  const auto s = chosen(r);
  ASSERT_FALSE(s.ranked.empty());
  EXPECT_EQ(s.ranked.front().cutter.id, "generic/drill_insert/22") << "quicker than high-speed steel";
  r.spot_angle_rad = 90.0 * kDegree;
  EXPECT_THAT(why_not(chosen(r), "generic/drill_insert/22"), HasSubstr("spot of 90 deg"));
}

TEST(DrillWithInserts, ReachesThreeAndFiveDiametersFromFourteenMillimetresUp) {
  for (const Cutter& c : library()) {
    if (!drills_with_inserts(c)) continue;
    EXPECT_GE(c.cutting_diameter_mm, 14.0) << c.id;
    EXPECT_EQ(c.teeth, 1) << c.id << ": two inserts share the radius";
    EXPECT_LE(reach_of(c), 5.0 * c.cutting_diameter_mm + 1e-9) << c.id;
    EXPECT_GE(reach_of(c), 3.0 * c.cutting_diameter_mm - 1e-9) << c.id;
    // Half a millimetre of tip at 14 mm, and 1.4 at 40: it may drill to a bottom that is milled level.
    EXPECT_LT(model::tip_length(c), 0.04 * c.cutting_diameter_mm) << c.id;
  }
  EXPECT_TRUE(drills_with_inserts(generic("generic/drill_insert/14")));
  EXPECT_TRUE(drills_with_inserts(generic("generic/drill_insert_long/32")));
  EXPECT_FALSE(drills_with_inserts(generic("generic/drill_carbide/20")));
}

TEST(DrillWithInserts, IsNoGunDrillWhenItIsReadFromANoun) {
  const Cutter read = read_back(generic("generic/drill_insert/22"));
  EXPECT_EQ(read.cutter_class, CutterClass::kTwistDrill);
  EXPECT_NEAR(read.point_angle_rad, 172.0 * kDegree, 1e-9);
  EXPECT_EQ(read.teeth, 1);
  EXPECT_EQ(read_back(generic("generic/gun_drill/10")).cutter_class, CutterClass::kGunDrill);
}

TEST(CompletedCutter, TakesLengthsAndFeedsOfOneWhoseEdgesLeanAlike) {
  Cutter face;
  face.id = "shop";
  face.cutter_class = CutterClass::kFacemill;
  face.cutting_diameter_mm = 63;
  Cutter leaning = face;
  leaning.lead_angle_rad = 45.0 * kDegree;
  complete(face, library());
  complete(leaning, library());
  EXPECT_EQ(face.maximum_depth_of_cut_mm, generic("generic/face_mill/63").maximum_depth_of_cut_mm);
  EXPECT_EQ(leaning.maximum_depth_of_cut_mm, generic("generic/face_mill_45/63").maximum_depth_of_cut_mm);
  Cutter drill;
  drill.id = "shop drill";
  drill.cutter_class = CutterClass::kTwistDrill;
  drill.substrate = model::Substrate::kCarbide;
  drill.cutting_diameter_mm = 22;
  complete(drill, library());
  EXPECT_LT(drill.point_angle_rad, 150.0 * kDegree) << "that it has inserts is never assumed";
}

}  // namespace
}  // namespace capstan::tooling
