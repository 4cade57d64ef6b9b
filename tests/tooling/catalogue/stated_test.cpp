#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tooling/catalogue/material.h"
#include "tooling/catalogue/stated_words.h"

// What a text says of a material beside its grade: hardness, strength, states of heat treatment.

namespace capstan::tooling {
namespace {

const std::vector<model::WorkMaterial>& table() {
  static const std::vector<model::WorkMaterial> kTable = shipped_materials().value();
  return kTable;
}

/// The hardest of a text; nothing: 0.
double brinell(std::string_view text) {
  double out = 0.0;
  for (const auto& h : stated_words(text).hardness) out = std::max(out, h.brinell);
  return out;
}

/// The card, or the code of the refusal.
std::string planned(const std::string& name, Job& job) {
  const auto found = find_material(name, table(), job);
  return found ? found->id : found.error().code;
}
std::string planned(const std::string& name) {
  Job job;
  const std::string out = planned(name, job);
  EXPECT_EQ(job.count(Severity::kWarning), 0u) << name;
  return out;
}

TEST(StatedHardness, ReadsBrinellVickersAndRockwellAndNothingElse) {
  // ASTM A370: 45 HRC is 421 HB, 50 HRC is 481 HB; halfway between them is taken as halfway.
  EXPECT_NEAR(brinell("45 HRC"), 421.0, 1e-9);
  EXPECT_NEAR(brinell("47.5 hrc"), 451.0, 1e-9);
  for (const char* text :
       {"207 HBW", "207 HV", "Brinell 207", "207 Vickers", "BHN 207", "hardness HBW = 207"})
    EXPECT_EQ(brinell(text), 207.0) << text;
  for (const char* text :
       {"Rc 45", "HRc 45", "Rockwell C 45", "45 Rockwell C", "hardness = 45 HRC", "Rockwell C hardness = 45",
        "Rockwell C hardness 45. HRC", "HRC (42-45)", "RC45", "42CrMo4 HRC45", "HRC min. 45"})
    EXPECT_NEAR(brinell(text), 421.0, 1e-9) << text;
  EXPECT_TRUE(std::isinf(brinell("75 HRC")));  // harder than any card
  for (const char* text : {"X40CrMoV5-1", "HBX 300", "arc 45", "207", "E = 210000 N/mm2", "PA 6", "Ra 3.2"})
    EXPECT_TRUE(stated_words(text).hardness.empty()) << text;
  EXPECT_EQ(stated_words("hardened to 48 HRC").before, "hardened to ");
}

TEST(StatedHardness, ReadsRockwellBAndAByTheConversionForSteel) {
  // ASTM E140: 100 HRB is 241 HB, 90 HRB 183; A370: 50 HRC is 75.9 HRA and 481 HB.
  EXPECT_NEAR(brinell("100 HRB"), 241.0, 1e-9);
  EXPECT_NEAR(brinell("HRB 90"), 183.0, 1e-9);
  EXPECT_NEAR(brinell("75.9 HRA"), 481.0, 1e-9);
  EXPECT_TRUE(std::isinf(brinell("110 HRB")));  // the scale ends at 100
}

TEST(StatedHardness, ReadsATensileStrengthAndNoOther) {
  // ISO 18265, table A.1: 965 N/mm2 is 285 HB, 1220 N/mm2 is 361 HB.
  for (const char* text : {"965 N/mm2", "965 MPa", "Rm 965", "Rm=965", "965 N/mm\xC2\xB2", "900-965 MPa",
                           "tensile strength = 965 N/mm2", "0.965 GPa", "UTS 965"})
    EXPECT_NEAR(brinell(text), 285.0, 1e-9) << text;
  // Groups of three digits; a yield strength before it is another number's.
  for (const char* text : {"Rm 1.220 N/mm2", "Rp0.2 1000 MPa Rm 1220 MPa", "Re 900 MPa, Rm 1,220 MPa"})
    EXPECT_NEAR(brinell(text), 361.0, 1e-9) << text;
  EXPECT_NEAR(brinell("UTS 177,000 psi"), 361.0, 1.0);  // 1220.4 N/mm2
  EXPECT_NEAR(brinell("177 ksi"), 361.0, 1.0);          // 1220.4 N/mm2
  for (const char* text :
       {"Re 700 N/mm2", "yield strength = 700 MPa", "Streckgrenze 700 N/mm2", "Rp0.2 700 MPa",
        "shear strength = 700 MPa", "specific cutting force = 2000 N/mm2"})
    EXPECT_EQ(brinell(text), 0.0) << text;
}

TEST(StatedHardness, OfATextIsTheHardestThatItMayMean) {
  const std::pair<const char*, double> texts[] = {{"42CrMo4 hardened 58+2 HRC", 60.0},
                                                  {"42CrMo4, hardened 58,5 HRC", 58.5},
                                                  {"4140 HRC 50", 50.0},
                                                  {"1.2379 HRC 60", 60.0},
                                                  {"42CrMo4, HRC 48-52", 52.0},
                                                  {"42CrMo4 48-52 HRC", 52.0},
                                                  {"42CrMo4 HRC 48 to 52", 52.0},
                                                  {"42CrMo4 48 bis 52 HRC", 52.0},
                                                  {"C45 HRC min 48 max 52", 52.0},
                                                  {"core 30 HRC, case 58 HRC", 58.0},
                                                  {"42CrMo4 48\xE2\x80\x93"
                                                   "52 HRC",
                                                   52.0},
                                                  {"42CrMo4 58 \xC2\xB1 2 HRC", 60.0}};
  for (const auto& [text, hrc] : texts) EXPECT_EQ(brinell(text), brinell_of(Scale::kRockwellC, hrc)) << text;
  EXPECT_EQ(brinell("1.7225 HB 300"), 300.0);
  EXPECT_EQ(brinell("42CrMo4 hardened 700 HV"), 700.0);
}

TEST(StatedHardness, GivesEachNumberToOneUnit) {
  const auto said = stated_words("C45 HB 200, 900 N/mm2").hardness;
  ASSERT_EQ(said.size(), 2u);
  EXPECT_EQ(said[0].text, "200 HB");
  EXPECT_EQ(said[1].text, "900 N/mm2");
  EXPECT_EQ(brinell("Rm 900, 250 HB"), 266.0);  // 900 N/mm2: ISO 18265
  EXPECT_EQ(brinell("210 HBW 5/250"), 210.0);   // the ball and its load
}

TEST(FindMaterial, TakesTheCardThatIsAsHardInAnyScaleThatConverts) {
  EXPECT_EQ(planned("42CrMo4 95 HRB"), "42crmo4");  // 209 HB, within a tenth of 200
  EXPECT_EQ(planned("C45 100 HRB"), "c45_qt");      // 241 HB
  EXPECT_EQ(planned("42CrMo4 Rc 45"), "hardened_steel_45");
  EXPECT_EQ(planned("16MnCr5 1500 MPa"), "hardened_steel_45");  // 441 HB
  EXPECT_EQ(planned("42CrMo4 1000 N/mm2"), "42crmo4_qt");       // 295 HB
  EXPECT_EQ(planned("C45E Rm 850"), "c45_qt");                  // 251 HB
  EXPECT_EQ(planned("C45 650 N/mm2"), "c45");
  EXPECT_EQ(planned("42CrMo4 79 HRA"), "hardened_steel_55");  // 577 HB
}

TEST(FindMaterial, TakesTheHardestOfAllThatIsSaid) {
  Job job;
  const auto id = [&](const std::vector<std::string>& names, const std::vector<std::string>& properties) {
    const auto m = choose_material(names, properties, table(), job);
    return m ? m->material.id : m.error().code;
  };
  EXPECT_EQ(id({"42CrMo4 300 HB"}, {"hardness = 50 HRC"}), "hardened_steel_50");
  EXPECT_EQ(id({"42CrMo4 50 HRC"}, {"hardness = 300 HB"}), "hardened_steel_50");
  EXPECT_EQ(id({"42CrMo4+QT"}, {"hardness = 50 HRC"}), "hardened_steel_50");
  EXPECT_EQ(id({"C45 250 HB", "C45, 55 HRC"}, {}), "hardened_steel_55");
  EXPECT_EQ(id({"16MnCr5 case-hardened"}, {"hardness = 60 HRC"}), "hardened_steel_60");
  EXPECT_EQ(id({"16MnCr5"}, {"heat treatment = case-hardened"}), "MATERIAL-STATE");
  EXPECT_EQ(id({"STEEL 55 HRC"}, {}), "hardened_steel_55");
  EXPECT_EQ(id({"SAE 1020, 58 HRC"}, {}), "hardened_steel_60");
  EXPECT_EQ(id({"1.2510 60 HRC"}, {}), "hardened_steel_60");
}

TEST(FindMaterial, RefusesAStateThatIsHarderThanTheCardAndGivesNoNumber) {
  for (const char* name : {"16MnCr5 case-hardened",
                           "16MnCr5 case hardened",
                           "16MnCr5 carburized",
                           "16MnCr5, carburised",
                           "16MnCr5 einsatzgeh\xC3\xA4rtet",
                           "16MnCr5 aufgekohlt",
                           "42CrMo4 nitrided",
                           "42CrMo4 nitriert",
                           "42CrMo4 gasnitriert",
                           "C45 induction hardened",
                           "C45E induktivgeh\xC3\xA4rtet",
                           "C45, hardened",
                           "C45 geh\xC3\xA4rtet",
                           "1.2379 geh\xC3\xA4rtet",
                           "1.2379 gehaertet",
                           "C45E quenched",
                           "C60 QT",
                           "34CrMo4+QT",
                           "34CrMo4 quenched and tempered",
                           "34CrMo4 verg\xC3\xBCtet",
                           "34CrMo4V",
                           "34CrMo4 Q&T",
                           "100Cr6 through-hardened",
                           "hardened C45",
                           "case-hardened 16MnCr5",
                           "geh\xC3\xA4rteter C45",
                           "nitrided steel",
                           "AISI 304 work hardened",
                           "17-4PH H900",
                           "42CrMo4 300 HB, nitrided",
                           "16MnCr5 C\xC3\xA9ment\xC3\xA9",
                           "C45 1.0503 oberfl\xC3\xA4"
                           "chengeh\xC3\xA4rtet"}) {
    Job job;
    const auto found = find_material(std::string(name), table(), job);
    ASSERT_FALSE(found) << name << " is taken for " << found->id;
    EXPECT_EQ(found.error().code, "MATERIAL-STATE") << name << ": " << found.error().message;
  }
  Job job;
  const auto refused = find_material("16MnCr5 case-hardened", table(), job).error();
  EXPECT_EQ(
      refused.message,
      "the material '16MnCr5 case-hardened' is said to be 'case-hardened', which is harder than its card "
      "(16mncr5, 200 HB), and nothing says how hard");
  EXPECT_NE(refused.expected.find("16mncr5 58 HRC"), std::string::npos) << refused.expected;
  EXPECT_NE(refused.hint.find("--material like:"), std::string::npos) << refused.hint;
}

TEST(FindMaterial, KeepsTheCardOfAStateThatItHolds) {
  const std::pair<const char*, const char*> names[] = {
      {"C45 annealed", "c45"},
      {"42CrMo4 weichgegl\xC3\xBCht", "42crmo4"},
      {"C45 normalized", "c45"},
      {"annealed C45", "c45"},
      {"1.2379 not hardened", "tool_steel_1_2379"},
      {"1.2379 ungeh\xC3\xA4rtet", "tool_steel_1_2379"},
      {"16MnCr5 case hardening steel", "16mncr5"},
      {"16MnCr5 Einsatzstahl", "16mncr5"},
      {"42CrMo4 QT", "42crmo4_qt"},
      {"42CrMo4+QT polished", "42crmo4_qt"},
      {"C45 quenched and tempered", "c45_qt"},
      {"4140 prehardened", "42crmo4_qt"},
      {"1.2311 prehardened", "tool_steel_1_2311"},
      {"1.2311 vorverg\xC3\xBCtet", "tool_steel_1_2311"},
      {"hardened steel 50 HRC", "hardened_steel_50"},
      {"EN AW-6082 T6 heat treated", "wrought_aluminium"},
      {"Inconel 718 precipitation hardened", "inconel_718"},
      {"AISI 304 solution annealed", "aisi_304"},
      {"C45 hardened 55 HRC", "hardened_steel_55"},
      {"16MnCr5 case-hardened 58+2 HRC", "hardened_steel_60"},
      {"42CrMo4 nitrided 500 HV", "hardened_steel_50"}};
  for (const auto& [name, id] : names) EXPECT_EQ(planned(name), id) << name;
}

TEST(FindMaterial, SaysOfAHardnessInItsNameThatItIsNotUsed) {
  const std::pair<const char*, const char*> names[] = {{"CW614N 75 HRB", "75 HRB"},
                                                       {"EN AW-6061 310 MPa", "310 MPa"},
                                                       {"C45E Shore 35", "35 Shore"},
                                                       {"S355 Re 355 N/mm2", "355 N/mm2"},
                                                       {"SAE 1020 130 HB", "130 HB"}};
  for (const auto& [name, stated] : names) {
    Job job;
    ASSERT_TRUE(find_material(name, table(), job)) << name;
    ASSERT_EQ(job.count(Severity::kWarning), 1u) << name;
    const auto& told = job.diagnostics().front();
    EXPECT_EQ(told.code, "MATERIAL-HARDNESS");
    EXPECT_NE(told.message.find("states " + std::string(stated) + ", which is not used"), std::string::npos)
        << told.message;
  }
}

}  // namespace
}  // namespace capstan::tooling
