#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <string>

#include "planner/model/nouns/all.h"
#include "planner/model/requirements.h"
#include "planner/output/linuxcnc/probing.h"
#include "planner/pipeline/shop.h"
#include "tests/support/corpus.h"

namespace capstan::pipeline {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const Inputs& shop() {
  static const Inputs kShop = [] {
    Job job;
    auto in = load_shop({}, job);
    return in ? *std::move(in) : Inputs{};
  }();
  return kShop;
}

/// A block of 100 x 100 x 20 mm with its top at z = 0 and its middle at (50, 50), and `features` of #4 in it.
/// #50 is a placement in its middle, #53 a plane 5 mm, #56 one 10 mm below that.
std::string part_text(const std::string& features) {
  return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\n"
         "FILE_SCHEMA(('MACHINING_SCHEMA','MILLING_SCHEMA'));\nENDSEC;\nDATA;\n"
         "#1=PROJECT('PART',#2,(#4),$,$,$);\n#2=WORKPLAN('MAIN WORKPLAN',(),$,#8,$);\n"
         "#4=WORKPIECE('PART',#6,0.1,#5,$,$,());\n#5=WORKPIECE('RAW PIECE',#6,$,$,$,#26,());\n"
         "#6=MATERIAL('EN AW-6061','ALUMINIUM',());\n#8=SETUP('SETUP1',#28,#31,(#9));\n"
         "#9=WORKPIECE_SETUP(#4,#28,$,$,());\n#21=DIRECTION('',(0.,0.,1.));\n#22=DIRECTION('',(1.,0.,0.));\n"
         "#24=CARTESIAN_POINT('',(0.,0.,-20.));\n#25=AXIS2_PLACEMENT_3D('',#24,#21,#22);\n"
         "#26=BLOCK('RAW PIECE',#25,100.,100.,20.);\n#27=CARTESIAN_POINT('',(0.,0.,0.));\n"
         "#28=AXIS2_PLACEMENT_3D('',#27,#21,#22);\n#29=CARTESIAN_POINT('',(0.,0.,20.));\n"
         "#30=AXIS2_PLACEMENT_3D('',#29,#21,#22);\n#31=PLANE('',#30);\n"
         "#49=CARTESIAN_POINT('',(50.,50.,0.));\n#50=AXIS2_PLACEMENT_3D('',#49,#21,#22);\n"
         "#51=CARTESIAN_POINT('',(0.,0.,-5.));\n#52=AXIS2_PLACEMENT_3D('',#51,#21,#22);\n#53=PLANE('',#52);\n"
         "#54=CARTESIAN_POINT('',(0.,0.,-10.));\n#55=AXIS2_PLACEMENT_3D('',#54,#21,#22);\n#56=PLANE('',#55);"
         "\n"
         "#57=PLANAR_POCKET_BOTTOM_CONDITION();\n#58=THROUGH_BOTTOM_CONDITION();\n" +
         features + "ENDSEC;\nEND-ISO-10303-21;\n";
}

model::Plan read(const std::string& features) {
  Job job;
  auto plan = read_plan(part_text(features), "part.p21", job);
  EXPECT_TRUE(plan) << (plan ? "" : to_text(plan.error()));
  return plan ? *std::move(plan) : model::Plan{};
}

struct Planned {
  model::Plan plan;
  std::string said;  ///< diagnostics
};
Planned bound(model::Plan plan, const Inputs& in = shop()) {
  Job job;
  auto out = bind(std::move(plan), in, {}, job);
  EXPECT_TRUE(out) << (out ? "" : to_text(out.error()));
  Planned p{out ? *std::move(out) : model::Plan{}, {}};
  for (const auto& d : job.diagnostics()) p.said += to_text(d) + "\n";
  for (const auto& u : p.plan.unplanned) p.said += "unplanned: " + u.reason + "\n";
  return p;
}

/// Nearest and farthest that a cutter's flank comes to the axis through (50, 50) while it cuts.
struct Flank {
  double nearest = 1e300, farthest = 0.0;
};
Flank flank_of(const model::Plan& plan) {
  Flank out;
  for (const auto& s : plan.steps) {
    const double r = 0.5 * model::find_cutter(plan, s.cutter_id)->cutting_diameter_mm;
    for (std::size_t i = 0; s.path && i < s.path->size(); ++i) {
      if (s.path->z[i] > -1.0) continue;
      const double d = std::hypot(s.path->x[i] - 50.0, s.path->y[i] - 50.0);
      out.nearest = std::min(out.nearest, d - r);
      out.farthest = std::max(out.farthest, d + r);
    }
  }
  return out;
}

TEST(Aim, CutsAPocketOf20H7At20Point0105) {
  const Planned p =
      bound(read("#60=PLUS_MINUS_VALUE(0.021,0.,3);\n#61=TOLERANCED_LENGTH_MEASURE(20.,#60);\n"
                 "#62=CIRCULAR_CLOSED_PROFILE($,#61);\n"
                 "#63=CLOSED_POCKET('P',#4,(),#50,#53,(),$,#57,$,$,#62);\n"));
  ASSERT_FALSE(p.plan.steps.empty()) << p.said;
  EXPECT_NEAR(2.0 * flank_of(p.plan).farthest, 20.0105, 0.002);
}

TEST(Aim, CutsAnOutsideOf60H9At59Point963AndTheCheckHoldsItGood) {
  const Planned p =
      bound(read("#60=PLUS_MINUS_VALUE(0.,0.074,3);\n#61=TOLERANCED_LENGTH_MEASURE(60.,#60);\n"
                 "#62=CIRCULAR_CLOSED_PROFILE($,#61);\n"
                 "#63=GENERAL_OUTSIDE_PROFILE('O',#4,(),#50,#53,$,#62);\n"));
  ASSERT_FALSE(p.plan.steps.empty()) << p.said;
  EXPECT_NEAR(2.0 * flank_of(p.plan).nearest, 60.0 - 0.037, 0.002);
  Job job;
  for (const auto& f : findings_of(p.plan, job)) EXPECT_NE(f.code, "CHK-GOUGE") << f.message;
}

TEST(Aim, MovesOnlyTheSidesWhoseSizeIsToleranced) {
  // 60 along x without, 40 along y with a tolerance of +0.1 to +0.3: 40.2 wide, 60 long.
  const Planned p =
      bound(read("#60=PLUS_MINUS_VALUE(0.3,-0.1,3);\n#61=TOLERANCED_LENGTH_MEASURE(40.,#60);\n"
                 "#64=TOLERANCED_LENGTH_MEASURE(60.,$);\n#66=TOLERANCED_LENGTH_MEASURE(6.,$);\n"
                 "#62=RECTANGULAR_CLOSED_PROFILE($,#61,#64);\n"
                 "#63=CLOSED_POCKET('P',#4,(),#50,#53,(),$,#57,$,#66,#62);\n"));
  ASSERT_FALSE(p.plan.steps.empty()) << p.said;
  double x = 0.0, y = 0.0;
  for (const auto& s : p.plan.steps) {
    const double r = 0.5 * model::find_cutter(p.plan, s.cutter_id)->cutting_diameter_mm;
    for (std::size_t i = 0; i < s.path->size(); ++i) {
      if (s.path->z[i] > -1.0) continue;
      x = std::max(x, std::abs(s.path->x[i] - 50.0) + r);
      y = std::max(y, std::abs(s.path->y[i] - 50.0) + r);
    }
  }
  EXPECT_NEAR(2.0 * x, 60.0, 0.003);
  EXPECT_NEAR(2.0 * y, 40.2, 0.003);
}

const char* const kHole =
    "#60=PLUS_MINUS_VALUE(0.021,0.,3);\n#61=TOLERANCED_LENGTH_MEASURE(20.,#60);\n"
    "#63=ROUND_HOLE('H',#4,(),#50,#56,#61,$,#58);\n";

TEST(GeneralTolerance, ThatIsNotUnderstoodIsOneError) {
  Inputs in = shop();
  in.general_tolerance = "ISO 2768-x";
  Job job;
  const auto out = bind(read(kHole), in, {}, job);
  ASSERT_FALSE(out);
  EXPECT_EQ(out.error().code, "MDL-GENERAL");
}

TEST(GeneralTolerance, WiderThanTheCheckJudgesByIsSaid) {
  std::string text = part_text("");
  const std::string stated = "('PART',#6,0.1,";
  text.replace(text.find(stated), stated.size(), "('PART',#6,5.,");
  Job job;
  ASSERT_TRUE(read_plan(text, "part.p21", job));
  std::string said;
  for (const auto& d : job.diagnostics()) said += to_text(d) + "\n";
  EXPECT_THAT(said, HasSubstr("WORKPIECE.global_tolerance is 5 mm; kept, but the check judges by 0.5 mm"));
}

TEST(GeneralTolerance, DecidesTheChainOfWhatStatesNone) {
  const std::string plain =
      "#61=TOLERANCED_LENGTH_MEASURE(20.,$);\n#63=ROUND_HOLE('H',#4,(),#50,#56,#61,$,#58);\n";
  const auto reason = [&](const char* general) {
    Inputs in = shop();
    in.general_tolerance = general;
    const Planned p = bound(read(plain), in);
    EXPECT_FALSE(p.plan.steps.empty()) << p.said;
    const auto* d = p.plan.ledger.find(p.plan.steps.front().step, "its_operation");
    return d == nullptr ? std::string() : p.plan.ledger.reason(d->reason).text;
  };
  EXPECT_THAT(reason("ISO 2768-m"), HasSubstr("+-0.2 mm (ISO 2768-m)"));
  EXPECT_THAT(reason("ISO 2768-f"), HasSubstr("+-0.1 mm (ISO 2768-f)"));
}

TEST(Deviation, FollowsFromWhatAStepLeavesAndFromTheTolerance) {
  const Planned p =
      bound(read("#60=PLUS_MINUS_VALUE(0.03,0.,3);\n#61=TOLERANCED_LENGTH_MEASURE(40.,#60);\n"
                 "#62=CIRCULAR_CLOSED_PROFILE($,#61);\n"
                 "#63=CLOSED_POCKET('P',#4,(),#50,#53,(),$,#57,$,$,#62);\n"));
  ASSERT_GE(p.plan.steps.size(), 2U) << p.said;
  const auto& rough = p.plan.steps.front();
  const auto& finish = p.plan.steps.back();
  EXPECT_NEAR(finish.contour_tolerance_mm, 0.003, 1e-9) << "a tenth of 0.03";
  EXPECT_GT(rough.contour_tolerance_mm, finish.contour_tolerance_mm);
  Job job;
  const auto text = write_plan(p.plan, Format::kLinuxCnc, job);
  ASSERT_TRUE(text);
  EXPECT_THAT(*text, HasSubstr("G64 P0.003\n"));
}

/// Makes `datum` datum A and ties `feature` to it by a position tolerance.
void tie(model::Model& m, model::AnyRef datum, model::AnyRef feature, double value) {
  model::Datum a;
  const auto piece = model::Ref<model::Workpiece>(m.at<model::ManufacturingFeature>(feature).its_workpiece);
  a.identification = "A";
  a.its_workpiece = piece;
  a.established_by.push_back(model::Ref<model::ManufacturingFeature>(datum));
  model::DatumReference r;
  const auto made = m.add(a);
  r.referenced_datum = made;
  model::DatumSystem s;
  s.its_workpiece = piece;
  s.constituents.push_back(m.add(r));
  model::PositionTolerance t;
  t.tolerance_value = value;
  t.applied_to.push_back(model::Ref<model::ManufacturingFeature>(feature));
  t.its_datum_system = m.add(s);
  t.its_workpiece = piece;
  const auto tolerance = m.add(t);
  m.at<model::Workpiece>(piece).its_requirements.push_back(made);
  m.at<model::Workpiece>(piece).its_requirements.push_back(tolerance);
}

model::AnyRef feature(const model::Plan& plan, const std::string& id) {
  for (const auto r : plan.model.all_below(model::TypeId::kManufacturingFeature)) {
    if (plan.model.at<model::ManufacturingFeature>(r).its_id == id) return r;
  }
  return {};
}

const char* const kTwoHoles =
    "#61=TOLERANCED_LENGTH_MEASURE(8.,$);\n#63=ROUND_HOLE('H1',#4,(),#50,#56,#61,$,#58);\n"
    "#64=CARTESIAN_POINT('',(20.,20.,0.));\n#65=AXIS2_PLACEMENT_3D('',#64,#21,#22);\n"
    "#66=ROUND_HOLE('H2',#4,(),#65,#56,#61,$,#58);\n";

TEST(Datums, AreCutFirstAndTheReasonSaysSo) {
  model::Plan plan = read(kTwoHoles);
  tie(plan.model, feature(plan, "H2"), feature(plan, "H1"), 0.2);
  const Planned p = bound(std::move(plan));
  ASSERT_FALSE(p.plan.steps.empty()) << p.said;
  const auto* project = p.plan.model.get<model::Project>(p.plan.project);
  const auto* d = p.plan.ledger.find(project->main_workplan, "its_elements");
  ASSERT_NE(d, nullptr);
  EXPECT_THAT(p.plan.ledger.reason(d->reason).text,
              HasSubstr("datum A ('H2') first, before 'H1': position 0.2 | A"));
  std::vector<std::string> order;
  for (const auto& s : p.plan.steps) order.push_back(model::step_id(p.plan, s));
  const auto last_of = [&](const std::string& name) {
    const auto it =
        std::find_if(order.rbegin(), order.rend(), [&](const auto& n) { return n.starts_with(name); });
    return order.rend() - it;
  };
  const auto first_of = [&](const std::string& name) {
    const auto it =
        std::find_if(order.begin(), order.end(), [&](const auto& n) { return n.starts_with(name); });
    return it - order.begin() + 1;
  };
  EXPECT_LT(last_of("H2"), first_of("H1"));
}

TEST(Datums, GoThroughAp238AndDecideTheSame) {
  model::Plan plan = read(kTwoHoles);
  tie(plan.model, feature(plan, "H2"), feature(plan, "H1"), 0.04);
  Job job;
  const auto text = write_plan(plan, Format::kAp238, job);
  ASSERT_TRUE(text) << to_text(text.error());
  auto again = read_plan(*text, "part.stp", job);
  ASSERT_TRUE(again) << to_text(again.error());
  const auto q =
      model::quality_of(again->model, model::Ref<model::ManufacturingFeature>(feature(*again, "H1")));
  EXPECT_EQ(q.location_mm, 0.04);
  EXPECT_THAT(q.texts, ::testing::ElementsAre("position 0.04 | A"));
  const auto chain = [](const model::Plan& p) {
    std::vector<std::string> out;
    for (const auto& s : p.steps) out.push_back(model::step_id(p, s));
    return out;
  };
  const Planned first = bound(std::move(plan));
  const Planned second = bound(*std::move(again));
  EXPECT_EQ(chain(first.plan), chain(second.plan)) << second.said;
}

TEST(Ties, BetweenSidesThatOneSetUpDoesNotReachAreSaid) {
  // A blind pocket from below, and one from above that refers to it.
  model::Plan plan = read(
      "#61=TOLERANCED_LENGTH_MEASURE(30.,$);\n#62=CIRCULAR_CLOSED_PROFILE($,#61);\n"
      "#63=CLOSED_POCKET('ABOVE',#4,(),#50,#53,(),$,#57,$,$,#62);\n"
      "#70=DIRECTION('',(0.,0.,-1.));\n#71=CARTESIAN_POINT('',(50.,50.,-20.));\n"
      "#72=AXIS2_PLACEMENT_3D('',#71,#70,#22);\n"
      "#73=CLOSED_POCKET('BELOW',#4,(),#72,#53,(),$,#57,$,$,#62);\n");
  tie(plan.model, feature(plan, "BELOW"), feature(plan, "ABOVE"), 0.1);
  const Planned p = bound(std::move(plan));
  EXPECT_THAT(p.said, HasSubstr("PIP-TIED"));
  EXPECT_THAT(p.said, HasSubstr("'ABOVE' and 'BELOW' (datum A)"));
  EXPECT_THAT(p.said, HasSubstr("position 0.1 | A"));
}

TEST(Ties, TurnAThroughHoleToTheSideOfItsDatum) {
  model::Plan plan = read(
      "#61=TOLERANCED_LENGTH_MEASURE(30.,$);\n#62=CIRCULAR_CLOSED_PROFILE($,#61);\n"
      "#54000=CARTESIAN_POINT('',(0.,0.,-20.));\n#55000=AXIS2_PLACEMENT_3D('',#54000,#21,#22);\n"
      "#56000=PLANE('',#55000);\n#69=TOLERANCED_LENGTH_MEASURE(8.,$);\n"
      "#64=CARTESIAN_POINT('',(20.,20.,0.));\n#65=AXIS2_PLACEMENT_3D('',#64,#21,#22);\n"
      "#66=ROUND_HOLE('H',#4,(),#65,#56000,#69,$,#58);\n"
      "#70=DIRECTION('',(0.,0.,-1.));\n#71=CARTESIAN_POINT('',(50.,50.,-20.));\n"
      "#72=AXIS2_PLACEMENT_3D('',#71,#70,#22);\n"
      "#73=CLOSED_POCKET('BELOW',#4,(),#72,#53,(),$,#57,$,$,#62);\n");
  tie(plan.model, feature(plan, "BELOW"), feature(plan, "H"), 0.1);
  const Planned p = bound(std::move(plan));
  EXPECT_TRUE(p.plan.unplanned.empty()) << p.said;
  EXPECT_THAT(p.said, Not(HasSubstr("PIP-TIED")));
  for (const auto& s : p.plan.steps) EXPECT_EQ(s.setup, p.plan.steps.front().setup);
}

/// A touch as the plan says it: start, direction, and the distance expected.
struct Made {
  double x, y, z, dx, dy, dz, distance;
};
std::vector<Made> touches(const model::Plan& plan) {
  std::vector<Made> out;
  for (const auto r : plan.model.all(model::TypeId::kWorkpieceProbing)) {
    const auto& p = plan.model.at<model::WorkpieceProbing>(r);
    const auto& at = plan.model.at<model::Axis2Placement3d>(p.start_position);
    const auto& c = plan.model.at<model::CartesianPoint>(at.location).coordinates.items;
    const auto& d = plan.model.at<model::Direction>(p.direction).direction_ratios.items;
    const auto& e = plan.model.at<model::TolerancedLengthMeasure>(p.expected_value);
    out.push_back({c[0], c[1], c[2], d[0], d[1], d[2], e.theoretical_size.value_or(-1.0)});
  }
  return out;
}
double probe_radius(const model::Plan& plan) {
  for (const auto& c : plan.cutters) {
    if (c.cutter_class == model::CutterClass::kTouchProbe) return 0.5 * c.cutting_diameter_mm;
  }
  return 0.0;
}

/// What is planned for a feature whose position is asked within 0.02 mm and which refers to no datum.
Planned placed(const std::string& features, const std::string& id) {
  Inputs in = shop();
  in.machine.abilities.probe = true;
  model::Plan plan = read(features);
  model::PositionTolerance t;
  t.tolerance_value = 0.02;
  t.applied_to.push_back(model::Ref<model::ManufacturingFeature>(feature(plan, id)));
  plan.model.add(t);
  return bound(std::move(plan), in);
}

TEST(Probing, TouchesOppositeWallsOfAPocketInXAndY) {
  for (const char* bottom : {"#57", "#58"}) {  // its floor is never touched, and need not be there
    const Planned p = placed(
        "#61=TOLERANCED_LENGTH_MEASURE(40.,$);\n#64=TOLERANCED_LENGTH_MEASURE(60.,$);\n"
        "#66=TOLERANCED_LENGTH_MEASURE(8.,$);\n"
        "#62=RECTANGULAR_CLOSED_PROFILE($,#61,#64);\n"
        "#63=CLOSED_POCKET('P',#4,(),#50,#56,(),$," +
            std::string(bottom) + ",$,#66,#62);\n",
        "P");
    const auto made = touches(p.plan);
    ASSERT_EQ(made.size(), 4U) << p.said;
    const double ball = probe_radius(p.plan);
    double x = 0.0, y = 0.0;
    for (const Made& t : made) {
      EXPECT_NEAR(t.x, 50.0, 1e-6);
      EXPECT_NEAR(t.y, 50.0, 1e-6);
      EXPECT_NEAR(t.z, -5.0, 1e-6) << "below the top, above the floor";
      EXPECT_EQ(t.dz, 0.0);
      x += t.dx;
      y += t.dy;
      // What the last step takes off is still there.
      const double half = std::abs(t.dx) > 0.5 ? 30.0 : 20.0;
      EXPECT_LE(t.distance, half - ball + 1e-6);
      EXPECT_GT(t.distance, half - ball - 0.5);
    }
    EXPECT_EQ(x, 0.0);
    EXPECT_EQ(y, 0.0);
  }
}

TEST(Probing, OfAnOutsideStartsBesideItAndMovesInwards) {
  const Planned p = placed(
      "#61=TOLERANCED_LENGTH_MEASURE(60.,$);\n#62=CIRCULAR_CLOSED_PROFILE($,#61);\n"
      "#63=GENERAL_OUTSIDE_PROFILE('O',#4,(),#50,#56,$,#62);\n",
      "O");
  const auto made = touches(p.plan);
  ASSERT_EQ(made.size(), 4U) << p.said;
  const double ball = probe_radius(p.plan);
  for (const Made& t : made) {
    const double from = std::hypot(t.x - 50.0, t.y - 50.0);
    EXPECT_GT(from - ball, 30.0 + 5.0) << "not over what stands";
    EXPECT_LT((t.x - 50.0) * t.dx + (t.y - 50.0) * t.dy, 0.0) << "inwards";
    EXPECT_GE(from - ball - t.distance, 30.0 - 0.01);
    EXPECT_LT(from - ball - t.distance, 30.5);
    EXPECT_NEAR(t.z, -5.0, 1e-6);
  }
}

TEST(Probing, OfAFaceIsItsLevel) {
  const Planned p = placed(
      "#61=TOLERANCED_LENGTH_MEASURE(100.,$);\n#62=LINEAR_PROFILE($,#68);\n#68=NUMERIC_PARAMETER('PROFILE "
      "LENGTH',100.,'MM');\n"
      "#64=CARTESIAN_POINT('',(0.,0.,0.));\n#65=AXIS2_PLACEMENT_3D('',#64,#21,#22);\n"
      "#66=LINEAR_PATH($,#61,#67);\n#67=DIRECTION('',(0.,1.,0.));\n"
      "#63=PLANAR_FACE('F',#4,(),#65,#53,#66,#62,$,());\n",
      "F");
  const auto made = touches(p.plan);
  ASSERT_EQ(made.size(), 1U) << p.said;
  EXPECT_EQ(made[0].dz, -1.0);
  EXPECT_GT(made[0].z - made[0].distance - probe_radius(p.plan), -5.0 - 1e-9);
  EXPECT_LT(made[0].z - made[0].distance - probe_radius(p.plan), -4.0);
}

TEST(Probing, AFeatureWhosePlaceNobodyCanMeasureIsNotPlanned) {
  // A pocket over the whole width of another hole's wall: the hole's wall is not there at any height, so that
  // nothing tells whether the hole is within its 0.02 mm.
  const Planned p = placed(
      "#61=TOLERANCED_LENGTH_MEASURE(8.,$);\n#63=ROUND_HOLE('H1',#4,(),#50,#56,#61,$,#57000);\n"
      "#57000=FLAT_HOLE_BOTTOM();\n#64=TOLERANCED_LENGTH_MEASURE(40.,$);\n"
      "#62=CIRCULAR_CLOSED_PROFILE($,#64);\n"
      "#66=CLOSED_POCKET('P',#4,(),#50,#56,(),$,#57,$,$,#62);\n",
      "H1");
  EXPECT_TRUE(touches(p.plan).empty());
  ASSERT_EQ(p.plan.unplanned.size(), 1U) << p.said;
  EXPECT_EQ(p.plan.unplanned.front().feature, feature(p.plan, "H1"));
  EXPECT_THAT(p.plan.unplanned.front().reason,
              HasSubstr("'H1 probe_feature' cannot be made (along x and y there are no two walls"));
  EXPECT_THAT(p.plan.unplanned.front().reason, HasSubstr("nothing holds what is asked"));
}

TEST(Measuring, AChainThatLeansOnItIsNotUsedWhereNothingCanBeMeasured) {
  // IT6 of 20 mm is 13 um; the hole's wall is cut away by a pocket at every height.
  const Planned p =
      bound(read("#60=PLUS_MINUS_VALUE(0.013,0.,4);\n#61=TOLERANCED_LENGTH_MEASURE(20.,#60);\n"
                 "#63=ROUND_HOLE('H1',#4,(),#50,#56,#61,$,#57000);\n#57000=FLAT_HOLE_BOTTOM();\n"
                 "#64=TOLERANCED_LENGTH_MEASURE(40.,$);\n#62=CIRCULAR_CLOSED_PROFILE($,#64);\n"
                 "#66=CLOSED_POCKET('P',#4,(),#50,#56,(),$,#57,$,$,#62);\n"));
  EXPECT_TRUE(touches(p.plan).empty());
  ASSERT_EQ(p.plan.unplanned.size(), 1U) << p.said;
  EXPECT_THAT(
      p.plan.unplanned.front().reason,
      HasSubstr("'H1 measure' cannot be made (along x and y there are no two walls facing each other"));
  EXPECT_THAT(p.said, Not(HasSubstr("is not proposed")));
}

TEST(Measuring, AMilledSizeThatIsOffStopsTheProgramForNoRadiusActsInIt) {
  // IT6 of 20 mm is 13 um: a milled pocket.
  const auto program_of = [](const std::string& features) {
    const Planned p = bound(
        read("#60=PLUS_MINUS_VALUE(0.013,0.,4);\n#61=TOLERANCED_LENGTH_MEASURE(20.,#60);\n" + features));
    EXPECT_TRUE(p.plan.unplanned.empty()) << p.said;
    Job job;
    const auto text = write_plan(p.plan, Format::kLinuxCnc, job);
    EXPECT_TRUE(text) << p.said;
    return text ? *text : std::string();
  };
  const std::string milled = program_of(
      "#62=CIRCULAR_CLOSED_PROFILE($,#61);\n#63=CLOSED_POCKET('P',#4,(),#50,#53,(),$,#57,$,$,#62);\n");
  // 0.05 mm stay on each wall, so that 19.9 to 19.913 are right here.
  std::smatch m;
  ASSERT_TRUE(std::regex_search(
      milled, m,
      std::regex(
          R"(\(MSG, .*P measure.*, continue only when x is ([0-9.]+) to ([0-9.]+) and y is [0-9.]+ to )"
          R"([0-9.]+ mm; else stop here and plan again with the radius of T[0-9]+ as measured\))")))
      << milled;
  EXPECT_NEAR(std::stod(m[1]), 19.9, 1e-4);
  EXPECT_NEAR(std::stod(m[2]), 19.913, 1e-4);
  EXPECT_THAT(milled, HasSubstr("no G41 acts here"));
  EXPECT_THAT(milled, Not(HasSubstr("correct the work offset")));
  EXPECT_THAT(milled, Not(HasSubstr("correct the radius")));
}

/// How far from the middle of the piece each touch expects the wall, less what is still to be cut: of a round
/// feature the same on all sides.
std::vector<double> radii(const Planned& p) {
  std::vector<double> out;
  for (const Made& t : touches(p.plan)) {
    const double end = (t.x - 50.0) * t.dx + (t.y - 50.0) * t.dy + t.distance;
    out.push_back(end > 0.0 ? end + probe_radius(p.plan) : -(end + probe_radius(p.plan)));
  }
  return out;
}

TEST(Measuring, TheWallOfARoundFeatureIsExpectedOnItsCircleAndNotOnAChord) {
  // Chords of 1 um beside a circle of radius r span 2 acos(1 - 0.001 / r): 223 of them make a pocket of 20
  // mm, 385 an outside of 60 mm. Both are odd, so that a chord's middle lies where -x meets the outline.
  const std::string circle =
      "#80=CARTESIAN_POINT('',(0.,0.,0.));\n#81=AXIS2_PLACEMENT_3D('',#80,#21,#22);\n"
      "#82=CIRCLE('',#81,10.);\n#62=GENERAL_CLOSED_PROFILE($,#83);\n"
      "#83=TRIMMED_CURVE('',#82,(PARAMETER_VALUE(0.)),(PARAMETER_VALUE(360.)),.T.,.PARAMETER.);\n";
  const std::string pocket = "#63=CLOSED_POCKET('P',#4,(),#50,#53,(),$,#57,$,$,#62);\n";
  for (const auto& [features, id, radius] :
       {std::tuple("#61=TOLERANCED_LENGTH_MEASURE(20.,$);\n#62=CIRCULAR_CLOSED_PROFILE($,#61);\n" + pocket,
                   "P", 10.0),
        std::tuple(circle + pocket, "P", 10.0),
        std::tuple(std::string("#61=TOLERANCED_LENGTH_MEASURE(60.,$);\n#62=CIRCULAR_CLOSED_PROFILE($,#61);\n"
                               "#63=GENERAL_OUTSIDE_PROFILE('P',#4,(),#50,#56,$,#62);\n"),
                   "P", 30.0)}) {
    const Planned p = placed(features, id);
    const auto expected = radii(p);
    ASSERT_EQ(expected.size(), 4U) << p.said;
    // What the last step takes off is a round number of hundredths.
    const double left = std::round(100.0 * std::abs(radius - expected.front())) / 100.0;
    for (const double r : expected) EXPECT_NEAR(std::abs(r - radius), left, 2e-5) << features;
  }
}

TEST(ToolTable, HoldsNoToolOfAStepThatIsLeftOut) {
  // A flat hole in the middle of a pocket of the same depth: what its steps would cut is gone.
  const Planned p =
      bound(read("#61=TOLERANCED_LENGTH_MEASURE(8.,$);\n#63=ROUND_HOLE('H1',#4,(),#50,#56,#61,$,#57000);\n"
                 "#57000=FLAT_HOLE_BOTTOM();\n#64=TOLERANCED_LENGTH_MEASURE(40.,$);\n"
                 "#62=CIRCULAR_CLOSED_PROFILE($,#64);\n"
                 "#66=CLOSED_POCKET('P',#4,(),#50,#56,(),$,#57,$,$,#62);\n"));
  ASSERT_THAT(p.said, HasSubstr("PIP-GONE"));
  for (const auto& c : p.plan.cutters) {
    EXPECT_TRUE(std::any_of(p.plan.steps.begin(), p.plan.steps.end(), [&](const auto& s) {
      return s.cutter_id == c.id;
    })) << c.id;
  }
}

TEST(Requirements, OfAZoneOfZeroAreSaid) {
  model::Plan plan = read(kTwoHoles);
  tie(plan.model, feature(plan, "H2"), feature(plan, "H1"), 0.0);
  const Planned p = bound(std::move(plan));
  EXPECT_THAT(p.said, HasSubstr("POSITION_TOLERANCE of 'H1' has a zone of 0"));
}

TEST(Requirements, ThatNameNothingAreKeptAndSaid) {
  model::Plan plan = read(kTwoHoles);
  model::FlatnessTolerance t;
  t.tolerance_value = 0.001;  // what no cutter holds
  plan.model.add(t);
  const Planned p = bound(std::move(plan));
  EXPECT_TRUE(p.plan.unplanned.empty());
  EXPECT_THAT(p.said, HasSubstr("PIP-REQUIREMENT"));
  EXPECT_THAT(p.said, HasSubstr("flatness 0.001"));
}

TEST(Probing, StopsTheProgramBeforeTheLastStepWhereThePositionAsksForIt) {
  Inputs in = shop();
  in.machine.abilities.probe = true;
  model::Plan plan = read(kTwoHoles);
  tie(plan.model, feature(plan, "H2"), feature(plan, "H1"), 0.02);
  const Planned p = bound(std::move(plan), in);
  const auto probings = p.plan.model.all(model::TypeId::kWorkpieceProbing);
  ASSERT_EQ(probings.size(), 4U) << p.said;
  const auto before = output::probings_before(p.plan);
  ASSERT_EQ(before.size(), 1U) << "one stop";
  for (const auto& s : p.plan.steps) {
    if (s.step != before.begin()->first) continue;
    EXPECT_TRUE(model::step_id(p.plan, s).starts_with("H1")) << model::step_id(p.plan, s);
  }
  // Datum A is the finished hole H2 of 8 mm at (20, 20): from its axis to the wall, less the ball.
  const double ball = probe_radius(p.plan);
  EXPECT_GT(ball, 0.0);
  for (const Made& t : touches(p.plan)) {
    EXPECT_NEAR(t.distance, 4.0 - ball, 1e-9);
    EXPECT_NEAR(t.x, 20.0, 1e-9);
    EXPECT_NEAR(t.y, 20.0, 1e-9);
    // Stated 10 mm deep and right through, in a piece of 20 mm: it is cut to the underside.
    EXPECT_NEAR(t.z, -10.0, 1e-9) << "half way down";
  }
  Job job;
  const auto program = write_plan(p.plan, Format::kLinuxCnc, job);
  ASSERT_TRUE(program) << to_text(program.error());
  const auto stop = program->find("measure H1 probe_feature");
  ASSERT_NE(stop, std::string::npos);
  EXPECT_LT(program->rfind("M5", stop), stop);
  EXPECT_NE(program->find("M0", stop), std::string::npos);
  EXPECT_EQ(program->find("G38"), std::string::npos) << "no move of a probe is written";
  const std::vector<const char*> kNames{"WORKPIECE_PROBING", "workpiece probing", "workpiece_probing"};
  for (const Format f : {Format::kIso14649, Format::kAp238, Format::kJson}) {
    const auto text = write_plan(p.plan, f, job);
    ASSERT_TRUE(text) << to_text(text.error());
    const bool holds = std::any_of(kNames.begin(), kNames.end(),
                                   [&](const char* n) { return text->find(n) != std::string::npos; });
    EXPECT_TRUE(holds) << static_cast<int>(f);
  }
}

TEST(Probing, IsDoneByHandOnAMachineWithoutAProbe) {
  Inputs in = shop();
  in.machine.abilities.probe = false;
  model::Plan plan = read(kTwoHoles);
  tie(plan.model, feature(plan, "H2"), feature(plan, "H1"), 0.02);
  const Planned p = bound(std::move(plan), in);
  ASSERT_EQ(p.plan.model.all(model::TypeId::kWorkpieceProbing).size(), 4U);
  EXPECT_THAT(p.said, HasSubstr("PIP-PROBE"));
  for (const Made& t : touches(p.plan)) EXPECT_NEAR(t.distance, 4.0, 1e-9) << "no ball: to the wall itself";
  for (const auto& c : p.plan.cutters) EXPECT_NE(c.cutter_class, model::CutterClass::kTouchProbe);
  Job job;
  const auto program = write_plan(p.plan, Format::kLinuxCnc, job);
  ASSERT_TRUE(program);
  EXPECT_THAT(*program, HasSubstr("by hand, in the machine"));
}

TEST(Quality, OfTheAnnexJPartIsItsGeneralTolerance) {
  CAPSTAN_CORPUS_FILE(path, "ap238/ap238e4dis_annexJ_cc3.stp");
  Job job;
  const auto plan = read_plan(testing::slurp(path), "cc3.stp", job);
  ASSERT_TRUE(plan);
  for (const auto f : plan->model.all_below(model::TypeId::kManufacturingFeature))
    EXPECT_TRUE(model::quality_of(plan->model, model::Ref<model::ManufacturingFeature>(f)).texts.empty());
  EXPECT_TRUE(model::Attribution(plan->model).lost().empty());
  const auto pieces = plan->model.all(model::TypeId::kWorkpiece);
  std::vector<double> stated;
  for (const auto piece : pieces) {
    const auto g = model::general_tolerance_of(plan->model, model::Ref<model::Workpiece>(piece));
    ASSERT_TRUE(g);
    if (*g) stated.push_back(*model::general_size(**g, 50.0));
  }
  EXPECT_THAT(stated, ::testing::ElementsAre(0.01));
}

TEST(Quality, OfTheToolMakersFileIsNotAsked) {
  CAPSTAN_CORPUS_FILE(path, "ap238/exp2_stepnc_maker3_empty_ed3anchors.stpnc");
  Job job;
  const auto plan = read_plan(testing::slurp(path), "exp2.stpnc", job);
  ASSERT_TRUE(plan);
  for (const auto f : plan->model.all_below(model::TypeId::kManufacturingFeature))
    EXPECT_TRUE(model::quality_of(plan->model, model::Ref<model::ManufacturingFeature>(f)).texts.empty());
}

}  // namespace
}  // namespace capstan::pipeline
