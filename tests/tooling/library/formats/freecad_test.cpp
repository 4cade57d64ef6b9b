#include "tooling/library/formats/freecad/freecad.h"

#include <gmock/gmock.h>

#include <numbers>
#include <random>

#include "planner/ground/base/number.h"
#include "tests/support/corpus.h"
#include "tooling/library/formats/all.h"
#include "tooling/library/formats/import.h"
#include "tooling/library/formats/values.h"

namespace capstan::tooling {
namespace {

using model::CutterClass;
using ::testing::Contains;
using ::testing::Field;
using ::testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180.0;

std::string bit(std::string_view type, std::string_view parameters) {
  return "{\"version\": 2, \"name\": \"n\", \"shape\": \"x.fcstd\", \"shape-type\": \"" + std::string(type) +
         "\", \"parameter\": {" + std::string(parameters) + "}, \"attribute\": {}}";
}

Result<Imported> read_bit(const std::string& text, std::optional<double> mm_per_unit = std::nullopt) {
  Job job;
  return read_freecad({{"Bit/a.fctb", text}}, "a.fctb", {.mm_per_unit = mm_per_unit, .column_map = {}}, job);
}

const CatalogueItem& item(const ToolLibrary& l, std::string_view id) {
  for (const CatalogueItem& i : l.items)
    if (i.id == id) return i;
  throw std::logic_error("no item " + std::string(id));
}

TEST(Freecad, ReadsTheBitsThatComeWithFreecad) {
  CAPSTAN_CORPUS_FILE(folder, "tools/freecad");
  Job job;
  const auto r = import_library(folder, {}, job);
  ASSERT_TRUE(r) << to_text(r.error());
  const ToolLibrary& l = r->library;
  EXPECT_EQ(l.items.size(), 14U);
  EXPECT_EQ(l.entries.size(), 13U);
  // 5mm_Endmill.fctb: Diameter 5.0000 mm, CuttingEdgeHeight 30.0000 mm, Length 50.0000 mm,
  // ShankDiameter 3.0000 mm
  const CatalogueItem& mill = item(l, "5mm_Endmill");
  EXPECT_EQ(mill.cutter_class, CutterClass::kEndmill);
  EXPECT_EQ(number_of(mill, "DC"), 5.0);
  EXPECT_EQ(number_of(mill, "APMX"), 30.0);
  EXPECT_EQ(number_of(mill, "OAL"), 50.0);
  EXPECT_EQ(number_of(mill, "DMM"), 3.0);
  // 5mm_Drill.fctb: TipAngle 119.0000 deg
  EXPECT_NEAR(*number_of(item(l, "5mm_Drill"), "SIG"), 119.0 * kDegree, 1e-12);
  // 375-16_Tap.fctb: Diameter 0.375 ", Flutes 3
  const CatalogueItem& tap = item(l, "375-16_Tap");
  EXPECT_TRUE(tap.inches);
  EXPECT_DOUBLE_EQ(*number_of(tap, "DC"), 0.375 * 25.4);
  EXPECT_EQ(number_of(tap, "ZEFF"), 3.0);
  // 6mm_Bullnose.fctb: CornerRadius 1.5000 mm; 6mm_Ball_End.fctb: half of 6 mm
  EXPECT_EQ(number_of(item(l, "6mm_Bullnose"), "RE"), 1.5);
  EXPECT_EQ(number_of(item(l, "6mm_Ball_End"), "RE"), 3.0);
  EXPECT_EQ(number_of(item(l, "slittingsaw"), "CW"), 3.0);
  EXPECT_EQ(item(l, "probe").cutter_class, CutterClass::kTouchProbe);
  // 60degree_Vbit.fctb: (10 - 0.1) / 2 / tan(30 deg) of cone, 1 mm of cylinder
  EXPECT_NEAR(*number_of(item(l, "60degree_Vbit"), "APMX"), 4.95 * std::numbers::sqrt3 + 1.0, 1e-4);
  // Library/Default.fctl: nr 3 is 5mm_Drill.fctb
  EXPECT_THAT(l.entries, Contains(::testing::AllOf(Field(&MachineEntry::number, 3),
                                                   Field(&MachineEntry::assembly, "5mm_Drill"))));
}

TEST(Freecad, FindsWhatThePublicBitsGetWrong) {
  CAPSTAN_CORPUS_FILE(folder, "tools/freecad");
  Job job;
  const auto r = import_library(folder, {}, job);
  ASSERT_TRUE(r) << to_text(r.error());
  // The chamfer mill says 45 deg; from 5 mm over 6.35 mm, 12.3323 mm is a cone of 60 deg.
  EXPECT_EQ(item(r->library, "45degree_chamfer").cutter_class, std::nullopt);
  EXPECT_THAT(r->report.dropped, Contains(Field(&LossReport::Line::what, HasSubstr("contradict"))));
  // The tap has a pitch of 0; its name tells it: 3/8 in, 16 threads an inch.
  EXPECT_EQ(number_of(item(r->library, "375-16_Tap"), "TP"), 0.0);
  LossReport report;
  const auto cutters = cutters_of(r->library, report, job);
  ASSERT_TRUE(cutters) << to_text(cutters.error());
  EXPECT_EQ(cutters->size(), 12U);  // without the chamfer mill and a thread mill that has no pitch
  const auto tap =
      std::find_if(cutters->begin(), cutters->end(), [](const auto& c) { return c.id == "375-16_Tap"; });
  ASSERT_NE(tap, cutters->end());
  EXPECT_NEAR(tap->thread_pitch_mm, 25.4 / 16.0, 1e-9);
}

TEST(Freecad, ALibraryFindsItsBitsInTheFolderBesideItsOwn) {
  CAPSTAN_CORPUS_FILE(file, "tools/freecad/Library/Default.fctl");
  Job job;
  const auto r = import_library(file, {}, job);
  ASSERT_TRUE(r) << to_text(r.error());
  EXPECT_EQ(r->library.items.size(), 13U);
  EXPECT_EQ(r->library.assemblies.size(), 13U);
}

TEST(Freecad, NamesOfALibraryNeverLeadElsewhere) {
  const capstan::testing::ScratchFolder scratch;
  Job job;
  const std::string text =
      "{\"version\": 1, \"tools\": [{\"nr\": 1, \"path\": \"../../../../etc/hostname.fctb\"}]}";
  const auto r = freecad_format().read(text, scratch.file("a.fctl"), {}, job);
  ASSERT_FALSE(r);  // nothing was found beside it
  EXPECT_EQ(r.error().code, "FREECAD-VALUE");
}

TEST(Freecad, TheCorpusSurvivesARoundTrip) {
  CAPSTAN_CORPUS_FILE(file, "tools/freecad/Library/Default.fctl");
  Job job;
  const auto first = import_library(file, {}, job);
  ASSERT_TRUE(first) << to_text(first.error());
  const auto written = write_freecad(first->library, {}, job);
  ASSERT_TRUE(written) << to_text(written.error());
  EXPECT_TRUE(written->report.dropped.empty())
      << written->report.dropped.front().tool << " " << written->report.dropped.front().field;
  const auto second = import_bytes(written->bytes, "a.zip", {}, job);
  ASSERT_TRUE(second) << to_text(second.error());
  ASSERT_EQ(second->library.items.size(), first->library.items.size());
  for (const CatalogueItem& i : first->library.items) {
    const CatalogueItem& other = item(second->library, i.id);
    EXPECT_EQ(i.cutter_class, other.cutter_class) << i.id;
    for (const Property& p : i.properties) {
      const Property* q = find(other.properties, p.symbol);
      ASSERT_NE(q, nullptr) << i.id << " " << p.symbol;
      EXPECT_EQ(*q, p) << i.id << " " << p.symbol;
    }
    EXPECT_THAT(other.kept, ::testing::UnorderedElementsAreArray(i.kept)) << i.id;
  }
  EXPECT_EQ(second->library.entries.size(), 13U);
}

TEST(Freecad, RandomToolsSurviveARoundTripInMillimetresAndInches) {
  std::mt19937 random(20240611);
  const auto size = [&](double least, double most) {
    return rounded(std::uniform_real_distribution(least, most)(random), 4);
  };
  ToolLibrary l;
  l.name = "shop";
  const CutterClass classes[] = {CutterClass::kEndmill, CutterClass::kBullnoseEndmill, CutterClass::kReamer,
                                 CutterClass::kTap, CutterClass::kThreadMill};
  for (int n = 0; n < 200; ++n) {
    CatalogueItem i;
    i.id = i.description = "t" + std::to_string(n);
    i.cutter_class = classes[n % 5];
    const std::string_view unit = n % 2 == 0 ? "mm" : "in";
    i.inches = unit == "in";
    const double k = i.inches ? 25.4 : 1.0;
    const auto add = [&](std::string_view symbol, double value) {
      i.properties.push_back(number_property(symbol, value * k, unit, ValueState::kStated, ""));
    };
    const double d = i.inches ? size(0.04, 1.0) : size(1.0, 25.0);
    add("DC", d);
    add("OAL", d * 8.0);
    add("DMM", d);
    if (i.cutter_class != CutterClass::kThreadMill) add("APMX", d * 2.0);
    if (i.cutter_class == CutterClass::kBullnoseEndmill) add("RE", d * 0.25);
    if (i.cutter_class == CutterClass::kTap) add("TP", d * 0.1);
    i.properties.push_back(number_property("ZEFF", 2 + n % 5, "", ValueState::kStated, ""));
    l.items.push_back(i);
    l.assemblies.push_back({i.id, i.id, {}, {}, {}, {}});
    l.entries.push_back({n + 1, {}, "shop", i.id, {}, {}});
  }
  Job job;
  const auto written = write_freecad(l, {}, job);
  ASSERT_TRUE(written) << to_text(written.error());
  // A reamer of FreeCAD has no flutes; nothing else may be lost.
  for (const auto& line : written->report.dropped) EXPECT_EQ(line.field, "ZEFF") << line.tool << line.what;
  const auto back = import_bytes(written->bytes, "a.zip", {}, job);
  ASSERT_TRUE(back) << to_text(back.error());
  ASSERT_EQ(back->library.items.size(), l.items.size());
  for (const CatalogueItem& i : l.items) {
    const CatalogueItem& other = item(back->library, i.id);
    EXPECT_EQ(other.cutter_class, i.cutter_class);
    EXPECT_EQ(other.inches, i.inches);
    for (const Property& p : i.properties)
      EXPECT_EQ(number_of(other, p.symbol), p.number) << i.id << " " << p.symbol << " " << p.text << p.unit;
  }
  EXPECT_EQ(back->library.entries.size(), l.entries.size());
  // The same library gives the same bytes.
  EXPECT_EQ(write_freecad(l, {}, job)->bytes, written->bytes);
}

TEST(Freecad, AttributesAndUnknownShapesAreKeptWordForWord) {
  const std::string text =
      "{\"version\": 2, \"name\": \"n\", \"shape\": \"laser.fcstd\", \"shape-type\": \"Laser\","
      " \"parameter\": {\"DotSize\": \"0.1 mm\"}, \"attribute\": {\"Colour\": [1, \"red\"]}}";
  const auto r = read_bit(text);
  ASSERT_TRUE(r) << to_text(r.error());
  const CatalogueItem& i = r->library.items.front();
  EXPECT_EQ(i.cutter_class, std::nullopt);
  EXPECT_EQ(*find_kept(i.kept, "parameter/DotSize"), "0.1 mm");
  LossReport report;
  const auto files = freecad_files(r->library, report);
  ASSERT_EQ(files.size(), 1U);
  EXPECT_THAT(files.front().bytes, HasSubstr("\"Laser\""));
  EXPECT_THAT(files.front().bytes, HasSubstr("\"DotSize\": \"0.1 mm\""));
  EXPECT_THAT(files.front().bytes, HasSubstr("\"red\""));
}

struct Bad {
  const char* name;
  std::string text;
  const char* code;
};
void PrintTo(const Bad& b, std::ostream* os) { *os << b.name; }

class FreecadRefuses : public ::testing::TestWithParam<Bad> {};
TEST_P(FreecadRefuses, WithOneClearError) {
  const auto r = read_bit(GetParam().text);
  ASSERT_FALSE(r);
  EXPECT_EQ(r.error().code, GetParam().code) << to_text(r.error());
  EXPECT_EQ(r.error().file, "a.fctb");
}
INSTANTIATE_TEST_SUITE_P(
    Bits, FreecadRefuses,
    ::testing::Values(
        Bad{"no unit", bit("Endmill", R"("Diameter": "6.0000")"), "DATA-UNIT"},
        Bad{"unknown unit", bit("Endmill", R"("Diameter": "6 furlong")"), "DATA-UNIT"},
        Bad{"angle in mm", bit("Drill", R"("Diameter": "6 mm", "TipAngle": "118 mm")"), "DATA-UNIT"},
        Bad{"zero diameter", bit("Endmill", R"("Diameter": "0.0000 mm")"), "FREECAD-VALUE"},
        Bad{"negative", bit("Endmill", R"("Diameter": "-6 mm")"), "TOOL-VALUE"},
        Bad{"no diameter", bit("Endmill", R"("Length": "50 mm")"), "FREECAD-VALUE"},
        Bad{"flutes longer than the tool",
            bit("Endmill", R"("Diameter": "6 mm", "CuttingEdgeHeight": "60 mm", "Length": "50 mm")"),
            "FREECAD-VALUE"},
        Bad{"3.9 flutes", bit("Endmill", R"("Diameter": "6 mm", "Flutes": "3.9")"), "TOOL-VALUE"},
        Bad{"300 flutes", bit("Endmill", R"("Diameter": "6 mm", "Flutes": "300")"), "TOOL-VALUE"},
        Bad{"-1 flutes", bit("Endmill", R"("Diameter": "6 mm", "Flutes": "-1")"), "TOOL-VALUE"},
        Bad{"radius too large", bit("Bullnose", R"("Diameter": "6 mm", "CornerRadius": "3.1 mm")"),
            "FREECAD-VALUE"},
        Bad{"1e400", bit("Endmill", R"("Diameter": "1e400 mm")"), "DATA-NUMBER"},
        Bad{"NaN", bit("Endmill", R"("Diameter": "NaN mm")"), "FREECAD-VALUE"},
        Bad{"decimal comma", bit("Endmill", R"("Diameter": "6,5 mm")"), "DATA-NUMBER"},
        Bad{"duplicate key", bit("Endmill", R"("Diameter": "6 mm", "Diameter": "8 mm")"), "DATA-DUPLICATE"},
        Bad{"a bare number", R"({"shape": "endmill.fcstd", "parameter": {"Diameter": 6}})", "DATA-UNIT"},
        Bad{"no shape", R"({"parameter": {}})", "FREECAD-FORM"},
        Bad{"cut off", R"({"shape": "endmill.fcstd", "parameter": {"Dia)", "JSON-SYNTAX"},
        Bad{"deep", R"({"shape": "e", "attribute": )" + std::string(1'000'000, '['), "JSON-DEPTH"}));

TEST(Freecad, AToolNumberGivenTwiceIsRefused) {
  Job job;
  const auto r = read_freecad(
      {{"Bit/a.fctb", bit("Endmill", R"("Diameter": "6 mm")")},
       {"Library/l.fctl",
        "{\"tools\": [{\"nr\": 1, \"path\": \"a.fctb\"},\n {\"nr\": 1, \"path\": \"a.fctb\"}]}"}},
      "lib.zip", {}, job);
  ASSERT_FALSE(r);
  EXPECT_EQ(r.error().code, "TOOL-NUMBER");
  EXPECT_EQ(r.error().line, 2U);
}

TEST(Freecad, OneBadBitOfManyIsLeftOutAndTold) {
  Job job;
  const auto r = read_freecad({{"Bit/a.fctb", bit("Endmill", R"("Diameter": "6 mm")")},
                               {"Bit/b.fctb", bit("Endmill", R"("Diameter": "6")")}},
                              "lib.zip", {}, job);
  ASSERT_TRUE(r) << to_text(r.error());
  EXPECT_EQ(r->library.items.size(), 1U);
  EXPECT_EQ(job.count(Severity::kWarning), 1U);
  EXPECT_THAT(r->report.dropped, Contains(Field(&LossReport::Line::tool, "b")));
}

TEST(Freecad, ABitThatIsCutOffOrNoneIsLeftOutOfManyToo) {
  Job job;
  const auto r = read_freecad({{"Bit/a.fctb", bit("Endmill", R"("Diameter": "6 mm")")},
                               {"Bit/b.fctb", R"({"shape": "endmill.fcstd", "parameter": {"Dia)"},
                               {"Bit/c.fctb", R"({"parameter": {}})"}},
                              "lib.zip", {}, job);
  ASSERT_TRUE(r) << to_text(r.error());
  EXPECT_EQ(r->library.items.size(), 1U);
  ASSERT_EQ(job.count(Severity::kWarning), 2U);
  EXPECT_EQ(job.diagnostics()[0].code, "JSON-SYNTAX");
  EXPECT_EQ(job.diagnostics()[0].file, "lib.zip (Bit/b.fctb)");
  EXPECT_EQ(job.diagnostics()[1].code, "FREECAD-FORM");
}

TEST(Freecad, LengthsWithoutAUnitAreInTheUnitThatTheCallerNames) {
  const std::string text =
      bit("Endmill", R"("Diameter": "6.0000", "CuttingEdgeHeight": 20, "Length": "2.5 in", "Flutes": "3")");
  // Nobody says the unit: an error that says how to.
  const auto unsaid = read_bit(text);
  ASSERT_FALSE(unsaid);
  EXPECT_EQ(unsaid.error().code, "DATA-UNIT");
  EXPECT_THAT(unsaid.error().hint, HasSubstr("--unit"));
  const auto mm = read_bit(text, 1.0);
  ASSERT_TRUE(mm) << to_text(mm.error());
  const CatalogueItem& i = mm->library.items.front();
  EXPECT_EQ(number_of(i, "DC"), 6.0);
  EXPECT_EQ(number_of(i, "APMX"), 20.0);
  EXPECT_DOUBLE_EQ(*number_of(i, "OAL"), 2.5 * 25.4);  // what is stated stays
  EXPECT_EQ(number_of(i, "ZEFF"), 3.0);                // a count has none
  EXPECT_FALSE(i.inches);
  EXPECT_THAT(mm->report.derived, Contains(Field(&LossReport::Line::field, "unit")));
  const auto inch = read_bit(bit("Endmill", R"("Diameter": "0.25")"), 25.4);
  ASSERT_TRUE(inch) << to_text(inch.error());
  EXPECT_DOUBLE_EQ(*number_of(inch->library.items.front(), "DC"), 0.25 * 25.4);
  EXPECT_TRUE(inch->library.items.front().inches);
  // The cylinder above a V-bit's cone: (6 - 0) / 2 / tan(45 deg) = 3, and 2.
  const auto v = read_bit(bit("VBit", R"("Diameter": "6", "CuttingEdgeAngle": "90 deg", "TipDiameter": "0",
                                         "CuttingEdgeHeight": "2")"),
                          1.0);
  ASSERT_TRUE(v) << to_text(v.error());
  EXPECT_NEAR(*number_of(v->library.items.front(), "APMX"), 5.0, 1e-4);
  // An angle is never in millimetres.
  EXPECT_FALSE(read_bit(bit("Drill", R"("Diameter": "6 mm", "TipAngle": "118")"), 1.0));
}

TEST(Freecad, TheChipLoadIsTheLargestFeedPerToothAndComesBackAsItWas) {
  Job job;
  const auto r = read_bit(bit("Endmill", R"("Diameter": "6 mm", "Flutes": 2, "Chipload": "0.05 mm")"));
  ASSERT_TRUE(r) << to_text(r.error());
  EXPECT_EQ(number_of(r->library.items.front(), "FZMAX"), 0.05);
  for (const auto& line : r->report.dropped) EXPECT_NE(line.field, "Chipload") << line.what;
  LossReport report;
  const auto cutters = cutters_of(r->library, report, job);
  ASSERT_TRUE(cutters) << to_text(cutters.error());
  ASSERT_EQ(cutters->size(), 1U);
  EXPECT_EQ(cutters->front().fz_max_mm, 0.05);
  EXPECT_LE(cutters->front().fz_min_mm, 0.05);
  const auto files = freecad_files(r->library, report);
  ASSERT_EQ(files.size(), 1U);
  EXPECT_THAT(files.front().bytes, HasSubstr("\"Chipload\": \"0.05 mm\""));
  for (const auto& line : report.dropped) EXPECT_NE(line.field, "FZMAX") << line.what;
  // FreeCAD's default, 0, says nothing.
  const auto none = read_bit(bit("Endmill", R"("Diameter": "6 mm", "Chipload": "0.00 mm")"));
  ASSERT_TRUE(none) << to_text(none.error());
  EXPECT_EQ(number_of(none->library.items.front(), "FZMAX"), std::nullopt);
  // The feed of a tap is its pitch.
  const auto tap = read_bit(bit("Tap", R"("Diameter": "6 mm", "Pitch": "1 mm", "Chipload": "0.05 mm")"));
  ASSERT_TRUE(tap) << to_text(tap.error());
  EXPECT_EQ(number_of(tap->library.items.front(), "FZMAX"), std::nullopt);
  // As a length it has a unit, or the caller's.
  EXPECT_FALSE(read_bit(bit("Endmill", R"("Diameter": "6 mm", "Chipload": "0.05")")));
  const auto bare = read_bit(bit("Endmill", R"("Diameter": "6 mm", "Chipload": "0.002")"), 25.4);
  ASSERT_TRUE(bare) << to_text(bare.error());
  EXPECT_DOUBLE_EQ(*number_of(bare->library.items.front(), "FZMAX"), 0.002 * 25.4);
}

TEST(Freecad, TheFluteLengthOfFusionIsTheHeightOfTheEdge) {
  Job job;
  const std::string tools =
      R"({"data": [
        {"type": "ball end mill", "unit": "millimeters", "guid": "ball", "description": "ball", "BMC": "carbide",
         "geometry": {"DC": 6, "LCF": 13, "LB": 30, "OAL": 57, "SFDM": 6, "NOF": 2, "RE": 3, "HAND": true}},
        {"type": "flat end mill", "unit": "inches", "guid": "flat", "description": "flat", "BMC": "hss",
         "geometry": {"DC": 0.25, "LCF": 0.75, "LB": 1.5, "OAL": 2.5, "SFDM": 0.25, "NOF": 3, "HAND": true}}]})";
  const auto in = import_bytes(tools, "a.json", {}, job);
  ASSERT_TRUE(in) << to_text(in.error());
  const auto out = write_freecad(in->library, {}, job);
  ASSERT_TRUE(out) << to_text(out.error());
  for (const auto& line : out->report.dropped) {
    EXPECT_NE(line.field, "LCF") << line.what;
    EXPECT_NE(line.field, "BMC") << line.what;
    EXPECT_NE(line.field, "RE") << line.what;  // half the diameter, which a ball says
  }
  const auto back = import_bytes(out->bytes, "a.zip", {}, job);
  ASSERT_TRUE(back) << to_text(back.error());
  EXPECT_EQ(number_of(item(back->library, "ball"), "APMX"), 13.0);
  EXPECT_EQ(number_of(item(back->library, "ball"), "RE"), 3.0);
  EXPECT_EQ(find(item(back->library, "ball").properties, "SUBSTRATE")->text, "carbide");
  EXPECT_DOUBLE_EQ(*number_of(item(back->library, "flat"), "APMX"), 0.75 * 25.4);
  EXPECT_EQ(find(item(back->library, "flat").properties, "SUBSTRATE")->text, "hss");
}

}  // namespace
}  // namespace capstan::tooling
