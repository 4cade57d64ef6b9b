#include "planner/files/exchange/conformance/check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/files/exchange/conformance/support.h"

namespace capstan::exchange {
namespace {

using conformance::faults_in;
using conformance::faults_of;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

TEST(CheckSchema, KnowsBothNamesOfTheSchema) {
  EXPECT_TRUE(is_ap238_schema("MODEL_BASED_INTEGRATED_MANUFACTURING_SCHEMA {1 0 10303 238 4 1 1}"));
  EXPECT_TRUE(is_ap238_schema("integrated_cnc_schema"));
  EXPECT_FALSE(is_ap238_schema("AUTOMOTIVE_DESIGN"));
  EXPECT_THAT(
      faults_of(
          "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\n"
          "FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nDATA;\n#1=CARTESIAN_POINT('',$);\nENDSEC;\n"
          "END-ISO-10303-21;\n"),
      ElementsAre(HasSubstr("[SCH-SCHEMA]")));
}

TEST(CheckSchema, IsOfferedFilesWhoseHeaderNamesIt) {
  EXPECT_TRUE(declares_ap238(conformance::file_of("")));
  EXPECT_TRUE(declares_ap238(
      "/* FILE_SCHEMA; */ISO-10303-21;HEADER;file_schema( ( 'integrated_cnc_schema {1 0 10303}' ));"));
  EXPECT_FALSE(declares_ap238("ISO-10303-21;HEADER;FILE_SCHEMA(('MACHINING_SCHEMA'));ENDSEC;"));
  EXPECT_FALSE(declares_ap238("ISO-10303-21;HEADER;FILE_SCHEMA(('"));
  EXPECT_FALSE(declares_ap238("G1 X10"));
}

TEST(CheckSchema, AcceptsWhatIsRight) {
  EXPECT_THAT(faults_in("#1=CARTESIAN_POINT('',(0.,1.));\n"
                        "#2=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n"
                        "#3=(LENGTH_MEASURE_WITH_UNIT()MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(LENGTH_"
                        "MEASURE(1.),#2)"
                        "REPRESENTATION_ITEM('depth'));\n"
                        "#4=!CAPSTAN_THING(1,2,3);\n"),
              IsEmpty());
}

TEST(CheckSchema, NamesUnknownEntitiesAndWrongNumbersOfParameters) {
  EXPECT_THAT(faults_in("#1=TROCHOIDAL_THING('',(0.,1.));\n#2=CARTESIAN_POINT('');\n"),
              ElementsAre(AllOf(HasSubstr("#1 TROCHOIDAL_THING"), HasSubstr("[SCH-ENTITY]")),
                          AllOf(HasSubstr("has 1 parameters; expected 2 (name, coordinates)"),
                                HasSubstr("[SCH-COUNT]"))));
}

TEST(CheckSchema, AllowsADollarOnlyWhereOptionalAndAStarOnlyWhereDerived) {
  EXPECT_THAT(faults_in("#1=CARTESIAN_POINT($,(0.));\n"        // name is mandatory
                        "#2=AXIS2_PLACEMENT_3D('',#1,$,$);\n"  // both directions are optional
                        "#3=CARTESIAN_POINT('',*);\n"
                        "#4=SI_UNIT($,$,.METRE.);\n"),  // dimensions are derived, the prefix is optional
              ElementsAre(AllOf(HasSubstr("#1 name"), HasSubstr("[SCH-MANDATORY]")),
                          AllOf(HasSubstr("#3 coordinates"), HasSubstr("[SCH-DERIVED]")),
                          AllOf(HasSubstr("#4 dimensions"), HasSubstr("[SCH-DERIVED]"))));
}

TEST(CheckSchema, ComparesEveryKindOfValueWithItsType) {
  const std::string sound = "#1=CARTESIAN_POINT('',(0.,0.));\n#2=DIRECTION('',(0.,1.));\n";
  const auto fault = [&](const std::string& more) { return faults_in(sound + more); };
  EXPECT_THAT(fault("#3=CARTESIAN_POINT('',(0,1.));\n"),
              ElementsAre(AllOf(HasSubstr("0 has the wrong type; expected "
                                          "LENGTH_MEASURE (real)"),
                                HasSubstr("[SCH-TYPE]"))));
  EXPECT_THAT(fault("#3=CARTESIAN_POINT(7,(0.));\n"), ElementsAre(HasSubstr("[SCH-TYPE]")));
  EXPECT_THAT(fault("#3=CARTESIAN_POINT('',0.);\n"), ElementsAre(HasSubstr("[SCH-TYPE]")));
  EXPECT_THAT(fault("#3=CARTESIAN_POINT('',(0.,0.,0.,0.));\n"),
              ElementsAre(AllOf(HasSubstr("there are 4 elements"), HasSubstr("[SCH-BOUNDS]"))));
  EXPECT_THAT(
      fault("#3=VECTOR('',#1,1.);\n"),
      ElementsAre(AllOf(HasSubstr("#1 is a CARTESIAN_POINT; expected DIRECTION"), HasSubstr("[SCH-TYPE]"))));
  EXPECT_THAT(fault("#3=VECTOR('',#9,1.);\n"),
              ElementsAre(AllOf(HasSubstr("no instance #9"), HasSubstr("[SCH-REFERENCE]"))));
  EXPECT_THAT(fault("#3=LINE('',#2,#4);\n#4=VECTOR('',#2,1.);\n"),
              ElementsAre(HasSubstr("expected CARTESIAN_POINT")));
  EXPECT_THAT(fault("#3=SI_UNIT(*,.MILI.,.METRE.);\n"),
              ElementsAre(AllOf(HasSubstr(".MILI. is not a value of SI_PREFIX"), HasSubstr("[SCH-ENUM]"))));
  EXPECT_THAT(fault("#3=SHAPE_ASPECT('','',#4,.X.);\n#4=PRODUCT_DEFINITION_SHAPE('','',#3);\n"),
              ElementsAre(HasSubstr("[SCH-ENUM]")));
  EXPECT_THAT(fault("#3=CALENDAR_DATE(2024,40,1);\n"),
              ElementsAre(AllOf(HasSubstr("40 is outside the range of DAY_IN_MONTH_NUMBER"),
                                HasSubstr("[SCH-BOUNDS]"))));
}

TEST(CheckSchema, WantsValuesOfSelectsToSayTheirType) {
  const std::string unit = "#1=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n";
  EXPECT_THAT(faults_in(unit + "#2=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.),#1);\n"), IsEmpty());
  EXPECT_THAT(faults_in(unit + "#2=LENGTH_MEASURE_WITH_UNIT(1.,#1);\n"),
              ElementsAre(HasSubstr("does not say which type of the select it has")));
  EXPECT_THAT(faults_in(unit + "#2=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(1),#1);\n"),
              ElementsAre(HasSubstr("1 has the wrong type")));
  EXPECT_THAT(faults_in(unit + "#2=LENGTH_MEASURE_WITH_UNIT(SI_UNIT_NAME(.METRE.),#1);\n"),
              ElementsAre(HasSubstr("[SCH-TYPE]")));
}

TEST(CheckSchema, FindsElementsTwiceInASet) {
  EXPECT_THAT(faults_in("#1=DIRECTION('',(0.,1.));\n#2=GEOMETRIC_REPRESENTATION_CONTEXT('','',3);\n"
                        "#3=REPRESENTATION('',(#1,#1),#2);\n"),
              ElementsAre(AllOf(HasSubstr("#1 is there twice"), HasSubstr("[SCH-BOUNDS]"))));
}

TEST(CheckSchema, WantsComplexInstancesCompleteSortedAndConcrete) {
  EXPECT_THAT(faults_in("#1=(LENGTH_UNIT()SI_UNIT(.MILLI.,.METRE.));\n"),
              ElementsAre(AllOf(HasSubstr("lacks supertypes of its parts; expected NAMED_UNIT"),
                                HasSubstr("[SCH-COMPLEX]"))));
  EXPECT_THAT(faults_in("#1=(NAMED_UNIT(*)LENGTH_UNIT()SI_UNIT(.MILLI.,.METRE.));\n"),
              ElementsAre(HasSubstr("not in alphabetical order")));
  EXPECT_THAT(faults_in("#1=(LENGTH_UNIT()LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n"),
              ElementsAre(HasSubstr("LENGTH_UNIT is there twice")));
  EXPECT_THAT(faults_in("#1=(LENGTH_UNIT()NAMED_UNIT($)SI_UNIT(.MILLI.,.METRE.));\n"),
              ElementsAre(HasSubstr("[SCH-DERIVED]")));
  EXPECT_THAT(faults_in("#1=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.)TIME_UNIT());\n"),
              ElementsAre(HasSubstr("the parts LENGTH_UNIT, TIME_UNIT exclude each other")));
  EXPECT_THAT(faults_in("#1=CHARACTERIZED_CHAIN_BASED_ITEM_WITHIN_REPRESENTATION();\n"), SizeIs(1));
}

TEST(CheckSchema, LeavesReferencesToOtherFilesAlone) {
  const std::string text = conformance::file_of("#1=VECTOR('',#20,1.);\n");
  const auto data = text.find("DATA;");
  EXPECT_THAT(faults_of(text.substr(0, data) + "REFERENCE;\n#20=<other.stp#direction>;\nENDSEC;\n" +
                        text.substr(data)),
              IsEmpty());
}

TEST(CheckSchema, ReportsFiftyFaultsOfAKindAndTheNumberOfTheRest) {
  std::string data;
  for (int i = 1; i <= 60; ++i) data += "#" + std::to_string(i) + "=CARTESIAN_POINT($,(0.));\n";
  const auto faults = faults_in(data);
  ASSERT_THAT(faults, SizeIs(kReportedFaultsPerCode + 1));
  EXPECT_THAT(faults.back(), HasSubstr("and 10 more faults of the kind SCH-MANDATORY"));
}

}  // namespace
}  // namespace capstan::exchange
