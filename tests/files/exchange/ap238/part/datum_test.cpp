#include "tests/files/exchange/ap238/part/requirements.h"

namespace capstan::exchange::ap238 {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

TEST(Ap238Datum, IsEstablishedByADatumFeature) {
  StatedBench b;
  b.datum("A");
  EXPECT_EQ(b.lost(), "");
  const auto lines = b.lines();
  EXPECT_THAT(lines, Contains("DATUM('',$,#,.F.,'A');"));
  EXPECT_THAT(lines, Contains("DATUM_FEATURE('feature of A',$,#,.T.);"));
  EXPECT_THAT(lines, Contains("SHAPE_ASPECT_RELATIONSHIP('',$,#,#);"));
}

TEST(Ap238Datum, IsEstablishedByAManufacturingFeatureThatIsADatumFeatureToo) {
  StatedBench b;
  b.datum("B", b.hole);
  EXPECT_EQ(b.lost(), "");
  EXPECT_THAT(b.lines(), Contains(HasSubstr("DATUM_FEATURE()")));
}

TEST(Ap238Datum, HasTargetsOfEachKind) {
  StatedBench b;
  model::Datum d;
  d.identification = "A";
  const auto target = [&](auto t, const char* id) {
    t.target_id = id;
    t.its_workpiece = b.workpiece;
    if constexpr (requires { t.placement; }) t.placement = b.plan.model.add(b.placement(b.plan.model));
    if constexpr (requires { t.length; }) t.length = 8.0;
    if constexpr (requires { t.width; }) t.width = 4.0;
    if constexpr (requires { t.diameter; }) t.diameter = 6.0;
    const auto r = b.plan.model.add(t);
    b.plan.model.at<model::Workpiece>(b.workpiece).its_requirements.push_back(r);
    d.established_by.push_back(r);
  };
  target(model::PointDatumTarget{}, "1");
  target(model::LineDatumTarget{}, "2");
  target(model::RectangleDatumTarget{}, "3");
  target(model::CircleDatumTarget{}, "4");
  target(model::CircularCurveDatumTarget{}, "5");
  model::DatumTarget drawn;
  drawn.description = "the forging's parting line";
  target(drawn, "6");
  b.state(d);
  EXPECT_EQ(b.lost(), "");
  const auto lines = b.lines();
  for (const char* kind : {"point", "line", "rectangle", "circle", "circular curve"}) {
    EXPECT_THAT(lines,
                Contains(HasSubstr(std::string("PLACED_DATUM_TARGET_FEATURE('','") + kind + "',#,.T.,'")));
  }
  EXPECT_THAT(lines, Contains("DATUM_TARGET('','the forging''s parting line',#,.T.,'6');"));
  EXPECT_THAT(lines, Contains(HasSubstr("REPRESENTATION_ITEM('target width')")));
  EXPECT_THAT(lines, Contains("AXIS2_PLACEMENT_3D('orientation',#,$,$);"));
  EXPECT_THAT(lines, Contains("SHAPE_REPRESENTATION_WITH_PARAMETERS('',(#,#,#),#);"));
}

TEST(Ap238Datum, SystemsHaveCommonDatumsAndModifiersWithValues) {
  StatedBench b;
  const auto a = b.datum("A"), c = b.datum("B");
  model::DatumReference common;
  common.its_elements.push_back(b.plan.model.add(b.on(a, {"free_state"})));
  common.its_elements.push_back(b.plan.model.add(b.on(c)));
  auto projected = b.on(b.datum("C"), {"basic"});
  projected.valued_modifier = "projected";
  projected.modifier_value = 15.0;
  model::PositionTolerance t;
  t.tolerance_value = 0.1;
  t.applied_to.push_back(b.hole);
  t.its_datum_system = b.system({common, projected});
  b.state(t);
  EXPECT_EQ(b.lost(), "");
  const auto lines = b.lines();
  EXPECT_THAT(lines, Contains("DATUM_REFERENCE_COMPARTMENT('',$,#,.F.,COMMON_DATUM_LIST((#,#)),$);"));
  EXPECT_THAT(
      lines,
      Contains("DATUM_REFERENCE_ELEMENT('',$,#,.F.,#,(SIMPLE_DATUM_REFERENCE_MODIFIER(.FREE_STATE.)));"));
  EXPECT_THAT(lines, Contains("DATUM_REFERENCE_MODIFIER_WITH_VALUE(.PROJECTED.,#);"));
}

}  // namespace
}  // namespace capstan::exchange::ap238
