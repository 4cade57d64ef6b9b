#include "tooling/library/formats/din4000/din4000.h"

#include <gmock/gmock.h>

#include <numbers>

#include "tests/support/corpus.h"
#include "tooling/library/formats/all.h"
#include "tooling/library/formats/din4000/codes.h"
#include "tooling/library/formats/import.h"

namespace capstan::tooling {
namespace {

using model::CutterClass;
using ::testing::Contains;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kDegree = std::numbers::pi / 180.0;

Result<Imported> read(const std::string& text) {
  Job job;
  return import_bytes(text, "a.xml", {}, job);
}

std::string property(std::string_view code, std::string_view value) {
  return "<Property-Data><PropertyName source=\"din_mk\">" + std::string(code) + "</PropertyName><Value>" +
         std::string(value) + "</Value></Property-Data>\n";
}
std::string tool(std::string_view properties, std::string_view table = "DIN4000-82",
                 std::string_view figure = "1") {
  return "<Tool><Main-Data><Manufacturer>X</Manufacturer><PrimaryId>id</PrimaryId></Main-Data><Category>"
         "<Category-Data><PropertyName>NSM</PropertyName><Value>" +
         std::string(table) +
         "</Value></Category-Data><Category-Data><PropertyName>BLD</PropertyName><Value>" +
         std::string(figure) + "</Value></Category-Data></Category><Properties>\n" + std::string(properties) +
         "</Properties></Tool>";
}
std::string xml(std::string_view tools) { return "<Tool-Data>" + std::string(tools) + "</Tool-Data>"; }

TEST(Din4000, TheThreeLayoutsOfOneArticleSayTheSame) {
  CAPSTAN_CORPUS_FILE(folder, "tools/iso13399");
  for (const char* name : {"/din4000-82.csv", "/din4000-82_2013.xml", "/din4000-82_2016.xml"}) {
    Job job;
    const auto r = import_library(folder + name, {}, job);
    ASSERT_TRUE(r) << to_text(r.error());
    ASSERT_EQ(r->library.items.size(), 1U);
    const CatalogueItem& i = r->library.items.front();
    EXPECT_EQ(i.id, "6767731") << name;
    EXPECT_EQ(i.description, "ENDMILL H1TE 1/16X1/8X1/8X1 1/2 S");
    EXPECT_EQ(i.manufacturer, "KH");
    EXPECT_EQ(i.cutter_class, CutterClass::kEndmill);
    // A1 1.588 or 1,588; B2 3.175; B5 38.1; C3 3.175; F21 4; F4 36; D7 0.01; the article's name has 1/16 x
    // 1/8 x 1/8 x 1 1/2 inches for diameter, shank, length of cut, overall length
    EXPECT_EQ(number_of(i, "DC"), 1.588) << name;
    EXPECT_EQ(number_of(i, "APMX"), 3.175);
    EXPECT_EQ(number_of(i, "OAL"), 38.1);
    EXPECT_EQ(number_of(i, "DMM"), 3.175);
    EXPECT_EQ(number_of(i, "LH"), 10.188);
    EXPECT_EQ(number_of(i, "LS"), 27.912);
    EXPECT_EQ(number_of(i, "ZEFF"), 4.0);
    EXPECT_EQ(number_of(i, "WT"), 0.01);
    EXPECT_NEAR(*number_of(i, "FHA"), 36.0 * kDegree, 1e-12);
    EXPECT_EQ(find(i.properties, "GRADE")->text, "KCPM15");
    EXPECT_EQ(find(i.properties, "SUBSTRATE")->text, "carbide");  // H11 HC
    // A list with commas is no number.
    EXPECT_THAT(i.kept, Contains(Field(&std::pair<std::string, std::string>::first, "J8")));
  }
}

TEST(Din4000, ReadsADrill) {
  CAPSTAN_CORPUS_FILE(path, "tools/din4000/B720111000.xml");
  Job job;
  const auto r = import_library(path, {}, job);
  ASSERT_TRUE(r) << to_text(r.error());
  const CatalogueItem& i = r->library.items.front();
  EXPECT_EQ(i.cutter_class, CutterClass::kTwistDrill);
  // A11 10; B4 31,3; B5 89; B6 46,3; B7 1,82; B71 87,18; C3 10; D1 2; D3 30; D6 50000; D7 0,084; E1 140
  EXPECT_EQ(number_of(i, "DC"), 10.0);
  EXPECT_EQ(number_of(i, "LU"), 31.3);
  EXPECT_EQ(number_of(i, "OAL"), 89.0);
  EXPECT_EQ(number_of(i, "LCF"), 46.3);
  EXPECT_EQ(number_of(i, "LF"), 87.18);
  EXPECT_EQ(number_of(i, "ZEFF"), 2.0);
  EXPECT_EQ(number_of(i, "RPMX"), 50000.0);
  EXPECT_EQ(number_of(i, "WT"), 0.084);
  EXPECT_NEAR(*number_of(i, "SIG"), 140.0 * kDegree, 1e-12);
  EXPECT_NEAR(*number_of(i, "FHA"), 30.0 * kDegree, 1e-12);
  // What the codes are taken for holds within the file: B7 is the height of the point, B71 = B5 - B7.
  EXPECT_NEAR(*number_of(i, "PL"), 5.0 / std::tan(70.0 * kDegree), 0.005);
  EXPECT_NEAR(*number_of(i, "LF"), *number_of(i, "OAL") - *number_of(i, "PL"), 1e-9);
}

TEST(Din4000, ReadsMillsOfThreeMakers) {
  CAPSTAN_CORPUS_FILE(folder, "tools/din4000");
  Job job;
  const auto hoffmann = import_library(folder + "/CAD_206322_10_3,5_prop.xml", {}, job);
  ASSERT_TRUE(hoffmann) << to_text(hoffmann.error());
  const CatalogueItem& torus = hoffmann->library.items.front();
  EXPECT_EQ(torus.id, "206322 10/3,5");
  EXPECT_EQ(torus.cutter_class, CutterClass::kBullnoseEndmill);
  EXPECT_EQ(number_of(torus, "RE"), 3.5);  // G1 3,5, in a block of its own
  EXPECT_EQ(number_of(torus, "DN"), 9.2);  // A5
  EXPECT_EQ(number_of(torus, "LCF"), 11.0);
  // B3 36 and C4 39,9 are together longer than B5 73
  EXPECT_THAT(hoffmann->report.dropped,
              Contains(Field(&LossReport::Line::what, HasSubstr("longer than the tool, 73 mm"))));

  const auto fraisa = import_library(folder + "/H8502180.xml", {}, job);
  ASSERT_TRUE(fraisa) << to_text(fraisa.error());
  const CatalogueItem& small = fraisa->library.items.front();
  EXPECT_EQ(number_of(small, "DC"), 3.0);
  EXPECT_EQ(number_of(small, "DN"), 2.8);
  EXPECT_EQ(number_of(small, "APMX"), 4.0);
  EXPECT_EQ(number_of(small, "LU"), 14.0);
  EXPECT_EQ(number_of(small, "RPMX"), 60000.0);
  // G2 0,1: not known in this table, never taken for a corner radius or chamfer.
  EXPECT_EQ(number_of(small, "RE"), std::nullopt);
  EXPECT_THAT(small.kept, Contains(std::pair<std::string, std::string>("G2", "0,1")));
  EXPECT_THAT(fraisa->report.dropped, Contains(Field(&LossReport::Line::field, "G2")));

  const auto ceratizit = import_library(folder + "/CE_52745160_DataExport_DIN4000.xml", {}, job);
  ASSERT_TRUE(ceratizit) << to_text(ceratizit.error());
  const CatalogueItem& plain = ceratizit->library.items.front();
  EXPECT_EQ(number_of(plain, "DC"), 16.0);
  EXPECT_EQ(number_of(plain, "APMX"), 31.0);
  EXPECT_EQ(number_of(plain, "OAL"), *number_of(plain, "LH") + *number_of(plain, "LS"));
  // Figure 0 shows no shape: read, not planned with, and told.
  EXPECT_EQ(plain.cutter_class, std::nullopt);
  EXPECT_THAT(ceratizit->report.dropped, Contains(Field(&LossReport::Line::what, HasSubstr("figure '0'"))));

  const auto multi = import_library(folder + "/FAC_U7960391.xml", {}, job);
  ASSERT_TRUE(multi) << to_text(multi.error());
  const CatalogueItem& gouge = multi->library.items.front();
  EXPECT_EQ(number_of(gouge, "DC"), 8.0);
  EXPECT_EQ(number_of(gouge, "ZEFF"), 2.0);  // F22 only
  EXPECT_EQ(gouge.cutter_class, std::nullopt);
  EXPECT_THAT(multi->report.dropped,
              Contains(Field(&LossReport::Line::what, HasSubstr("thicker than the cutting diameter"))));
}

TEST(Din4000, EveryFileOfTheCorpusFolderReads) {
  for (const char* folder : {"tools/din4000", "tools/iso13399"}) {
    CAPSTAN_CORPUS_FILE(path, folder);
    Job job;
    const auto r = import_library(path, {}, job);
    ASSERT_TRUE(r) << to_text(r.error());
    LossReport report;
    const auto cutters = cutters_of(r->library, report, job);
    ASSERT_TRUE(cutters) << to_text(cutters.error());
    EXPECT_FALSE(cutters->empty());
  }
}

TEST(Din4000, CodesMeanSomethingWithinTheirTableOnly) {
  EXPECT_EQ(din4000::find_code("82", "A1")->symbol, "DC");
  EXPECT_EQ(din4000::find_code("81", "A11")->symbol, "DC");
  EXPECT_EQ(din4000::find_code("81", "A1"), nullptr);
  EXPECT_EQ(din4000::find_code("82", "E1"), nullptr);
  EXPECT_EQ(din4000::find_code("76", "B5"), nullptr);  // an unknown table: not even the common ones
  const auto r = read(xml(tool(property("A1", "10") + property("B5", "70"), "DIN4000-76")));
  ASSERT_TRUE(r) << to_text(r.error());
  EXPECT_TRUE(r->library.items.front().properties.empty());
  EXPECT_THAT(r->report.dropped, Contains(Field(&LossReport::Line::field, "A1")));
}

TEST(Din4000, ATapHasItsPitchAndNominalDiameter) {
  const std::string all =
      property("A1", "M") + property("A21", "8") + property("A3", "1,25") + property("B5", "90");
  auto r = read(xml(tool(all, "DIN4000-80", "2")));
  ASSERT_TRUE(r) << to_text(r.error());
  const CatalogueItem& tap = r->library.items.front();
  EXPECT_EQ(tap.cutter_class, CutterClass::kTap);
  EXPECT_EQ(number_of(tap, "TP"), 1.25);
  EXPECT_EQ(number_of(tap, "DC"), 8.0);
  EXPECT_EQ(find(tap.properties, "THFT")->text, "M");
  r = read(xml(tool(property("A21", "8"), "DIN4000-80", "2")));
  ASSERT_TRUE(r) << to_text(r.error());
  EXPECT_EQ(r->library.items.front().cutter_class, std::nullopt);
  EXPECT_THAT(r->report.dropped, Contains(Field(&LossReport::Line::what, HasSubstr("no pitch (A3)"))));
}

TEST(Din4000, OfATapWithoutASizeTheSizeIsMissed) {
  for (const std::string& stated : {property("A1", "M"), property("A3", "1"),
                                    property("J22", "M2 HSS hand tap"), property("J22", "tap")}) {
    const auto r = read(xml(tool(stated, "DIN4000-80", "2")));
    ASSERT_TRUE(r) << to_text(r.error());
    EXPECT_EQ(r->library.items.front().cutter_class, std::nullopt);
    EXPECT_THAT(r->report.dropped, Contains(Field(&LossReport::Line::what, HasSubstr("A21")))) << stated;
    for (const auto& line : r->report.dropped) EXPECT_THAT(line.what, Not(HasSubstr("no pitch"))) << stated;
  }
}

TEST(Din4000, ATapTakesSizeAndPitchFromItsNamesWhereTheNumbersAreMissing) {
  auto r =
      read(xml(tool(property("A1", "M") + property("J22", "Maschinengewindebohrer M6"), "DIN4000-80", "2")));
  ASSERT_TRUE(r) << to_text(r.error());
  const CatalogueItem& tap = r->library.items.front();
  EXPECT_EQ(tap.cutter_class, CutterClass::kTap);
  EXPECT_EQ(number_of(tap, "DC"), 6.0);
  EXPECT_EQ(find(tap.properties, "DC")->state, ValueState::kDerived);
  Job job;
  LossReport report;
  const auto cutters = cutters_of(r->library, report, job);
  ASSERT_TRUE(cutters) << to_text(cutters.error());
  ASSERT_EQ(cutters->size(), 1U);
  EXPECT_EQ(cutters->front().cutting_diameter_mm, 6.0);
  EXPECT_EQ(cutters->front().thread_pitch_mm, 1.0);  // ISO 261, coarse
  // A number that is stated counts, whatever the name says.
  r = read(xml(tool(property("A21", "8") + property("A3", "1") + property("J22", "M6"), "DIN4000-80", "2")));
  ASSERT_TRUE(r);
  EXPECT_EQ(number_of(r->library.items.front(), "DC"), 8.0);
}

TEST(Din4000, TheDiameterOfAThreadMillIsInA5OrA2) {
  for (const char* code : {"A5", "A2"}) {
    const auto r = read(xml(tool(property("A1", "M") + property(code, "4,5") + property("D32", "1") +
                                     property("B2", "12") + property("F21", "4"),
                                 "DIN4000-82", "10")));
    ASSERT_TRUE(r) << to_text(r.error());
    const CatalogueItem& mill = r->library.items.front();
    EXPECT_EQ(mill.cutter_class, CutterClass::kThreadMill) << code;
    EXPECT_EQ(number_of(mill, "DC"), 4.5) << code;
    EXPECT_EQ(number_of(mill, "DN"), std::nullopt) << code;
    EXPECT_EQ(number_of(mill, "TP"), 1.0);
    EXPECT_THAT(r->report.derived, Contains(Field(&LossReport::Line::what, HasSubstr(code))));
  }
  auto r = read(xml(tool(property("A2", "6") + property("A5", "4,5"), "DIN4000-82", "10")));
  ASSERT_TRUE(r) << to_text(r.error());
  EXPECT_EQ(number_of(r->library.items.front(), "DC"), 4.5);
  r = read(xml(tool(property("A1", "4,5"), "DIN4000-82", "10")));
  ASSERT_TRUE(r) << to_text(r.error());
  EXPECT_EQ(number_of(r->library.items.front(), "DC"), 4.5);
  EXPECT_EQ(r->library.items.front().cutter_class, CutterClass::kThreadMill);
  // Two diameters: not guessed which is it.
  r = read(xml(tool(property("A1", "6") + property("A5", "4,5"), "DIN4000-82", "10")));
  ASSERT_TRUE(r) << to_text(r.error());
  EXPECT_EQ(r->library.items.front().cutter_class, std::nullopt);
  EXPECT_THAT(r->report.dropped,
              Contains(Field(&LossReport::Line::what, HasSubstr("A1 is 6 and A5 is 4,5"))));
}

TEST(Din4000, AnEndMillWithoutA1HasItsDiameterInA2AndItsNeckInA5) {
  auto r = read(xml(tool(property("A2", "10") + property("A5", "9,2") + property("B2", "20"))));
  ASSERT_TRUE(r) << to_text(r.error());
  EXPECT_EQ(number_of(r->library.items.front(), "DC"), 10.0);
  EXPECT_EQ(number_of(r->library.items.front(), "DN"), 9.2);
  for (const auto& line : r->report.dropped) EXPECT_NE(line.field, "A2") << line.what;
  EXPECT_EQ(number_of(read(xml(tool(property("A2", "10"), "DIN4000-82", "2")))->library.items.front(), "DC"),
            10.0);
  // Of other figures no source says so: their diameter is missing.
  for (const char* figure : {"5", "6"})
    EXPECT_FALSE(read(xml(tool(property("A2", "10"), "DIN4000-82", figure))));
  for (const char* figure : {"3", "7", "0"}) {
    r = read(xml(tool(property("A2", "10"), "DIN4000-82", figure)));
    ASSERT_TRUE(r) << to_text(r.error());
    EXPECT_EQ(number_of(r->library.items.front(), "DC"), std::nullopt) << figure;
    EXPECT_EQ(r->library.items.front().cutter_class, std::nullopt) << figure;
    EXPECT_THAT(r->report.dropped, Contains(Field(&LossReport::Line::field, "A2"))) << figure;
  }
  // A neck alone is no diameter.
  EXPECT_FALSE(read(xml(tool(property("A5", "9,2") + property("B2", "20")))));
  // Beside A1 nobody knows what A2 is.
  r = read(xml(tool(property("A1", "10") + property("A2", "12"))));
  ASSERT_TRUE(r) << to_text(r.error());
  EXPECT_EQ(number_of(r->library.items.front(), "DC"), 10.0);
  EXPECT_THAT(r->report.dropped, Contains(Field(&LossReport::Line::field, "A2")));
}

TEST(Din4000, AHandOfZeroIsNoneGiven) {
  const auto r = read(xml(tool(property("A1", "10") + property("F1", "0"))));
  ASSERT_TRUE(r) << to_text(r.error());
  EXPECT_EQ(find(r->library.items.front().properties, "HAND"), nullptr);
  EXPECT_THAT(r->report.dropped, Contains(Field(&LossReport::Line::field, "F1")));
  EXPECT_FALSE(read(xml(tool(property("A1", "10") + property("F1", "X")))));  // an unknown hand stays a fault
}

TEST(Din4000, ABallEndMillIsKnownByItsFigureOrItsRadius) {
  auto r = read(xml(tool(property("A1", "6"), "DIN4000-82", "6")));
  ASSERT_TRUE(r);
  EXPECT_EQ(r->library.items.front().cutter_class, CutterClass::kBallEndmill);
  EXPECT_EQ(number_of(r->library.items.front(), "RE"), 3.0);
  r = read(xml(tool(property("A1", "6") + property("G1", "3"))));
  ASSERT_TRUE(r);
  EXPECT_EQ(r->library.items.front().cutter_class, CutterClass::kBallEndmill);
}

struct Bad {
  const char* name;
  std::string text;
  const char* code;
};
void PrintTo(const Bad& b, std::ostream* os) { *os << b.name; }
std::string csv(std::string_view row) { return "J21;NSM;BLD;A1;B5\n" + std::string(row) + "\n"; }
std::string deep() {
  std::string s = "<Tool-Data>";
  for (int i = 0; i < 100'000; ++i) s += "<a>";
  for (int i = 0; i < 100'000; ++i) s += "</a>";
  return s + "</Tool-Data>";
}

class Din4000Refuses : public ::testing::TestWithParam<Bad> {};
TEST_P(Din4000Refuses, WithOneClearError) {
  const auto r = read(GetParam().text);
  ASSERT_FALSE(r);
  EXPECT_EQ(r.error().code, GetParam().code) << to_text(r.error());
  EXPECT_EQ(r.error().file, "a.xml");
}
INSTANTIATE_TEST_SUITE_P(
    Files, Din4000Refuses,
    ::testing::Values(
        Bad{"no table", xml("<Tool><Main-Data><PrimaryId>x</PrimaryId></Main-Data></Tool>"), "DIN4000-FORM"},
        Bad{"no article",
            xml("<Tool><Category><Category-Data><PropertyName>NSM</PropertyName><Value>DIN4000-82"
                "</Value></Category-Data></Category></Tool>"),
            "DIN4000-FORM"},
        Bad{"no tool", xml(""), "DIN4000-VALUE"}, Bad{"cut off", "<Tool-Data><Tool>", "XML-SYNTAX"},
        Bad{"deep", deep(), "XML-DEPTH"},
        Bad{"no diameter", xml(tool(property("B5", "70"))), "DIN4000-VALUE"},
        Bad{"zero diameter", xml(tool(property("A1", "0"))), "DIN4000-VALUE"},
        Bad{"negative", xml(tool(property("A1", "-10"))), "TOOL-VALUE"},
        Bad{"thousands", xml(tool(property("A1", "1.234,5"))), "DATA-NUMBER"},
        Bad{"two commas", xml(tool(property("A1", "1,2,3"))), "DATA-NUMBER"},
        Bad{"NaN", xml(tool(property("A1", "NaN"))), "DATA-NUMBER"},
        Bad{"1e400", xml(tool(property("A1", "1e400"))), "DATA-NUMBER"},
        Bad{"3.9 teeth", xml(tool(property("A1", "10") + property("F21", "3,9"))), "TOOL-VALUE"},
        Bad{"300 teeth", xml(tool(property("A1", "10") + property("F21", "300"))), "TOOL-VALUE"},
        Bad{"flutes longer than the tool",
            xml(tool(property("A1", "10") + property("B2", "80") + property("B5", "70"))), "DIN4000-VALUE"},
        Bad{"twice and different", xml(tool(property("A1", "10") + property("A1", "12"))), "TOOL-VALUE"},
        Bad{"one article twice", xml(tool(property("A1", "10")) + tool(property("A1", "10"))), "TOOL-ID"},
        Bad{"csv: a field too few", csv("1;DIN4000-82;1;10"), "DIN4000-FORM"},
        Bad{"csv: open quote", csv("1;DIN4000-82;1;\"10;70"), "DIN4000-FORM"},
        Bad{"csv: a column twice", "J21;NSM;BLD;A1;A1\n1;DIN4000-82;1;10;11\n", "DIN4000-FORM"},
        Bad{"csv: text for a number", csv("1;DIN4000-82;1;ten;70"), "DATA-NUMBER"}));

TEST(Din4000, EntitiesAreNotExpandedAndNothingIsFetched) {
  std::string bomb = "<!DOCTYPE Tool-Data [<!ENTITY a \"aaaaaaaaaa\">";
  for (char c = 'b'; c <= 'k'; ++c)
    bomb += std::string("<!ENTITY ") + c + " \"" + "&" + char(c - 1) + ";&" + char(c - 1) + ";&" +
            char(c - 1) + ";\">";
  bomb += "<!ENTITY file SYSTEM \"file:///etc/passwd\">]>";
  const auto r = read(bomb + xml(tool(property("A1", "10") + property("J22", "&k;&file;"))));
  ASSERT_TRUE(r) << to_text(r.error());
  EXPECT_EQ(r->library.items.front().description, "&k;&file;");
}

TEST(Din4000, OneBadToolOfManyIsLeftOutAndTold) {
  Job job;
  std::string second = tool(property("A1", "x"));
  second.replace(second.find("<PrimaryId>id"), 13, "<PrimaryId>i2");
  const auto r = import_bytes(xml(tool(property("A1", "10")) + second), "a.xml", {}, job);
  ASSERT_TRUE(r) << to_text(r.error());
  EXPECT_EQ(r->library.items.size(), 1U);
  EXPECT_EQ(job.count(Severity::kWarning), 1U);
}

}  // namespace
}  // namespace capstan::tooling
