#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <string>
#include <tuple>
#include <vector>

#include "planner/controls/gcode/probing.h"
#include "tests/door/pipeline/block.h"

// Measuring in the process: where is touched, what is expected there, and what becomes of what cannot be
// measured.

namespace capstan::pipeline {
namespace {

using namespace block;
using ::testing::HasSubstr;
using ::testing::Not;

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
  for (const char* bottom : {"#57", "#59"}) {  // its floor is never touched, and need not be there
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
  EXPECT_THAT(p.plan.unplanned.front().reason, HasSubstr("nothing holds the requirement"));
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

TEST(Measuring, WithoutAProbeNoBallIsBlamed) {
  // As above, on a machine that has none.
  Inputs in = shop();
  in.machine.abilities.probe = false;
  const Planned p =
      bound(read("#60=PLUS_MINUS_VALUE(0.013,0.,4);\n#61=TOLERANCED_LENGTH_MEASURE(20.,#60);\n"
                 "#63=ROUND_HOLE('H1',#4,(),#50,#56,#61,$,#57000);\n#57000=FLAT_HOLE_BOTTOM();\n"
                 "#64=TOLERANCED_LENGTH_MEASURE(40.,$);\n#62=CIRCULAR_CLOSED_PROFILE($,#64);\n"
                 "#66=CLOSED_POCKET('P',#4,(),#50,#56,(),$,#57,$,$,#62);\n"),
            in);
  EXPECT_THAT(p.said, Not(HasSubstr("ball of 0 mm")));
  EXPECT_THAT(p.said, HasSubstr("that a gauge is known to reach freely"));
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

TEST(Probing, StopsTheProgramBeforeTheLastStepWhereThePositionAsksForIt) {
  Inputs in = shop();
  in.machine.abilities.probe = true;
  model::Plan plan = read(kTwoHoles);
  tie(plan.model, feature(plan, "H2"), feature(plan, "H1"), 0.02);
  const Planned p = bound(std::move(plan), in);
  const auto probings = p.plan.model.all(model::TypeId::kWorkpieceProbing);
  ASSERT_EQ(probings.size(), 4U) << p.said;
  const auto before = controls::gcode::probings_before(p.plan);
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

}  // namespace
}  // namespace capstan::pipeline
