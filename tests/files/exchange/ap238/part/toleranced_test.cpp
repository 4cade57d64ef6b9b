#include "tests/files/exchange/ap238/part/feature_support.h"

namespace capstan::exchange::ap238 {
namespace {

struct Holed : FeatureBench {
  model::Ref<model::RoundHole> hole(model::Ref<model::TolerancedLengthMeasure> diameter) {
    auto f = basic<model::RoundHole>("H");
    f.diameter = diameter;
    f.bottom_condition = as<model::HoleBottomCondition>(m.add(model::FlatHoleBottom{}));
    return m.add(std::move(f));
  }
};

TEST(TolerancedLength, IsAMeasureQualifiedByItsLimitsAndDigits) {
  Holed b;
  b.hole(b.length(22.0, 0.05, 0.02, 4));
  const Shapes s(b.plan);
  EXPECT_TRUE(
      s.has("(LENGTH_MEASURE_WITH_UNIT()MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(LENGTH_MEASURE(22.),#)"
            "QUALIFIED_REPRESENTATION_ITEM((#,#,#))REPRESENTATION_ITEM('diameter'));"));
  EXPECT_TRUE(s.has("STANDARD_UNCERTAINTY('upper limit','',0.05);"));
  EXPECT_TRUE(s.has("STANDARD_UNCERTAINTY('lower limit','',0.02);"));
  EXPECT_TRUE(s.has("PRECISION_QUALIFIER(4);"));
  EXPECT_EQ(lost_on_the_way(b.plan), "");
}

TEST(TolerancedLength, WithoutToleranceIsAMeasure) {
  Holed b;
  b.hole(b.length(8.5));
  const Shapes s(b.plan);
  EXPECT_TRUE(
      s.has("(LENGTH_MEASURE_WITH_UNIT()MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(LENGTH_MEASURE(8.5),#)"
            "REPRESENTATION_ITEM('diameter'));"));
  EXPECT_EQ(lost_on_the_way(b.plan), "");
}

TEST(TolerancedLength, CarriesAFitOfISO14649ByTheDimensionItRepresents) {
  Holed b;
  model::LimitsAndFits fit;
  fit.deviation = 0.0;
  fit.grade = 7.0;
  fit.its_fitting_type = model::FittingType::kHole;
  const auto d = b.length(20.0);
  b.m.at<model::TolerancedLengthMeasure>(d).implicit_tolerance =
      model::OneOf<model::PlusMinusValue, model::LimitsAndFits>(model::AnyRef(b.m.add(std::move(fit))));
  b.hole(d);
  const Shapes s(b.plan);
  EXPECT_TRUE(s.has("LIMITS_AND_FITS('','hole','7','');"));
  EXPECT_TRUE(s.has("PLUS_MINUS_TOLERANCE(#,#);"));
  EXPECT_TRUE(s.has("DIMENSIONAL_SIZE(#,'diameter');"));
  EXPECT_TRUE(s.has("DIMENSIONAL_CHARACTERISTIC_REPRESENTATION(#,#);"));
  EXPECT_TRUE(s.has("STANDARD_UNCERTAINTY('deviation','',0.);"));
  EXPECT_EQ(lost_on_the_way(b.plan), "");
}

TEST(TolerancedLength, CarriesAFitByItsLetter) {
  Holed b;
  model::LimitsAndFits fit;
  fit.grade = 6.0;
  fit.its_fitting_type = model::FittingType::kShaft;
  fit.form_variance = "g";
  fit.zone_variance = "shaft";
  fit.tolerance_grade = "6";
  fit.source = "ISO 286";
  const auto d = b.length(20.0);
  b.m.at<model::TolerancedLengthMeasure>(d).implicit_tolerance =
      model::OneOf<model::PlusMinusValue, model::LimitsAndFits>(model::AnyRef(b.m.add(std::move(fit))));
  b.hole(d);
  EXPECT_TRUE(Shapes(b.plan).has("LIMITS_AND_FITS('g','shaft','6','ISO 286');"));
  EXPECT_EQ(lost_on_the_way(b.plan), "");
}

// A hole of one inch with limits, in a file of inches; the depth only as a course of travel.
std::string inch_hole(const std::string& diameter) {
  return file_of(
      "#1=PRODUCT_DEFINITION('','',#2,$);\n#2=PRODUCT_DEFINITION_FORMATION('','',#3);\n#3=PRODUCT('P','P','',"
      "());\n"
      "#4=PRODUCT_DEFINITION_SHAPE('','',#1);\n"
      "#10=(CHARACTERIZED_OBJECT('','')FEATURE_DEFINITION()INSTANCED_FEATURE()ROUND_HOLE()SHAPE_ASPECT('H',''"
      ",#4,.T.));\n"
      "#11=PRODUCT_DEFINITION_SHAPE('','',#10);\n#12=SHAPE_DEFINITION_REPRESENTATION(#11,#13);\n"
      "#13=SHAPE_REPRESENTATION_WITH_PARAMETERS('',(#14),#50);\n#14=AXIS2_PLACEMENT_3D('orientation',#15,$,$)"
      ";\n"
      "#15=CARTESIAN_POINT('',(2.,0.,-0.5));\n"
      "#20=SHAPE_ASPECT('','diameter "
      "occurrence',#11,.F.);\n#21=SHAPE_DEFINING_RELATIONSHIP('diameter','profile usage',#22,#20);\n"
      "#22=CIRCULAR_CLOSED_PROFILE('','',#60,.F.);\n#23=PROPERTY_DEFINITION('','',#22);\n#24=SHAPE_"
      "DEFINITION_REPRESENTATION(#23,#25);\n"
      "#25=SHAPE_REPRESENTATION_WITH_PARAMETERS('',(#26,#14),#50);\n#26=" +
      diameter +
      "\n"
      "#27=STANDARD_UNCERTAINTY('upper limit','',0.002);\n#28=STANDARD_UNCERTAINTY('lower limit','',0.001);\n"
      "#30=SHAPE_ASPECT('','hole depth occurrence',#11,.F.);\n"
      "#31=SHAPE_DEFINING_RELATIONSHIP('hole depth','path feature component usage',#32,#30);\n"
      "#32=PATH_FEATURE_COMPONENT('','linear',#60,.F.);\n#33=PROPERTY_DEFINITION('','linear',#32);\n"
      "#34=SHAPE_DEFINITION_REPRESENTATION(#33,#35);\n#35=SHAPE_REPRESENTATION_WITH_PARAMETERS('',(#36,#14),#"
      "50);\n"
      "#36=(LENGTH_MEASURE_WITH_UNIT()MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(LENGTH_MEASURE(0.5),#51)"
      "REPRESENTATION_ITEM('distance'));\n"
      "#37=PROPERTY_DEFINITION_REPRESENTATION(#33,#38);\n#38=DIRECTION_SHAPE_REPRESENTATION('',(#39),#50);\n"
      "#39=DIRECTION('',(0.,0.,1.));\n#40=SHAPE_ASPECT('','bottom condition occurrence',#11,.F.);\n"
      "#41=FEATURE_COMPONENT_RELATIONSHIP('hole depth start','hole bottom "
      "usage',#42,#40);\n#42=HOLE_BOTTOM('','flat',#60,.F.);\n"
      "#50=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((#51,#54))REPRESENTATION_CONTEXT("
      "'',''));\n"
      "#51=(CONVERSION_BASED_UNIT('INCH',#52)LENGTH_UNIT()NAMED_UNIT(#55));\n"
      "#52=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#53);\n#53=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(."
      "MILLI.,.METRE.));\n"
      "#54=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));\n#55=DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0."
      ",0.);\n"
      "#60=PRODUCT_DEFINITION_SHAPE('feature component',$,#61);\n#61=FEATURE_COMPONENT_DEFINITION('feature "
      "component','');\n");
}

TEST(TolerancedLength, ReadsLimitsInTheUnitOfTheMeasure) {
  std::vector<std::string> said;
  const auto plan = read_text(
      inch_hole(
          "(LENGTH_MEASURE_WITH_UNIT()MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT("
          "LENGTH_MEASURE(1.),#51)QUALIFIED_REPRESENTATION_ITEM((#27,#28))REPRESENTATION_ITEM('diameter'));"),
      &said);
  const auto holes = plan.model.all(model::TypeId::kRoundHole);
  ASSERT_EQ(holes.size(), 1u);
  const auto& hole = plan.model.at<model::RoundHole>(holes.front());
  const auto& d = plan.model.at<model::TolerancedLengthMeasure>(hole.diameter);
  EXPECT_NEAR(*d.theoretical_size, 25.4, 1e-12);
  const auto* limits = plan.model.get<model::PlusMinusValue>(d.implicit_tolerance);
  ASSERT_NE(limits, nullptr);
  EXPECT_NEAR(*limits->upper_limit, 0.0508, 1e-12);
  EXPECT_NEAR(*limits->lower_limit, 0.0254, 1e-12);
}

TEST(TolerancedLength, ReadsAPlainMeasureItemToo) {
  const auto plan = read_text(inch_hole("MEASURE_REPRESENTATION_ITEM('diameter',LENGTH_MEASURE(0.5),#51);"));
  const auto& hole = plan.model.at<model::RoundHole>(plan.model.all(model::TypeId::kRoundHole).front());
  EXPECT_NEAR(*plan.model.at<model::TolerancedLengthMeasure>(hole.diameter).theoretical_size, 12.7, 1e-12);
}

constexpr const char* kQualified =
    "(LENGTH_MEASURE_WITH_UNIT()MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT("
    "LENGTH_MEASURE(1.),#51)QUALIFIED_REPRESENTATION_ITEM((#27,#28))REPRESENTATION_ITEM('diameter'));";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  EXPECT_NE(text.find(from), std::string::npos) << from;
  return text.find(from) == std::string::npos ? text : text.replace(text.find(from), from.size(), to);
}

TEST(TolerancedLength, HasNoLimitThatIsNotFiniteInMillimetres) {
  std::vector<std::string> said;
  const auto plan = read_text(replaced(inch_hole(kQualified), "'',0.002)", "'',1.E308)"), &said);
  const auto& hole = plan.model.at<model::RoundHole>(plan.model.all(model::TypeId::kRoundHole).front());
  const auto& d = plan.model.at<model::TolerancedLengthMeasure>(hole.diameter);
  const auto* limits = plan.model.get<model::PlusMinusValue>(d.implicit_tolerance);
  ASSERT_NE(limits, nullptr);
  EXPECT_FALSE(limits->upper_limit.has_value());
  EXPECT_NEAR(*limits->lower_limit, 0.0254, 1e-12);
  EXPECT_THAT(said, ::testing::Contains(::testing::AllOf(
                        ::testing::HasSubstr("#27"), ::testing::HasSubstr("the upper limit is not finite"),
                        ::testing::HasSubstr("EXC-VALUE"))));
  (void)written(plan);
}

TEST(TolerancedLength, HasAGradeOnlyOfDecimalNumbers) {
  for (const char* grade : {"inf", "nan", "0x10", "1e999"}) {
    Holed b;
    model::LimitsAndFits fit;
    fit.grade = 7.0;
    fit.tolerance_grade = "seven";
    fit.zone_variance = "hole";
    const auto d = b.length(20.0);
    b.m.at<model::TolerancedLengthMeasure>(d).implicit_tolerance =
        model::OneOf<model::PlusMinusValue, model::LimitsAndFits>(model::AnyRef(b.m.add(std::move(fit))));
    b.hole(d);
    const auto plan = read_text(replaced(written(b.plan).bytes, "'seven'", "'" + std::string(grade) + "'"));
    const auto fits = plan.model.all(model::TypeId::kLimitsAndFits);
    ASSERT_EQ(fits.size(), 1u);
    EXPECT_FALSE(plan.model.at<model::LimitsAndFits>(fits.front()).grade.has_value()) << grade;
  }
}

// --- faults in geometry ---

TEST(Geometry, ThatTheProjectDoesNotNeedIsWarnedOfWhereItIsAtFault) {
  for (const char* coordinates : {"(1.E308,0.,-0.5)", "(2.,.T.,-0.5)"}) {
    std::vector<std::string> said;
    const auto plan = read_text(replaced(inch_hole(kQualified), "(2.,0.,-0.5)", coordinates), &said);
    EXPECT_EQ(plan.model.count(model::TypeId::kRoundHole), 1u);
    EXPECT_THAT(said, ::testing::Contains(::testing::AllOf(::testing::HasSubstr("warning: #15"),
                                                           ::testing::HasSubstr("EXC-VALUE"))));
    (void)written(plan);
  }
}

TEST(Geometry, ThatTheProjectNeedsMustBeWithoutFault) {
  Holed b;
  model::MachiningWorkingstep step;
  step.its_id = "step";
  step.its_feature = b.as<model::ManufacturingFeature>(b.hole(b.length(20.0)));
  b.step(std::move(step));
  const std::string text = replaced(written(b.plan).bytes, "(20.,30.,5.)", "(20.,.T.,5.)");
  Job job;
  const auto plan = read_bytes(text, "test.stpnc", {}, job);
  ASSERT_FALSE(plan.has_value());
  EXPECT_THAT(plan.error().message, ::testing::HasSubstr("CARTESIAN_POINT.coordinates"));
}

TEST(NumericParameter, KeepsTheNameAndUnitThatItsRoleDoesNotSay) {
  for (const auto& [name, unit, mm] :
       std::vector<std::tuple<std::string, std::string, double>>{{"profile length", "mm", 4.0},
                                                                 {"PROFILE LENGTH", "MM", 4.0},
                                                                 {"profile length", "inch", 101.6},
                                                                 {"", "", 4.0}}) {
    FeatureBench b;
    auto f = b.basic<model::PlanarFace>("F");
    f.course_of_travel = b.line(120, 0, 1, 0);
    model::LinearProfile p;
    p.profile_length = b.number(name, 4.0, unit);
    f.removal_boundary = b.m.add(std::move(p));
    f.its_boss.given = true;
    b.m.add(std::move(f));
    const bool said = name == "profile length" && unit == "mm";
    const Shapes s(b.plan);
    std::string number = mm == 4.0 ? "4." : "101.6";
    EXPECT_TRUE(
        s.has("(LENGTH_MEASURE_WITH_UNIT()MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(LENGTH_MEASURE(" +
              number + "),#)" + (said ? "" : "QUALIFIED_REPRESENTATION_ITEM((#))") +
              "REPRESENTATION_ITEM('profile length'));"))
        << unit;
    EXPECT_EQ(s.count("TYPE_QUALIFIER('" + name + " [" + unit + "]');"), said ? 0 : 1);
    EXPECT_EQ(lost_on_the_way(b.plan), "") << unit;
  }
}

}  // namespace
}  // namespace capstan::exchange::ap238
