#include <gmock/gmock.h>

#include <numbers>

#include "tests/support/corpus.h"
#include "tooling/library/formats/all.h"
#include "tooling/library/formats/import.h"
#include "tooling/library/formats/values.h"

// Tools in the XML of hyperMILL, SolidCAM, and a maker's catalogue page.

namespace capstan::tooling {
namespace {

using model::CutterClass;
using ::testing::Contains;
using ::testing::Field;
using ::testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180.0;

Imported corpus(const std::string& path, Job& job) {
  auto r = import_library(path, {}, job);
  EXPECT_TRUE(r) << to_text(r.error());
  return r ? *std::move(r) : Imported{};
}

TEST(HyperMill, ReadsSizesAndStartValues) {
  CAPSTAN_CORPUS_FILE(path, "tools/din4000/15506610.xml");
  Job job;
  const Imported r = corpus(path, job);
  ASSERT_EQ(r.library.items.size(), 1U);
  const CatalogueItem& i = r.library.items.front();
  EXPECT_EQ(i.id, "15506610");
  EXPECT_EQ(i.manufacturer, "FRAISA");
  EXPECT_EQ(number_of(i, "DC"), 16.0);
  EXPECT_EQ(number_of(i, "APMX"), 48.0);
  EXPECT_EQ(number_of(i, "OAL"), 108.0);
  EXPECT_EQ(number_of(i, "RE"), 0.2);
  EXPECT_EQ(number_of(i, "ZEFF"), 3.0);
  EXPECT_EQ(i.cutter_class, CutterClass::kBullnoseEndmill);
  ASSERT_EQ(i.presets.size(), 1U);
  EXPECT_EQ(i.presets.front().vc_m_min, 500.0);
  EXPECT_EQ(i.presets.front().fz_mm, 0.3);
  EXPECT_EQ(i.presets.front().stepover_mm, 4.8);
  EXPECT_EQ(i.presets.front().stepdown_mm, 48.0);
}

TEST(HyperMill, ARadiusOfNearlyNothingIsASharpCorner) {
  CAPSTAN_CORPUS_FILE(path, "tools/din4000/P15250501.xml");
  Job job;
  const Imported r = corpus(path, job);
  const CatalogueItem& i = r.library.items.front();
  EXPECT_EQ(number_of(i, "DC"), 12.0);
  EXPECT_EQ(number_of(i, "ZEFF"), 7.0);
  EXPECT_EQ(i.presets.front().fz_mm, 0.051);
  EXPECT_EQ(i.cutter_class, CutterClass::kEndmill);  // cornerRadius 1e-05
  EXPECT_THAT(r.report.dropped, Contains(Field(&LossReport::Line::field, "RE")));
}

TEST(HyperMill, ReadsToolsInFoldersOfFolders) {
  CAPSTAN_CORPUS_FILE(path, "tools/iso13399/hypermill.xml");
  Job job;
  const Imported r = corpus(path, job);
  ASSERT_EQ(r.library.items.size(), 1U);
  const CatalogueItem& i = r.library.items.front();
  EXPECT_EQ(i.id, "6676918");
  EXPECT_EQ(number_of(i, "DC"), 6.35);
  EXPECT_EQ(number_of(i, "APMX"), 19.05);
  EXPECT_EQ(number_of(i, "OAL"), 63.5);
  EXPECT_EQ(find(i.properties, "HAND")->text, "R");
  EXPECT_TRUE(i.presets.empty());  // all zero: none given
}

TEST(SolidCam, ReadsSizesAndHowFarTheToolStandsOut) {
  CAPSTAN_CORPUS_FILE(path, "tools/iso13399/solidcam.xml");
  Job job;
  const Imported r = corpus(path, job);
  ASSERT_EQ(r.library.items.size(), 1U);
  const CatalogueItem& i = r.library.items.front();
  EXPECT_EQ(i.id, "6676918");
  EXPECT_EQ(number_of(i, "DC"), 6.35);
  EXPECT_EQ(number_of(i, "APMX"), 19.05);
  EXPECT_EQ(number_of(i, "ZEFF"), 4.0);
  EXPECT_NEAR(*number_of(i, "FHA"), 36.0 * kDegree, 1e-12);
  EXPECT_EQ(find(i.properties, "CSP")->text, "true");
  EXPECT_EQ(number_of(i, "DN"), std::nullopt);  // a shoulder of the cutting diameter is none
  ASSERT_EQ(r.library.assemblies.size(), 1U);
  EXPECT_EQ(r.library.assemblies.front().stick_out_mm, 24.13);
}

TEST(CatalogueFamily, ReadsEverySizeOfALargePage) {
  CAPSTAN_CORPUS_FILE(path, "tools/din4000/EN_1000.xml");
  Job job;
  const Imported r = corpus(path, job);
  // 86 Parameters elements
  EXPECT_EQ(r.library.items.size(), 86U);
  EXPECT_EQ(r.library.name, "HM90 E90A-10");
  const CatalogueItem& i = r.library.items.front();
  EXPECT_EQ(i.id, "E90A-D10-1-C10");
  EXPECT_EQ(number_of(i, "DC"), 10.0);
  EXPECT_EQ(number_of(i, "APMX"), 9.8);
  EXPECT_EQ(number_of(i, "OAL"), 80.0);
  EXPECT_EQ(number_of(i, "LH"), 20.0);
  EXPECT_EQ(number_of(i, "LU"), 13.8);
  EXPECT_EQ(number_of(i, "ZEFF"), 1.0);
  EXPECT_NEAR(*number_of(i, "RMPX"), 5.0 * kDegree, 1e-12);
  EXPECT_EQ(i.cutter_class, CutterClass::kEndmill);
  EXPECT_EQ(number_of(r.library.items.back(), "RPMX"), 28492.0);
  EXPECT_EQ(number_of(r.library.items.back(), "WT"), 0.94);  // under a picture of a weight
  // The page names no unit: said, not hidden.
  EXPECT_THAT(r.report.derived, Contains(Field(&LossReport::Line::field, "unit")));
  EXPECT_EQ(job.count(Severity::kNote), 1U);
}

TEST(CatalogueFamily, TheUnitCanBeTold) {
  Job job;
  const auto r = import_bytes(
      "<FamilyDetails><FamilyInfo><FamilyDesc>Endmills</FamilyDesc></FamilyInfo><Parameters>"
      "<Designation>x</Designation><DC_x0020__x003C_br_x003E_>0.5~</DC_x0020__x003C_br_x003E_>"
      "<OAL>-</OAL></Parameters></FamilyDetails>",
      "a.xml", {.mm_per_unit = 25.4, .column_map = {}}, job);
  ASSERT_TRUE(r) << to_text(r.error());
  const CatalogueItem& i = r->library.items.front();
  EXPECT_DOUBLE_EQ(*number_of(i, "DC"), 12.7);
  EXPECT_TRUE(i.inches);
  EXPECT_EQ(number_of(i, "OAL"), std::nullopt);  // a dash: not given
  EXPECT_EQ(job.count(Severity::kNote), 0U);
}

struct Bad {
  const char* name;
  std::string text;
  const char* code;
};
void PrintTo(const Bad& b, std::ostream* os) { *os << b.name; }
std::string hyper(std::string_view params) {
  return "<omtdx><tools><tool type=\"endMill\" name=\"n\">" + std::string(params) + "</tool></tools></omtdx>";
}
std::string solid(std::string_view params) {
  return "<Results><Tools><Tool Type=\"Milling\" SubType=\"EndMill\" UserType=\"n\">" + std::string(params) +
         "</Tool></Tools></Results>";
}
std::string param(std::string_view name, std::string_view value) {
  return "<param name=\"" + std::string(name) + "\" value=\"" + std::string(value) + "\"/>";
}

class CamXmlRefuses : public ::testing::TestWithParam<Bad> {};
TEST_P(CamXmlRefuses, WithOneClearError) {
  Job job;
  const auto r = import_bytes(GetParam().text, "a.xml", {}, job);
  ASSERT_FALSE(r);
  EXPECT_EQ(r.error().code, GetParam().code) << to_text(r.error());
}
INSTANTIATE_TEST_SUITE_P(
    Files, CamXmlRefuses,
    ::testing::Values(
        Bad{"hyperMILL: no unit", hyper(param("toolDiameter", "6")), "DATA-UNIT"},
        Bad{"hyperMILL: unknown unit", hyper(param("lengthOfUnit", "ell") + param("toolDiameter", "6")),
            "DATA-UNIT"},
        Bad{"hyperMILL: no diameter", hyper(param("lengthOfUnit", "mm")), "HYPERMILL-VALUE"},
        Bad{"hyperMILL: zero diameter", hyper(param("lengthOfUnit", "mm") + param("toolDiameter", "0")),
            "HYPERMILL-VALUE"},
        Bad{"hyperMILL: negative", hyper(param("lengthOfUnit", "mm") + param("toolDiameter", "-6")),
            "TOOL-VALUE"},
        Bad{"hyperMILL: flutes too long",
            hyper(param("lengthOfUnit", "mm") + param("toolDiameter", "6") + param("cuttingLength", "60") +
                  param("toolTotalLength", "50")),
            "HYPERMILL-VALUE"},
        Bad{"hyperMILL: no tool", "<omtdx><tools/></omtdx>", "HYPERMILL-VALUE"},
        Bad{"SolidCAM: no unit", solid(param("diameter", "6")), "DATA-UNIT"},
        Bad{"SolidCAM: decimal comma", solid(param("unit", "metric") + param("diameter", "6,5")),
            "DATA-NUMBER"},
        Bad{"SolidCAM: NaN", solid(param("unit", "metric") + param("diameter", "nan")), "DATA-NUMBER"},
        Bad{"SolidCAM: 3.9 teeth",
            solid(param("unit", "metric") + param("diameter", "6") + param("number of teeth", "3.9")),
            "TOOL-VALUE"},
        Bad{"family: no sizes", "<FamilyDetails><FamilyInfo/></FamilyDetails>", "CATALOGUE-VALUE"},
        Bad{"family: text for a number",
            "<FamilyDetails><Parameters><Designation>x</Designation><DC>ten</DC></Parameters></"
            "FamilyDetails>",
            "DATA-NUMBER"}));

CatalogueItem hyper_of(const std::string& type, const std::string& params, LossReport* report = nullptr) {
  Job job;
  const std::string common = param("lengthOfUnit", "mm") + param("toolDiameter", "10") +
                             param("toolTotalLength", "80") + param("cuttingEdges", "2") +
                             param("toolShaftDiameter", "8");
  const auto r = import_bytes(
      "<omtdx><tools><tool type=\"" + type + "\" name=\"n\">" + common + params + "</tool></tools></omtdx>",
      "a.xml", {}, job);
  EXPECT_TRUE(r) << to_text(r.error());
  if (!r) return {};
  if (report != nullptr) *report = r->report;
  return r->library.items.front();
}

TEST(HyperMill, ABallMillHasHalfItsDiameterForRadius) {
  const CatalogueItem ball = hyper_of("ballMill", param("cuttingLength", "12"));
  EXPECT_EQ(ball.cutter_class, CutterClass::kBallEndmill);
  EXPECT_EQ(number_of(ball, "RE"), 5.0);
  EXPECT_EQ(hyper_of("ballMill", param("cornerRadius", "5")).cutter_class, CutterClass::kBallEndmill);
  // Of another radius it is no ball: not guessed what it is.
  LossReport report;
  const CatalogueItem odd = hyper_of("ballMill", param("cornerRadius", "4"), &report);
  EXPECT_EQ(odd.cutter_class, std::nullopt);
  EXPECT_THAT(report.dropped, Contains(Field(&LossReport::Line::what, HasSubstr("radius of 4 mm"))));
}

TEST(HyperMill, ARadiusMillIsABullnoseAndStatesItsRadius) {
  const CatalogueItem mill = hyper_of("radiusMill", param("cornerRadius", "2"));
  EXPECT_EQ(mill.cutter_class, CutterClass::kBullnoseEndmill);
  EXPECT_EQ(number_of(mill, "RE"), 2.0);
  EXPECT_EQ(hyper_of("radiusMill", param("cornerRadius", "5")).cutter_class, CutterClass::kBallEndmill);
  for (const char* radius : {"0", "0.00001"}) {
    LossReport report;
    EXPECT_EQ(hyper_of("radiusMill", param("cornerRadius", radius), &report).cutter_class, std::nullopt);
    EXPECT_THAT(report.dropped,
                Contains(Field(&LossReport::Line::what, HasSubstr("without a corner radius"))));
  }
}

TEST(HyperMill, ATSlotCutterIsAsWideAsItsCuttingLengthUnlessTheDiscSaysOtherwise) {
  // Public importers fold the letters differently: tslotcutter, Tslotcutter.
  for (const char* type : {"tslotcutter", "Tslotcutter"}) {
    const CatalogueItem slot = hyper_of(type, param("cuttingLength", "4") + param("discHeight", "0"));
    EXPECT_EQ(slot.cutter_class, CutterClass::kTSlotMill) << type;
    EXPECT_EQ(number_of(slot, "APMX"), 4.0);
  }
  EXPECT_EQ(hyper_of("tslotcutter", param("cuttingLength", "4") + param("discHeight", "4")).cutter_class,
            CutterClass::kTSlotMill);
  LossReport report;
  const auto two = hyper_of("tslotcutter", param("cuttingLength", "4") + param("discHeight", "3"), &report);
  EXPECT_EQ(two.cutter_class, std::nullopt);
  EXPECT_THAT(report.dropped, Contains(Field(&LossReport::Line::what, HasSubstr("discHeight 3"))));
  EXPECT_EQ(hyper_of("tslotcutter", "").cutter_class, std::nullopt);  // of no height
}

TEST(HyperMill, ATaperedToolIsNoCylinder) {
  for (const char* type : {"endMill", "ballMill", "radiusMill"}) {
    LossReport report;
    const CatalogueItem cone = hyper_of(
        type, param("cornerRadius", "5") + param("tapered", "1") + param("taperAngle", "3"), &report);
    EXPECT_EQ(cone.cutter_class, std::nullopt) << type;
    EXPECT_THAT(report.dropped, Contains(Field(&LossReport::Line::what, HasSubstr("tapered"))));
  }
  // Its angle alone says so, too, whatever stands beside it.
  for (const char* tapered : {"", "0"}) {
    for (const char* angle : {"3", "-0.5", "3 deg"}) {
      LossReport report;
      const CatalogueItem cone =
          hyper_of("endMill", param("tapered", tapered) + param("taperAngle", angle), &report);
      EXPECT_EQ(cone.cutter_class, std::nullopt) << angle;
      EXPECT_THAT(report.dropped,
                  Contains(Field(&LossReport::Line::what, HasSubstr("taperAngle is " + std::string(angle)))));
    }
  }
  for (const char* angle : {"", "0", "0.0"})
    EXPECT_EQ(hyper_of("endMill", param("taperAngle", angle)).cutter_class, CutterClass::kEndmill) << angle;
}

TEST(HyperMill, ATypeThatNoSourceConfirmsIsReadAndNotPlannedWith) {
  for (const char* type : {"lollipop", "woodruff", "conicalBarrelTool", "drilTool"}) {
    LossReport report;
    const CatalogueItem other = hyper_of(type, "", &report);
    EXPECT_EQ(number_of(other, "DC"), 10.0);
    EXPECT_EQ(other.cutter_class, std::nullopt) << type;
    EXPECT_THAT(report.dropped, Contains(Field(&LossReport::Line::what, HasSubstr(type))));
  }
}

TEST(CamXml, InchesSurvive) {
  Job job;
  const auto r =
      import_bytes(hyper(param("lengthOfUnit", "inch") + param("toolDiameter", "0.5")), "a.xml", {}, job);
  ASSERT_TRUE(r) << to_text(r.error());
  EXPECT_TRUE(r->library.items.front().inches);
  EXPECT_DOUBLE_EQ(*number_of(r->library.items.front(), "DC"), 12.7);
}

}  // namespace
}  // namespace capstan::tooling
