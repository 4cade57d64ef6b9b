#include <cmath>
#include <numbers>
#include <random>

#include "planner/files/exchange/toolpaths/curves.h"
#include "planner/files/exchange/toolpaths/via.h"
#include "tests/files/exchange/ap238/support.h"

namespace capstan::exchange::ap238 {
namespace {

using curves::arc_through;
using curves::ViaOptions;
using geometry::Vec3;
using ::testing::HasSubstr;

constexpr double kPi = std::numbers::pi;

Result<curves::Segment> through(Vec3 from, std::vector<Vec3> via, Vec3 to, ViaOptions o = {}) {
  return arc_through(from, via, to, o);
}

TEST(ViaPoint, ArcRunsFromThePointBeforeThroughItToThePointAfter) {
  // The standard's example spans 270 degrees.
  const auto s = through({1, 0, 0}, {{-std::sqrt(0.5), std::sqrt(0.5), 0}}, {0, -1, 0});
  ASSERT_TRUE(s);
  EXPECT_TRUE(s->arc);
  EXPECT_NEAR(norm(s->centre), 0.0, 1e-12);
  EXPECT_NEAR(s->sweep * s->axis.z, 1.5 * kPi, 1e-12);
}

TEST(ViaPoint, ArcOnTheOtherSideTurnsTheOtherWay) {
  const auto s = through({1, 0, 0}, {{std::sqrt(0.5), -std::sqrt(0.5), 0}}, {0, -1, 0});
  ASSERT_TRUE(s);
  EXPECT_NEAR(s->sweep * s->axis.z, -0.5 * kPi, 1e-12);
}

TEST(ViaPoint, FullTurnTakesTwo) {
  const auto s = through({1, 0, 5}, {{0, 1, 5}, {-1, 0, 5}}, {1, 0, 5});
  ASSERT_TRUE(s);
  EXPECT_NEAR(s->sweep * s->axis.z, 2.0 * kPi, 1e-12);
  const auto clockwise = through({1, 0, 5}, {{0, -1, 5}, {-1, 0, 5}}, {1, 0, 5});
  ASSERT_TRUE(clockwise);
  EXPECT_NEAR(clockwise->sweep * clockwise->axis.z, -2.0 * kPi, 1e-12);
  const auto one = through({1, 0, 5}, {{-1, 0, 5}}, {1, 0, 5});
  ASSERT_FALSE(one);
  EXPECT_EQ(one.error().code, "EXC-VIA");
}

TEST(ViaPoint, CoincidentWithANeighbourMakesALine) {
  for (const Vec3 via :
       {Vec3{0, 0, 0}, Vec3{9e-6, 0, 0}, Vec3{10, 0, 0}, Vec3{10, 9e-6, 0}, Vec3{5, 9e-6, 0}}) {
    const auto s = through({0, 0, 0}, {via}, {10, 0, 0});
    ASSERT_TRUE(s);
    EXPECT_FALSE(s->arc);
  }
  const auto arc = through({0, 0, 0}, {{5, 2e-5, 0}}, {10, 0, 0});
  ASSERT_TRUE(arc);
  EXPECT_TRUE(arc->arc);
  // A coarser context takes that for a line, too.
  const auto coarse = through({0, 0, 0}, {{5, 2e-5, 0}}, {10, 0, 0}, {.coincident_mm = 1e-4});
  ASSERT_TRUE(coarse);
  EXPECT_FALSE(coarse->arc);
}

TEST(ViaPoint, SeveralMustLieOnOneRadiusAndInOrder) {
  const auto on = [](double degrees, double r = 10.0) {
    return Vec3{r * std::cos(degrees * kPi / 180.0), r * std::sin(degrees * kPi / 180.0), 0.0};
  };
  const auto s = through(on(0), {on(30), on(60), on(80)}, on(100));
  ASSERT_TRUE(s);
  EXPECT_NEAR(s->sweep * s->axis.z, kPi * 100.0 / 180.0, 1e-12);
  for (const auto& via :
       {std::vector<Vec3>{on(30, 10.02), on(60), on(80)}, std::vector<Vec3>{on(60), on(30)},
        std::vector<Vec3>{on(30), on(60), on(200)}, std::vector<Vec3>{on(30), {8, 8, 1}, on(80)}}) {
    const auto wrong = through(on(0), via, on(100));
    ASSERT_FALSE(wrong);
    EXPECT_EQ(wrong.error().code, "EXC-VIA");
  }
}

TEST(ViaPoint, OnTheLineBeyondItsEndsIsRefused) {
  EXPECT_FALSE(through({0, 0, 0}, {{11, 0, 0}}, {10, 0, 0}));
  EXPECT_FALSE(through({0, 0, 0}, {{-1, 0, 0}}, {10, 0, 0}));
}

TEST(ViaPoint, HelixRisesEvenlyAlongItsAxis) {
  const ViaOptions helix{.helix = true};
  const auto s = through({1, 0, 0}, {{0, 1, -1}}, {-1, 0, -2}, helix);
  ASSERT_TRUE(s);
  EXPECT_NEAR(s->sweep * s->axis.z, kPi, 1e-12);
  EXPECT_NEAR(norm(curves::at(*s, 0.5) - Vec3{0, 1, -1}), 0.0, 1e-12);
  const auto uneven = through({1, 0, 0}, {{0, 1, -1.5}}, {-1, 0, -2}, helix);
  ASSERT_FALSE(uneven);
  EXPECT_THAT(uneven.error().message, HasSubstr("rise"));
  const auto turn =
      through({1, 0, 0}, {{-0.5, -std::sqrt(0.75), -1}, {-0.5, std::sqrt(0.75), -2}}, {1, 0, -3}, helix);
  ASSERT_TRUE(turn);
  EXPECT_NEAR(turn->sweep * turn->axis.z, -2.0 * kPi, 1e-12);
  const auto plunge = through({1, 0, 0}, {{1, 0, -1}}, {1, 0, -2}, helix);
  ASSERT_TRUE(plunge);
  EXPECT_FALSE(plunge->arc);
}

// Any arc in space, by the via points that the writer gives it, is the same arc.
TEST(ViaPoint, RandomArcsComeBack) {
  std::mt19937 random(238);
  std::uniform_real_distribution<double> unit(-1.0, 1.0), radius(0.1, 200.0), angle(0.05, 2.0 * kPi - 0.05);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 z = normalised(Vec3{unit(random), unit(random), unit(random)});
    const Vec3 x = normalised(cross(z, Vec3{0.3, -0.7, 0.2}));
    const Vec3 y = cross(z, x), c = 300.0 * Vec3{unit(random), unit(random), unit(random)};
    const double r = radius(random), w = angle(random);
    const bool helix = i % 2 == 1;
    const double rise = helix ? 20.0 * unit(random) : 0.0;
    const auto at = [&](double t) {
      return c + r * std::cos(t * w) * x + r * std::sin(t * w) * y + t * rise * z;
    };
    const auto s = through(at(0), {at(0.5)}, at(1), {.helix = helix, .axis = z});
    ASSERT_TRUE(s);
    EXPECT_NEAR(std::abs(s->sweep), w, 1e-9);
    for (const double t : {0.2, 0.6, 0.9}) EXPECT_LT(norm(curves::at(*s, t) - at(t)), 1e-9);
    EXPECT_LT(norm(s->centre - c), 1e-8 * std::max(1.0, r));
  }
}

std::string exchange_file(const std::string& points) {
  return file_of(
      "#1=MACHINING_PROJECT('p','','',(#2));\n#2=PRODUCT_CONTEXT('','',#3,'');\n#3=APPLICATION_CONTEXT('');\n"
      "#4=PRODUCT_DEFINITION_FORMATION('','',#1);\n#5=PRODUCT_DEFINITION('p','',#4,#6);\n"
      "#6=PRODUCT_DEFINITION_CONTEXT('',#3,'');\n#7=PROCESS_PRODUCT_ASSOCIATION('','',#5,#8);\n"
      "#8=PRODUCT_DEFINITION_PROCESS('machining','',#9,'');\n#9=MACHINING_WORKPLAN('w','','','');\n"
      "#10=MACHINING_PROCESS_SEQUENCE_RELATIONSHIP('','',#9,#11,1.);\n"
      "#11=MACHINING_WORKINGSTEP('s','machining','','');\n"
      "#12=MACHINING_OPERATION_RELATIONSHIP('','machining',#11,#13);\n#13=FREEFORM_MILLING_OPERATION('o','','"
      "','');\n"
      "#14=MACHINING_TOOLPATH_SEQUENCE_RELATIONSHIP('','',#13,#15,1.);\n"
      "#15=MACHINING_TOOLPATH('t','cutter location trajectory','','');\n"
      "#20=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((#21))REPRESENTATION_CONTEXT('','"
      "'));\n"
      "#21=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n"
      "#30=ACTION_PROPERTY('basic curve','',#15);\n#31=ACTION_PROPERTY_REPRESENTATION('','',#30,#32);\n"
      "#32=REPRESENTATION('',(#33),#20);\n" +
      points);
}

model::Plan plan_with(const std::string& points) { return read_text(exchange_file(points)); }

Result<StepPath> path_in(const std::string& points) {
  const auto plan = plan_with(points);
  Job job;
  return path_of_step(
      plan, model::Ref<model::Executable>(plan.model.all(model::TypeId::kMachiningWorkingstep).at(0)), {},
      job);
}

TEST(ViaPoint, PolylineOfAFileBecomesLinesAndArcs) {
  const auto got = path_in(
      "#33=POLYLINE('',(#40,#41,#42,#43,#44,#45,#46));\n#40=CARTESIAN_POINT('',(0.,0.,0.));\n"
      "#41=CARTESIAN_POINT('',(10.,0.,0.));\n#42=VIA_ARC_POINT('',(15.,5.,0.));\n"
      "#43=CARTESIAN_POINT('',(10.,10.,0.));\n#44=VIA_HELIX_POINT('',(5.,5.,-1.));\n"
      "#45=CARTESIAN_POINT('',(10.,0.,-2.));\n#46=CARTESIAN_POINT('',(20.,0.,-2.));\n");
  ASSERT_TRUE(got) << to_text(got.error());
  const auto& p = got->path;
  ASSERT_EQ(p.size(), 5U);
  EXPECT_EQ(p.kind[1], model::MoveKind::kLine);
  EXPECT_EQ(p.kind[2], model::MoveKind::kArcCcw);
  EXPECT_EQ(p.kind[3], model::MoveKind::kArcCcw);
  EXPECT_EQ(p.kind[4], model::MoveKind::kLine);
  for (const std::size_t i : {2U, 3U}) {
    EXPECT_EQ(p.cx[i], 10.0);
    EXPECT_EQ(p.cy[i], 5.0);
  }
  EXPECT_EQ(p.point(3), (Vec3{10, 0, -2}));
}

// The uncertainty is stated in a unit of its own: a millimetre (#21) or an inch (#22).
model::Plan uncertain(const std::string& value, const char* unit, const std::string& points,
                      std::vector<std::string>* said = nullptr) {
  std::string text = exchange_file(points);
  const std::string bare = "GLOBAL_UNIT_ASSIGNED_CONTEXT((#21))";
  const auto at = text.find(bare);
  EXPECT_NE(at, std::string::npos);
  text.replace(at, bare.size(), "GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#25))" + bare);
  text.replace(text.find("#30="), 0,
               "#25=UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(" + value + ")," + unit +
                   ",'DISTANCE_ACCURACY_VALUE','');\n"
                   "#22=(CONVERSION_BASED_UNIT('inch',#23)LENGTH_UNIT()NAMED_UNIT(#24));\n"
                   "#23=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#21);\n"
                   "#24=DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.);\n");
  return read_text(text, said);
}

Result<StepPath> path_of(const model::Plan& plan) {
  Job job;
  return path_of_step(
      plan, model::Ref<model::Executable>(plan.model.all(model::TypeId::kMachiningWorkingstep).at(0)), {},
      job);
}

TEST(ViaPoint, WithinTheStatedUncertaintyOfANeighbourMakesALine) {
  struct Case {
    const char *value, *unit, *via;
    bool arc;
  };
  // 5E-5 inch are 1.27 micrometres: as a number of millimetres they were less than the distance.
  for (const Case& c :
       {Case{"0.001", "#21", "(0.,0.0005,0.)", false}, Case{"0.001", "#21", "(10.,0.0005,0.)", false},
        Case{"5.E-05", "#22", "(0.,0.0005,0.)", false}, Case{"0.0001", "#21", "(0.,0.0005,0.)", true},
        Case{"1.E-05", "#22", "(0.,0.0005,0.)", true}}) {
    SCOPED_TRACE(std::string(c.value) + c.unit + c.via);
    std::vector<std::string> said;
    const auto plan = uncertain(c.value, c.unit,
                                "#33=POLYLINE('',(#40,#41,#42));\n#40=CARTESIAN_POINT('',(0.,0.,0.));\n"
                                "#41=VIA_ARC_POINT(''," +
                                    std::string(c.via) + ");\n#42=CARTESIAN_POINT('',(10.,0.001,0.));\n",
                                &said);
    const auto got = path_of(plan);
    ASSERT_TRUE(got) << to_text(got.error());
    ASSERT_EQ(got->path.size(), 2U);
    EXPECT_EQ(got->path.kind[1] != model::MoveKind::kLine, c.arc);
    const auto warned = ::testing::Contains(HasSubstr("EXC-VIA"));
    if (c.arc) {
      EXPECT_THAT(said, ::testing::Not(warned));
    } else {
      EXPECT_THAT(said, warned);
      // Points stay as many: what stands beside the curve still fits it.
      const auto t = plan.model.all(model::TypeId::kCutterLocationTrajectory).at(0);
      const auto line = plan.model.at<model::CutterLocationTrajectory>(t).basiccurve;
      EXPECT_EQ(plan.model.at<model::Polyline>(line).points.size(), 3U);
    }
  }
}

TEST(ViaPoint, OneOfSeveralWithinTheUncertaintyLeavesTheArc) {
  const double h = std::sqrt(0.5) * 10.0;
  const auto at = [](double x, double y) {
    return "(" + std::to_string(x) + "," + std::to_string(y) + ",0.));\n";
  };
  const auto plan = uncertain("0.001", "#21",
                              "#33=POLYLINE('',(#40,#41,#42,#43));\n#40=CARTESIAN_POINT(''," + at(10, 0) +
                                  "#41=VIA_ARC_POINT(''," + at(10, 0.0005) + "#42=VIA_ARC_POINT(''," +
                                  at(h, h) + "#43=CARTESIAN_POINT(''," + at(0, 10));
  const auto got = path_of(plan);
  ASSERT_TRUE(got) << to_text(got.error());
  ASSERT_EQ(got->path.size(), 2U);
  EXPECT_EQ(got->path.kind[1], model::MoveKind::kArcCcw);
  EXPECT_NEAR(got->path.cx[1], 0.0, 1e-5);
}

TEST(ViaPoint, AtTheEndsOfAPolylineOrOfTwoKindsIsRefused) {
  const char* points =
      "#40=CARTESIAN_POINT('',(0.,0.,0.));\n#41=VIA_ARC_POINT('',(5.,5.,0.));\n"
      "#42=CARTESIAN_POINT('',(10.,0.,0.));\n#43=VIA_HELIX_POINT('',(8.,4.,0.));\n";
  for (const char* list : {"(#41,#40)", "(#40,#41)", "(#40,#41,#43,#42)", "(#41)", "()", "(#41,#43)"}) {
    const auto got = path_in("#33=POLYLINE(''," + std::string(list) + ");\n" + points);
    ASSERT_FALSE(got) << list;
    EXPECT_EQ(got.error().code, "EXC-CURVE") << list;
  }
}

TEST(ViaPoint, IsWrittenAsItWasRead) {
  const auto plan = plan_with(
      "#33=POLYLINE('',(#40,#41,#42));\n#40=CARTESIAN_POINT('',(0.,0.,0.));\n#41=VIA_ARC_POINT('',(5.,5.,0.))"
      ";\n"
      "#42=CARTESIAN_POINT('',(10.,0.,0.));\n");
  const auto lines = shapes(written(plan).bytes);
  EXPECT_THAT(lines, ::testing::Contains("VIA_ARC_POINT('',(5.,5.,0.));"));
  EXPECT_EQ(lost_on_the_way(plan), "");
}

TEST(ViaPoint, BecomesACircleInIso14649) {
  auto plan = plan_with(
      "#33=POLYLINE('',(#40,#41,#42));\n#40=CARTESIAN_POINT('',(0.,0.,0.));\n#41=VIA_ARC_POINT('',(5.,5.,0.))"
      ";\n"
      "#42=CARTESIAN_POINT('',(10.,0.,0.));\n");
  auto& m = plan.model;
  const auto step = m.all(model::TypeId::kMachiningWorkingstep).at(0);
  model::Axis2Placement3d place;
  model::CartesianPoint at;
  at.coordinates = {{100.0, 0.0, 0.0}, true};
  place.location = m.add(std::move(at));
  m.at<model::Workingstep>(step).toolpath_orientation = m.add(std::move(place));
  Job job;
  const auto out = write_iso14649(plan, job);
  ASSERT_TRUE(out) << to_text(out.error());
  EXPECT_THAT(out->bytes, ::testing::Not(HasSubstr("VIA_ARC_POINT")));
  EXPECT_THAT(out->bytes, HasSubstr("CIRCLE("));
  EXPECT_THAT(out->losses, ::testing::Contains(HasSubstr("no via points")));
  const auto again = read_text(out->bytes);
  const auto got = path_of_step(
      again, model::Ref<model::Executable>(again.model.all(model::TypeId::kMachiningWorkingstep).at(0)), {},
      job);
  ASSERT_TRUE(got) << to_text(got.error());
  ASSERT_EQ(got->path.size(), 2U);
  EXPECT_EQ(got->path.point(0), (Vec3{100, 0, 0}));
  EXPECT_EQ(got->path.cx[1], 105.0);
  EXPECT_EQ(got->path.kind[1], model::MoveKind::kArcCw);
}

/// A path along a trimmed HELIX, which AP238 does not have.
model::Plan with_helix(std::vector<double> axis) {
  model::Plan plan = plan_with(
      "#33=POLYLINE('',(#40,#41));\n#40=CARTESIAN_POINT('',(5.,0.,0.));\n"
      "#41=CARTESIAN_POINT('',(0.,5.,-4.5));\n");
  model::Model& m = plan.model;
  model::Axis2Placement3d place;
  model::CartesianPoint origin;
  origin.coordinates = {{0.0, 0.0, 0.0}, true};
  model::Direction z;
  z.direction_ratios = {std::move(axis), true};
  place.location = m.add(std::move(origin));
  place.axis = m.add(std::move(z));
  model::Helix helix;
  helix.position = m.add(std::move(place));
  helix.radius = 5.0;
  helix.pitch = 2.0;
  model::TrimmedCurve c;
  c.basis_curve = m.add(std::move(helix));
  const auto t = m.all(model::TypeId::kCutterLocationTrajectory).at(0);
  const auto line = m.at<model::Polyline>(m.at<model::CutterLocationTrajectory>(t).basiccurve);
  c.trim_1 = {{{.ref = line.points.items[0], .type = {}, .real = {}, .text = {}}}, true};
  c.trim_2 = {{{.ref = line.points.items[1], .type = {}, .real = {}, .text = {}}}, true};
  c.sense_agreement = true;
  c.master_representation = model::TrimmingPreference::kCartesian;
  m.at<model::CutterLocationTrajectory>(t).basiccurve = m.add(std::move(c));
  return plan;
}

bool follows_helix(const model::Plan& plan) {
  const auto& m = plan.model;
  const auto t = m.all(model::TypeId::kCutterLocationTrajectory).at(0);
  const auto* c = m.get<model::TrimmedCurve>(m.at<model::CutterLocationTrajectory>(t).basiccurve);
  return c != nullptr && m.holds<model::Helix>(c->basis_curve);
}

TEST(Helix, IsWrittenTurnByTurnWithViaPointsAndReadBackAsItWas) {
  const auto plan = with_helix({0, 0, -1});  // 4.5 high, 2 a turn: 2.25 turns down
  const Written out = written(plan);
  const auto lines = shapes(out.bytes);
  const auto vias =
      std::count_if(lines.begin(), lines.end(), [](const auto& l) { return l.rfind("VIA_HELIX", 0) == 0; });
  EXPECT_EQ(vias, 2 + 2 + 1);
  EXPECT_EQ(lost_on_the_way(plan), "");
  // Moved points are no longer that helix.
  std::string moved = out.bytes;
  moved.replace(moved.find("(0.,5.,-4.5)"), 12, "(0.,5.,-4.4)");
  EXPECT_FALSE(follows_helix(read_text(moved)));
  // Nor is a name that is none.
  std::string named = out.bytes;
  named.replace(named.find("'HELIX 5 "), 9, "'HELIX x ");
  EXPECT_FALSE(follows_helix(read_text(named)));
  EXPECT_TRUE(follows_helix(read_text(out.bytes)));
}

TEST(Helix, AboutAnotherAxisIsWrittenAsPointsAndSaidSo) {
  const auto plan = with_helix({0, 0.6, 0.8});
  const Written out = written(plan);
  EXPECT_THAT(out.bytes, ::testing::Not(HasSubstr("VIA_HELIX_POINT")));
  EXPECT_THAT(out.losses, ::testing::Contains(HasSubstr("does not turn about z")));
}

TEST(Helix, OfMoreTurnsThanItsPointsIsNone) {
  // A trillion turns in a name; its two points stay what they are.
  std::string named = written(with_helix({0, 0, -1})).bytes;
  const auto at = named.find("'HELIX 5 2 ");
  ASSERT_NE(at, std::string::npos);
  for (const char* name : {"'HELIX 5 1e-12 ", "'HELIX 5 1e-300 "}) {
    std::string text = named;
    text.replace(at, 11, name);
    EXPECT_FALSE(follows_helix(read_text(text))) << name;
  }
  const auto end = named.find('\'', at + 1);
  std::string text = named;
  text.replace(at, end - at, "'HELIX 5 2 0 0 0 0 0 -1 $ T 1 - 0 - 1e12");
  EXPECT_FALSE(follows_helix(read_text(text)));
}

TEST(Helix, OfTooManyPointsIsNotWrittenAndSaidSo) {
  for (const double turns : {9e4, 1e12}) {
    auto plan = with_helix({0, 0.6, 0.8});  // points within a micrometre: hundreds a turn
    auto& m = plan.model;
    const auto at = m.all(model::TypeId::kTrimmedCurve).at(0);
    auto& c = m.at<model::TrimmedCurve>(at);
    c.master_representation = model::TrimmingPreference::kParameter;
    c.trim_1 = {{{.ref = {}, .type = "PARAMETER_VALUE", .real = 0.0, .text = {}}}, true};
    c.trim_2 = {{{.ref = {}, .type = "PARAMETER_VALUE", .real = 360.0 * turns, .text = {}}}, true};
    Job job;
    const auto out = write_ap238(plan, job);
    if (out) {
      EXPECT_THAT(out->losses, ::testing::Contains(HasSubstr("is left out")));
    } else {
      EXPECT_THAT(out.error().message, HasSubstr("HELIX"));
    }
    EXPECT_FALSE(path_of(plan));
  }
}

}  // namespace
}  // namespace capstan::exchange::ap238
