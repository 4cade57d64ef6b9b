#include "tooling/catalogue/material.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/support/corpus.h"

namespace capstan::tooling {
namespace {

const std::vector<model::WorkMaterial>& table() {
  static const std::vector<model::WorkMaterial> kTable = shipped_materials().value();
  return kTable;
}

std::string id_of(const std::vector<std::string>& texts, Job& job) {
  return find_material(texts, table(), job).value().id;
}

struct Named {
  const char* text;
  const char* id;
};
void PrintTo(const Named& n, std::ostream* out) { *out << n.text; }

class KnownNames : public ::testing::TestWithParam<Named> {};

TEST_P(KnownNames, AreFoundWithoutAWarning) {
  Job job;
  EXPECT_EQ(id_of({GetParam().text}, job), GetParam().id);
  EXPECT_EQ(job.count(Severity::kWarning), 0u);
}

INSTANTIATE_TEST_SUITE_P(
    Materials, KnownNames,
    ::testing::Values(Named{"ST-50", "low_alloy_steel"}, Named{"St 50-2", "low_alloy_steel"},
                      Named{"SAE 1020", "mild_steel"}, Named{"SAE 1015", "mild_steel"},
                      Named{"ACO SEM LIGA", "low_alloy_steel"}, Named{"EN AW-6061", "wrought_aluminium"},
                      Named{"EN AW-6061-T6", "wrought_aluminium"}, Named{"en aw 7075", "wrought_aluminium"},
                      Named{"AISI 304", "austenitic_stainless_steel"}, Named{"mild_steel", "mild_steel"}));

TEST(FindMaterial, PrefersTheFirstTextThatSaysSomething) {
  Job job;
  EXPECT_EQ(id_of({"ST-50", "STEEL"}, job), "low_alloy_steel");
  EXPECT_EQ(id_of({"id", "SAE 1015"}, job), "mild_steel");
  EXPECT_EQ(job.count(Severity::kWarning), 0u);
}

TEST(FindMaterial, TakesTheHardestOfAFamilyAndWarns) {
  Job job;
  EXPECT_EQ(id_of({"STEEL"}, job), "tool_steel");
  EXPECT_EQ(id_of({"aluminium"}, job), "cast_aluminium");
  EXPECT_EQ(job.count(Severity::kWarning), 2u);
  EXPECT_EQ(job.diagnostics()[0].code, "MATERIAL-FAMILY");
}

TEST(FindMaterial, RefusesAFamilyWhereAMaterialIsToBeNamed) {
  Job job;
  const auto m = find_material({"STEEL"}, table(), job, Families::kRefused);
  ASSERT_FALSE(m);
  EXPECT_EQ(m.error().code, "NAME-UNKNOWN");
  EXPECT_EQ(m.error().message, "'STEEL' names a family of materials, not a material");
  for (const char* name : {"'mild_steel'", "'low_alloy_steel'", "'tool_steel'"})
    EXPECT_NE(m.error().expected.find(name), std::string::npos) << m.error().expected;
  EXPECT_TRUE(find_material({"mild steel"}, table(), job, Families::kRefused));
}

TEST(FindMaterial, RefusesAnUnknownNameWithTheNearestOnes) {
  Job job;
  const auto m = find_material("steeel", table(), job);
  ASSERT_FALSE(m);
  EXPECT_EQ(m.error().code, "NAME-UNKNOWN");
  EXPECT_NE(m.error().message.find("unknown material 'steeel'. Did you mean 'mild_steel'"), std::string::npos)
      << m.error().message;
  EXPECT_NE(m.error().hint.find("capstan materials list"), std::string::npos);
  EXPECT_FALSE(find_material("unobtainium", table(), job));
}

TEST(FindMaterial, TakesTheHardestOfAllWhereNothingNamesOneAndSaysThatItIsADefault) {
  for (const std::vector<std::string>& nothing : {std::vector<std::string>{}, {"", " "}}) {
    Job job;
    const auto m = find_material(nothing, table(), job).value();
    for (const auto& other : table()) EXPECT_LE(other.kc11_n_mm2, m.kc11_n_mm2);
    ASSERT_EQ(job.diagnostics().size(), 1u);
    EXPECT_EQ(job.diagnostics()[0].code, "MATERIAL-DEFAULT");
  }
}

TEST(FindMaterial, DoesNotCutANumberInTwo) {
  Job job;
  EXPECT_FALSE(find_material("ST-500", table(), job));  // not ST-50
}

TEST(FindMaterial, KnowsCastIronsByTheirJapaneseNamesAndWhy) {
  Job job;
  // JIS G 5501: FC and the tensile strength; EN 1561 has the same iron as EN-GJL and that strength.
  for (const char* pair : {"200", "250"}) {
    const auto jis = find_material(std::string("FC") + pair, table(), job).value();
    EXPECT_EQ(jis.id, find_material(std::string("EN-GJL-") + pair, table(), job).value().id);
    EXPECT_NE(jis.sources.back().second.find("JIS G 5501"), std::string::npos) << jis.sources.back().second;
  }
  // JIS G 5502: FCD and the tensile strength; EN 1563 has the same iron as EN-GJS and that strength.
  const auto nodular = find_material("FCD450", table(), job).value();
  EXPECT_EQ(nodular.id, find_material("EN-GJS-450", table(), job).value().id);
  EXPECT_NE(nodular.sources.back().second.find("JIS G 5502"), std::string::npos);
  EXPECT_EQ(job.count(Severity::kWarning), 0u);
}

TEST(ShippedMaterials, NameASourceForEveryNumberAndEveryName) {
  for (const auto& m : table()) {
    std::set<std::string> told;
    for (const auto& [field, source] : m.sources) {
      EXPECT_FALSE(source.empty()) << m.id << " " << field;
      told.insert(field);
    }
    for (const char* field : {"kc11_n_mm2", "mc", "vc_hss_m_min", "vc_carbide_m_min", "kc_uncertainty"})
      EXPECT_EQ(told.count(field), 1u) << m.id << " " << field;
    for (const auto& name : m.names) EXPECT_EQ(told.count("name " + name), 1u) << m.id << " " << name;
  }
}

TEST(ShippedMaterials, AgreeWithTheCardsTheyAreFrom) {
  CAPSTAN_CORPUS_FILE(folder, "tools/cutting_data/");
  const std::pair<const char*, const char*> cards[] = {
      {"mild_steel", "MildSteel"},
      {"low_alloy_steel", "LowAlloySteel"},
      {"tool_steel", "ToolSteel"},
      {"austenitic_stainless_steel", "AusteniticStainlessSteel"},
      {"grey_cast_iron", "GrayCastIron"},
      {"malleable_cast_iron", "MalleableCastIron"},
      {"wrought_aluminium", "AluminumWroughtAlloy"},
      {"cast_aluminium", "AluminumCastAlloy"}};
  for (const auto& [id, card] : cards) {
    const std::string text = testing::slurp(folder + card + ".FCMat");
    const auto value = [&](const std::string& key) {
      const auto at = text.find("\n    " + key + ":");
      const auto first = text.find_first_of("0123456789", at);
      return at == std::string::npos ? -1.0 : std::stod(text.substr(first));
    };
    Job job;
    const auto m = find_material(id, table(), job).value();
    EXPECT_DOUBLE_EQ(m.kc11_n_mm2, value("UnitCuttingForce")) << id;
    EXPECT_DOUBLE_EQ(m.mc, value("ChipThicknessExponent")) << id;
    EXPECT_DOUBLE_EQ(m.vc_hss_m_min, value("SurfaceSpeedHSS")) << id;
    EXPECT_DOUBLE_EQ(m.vc_carbide_m_min, value("SurfaceSpeedCarbide")) << id;
  }
}

TEST(ReadMaterials, RefusesACoefficientAHundredTimesTooLarge) {
  Job job;
  const char* text = R"(capstan_materials: 1
kc_uncertainty: 0.3
materials:
  - {source: "x", id: a, iso_group: P, kc11_n_mm2: 229800, mc: 0.2, vc_hss_m_min: 25, vc_carbide_m_min: 70}
)";
  const auto got = read_materials(text, "m.yaml", job);
  ASSERT_FALSE(got);
  EXPECT_EQ(got.error().code, "MATERIAL-RANGE");
  EXPECT_EQ(got.error().line, 4u);
}

TEST(FindMaterial, KeepsTheMeasuredSetsOfTheAlloyNamedAndNoOthers) {
  Job job;
  const auto sets = [&](const char* name) { return find_material(name, table(), job).value().mechanistic; };
  // Chin. J. Mech. Eng. 2021, doi 10.1186/s10033-021-00536-9, table 5 [S].
  const auto al7075 = sets("EN AW-7075-T6");
  ASSERT_EQ(al7075.size(), 4u);
  EXPECT_EQ(al7075[0].ktc_n_mm2, 767.01);
  EXPECT_EQ(al7075[0].kae_n_mm, 0.7);
  EXPECT_EQ(al7075[3].substrate, "hss");
  // The uncertainty of the first reaches the largest published: 600 to 1319 is the spread of one alloy.
  EXPECT_NEAR(al7075[0].ktc_n_mm2 * (1.0 + al7075[0].uncertainty), 1319.41, 1.0);
  const auto al6061 = sets("6061-T6");
  ASSERT_EQ(al6061.size(), 2u);
  EXPECT_EQ(al6061[0].ktc_n_mm2, 631.0);
  EXPECT_EQ(al6061[1].ktc_n_mm2, 243.77);
  EXPECT_NEAR(al6061[1].ktc_n_mm2 * (1.0 + al6061[1].uncertainty), 631.0 * 1.72, 1.0);
  EXPECT_EQ(sets("EN AW-6082").size(), 1u);
  EXPECT_TRUE(sets("wrought aluminium").empty());  // only the family is known
  EXPECT_TRUE(sets("EN AW-5083").empty());
  EXPECT_TRUE(sets("aluminium").empty());
}

TEST(ShippedMaterials, StateNoLifeLawWithoutASource) {
  for (const auto& m : table()) {
    for (const auto& law : m.life) EXPECT_FALSE(law.source.empty()) << m.id;
    for (const auto& set : m.mechanistic) EXPECT_FALSE(set.source.empty()) << m.id;
  }
}

std::string with(const std::string& rows) {
  return R"(capstan_materials: 1
kc_uncertainty: 0.3
materials:
  - source: "x"
    id: a
    iso_group: P
    kc11_n_mm2: 2298
    mc: 0.2
    vc_hss_m_min: 25
    vc_carbide_m_min: 70
)" + rows;
}

TEST(ReadMaterials, ReadsSetsAndLawsOfLife) {
  Job job;
  const auto got = read_materials(
      with("    mechanistic:\n      - {substrate: hss, ktc_n_mm2: 900, krc_n_mm2: 300, uncertainty: 0.4}\n"
           "    life:\n      - {substrate: carbide, v0_m_min: 100, life_min: 20, n: 0.25, h0_mm: 0.5, p: 2.8,"
           " scatter: 0.2, source: \"y\"}\n"),
      "m.yaml", job);
  ASSERT_TRUE(got) << got.error().message;
  ASSERT_EQ((*got)[0].mechanistic.size(), 1u);
  EXPECT_EQ((*got)[0].mechanistic[0].kte_n_mm, 0.0);
  EXPECT_EQ((*got)[0].mechanistic[0].source, "x");
  ASSERT_EQ((*got)[0].life.size(), 1u);
  EXPECT_EQ((*got)[0].life[0].scatter, 0.2);
  EXPECT_EQ((*got)[0].life[0].source, "y");
  // A set that names no alloys holds for every name of the material.
  EXPECT_EQ(find_material("a", *got, job).value().mechanistic.size(), 1u);
}

TEST(ReadMaterials, RefusesSetsAndLawsThatCannotBe) {
  const auto code = [](const std::string& rows) {
    Job job;
    const auto got = read_materials(with(rows), "m.yaml", job);
    return got ? std::string("accepted") : got.error().code;
  };
  EXPECT_EQ(
      code("    mechanistic:\n      - {substrate: wood, ktc_n_mm2: 900, krc_n_mm2: 300, uncertainty: 0.4}\n"),
      "MATERIAL-SUBSTRATE");
  EXPECT_EQ(
      code("    mechanistic:\n      - {substrate: hss, ktc_n_mm2: 9, krc_n_mm2: 300, uncertainty: 0.4}\n"),
      "MATERIAL-RANGE");
  EXPECT_EQ(code("    mechanistic:\n      - {substrate: hss, ktc_n_mm2: 900, krc_n_mm2: 300}\n"),
            "DATA-MISSING");
  EXPECT_EQ(
      code("    mechanistic:\n      - {substrate: hss, ktc_n_mm2: .nan, krc_n_mm2: 3, uncertainty: 0}\n"),
      "DATA-NUMBER");
  EXPECT_EQ(code("    life:\n      - {substrate: hss, v0_m_min: 20, life_min: 30, n: 4}\n"),
            "MATERIAL-RANGE");
  EXPECT_EQ(code("    life:\n      - {substrate: hss, v0_m_min: 20, life_min: 30, n: 0.1, p: 2}\n"),
            "MATERIAL-RANGE");  // an influence without its reference
  EXPECT_EQ(code("    life:\n      - {substrate: hss, v0_m_min: 20, life_min: 30, n: 0.1, wear: 0.3}\n"),
            "DATA-UNKNOWN");
}

}  // namespace
}  // namespace capstan::tooling
