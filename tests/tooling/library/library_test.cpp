#include "tooling/library/library.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/corpus.h"
#include "tooling/library/cutters/check.h"
#include "tooling/library/cutters/complete.h"
#include "tooling/library/words/comment_words.h"

namespace capstan::tooling {
namespace {

using model::CutterClass;

std::string list(const std::string& tools, const std::string& unit = "mm") {
  return "capstan_tools: 1\nunit: " + unit + "\nsource: shop list\ntools:\n" + tools;
}

TEST(OwnList, KeepsWhatIsStatedAndSaysWhatIsNot) {
  Job job;
  const auto tools =
      read_library(list("  - {id: em6, class: endmill, cutting_diameter: 6, teeth: 4, stick_out: 25}\n"),
                   "shop.yaml", job);
  ASSERT_TRUE(tools) << to_text(tools.error());
  const model::Cutter& c = tools->at(0);
  EXPECT_DOUBLE_EQ(c.stick_out_mm, 25.0);
  EXPECT_EQ(*source_of(c, "stick_out_mm"), "stated: shop list");
  EXPECT_GT(c.maximum_depth_of_cut_mm, 0.0);
  EXPECT_TRUE(source_of(c, "maximum_depth_of_cut_mm")->starts_with("default: as generic/"));
  EXPECT_FALSE(c.centre_cutting);  // nobody said so
  EXPECT_GT(c.maximum_ramp_angle_rad, 0.0);
}

TEST(OwnList, ReadsInchesAndJson) {
  Job job;
  const auto tools = read_library(
      R"({"capstan_tools": 1, "unit": "inch", "tools": [{"id": "q", "class": "endmill", "cutting_diameter": 0.25}]})",
      "shop.json", job);
  ASSERT_TRUE(tools) << to_text(tools.error());
  EXPECT_DOUBLE_EQ(tools->at(0).cutting_diameter_mm, 6.35);
}

struct Bad {
  const char* name;
  std::string text;
  const char* code;
  unsigned line;
};
void PrintTo(const Bad& b, std::ostream* out) { *out << b.name; }

class HostileLibrary : public ::testing::TestWithParam<Bad> {};

TEST_P(HostileLibrary, GetsOneClearErrorWithItsPlace) {
  Job job;
  const auto tools = read_library(GetParam().text, "shop.yaml", job);
  ASSERT_FALSE(tools);
  EXPECT_EQ(tools.error().code, GetParam().code) << to_text(tools.error());
  EXPECT_EQ(tools.error().line, GetParam().line) << to_text(tools.error());
  EXPECT_EQ(tools.error().file, "shop.yaml");
  EXPECT_EQ(job.count(Severity::kError), 0u) << to_text(job.diagnostics().front());
}

std::string one(const std::string& fields) { return list("  - {id: a, class: endmill, " + fields + "}\n"); }

INSTANTIATE_TEST_SUITE_P(
    Tools, HostileLibrary,
    ::testing::Values(
        Bad{"zero diameter", one("cutting_diameter: 0"), "TOOL-VALUE", 5},
        Bad{"negative diameter", one("cutting_diameter: -6"), "TOOL-VALUE", 5},
        Bad{"3.9 flutes", one("cutting_diameter: 6, teeth: 3.9"), "DATA-NUMBER", 5},
        Bad{"300 flutes", one("cutting_diameter: 6, teeth: 300"), "TOOL-VALUE", 5},
        Bad{"minus one flute", one("cutting_diameter: 6, teeth: -1"), "TOOL-VALUE", 5},
        Bad{"not a number", one("cutting_diameter: nan"), "DATA-NUMBER", 5},
        Bad{"1e400", one("cutting_diameter: 1e400"), "DATA-NUMBER", 5},
        Bad{"decimal comma", one("cutting_diameter: \"6,35\""), "DATA-NUMBER", 5},
        Bad{"flutes longer than the tool",
            one("cutting_diameter: 6, maximum_depth_of_cut: 40, stick_out: 30"), "TOOL-VALUE", 5},
        Bad{"corner radius above the radius", one("cutting_diameter: 6, corner_radius: 4"), "TOOL-VALUE", 5},
        Bad{"duplicate key", one("cutting_diameter: 6, cutting_diameter: 8"), "DATA-DUPLICATE", 5},
        Bad{"unknown key", one("cutting_diameter: 6, flutes: 4"), "DATA-UNKNOWN", 5},
        Bad{"unknown class", list("  - {id: a, class: hammer, cutting_diameter: 6}\n"), "DATA-UNKNOWN", 5},
        Bad{"unit missing", "capstan_tools: 1\nunit: furlong\ntools: []\n", "DATA-UNIT", 2},
        Bad{"duplicate id",
            list("  - {id: a, class: endmill, cutting_diameter: 6}\n  - {id: a, class: endmill, "
                 "cutting_diameter: 8}\n"),
            "TOOL-ID", 6},
        Bad{"duplicate tool number",
            list("  - {id: a, class: endmill, cutting_diameter: 6, pocket: 3}\n"
                 "  - {id: b, class: endmill, cutting_diameter: 8, pocket: 3}\n"),
            "TOOL-NUMBER", 6},
        Bad{"something else", "hello: world\n", "LIBRARY-KIND", 0}));

TEST(OwnList, DoesNotDieOfAMillionLevels) {
  Job job;
  EXPECT_FALSE(read_library(std::string(1000000, '['), "deep.json", job));
}

TEST(ClassFromWords, UnderstandsTheCommentsPeopleWrite) {
  EXPECT_EQ(class_from_words("3mm end mill"), CutterClass::kEndmill);
  EXPECT_EQ(class_from_words("5mm tap drill"), CutterClass::kTwistDrill);
  EXPECT_EQ(class_from_words("16 mm schaftfr\xC3\xA4ser"), CutterClass::kEndmill);
  EXPECT_EQ(class_from_words("M6 tap"), CutterClass::kTap);
  EXPECT_EQ(class_from_words("6 BALL endmill"), CutterClass::kBallEndmill);
  EXPECT_EQ(class_from_words("90 deg spot drill"), CutterClass::kSpotDrill);
  EXPECT_FALSE(class_from_words("tool 6"));
  EXPECT_EQ(class_from_words("ball probe"), CutterClass::kTouchProbe);
}

TEST(ToolTable, ReadsSubstrateAndTeethOfACommentAndNoSizeForThem) {
  using model::Substrate;
  const auto of = [](const char* comment) { return words_of_comment(comment, CutterClass::kEndmill, 10.0); };
  EXPECT_EQ(of("HSS end mill 2 flutes").substrate, Substrate::kHss);
  EXPECT_EQ(of("HSS end mill 2 flutes").teeth, 2);
  EXPECT_EQ(of("VHM Schaftfr\xC3\xA4ser vierschneidig").substrate, Substrate::kCarbide);
  EXPECT_EQ(of("VHM Schaftfr\xC3\xA4ser vierschneidig").teeth, 4);
  EXPECT_EQ(of("HSS, carbide tipped").substrate, Substrate::kHss);
  for (const char* none : {"1/4 flat end mill", "6 flat end mill", "end mill 0.5 fl", "end mill z 20 mm",
                           "end mill 2 flutes or 4 flutes", "10 mm end mill"})
    EXPECT_EQ(of(none).teeth, 0) << none;
  EXPECT_FALSE(of("10 mm end mill").substrate);
  EXPECT_FALSE(of("10 mm end mill, crosshss").substrate);
}

TEST(ToolTable, UsesWhatItUnderstandsAndSaysWhatNot) {
  Job job;
  const auto tools = read_library(
      "; my tools\nT1 P1 D6.0 Z+80.5 ;6mm endmill, 4 flutes\nT2 P2 D10 Z0 ;10mm\nT3 P3 D0 ;\nT4 P4 D6 ;M6 "
      "tap\n",
      "tool.tbl", job);
  ASSERT_TRUE(tools) << to_text(tools.error());
  ASSERT_EQ(tools->size(), 2u);
  const model::Cutter& mill = tools->at(0);
  EXPECT_EQ(mill.pocket, 1);
  EXPECT_EQ(mill.teeth, 4);
  EXPECT_DOUBLE_EQ(mill.functional_length_mm, 80.5);
  EXPECT_TRUE(source_of(mill, "cutter_class")->starts_with("derived"));
  EXPECT_DOUBLE_EQ(tools->at(1).thread_pitch_mm, 1.0);
  EXPECT_EQ(job.count(Severity::kWarning), 3u);  // T2: no class; T3: no diameter; T4: no length
  EXPECT_EQ(job.count(Severity::kNote), 1u);     // the unit
}

TEST(ToolTable, ReadsInches) {
  Job job;
  LibraryOptions inch;
  inch.mm_per_unit = 25.4;
  const auto tools = read_library("T1 P1 D0.25 ;endmill\n", "tool.tbl", job, inch).value();
  EXPECT_DOUBLE_EQ(tools[0].cutting_diameter_mm, 6.35);
  ASSERT_EQ(job.diagnostics().size(), 1u);
  EXPECT_EQ(job.diagnostics()[0].code, "TOOL-OFFSET");  // it tells no length
}

TEST(ToolTable, RefusesNonsenseByLine) {
  Job job;
  const auto tools = read_library("T1 P1 D6 ;endmill\nT1 P2 D8 ;endmill\n", "tool.tbl", job);
  ASSERT_FALSE(tools);
  EXPECT_EQ(tools.error().code, "TOOL-NUMBER");
  EXPECT_EQ(tools.error().line, 2u);
  EXPECT_EQ(read_library("T1 P1 Dnan ;endmill\n", "tool.tbl", job).error().code, "TBL-SYNTAX");
  EXPECT_EQ(read_library("T1.5 P1 D6 ;endmill\n", "tool.tbl", job).error().code, "TOOL-NUMBER");
  EXPECT_EQ(read_library("T1 P1 D-6 ;endmill\n", "tool.tbl", job).error().code, "TOOL-VALUE");
}

TEST(ToolTable, ReadsTheTablesOfTheCorpus) {
  CAPSTAN_CORPUS_FILE(folder, "tools/linuxcnc/");
  const std::pair<const char*, std::size_t> tables[] = {{"configs_sim_axis_sim_mm.tbl", 4},  // the named ones
                                                        {"configs_sim_nstools.tbl", 0},      // no comments
                                                        {"tormach_shop_tool.tbl", 0}};       // no diameters
  for (const auto& [name, least] : tables) {
    Job job;
    const auto tools = load_library(folder + name, job);
    ASSERT_TRUE(tools) << name << ": " << to_text(tools.error());
    EXPECT_GE(tools->size(), least) << name;
    for (const auto& c : *tools) EXPECT_TRUE(faults_of(c).empty()) << name << c.id;
    EXPECT_FALSE(job.diagnostics().empty());
  }
}

TEST(FusionLibrary, ReadsSizesInEitherUnitAndLeavesOutWhatItCannotUse) {
  Job job;
  const auto tools = read_library(
      R"({"data": [
  {"type": "flat end mill", "unit": "inches", "guid": "a", "BMC": "carbide", "description": "quarter inch",
   "geometry": {"DC": 0.25, "LCF": 0.75, "LB": 1.25, "SFDM": 0.25, "NOF": 3, "HAND": true},
   "post-process": {"number": 7}},
  {"type": "drill", "unit": "millimeters", "guid": "b", "geometry": {"DC": 5, "SIG": 118, "NOF": 2}},
  {"type": "laser cutter", "unit": "millimeters", "guid": "c", "geometry": {"CW": 2}},
  {"type": "holder", "unit": "millimeters"}], "version": 1})",
      "lib.json", job);
  ASSERT_TRUE(tools) << to_text(tools.error());
  ASSERT_EQ(tools->size(), 2u);
  EXPECT_DOUBLE_EQ(tools->at(0).cutting_diameter_mm, 6.35);
  EXPECT_DOUBLE_EQ(tools->at(0).stick_out_mm, 31.75);
  EXPECT_EQ(tools->at(0).teeth, 3);
  EXPECT_EQ(tools->at(0).pocket, 7);
  EXPECT_NEAR(tools->at(1).point_angle_rad, 118.0 * std::numbers::pi / 180.0, 1e-12);
  EXPECT_EQ(job.count(Severity::kWarning), 1u);
}

TEST(FusionLibrary, ReadsTheOneOfTheCorpus) {
  CAPSTAN_CORPUS_FILE(path, "tools/fusion/timm052_Fusion_Tool_Library.json");
  Job job;
  const auto tools = load_library(path, job);
  ASSERT_TRUE(tools) << to_text(tools.error());
  EXPECT_GE(tools->size(), 15u);
  for (const auto& c : *tools) EXPECT_TRUE(faults_of(c).empty()) << c.id;
  EXPECT_EQ(job.count(Severity::kError), 0u);
}

}  // namespace
}  // namespace capstan::tooling
