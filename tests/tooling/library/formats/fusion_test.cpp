#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <numbers>

#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "tests/support/corpus.h"
#include "tooling/library/cutters/check.h"
#include "tooling/library/formats/all.h"
#include "tooling/library/formats/fusion/keys.h"
#include "tooling/library/formats/import.h"
#include "tooling/library/formats/values.h"
#include "tooling/library/formats/zip.h"
#include "tooling/library/library.h"

namespace capstan::tooling {
namespace {

using model::CutterClass;

constexpr double kDegree = std::numbers::pi / 180.0;

/// Equal but for the spelling of numbers.
void expect_same(const Json& a, const Json& b, const std::string& path) {
  ASSERT_EQ(a.kind, b.kind) << path;
  if (a.kind == Json::Kind::kNumber) {
    const double x = *parse_double(a.text), y = *parse_double(b.text);
    EXPECT_NEAR(x, y, 1e-14 * std::abs(x)) << path;
  } else {
    EXPECT_EQ(a.text, b.text) << path;
  }
  ASSERT_EQ(a.items.size(), b.items.size()) << path;
  for (std::size_t k = 0; k < a.items.size(); ++k)
    expect_same(a.items[k], b.items[k], path + "[" + std::to_string(k) + "]");
  for (const auto& [key, value] : a.entries) {
    const Json* other = b.find(key);
    ASSERT_NE(other, nullptr) << path << "." << key;
    expect_same(value, *other, path + "." + key);
  }
  EXPECT_EQ(a.entries.size(), b.entries.size()) << path;
}

/// Holders that stand for themselves are moved behind the tools.
Json document(const std::string& bytes) {
  const std::string text = is_zip(bytes) ? read_zip(bytes, "doc").value().at(0).bytes : bytes;
  Json root = parse_json(text, "doc").value();
  for (auto& [key, value] : root.entries) {
    if (key == "data")
      std::stable_partition(value.items.begin(), value.items.end(),
                            [](const Json& t) { return t.text_of("type") != "holder"; });
  }
  return root;
}

TEST(Fusion, EveryLibraryOfTheCorpusComesBackFromWritingWithNothingLost) {
  CAPSTAN_CORPUS_FILE(folder, "tools/fusion/");
  int files = 0;
  for (const auto& f : std::filesystem::directory_iterator(folder)) {
    if (f.path().extension() == ".csv") continue;
    ++files;
    Job job;
    const std::string bytes = read_file(f.path().string()).value();
    const auto read = import_bytes(bytes, f.path().string(), {}, job);
    ASSERT_TRUE(read) << f.path() << to_text(read.error());
    EXPECT_TRUE(job.diagnostics().empty()) << to_text(job.diagnostics().front());
    const auto written = fusion_format().write(read->library, {}, job);
    ASSERT_TRUE(written) << to_text(written.error());
    expect_same(document(bytes), document(written->bytes), f.path().filename().string());
    EXPECT_THAT(written->report.dropped, ::testing::IsEmpty());
    // And the records come back as they were.
    const auto again = import_bytes(written->bytes, f.path().string(), {}, job).value();
    EXPECT_TRUE(again.library == read->library);
  }
  EXPECT_EQ(files, 6);
}

TEST(Fusion, ReadsWhatTheBallEndMillLibrarySays) {
  CAPSTAN_CORPUS_FILE(path, "tools/fusion/Makera_Ball_Endmills.tools");
  Job job;
  const auto read = import_library(path, {}, job).value();
  ASSERT_EQ(read.library.items.size(), 18u);
  const CatalogueItem& i = read.library.items[0];
  EXPECT_EQ(i.description, "Makera Metal - 1*3mm");
  EXPECT_EQ(i.cutter_class, CutterClass::kBallEndmill);
  EXPECT_EQ(i.id, "7df9f03d-55a3-459f-bf67-7f6d96834829");
  EXPECT_EQ(number_of(i, "DC"), 1.0);
  EXPECT_EQ(number_of(i, "LCF"), 3.0);
  EXPECT_EQ(number_of(i, "OAL"), 38.0);
  EXPECT_EQ(find(i.properties, "DMM")->text, "3.175");
  EXPECT_EQ(number_of(i, "ZEFF"), 2.0);
  EXPECT_EQ(find(i.properties, "BMC")->text, "carbide");
  EXPECT_EQ(number_of(i, "LU"), 3.0);  // the shank is thicker than the cut
  ASSERT_FALSE(i.presets.empty());
  EXPECT_EQ(i.presets[0].name, "Aluminum");
  EXPECT_EQ(i.presets[0].rpm, 12000.0);
  EXPECT_EQ(i.presets[0].vc_m_min, 37.69911184307752);  // pi 1 mm 12000/min
  EXPECT_EQ(i.presets[0].feed_mm_min, 500.0);
  EXPECT_EQ(i.presets[0].plunge_mm_min, 200.0);
  EXPECT_EQ(i.presets[0].stepdown_mm, 0.2);
  EXPECT_NEAR(*i.presets[0].ramp_angle_rad, 1.6 * kDegree, 1e-15);
  EXPECT_EQ(i.presets[0].coolant, "disabled");
  EXPECT_THAT(*find_kept(i.kept, "expressions"), ::testing::HasSubstr("\"tool_bodyLength\""));
  // Every tool repeats its holder; three differ, in when they were changed and what they are called within.
  ASSERT_EQ(read.library.holders.size(), 3u);
  for (const Holder& o : read.library.holders) EXPECT_EQ(o.segments, read.library.holders[0].segments);
  const Holder& h = read.library.holders[0];
  EXPECT_EQ(h.description, "Carvera ToolHolder");
  EXPECT_EQ(h.gage_length_mm, 6.5);
  ASSERT_EQ(h.segments.size(), 3u);
  EXPECT_EQ(h.segments[1], (model::HolderSegment{0.5, 9.0, 10.0}));
  EXPECT_EQ(read.library.assemblies[0].stick_out_mm, 19.0);
  EXPECT_EQ(read.library.assemblies[0].functional_length_mm, 25.5);
}

TEST(Fusion, MakesCuttersThatPlanningTakes) {
  CAPSTAN_CORPUS_FILE(path, "tools/fusion/Makera_Drill_Bits.tools");
  Job job;
  const auto cutters = load_library(path, job).value();
  ASSERT_EQ(cutters.size(), 30u);
  const model::Cutter& d = cutters[0];
  EXPECT_EQ(d.cutter_class, CutterClass::kTwistDrill);
  EXPECT_EQ(d.cutting_diameter_mm, 0.2);
  EXPECT_EQ(d.maximum_depth_of_cut_mm, 3.5);
  EXPECT_EQ(d.stick_out_mm, 19.0);
  EXPECT_EQ(d.functional_length_mm, 25.5);
  EXPECT_NEAR(d.point_angle_rad, 118 * kDegree, 1e-12);
  EXPECT_EQ(d.substrate, model::Substrate::kCarbide);
  EXPECT_EQ(d.holder.size(), 3u);
  EXPECT_EQ(d.holder_diameter_mm, 16.6);
  ASSERT_FALSE(d.presets.empty());
  // Aluminum: 100 mm/min at 10000/min and two teeth.
  EXPECT_NEAR(d.presets[0].vc_m_min, 6.283185307179586, 1e-12);
  EXPECT_NEAR(d.presets[0].fz_mm, 0.005, 1e-12);
  for (const auto& c : cutters) EXPECT_TRUE(faults_of(c).empty()) << c.id;
}

TEST(Fusion, ReadsEachKindOfToolOfTheOtherLibrary) {
  CAPSTAN_CORPUS_FILE(path, "tools/fusion/timm052_Fusion_Tool_Library.json");
  Job job;
  const auto read = import_library(path, {}, job).value();
  EXPECT_EQ(read.library.items.size(), 29u);
  EXPECT_EQ(read.library.holders.size(), 2u);  // the tools' and one of its own
  const auto& items = read.library.items;
  const auto of = [&items](std::string_view kind) -> const CatalogueItem& {
    for (const auto& i : items)
      if (i.kind == kind) return i;
    throw std::logic_error("no such kind");
  };
  EXPECT_EQ(number_of(of("bull nose end mill"), "RE"), 0.75);
  EXPECT_NEAR(*number_of(of("tapered mill"), "TA"), 10 * kDegree, 1e-12);
  EXPECT_NEAR(*number_of(of("chamfer mill"), "SIG"), 90 * kDegree, 1e-12);
  EXPECT_EQ(number_of(of("counter sink"), "DCN"), 1.2);
  EXPECT_EQ(number_of(of("tap left hand"), "TP"), 1.0);
  EXPECT_EQ(find(of("tap left hand").properties, "HAND")->text, "left");
  EXPECT_FALSE(of("laser cutter").cutter_class);
  EXPECT_EQ(of("probe").cutter_class, CutterClass::kTouchProbe);
}

TEST(Fusion, ConvertsInchesAndFeetAndKeepsTheirSpelling) {
  Job job;
  const auto read = import_bytes(R"({"data": [{"type": "flat end mill", "unit": "inches", "guid": "a",
   "description": "q", "vendor": "v", "product-id": "", "product-link": "",
   "geometry": {"DC": 0.2500, "LCF": 0.75, "LB": 1.25, "NOF": 3, "HAND": true},
   "post-process": {"number": 0, "comment": ""},
   "start-values": {"presets": [{"name": "P", "n": 3820, "v_c": 250.0, "v_f": 22.9, "f_z": 0.002}]}}]})",
                                 "lib.json", {}, job)
                        .value();
  const CatalogueItem& i = read.library.items.at(0);
  EXPECT_TRUE(i.inches);
  EXPECT_DOUBLE_EQ(*number_of(i, "DC"), 6.35);
  EXPECT_EQ(find(i.properties, "DC")->text, "0.2500");
  EXPECT_DOUBLE_EQ(*i.presets.at(0).vc_m_min, 76.2);       // 250 ft/min
  EXPECT_DOUBLE_EQ(*i.presets.at(0).feed_mm_min, 581.66);  // 22.9 in/min
  const auto written = fusion_json_format().write(read.library, {}, job).value();
  EXPECT_THAT(written.bytes, ::testing::HasSubstr("\"DC\": 0.2500"));
  EXPECT_THAT(written.bytes, ::testing::HasSubstr("\"v_c\": 250"));
  EXPECT_THAT(written.bytes, ::testing::HasSubstr("\"v_f\": 22.9"));
}

TEST(Fusion, WritesACuttersLibraryAndNamesWhatItCannotHold) {
  model::Cutter mill;
  mill.id = "m";
  mill.cutting_diameter_mm = 6.0;
  mill.helix_rad = 0.5;
  mill.teeth = 3;
  model::Cutter back = mill;
  back.id = "b";
  back.cutter_class = CutterClass::kBackCounterbore;
  Job job;
  const auto out = fusion_json_format().write(library_of({mill, back}, "l"), {}, job).value();
  EXPECT_EQ(out.report.tools, 1u);
  std::string dropped;
  for (const auto& l : out.report.dropped) dropped += l.tool + ":" + l.field + ":" + l.what + "\n";
  EXPECT_THAT(dropped, ::testing::HasSubstr("m:FHA:"));
  EXPECT_THAT(dropped, ::testing::HasSubstr("b::Fusion has no kind of tool for 'back_counterbore'"));
}

TEST(Fusion, AnArchiveIsTheSameBytesEveryTime) {
  const std::vector<ZipEntry> one = {{"tools.json", "{}"}};
  EXPECT_EQ(write_zip(one).value(), write_zip(one).value());
  EXPECT_EQ(read_zip(write_zip(one).value(), "z").value().at(0).bytes, "{}");
}

TEST(Fusion, RefusesArchivesMadeToFillTheMemory) {
  const std::string zeros(std::size_t{64} << 20, '0');
  const std::string packed = write_zip({{"tools.json", zeros}}).value();
  EXPECT_LT(packed.size(), std::size_t{1} << 20);
  EXPECT_EQ(read_zip(packed, "bomb.tools").error().code, "ZIP-CAP");
  ZipCaps few;
  few.entries = 2;
  EXPECT_EQ(read_zip(write_zip({{"a", ""}, {"b", ""}, {"c", ""}}).value(), "z", nullptr, few).error().code,
            "ZIP-CAP");
  EXPECT_EQ(read_zip(packed.substr(0, packed.size() / 2), "half.tools").error().code, "ZIP-SYNTAX");
}

}  // namespace
}  // namespace capstan::tooling
