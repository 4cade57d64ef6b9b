#include "planner/files/exchange/conformance/rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "planner/files/exchange/common/embedded.h"
#include "tests/files/exchange/conformance/support.h"

namespace capstan::exchange::conformance {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const express::Dictionary& ap238() { return express::Dictionary::ap238(); }

// Millimetre, second, millimetre per second, 1 per second, degree.
const std::string kUnits =
    "#901=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n"
    "#902=(NAMED_UNIT(*)SI_UNIT($,.SECOND.)TIME_UNIT());\n"
    "#903=DERIVED_UNIT((#904,#905));\n#904=DERIVED_UNIT_ELEMENT(#901,1.);\n#905=DERIVED_UNIT_ELEMENT(#902,-1."
    ");\n"
    "#906=DERIVED_UNIT((#905));\n"
    "#907=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));\n"
    "#908=GEOMETRIC_REPRESENTATION_CONTEXT('','',3);\n";

// The instances of an action property of #1: '#n' its own, then two more, with an item.
std::string property(int n, const std::string& name, const std::string& item) {
  const auto id = [n](int k) { return "#" + std::to_string(n + k); };
  return id(0) + "=ACTION_PROPERTY('" + name + "','',#1);\n" + id(1) +
         "=ACTION_PROPERTY_REPRESENTATION('',''," + id(0) + "," + id(2) + ");\n" + id(2) +
         "=REPRESENTATION('',(" + id(3) + "),#908);\n" + id(3) + "=" + item + ";\n";
}

std::string length(const std::string& name, const std::string& unit = "#901") {
  return "(LENGTH_MEASURE_WITH_UNIT()MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(LENGTH_MEASURE(1.)," +
         unit + ")REPRESENTATION_ITEM('" + name + "'))";
}
std::string text(const std::string& t) { return "DESCRIPTIVE_REPRESENTATION_ITEM('','" + t + "')"; }

TEST(RuleTable, IsReadWhole) {
  const auto rules = read_rules(embedded_file("conformance/rules.table"), ap238());
  EXPECT_GT(rules.size(), 600U);
  for (const Rule& r : rules) {
    EXPECT_LE(r.least, r.most);
    for (const Guard& g : r.guards) EXPECT_FALSE(g.values.empty()) << ap238().keyword(r.entity);
  }
}

TEST(RuleTable, RefusesWhatItDoesNotUnderstand) {
  EXPECT_THROW((void)read_rules("for no_such_entity\n", ap238()), std::logic_error);
  EXPECT_THROW((void)read_rules("for pocket\n  1 colour 'red'\n", ap238()), std::logic_error);
  EXPECT_THROW((void)read_rules("for pocket\n  1 property 'a' as heat\n", ap238()), std::logic_error);
  EXPECT_THROW((void)read_rules("for pocket\n  1 property 'a\n", ap238()), std::logic_error);
}

TEST(Rules, WantRequiredPropertiesWithAllowedTexts) {
  const std::string functions = kUnits + "#1=MACHINING_FUNCTIONS('','milling','','');\n";
  EXPECT_THAT(faults_in(functions + property(10, "coolant", text("coolant on"))), IsEmpty());
  EXPECT_THAT(faults_in(functions), ElementsAre(HasSubstr("has no property 'coolant'; expected 1")));
  EXPECT_THAT(faults_in(functions + property(10, "coolant", text("coolant on")) +
                        property(20, "coolant", text("coolant off"))),
              ElementsAre(HasSubstr("has the property 'coolant' twice; expected 1")));
  EXPECT_THAT(
      faults_in(functions + property(10, "coolant", text("flooded"))),
      ElementsAre(
          AllOf(HasSubstr("#1 MACHINING_FUNCTIONS 'milling' has a property 'coolant' (#10) of another form"),
                HasSubstr("text 'coolant on' 'coolant off'"), HasSubstr("[SCH-RULE]"))));
  // What the rule is not about is let alone.
  EXPECT_THAT(faults_in(kUnits + "#1=MACHINING_FUNCTIONS('','something else','','');\n"), IsEmpty());
}

TEST(Rules, WantLengthsToBeLengths) {
  const std::string strategy = kUnits + "#1=DRILLING_TYPE_STRATEGY('','','','');\n";
  EXPECT_THAT(faults_in(strategy + property(10, "depth of start", length(""))), IsEmpty());
  EXPECT_THAT(faults_in(strategy + property(10, "depth of start",
                                            "MEASURE_REPRESENTATION_ITEM('',NUMERIC_MEASURE(1.),#901)")),
              ElementsAre(HasSubstr("'depth of start' (#10) of another form; expected length")));
}

TEST(Rules, WantUnitsOfTheRightDimension) {
  const auto feed = [](const std::string& unit) {
    return faults_in(kUnits +
                     "#1=MACHINING_FEED_SPEED_REPRESENTATION('feed speed',(#2),#908);\n"
                     "#2=MEASURE_REPRESENTATION_ITEM('feed speed',NUMERIC_MEASURE(10.)," +
                     unit + ");\n");
  };
  EXPECT_THAT(feed("#903"), IsEmpty());
  EXPECT_THAT(feed("#906"), ElementsAre(HasSubstr("expected number unit length/time")));
  EXPECT_THAT(feed("#901"), ElementsAre(HasSubstr("expected number unit length/time")));
  const auto spindle = [](const std::string& unit) {
    return faults_in(kUnits +
                     "#1=MACHINING_SPINDLE_SPEED_REPRESENTATION('spindle speed',(#2),#908);\n"
                     "#2=MEASURE_REPRESENTATION_ITEM('rotational speed',NUMERIC_MEASURE(10.)," +
                     unit + ");\n");
  };
  EXPECT_THAT(spindle("#906"), IsEmpty());
  EXPECT_THAT(spindle("#903"), ElementsAre(HasSubstr("expected number unit 1/time")));
  EXPECT_THAT(
      faults_in(kUnits + "#1=" + length("", "#907") + ";\n"),
      ElementsAre(AllOf(HasSubstr("LENGTH_MEASURE_WITH_UNIT has a unit of another kind; expected length"))));
}

TEST(Rules, FollowRelationshipsToTheirTargets) {
  const std::string step =
      kUnits +
      "#1=MACHINING_WORKINGSTEP('','machining','','');\n#2=MACHINING_FEATURE_PROCESS('','','','');\n"
      "#3=PRODUCT_DEFINITION_PROCESS('machining','',#2,'');\n#4=MACHINING_FEATURE_RELATIONSHIP('','',#1,#2);"
      "\n"
      "#5=MACHINING_RAPID_MOVEMENT('','','','');\n";
  EXPECT_THAT(faults_in(step + "#6=MACHINING_OPERATION_RELATIONSHIP('','',#1,#5);\n"), IsEmpty());
  EXPECT_THAT(faults_in(step), ElementsAre(HasSubstr("has no MACHINING_OPERATION_RELATIONSHIP; expected 1")));
  EXPECT_THAT(faults_in(step + "#6=MACHINING_OPERATION_RELATIONSHIP('','',#1,#2);\n"),
              ElementsAre(AllOf(HasSubstr("leads by #6"), HasSubstr("expected MACHINING_OPERATION"))));
}

TEST(Rules, WantAToolForAnOperationThatCuts) {
  const auto faults = faults_in(kUnits + "#1=PLANE_MILLING_OPERATION('','finishing','','');\n");
  EXPECT_THAT(faults,
              ElementsAre(HasSubstr("has no tool"), HasSubstr("has no MACHINING_TECHNOLOGY_RELATIONSHIP"),
                          HasSubstr("has no MACHINING_FUNCTIONS_RELATIONSHIP")));
}

TEST(Rules, KnowDescriptionsOfEditionFour) {
  EXPECT_THAT(faults_in("#1=MACHINING_TOOLPATH('','connect middle','','');\n"), IsEmpty());
  EXPECT_THAT(faults_in("#1=MACHINING_TOOLPATH('','wandering','','');\n"),
              ElementsAre(HasSubstr("has the description 'wandering'")));
}

TEST(Rules, CompareTheParametersOfProfiles) {
  const std::string profile =
      kUnits +
      "#1=CIRCULAR_CLOSED_PROFILE('','',#2,.F.);\n#2=PRODUCT_DEFINITION_SHAPE('',$,#3);\n"
      "#3=FEATURE_COMPONENT_DEFINITION('','');\n#4=PROPERTY_DEFINITION('','',#1);\n"
      "#5=SHAPE_DEFINITION_REPRESENTATION(#4,#6);\n"
      "#8=AXIS2_PLACEMENT_3D('orientation',#9,$,$);\n#9=CARTESIAN_POINT('',(0.,0.,0.));\n";
  const std::string shape = "#6=SHAPE_REPRESENTATION_WITH_PARAMETERS('',(#7,#8),#908);\n";
  EXPECT_THAT(faults_in(profile + shape + "#7=" + length("diameter") + ";\n"), IsEmpty());
  EXPECT_THAT(faults_in(profile + shape + "#7=" + length("radius") + ";\n"),
              ElementsAre(HasSubstr("has no parameter 'diameter' as length; expected 1")));
  EXPECT_THAT(faults_in(profile + "#6=SHAPE_REPRESENTATION_WITH_PARAMETERS('',(#8),#908);\n"),
              ElementsAre(HasSubstr("has 1 parameter; expected 2"), HasSubstr("'diameter'")));
}

// Every property of every strategy shows the same huge representation.
TEST(Rules, StopWhereAFileSharesTooMuch) {
  constexpr int kItems = 20000, kStrategies = 4000;
  std::string data = kUnits + "#10=REPRESENTATION('',(#1000";
  for (int i = 1; i < kItems; ++i) data += ",#" + std::to_string(1000 + i);
  data += "),#908);\n";
  for (int i = 0; i < kItems; ++i) data += "#" + std::to_string(1000 + i) + "=DIRECTION('',(1.,0.));\n";
  for (int i = 0; i < kStrategies; ++i) {
    const int id = 100000 + 3 * i;
    const std::string strategy = "#" + std::to_string(id), property = "#" + std::to_string(id + 1);
    data += strategy + "=DRILLING_TYPE_STRATEGY('','','','');\n" + property +
            "=ACTION_PROPERTY('depth of start',''," + strategy + ");\n#" + std::to_string(id + 2) +
            "=ACTION_PROPERTY_REPRESENTATION('',''," + property + ",#10);\n";
  }
  EXPECT_THAT(faults_in(data), ::testing::Contains(HasSubstr("[SCH-LIMIT]")));
}

// A round hole as annex J 3 has it: three shape aspects, each led to by one relationship.
TEST(Rules, WantTheShapeAspectsOfAFeature) {
  const std::string hole =
      kUnits +
      "#1=(CHARACTERIZED_OBJECT('','')FEATURE_DEFINITION()INSTANCED_FEATURE()ROUND_HOLE()SHAPE_ASPECT('H','',"
      "#90,.T.));\n"
      "#2=PRODUCT_DEFINITION_SHAPE('','',#1);\n#3=SHAPE_DEFINITION_REPRESENTATION(#2,#4);\n"
      "#4=SHAPE_REPRESENTATION_WITH_PARAMETERS('',(#5),#908);\n#5=AXIS2_PLACEMENT_3D('orientation',#6,$,$);\n"
      "#6=CARTESIAN_POINT('',(0.,0.,0.));\n"
      "#90=PRODUCT_DEFINITION_SHAPE('',$,#91);\n#91=PRODUCT_DEFINITION('','',#92,#95);\n"
      "#92=PRODUCT_DEFINITION_FORMATION('','',#93);\n#93=PRODUCT('','','',(#94));\n#94=PRODUCT_CONTEXT('',#"
      "96,'');\n"
      "#95=PRODUCT_DEFINITION_CONTEXT('',#96,'');\n#96=APPLICATION_CONTEXT('');\n";
  const auto without_components = faults_in(hole);
  EXPECT_THAT(
      without_components,
      ElementsAre(
          HasSubstr("no shape aspect 'diameter occurrence' with a SHAPE_DEFINING_RELATIONSHIP"),
          HasSubstr("no shape aspect 'hole depth occurrence'"),
          HasSubstr("no shape aspect 'bottom condition occurrence' with a FEATURE_COMPONENT_RELATIONSHIP "
                    "'hole bottom usage' from a HOLE_BOTTOM")));
  const std::string bottom =
      "#20=SHAPE_ASPECT('','bottom condition occurrence',#2,.F.);\n"
      "#21=FEATURE_COMPONENT_RELATIONSHIP('','hole bottom "
      "usage',#22,#20);\n#22=HOLE_BOTTOM('','through',#23,.F.);\n"
      "#23=PRODUCT_DEFINITION_SHAPE('',$,#24);\n#24=FEATURE_COMPONENT_DEFINITION('','');\n";
  EXPECT_EQ(faults_in(hole + bottom).size(), without_components.size() - 1);
}

}  // namespace
}  // namespace capstan::exchange::conformance
