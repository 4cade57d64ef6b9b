#include "planner/files/exchange/toolpaths/curves.h"
#include "planner/files/exchange/toolpaths/schedules.h"
#include "tests/files/exchange/ap238/support.h"
#include "tests/files/exchange/support.h"

namespace capstan::exchange::ap238 {
namespace {

using model::MoveRole;
using ::testing::Contains;
using ::testing::HasSubstr;

void sample(model::SectionSeries& s, std::uint32_t move, double at, std::vector<double> v, double removed) {
  s.move.push_back(move);
  s.at_mm.push_back(at);
  s.ad_max_mm.push_back(v[0]);
  s.rd_max_mm.push_back(v[1]);
  s.x_max_ofs_mm.push_back(v[2]);
  s.y_max_ofs_mm.push_back(v[3]);
  s.csa_mm2.push_back(v[4]);
  s.x_cg_ofs_mm.push_back(v[5]);
  s.y_cg_ofs_mm.push_back(v[6]);
  s.removed_mm3.push_back(removed);
}

struct Cut {
  model::Plan plan;
  model::Ref<model::Executable> step;
  Cut() {
    Job job;
    auto read =
        exchange::testing::read_text(exchange::testing::part21(exchange::testing::drilled_plate()), job);
    EXPECT_TRUE(read);
    plan = std::move(*read);
    step = model::Ref<model::Executable>(plan.model.all(model::TypeId::kMachiningWorkingstep).at(0));
    auto path = std::make_shared<model::CutterPath>();
    path->start({20, 60, 5});
    path->rapid({20, 60, 1}, MoveRole::kApproach);
    path->line({20, 60, -1}, MoveRole::kPlunge);
    path->line({30, 60, -1}, MoveRole::kCut);  // the first half in the material: 5 mm, 2 x 3 mm
    path->arc({40, 60, -1}, {35, 60}, true, MoveRole::kCut);
    path->rapid({40, 60, 5}, MoveRole::kRetract);
    auto sections = std::make_shared<model::SectionSeries>();
    sample(*sections, 3, 2.5, {2, 3, 0.5, -1, 6, 0.25, -1}, 15.0);
    sample(*sections, 3, 5.0, {2, 3, 0.5, -1, 6, 0.25, -1}, 15.0);
    sample(*sections, 3, 7.5, {0, 0, 0, 0, 0, 0, 0}, 0.0);
    const double half = 0.5 * model::move_length(*path, 4);
    sample(*sections, 4, half, {1, 1, 0, -0.5, 1, 0, -0.5}, half);
    sample(*sections, 4, 2.0 * half, {1, 2, 0, -0.5, 2, 0, -0.5}, 2.0 * half);
    model::StepResult result;
    result.step = step;
    result.path = path;
    result.sections = sections;
    plan.steps.push_back(result);
  }
};

TEST(Sections, StandAsSevenNumbersForEachPointOfTheBasicCurve) {
  const Cut cut;
  const auto lines = shapes(written(cut.plan).bytes);
  EXPECT_THAT(lines,
              Contains("ACTION_PROPERTY('cross section area parameters','cutter location trajectory',#);"));
  EXPECT_THAT(lines, Contains("CARTESIAN_POINT('',(2.,3.,0.5,-1.,6.,0.25,-1.));"));  // where the cut begins
  EXPECT_THAT(lines, Contains("CARTESIAN_POINT('',(0.,0.,0.,0.,0.,0.,0.));"));       // where it ended, in air
  EXPECT_THAT(lines, Contains("CARTESIAN_POINT('',(1.,1.,0.,-0.5,1.,0.,-0.5));"));   // at the via point
  EXPECT_THAT(lines, Contains("CARTESIAN_POINT('',(1.,2.,0.,-0.5,2.,0.,-0.5));"));
  // Four points of the path, one of them a via point, and two where the cut ends and where that is measured;
  // as many of sections.
  EXPECT_EQ(std::count(lines.begin(), lines.end(), "POLYLINE('',(#,#,#,#,#,#));"), 2);
  EXPECT_EQ(std::count_if(lines.begin(), lines.end(),
                          [](const auto& l) { return l.starts_with("CARTESIAN_POINT('section',"); }),
            2);
}

TEST(Sections, ComeBackWhereThePointsAreAndWithTheVolume) {
  const Cut cut;
  const Written out = written(cut.plan);
  const auto again = read_text(out.bytes);
  Job job;
  const auto got = path_of_step(
      again, model::Ref<model::Executable>(again.model.all(model::TypeId::kMachiningWorkingstep).at(0)), {},
      job);
  ASSERT_TRUE(got) << to_text(got.error());
  const auto& s = got->sections;
  const auto& path = *cut.plan.steps[0].path;
  // Points that only the sections need make no moves of their own.
  EXPECT_EQ(got->path.kind, path.kind);
  ASSERT_EQ(s.size(), 6U);
  const double length = model::move_length(path, 4);
  const double at[] = {0.0, 5.0, 7.5, 10.0, 0.5 * length, length};
  const double area[] = {6.0, 6.0, 0.0, 0.0, 1.0, 2.0};
  const std::uint32_t move[] = {3, 3, 3, 3, 4, 4};
  double removed = 0.0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    EXPECT_EQ(s.move[i], move[i]);
    EXPECT_NEAR(s.at_mm[i], at[i], 1e-9);
    EXPECT_EQ(s.csa_mm2[i], area[i]);
    removed += s.removed_mm3[i];
  }
  EXPECT_NEAR(removed, 30.0 + 1.5 * length, 1e-9);
  // Written again, the sections are the same.
  auto second = again;
  EXPECT_EQ(lost_on_the_way(second), "");
}

TEST(Sections, OfOtherThanSevenNumbersOrAnotherRangeAreNotFollowed) {
  Cut cut;
  const auto again = read_text(written(cut.plan).bytes);
  for (const bool range : {false, true}) {
    auto plan = again;
    for (const auto at : plan.model.all(model::TypeId::kCutterLocationTrajectory)) {
      const auto curve = plan.model.at<model::Trajectory>(at).cross_section_area_parameters;
      if (!curve) continue;
      auto& points = plan.model.at<model::Polyline>(curve).points;
      if (range) {
        points.items.pop_back();
      } else {
        plan.model.at<model::CartesianPoint>(points[0]).coordinates.items.pop_back();
      }
    }
    Job job;
    const auto got = path_of_step(
        plan, model::Ref<model::Executable>(plan.model.all(model::TypeId::kMachiningWorkingstep).at(0)), {},
        job);
    ASSERT_TRUE(got);
    EXPECT_EQ(got->sections.size(), 0U);
    const auto said = job.take_diagnostics();
    EXPECT_TRUE(
        std::any_of(said.begin(), said.end(), [](const auto& d) { return d.code == "EXC-SECTIONS"; }));
  }
}

TEST(Sections, OfACurveSampledBetweenItsPointsStayWithinThem) {
  model::Plan plan;
  auto& m = plan.model;
  model::Polyline c;
  for (const double area : {1.0, 2.0, 3.0}) {
    model::CartesianPoint p;
    p.coordinates = {{0.0, 0.0, 0.0, 0.0, area, 0.0, 0.0}, true};
    c.points.push_back(m.add(std::move(p)));
  }
  model::Trajectory t;
  t.cross_section_area_parameters = m.add(std::move(c));
  t.its_material_removal_total_volume = 6.0;
  // An arc over both spans, in four chords of half a span each; forwards and backwards.
  for (const bool back : {false, true}) {
    model::CutterPath path;
    MoveParameters moves{.from = {0.0}, .to = {0.0}, .first = 0.0, .last = 2.0};
    path.start({0, 0, 0});
    for (int i = 0; i < 4; ++i) {
      path.line({i + 1.0, 0, 0}, MoveRole::kCut);
      moves.from.push_back(back ? 2.0 - 0.5 * i : 0.5 * i);
      moves.to.push_back(back ? 1.5 - 0.5 * i : 0.5 * i + 0.5);
    }
    model::SectionSeries out;
    ASSERT_TRUE(add_sections(m, t, moves, path, out));
    ASSERT_GT(out.size(), 0U);
    EXPECT_EQ(out.csa_mm2.back(), back ? 1.0 : 3.0);
  }
}

}  // namespace
}  // namespace capstan::exchange::ap238
