// What CAD files ask of their shape: sizes, geometric tolerances, datums, texture, from the instances of
// Part 21.

#include "planner/files/exchange/brep/read_pmi.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "planner/files/p21/read/parse.h"
#include "tests/support/corpus.h"

namespace capstan::exchange {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// One face #1, with the shape aspect #3 that is it; units: #10 mm, #12 inch.
constexpr const char* kCommon =
    "#1=ADVANCED_FACE('',(),#90,.T.);\n#2=PRODUCT_DEFINITION_SHAPE('','',#91);\n"
    "#3=SHAPE_ASPECT('','',#2,.T.);\n#4=GEOMETRIC_ITEM_SPECIFIC_USAGE('','',#3,#92,#1);\n"
    "#5=ADVANCED_FACE('',(),#90,.T.);\n#6=SHAPE_ASPECT('','',#2,.T.);\n"
    "#7=ITEM_IDENTIFIED_REPRESENTATION_USAGE('',$,#6,#92,SET_REPRESENTATION_ITEM((#5,#1)));\n"
    "#10=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n"
    "#11=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#10);\n"
    "#12=(CONVERSION_BASED_UNIT('INCH',#11)LENGTH_UNIT()NAMED_UNIT(#93));\n";

std::string measure(const std::string& id, const std::string& value, const std::string& unit,
                    const std::string& name = "") {
  return id + "=(LENGTH_MEASURE_WITH_UNIT()MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(LENGTH_MEASURE(" +
         value + ")," + unit + ")REPRESENTATION_ITEM('" + name + "'));\n";
}

/// A diameter #20 of the aspect with items #30, #31, … and what else is said.
std::string diameter(const std::string& items, const std::string& more, const std::string& aspect = "#3") {
  return "#20=DIMENSIONAL_SIZE(" + aspect + ",'diameter');\n#21=SHAPE_DIMENSION_REPRESENTATION('',(" + items +
         "),#94);\n#22=DIMENSIONAL_CHARACTERISTIC_REPRESENTATION(#20,#21);\n" + more;
}

Pmi pmi_of(const std::string& data) {
  Job job;
  const auto file = p21::parse(
      "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\n"
      "FILE_SCHEMA(('AP242'));\nENDSEC;\nDATA;\n" +
          std::string(kCommon) + data + "ENDSEC;\nEND-ISO-10303-21;\n",
      "part.step", {}, job);
  EXPECT_TRUE(file) << (file ? "" : file.error().message);
  return file ? read_pmi(*file) : Pmi{};
}

StatedSize only_size(const std::string& data) {
  const Pmi p = pmi_of(data);
  EXPECT_EQ(p.sizes.size(), 1U);
  EXPECT_THAT(p.unread, IsEmpty());
  return p.sizes.empty() ? StatedSize{} : p.sizes.front();
}

TEST(ReadPmi, DeviationsOfASizeAreSigned) {
  const StatedSize s =
      only_size(diameter("#30", measure("#30", "35.", "#10", "nominal value") +
                                    measure("#31", "-0.2", "#10") + measure("#32", "0.", "#10") +
                                    "#33=TOLERANCE_VALUE(#31,#32);\n#34=PLUS_MINUS_TOLERANCE(#33,#20);\n"));
  EXPECT_EQ(s.id, 20);
  EXPECT_EQ(s.kind, "diameter");
  EXPECT_EQ(s.nominal_mm, 35.0);
  EXPECT_EQ(s.lower_mm, -0.2);
  EXPECT_EQ(s.upper_mm, 0.0);
  EXPECT_THAT(s.faces, ElementsAre(1));
}

TEST(ReadPmi, InchesBecomeMillimetres) {
  const StatedSize s =
      only_size(diameter("#30", measure("#30", "0.5", "#12", "nominal value") +
                                    measure("#31", "-0.001", "#12") + measure("#32", "0.002", "#12") +
                                    "#33=TOLERANCE_VALUE(#31,#32);\n#34=PLUS_MINUS_TOLERANCE(#33,#20);\n"));
  EXPECT_DOUBLE_EQ(*s.nominal_mm, 12.7);
  EXPECT_DOUBLE_EQ(*s.lower_mm, -0.0254);
  EXPECT_DOUBLE_EQ(*s.upper_mm, 0.0508);
}

TEST(ReadPmi, LimitsAreReadByTheirNameOrByTheirQualifier) {
  const StatedSize named = only_size(diameter("#30,#31", measure("#30", "35.2", "#10", "upper limit") +
                                                             measure("#31", "34.8", "#10", "lower limit")));
  const StatedSize qualified = only_size(
      diameter("#30,#31",
               "#30=(LENGTH_MEASURE_WITH_UNIT()MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(LENGTH_MEASURE("
               "35.2),#10)QUALIFIED_REPRESENTATION_ITEM((#40))REPRESENTATION_ITEM(''));\n"
               "#31=(LENGTH_MEASURE_WITH_UNIT()MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(LENGTH_MEASURE("
               "34.8),#10)QUALIFIED_REPRESENTATION_ITEM((#41))REPRESENTATION_ITEM(''));\n"
               "#40=TYPE_QUALIFIER('maximum');\n#41=TYPE_QUALIFIER('minimum');\n"));
  for (const StatedSize& s : {named, qualified}) {
    EXPECT_FALSE(s.nominal_mm);
    EXPECT_EQ(s.least_mm, 34.8);
    EXPECT_EQ(s.greatest_mm, 35.2);
  }
}

TEST(ReadPmi, AFitIsItsLetterAndItsGrade) {
  const std::string nominal = measure("#30", "8.", "#10", "nominal value");
  const StatedSize hole = only_size(diameter(
      "#30", nominal + "#33=LIMITS_AND_FITS('H','hole','7','');\n#34=PLUS_MINUS_TOLERANCE(#33,#20);\n"));
  EXPECT_EQ(hole.fit, "H7");
  EXPECT_FALSE(hole.of_shaft);
  const StatedSize shaft = only_size(diameter(
      "#30", nominal + "#33=LIMITS_AND_FITS('g','shaft','IT6','');\n#34=PLUS_MINUS_TOLERANCE(#33,#20);\n"));
  EXPECT_EQ(shaft.fit, "g6");
  EXPECT_TRUE(shaft.of_shaft);
}

TEST(ReadPmi, FacesOfACompositeAspectAreThoseOfItsParts) {
  const StatedSize s =
      only_size(diameter("#30",
                         measure("#30", "8.", "#10") + "#50=COMPOSITE_SHAPE_ASPECT('','',#2,.F.);\n"
                                                       "#51=SHAPE_ASPECT_RELATIONSHIP('',$,#50,#3);\n"
                                                       "#52=SHAPE_ASPECT_RELATIONSHIP('',$,#50,#6);\n",
                         "#50"));
  EXPECT_THAT(s.faces, ElementsAre(1, 5));
}

TEST(ReadPmi, ADistanceHasTwoEndsThatAreNoPartsOfEachOther) {
  const StatedSize s =
      only_size(measure("#30", "8.", "#10") +
                "#60=SHAPE_ASPECT('','',#2,.T.);\n#61=GEOMETRIC_ITEM_SPECIFIC_USAGE('','',#60,#92,#5);\n"
                "#20=DIMENSIONAL_LOCATION('linear distance',$,#3,#60);\n"
                "#21=SHAPE_DIMENSION_REPRESENTATION('',(#30),#94);\n"
                "#22=DIMENSIONAL_CHARACTERISTIC_REPRESENTATION(#20,#21);\n");
  EXPECT_EQ(s.kind, "linear distance");
  EXPECT_THAT(s.faces, ElementsAre(1));
  EXPECT_THAT(s.to, ElementsAre(5));
}

TEST(ReadPmi, AZoneHasItsValueFormModifiersAndDatumsByPrecedence) {
  const Pmi p = pmi_of(
      measure("#30", "0.05", "#10") +
      "#40=(GEOMETRIC_TOLERANCE('Position.1','',#30,#3)GEOMETRIC_TOLERANCE_WITH_DATUM_REFERENCE((#41))"
      "GEOMETRIC_TOLERANCE_WITH_MODIFIERS((.MAXIMUM_MATERIAL_REQUIREMENT.))POSITION_TOLERANCE());\n"
      "#41=DATUM_SYSTEM('',$,#2,.F.,(#42,#43));\n"
      "#42=DATUM_REFERENCE_COMPARTMENT('',$,#2,.F.,#44,$);\n"
      "#43=DATUM_REFERENCE_COMPARTMENT('',$,#2,.F.,COMMON_DATUM_LIST((#46,#47)),$);\n"
      "#44=DATUM('',$,#2,.F.,'A');\n#45=DATUM('',$,#2,.F.,'B');\n#48=DATUM('',$,#2,.F.,'C');\n"
      "#46=DATUM_REFERENCE_ELEMENT('',$,#2,.F.,#45,$);\n#47=DATUM_REFERENCE_ELEMENT('',$,#2,.F.,#48,$);\n"
      "#50=DATUM_FEATURE('',$,#2,.T.);\n#51=SHAPE_ASPECT_RELATIONSHIP('',$,#50,#44);\n"
      "#52=GEOMETRIC_ITEM_SPECIFIC_USAGE('','',#50,#92,#5);\n"
      "#53=TOLERANCE_ZONE_FORM('cylindrical or circular');\n#54=TOLERANCE_ZONE('',$,#2,.F.,(#40),#53);\n");
  ASSERT_EQ(p.zones.size(), 1U);
  const StatedZone& z = p.zones.front();
  EXPECT_EQ(z.keyword, "POSITION_TOLERANCE");
  EXPECT_EQ(z.value_mm, 0.05);
  EXPECT_EQ(z.form, "cylindrical or circular");
  EXPECT_THAT(z.modifiers, ElementsAre("maximum_material_requirement"));
  EXPECT_THAT(z.datums, ElementsAre(ElementsAre("A"), ElementsAre("B", "C")));
  EXPECT_THAT(z.faces, ElementsAre(1));
  ASSERT_EQ(p.datums.size(), 3U);
  EXPECT_EQ(p.datums.front().letter, "A");
  EXPECT_THAT(p.datums.front().faces, ElementsAre(5));
}

TEST(ReadPmi, AToleranceOfTheProductIsOfTheWholePart) {
  const Pmi p = pmi_of(measure("#30", "0.5", "#10") + "#40=SURFACE_PROFILE_TOLERANCE('','',#30,#2);\n");
  ASSERT_EQ(p.zones.size(), 1U);
  EXPECT_TRUE(p.zones.front().whole);
}

TEST(ReadPmi, ATextureIsInMicrometres) {
  const Pmi p = pmi_of("#13=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MICRO.,.METRE.));\n" +
                       measure("#30", "1.6", "#13", "Ra") +
                       "#31=DESCRIPTIVE_REPRESENTATION_ITEM('measuring method','ISO 21920');\n"
                       "#40=PROPERTY_DEFINITION('surface_condition','',#3);\n"
                       "#41=SURFACE_TEXTURE_REPRESENTATION('',(#30,#31),#94);\n#42=PROPERTY_DEFINITION_"
                       "REPRESENTATION(#40,#41);\n");
  ASSERT_EQ(p.textures.size(), 1U);
  EXPECT_EQ(p.textures.front().parameter, "Ra");
  EXPECT_DOUBLE_EQ(p.textures.front().value_um, 1.6);
  EXPECT_EQ(p.textures.front().method, "ISO 21920");
  EXPECT_THAT(p.textures.front().faces, ElementsAre(1));
}

struct Broken {
  const char* name;
  std::string data;
};
void PrintTo(const Broken& b, std::ostream* out) { *out << b.name; }
class BrokenPmi : public ::testing::TestWithParam<Broken> {};

// Never a tolerance of another size than the file states.
TEST_P(BrokenPmi, IsNamedAndNotRead) {
  const Pmi p = pmi_of(GetParam().data);
  EXPECT_THAT(p.sizes, IsEmpty());
  EXPECT_THAT(p.zones, IsEmpty());
  ASSERT_EQ(p.unread.size(), 1U);
  EXPECT_FALSE(p.unread.front().why.empty());
}

std::string nominal() { return measure("#30", "35.", "#10"); }

INSTANTIATE_TEST_SUITE_P(
    Each, BrokenPmi,
    ::testing::Values(
        Broken{"no_value", diameter("#30", "")},
        Broken{"no_unit", diameter("#30", measure("#30", "35.", "#99"))},
        Broken{"an_angle_as_unit",
               diameter("#30", measure("#30", "35.", "#14") +
                                   "#14=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));\n")},
        Broken{"a_unit_of_itself",
               diameter("#30", measure("#30", "35.", "#14") +
                                   "#15=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(2.),#14);\n"
                                   "#14=(CONVERSION_BASED_UNIT('X',#15)LENGTH_UNIT()NAMED_UNIT(*));\n")},
        Broken{"a_bound_is_missing", diameter("#30", nominal() + measure("#31", "-0.2", "#10") +
                                                         "#33=TOLERANCE_VALUE(#31,#32);\n"
                                                         "#34=PLUS_MINUS_TOLERANCE(#33,#20);\n")},
        Broken{"two_tolerances", diameter("#30", nominal() + "#33=LIMITS_AND_FITS('H','hole','7','');\n"
                                                             "#34=PLUS_MINUS_TOLERANCE(#33,#20);\n"
                                                             "#35=PLUS_MINUS_TOLERANCE(#33,#20);\n")},
        Broken{"an_unknown_tolerance",
               diameter("#30", nominal() + "#33=LOOSE();\n#34=PLUS_MINUS_TOLERANCE(#33,#20);\n")},
        Broken{"an_angle", "#20=ANGULAR_SIZE(#3,'angle',.SMALL.);\n"},
        Broken{"a_zone_without_magnitude", "#40=FLATNESS_TOLERANCE('','',#30,#3);\n"},
        Broken{"a_zone_of_no_kind", nominal() + "#40=GEOMETRIC_TOLERANCE('','',#30,#3);\n"}),
    [](const auto& row) { return std::string(row.param.name); });

TEST(ReadPmi, CirclesOfAspectsEnd) {
  const StatedSize s = only_size(diameter("#30", nominal() + "#50=SHAPE_ASPECT_RELATIONSHIP('',$,#3,#6);\n"
                                                             "#51=SHAPE_ASPECT_RELATIONSHIP('',$,#6,#3);\n"));
  EXPECT_THAT(s.faces, ElementsAre(1, 5));
}

std::size_t count_of(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

// The oracle is the text itself: how often the keywords occur, however the instances are written.
TEST(ReadPmi, OfTheNistPartsEachSizeToleranceAndDatumIsRead) {
  const std::filesystem::path folder =
      std::filesystem::path(capstan::testing::corpus_folder()) / "cad" / "nist";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no corpus";
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().filename().string().find("ap242") == std::string::npos) continue;
    const std::string text = capstan::testing::slurp(entry.path().string());
    Job job;
    const auto file = p21::parse(text, entry.path().filename().string(), {}, job);
    ASSERT_TRUE(file);
    const Pmi p = read_pmi(*file);
    ++files;
    const auto unread = [&](const char* word) {
      return static_cast<std::size_t>(
          std::count_if(p.unread.begin(), p.unread.end(),
                        [&](const UnreadPmi& u) { return u.what.find(word) != std::string::npos; }));
    };
    EXPECT_EQ(p.sizes.size() + unread("DIMENSIONAL"),
              count_of(text, "DIMENSIONAL_SIZE(") + count_of(text, "DIMENSIONAL_LOCATION("))
        << entry.path();
    // A simple one is KIND_TOLERANCE('…; of a complex one the part GEOMETRIC_TOLERANCE('… stands once.
    EXPECT_EQ(p.zones.size() + unread("_TOLERANCE"), count_of(text, "_TOLERANCE('")) << entry.path();
    EXPECT_EQ(p.datums.size(), count_of(text, "=DATUM(") + count_of(text, "= DATUM(")) << entry.path();
    std::size_t faceless = 0;
    for (const StatedSize& s : p.sizes) faceless += s.faces.empty() ? 1 : 0;
    for (const StatedZone& z : p.zones) faceless += z.faces.empty() && !z.whole ? 1 : 0;
    std::cout << entry.path().filename().string() << ": " << p.sizes.size() << " sizes, " << p.zones.size()
              << " geometric tolerances, " << p.datums.size() << " datums, " << p.unread.size() << " unread, "
              << faceless << " without a face\n";
    for (const UnreadPmi& u : p.unread)
      std::cout << "  unread #" << u.id << " " << u.what << ": " << u.why << "\n";
  }
  EXPECT_GT(files, 0U);
}

}  // namespace
}  // namespace capstan::exchange
