#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tooling/library/formats/all.h"
#include "tooling/library/formats/import.h"
#include "tooling/library/formats/linuxcnc/linuxcnc.h"
#include "tooling/library/formats/own/own_list.h"
#include "tooling/library/formats/values.h"
#include "tooling/library/formats/zip.h"
#include "tooling/library/library.h"
#include "tooling/library/words/comment_words.h"

// What a tool does not say and may not be guessed.

namespace capstan::tooling {
namespace {

using model::Cutter;
using model::CutterClass;
using ::testing::HasSubstr;

std::vector<Cutter> of_table(const std::string& text, Job& job) {
  auto c = read_tool_table(text, "shop.tbl", job);
  return c ? *c : std::vector<Cutter>{};
}

std::string told(const Job& job) {
  std::string out;
  for (const auto& d : job.diagnostics()) out += d.code + ": " + d.message + "\n";
  return out;
}

double pitch(const std::string& comment, const std::string& d) {
  Job job;
  const auto c = of_table("T1 P1 D" + d + " ;" + comment + "\n", job);
  return c.empty() ? 0.0 : c[0].thread_pitch_mm;
}

TEST(Unsaid, ATapWithoutAPitchIsLeftOut) {
  Job job;
  EXPECT_TRUE(of_table("T1 P1 D6 ;tap\n", job).empty());
  EXPECT_THAT(told(job), HasSubstr("a tap without a pitch"));
  EXPECT_EQ(pitch("thread mill", "4.5"), 0.0);
  EXPECT_EQ(pitch("M6 fine tap", "6"), 0.0);
}

TEST(Unsaid, WordsTellThePitchThatSuitsTheDiameter) {
  EXPECT_NEAR(pitch("tap 1/4-20", "6.35"), 1.27, 1e-9);
  EXPECT_NEAR(pitch("#10-32 UNF tap", "4.826"), 25.4 / 32, 1e-9);
  EXPECT_NEAR(pitch("375-16_Tap", "9.525"), 1.5875, 1e-9);
  EXPECT_NEAR(pitch("tap 1 1/4-7 UNC", "31.75"), 25.4 / 7, 1e-9);
  EXPECT_NEAR(pitch("tap 20 TPI", "6.35"), 1.27, 1e-9);
  EXPECT_EQ(pitch("tap M6x0.75", "6"), 0.75);
  EXPECT_EQ(pitch("Gewindebohrer M8 x 1,25", "8"), 1.25);
  EXPECT_EQ(pitch("M8-1.25 tap 6H", "8"), 1.25);
  EXPECT_EQ(pitch("tap M6", "6"), 1.0);  // ISO 261, coarse
  EXPECT_EQ(pitch("M6-6H tap", "6"), 1.0);
  EXPECT_EQ(pitch("thread mill M6", "4.5"), 1.0);
  EXPECT_EQ(pitch("tap M8", "6"), 0.0);      // an M8 tap is not 6 mm wide
  EXPECT_EQ(pitch("tap 1/4-20", "6"), 0.0);  // nor is one of 1/4 in
  EXPECT_EQ(pitch("tap lot 12-20", "6"), 0.0);
}

TEST(Unsaid, TheSizeOfATapIsThatOfTheOneThreadInItsNames) {
  EXPECT_EQ(thread_size_of_words("Gewindebohrer M6"), 6.0);
  EXPECT_EQ(thread_size_of_words("M8x1 tap"), 8.0);
  EXPECT_EQ(thread_size_of_words("MF10 x 1,25"), 10.0);
  EXPECT_EQ(thread_size_of_words("M6-6H"), 6.0);
  EXPECT_EQ(thread_size_of_words("M2,5"), 2.5);
  EXPECT_EQ(thread_size_of_words("tap 1/4-20 UNC"), 6.35);
  EXPECT_EQ(thread_size_of_words("tap 1 1/4-7 UNC"), 31.75);  // 7 threads an inch are too coarse for 1/4 in
  // No size: a grade of steel, one that ISO 261 lacks, a bare number, two sizes, part of a word.
  EXPECT_EQ(thread_size_of_words("HSS-E M35 tap"), 0.0);
  EXPECT_EQ(thread_size_of_words("HSS M2"), 0.0);
  EXPECT_EQ(thread_size_of_words("M13"), 0.0);
  EXPECT_EQ(thread_size_of_words("tap 6"), 0.0);
  EXPECT_EQ(thread_size_of_words("taps M6 and M8"), 0.0);
  EXPECT_EQ(thread_size_of_words("VHM6"), 0.0);
  EXPECT_EQ(thread_size_of_words("10-32"), 0.0);  // 10 in or number 10
}

TEST(Unsaid, ANumberThatMayBeTheGradeOfTheSteelBesideItIsNoSize) {
  for (const char* words :
       {"M2 HSS hand tap", "Cobalt M4 tap", "M2 high speed steel", "M2 high-speed steel tap", "HSS-E M6 tap",
        "HSSE (M3)", "tap, M2/HSS", "M10 HSSE", "M4 PM tap", "PM M4", "M2 steel tap", "HSS grade M2",
        "M3 cobalt", "Gewindebohrer Kobalt M6", "M4 Schnellarbeitsstahl", "HSS-Co5 M6", "M4 5% Co",
        "High Speed M2 tap"})
    EXPECT_EQ(thread_size_of_words(words), 0.0) << words;
  // A pitch or a tolerance makes it a thread; so does a number that is no grade, or one beside no steel.
  EXPECT_EQ(thread_size_of_words("M4x0.7 HSS tap"), 4.0);
  EXPECT_EQ(thread_size_of_words("HSS M6 x 1"), 6.0);
  EXPECT_EQ(thread_size_of_words("M6-6H HSS"), 6.0);
  EXPECT_EQ(thread_size_of_words("HSS-E M8"), 8.0);
  EXPECT_EQ(thread_size_of_words("M5 HSS hand tap"), 5.0);
  EXPECT_EQ(thread_size_of_words("M2,5 HSS"), 2.5);
  EXPECT_EQ(thread_size_of_words("M42 cobalt tap M6"), 6.0);
  EXPECT_EQ(thread_size_of_words("M4 high helix tap"), 4.0);
  EXPECT_EQ(thread_size_of_words("M6 core"), 6.0);
}

TEST(Unsaid, ATapOfATableWithoutADiameterIsAsWideAsItsNameSays) {
  Job job;
  const auto lib = import_bytes(
      "id,class,description,diameter (mm)\na,tap,tap M6,\nb,tap,tap,\nc,endmill,M6,\nd,tap,M2 HSS hand "
      "tap,\n",
      "t.csv", {}, job);
  ASSERT_TRUE(lib) << to_text(lib.error());
  LossReport report;
  const auto cutters = cutters_of(lib->library, report, job);
  ASSERT_TRUE(cutters) << to_text(cutters.error());
  ASSERT_EQ(cutters->size(), 1U) << told(job);
  EXPECT_EQ(cutters->front().cutting_diameter_mm, 6.0);
  EXPECT_EQ(cutters->front().thread_pitch_mm, 1.0);
}

TEST(Unsaid, ConversionFillsInNoPitch) {
  Job job;
  const auto lib = import_bytes("id,class,diameter (mm)\na,tap,6\nM5 roughing,tap,5\n", "t.csv", {}, job);
  ASSERT_TRUE(lib) << to_text(lib.error());
  for (const Format* f : {&csv_format(), &linuxcnc_format()}) {
    const auto out = f->write(lib->library, {}, job);
    ASSERT_TRUE(out);
    const auto back = import_bytes(out->bytes, f == &csv_format() ? "b.csv" : "b.tbl", {}, job);
    ASSERT_TRUE(back) << to_text(back.error()) << out->bytes;
    for (const auto& i : back->library.items)
      EXPECT_FALSE(number_of(i, "DC") == 6.0 && number_of(i, "TP")) << out->bytes;
    LossReport report;
    const auto cutters = cutters_of(back->library, report, job);
    ASSERT_TRUE(cutters);
    for (const Cutter& c : *cutters) EXPECT_NE(c.cutting_diameter_mm, 6.0) << c.id;
  }
}

TEST(Unsaid, AnglesAndRadiiComeFromWordsOrTheToolIsLeftOut) {
  constexpr double kDeg = std::numbers::pi / 180.0;
  Job job;
  auto c = of_table(
      "T1 P1 D10 ;30 Deg. V-Bit\nT2 P2 D6 ;6 mm bull nose R1.5\nT3 P3 D12 ;90 deg chamfer mill\n", job);
  ASSERT_EQ(c.size(), 3u) << told(job);
  EXPECT_NEAR(c[0].point_angle_rad, 30 * kDeg, 1e-12);
  EXPECT_EQ(c[0].tip_diameter_mm, 0.0);
  EXPECT_EQ(c[1].corner_radius_mm, 1.5);
  EXPECT_NEAR(c[2].point_angle_rad, 90 * kDeg, 1e-12);
  c = of_table("T1 P1 D8 ;generic 8 mm carbide bull-nose end mill, 4 flutes, corner 0.1 mm\n", job);
  ASSERT_EQ(c.size(), 1u) << told(job);
  EXPECT_EQ(c[0].corner_radius_mm, 0.1);
  for (const char* line : {"T1 P1 D6 ;6 mm bull nose", "T1 P1 D10 ;v-bit", "T1 P1 D10 ;countersink",
                           "T1 P1 D10 ;45 deg chamfer mill", "T1 P1 D6 ;tapered end mill"}) {
    Job quiet;
    EXPECT_TRUE(of_table(line, quiet).empty()) << line;
    EXPECT_THAT(told(quiet), HasSubstr("without")) << line;
  }
}

TEST(Unsaid, AToolTableCarriesSizesInItsComments) {
  Job job;
  const auto lib = import_bytes(
      "capstan_tools: 1\nunit: mm\ntools:\n"
      "  - {id: a, class: bullnose_endmill, cutting_diameter: 6, corner_radius: 1.5}\n"
      "  - {id: b, class: chamfer_mill, cutting_diameter: 10, point_angle_deg: 30, tip_diameter: 0.5}\n"
      "  - {id: c, class: tap, cutting_diameter: 6.35, thread_pitch: 1.27}\n",
      "own.yaml", {}, job);
  ASSERT_TRUE(lib) << to_text(lib.error());
  for (const double unit : {1.0, 25.4}) {
    FormatOptions o;
    o.mm_per_unit = unit;
    const auto out = linuxcnc_format().write(lib->library, o, job);
    ASSERT_TRUE(out);
    LibraryOptions read;
    read.mm_per_unit = unit;
    const auto c = read_tool_table(out->bytes, "b.tbl", job, read);
    ASSERT_TRUE(c) << to_text(c.error());
    ASSERT_EQ(c->size(), 3u) << out->bytes << told(job);
    EXPECT_NEAR(c->at(0).corner_radius_mm, 1.5, 1e-4);
    EXPECT_NEAR(c->at(1).point_angle_rad, std::numbers::pi / 6.0, 1e-6);
    EXPECT_NEAR(c->at(1).tip_diameter_mm, 0.5, 1e-4);
    EXPECT_NEAR(c->at(2).thread_pitch_mm, 1.27, 1e-4);
  }
}

TEST(Unsaid, ANumberOfACatalogueIsNoPlaceInTheMagazine) {
  Job job;
  const auto fusion = read_library(
      R"({"data": [{"type": "flat end mill", "unit": "millimeters", "guid": "a",
          "geometry": {"DC": 6, "LCF": 12, "NOF": 3}, "post-process": {"number": 7}}], "version": 1})",
      "lib.json", job);
  ASSERT_TRUE(fusion) << to_text(fusion.error());
  ASSERT_EQ(fusion->size(), 1u);
  EXPECT_EQ(fusion->at(0).pocket, 7);  // preferred
  EXPECT_FALSE(fusion->at(0).loaded);
  const auto table = of_table("T4 D6 ;6 mm end mill\n", job);
  ASSERT_EQ(table.size(), 1u);
  EXPECT_TRUE(table[0].loaded);
  const auto own = read_own_list(
      "capstan_tools: 1\nunit: mm\ntools:\n  - {id: a, class: endmill, cutting_diameter: 6, pocket: 2}\n"
      "  - {id: b, class: endmill, cutting_diameter: 8, pocket: 3, loaded: false}\n",
      "own.yaml", job);
  ASSERT_TRUE(own) << to_text(own.error());
  EXPECT_TRUE(own->at(0).loaded);
  EXPECT_FALSE(own->at(1).loaded);
  // Written and read again it is still not loaded.
  const auto again = own_format().write(library_of(*own, "own"), {}, job);
  ASSERT_TRUE(again);
  const auto back = read_own_list(again->bytes, "b.yaml", job);
  ASSERT_TRUE(back) << to_text(back.error());
  EXPECT_TRUE(back->at(0).loaded);
  EXPECT_FALSE(back->at(1).loaded);
}

TEST(Unlikely, AMillimetreToolReadAsInchesIsWarnedOf) {
  Job job;
  LibraryOptions inch;
  inch.mm_per_unit = 25.4;
  ASSERT_TRUE(read_tool_table("T1 P1 D6 ;end mill\nT2 P2 D6 ;face mill\n", "a.tbl", job, inch));
  EXPECT_THAT(told(job), HasSubstr("TOOL-UNLIKELY: 'end mill': a diameter of 152.4 mm"));
  EXPECT_THAT(told(job), ::testing::Not(HasSubstr("'face mill': a diameter")));
}

TEST(Unlikely, AFractionBesideTheSameNumberSaysInches) {
  Job job;
  const auto refused = read_tool_table("T1 P1 D+0.25 ;1/4 end mill\n", "a.tbl", job);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "TBL-UNIT");
  LibraryOptions inch;
  inch.mm_per_unit = 25.4;
  const auto read = read_tool_table("T1 P1 D+0.25 ;1/4 end mill\n", "a.tbl", job, inch);
  ASSERT_TRUE(read);
  EXPECT_DOUBLE_EQ(read->at(0).cutting_diameter_mm, 6.35);
}

TEST(Unlikely, MillimetresBesideTheSameSizeInInchesSayInches) {
  Job job;
  const auto refused =
      read_tool_table("T1 P1 Z4.0157 D+0.3937 ;generic 10 mm carbide end mill\n", "a.tbl", job);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "TBL-UNIT");
  EXPECT_THAT(to_text(refused.error()), HasSubstr("capstan tools import a.tbl --unit inch -o tools.yaml"));
  LibraryOptions inch;
  inch.mm_per_unit = 25.4;
  const auto read = read_tool_table("T1 P1 D+0.3937 ;generic 10 mm carbide end mill\n", "a.tbl", job, inch);
  ASSERT_TRUE(read);
  EXPECT_NEAR(read->at(0).cutting_diameter_mm, 10.0, 1e-3);
  // A worn mill, and one whose comment speaks of something else, are in mm.
  ASSERT_TRUE(
      read_tool_table("T1 P1 D+7.98 ;8 mm end mill\nT2 P2 D+0.5 ;end mill, 6 mm shank\n", "a.tbl", job));
}

TEST(Unlikely, TwoColumnsOfDiametersAreRefused) {
  Job job;
  const auto r = import_bytes("id,class,diameter,DC\na,endmill,6,8\n", "t.csv", {}, job);
  ASSERT_FALSE(r);
  EXPECT_EQ(r.error().code, "DATA-DUPLICATE");
}

TEST(Unlikely, AnArchiveOfTwoLibrariesIsRefused) {
  const std::string one = R"({"data": [{"type": "drill", "unit": "millimeters", "guid": "a",
      "geometry": {"DC": 5, "NOF": 2}}], "version": 1})";
  Job job;
  const auto two = write_zip({{"tools.json", one}, {"more.json", one}});
  ASSERT_TRUE(two);
  EXPECT_FALSE(import_bytes(*two, "a.tools", {}, job));
  const auto single = write_zip({{"tools.json", one}});
  ASSERT_TRUE(single);
  EXPECT_TRUE(import_bytes(*single, "a.tools", {}, job));
}

TEST(Unlikely, ANumberGivenTwiceIsWrittenOnceToFreecad) {
  ToolLibrary l;
  for (const char* id : {"a", "b"}) {
    CatalogueItem i;
    i.id = i.description = id;
    i.cutter_class = CutterClass::kEndmill;
    i.properties = {number_property("DC", 6, "mm", ValueState::kStated, "")};
    l.items.push_back(i);
    ToolAssembly a;
    a.id = a.item = id;
    l.assemblies.push_back(a);
    MachineEntry e;
    e.number = 1;
    e.assembly = id;
    l.entries.push_back(e);
  }
  Job job;
  const auto out = freecad_format().write(l, {}, job);
  ASSERT_TRUE(out) << to_text(out.error());
  EXPECT_THAT(::testing::PrintToString(out->report.dropped.size()), ::testing::Not("0"));
  const auto back = import_bytes(out->bytes, "b.zip", {}, job);
  ASSERT_TRUE(back) << to_text(back.error());
  EXPECT_EQ(back->library.items.size(), 2u);
}

TEST(Unlikely, AProbeMayHaveNoTeeth) {
  Job job;
  const std::string head =
      "capstan_tools: 1\nunit: mm\ntools:\n  - {id: a, cutting_diameter: 6, teeth: 0, class: ";
  const auto probe = import_bytes(head + "touch_probe}\n", "own.yaml", {}, job);
  ASSERT_TRUE(probe) << to_text(probe.error());
  EXPECT_FALSE(import_bytes(head + "endmill}\n", "own.yaml", {}, job));
}

}  // namespace
}  // namespace capstan::tooling
