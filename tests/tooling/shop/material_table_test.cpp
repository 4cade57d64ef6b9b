#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/scratch.h"
#include "tooling/shop/material/material.h"

namespace capstan::tooling {
namespace {

const std::vector<model::WorkMaterial>& table() {
  static const std::vector<model::WorkMaterial> kTable = shipped_materials().value();
  return kTable;
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

TEST(ReadMaterials, PutsACitationInPlaceOfItsName) {
  Job job;
  const char* text = R"(capstan_materials: 1
kc_uncertainty: {value: 0.3, source: "@handbook p. 7"}
citations: {handbook: "Handbook, 3rd ed."}
materials:
  - {source: "@handbook, table 2", id: a, iso_group: P, kc11_n_mm2: 2298, mc: 0.2, vc_hss_m_min: 25, vc_carbide_m_min: 70}
)";
  const auto got = read_materials(text, "m.yaml", job);
  ASSERT_TRUE(got) << got.error().message;
  EXPECT_EQ((*got)[0].sources.front().second, "Handbook, 3rd ed., table 2");
  EXPECT_EQ((*got)[0].sources.back().second, "Handbook, 3rd ed. p. 7");
}

TEST(ReadMaterials, RefusesASourceThatIsTooLongBeforeItIsCopied) {
  const auto code = [](const std::string& text) {
    Job job;
    const auto got = read_materials(text, "m.yaml", job);
    return got ? std::string("accepted") : got.error().code + ": " + got.error().expected;
  };
  const auto table = [](const std::string& cited, const std::string& source) {
    return "capstan_materials: 1\nkc_uncertainty: 0.3\ncitations: {a: \"" + cited +
           "\"}\nmaterials:\n  - {source: \"" + source +
           "\", id: a, iso_group: P, kc11_n_mm2: 2298, mc: 0.2, vc_hss_m_min: 25, vc_carbide_m_min: 70}\n";
  };
  const std::string told = "DATA-SOURCE: at most 1000 bytes, its citations written out";
  EXPECT_EQ(code(table("short", "@a")), "accepted");
  EXPECT_EQ(code(table(std::string(1001, 'x'), "short")), told);
  EXPECT_EQ(code(table("short", std::string(1001, 'x'))), told);
  // 900 bytes meant twice are 1801.
  EXPECT_EQ(code(table(std::string(900, 'x'), "@a @a")), told);
  // And a table of more values than a table of materials has.
  std::string many = table("short", "x");
  many.insert(
      many.size() - 2, ", names: [{name: [a" + [] {
        std::string out;
        for (int i = 0; i < 20'000; ++i) out += ", n" + std::to_string(i);
        return out;
      }() + "]}]");
  EXPECT_EQ(code(many), "DATA-SIZE: at most 20000");
}

TEST(ReadMaterials, RefusesATableThatContradictsItself) {
  const auto refusal = [](const std::string& rows) {
    Job job;
    const auto got = read_materials(with(rows), "m.yaml", job);
    return got ? std::string("accepted") : got.error().code + ": " + got.error().message;
  };
  const std::string other =
      "  - {source: x, id: b, iso_group: P, kc11_n_mm2: 2000, mc: 0.2, vc_hss_m_min: 25, vc_carbide_m_min: "
      "70,"
      " names: [{name: [St 37]}]}\n";
  EXPECT_EQ(refusal("    names: [{name: [St 37]}]\n" + other),
            "DATA-DUPLICATE: the name 'St 37' is given to 'a' and to 'b'");
  EXPECT_EQ(refusal("    harder: [c]\n"),
            "DATA-UNKNOWN: 'c', said to be harder than 'a', is no material here");
  EXPECT_EQ(refusal("    hardness_hb: {value: 200, source: \"@nowhere\"}\n"),
            "DATA-SOURCE: '@nowhere' is no citation of this table");
  EXPECT_EQ(refusal("    hardness_hb: 9000\n").substr(0, 14), "MATERIAL-RANGE");
  EXPECT_EQ(refusal("    hardnes_hb: 200\n").substr(0, 12), "DATA-UNKNOWN");
}

TEST(LoadMaterial, TakesOneMaterialWithAnIdOfItsOwn) {
  const auto load = [&](const std::string& text) {
    const std::string path = capstan::testing::scratch_file("capstan_material_test.yaml");
    std::ofstream(path) << text;
    Job job;
    return load_material(path, table(), job);
  };
  EXPECT_EQ(load(with("")).value().id, "a");
  const std::string other =
      "  - {source: x, id: b, iso_group: P, kc11_n_mm2: 2000, mc: 0.2, vc_hss_m_min: 25, vc_carbide_m_min: "
      "70}\n";
  const auto two = load(with("") + other);
  ASSERT_FALSE(two);
  EXPECT_EQ(two.error().code, "MATERIAL-FILE");
  EXPECT_NE(two.error().message.find("holds 2 materials"), std::string::npos);
  std::string shipped = with("");
  shipped.replace(shipped.find("id: a"), 5, "id: C 45");
  EXPECT_EQ(load(shipped).error().code, "MATERIAL-FILE");
  std::string none = with("");
  none.erase(none.find("  - source"));
  EXPECT_FALSE(load(none));
  Job job;
  EXPECT_FALSE(load_material(capstan::testing::scratch_file("no_such_file.yaml"), table(), job));
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
  // Planning marks by that what cases correct, and leaves it out when it plans anew.
  EXPECT_EQ(
      code("    mechanistic:\n      - {substrate: hss, ktc_n_mm2: 900, krc_n_mm2: 300, uncertainty: 0.4, "
           "source: \"measured cases: ten of ours\"}\n"),
      "DATA-SOURCE");
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
