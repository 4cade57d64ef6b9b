#include "tooling/library/formats/iso13399/iso13399.h"

#include <gmock/gmock.h>

#include <numbers>
#include <random>

#include "planner/ground/base/number.h"
#include "tests/support/corpus.h"
#include "tooling/library/formats/all.h"
#include "tooling/library/formats/import.h"
#include "tooling/library/formats/item/iso_names.h"
#include "tooling/library/formats/values.h"
#include "tooling/library/formats/zip.h"

namespace capstan::tooling {
namespace {

using model::CutterClass;
using ::testing::Contains;
using ::testing::Field;
using ::testing::HasSubstr;

std::string file(std::string_view data) {
  return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\n"
         "FILE_SCHEMA(('CUTTING_TOOL_SCHEMA_ARM'));\nENDSEC;\nDATA;\n" +
         std::string(data) + "ENDSEC;\nEND-ISO-10303-21;\n";
}

/// One end mill in the dialect that names values at length and has the dictionary's codes.
constexpr std::string_view kLong =
    "#1=ITEM('solid end mill',\n'EM-10',$);\n"
    "#2=ITEM_VERSION(#1,$,'1');\n"
    "#3=ITEM_DEFINITION(#2,$,'d',$);\n"
    "#4=SPECIFIC_ITEM_CLASSIFICATION((#1),'tool item',$);\n"
    "#9=PLIB_CLASS_REFERENCE('71EAD3871D313','0112/1///13399__003','003');\n"
    "#10=UNIT('mm');\n"
    "#11=PLIB_PROPERTY_REFERENCE('71D078EB7C086',#9,'1');\n"
    "#12=PROPERTY((),$,'p1',#11,$,$);\n"
    "#13=NUMERICAL_VALUE('overall length',$,#10,'72.');\n"
    "#14=PROPERTY_VALUE_REPRESENTATION(#12,$,$,#13,$);\n"
    "#15=PROPERTY_VALUE_ASSOCIATION($,#3,#14,$,$);\n"
    "#22=PROPERTY((),$,'p2',$,$,$);\n"
    "#23=NUMERICAL_VALUE('Cutting diameter',$,#10,10.);\n"
    "#24=PROPERTY_VALUE_REPRESENTATION(#22,$,$,#23,$);\n"
    "#25=PROPERTY_VALUE_ASSOCIATION($,#3,#24,$,$);\n"
    "#32=PROPERTY((),$,'p3',$,$,$);\n"
    "#33=STRING_VALUE('colour of the box','blue');\n"
    "#34=PROPERTY_VALUE_REPRESENTATION(#32,$,$,#33,$);\n"
    "#35=PROPERTY_VALUE_ASSOCIATION($,#3,#34,$,$);\n";

Result<Imported> read(const std::string& text) {
  Job job;
  return import_bytes(text, "a.p21", {}, job);
}

TEST(Iso13399, ReadsTheFileOfTheCorpusBySymbol) {
  CAPSTAN_CORPUS_FILE(path, "tools/iso13399/iso13399.p21");
  Job job;
  const auto r = import_library(path, {}, job);
  ASSERT_TRUE(r) << to_text(r.error());
  ASSERT_EQ(r->library.items.size(), 1U);
  const CatalogueItem& i = r->library.items.front();
  // ITEM: description, id; NUMERICAL_VALUEs DC 6.35, OAL 63.5, APMX 19.05, LF 63.5, ZEFF 4, DCONMS 6.35
  EXPECT_EQ(i.id, "6676918");
  EXPECT_EQ(i.description, "END MILL HARVI I TE 1/4X1/4X3/4X2 1/2 S");
  EXPECT_EQ(i.manufacturer, "Kennametal");
  EXPECT_EQ(number_of(i, "DC"), 6.35);
  EXPECT_EQ(number_of(i, "OAL"), 63.5);
  EXPECT_EQ(number_of(i, "APMX"), 19.05);
  EXPECT_EQ(number_of(i, "LF"), 63.5);
  EXPECT_EQ(number_of(i, "DMM"), 6.35);
  EXPECT_EQ(number_of(i, "ZEFF"), 4.0);
  EXPECT_EQ(i.cutter_class, CutterClass::kEndmill);
  // The file gives the helix of 36 in millimetres: not used, kept, told.
  EXPECT_EQ(find(i.properties, "FHA"), nullptr);
  EXPECT_EQ(*find_kept(i.kept, "FHA"), "36 mm");
  EXPECT_EQ(job.count(Severity::kWarning), 1U);
  // Planning takes the bare tool's LF for no length in a holder.
  LossReport report;
  const auto cutters = cutters_of(r->library, report, job);
  ASSERT_TRUE(cutters) << to_text(cutters.error());
  ASSERT_EQ(cutters->size(), 1U);
  EXPECT_NE(cutters->front().functional_length_mm, 63.5);
}

TEST(Iso13399, ReadsTheDialectOfLongNamesAndCodes) {
  const auto r = read(file(kLong));
  ASSERT_TRUE(r) << to_text(r.error());
  const CatalogueItem& i = r->library.items.front();
  EXPECT_EQ(number_of(i, "OAL"), 72.0);  // by its code
  EXPECT_THAT(find(i.properties, "OAL")->source, HasSubstr("71D078EB7C086"));
  EXPECT_EQ(number_of(i, "DC"), 10.0);  // by its preferred name; a plain number
  // What is not known keeps its name and text.
  ASSERT_NE(find(i.properties, "colour of the box"), nullptr);
  EXPECT_EQ(find(i.properties, "colour of the box")->text, "blue");
  EXPECT_THAT(r->report.dropped, Contains(Field(&LossReport::Line::field, "colour of the box")));
}

TEST(Iso13399, CodesComeBeforeSymbolsAndDisagreementIsTold) {
  std::string text = file(kLong);
  text.replace(text.find("'overall length'"), 16, "'LF'");
  const auto r = read(text);
  ASSERT_TRUE(r) << to_text(r.error());
  EXPECT_EQ(number_of(r->library.items.front(), "OAL"), 72.0);
  EXPECT_THAT(r->report.derived, Contains(Field(&LossReport::Line::what, HasSubstr("the name says LF"))));
}

TEST(Iso13399, EachCodeAndNameIsThatOfOneSymbol) {
  for (const IsoName& n : iso_names()) {
    EXPECT_EQ(find_symbol(n.symbol), &n);
    EXPECT_EQ(find_preferred_name(n.name), &n) << n.name;
    if (!n.bsu.empty()) {
      EXPECT_EQ(find_bsu(n.bsu), &n);
    }
  }
  EXPECT_EQ(find_symbol("DCONMS"), find_symbol("DMM"));
  EXPECT_EQ(find_symbol("NO"), nullptr);
}

TEST(Iso13399, RolesMakeItemsHoldersAndInserts) {
  const auto r = read(
      file(std::string(kLong) +
           "#101=ITEM('collet chuck','H1',$);\n#104=SPECIFIC_ITEM_CLASSIFICATION((#101),'adaptive item',$);\n"
           "#201=ITEM('insert','I1',$);\n#204=SPECIFIC_ITEM_CLASSIFICATION((#201),'cutting item',$);\n"));
  ASSERT_TRUE(r) << to_text(r.error());
  EXPECT_EQ(r->library.items.size(), 1U);
  ASSERT_EQ(r->library.holders.size(), 1U);
  EXPECT_EQ(r->library.holders.front().id, "H1");
  EXPECT_THAT(r->report.dropped, Contains(Field(&LossReport::Line::tool, "I1")));
}

TEST(Iso13399, InchesSurvive) {
  std::string text = file(kLong);
  text.replace(text.find("UNIT('mm')"), 10, "UNIT('in')");
  text.replace(text.find("10.);"), 5, "'0.375');");
  text.replace(text.find("'72.'"), 5, "'3.'");
  Job job;
  const auto r = import_bytes(text, "a.p21", {}, job);
  ASSERT_TRUE(r) << to_text(r.error());
  const CatalogueItem& i = r->library.items.front();
  EXPECT_TRUE(i.inches);
  EXPECT_DOUBLE_EQ(*number_of(i, "DC"), 9.525);
  const auto back = write_iso13399(r->library, {}, job);
  ASSERT_TRUE(back);
  EXPECT_THAT(back->bytes, HasSubstr("UNIT('in')"));
  EXPECT_THAT(back->bytes, HasSubstr("'0.375'"));
}

TEST(Iso13399, RandomLibrariesSurviveARoundTrip) {
  std::mt19937 random(13399);
  std::uniform_real_distribution<double> size(0.5, 30.0);
  ToolLibrary l;
  for (int n = 0; n < 200; ++n) {
    CatalogueItem i;
    i.id = i.product_id = "it's \xC3\xA9t\xC3\xA9 #" + std::to_string(n);
    i.description = "tool \\ " + std::to_string(n);
    i.manufacturer = n % 3 == 0 ? "M\xC3\xBCller" : "Smith";
    i.cutter_class = static_cast<CutterClass>(n % (static_cast<int>(model::kLastCutterClass) + 1));
    i.kind = n % 2 == 0 ? "class " + std::to_string(n) : "";
    i.inches = n % 4 == 0;
    const std::string_view unit = i.inches ? "in" : "mm";
    const double d = rounded(size(random), 3);
    i.properties.push_back(number_property("DC", d, unit, ValueState::kStated, "ISO 13399 DC"));
    i.properties.push_back(number_property("OAL", 8.0 * d, unit, ValueState::kDerived, "eight times DC"));
    i.properties.push_back(number_property("SIG", 2.0, "deg", ValueState::kDefault, "a guess"));
    i.properties.push_back(number_property("ZEFF", 1 + n % 6, "", ValueState::kStated, "ISO 13399 ZEFF"));
    i.properties.push_back(text_property("COATING", "TiN", "ISO 13399 COATING"));
    i.properties.push_back(text_property("own word", "x", "ISO 13399 own word"));
    l.items.push_back(std::move(i));
  }
  Job job;
  const auto written = write_iso13399(l, {}, job);
  ASSERT_TRUE(written) << to_text(written.error());
  EXPECT_TRUE(written->report.dropped.empty());
  const auto back = import_bytes(written->bytes, "a.p21", {}, job);
  ASSERT_TRUE(back) << to_text(back.error());
  ASSERT_EQ(back->library.items.size(), l.items.size());
  for (std::size_t n = 0; n < l.items.size(); ++n) {
    const CatalogueItem &a = l.items[n], &b = back->library.items[n];
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.description, b.description);
    EXPECT_EQ(a.manufacturer, b.manufacturer);
    EXPECT_EQ(a.cutter_class, b.cutter_class);
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_EQ(a.inches, b.inches);
    ASSERT_EQ(a.properties.size(), b.properties.size());
    for (const Property& p : a.properties) {
      const Property* q = find(b.properties, p.symbol);
      ASSERT_NE(q, nullptr) << p.symbol;
      EXPECT_EQ(q->text, p.text) << p.symbol;
      EXPECT_EQ(q->state, p.state) << p.symbol;
      if (p.state != ValueState::kStated) {
        EXPECT_EQ(q->source, p.source);
      }
      if (p.number) {
        EXPECT_NEAR(*q->number, *p.number, 1e-12 * *p.number) << p.symbol;
      }
    }
  }
  // And again: nothing more changes.
  const auto twice = write_iso13399(back->library, {}, job);
  ASSERT_TRUE(twice);
  const auto third = import_bytes(twice->bytes, "a.p21", {}, job);
  ASSERT_TRUE(third);
  EXPECT_EQ(third->library.items, back->library.items);
}

TEST(Iso13399, AToolThatMustNotBePlannedWithStaysOut) {
  ToolLibrary l;
  CatalogueItem i;
  i.id = "a";
  i.description = "45 deg chamfer mill";  // words that would give it a class
  i.kind = "Chamfer";
  i.kept.emplace_back("left out", "its sizes contradict each other");
  l.items.push_back(i);
  Job job;
  const auto w = write_iso13399(l, {}, job);
  ASSERT_TRUE(w);
  const auto back = import_bytes(w->bytes, "a.p21", {}, job);
  ASSERT_TRUE(back) << to_text(back.error());
  EXPECT_EQ(back->library.items.front().cutter_class, std::nullopt);
  EXPECT_EQ(back->library.items.front().kind, "Chamfer");
  EXPECT_EQ(*find_kept(back->library.items.front().kept, "left out"), "its sizes contradict each other");
}

TEST(Iso13399, NumbersWithoutAUnitAreWrittenInOurs) {
  ToolLibrary l;
  CatalogueItem i;
  i.id = i.description = "end mill";
  for (const auto& [symbol, value] :
       {std::pair{"DC", 6.0}, std::pair{"SIG", 2.0}, std::pair{"WT", 0.25}, std::pair{"RPMX", 9000.0}})
    i.properties.push_back(number_property(symbol, value, "", ValueState::kStated, ""));
  l.items.push_back(i);
  Job job;
  const auto back = import_bytes(write_iso13399(l, {}, job)->bytes, "a.p21", {}, job);
  ASSERT_TRUE(back) << to_text(back.error());
  for (const Property& p : i.properties)
    EXPECT_EQ(number_of(back->library.items.front(), p.symbol), p.number);
}

TEST(Iso13399, SpeedsPerSecondAreRefused) {
  const auto r =
      read(file(std::string(kLong) + "#50=UNIT('1/s');\n#51=NUMERICAL_VALUE('RPMX',$,#50,'200');\n"));
  ASSERT_FALSE(r);
  EXPECT_EQ(r.error().code, "DATA-UNIT");
}

TEST(Iso13399, WhatIsNotWrittenIsTold) {
  ToolLibrary l;
  CatalogueItem i;
  i.id = "a";
  i.properties.push_back(number_property("DC", 6.0, "mm", ValueState::kStated, ""));
  i.presets.push_back({});
  l.items.push_back(i);
  l.entries.push_back({5, {}, {}, "a", {}, {}});
  Job job;
  const auto w = write_iso13399(l, {}, job);
  ASSERT_TRUE(w);
  EXPECT_THAT(w->report.dropped, Contains(Field(&LossReport::Line::field, "presets")));
  EXPECT_THAT(w->report.dropped, Contains(Field(&LossReport::Line::field, "table")));
}

struct Bad {
  const char* name;
  const char* from;
  const char* to;
  const char* code;
};
void PrintTo(const Bad& b, std::ostream* os) { *os << b.name; }

class Iso13399Refuses : public ::testing::TestWithParam<Bad> {};
TEST_P(Iso13399Refuses, WithOneClearErrorThatNamesTheInstance) {
  std::string text = file(kLong);
  const auto at = text.find(GetParam().from);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, std::string_view(GetParam().from).size(), GetParam().to);
  const auto r = read(text);
  ASSERT_FALSE(r);
  EXPECT_EQ(r.error().code, GetParam().code) << to_text(r.error());
  EXPECT_EQ(r.error().file, "a.p21");
  EXPECT_NE(r.error().line, 0U) << to_text(r.error());
}
INSTANTIATE_TEST_SUITE_P(
    Files, Iso13399Refuses,
    ::testing::Values(
        Bad{"dangling definition", "ASSOCIATION($,#3,#14", "ASSOCIATION($,#77,#14", "ISO13399-DANGLING"},
        Bad{"dangling unit", "'Cutting diameter',$,#10", "'Cutting diameter',$,#78", "ISO13399-DANGLING"},
        Bad{"no unit", "'Cutting diameter',$,#10", "'Cutting diameter',$,$", "DATA-UNIT"},
        Bad{"unit of another kind", "UNIT('mm')", "UNIT('kg')", "DATA-UNIT"},
        Bad{"unit of a wrong type", "'Cutting diameter',$,#10", "'Cutting diameter',$,#9", "ISO13399-FORM"},
        Bad{"list for a number", "#10,10.)", "#10,(10.))", "ISO13399-FORM"},
        Bad{"text for a number", "#10,10.)", "#10,'ten')", "DATA-NUMBER"},
        Bad{"decimal comma", "#10,10.)", "#10,'10,5')", "DATA-NUMBER"},
        Bad{"negative", "#10,10.)", "#10,-10.)", "TOOL-VALUE"},
        Bad{"zero diameter", "#10,10.)", "#10,0.)", "TOOL-VALUE"},
        Bad{"overflow in a text", "#10,10.)", "#10,'1e400')", "DATA-NUMBER"},
        Bad{"version of no item", "ITEM_VERSION(#1,", "ITEM_VERSION(#4,", "ISO13399-FORM"},
        Bad{"item without a name", "'EM-10',$)", "'EM-10')", "ISO13399-FORM"},
        Bad{"id that is no string", "'EM-10',$)", "7,$)", "ISO13399-FORM"},
        Bad{"role of a unit", "((#1),'tool item'", "((#10),'tool item'", "ISO13399-FORM"}));

TEST(Iso13399, RefusesOtherSchemasAndBrokenFiles) {
  Job job;
  std::string text = file(kLong);
  text.replace(text.find("CUTTING_TOOL_SCHEMA_ARM"), 23, "AUTOMOTIVE_DESIGN      ");
  auto r = iso13399_format().read(text, "a.p21", {}, job);
  ASSERT_FALSE(r);
  EXPECT_EQ(r.error().code, "ISO13399-FORM");
  EXPECT_THAT(to_text(r.error()), HasSubstr("AUTOMOTIVE_DESIGN"));
  EXPECT_FALSE(iso13399_format().read(file(kLong).substr(0, 500), "a.p21", {}, job));
  r = iso13399_format().read(file("#1=UNIT('mm');\n"), "a.p21", {}, job);
  ASSERT_FALSE(r);
  EXPECT_THAT(to_text(r.error()), HasSubstr("no tool"));
  // A text that leads to itself ends.
  r = iso13399_format().read(file("#1=ITEM(#2,'x',$);\n#2=MULTI_LANGUAGE_STRING((),#2);\n"), "a.p21", {},
                             job);
  ASSERT_TRUE(r);  // an item without words or sizes
  EXPECT_EQ(r->library.items.front().cutter_class, std::nullopt);
}

TEST(Iso13399, AnItemGivenTwiceIsRefused) {
  const auto r = read(file("#1=ITEM('end mill','x',$);\n#2=ITEM('end mill','x',$);\n"));
  ASSERT_FALSE(r);
  EXPECT_EQ(r.error().code, "TOOL-ID");
}

std::string package(bool nested, const char* assortment_file = "EM-10.p21") {
  const std::string assortment =
      "<?xml version=\"1.0\"?><package_assortment><item><product_id>4711</product_id>"
      "<gtc_generic_class_id>MILSQS</gtc_generic_class_id><p21_file_name>" +
      std::string(assortment_file) +
      "</p21_file_name><unit_system>metric</unit_system></item></package_assortment>";
  const std::string meta = "<package_meta_data><vendor_name>Own</vendor_name></package_meta_data>";
  std::vector<ZipEntry> entries = {{"package_meta_data.xml", meta},
                                   {"package_assortment.xml", assortment},
                                   {"product_data_files/EM-10.p21", file(kLong)},
                                   {"product_pictures/EM-10.png", "no picture"}};
  if (nested) {
    for (ZipEntry& e : entries) {
      if (!e.name.ends_with(".p21")) continue;
      e.bytes = *write_zip({{"EM-10.p21", e.bytes}});
      e.name += ".zip";
    }
  }
  return *write_zip(entries);
}

TEST(Gtc, ReadsAPackageAndItsClass) {
  for (const bool nested : {false, true}) {
    Job job;
    const auto r = import_bytes(package(nested), "own.zip", {}, job);
    ASSERT_TRUE(r) << to_text(r.error());
    ASSERT_EQ(r->library.items.size(), 1U);
    const CatalogueItem& i = r->library.items.front();
    EXPECT_EQ(i.product_id, "4711");
    EXPECT_EQ(i.kind, "MILSQS");
    EXPECT_EQ(i.cutter_class, CutterClass::kEndmill);
    EXPECT_EQ(number_of(i, "DC"), 10.0);
    EXPECT_EQ(*find_kept(r->library.kept, "package_meta_data/vendor_name"), "Own");
  }
}

TEST(Gtc, TellsOfProductDataThatIsMissing) {
  Job job;
  const auto r = import_bytes(package(false, "other.p21"), "own.zip", {}, job);
  ASSERT_TRUE(r) << to_text(r.error());
  EXPECT_THAT(r->report.dropped, Contains(Field(&LossReport::Line::what, HasSubstr("other.p21"))));
}

TEST(Gtc, RefusesPackagesWithoutDataAndBrokenOnes) {
  Job job;
  auto r =
      import_bytes(*write_zip({{"package_assortment.xml", "<package_assortment/>"}}), "own.zip", {}, job);
  ASSERT_FALSE(r);
  EXPECT_EQ(r.error().code, "GTC-FORM");
  r = import_bytes(*write_zip({{"package_assortment.xml", "<package_assortment>"}, {"a.p21", file(kLong)}}),
                   "own.zip", {}, job);
  ASSERT_FALSE(r);
  EXPECT_EQ(r.error().code, "XML-SYNTAX");
  const std::string whole = package(false);
  r = gtc_format().read(whole.substr(0, whole.size() / 2), "own.zip", {}, job);
  ASSERT_FALSE(r);
  EXPECT_EQ(r.error().code, "ZIP-SYNTAX");
}

}  // namespace
}  // namespace capstan::tooling
