#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "planner/ground/base/number.h"
#include "tests/support/corpus.h"
#include "tooling/library/cutters/generic.h"
#include "tooling/library/formats/all.h"
#include "tooling/library/formats/csv/csv.h"
#include "tooling/library/formats/import.h"
#include "tooling/library/formats/values.h"
#include "tooling/library/library.h"

namespace capstan::tooling {
namespace {

using ::testing::HasSubstr;

std::string dropped(const LossReport& r) {
  std::string out;
  for (const auto& l : r.dropped) out += l.tool + ":" + l.field + ":" + l.what + "\n";
  return out;
}

// --- tables with columns ---

TEST(Csv, ReadsFusionsExportAsTheLibraryItIsOf) {
  CAPSTAN_CORPUS_FILE(table, "tools/fusion/Makera_Drill_Bits.csv");
  CAPSTAN_CORPUS_FILE(packed, "tools/fusion/Makera_Drill_Bits.tools");
  Job job;
  const auto csv = import_library(table, {}, job);
  ASSERT_TRUE(csv) << to_text(csv.error());
  const auto tools = import_library(packed, {}, job).value();
  ASSERT_EQ(csv->library.items.size(), 30u);
  const CatalogueItem& first = csv->library.items[0];
  EXPECT_EQ(first.description, "0.2*3.5mm Drill");
  EXPECT_EQ(first.presets.size(), 8u);  // a row each
  EXPECT_EQ(first.presets[2].name, "Carbon Fiber");
  EXPECT_EQ(first.presets[2].plunge_mm_min, 200.0);
  EXPECT_EQ(csv->library.assemblies[0].stick_out_mm, 19.0);
  EXPECT_EQ(csv->library.holders.at(0).segments.at(1), (model::HolderSegment{0.5, 9.0, 10.0}));
  // The same sizes as in the library itself; the order of tools differs.
  const auto of = [&tools](const std::string& description) -> const CatalogueItem* {
    for (const auto& i : tools.library.items)
      if (i.description == description) return &i;
    return nullptr;
  };
  for (const auto& i : csv->library.items) {
    const CatalogueItem* other = of(i.description);
    ASSERT_NE(other, nullptr) << i.description;
    for (const char* symbol : {"DC", "LCF", "OAL", "DMM", "ZEFF", "SIG", "LU"})
      EXPECT_EQ(number_of(i, symbol), number_of(*other, symbol)) << i.description << " " << symbol;
    EXPECT_EQ(i.presets.size(), other->presets.size());
  }
}

TEST(Csv, TakesDecimalCommasSemicolonsAndUnitsOfTitles) {
  Job job;
  const auto read = import_bytes(
      "\xEF\xBB\xBF"
      "Bezeichnung;Typ;Durchmesser [mm];Schneidenzahl;Spitzenwinkel [\xC2\xB0];Shank (in)\r\n"
      "\"Bohrer 5,5; lang\";Bohrer;5,5;2;118;0,25\r\n",
      "tools.csv", {}, job);
  ASSERT_TRUE(read) << to_text(read.error());
  const CatalogueItem& i = read->library.items.at(0);
  EXPECT_EQ(i.description, "Bohrer 5,5; lang");
  EXPECT_EQ(i.cutter_class, model::CutterClass::kTwistDrill);
  EXPECT_EQ(number_of(i, "DC"), 5.5);
  EXPECT_DOUBLE_EQ(*number_of(i, "DMM"), 6.35);
  EXPECT_NEAR(*number_of(i, "SIG"), 118 * std::numbers::pi / 180.0, 1e-12);
}

TEST(Csv, ASavedMapReadsAForeignTableAndWritesItAgain) {
  const std::string table = "Fraeser,Dm,Zz,Notiz\n8er,8,3,rot\n";
  FormatOptions options;
  options.column_map =
      "capstan_columns: 1\nunit: mm\ncolumns:\n"
      "  - {title: Fraeser, field: description}\n  - {title: Dm, field: DC}\n  - {title: Zz, field: ZEFF}\n";
  Job job;
  const auto read = import_bytes(table, "t.csv", options, job);
  ASSERT_TRUE(read) << to_text(read.error());
  EXPECT_EQ(number_of(read->library.items.at(0), "DC"), 8.0);
  EXPECT_EQ(number_of(read->library.items.at(0), "ZEFF"), 3.0);
  const std::string* map = find_kept(read->library.kept, csv::kMapKey);
  ASSERT_NE(map, nullptr);
  // The map that was kept says the same, and more: what becomes of the fourth column.
  FormatOptions saved;
  saved.column_map = *map;
  EXPECT_TRUE(import_bytes(table, "t.csv", saved, job)->library == read->library);
  EXPECT_EQ(csv_format().write(read->library, saved, job)->bytes, table);
  options.column_map += "  - {title: Laenge, field: OAL}\n";
  EXPECT_EQ(import_bytes(table, "t.csv", options, job).error().code, "CSV-COLUMN");
}

TEST(Csv, RefusesAPointWhereTheMapSaysComma) {
  FormatOptions comma;
  comma.column_map =
      "capstan_columns: 1\nseparator: \";\"\ndecimal: \",\"\nunit: mm\ncolumns:\n"
      "  - {title: n, field: description}\n  - {title: d, field: DC}\n";
  Job job;
  EXPECT_EQ(number_of(import_bytes("n;d\na;5,5\n", "t.csv", comma, job)->library.items.at(0), "DC"), 5.5);
  const auto point = import_bytes("n;d\na;1.234\n", "t.csv", comma, job);
  ASSERT_FALSE(point);  // 1.234 or 1234?
  EXPECT_EQ(point.error().code, "DATA-NUMBER");
  EXPECT_THAT(point.error().path, HasSubstr("column 'd'"));
}

TEST(Csv, WhatATableKeepsDoesNotBecomeAKeyOfFusions) {
  Job job;
  const auto read =
      import_bytes("description,type,DC,unit,Shelf\nx,drill,5,mm,7\n", "a.csv", {}, job).value();
  const auto out = fusion_json_format().write(read.library, {}, job).value();
  EXPECT_EQ(out.bytes.find("Shelf"), std::string::npos);
  EXPECT_THAT(dropped(out.report), HasSubstr("csv.Shelf:it has no place in a Fusion library"));
}

TEST(Csv, AToolNumberIsWrittenForTheFirstThatHasIt) {
  CAPSTAN_CORPUS_FILE(path, "tools/fusion/Makera_Ball_Endmills.tools");
  Job job;
  ToolLibrary library = import_library(path, {}, job).value().library;
  for (auto& e : library.entries) e.number = 1;
  const auto out = csv_format().write(library, {}, job).value();
  EXPECT_THAT(dropped(out.report), HasSubstr("number:tool number 1 is that of another tool"));
  const auto again = import_bytes(out.bytes, "t.csv", {}, job);
  ASSERT_TRUE(again) << to_text(again.error());
  EXPECT_EQ(again->library.items.size(), 18u);
  EXPECT_EQ(again->library.items[0].presets.size(), library.items[0].presets.size());
}

// --- LinuxCNC ---

TEST(LinuxCnc, ReadsTheTablesOfTheCorpusAndWritesThemWithNothingLost) {
  CAPSTAN_CORPUS_FILE(folder, "tools/linuxcnc/");
  struct Table {
    const char* name;
    std::size_t entries, items, number;
    char axis;
    double value;
  };
  // Of the entry in question: line 3 of the first (T3 Z1.273), line 5 of the second (T5 X+4711).
  const Table tables[] = {{"configs_sim_axis_sim_mm.tbl", 24, 24, 3, 'Z', 1.273},
                          {"configs_sim_nstools.tbl", 24, 24, 5, 'X', 4711.0},
                          {"tormach_shop_tool.tbl", 256, 0, 7, 'D', 0.0}};
  for (const Table& t : tables) {
    Job job;
    const auto read = import_library(folder + t.name, {}, job);
    ASSERT_TRUE(read) << to_text(read.error());
    EXPECT_EQ(read->library.entries.size(), t.entries) << t.name;
    EXPECT_EQ(read->library.items.size(), t.items) << t.name;
    bool found = false;
    for (const auto& e : read->library.entries)
      for (const auto& [axis, value] : e.offsets)
        found = found || (e.number == static_cast<int>(t.number) && axis == t.axis && value == t.value);
    EXPECT_TRUE(found) << t.name;
    const auto written = linuxcnc_format().write(read->library, {}, job).value();
    auto again = import_bytes(written.bytes, folder + t.name, {}, job).value();
    EXPECT_EQ(dropped(written.report), "") << t.name;
    // Letters are written in one order; what they say is the same.
    const auto sorted = [](ToolLibrary l) {
      for (auto& e : l.entries) std::sort(e.offsets.begin(), e.offsets.end());
      return l;
    };
    EXPECT_TRUE(sorted(again.library) == sorted(read->library)) << t.name;
  }
}

TEST(LinuxCnc, KeepsAllLettersAndConvertsTheUnitWhenAsked) {
  Job job;
  FormatOptions inch;
  inch.mm_per_unit = 25.4;
  const std::string line =
      "T7 P3 X0.5 Y-1 Z+4.25 A10 B20 C30 U1 V2 W3 D0.250 I90 J95 Q2 ;1/4 end mill, 2 flutes\n";
  const auto read = import_bytes(line, "t.tbl", inch, job).value();
  ASSERT_EQ(read.library.entries.size(), 1u);
  EXPECT_EQ(read.library.entries[0].offsets.size(), 13u);
  EXPECT_DOUBLE_EQ(*number_of(read.library.items.at(0), "DC"), 6.35);
  EXPECT_EQ(linuxcnc_format().write(read.library, {}, job)->bytes,
            "T7 P3 X0.5 Y-1 Z4.25 A10 B20 C30 U1 V2 W3 D0.250 I90 J95 Q2 ;1/4 end mill, 2 flutes\n");
  FormatOptions mm;
  mm.mm_per_unit = 1.0;
  const auto metric = linuxcnc_format().write(read.library, mm, job)->bytes;
  EXPECT_THAT(metric, HasSubstr("X12.7 Y-25.4 Z107.95 A10 B20 C30 U25.4 V50.8 W76.2 D6.35 I90"));
}

TEST(LinuxCnc, WritesAClassIntoTheCommentAndTellsWhatATableCannotHold) {
  Job job;
  const auto generic = generic_library().value();
  const auto out = linuxcnc_format().write(library_of(generic, "generic"), {}, job).value();
  EXPECT_EQ(out.report.tools, generic.size());
  const auto again = import_bytes(out.bytes, "t.tbl", {}, job);
  ASSERT_TRUE(again) << to_text(again.error());
  ASSERT_EQ(again->library.items.size(), generic.size());
  std::size_t same = 0;
  for (std::size_t k = 0; k < generic.size(); ++k) {
    EXPECT_NEAR(*number_of(again->library.items[k], "DC"), generic[k].cutting_diameter_mm, 1e-9);
    same += again->library.items[k].cutter_class == generic[k].cutter_class ? 1U : 0U;
  }
  // Words may mislead; where they do, the report says so.
  std::size_t told = 0;
  for (const auto& l : out.report.dropped) told += l.field == "class" ? 1U : 0U;
  EXPECT_EQ(same + told, generic.size());
  EXPECT_THAT(dropped(out.report), HasSubstr("presets:a tool table has no place for start values"));
}

// --- round trips of libraries drawn at random ---

class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}
  double size(double most) { return std::uniform_int_distribution<int>(1, 4000)(random_) * most / 4000.0; }
  int upto(int n) { return std::uniform_int_distribution<int>(0, n)(random_); }
  bool toss() { return upto(1) == 1; }
  std::string word() {
    static const char* kWords[] = {"short",        "a,b", "\"quoted\"", "semi;colon",
                                   "\xC3\xBC\x6d", "tab", "x'y",        "100%"};
    return kWords[upto(7)];
  }

  ToolLibrary library() {
    ToolLibrary out;
    const int n = 1 + upto(12);
    for (int k = 0; k < n; ++k) tool(out, k);
    return out;
  }

 private:
  void tool(ToolLibrary& out, int k) {
    CatalogueItem i;
    i.id = "id-" + std::to_string(k);
    i.inches = toss();
    const char* unit = i.inches ? "in" : "mm";
    static const std::pair<const char*, model::CutterClass> kKinds[] = {
        {"flat end mill", model::CutterClass::kEndmill},
        {"drill", model::CutterClass::kTwistDrill},
        {"ball end mill", model::CutterClass::kBallEndmill},
        {"reamer", model::CutterClass::kReamer}};
    const auto& [kind, cls] = kKinds[upto(3)];
    i.kind = kind;
    i.cutter_class = cls;
    i.description = word() + " " + std::to_string(k);
    i.manufacturer = toss() ? word() : "";
    i.product_id = toss() ? word() : "";
    const double d = size(40.0);
    const auto add = [&](const char* symbol, double v, const char* u) {
      // As a reader would have it: the number follows from what is spelled.
      const Property p = number_property(symbol, v, u, ValueState::kStated, symbol);
      i.properties.push_back(property_from(symbol, p.text, u, symbol, {}).value());
    };
    add("DC", d, unit);
    if (toss()) add("LCF", 10.0 + size(30.0), unit);
    if (toss()) add("OAL", 45.0 + size(100.0), unit);
    if (toss()) add("DMM", d, unit);
    if (toss()) add("ZEFF", 1 + upto(7), "");
    if (toss()) add("SIG", size(3.0), "deg");
    if (toss()) i.properties.push_back(text_property("BMC", toss() ? "carbide" : "hss", "BMC"));
    for (int p = upto(3); p > 0; --p) {
      Preset q;
      q.name = word() + std::to_string(p);
      q.source = "preset '" + q.name + "'";
      if (toss()) q.material = word();
      if (toss()) q.coolant = "flood";
      q.rpm = 1000.0 + upto(20000);
      if (toss()) q.fz_mm = *parse_double(shortest(size(0.5))) * (i.inches ? kMmPerInch : 1.0);
      if (toss()) q.plunge_mm_min = (10 + upto(500)) * (i.inches ? kMmPerInch : 1.0);
      i.presets.push_back(q);
    }
    ToolAssembly a;
    a.id = a.item = i.id;
    if (toss()) {
      Holder h;
      h.id = "h-" + std::to_string(k);
      h.description = word();
      h.inches = i.inches;
      const double mm = i.inches ? kMmPerInch : 1.0;
      for (int s = upto(3); s >= 0; --s)
        h.segments.push_back({(1 + upto(30)) * mm, upto(60) * mm, upto(60) * mm});
      a.holder = h.id;
      out.holders.push_back(h);
    }
    if (toss()) {
      MachineEntry e;
      e.number = 100 + k;
      e.assembly = a.id;
      e.comment = toss() ? "comment " + std::to_string(k) : "";
      out.entries.push_back(e);
    }
    out.items.push_back(i);
    out.assemblies.push_back(a);
  }
  std::mt19937 random_;
};

/// Where a value was read from, and the reading's own marks, differ by the file.
ToolLibrary bare(ToolLibrary l) {
  l.source.clear();
  l.kept.clear();
  for (auto& i : l.items) {
    for (auto& p : i.properties) p.source.clear();
    std::sort(i.properties.begin(), i.properties.end(),
              [](const Property& a, const Property& b) { return a.symbol < b.symbol; });
    std::erase_if(i.properties, [](const Property& p) {
      return p.symbol == "HAND" || p.state == ValueState::kDerived;  // written, or found again
    });
    std::erase_if(i.kept, [](const auto& k) { return k.first.starts_with("presets."); });
  }
  for (auto& h : l.holders) h.kept.clear();
  return l;
}

/// Records by their ids, so that a difference can be named.
void expect_same(const ToolLibrary& want, const ToolLibrary& have, unsigned seed) {
  ASSERT_EQ(want.items.size(), have.items.size()) << seed;
  for (std::size_t k = 0; k < want.items.size(); ++k) {
    const auto &a = want.items[k], &b = have.items[k];
    ASSERT_EQ(a.properties.size(), b.properties.size()) << seed << a.id;
    for (std::size_t p = 0; p < a.properties.size(); ++p) {
      EXPECT_EQ(a.properties[p].symbol, b.properties[p].symbol) << seed;
      EXPECT_EQ(a.properties[p].number, b.properties[p].number) << seed << a.properties[p].symbol;
      EXPECT_EQ(a.properties[p].text, b.properties[p].text) << seed << a.properties[p].symbol;
      EXPECT_EQ(a.properties[p].unit, b.properties[p].unit) << seed << a.properties[p].symbol;
    }
    EXPECT_EQ(a.presets.size(), b.presets.size()) << seed << a.id;
    EXPECT_TRUE(a.presets == b.presets) << seed << a.id;
    EXPECT_TRUE(a == b) << seed << a.id;
  }
  EXPECT_TRUE(want.assemblies == have.assemblies) << seed;
  EXPECT_TRUE(want.entries == have.entries) << seed;
  EXPECT_TRUE(want.holders == have.holders) << seed;
}

TEST(RandomLibraries, ComeBackFromFusionAsTheyWere) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const ToolLibrary library = Draw(seed).library();
    Job job;
    const auto out = fusion_format().write(library, {}, job).value();
    EXPECT_EQ(dropped(out.report), "") << seed;
    const auto again = import_bytes(out.bytes, "r.tools", {}, job);
    ASSERT_TRUE(again) << seed << to_text(again.error());
    expect_same(bare(library), bare(again->library), seed);
  }
}

TEST(RandomLibraries, ComeBackFromATableAsTheyWere) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const ToolLibrary library = Draw(seed).library();
    Job job;
    const auto out = csv_format().write(library, {}, job).value();
    EXPECT_EQ(dropped(out.report), "") << seed;
    const auto again = import_bytes(out.bytes, "r.csv", {}, job);
    ASSERT_TRUE(again) << seed << to_text(again.error()) << out.bytes;
    expect_same(bare(library), bare(again->library), seed);
  }
}

TEST(RandomLibraries, CuttersComeBackFromRecordsAsTheyWere) {
  const auto generic = generic_library().value();
  Job job;
  LossReport report;
  const auto again = cutters_of(library_of(generic, "generic"), report, job).value();
  EXPECT_EQ(dropped(report), "");
  ASSERT_EQ(again.size(), generic.size());
  for (std::size_t k = 0; k < generic.size(); ++k) {
    model::Cutter a = generic[k], b = again[k];
    a.sources.clear();
    b.sources.clear();
    for (auto* c : {&a, &b})
      for (auto& p : c->presets) p.fz_mm = rounded(p.fz_mm, 9);
    EXPECT_TRUE(a == b) << a.id;
  }
}

TEST(RandomLibraries, OurOwnListHoldsWhatPlanningUses) {
  const auto generic = generic_library().value();
  std::vector<model::Cutter> some(generic.begin(), generic.begin() + 60);
  for (auto& c : some) {  // as a shop would state them
    c.sources = {{"*", "stated: measured"}};
    for (auto& p : c.presets) p.source = "measured";
  }
  Job job;
  const auto out = own_format().write(library_of(some, "shop"), {}, job).value();
  const auto again = read_library(out.bytes, "own.yaml", job);
  ASSERT_TRUE(again) << to_text(again.error());
  ASSERT_EQ(again->size(), some.size());
  for (std::size_t k = 0; k < some.size(); ++k) {
    model::Cutter a = some[k], b = again->at(k);
    a.sources.clear();
    b.sources.clear();
    for (auto* c : {&a, &b})
      for (auto& p : c->presets) p.fz_mm = rounded(p.fz_mm, 9);
    EXPECT_TRUE(a == b) << out.bytes.substr(0, 1200);
  }
}

}  // namespace
}  // namespace capstan::tooling
