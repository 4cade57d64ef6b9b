#include "tooling/library/nouns/nouns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "planner/model/nouns/tool.h"
#include "planner/model/nouns/workpiece.h"
#include "tooling/library/cutters/complete.h"
#include "tooling/library/cutters/generic.h"
#include "tooling/selection/select.h"

namespace capstan::tooling {
namespace {

using model::Cutter;
using model::CutterClass;
using model::Model;
using model::Ref;

constexpr double kDegree = std::numbers::pi / 180.0;

const std::vector<Cutter>& library() {
  static const std::vector<Cutter> kLibrary = generic_library().value();
  return kLibrary;
}

/// A tool as files give it: a body of that kind, a diameter, and one cutting edge.
template <class BodyKind>
model::Ref<model::MillingCuttingTool> given_tool(Model& m, double diameter_mm, double top_angle_deg = 0.0) {
  const auto dimension = m.add<model::MillingToolDimension>();
  auto& d = m.at<model::MillingToolDimension>(dimension);
  d.diameter = diameter_mm;
  d.tool_top_angle = top_angle_deg * kDegree;
  d.cutting_edge_length = 40.0;
  const auto body = m.add<BodyKind>();
  m.at<BodyKind>(body).dimension = dimension;
  m.at<BodyKind>(body).number_of_teeth = 2;
  const auto edge = m.add<model::CuttingComponent>();
  m.at<model::CuttingComponent>(edge).tool_offset_length = 90.0;
  const auto tool = m.add<model::MillingCuttingTool>();
  auto& t = m.at<model::MillingCuttingTool>(tool);
  t.its_id = "tool";
  t.its_tool_body = body;
  t.its_cutting_edge.push_back(edge);
  return tool;
}

TEST(CutterFromNouns, ReadsADrillWhoseTopAngleIsTheComplement) {
  Model m;
  Job job;
  // 31 degrees: twice is 62, no drill; 180 - 62 is 118.
  const auto c = cutter_from_nouns(m, given_tool<model::TwistDrill>(m, 20.0, 31.0), job).value();
  EXPECT_EQ(c.cutter_class, CutterClass::kTwistDrill);
  EXPECT_NEAR(c.point_angle_rad / kDegree, 118.0, 1e-9);
  EXPECT_DOUBLE_EQ(c.functional_length_mm, 90.0);
  EXPECT_TRUE(source_of(c, "stick_out_mm")->starts_with("derived"));
  EXPECT_TRUE(source_of(c, "point_angle_rad")->starts_with("derived"));
  EXPECT_EQ(job.count(Severity::kNote), 1u);
}

struct Angle {
  double stored_deg, point_deg;
  CutterClass cutter_class;
};

TEST(PointAngleFrom, TakesTheReadingThatIsAUsualPoint) {
  const Angle cases[] = {{59, 118, CutterClass::kTwistDrill},  {31, 118, CutterClass::kTwistDrill},
                         {20, 140, CutterClass::kTwistDrill},  {70, 140, CutterClass::kTwistDrill},
                         {118, 118, CutterClass::kTwistDrill}, {45, 90, CutterClass::kCountersink},
                         {30, 60, CutterClass::kCenterDrill},  {41, 82, CutterClass::kCountersink},
                         {5, 0, CutterClass::kTwistDrill},     {0, 0, CutterClass::kTwistDrill}};
  for (const Angle& a : cases) {
    std::string reading;
    EXPECT_NEAR(point_angle_from(a.stored_deg * kDegree, a.cutter_class, reading) / kDegree, a.point_deg,
                1e-9)
        << a.stored_deg;
    EXPECT_FALSE(reading.empty());
  }
}

TEST(CutterFromNouns, TakesATinyFaceMillAsAnEndMillAndSaysSo) {
  Model m;
  Job job;
  const auto c = cutter_from_nouns(m, given_tool<model::Facemill>(m, 6.0), job).value();
  EXPECT_EQ(c.cutter_class, CutterClass::kEndmill);
  EXPECT_FALSE(c.centre_cutting);
  ASSERT_EQ(job.count(Severity::kWarning), 1u);
  EXPECT_EQ(cutter_from_nouns(m, given_tool<model::Facemill>(m, 63.0), job)->cutter_class,
            CutterClass::kFacemill);
}

TEST(CutterFromNouns, TakesATaperedKindWithoutATaperAsPlain) {
  Model m;
  Job job;
  const auto tool = given_tool<model::TaperedEndmill>(m, 18.0);
  EXPECT_EQ(cutter_from_nouns(m, tool, job)->cutter_class, CutterClass::kEndmill);
  m.at<model::TaperedEndmill>(m.at<model::CuttingTool>(tool).its_tool_body).taper_angle = 3.0 * kDegree;
  const auto tapered = cutter_from_nouns(m, tool, job).value();
  EXPECT_EQ(tapered.cutter_class, CutterClass::kTaperedEndmill);
  EXPECT_DOUBLE_EQ(tapered.taper_angle_rad, 3.0 * kDegree);
  // 40 mm of flutes on a tip of 18 mm: 9 + 40 tan 3 deg at the top.
  EXPECT_NEAR(model::profile_of(tapered).height(9.0 + 20.0 * std::tan(3.0 * kDegree)), 20.0, 1e-9);
}

TEST(CutterFromNouns, StartsAGivenHssMillAtTheMaterialsHssSpeed) {
  Model m;
  Job job;
  const auto c = cutter_from_nouns(m, given_tool<model::Endmill>(m, 18.0), job).value();
  EXPECT_EQ(c.substrate, model::Substrate::kHss);  // nothing says carbide
  for (const auto& p : c.presets) EXPECT_EQ(p.vc_m_min, 0.0);
  model::WorkMaterial w;
  w.iso_group = "P";
  w.vc_hss_m_min = 25.0;
  w.vc_carbide_m_min = 70.0;
  model::Machine machine;
  machine.spindle.rpm_max = 10000.0;
  EXPECT_NEAR(start_values(c, w, machine).vc_m_min, 25.0, 1e-9);
}

TEST(CutterFromNouns, FailsWhereThereIsNothingToGoBy) {
  Model m;
  Job job;
  EXPECT_EQ(cutter_from_nouns(m, {}, job).error().code, "TOOL-NONE");
  const auto bare = m.add<model::MillingCuttingTool>();
  EXPECT_EQ(cutter_from_nouns(m, bare, job).error().code, "TOOL-BODY");
  EXPECT_EQ(cutter_from_nouns(m, given_tool<model::Endmill>(m, 0.0), job).error().code, "TOOL-VALUE");
  EXPECT_EQ(cutter_from_nouns(m, given_tool<model::Endmill>(m, -6.0), job).error().code, "TOOL-VALUE");
  EXPECT_EQ(cutter_from_nouns(m, given_tool<model::SideMill>(m, 60.0), job).error().code, "TOOL-KIND");
}

TEST(RoundTrip, GivesEveryLibraryCutterBackThroughItsReference) {
  Job job;
  int pocket = 0;
  for (Cutter c : library()) {
    c.pocket = ++pocket;
    Model m;
    const auto tool = nouns_from_cutter(m, c);
    EXPECT_FALSE(is_requirement(m, tool)) << c.id;
    const auto back = cutter_from_nouns(m, tool, job, library());
    ASSERT_TRUE(back) << c.id << ": " << to_text(back.error());
    EXPECT_EQ(*back, c) << c.id;
  }
  EXPECT_TRUE(job.diagnostics().empty());
}

TEST(RoundTrip, KeepsWhatTheNounsHoldWithoutTheLibrary) {
  for (const Cutter& c : library()) {
    Job job;
    Model m;
    const auto back = cutter_from_nouns(m, nouns_from_cutter(m, c), job);
    ASSERT_TRUE(back) << c.id << ": " << to_text(back.error());
    EXPECT_EQ(back->id, c.id);
    EXPECT_EQ(back->description, c.description);
    EXPECT_DOUBLE_EQ(back->cutting_diameter_mm, c.cutting_diameter_mm) << c.id;
    EXPECT_DOUBLE_EQ(back->corner_radius_mm, c.corner_radius_mm) << c.id;
    EXPECT_NEAR(back->point_angle_rad, c.point_angle_rad, 1e-12) << c.id;
    EXPECT_DOUBLE_EQ(back->maximum_depth_of_cut_mm, c.maximum_depth_of_cut_mm) << c.id;
    EXPECT_DOUBLE_EQ(back->functional_length_mm, c.functional_length_mm) << c.id;
    EXPECT_EQ(back->teeth, c.teeth) << c.id;
    if (c.cutter_class != CutterClass::kTouchProbe) {
      EXPECT_EQ(back->substrate, c.substrate) << c.id;
    }
    EXPECT_EQ(back->hand, c.hand) << c.id;
    EXPECT_EQ(back->thread_form, c.thread_form) << c.id;
    EXPECT_DOUBLE_EQ(back->thread_size_mm, c.thread_size_mm) << c.id;
    EXPECT_DOUBLE_EQ(back->thread_pitch_mm, c.thread_pitch_mm) << c.id;
    EXPECT_DOUBLE_EQ(back->lead_threads, c.lead_threads) << c.id;
    EXPECT_DOUBLE_EQ(back->lead_length_mm, c.lead_length_mm) << c.id;
    EXPECT_DOUBLE_EQ(back->taper_angle_rad, c.taper_angle_rad) << c.id;
    const bool chamfer = c.cutter_class == CutterClass::kChamferMill;  // the standard has none
    EXPECT_EQ(back->cutter_class, chamfer ? CutterClass::kCountersink : c.cutter_class) << c.id;
  }
}

TEST(RoundTrip, KeepsWhereAToolSitsWhatItIsAndHowLongItWasMeasured) {
  Job job;
  Cutter c = library().front();
  c.id = "T12 drill";
  c.pocket = 12;
  c.carousel = "left";
  c.product_id = "8041.100";
  c.library_reference = "0112/1///13399__003#71EAD3871D313";
  c.library_source = "ISO 13399-3";
  Model m;
  const auto tool = nouns_from_cutter(m, c);
  m.at<model::MillingCuttingTool>(Ref<model::MillingCuttingTool>(tool)).overall_assembly_length.reset();
  const auto back = cutter_from_nouns(m, tool, job).value();
  EXPECT_EQ(back.id, "T12 drill");
  EXPECT_EQ(back.pocket, 12);
  EXPECT_EQ(back.carousel, "left");
  EXPECT_EQ(back.product_id, "8041.100");
  EXPECT_EQ(back.library_reference, c.library_reference);
  EXPECT_EQ(back.library_source, "ISO 13399-3");
  EXPECT_DOUBLE_EQ(back.functional_length_mm, c.functional_length_mm);
  EXPECT_EQ(*source_of(back, "functional_length_mm"), "stated: gage_placement and tool_end_placement");
  EXPECT_TRUE(job.diagnostics().empty());
}

TEST(CutterFromNouns, TakesTheMeasuredLengthWhereTheStatedOneDiffersAndSaysSo) {
  Job job;
  const Cutter c = library().front();
  Model m;
  const auto tool = nouns_from_cutter(m, c);
  m.at<model::MillingCuttingTool>(Ref<model::MillingCuttingTool>(tool)).overall_assembly_length = 222.0;
  EXPECT_DOUBLE_EQ(cutter_from_nouns(m, tool, job)->functional_length_mm, c.functional_length_mm);
  EXPECT_EQ(job.count(Severity::kWarning), 1u);
}

TEST(CutterFromNouns, FindsALibraryToolByItsLinkAndByItsProduct) {
  Job job;
  auto shop = library();
  shop[3].library_reference = "PLIB 4711";
  shop[5].product_id = "ord-no 5";
  Model m;
  Cutter by_link = shop[3], by_product = shop[5];
  by_link.id = by_product.id = "as the file calls it";
  EXPECT_EQ(cutter_from_nouns(m, nouns_from_cutter(m, by_link), job, shop)->id, shop[3].id);
  EXPECT_EQ(cutter_from_nouns(m, nouns_from_cutter(m, by_product), job, shop)->id, shop[5].id);
}

TEST(RoundTrip, LetsTheFileHoldWhenTheLibrarySaysOtherwise) {
  Job job;
  Model m;
  const Cutter c = library().front();
  const auto tool = nouns_from_cutter(m, c);
  const auto body = m.at<model::CuttingTool>(tool).its_tool_body;
  m.at<model::MillingToolDimension>(m.at<model::MillingToolBody>(body).dimension).diameter = 1.05;
  EXPECT_DOUBLE_EQ(cutter_from_nouns(m, tool, job, library())->cutting_diameter_mm, 1.05);
  EXPECT_EQ(job.count(Severity::kWarning), 1u);
}

TEST(Requirement, SurvivesBeingWritten) {
  model::ToolRequirement r;
  r.classes = {CutterClass::kTwistDrill};
  r.diameter_exact_mm = 8.5;
  r.depth_of_cut_mm = r.reach_mm = 30.0;
  r.point_angle_rad = 118.0 * kDegree;
  Model m;
  Job job;
  const auto tool = nouns_from_requirement(m, r);
  EXPECT_TRUE(is_requirement(m, tool));
  const auto back = requirement_from_nouns(m, tool, job).value();
  EXPECT_EQ(back.classes, r.classes);
  EXPECT_DOUBLE_EQ(back.diameter_exact_mm, 8.5);
  EXPECT_DOUBLE_EQ(back.reach_mm, 30.0);
  EXPECT_NEAR(back.point_angle_rad, r.point_angle_rad, 1e-12);
}

TEST(Requirement, OfALeftHandTapStaysLeft) {
  model::ToolRequirement r;
  r.classes = {CutterClass::kTap};
  r.diameter_exact_mm = 8.0;
  for (const bool left : {true, false}) {
    r.left_hand = left;
    Model m;
    Job job;
    EXPECT_EQ(requirement_from_nouns(m, nouns_from_requirement(m, r), job).value().left_hand, left);
  }
}

TEST(Requirement, LeavesASmallerMillPossible) {
  model::ToolRequirement r;
  r.classes = {CutterClass::kEndmill};
  r.diameter_max_mm = 12.0;
  r.corner_radius_limited = true;
  Model m;
  Job job;
  const auto back = requirement_from_nouns(m, nouns_from_requirement(m, r), job).value();
  EXPECT_DOUBLE_EQ(back.diameter_max_mm, 12.0);
  EXPECT_DOUBLE_EQ(back.diameter_min_mm, 6.0);
  EXPECT_TRUE(back.corner_radius_limited);
}

TEST(IsRequirement, TakesAnAssembledToolAsGiven) {
  Model m;
  const auto tool = given_tool<model::Endmill>(m, 6.0);
  EXPECT_FALSE(is_requirement(m, tool));
  auto& t = m.at<model::MillingCuttingTool>(tool);
  t.its_cutting_edge.items.clear();
  EXPECT_TRUE(is_requirement(m, tool));
  t.overall_assembly_length = 80.0;
  EXPECT_FALSE(is_requirement(m, tool));
  EXPECT_TRUE(is_requirement(m, {}));
}

}  // namespace
}  // namespace capstan::tooling
