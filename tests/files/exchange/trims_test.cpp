#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "planner/model/features/curve_points.h"
#include "tests/files/exchange/ap238/part/feature_support.h"

// Angles that trim circles, in files of both forms.

namespace capstan::exchange {
namespace {

using model::AnyRef;

std::string iso14649(const std::string& from, const std::string& to, const char* sense) {
  return R"(ISO-10303-21;
HEADER;
FILE_DESCRIPTION((''),'2;1');
FILE_NAME('t.p21','',(''),(''),'','','');
FILE_SCHEMA(('MACHINING_SCHEMA'));
ENDSEC;
DATA;
#1=PROJECT('P',#2,(#4),$,$,$);
#2=WORKPLAN('MAIN',(),$,$,$);
#4=WORKPIECE('W',$,0.1,$,$,$,());
#20=CARTESIAN_POINT('',(10.,0.,0.));
#21=AXIS2_PLACEMENT_3D('',#20,$,$);
#22=CIRCLE('',#21,5.);
#23=TRIMMED_CURVE('',#22,(PARAMETER_VALUE()" +
         from + ")),(PARAMETER_VALUE(" + to + "))," + sense + R"(,.PARAMETER.);
#24=GENERAL_CLOSED_PROFILE($,#23);
#25=PLANE('',#21);
#26=CLOSED_POCKET('P',#4,(),#21,#25,(),$,$,$,$,#24);
ENDSEC;
END-ISO-10303-21;
)";
}

struct Read {
  model::Plan plan;
  std::vector<Diagnostic> said;
};

Read read(const std::string& text) {
  Job job;
  auto plan = read_bytes(text, "t.p21", {}, job);
  EXPECT_TRUE(plan) << (plan ? "" : to_text(plan.error()));
  return {plan ? *std::move(plan) : model::Plan{}, job.take_diagnostics()};
}

/// Start, end and length of the only trimmed curve.
void expect_quarter(const model::Plan& plan, double y0, double x1) {
  const auto all = plan.model.all(model::TypeId::kTrimmedCurve);
  ASSERT_EQ(all.size(), 1u);
  const auto p = model::curve_points(plan.model, all.front(), 0.001);
  ASSERT_TRUE(p) << p.error().message;
  EXPECT_LT(norm(p->front() - geometry::Vec3{10, y0, 0}), 1e-9);
  EXPECT_LT(norm(p->back() - geometry::Vec3{x1, 0, 0}), 1e-9);
  double length = 0.0;
  for (std::size_t i = 1; i < p->size(); ++i) length += norm((*p)[i] - (*p)[i - 1]);
  EXPECT_NEAR(length, 5.0 * 3.14159265358979 / 2.0, 0.01);
}

TEST(Trims, OfISO14649AreDegreesAndRunAcross0) {
  expect_quarter(read(iso14649("270.", "0.", ".T.")).plan, -5, 15);
  expect_quarter(read(iso14649("270.", "360.", ".T.")).plan, -5, 15);
  expect_quarter(read(iso14649("90.", "0.", ".F.")).plan, 5, 15);
}

TEST(Trims, ThatAreRadiansWithoutDoubtAreTakenSoAndItIsSaid) {
  const Read r = read(iso14649("4.71238898038469", "0.", ".T."));
  expect_quarter(r.plan, -5, 15);
  bool said = false;
  for (const auto& d : r.said) {
    said = said || (d.code == "EXC-UNIT-ANGLE" && d.message.find("270 degrees") != std::string::npos);
  }
  EXPECT_TRUE(said);
}

}  // namespace

namespace ap238 {
namespace {

TEST(Trims, ComeBackFromAP238AsTheyWere) {
  FeatureBench b;
  model::Circle c;
  c.name = "";
  c.position = b.placement(10, 0, 0);
  c.radius = 5.0;
  model::TrimmedCurve t;
  t.name = "";
  t.basis_curve = b.as<model::Curve>(b.m.add(std::move(c)));
  t.trim_1.given = t.trim_2.given = true;
  t.trim_1.items.push_back({.ref = {}, .type = "PARAMETER_VALUE", .real = 270.0, .text = {}});
  t.trim_2.items.push_back({.ref = {}, .type = "PARAMETER_VALUE", .real = 0.0, .text = {}});
  t.sense_agreement = true;
  t.master_representation = model::TrimmingPreference::kParameter;
  model::GeneralClosedProfile g;
  g.closed_profile_shape = b.as<model::BoundedCurve>(b.m.add(std::move(t)));
  auto f = b.basic<model::ClosedPocket>("P");
  f.its_boss.given = true;
  f.bottom_condition = b.as<model::PocketBottomCondition>(b.m.add(model::PlanarPocketBottomCondition{}));
  f.feature_boundary = b.as<model::ClosedProfile>(b.m.add(std::move(g)));
  b.m.add(std::move(f));
  const std::string bytes = written(b.plan).bytes;
  EXPECT_NE(bytes.find("PARAMETER_VALUE(4.71238898038469"), std::string::npos) << "radians in the file";
  expect_quarter(read_text(bytes), -5, 15);
}

}  // namespace
}  // namespace ap238
}  // namespace capstan::exchange
