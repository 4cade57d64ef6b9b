#include "tests/files/exchange/ap238/part/requirements.h"

namespace capstan::exchange::ap238 {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

template <class T>
class EachTolerance : public ::testing::Test {};

using Kinds =
    ::testing::Types<model::AngularityTolerance, model::CircularRunoutTolerance, model::RoundnessTolerance,
                     model::CoaxialityTolerance, model::ConcentricityTolerance, model::CylindricityTolerance,
                     model::FlatnessTolerance, model::LineProfileTolerance, model::ParallelismTolerance,
                     model::PerpendicularityTolerance, model::PositionTolerance, model::StraightnessTolerance,
                     model::SurfaceProfileTolerance, model::SymmetryTolerance, model::TotalRunoutTolerance>;
TYPED_TEST_SUITE(EachTolerance, Kinds);

template <class T>
T tolerance(const StatedBench& b) {
  T t;
  t.its_id = "G1";
  t.tolerance_value = 0.05;
  t.applied_to.push_back(b.hole);
  return t;
}

// Kinds that only make sense against datums (subtypes of geometric_tolerance_with_datum_reference).
template <class T>
constexpr bool kNeedsDatums =
    std::is_same_v<T, model::AngularityTolerance> || std::is_same_v<T, model::CircularRunoutTolerance> ||
    std::is_same_v<T, model::CoaxialityTolerance> || std::is_same_v<T, model::ConcentricityTolerance> ||
    std::is_same_v<T, model::ParallelismTolerance> || std::is_same_v<T, model::PerpendicularityTolerance> ||
    std::is_same_v<T, model::SymmetryTolerance> || std::is_same_v<T, model::TotalRunoutTolerance>;

TYPED_TEST(EachTolerance, ComesBackAsItWas) {
  StatedBench b;
  auto t = tolerance<TypeParam>(b);
  t.description = "as drawn";
  if (kNeedsDatums<TypeParam>) t.its_datum_system = b.system({b.on(b.datum("A"))});
  b.state(t);
  EXPECT_EQ(b.lost(), "");
  const std::string keyword(model::noun_type(TypeParam::kType).keyword);
  EXPECT_THAT(b.lines(), Contains(HasSubstr(keyword + "('G1','as drawn',#,#")));
}

TYPED_TEST(EachTolerance, ComesBackWithDatumsAndModifiers) {
  StatedBench b;
  const auto a = b.datum("A"), c = b.datum("C");
  auto t = tolerance<TypeParam>(b);
  t.its_datum_system = b.system({b.on(a), b.on(c, {"maximum_material_requirement", "translation"})});
  t.modifiers.items = {"free_state", "maximum_material_requirement"};
  t.modifiers.given = true;
  t.maximum_tolerance = 0.25;
  b.state(t);
  EXPECT_EQ(b.lost(), "");
  const auto lines = b.lines();
  EXPECT_THAT(lines, Contains(HasSubstr("GEOMETRIC_TOLERANCE_WITH_DATUM_REFERENCE((#))")));
  EXPECT_THAT(lines,
              Contains(HasSubstr(
                  "GEOMETRIC_TOLERANCE_WITH_MODIFIERS((.FREE_STATE.,.MAXIMUM_MATERIAL_REQUIREMENT.))")));
  EXPECT_THAT(lines, Contains(HasSubstr("GEOMETRIC_TOLERANCE_WITH_MAXIMUM_TOLERANCE(#)")));
  EXPECT_THAT(lines, Contains(HasSubstr(std::string(model::noun_type(TypeParam::kType).keyword) + "()")));
  EXPECT_THAT(lines, Contains("DATUM_SYSTEM('system',$,#,.F.,(#,#));"));
  EXPECT_THAT(lines,
              Contains("DATUM_REFERENCE_COMPARTMENT('',$,#,.F.,#,(SIMPLE_DATUM_REFERENCE_MODIFIER(.MAXIMUM_"
                       "MATERIAL_REQUIREMENT.),SIMPLE_DATUM_REFERENCE_MODIFIER(.TRANSLATION.)));"));
}

TEST(Ap238Tolerance, IsOfAFeature) {
  StatedBench b;
  b.state(tolerance<model::PositionTolerance>(b));
  const auto lines = b.lines();
  EXPECT_THAT(lines, Contains("POSITION_TOLERANCE('G1',$,#,#);"));
  EXPECT_THAT(
      lines,
      Contains(
          "(LENGTH_MEASURE_WITH_UNIT()MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(LENGTH_MEASURE(0.05),#)"
          "REPRESENTATION_ITEM(''));"));
}

TEST(Ap238Tolerance, IsOfSeveralFeaturesTogetherOrOfTheWholePart) {
  StatedBench b;
  auto t = tolerance<model::SurfaceProfileTolerance>(b);
  t.applied_to.push_back(b.pocket);
  b.state(t);
  t.its_id = "G2";
  t.applied_to = {};
  b.state(t);
  EXPECT_THAT(b.lines(), Contains("COMPOSITE_GROUP_SHAPE_ASPECT('','toleranced together',#,.T.);"));
  const auto again = read_text(written(b.plan).bytes);
  ASSERT_EQ(again.model.count(model::TypeId::kSurfaceProfileTolerance), 2U);
  const auto& two = again.model.at<model::SurfaceProfileTolerance>(
      again.model.all(model::TypeId::kSurfaceProfileTolerance)[0]);
  EXPECT_EQ(two.applied_to.size(), 2U);
  const auto& all = again.model.at<model::SurfaceProfileTolerance>(
      again.model.all(model::TypeId::kSurfaceProfileTolerance)[1]);
  EXPECT_TRUE(all.applied_to.empty());
  EXPECT_EQ(again.model.at<model::Workpiece>(all.its_workpiece).its_id, "part");
}

TEST(Ap238Tolerance, IsOfAPatternGivenAsACompositeElement) {
  StatedBench b;
  model::ShapeElement e;
  e.its_id = "pattern";
  e.description = "four holes";
  e.its_workpiece = b.workpiece;
  e.its_elements.push_back(b.hole);
  e.its_elements.push_back(b.pocket);
  const auto element = b.plan.model.add(e);
  auto t = tolerance<model::PositionTolerance>(b);
  t.applied_to = {};
  t.applied_to.push_back(element);
  b.state(t);
  EXPECT_EQ(b.lost(), "");
  EXPECT_THAT(b.lines(), Contains("COMPOSITE_GROUP_SHAPE_ASPECT('pattern','four holes',#,.T.);"));
}

TEST(Ap238Tolerance, HasUnitsUnequalZonesProjectionAndPlane) {
  StatedBench b;
  auto t = tolerance<model::FlatnessTolerance>(b);
  t.unit_size = 25.0;
  t.area_type = model::AreaUnitType::kRectangular;
  t.second_unit_size = 10.0;
  b.state(t);
  auto p = tolerance<model::SurfaceProfileTolerance>(b);
  p.its_id = "G2";
  p.displacement = 0.02;
  b.state(p);
  auto s = tolerance<model::StraightnessTolerance>(b);
  s.its_id = "G3";
  s.unit_size = 100.0;
  s.affected_plane = b.plan.model.add(b.placement(b.plan.model));
  b.state(s);
  auto a = tolerance<model::CylindricityTolerance>(b);
  a.its_id = "G4";
  a.unit_size = 20.0;
  a.area_type = model::AreaUnitType::kCylindrical;
  a.second_unit_angle = 0.5;
  b.state(a);
  auto q = tolerance<model::PositionTolerance>(b);
  q.its_id = "G5";
  q.zone_form = "cylindrical or circular";
  q.projected_zone_length = 12.5;
  q.projection_end = b.pocket;
  b.state(q);
  EXPECT_EQ(b.lost(), "");
  const auto lines = b.lines();
  EXPECT_THAT(lines, Contains(HasSubstr("GEOMETRIC_TOLERANCE_WITH_DEFINED_AREA_UNIT(.RECTANGULAR.,#)"
                                        "GEOMETRIC_TOLERANCE_WITH_DEFINED_UNIT(#)")));
  EXPECT_THAT(lines, Contains(HasSubstr("UNEQUALLY_DISPOSED_GEOMETRIC_TOLERANCE(#)")));
  EXPECT_THAT(lines, Contains("TOLERANCE_ZONE_FORM('cylindrical or circular');"));
  EXPECT_THAT(lines, Contains("TOLERANCE_ZONE('',$,#,.F.,(#),#);"));
  EXPECT_THAT(lines, Contains("PROJECTED_ZONE_DEFINITION(#,(),#,#);"));
}

TEST(Ap238Tolerance, ReadsTheOlderForms) {
  StatedBench b;
  std::string bytes = written(b.plan).bytes;
  const auto number = [&](const std::string& keyword) {
    const auto at = bytes.find("=" + keyword);
    const auto hash = bytes.rfind('#', at);
    return bytes.substr(hash, at - hash);
  };
  const std::string shape = number("PRODUCT_DEFINITION_SHAPE"), feature = number("INSTANCED_FEATURE");
  ASSERT_EQ(shape.front(), '#');
  std::string extra =
      "#901=DATUM('',$,SHAPE,.F.,'A');\n#902=DATUM_FEATURE('face',$,SHAPE,.T.);\n"
      "#903=SHAPE_ASPECT_RELATIONSHIP('',$,#902,#901);\n"
      "#904=REFERENCED_MODIFIED_DATUM(2,#901,.LEAST_MATERIAL_CONDITION.);\n#905=DATUM_REFERENCE(1,#901);\n"
      "#906=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(0.002),#907);\n"
      "#907=(CONVERSION_BASED_UNIT('INCH',#908)LENGTH_UNIT()NAMED_UNIT(#909));\n"
      "#908=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#910);\n#909=DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,"
      "0.,0.);\n"
      "#910=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n"
      "#911=(GEOMETRIC_TOLERANCE('old','',#906,FEATURE)GEOMETRIC_TOLERANCE_WITH_DATUM_REFERENCE((#904,#905))"
      "MODIFIED_GEOMETRIC_TOLERANCE(.MAXIMUM_MATERIAL_CONDITION.)POSITION_TOLERANCE());\n";
  const auto put = [&](const std::string& what, const std::string& by) {
    for (auto at = extra.find(what); at != std::string::npos; at = extra.find(what, at + 1)) {
      if (extra[at - 1] == ',') extra.replace(at, what.size(), by);
    }
  };
  put("SHAPE", shape);
  put("FEATURE", feature);
  bytes.insert(bytes.find("ENDSEC;\nEND-ISO"), extra);
  const auto plan = read_text(bytes);
  ASSERT_EQ(plan.model.count(model::TypeId::kPositionTolerance), 1U);
  const auto& t =
      plan.model.at<model::PositionTolerance>(plan.model.all(model::TypeId::kPositionTolerance)[0]);
  EXPECT_NEAR(*t.tolerance_value, 0.0508, 1e-12);
  EXPECT_THAT(t.modifiers.items, ::testing::ElementsAre("maximum_material_requirement"));
  ASSERT_TRUE(t.its_datum_system);
  const auto& s = plan.model.at<model::DatumSystem>(t.its_datum_system);
  ASSERT_EQ(s.constituents.size(), 2U);
  EXPECT_TRUE(plan.model.at<model::DatumReference>(s.constituents[0]).modifiers.items.empty());
  EXPECT_THAT(plan.model.at<model::DatumReference>(s.constituents[1]).modifiers.items,
              ::testing::ElementsAre("least_material_requirement"));
  const auto lines = shapes(written(plan).bytes);
  EXPECT_THAT(lines,
              Contains(HasSubstr("GEOMETRIC_TOLERANCE_WITH_MODIFIERS((.MAXIMUM_MATERIAL_REQUIREMENT.))")));
}

TEST(Ap238Dimension, OfSizeComesBack) {
  StatedBench b;
  model::SizeDimension d;
  d.its_id = "D1";
  d.kind = "diameter";
  d.applied_to = b.hole;
  d.nominal_value = 10.0;
  model::PlusMinusValue v;
  v.upper_limit = 0.02;
  v.lower_limit = 0.01;
  v.significant_digits = 2;
  d.implicit_tolerance = b.plan.model.add(v);
  b.state(d);
  model::SizeDimension fit;
  fit.kind = "diameter";
  fit.applied_to = b.pocket;
  fit.nominal_value = 8.0;
  fit.qualifiers.items = {"average", "reference"};
  fit.qualifiers.given = true;
  model::LimitsAndFits h7;
  h7.form_variance = "H";
  h7.zone_variance = "hole";
  h7.tolerance_grade = "7";
  h7.source = "ISO 286-2";
  fit.implicit_tolerance = b.plan.model.add(h7);
  b.state(fit);
  model::SizeDimension angle;
  angle.kind = "angle";
  angle.applied_to = b.pocket;
  angle.angle_selection = model::AngleRelator::kSmall;
  angle.nominal_angle = 0.7;
  angle.upper_angle_limit = 0.01;
  angle.lower_angle_limit = -0.02;
  b.state(angle);
  model::SizeDimension range;
  range.kind = "width";
  range.applied_to = b.pocket;
  range.upper_range = 5.2;
  range.lower_range = 5.0;
  b.state(range);
  EXPECT_EQ(b.lost(), "");
  const auto lines = b.lines();
  EXPECT_THAT(lines, Contains("DIMENSIONAL_SIZE(#,'diameter');"));
  EXPECT_THAT(lines, Contains("ANGULAR_SIZE(#,'angle',.SMALL.);"));
  EXPECT_THAT(lines, Contains("LIMITS_AND_FITS('H','hole','7','ISO 286-2');"));
  EXPECT_THAT(lines, Contains("PLUS_MINUS_TOLERANCE(#,#);"));
  EXPECT_THAT(lines, Contains("TOLERANCE_VALUE(#,#);"));
  EXPECT_THAT(lines, Contains(HasSubstr("LENGTH_MEASURE(-0.01)")));
  EXPECT_THAT(lines, Contains("TYPE_QUALIFIER('reference');"));
  EXPECT_THAT(lines, Contains("SHAPE_DIMENSION_REPRESENTATION('',(#,#),#);"));
  EXPECT_THAT(lines, Contains(HasSubstr("REPRESENTATION_ITEM('upper limit')")));
  EXPECT_THAT(lines, Contains("ID_ATTRIBUTE('D1',#);"));
}

TEST(Ap238Dimension, OfLocationComesBack) {
  StatedBench b;
  model::LocationDimension d;
  d.kind = "linear distance";
  d.origin = b.hole;
  d.target = b.pocket;
  d.nominal_value = 42.5;
  b.state(d);
  d.directed = true;
  d.its_id = "D2";
  b.state(d);
  model::LocationDimension a;
  a.kind = "angle";
  a.origin = b.datum("A", b.hole);
  a.target = b.pocket;
  a.nominal_angle = 1.2;
  a.angle_selection = model::AngleRelator::kLarge;
  b.state(a);
  EXPECT_EQ(b.lost(), "");
  const auto lines = b.lines();
  EXPECT_THAT(lines, Contains("DIMENSIONAL_LOCATION('linear distance',$,#,#);"));
  EXPECT_THAT(lines, Contains("DIRECTED_DIMENSIONAL_LOCATION('linear distance',$,#,#);"));
  EXPECT_THAT(lines, Contains("ANGULAR_LOCATION('angle',$,#,#,.LARGE.);"));
}

TEST(Ap238Dimension, AlongACurveComesBack) {
  StatedBench b;
  model::Polyline line;
  line.name = "";
  for (const double x : {0.0, 7.0}) {
    model::CartesianPoint p;
    p.name = "";
    p.coordinates.items = {x, 0.0, 0.0};
    p.coordinates.given = true;
    line.points.push_back(b.plan.model.add(p));
  }
  const auto curve = b.plan.model.add(line);
  model::SizeDimension d;
  d.kind = "curve length";
  d.applied_to = b.hole;
  d.nominal_value = 7.0;
  d.measurement_path = curve;
  b.state(d);
  EXPECT_EQ(b.lost(), "");
  EXPECT_THAT(b.lines(), Contains("DIMENSIONAL_SIZE_WITH_PATH(#,'curve length',#);"));
}

TEST(Ap238Tolerance, OfAFaceOfAKeptSolidStaysConnected) {
  StatedBench b;
  std::string bytes = written(b.plan).bytes;
  const auto at = bytes.find("=PRODUCT_DEFINITION_SHAPE");
  const auto hash = bytes.rfind('#', at);
  const std::string shape = bytes.substr(hash, at - hash);
  bytes.insert(
      bytes.find("ENDSEC;\nEND-ISO"),
      "#901=SHAPE_ASPECT('face','GDT'," + shape +
          ",.T.);\n"
          "#902=FLATNESS_TOLERANCE('F','',#903,#901);\n#903=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(0.1),#"
          "904);\n"
          "#904=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n"
          "#905=GEOMETRIC_ITEM_SPECIFIC_USAGE('','GDT',#901,#906,#907);\n"
          "#906=ADVANCED_BREP_SHAPE_REPRESENTATION('',(#908),#909);\n#908=MANIFOLD_SOLID_BREP('',#910);\n"
          "#910=CLOSED_SHELL('',(#907));\n#907=ADVANCED_FACE('top',(),#911,.T.);\n#911=PLANE('',#912);\n"
          "#912=AXIS2_PLACEMENT_3D('',#913,$,$);\n#913=CARTESIAN_POINT('',(0.,0.,0.));\n"
          "#909=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((#904))"
          "REPRESENTATION_CONTEXT('',''));\n#914=SHAPE_DEFINITION_REPRESENTATION(" +
          shape + ",#906);\n");
  const auto plan = read_text(bytes);
  ASSERT_EQ(plan.model.count(model::TypeId::kFlatnessTolerance), 1U);
  const auto& t =
      plan.model.at<model::FlatnessTolerance>(plan.model.all(model::TypeId::kFlatnessTolerance)[0]);
  ASSERT_EQ(t.applied_to.size(), 1U);
  ASSERT_EQ(t.applied_to[0].type, model::TypeId::kShapeElement);
  const auto& e = plan.model.at<model::ShapeElement>(t.applied_to[0]);
  ASSERT_EQ(e.explicit_representation.size(), 1U);
  const auto again = written(plan).bytes;
  EXPECT_THAT(shapes(again), Contains(HasSubstr("ADVANCED_FACE('top',(),#,.T.);")));
  EXPECT_THAT(shapes(again), Contains(HasSubstr("GEOMETRIC_ITEM_SPECIFIC_USAGE('',")));
  const auto twice = read_text(again);
  const auto& u =
      twice.model.at<model::FlatnessTolerance>(twice.model.all(model::TypeId::kFlatnessTolerance)[0]);
  ASSERT_EQ(u.applied_to.size(), 1U);
  EXPECT_EQ(twice.model.at<model::ShapeElement>(u.applied_to[0]).explicit_representation.size(), 1U);
}

}  // namespace
}  // namespace capstan::exchange::ap238
