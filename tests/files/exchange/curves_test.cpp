#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <regex>
#include <sstream>

#include "planner/files/exchange/toolpaths/curves.h"
#include "tests/files/exchange/support.h"
#include "tests/support/corpus.h"

namespace capstan::exchange {
namespace {

using model::CutterPath;
using model::MoveKind;
using model::MoveRole;

using testing::read_text;

constexpr CurveOptions kOptions;

/// One motion of the published interpreter's output.
struct Motion {
  bool rapid = false;
  bool arc = false;
  geometry::Vec3 to;
  geometry::Vec2 centre;
  int turns = 0;  // ARC_FEED's rotation: positive counter-clockwise
};

std::vector<Motion> motions(const std::string& text) {
  std::vector<Motion> out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    Motion m;
    auto& p = m.to;
    if (const auto at = line.find("STRAIGHT_FEED("); at != std::string::npos) {
      std::sscanf(line.c_str() + at, "STRAIGHT_FEED(%lf, %lf, %lf)", &p.x, &p.y, &p.z);
    } else if (const auto t = line.find("STRAIGHT_TRAVERSE("); t != std::string::npos) {
      m.rapid = true;
      std::sscanf(line.c_str() + t, "STRAIGHT_TRAVERSE(%lf, %lf, %lf)", &p.x, &p.y, &p.z);
    } else if (const auto a = line.find("ARC_FEED("); a != std::string::npos) {
      m.arc = true;
      std::sscanf(line.c_str() + a, "ARC_FEED(%lf, %lf, %lf, %lf, %d, %lf)", &p.x, &p.y, &m.centre.x,
                  &m.centre.y, &m.turns, &p.z);
    } else {
      continue;
    }
    out.push_back(m);
  }
  return out;
}

TEST(CurvesCorpus, ExplicitToolpathsOfExampleOneAreTheMotionThatThePublishedInterpreterMakes) {
  CAPSTAN_CORPUS_FILE(path, "iso14649/nist_ex1E.stp");
  Job job;
  const auto plan = read(path, job);
  ASSERT_TRUE(plan) << to_text(plan.error());
  std::vector<Motion> feeds;
  for (const Motion& m :
       motions(capstan::testing::slurp(capstan::testing::corpus_folder() + "/iso14649/nist_ex1E.can"))) {
    if (!m.rapid) feeds.push_back(m);
  }
  constexpr double kPrinted = 1e-4;  // both files carry four decimals
  std::size_t k = 0;
  const auto& main =
      plan->model.at<model::Workplan>(plan->model.at<model::Project>(plan->project).main_workplan);
  for (const auto step : main.its_elements.items) {
    const auto got = path_of_step(*plan, model::Ref<model::Executable>(step), kOptions, job);
    ASSERT_TRUE(got) << to_text(got.error());
    const CutterPath& p = got->path;
    for (std::size_t i = 1; i < p.size(); ++i) {
      if (p.kind[i] == MoveKind::kRapid) continue;
      const bool arc = p.kind[i] != MoveKind::kLine;
      // A helix of several turns is one motion there, one move per turn here.
      if (arc && i + 1 < p.size() && p.kind[i + 1] == p.kind[i] && p.cx[i + 1] == p.cx[i] &&
          p.cy[i + 1] == p.cy[i] && p.z[i + 1] != p.z[i]) {
        continue;
      }
      ASSERT_LT(k, feeds.size());
      const Motion& m = feeds[k++];
      EXPECT_NEAR(p.x[i], m.to.x, kPrinted) << "motion " << k;
      EXPECT_NEAR(p.y[i], m.to.y, kPrinted) << "motion " << k;
      EXPECT_NEAR(p.z[i], m.to.z, kPrinted) << "motion " << k;
      EXPECT_EQ(arc, m.arc) << "motion " << k;
      if (!arc) continue;
      EXPECT_NEAR(p.cx[i], m.centre.x, kPrinted) << "motion " << k;
      EXPECT_NEAR(p.cy[i], m.centre.y, kPrinted) << "motion " << k;
      EXPECT_EQ(p.kind[i] == MoveKind::kArcCw, m.turns < 0) << "motion " << k;
    }
  }
  EXPECT_EQ(k, feeds.size());
  EXPECT_GT(k, 400U);
}

TEST(CurvesCorpus, FirstHelixOfExampleOneTurnsAsOftenAsItsPitchSays) {
  CAPSTAN_CORPUS_FILE(path, "iso14649/nist_ex1E.stp");
  Job job;
  const auto plan = read(path, job);
  ASSERT_TRUE(plan);
  for (const auto at : plan->model.all(model::TypeId::kMachiningWorkingstep)) {
    if (plan->model.origin(at).instance != 13) continue;
    const auto got = path_of_step(*plan, model::Ref<model::Executable>(at), kOptions, job);
    ASSERT_TRUE(got);
    // 20.9 mm down at 7.976846 mm a turn: 2.62 turns, so three moves, the last one full.
    EXPECT_EQ(got->path.kind[1], MoveKind::kArcCw);
    EXPECT_EQ(got->path.kind[3], MoveKind::kArcCw);
    const double turns = (arc_sweep(got->path, 1) + arc_sweep(got->path, 2) + arc_sweep(got->path, 3)) /
                         (2.0 * std::numbers::pi);
    EXPECT_NEAR(turns, 20.9 / 7.976846, 1e-3);
    EXPECT_NEAR(got->schedule.feed_mm_min[1], 2400.0, 1e-9);
    EXPECT_NEAR(got->schedule.spindle_rpm[1], 1200.0, 1e-9);  // clockwise
  }
}

Result<CutterPath> follow(const std::string& curves, const std::string& speed = "$") {
  Job job;
  const auto plan = read_text(
      testing::part21(testing::drilled_plate(
                          {{20, "DRILLING(#200,$,'DRILL',10.,$,#44,#45,#41,$,$,$,$,$,$)"},
                           {200, "TOOLPATH_LIST((#201))"},
                           {201, "CUTTER_LOCATION_TRAJECTORY(.T.,.CONTACT.," + speed + ",$,$,$,#300,$,$)"}}) +
                      curves),
      job);
  if (!plan) return fail(plan.error());
  auto got = path_of_step(
      *plan, model::Ref<model::Executable>(plan->model.all(model::TypeId::kMachiningWorkingstep)[0]),
      kOptions, job);
  if (!got) return fail(got.error());
  return got->path;
}

// The hole stands at (20, 60, 0): curve coordinates are its own.
TEST(Curves, LineTrimmedByParametersRunsInMultiplesOfItsVector) {
  const auto p = follow(
      "#300=TRIMMED_CURVE('',#301,(PARAMETER_VALUE(0.)),(PARAMETER_VALUE(0.5)),.T.,.PARAMETER.);\n"
      "#301=LINE('',#95,#302);\n#302=VECTOR('',#97,8.);\n");
  ASSERT_TRUE(p) << to_text(p.error());
  ASSERT_EQ(p->size(), 2U);
  EXPECT_EQ(p->point(0), (geometry::Vec3{20, 60, 0}));
  EXPECT_EQ(p->point(1), (geometry::Vec3{24, 60, 0}));
  EXPECT_EQ(p->role[1], MoveRole::kCut);
}

TEST(Curves, CircleTrimmedByDegreesIsAnArcInTheSenseStated) {
  for (const bool along : {true, false}) {
    const auto p =
        follow(std::string("#300=TRIMMED_CURVE('',#301,(PARAMETER_VALUE(0.)),(PARAMETER_VALUE(90.)),") +
               (along ? ".T." : ".F.") + ",.PARAMETER.);\n#301=CIRCLE('',#71,2.);\n");
    ASSERT_TRUE(p) << to_text(p.error());
    ASSERT_EQ(p->size(), 2U);
    EXPECT_NEAR(p->x[1], 20.0, 1e-12);
    EXPECT_NEAR(p->y[1], 62.0, 1e-12);
    EXPECT_EQ(p->kind[1], along ? MoveKind::kArcCcw : MoveKind::kArcCw);
    EXPECT_NEAR(arc_sweep(*p, 1), (along ? 0.5 : 1.5) * std::numbers::pi, 1e-12);
  }
}

TEST(Curves, ArcThatIsNotAboutTheToolAxisStaysWithinTheChordTolerance) {
  // In the plane x = 0, radius 2, half a turn.
  const auto p = follow(
      "#300=TRIMMED_CURVE('',#301,(PARAMETER_VALUE(0.)),(PARAMETER_VALUE(180.)),.T.,.PARAMETER.);\n"
      "#301=CIRCLE('',#303,2.);\n#303=AXIS2_PLACEMENT_3D('',#95,#97,#96);\n");
  ASSERT_TRUE(p) << to_text(p.error());
  EXPECT_GT(p->size(), 20U);
  for (std::size_t i = 1; i < p->size(); ++i) {
    const auto mid = 0.5 * (p->point(i - 1) + p->point(i)) - geometry::Vec3{20, 60, 0};
    EXPECT_EQ(p->kind[i], MoveKind::kLine);
    EXPECT_GE(norm(mid), 2.0 - kOptions.chord_tolerance_mm);
    EXPECT_LE(norm(mid), 2.0);
  }
}

TEST(Curves, BSplineIsSampledWithinTheToleranceOfTheCurve) {
  // A quadratic Bezier from (0,0) by (1,2) to (2,0) is the parabola y = 2 x - x^2.
  const auto p = follow(
      "#300=B_SPLINE_CURVE_WITH_KNOTS('',2,(#95,#310,#311),.UNSPECIFIED.,.F.,.F.,(3,3),(0.,1.),"
      ".UNSPECIFIED.);\n#310=CARTESIAN_POINT('',(1.,2.,0.));\n#311=CARTESIAN_POINT('',(2.,0.,0.));\n");
  ASSERT_TRUE(p) << to_text(p.error());
  EXPECT_GT(p->size(), 10U);
  for (std::size_t i = 0; i < p->size(); ++i) {
    const double x = p->x[i] - 20.0;
    EXPECT_NEAR(p->y[i] - 60.0, 2.0 * x - x * x, 1e-12);
    if (i == 0) continue;
    const double mx = 0.5 * (p->x[i] + p->x[i - 1]) - 20.0, my = 0.5 * (p->y[i] + p->y[i - 1]) - 60.0;
    EXPECT_LE(std::abs(2.0 * mx - mx * mx - my), 3.0 * kOptions.chord_tolerance_mm);  // slope at most 2
  }
}

TEST(Curves, CompositeCurvePointingStraightAtAPolylineIsFollowed) {
  const auto p = follow("#300=COMPOSITE_CURVE('',(#301),.U.);\n#301=POLYLINE('',(#95,#110));\n");
  ASSERT_TRUE(p) << to_text(p.error());
  EXPECT_EQ(p->point(1), (geometry::Vec3{40, 120, 0}));
}

TEST(Curves, RapidSpeedMakesRapidMoves) {
  const auto p = follow("#300=POLYLINE('',(#95,#110));\n", ".RAPID.");
  ASSERT_TRUE(p) << to_text(p.error());
  EXPECT_EQ(p->kind[1], MoveKind::kRapid);
}

TEST(Curves, CuttingSpeedAndFeedPerToothBecomeSpindleAndFeedByTheTool) {
  Job job;
  const auto plan = read_text(testing::part21(testing::drilled_plate(
                                  {{20, "DRILLING(#200,$,'DRILL',10.,$,#44,#45,#41,$,$,$,$,$,$)"},
                                   {45, "MILLING_TECHNOLOGY($,.TCP.,0.5,$,0.1,.F.,.F.,.F.,$)"},
                                   {200, "TOOLPATH_LIST((#201))"},
                                   {201, "CUTTER_LOCATION_TRAJECTORY(.T.,.CONTACT.,$,$,$,$,#300,$,$)"},
                                   {300, "POLYLINE('',(#95,#110))"}})),
                              job);
  ASSERT_TRUE(plan);
  const auto got = path_of_step(
      *plan, model::Ref<model::Executable>(plan->model.all(model::TypeId::kMachiningWorkingstep)[0]),
      kOptions, job);
  ASSERT_TRUE(got) << to_text(got.error());
  const double rpm = 30000.0 / (std::numbers::pi * 10.0);  // 30 m/min, 10 mm
  EXPECT_NEAR(got->schedule.spindle_rpm[1], rpm, 1e-9);
  EXPECT_NEAR(got->schedule.feed_mm_min[1], 0.1 * 2.0 * rpm, 1e-9);  // two teeth
}

TEST(Curves, GapWithinACompositeCurveIsRefused) {
  const auto p = follow(
      "#300=COMPOSITE_CURVE('',(#301,#302),.U.);\n#301=POLYLINE('',(#95,#110));\n"
      "#302=POLYLINE('',(#95,#98));\n");
  ASSERT_FALSE(p);
  EXPECT_EQ(p.error().code, "EXC-CURVE");
}

// A path with every kind of move, written as curves and read back, is the same path.
TEST(Trajectories, PathIsTheSameAfterBeingWrittenAsCurvesAndReadBack) {
  Job job;
  auto plan = read_text(testing::part21(testing::drilled_plate()), job);
  ASSERT_TRUE(plan);
  auto& m = plan->model;
  auto path = std::make_shared<CutterPath>();
  path->start({20, 60, 30});
  path->rapid({20, 60, 2}, MoveRole::kApproach);
  path->line({20, 60, 0}, MoveRole::kPlunge);
  path->arc({20, 60, -2}, {18, 60}, true, MoveRole::kRamp);  // one clockwise turn down: right-handed
  path->line({25, 60, -2}, MoveRole::kCut);
  path->arc({20, 65, -2}, {20, 60}, false, MoveRole::kCut);
  path->line({20, 70, -2}, MoveRole::kCut);
  path->dwell();
  path->line({20, 75, -2}, MoveRole::kLink);
  path->rapid({20, 75, 30}, MoveRole::kRetract);
  auto schedule = std::make_shared<model::FeedSchedule>();
  for (std::size_t i = 0; i < path->size(); ++i) {
    schedule->feed_mm_min.push_back(i >= 5 ? 432.1 : 150.0);
    schedule->spindle_rpm.push_back(3000.0);
    schedule->dwell_s.push_back(path->kind[i] == MoveKind::kDwell ? 0.25 : 0.0);
  }
  model::CutterLocationTrajectory t;
  t.its_priority = true;
  t.its_type = model::ToolpathType::kTrajectoryPath;
  t.path = path;
  model::ToolpathList list;
  list.its_list.push_back(m.add(std::move(t)));
  const auto step = model::Ref<model::Executable>(m.all(model::TypeId::kMachiningWorkingstep)[0]);
  m.at<model::Drilling>(m.all(model::TypeId::kDrilling)[0]).its_toolpath = m.add(std::move(list));
  model::StepResult result;
  result.step = step;
  result.cutter_id = "D10";
  result.path = path;
  result.schedule = schedule;
  plan->steps.push_back(result);

  const auto written = write_iso14649(*plan, job);
  ASSERT_TRUE(written) << to_text(written.error());
  const auto again = read_text(written->bytes, job);
  ASSERT_TRUE(again) << to_text(again.error()) << written->bytes;
  const auto got = path_of_step(
      *again, model::Ref<model::Executable>(again->model.all(model::TypeId::kMachiningWorkingstep)[0]),
      kOptions, job);
  ASSERT_TRUE(got) << to_text(got.error()) << written->bytes;
  ASSERT_EQ(got->path.size(), path->size()) << written->bytes;
  for (std::size_t i = 0; i < path->size(); ++i) {
    EXPECT_LT(norm(got->path.point(i) - path->point(i)), 1e-12) << i;
    if (i == 0) continue;
    EXPECT_EQ(got->path.kind[i], path->kind[i]) << i;
    if (path->kind[i] == MoveKind::kDwell) {
      EXPECT_EQ(got->schedule.dwell_s[i], 0.25);
      continue;
    }
    EXPECT_EQ(got->path.role[i], path->role[i]) << i;
    EXPECT_NEAR(got->path.cx[i], path->cx[i], 1e-12) << i;
    if (path->kind[i] == MoveKind::kRapid) continue;
    EXPECT_EQ(got->schedule.feed_mm_min[i], schedule->feed_mm_min[i]) << i;
    EXPECT_EQ(got->schedule.spindle_rpm[i], 3000.0) << i;
  }
  EXPECT_EQ(again->steps.size(), 1U);
  EXPECT_EQ(again->steps[0].cutter_id, "D10");
}

TEST(Trajectories, PathThatOnlyTheResultsHoldIsWrittenToo) {
  Job job;
  auto plan = read_text(testing::part21(testing::drilled_plate()), job);
  ASSERT_TRUE(plan);
  auto path = std::make_shared<CutterPath>();
  path->start({20, 60, 2});
  path->line({20, 60, -30}, MoveRole::kDrill);
  model::StepResult result;
  result.step = model::Ref<model::Executable>(plan->model.all(model::TypeId::kMachiningWorkingstep)[0]);
  result.path = path;
  plan->steps.push_back(result);
  const auto written = write_iso14649(*plan, job);
  ASSERT_TRUE(written);
  const auto again = read_text(written->bytes, job);
  ASSERT_TRUE(again);
  const auto got = path_of_step(*again, again->steps.at(0).step, kOptions, job);
  ASSERT_TRUE(got) << to_text(got.error());
  ASSERT_EQ(got->path.size(), 2U);
  EXPECT_EQ(got->path.point(1), (geometry::Vec3{20, 60, -30}));
  EXPECT_EQ(got->schedule.feed_mm_min[1], 300.0);  // the operation's own
}

/// A plate whose drilling has a path that turns counter-clockwise down: a left-handed helix, in the file.
std::string left_handed(std::shared_ptr<const CutterPath> path) {
  Job job;
  auto plan = read_text(testing::part21(testing::drilled_plate()), job);
  EXPECT_TRUE(plan);
  auto& m = plan->model;
  model::CutterLocationTrajectory t;
  t.path = std::move(path);
  model::ToolpathList list;
  list.its_list.push_back(m.add(std::move(t)));
  m.at<model::Drilling>(m.all(model::TypeId::kDrilling)[0]).its_toolpath = m.add(std::move(list));
  const auto written = write_iso14649(*plan, job);
  EXPECT_TRUE(written);
  EXPECT_THAT(written->losses, ::testing::Contains(::testing::HasSubstr("left-handed helix")));
  return written->bytes;
}
std::shared_ptr<const CutterPath> down_and_round() {
  auto path = std::make_shared<CutterPath>();
  path->start({25, 60, 0});
  path->arc({25, 60, -2}, {20, 60}, false, MoveRole::kCut);     // a whole turn, counter-clockwise down
  path->arc({20, 65, -2.75}, {20, 60}, false, MoveRole::kCut);  // a quarter
  path->line({30, 65, -2.75}, MoveRole::kCut);
  path->arc({30, 55, -1}, {30, 60}, true, MoveRole::kCut);  // clockwise up
  return path;
}
/// Without the header's exact paths: what the toolpaths themselves say.
Result<StepPath> path_of(const std::string& bytes) {
  std::string text = bytes;
  for (auto at = text.find("\n!CAPSTAN"); at != std::string::npos; at = text.find("\n!CAPSTAN"))
    text.erase(at, text.find('\n', at + 1) - at);
  Job job;
  const auto plan = read_text(text, job);
  EXPECT_TRUE(plan);
  return path_of_step(*plan,
                      model::Ref<model::Executable>(plan->model.all(model::TypeId::kMachiningWorkingstep)[0]),
                      kOptions, job);
}

TEST(Trajectories, LeftHandedHelixIsWrittenAsChordsAndFollowedAsItself) {
  const auto path = down_and_round();
  const std::string bytes = left_handed(path);
  // Its chords are within the tolerance of who knows nothing of the name: of a circle of 5 mm.
  EXPECT_GT(std::count(bytes.begin(), bytes.end(), '\n'), 100);
  const auto got = path_of(bytes);
  ASSERT_TRUE(got) << to_text(got.error());
  ASSERT_EQ(got->path.size(), path->size());
  for (std::size_t i = 0; i < path->size(); ++i) {
    EXPECT_LT(norm(got->path.point(i) - path->point(i)), 1e-9) << i;
    if (i == 0) continue;
    EXPECT_EQ(got->path.kind[i], path->kind[i]) << i;
    EXPECT_NEAR(got->path.cx[i], path->cx[i], 1e-9) << i;
    EXPECT_NEAR(got->path.cy[i], path->cy[i], 1e-9) << i;
  }
}

TEST(Trajectories, ChordsOfALeftHandedHelixThatWereEditedAreFollowedAsTheyStand) {
  std::string bytes = left_handed(down_and_round());
  // The point half round, opposite to where it begins: (15, 60, -1), moved by a tenth.
  // In the hole's own coordinates: (-5, 0, -1).
  const std::regex half_round("\\(-5\\.,([^,()]*),-1\\.\\)");
  ASSERT_TRUE(std::regex_search(bytes, half_round)) << bytes;
  bytes = std::regex_replace(bytes, half_round, "(-4.9,$1,-1.)", std::regex_constants::format_first_only);
  const auto got = path_of(bytes);
  ASSERT_TRUE(got) << to_text(got.error());
  // A chord of a circle of 5 mm strays 0.001 mm at 2 acos(1 - 0.001 / 5) = 2.29 degrees: 158 a turn.
  EXPECT_EQ(got->path.size(), down_and_round()->size() - 1 + 158);
  double least = 5.0;
  for (std::size_t i = 1; i < 158; ++i)
    least = std::min(least, std::hypot(got->path.x[i] - 20.0, got->path.y[i] - 60.0));
  EXPECT_NEAR(least, 4.9, 1e-6);
}

}  // namespace
}  // namespace capstan::exchange
