#include <cmath>
#include <numbers>

#include "planner/files/exchange/toolpaths/curves.h"
#include "planner/files/exchange/toolpaths/schedules.h"
#include "tests/files/exchange/ap238/support.h"
#include "tests/files/exchange/support.h"

namespace capstan::exchange::ap238 {
namespace {

using geometry::Vec3;
using model::CutterPath;
using model::MoveKind;
using model::MoveRole;
using ::testing::Contains;
using ::testing::HasSubstr;

/// A drilled plate with a path for its one step.
struct Planned {
  model::Plan plan;
  std::shared_ptr<CutterPath> path = std::make_shared<CutterPath>();
  std::shared_ptr<model::FeedSchedule> schedule = std::make_shared<model::FeedSchedule>();
  Planned() {
    Job job;
    auto read =
        exchange::testing::read_text(exchange::testing::part21(exchange::testing::drilled_plate()), job);
    EXPECT_TRUE(read) << to_text(read.error());
    if (read) plan = std::move(*read);
  }
  model::Ref<model::Executable> step(const model::Plan& p) const {
    return model::Ref<model::Executable>(p.model.all(model::TypeId::kMachiningWorkingstep).at(0));
  }
  void finish(std::shared_ptr<const model::SectionSeries> sections = nullptr) {
    model::StepResult result;
    result.step = step(plan);
    result.path = path;
    result.schedule = schedule;
    result.sections = std::move(sections);
    plan.steps.push_back(result);
  }
  void feeds(const std::vector<double>& feed, double rpm = 3000.0) {
    for (std::size_t i = 0; i < path->size(); ++i) {
      schedule->feed_mm_min.push_back(feed[i]);
      schedule->spindle_rpm.push_back(rpm);
      schedule->dwell_s.push_back(path->kind[i] == MoveKind::kDwell ? 0.25 : 0.0);
    }
  }
  Result<StepPath> back(std::string* bytes = nullptr, std::vector<std::string>* said = nullptr) const {
    const Written out = written(plan);
    if (bytes != nullptr) *bytes = out.bytes;
    const auto again = read_text(out.bytes, said);
    Job job;
    return path_of_step(again, step(again), {}, job);
  }
};

void expect_same(const StepPath& got, const CutterPath& path, const model::FeedSchedule& schedule) {
  ASSERT_EQ(got.path.size(), path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    SCOPED_TRACE(i);
    EXPECT_LT(norm(got.path.point(i) - path.point(i)), 1e-12);
    if (i == 0) continue;
    EXPECT_EQ(got.path.kind[i], path.kind[i]);
    if (path.kind[i] == MoveKind::kDwell) {
      EXPECT_EQ(got.schedule.dwell_s[i], schedule.dwell_s[i]);
      continue;
    }
    EXPECT_EQ(got.path.role[i], path.role[i]);
    EXPECT_NEAR(got.path.cx[i], path.cx[i], 1e-9);
    EXPECT_NEAR(got.path.cy[i], path.cy[i], 1e-9);
    if (path.kind[i] == MoveKind::kRapid) continue;
    EXPECT_EQ(got.schedule.feed_mm_min[i], schedule.feed_mm_min[i]);
    EXPECT_EQ(got.schedule.spindle_rpm[i], schedule.spindle_rpm[i]);
  }
}

TEST(Schedule, PathAndFeedsOfEveryKindComeBack) {
  Planned p;
  p.path->start({20, 60, 30});
  p.path->rapid({20, 60, 2}, MoveRole::kApproach);
  p.path->line({20, 60, 0}, MoveRole::kPlunge);
  p.path->arc({20, 60, -2}, {18, 60}, true, MoveRole::kRamp);
  p.path->arc({20, 60, -4}, {18, 60}, false, MoveRole::kRamp);  // left-handed: no matter to via points
  p.path->line({25, 60, -4}, MoveRole::kCut);
  p.path->arc({20, 65, -4}, {20, 60}, false, MoveRole::kCut);
  p.path->arc({15, 60, -4}, {20, 60}, true, MoveRole::kCut);  // three quarters
  p.path->arc({15, 60, -4}, {10, 60}, true, MoveRole::kCut);  // full turn
  p.path->line({20, 70, -4}, MoveRole::kCut);
  p.path->dwell();
  p.path->line({20, 75, -4}, MoveRole::kLink);
  p.path->rapid({20, 75, 30}, MoveRole::kRetract);
  p.feeds({0, 0, 150, 150, 200, 432.1, 432.1, 123.456, 1000.0 / 3.0, 77.7, 0, 432.1, 0});
  p.finish();
  std::string bytes;
  const auto got = p.back(&bytes);
  ASSERT_TRUE(got) << to_text(got.error()) << bytes;
  expect_same(*got, *p.path, *p.schedule);
  EXPECT_THAT(bytes, HasSubstr("VIA_ARC_POINT"));
  EXPECT_THAT(bytes, HasSubstr("VIA_HELIX_POINT"));
}

TEST(Schedule, OneFeedIsARatioAndManyAreACurveOfThem) {
  Planned p;  // its technology feeds 300 mm/min at 3000 1/min clockwise
  p.path->start({20, 60, 2});
  p.path->line({20, 60, -1}, MoveRole::kPlunge);
  p.path->line({30, 60, -1}, MoveRole::kCut);
  p.path->line({40, 60, -1}, MoveRole::kCut);
  p.path->line({50, 60, -1}, MoveRole::kCut);
  const auto& technology =
      p.plan.model.at<model::MillingTechnology>(p.plan.model.all(model::TypeId::kMillingTechnology).at(0));
  const double base = technology.feedrate.value();
  p.feeds({0, 0.5 * base, base, base, 0.25 * base}, -technology.spindle.value());
  p.finish();
  const auto lines = shapes(written(p.plan).bytes);
  EXPECT_THAT(
      lines,
      Contains(
          "(MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(RATIO_MEASURE(0.5),#)RATIO_MEASURE_WITH_UNIT()"
          "REPRESENTATION_ITEM(''));"));
  // Four points, the third twice where the feed jumps; the curve of ratios has as many.
  EXPECT_EQ(std::count(lines.begin(), lines.end(), "POLYLINE('',(#,#,#,#,#));"), 2);
  EXPECT_THAT(lines, Contains("CARTESIAN_POINT('',(0.25));"));
  const auto got = p.back();
  ASSERT_TRUE(got);
  expect_same(*got, *p.path, *p.schedule);
}

MoveParameters along(std::size_t moves) {
  MoveParameters out;
  out.from = {0.0};
  out.to = {0.0};
  for (std::size_t i = 0; i < moves; ++i) {
    out.from.push_back(static_cast<double>(i));
    out.to.push_back(static_cast<double>(i + 1));
  }
  out.last = static_cast<double>(moves);
  return out;
}

model::AnyRef curve_of(model::Model& m, const std::vector<double>& values) {
  model::Polyline c;
  for (const double v : values) {
    model::CartesianPoint p;
    p.coordinates = {{v}, true};
    c.points.push_back(m.add(std::move(p)));
  }
  return m.add(std::move(c));
}

TEST(Schedule, SpeedCurveGoesByTheParameterOfItsBasicCurveAndTheLeastAlongAMoveCounts) {
  model::Model m;
  Job job;
  const auto got = speed_ratios(m, curve_of(m, {1.0, 0.5, 0.75}), along(2), 300.0, job);
  ASSERT_TRUE(got);
  EXPECT_THAT(*got, ::testing::ElementsAre(1.0, 0.5, 0.5));
  // Metres per second and millimetres per minute are told by their size: 300 mm/min are 0.005 m/s.
  const auto metres = speed_ratios(m, curve_of(m, {0.005, 0.0025, 0.005}), along(2), 300.0, job);
  ASSERT_TRUE(metres);
  EXPECT_NEAR(metres->at(1), 0.5, 1e-12);
  const auto millimetres = speed_ratios(m, curve_of(m, {300.0, 150.0, 300.0}), along(2), 300.0, job);
  ASSERT_TRUE(millimetres);
  EXPECT_NEAR(millimetres->at(2), 0.5, 1e-12);
}

TEST(Schedule, SpeedCurveThatDoesNotFitIsRefused) {
  model::Model m;
  Job job;
  for (const auto& values :
       {std::vector<double>{1.0, 1.0}, std::vector<double>{1.0, 0.0, 1.0},
        std::vector<double>{1.0, -1.0, 1.0}, std::vector<double>{1e6, 1e6, 1e6}, std::vector<double>{}}) {
    const auto got = speed_ratios(m, curve_of(m, values), along(2), 300.0, job);
    ASSERT_FALSE(got);
    EXPECT_EQ(got.error().code, "EXC-SPEED-PROFILE");
  }
  EXPECT_FALSE(speed_ratios(m, {}, along(2), 300.0, job));
}

TEST(Schedule, SpeedCurveMayBeASpline) {
  model::Model m;
  Job job;
  model::BSplineCurveWithKnots c;
  c.degree = 1;
  for (const double v : {1.0, 0.5, 1.0}) {
    model::CartesianPoint p;
    p.coordinates = {{v}, true};
    c.control_points_list.push_back(m.add(std::move(p)));
  }
  c.knot_multiplicities = {{2, 1, 2}, true};
  c.knots = {{0.0, 1.0, 2.0}, true};
  const auto at = m.add(std::move(c));
  const auto got = speed_ratios(m, at, along(2), 300.0, job);
  ASSERT_TRUE(got) << to_text(got.error());
  EXPECT_NEAR(got->at(1), 0.5, 1e-12);
  EXPECT_NEAR(got->at(2), 0.5, 1e-12);
}

TEST(Schedule, SpeedCurveOfTwoPlausibleReadingsIsWarnedOf) {
  model::Model m;
  // Of 1200 mm/min: 24 to 60 mm/min, or 1200 to 3000 mm/min.
  Job job;
  const auto got = speed_ratios(m, curve_of(m, {0.02, 0.05, 0.02}), along(2), 1200.0, job);
  ASSERT_TRUE(got);
  EXPECT_NEAR(got->at(1), 0.02, 1e-12);
  ASSERT_EQ(job.count(Severity::kWarning), 1U);
  EXPECT_EQ(job.diagnostics()[0].code, "EXC-SPEED-PROFILE");
  EXPECT_THAT(job.diagnostics()[0].message, HasSubstr("metres per second (3000 mm/min)"));
  for (const auto& [values, feed] : {std::pair(std::vector<double>{0.02, 0.05, 0.02}, 300.0),
                                     std::pair(std::vector<double>{0.5, 1.0, 0.5}, 20000.0),
                                     std::pair(std::vector<double>{0.005, 0.0025, 0.005}, 300.0)}) {
    Job quiet;
    ASSERT_TRUE(speed_ratios(m, curve_of(m, values), along(2), feed, quiet));
    EXPECT_TRUE(quiet.diagnostics().empty()) << to_text(quiet.diagnostics()[0]);
  }
}

// A step of one straight toolpath of two points with a speed curve of these values, and its technology's
// feed.
std::pair<Result<StepPath>, double> along_with(const std::vector<double>& values, Job& job) {
  Planned p;
  auto& m = p.plan.model;
  model::Polyline line;
  for (const double z : {2.0, -2.0}) {
    model::CartesianPoint c;
    c.coordinates = {{0.0, 0.0, z}, true};
    line.points.push_back(m.add(std::move(c)));
  }
  model::ToolpathSpeed speed;
  speed.speed = model::Ref<model::BoundedCurve>(curve_of(m, values));
  model::CutterLocationTrajectory t;
  t.basiccurve = m.add(std::move(line));
  t.its_speed.ref = m.add(std::move(speed));
  model::ToolpathList list;
  list.its_list.push_back(m.add(std::move(t)));
  m.at<model::Drilling>(m.all(model::TypeId::kDrilling).at(0)).its_toolpath = m.add(std::move(list));
  const double feed =
      m.at<model::MillingTechnology>(m.all(model::TypeId::kMillingTechnology).at(0)).feedrate.value();
  return {path_of_step(p.plan, p.step(p.plan), {}, job), feed};
}

TEST(Schedule, SpeedCurveThatCannotBeFollowedHoldsTheWholePathToItsLeast) {
  Job job;
  const auto [got, feed] = along_with({0.5, 0.25, 0.5}, job);  // a point too many for the basic curve
  ASSERT_TRUE(got) << to_text(got.error());
  EXPECT_NEAR(got->schedule.feed_mm_min.back(), 0.25 * feed, 1e-9);
  ASSERT_EQ(job.count(Severity::kWarning), 1U);
  EXPECT_EQ(job.diagnostics()[0].code, "EXC-SPEED-PROFILE");
  EXPECT_THAT(job.diagnostics()[0].message, HasSubstr("least speed"));
  // No faster than the technology, whatever the curve says.
  Job fast;
  EXPECT_NEAR(along_with({2.0, 1.5, 2.0}, fast).first.value().schedule.feed_mm_min.back(), feed, 1e-9);
}

TEST(Schedule, SpeedCurveWithoutALeastSpeedIsRefusedWithItsPath) {
  for (const auto& values : {std::vector<double>{0.5, 0.0}, std::vector<double>{0.5, -0.5, 0.5},
                             std::vector<double>{1e6, 1e6}, std::vector<double>{}}) {
    Job job;
    const auto got = along_with(values, job).first;
    ASSERT_FALSE(got);
    EXPECT_EQ(got.error().code, "EXC-SPEED-PROFILE");
    EXPECT_EQ(got.error().severity, Severity::kError);
  }
}

TEST(Schedule, DwellInRevolutionsIsTimeByTheSpindle) {
  Planned p;
  auto& m = p.plan.model;
  model::Polyline line;
  for (const double z : {2.0, -2.0}) {
    model::CartesianPoint c;
    c.coordinates = {{0.0, 0.0, z}, true};
    line.points.push_back(m.add(std::move(c)));
  }
  model::CutterLocationTrajectory t;
  t.basiccurve = m.add(std::move(line));
  model::Feedstop stop;
  stop.dwell_revolutions = 3.0;
  model::ToolpathList list;
  list.its_list.push_back(m.add(std::move(t)));
  list.its_list.push_back(m.add(std::move(stop)));
  m.at<model::Drilling>(m.all(model::TypeId::kDrilling).at(0)).its_toolpath = m.add(std::move(list));
  const double rpm = std::abs(
      m.at<model::MillingTechnology>(m.all(model::TypeId::kMillingTechnology).at(0)).spindle.value());
  Job job;
  const auto got = path_of_step(p.plan, p.step(p.plan), {}, job);
  ASSERT_TRUE(got) << to_text(got.error());
  ASSERT_EQ(got->path.kind.back(), MoveKind::kDwell);
  EXPECT_NEAR(got->schedule.dwell_s.back(), 180.0 / rpm, 1e-12);
}

// --- frames ---

model::Ref<model::Axis2Placement3d> placement(model::Model& m, std::vector<double> at,
                                              std::vector<double> x = {1, 0, 0}) {
  model::CartesianPoint p;
  p.coordinates = {std::move(at), true};
  model::Direction d, z;
  d.direction_ratios = {std::move(x), true};
  z.direction_ratios = {{0, 0, 1}, true};
  model::Axis2Placement3d out;
  out.location = m.add(std::move(p));
  out.axis = m.add(std::move(z));
  out.ref_direction = m.add(std::move(d));
  return m.add(std::move(out));
}

TEST(Orientation, OfAWorkingstepStandsInPlaceOfTheFeaturesAndOfWorkplansAddsUp) {
  Planned p;  // the hole stands at (20, 60, 0)
  auto& m = p.plan.model;
  const auto step = p.step(p.plan);
  const auto frame = [&] { return frame_of_step(p.plan, step).value(); };
  EXPECT_EQ(frame().to_parent({0, 0, 0}), (Vec3{20, 60, 0}));
  m.at<model::Workingstep>(step).toolpath_orientation = placement(m, {1, 2, 3});
  EXPECT_EQ(frame().to_parent({0, 0, 0}), (Vec3{1, 2, 3}));
  const auto inner = m.at<model::Project>(p.plan.project).main_workplan;
  m.at<model::Workplan>(inner).toolpath_orientation = placement(m, {10, 0, 0}, {0, 1, 0});  // a quarter turn
  EXPECT_LT(norm(frame().to_parent({0, 0, 0}) - Vec3{8, 1, 3}), 1e-12);
  model::Workplan outer;
  outer.toolpath_orientation = placement(m, {0, 0, 100}, {0, 1, 0});
  outer.its_elements.push_back(inner);
  m.at<model::Project>(p.plan.project).main_workplan = m.add(std::move(outer));
  EXPECT_LT(norm(frame().to_parent({0, 0, 0}) - Vec3{-1, 8, 103}), 1e-12);
}

TEST(Orientation, IsWrittenWithToolpathsAndDroppedWhereTheFeatureSaysTheSame) {
  Planned p;
  p.path->start({20, 60, 2});
  p.path->line({20, 60, -30}, MoveRole::kDrill);
  p.feeds({0, 100});
  p.finish();
  const Written out = written(p.plan);
  EXPECT_THAT(out.bytes, HasSubstr("ACTION_PROPERTY('toolpath orientation'"));
  EXPECT_THAT(out.bytes, HasSubstr("CARTESIAN_POINT('',(20.,60.,0.))"));
  const auto again = read_text(out.bytes);
  EXPECT_FALSE(again.model.at<model::Workingstep>(p.step(again)).toolpath_orientation);
  Job job;
  const auto got = path_of_step(again, p.step(again), {}, job);
  ASSERT_TRUE(got) << to_text(got.error());
  EXPECT_EQ(got->path.point(1), (Vec3{20, 60, -30}));
}

TEST(Orientation, ToolAxisThatTiltsIsRefused) {
  Planned p;
  auto& m = p.plan.model;
  const auto line = [&](const std::vector<std::vector<double>>& points) {
    model::Polyline c;
    for (const auto& at : points) {
      model::CartesianPoint q;
      q.coordinates = {at, true};
      c.points.push_back(m.add(std::move(q)));
    }
    return m.add(std::move(c));
  };
  model::CutterLocationTrajectory t;
  t.basiccurve = line({{0, 0, 2}, {0, 0, -2}});
  t.its_toolaxis = line({{0, 0, 1}, {0, 0, 2}});
  const auto at = m.add(std::move(t));
  model::ToolpathList list;
  list.its_list.push_back(at);
  m.at<model::Drilling>(m.all(model::TypeId::kDrilling).at(0)).its_toolpath = m.add(std::move(list));
  Job job;
  EXPECT_TRUE(path_of_step(p.plan, p.step(p.plan), {}, job));
  m.at<model::CutterLocationTrajectory>(at).its_toolaxis = line({{0, 0, 1}, {0, 0.1, 1}});
  const auto got = path_of_step(p.plan, p.step(p.plan), {}, job);
  ASSERT_FALSE(got);
  EXPECT_EQ(got.error().code, "EXC-TOOL-AXIS");
}

}  // namespace
}  // namespace capstan::exchange::ap238
