#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/door/app/command/command.h"
#include "tests/door/app/plans.h"

// Work materials at the command: listed, shown, of the shop's own, asked for by another's figures, by
// hardness.

namespace capstan::app {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(CommandTest, MaterialsAreListedByGroupALineEach) {
  const Ran materials = run("materials list");
  EXPECT_EQ(materials.code, 0);
  EXPECT_THAT(materials.out, HasSubstr("wrought_aluminium"));
  for (const char* group : {"ISO 513 P", "ISO 513 M", "ISO 513 K", "ISO 513 N", "ISO 513 S", "ISO 513 H"})
    EXPECT_THAT(materials.out, HasSubstr(group));
  // 61 materials under 6 groups: a screen or two.
  EXPECT_LE(std::count(materials.out.begin(), materials.out.end(), '\n'), 80);
  EXPECT_THAT(run("materials list FCD").out, AllOf(HasSubstr("FCD400"), Not(HasSubstr("wrought_aluminium"))));
}

TEST_F(CommandTest, AMaterialIsShownByAnyOfItsNamesWithTheSourceOfEachFigure) {
  const Ran shown = run("materials show 1.0503");
  EXPECT_EQ(shown.code, 0);
  EXPECT_THAT(shown.out, AllOf(HasSubstr("c45\n"), HasSubstr("ISO 513 P"), HasSubstr("1500 N/mm2"),
                               HasSubstr("Iscar"), HasSubstr("S45C"), HasSubstr("c45_qt")));
  EXPECT_THAT(run("materials show hardened_steel_60").out, HasSubstr("none"));
  const Ran unknown = run("materials show unobtainium");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("unknown material 'unobtainium'"));
}

const char* const kShopMaterial = R"(capstan_materials: 1
kc_uncertainty: {value: 0.2, source: "shop"}
materials:
  - {source: "measured in the shop", id: shop_alloy, iso_group: N, kc11_n_mm2: 700, mc: 0.25, vc_hss_m_min: 90,
     vc_carbide_m_min: 200}
)";

TEST_F(CommandTest, AShopsOwnMaterialIsPlannedByItsFigures) {
  put("plate.p21", testing::drilled_plate());
  put("alloy.yaml", kShopMaterial);
  const Ran r = run("plan plate.p21 --material alloy.yaml -o a.json");
  EXPECT_LE(r.code, 1) << r.err;  // the part's own stated feed is found fault with
  const std::string told = run("explain a.json").out;
  EXPECT_THAT(
      told, AllOf(HasSubstr("shop_alloy (ISO 513 N), kc1.1 700 N/mm2"), HasSubstr("--material alloy.yaml")));
  // The plan holds it: planned again without the file, it is the same.
  const Ran again = run("plan a.json --reopen technology -o b.json");
  EXPECT_LE(again.code, 1) << again.err;
  EXPECT_THAT(run("explain b.json").out, HasSubstr("shop_alloy (ISO 513 N), kc1.1 700 N/mm2"));
  EXPECT_THAT(run("materials show alloy.yaml").out, HasSubstr("measured in the shop"));
}

TEST_F(CommandTest, AShopsOwnMaterialThatIsWrongIsRefusedWithWhatIsWrong) {
  put("plate.p21", testing::drilled_plate());
  const auto refused = [&](const std::string& from, const std::string& to, const std::string& said) {
    std::string text = kShopMaterial;
    text.replace(text.find(from), from.size(), to);
    put("alloy.yaml", text);
    const Ran r = run("plan plate.p21 --material alloy.yaml -o a.json");
    EXPECT_EQ(r.code, 3) << r.err;
    EXPECT_THAT(r.err, AllOf(HasSubstr("alloy.yaml"), HasSubstr(said)));
  };
  refused("kc11_n_mm2: 700", "kc11_n_mm2: 70000", "70000 is no value of a material");
  refused("mc: 0.25, ", "", "'mc' is missing");
  refused("iso_group: N", "iso_group: Q", "'Q' is no group of ISO 513");
  refused("source: \"measured in the shop\", ", "", "no source is stated");
  refused("id: shop_alloy", "id: c45", "'c45' is the id of a built-in material");
  refused("capstan_materials: 1", "capstan_tools: 1", "'capstan_materials' is missing");
}

TEST_F(CommandTest, AnotherMaterialsFiguresAreTakenForWhoAsksAndThePlanSaysSo) {
  std::string text = testing::drilled_plate();
  const std::string stated = "MATERIAL('EN AW-6061','ALUMINIUM',())";
  text.replace(text.find(stated), stated.size(), "MATERIAL('UNOBTAINIUM','U',())");
  put("plate.p21", text);
  EXPECT_THAT(run("plan plate.p21 -o a.json").err, HasSubstr("--material like:C45"));
  EXPECT_LE(run("plan plate.p21 --material like:AlMgSi1 -o a.json").code, 1);
  const std::string told = run("explain a.json").out;
  EXPECT_THAT(told, AllOf(HasSubstr("like:AlMgSi1"), HasSubstr("with the figures of 'wrought_aluminium'")));
  EXPECT_EQ(run("plan plate.p21 --material like:nothing_known -o b.json").code, 2);
}

TEST_F(CommandTest, AStatedHardnessPicksTheCardThatIsAsHardAndIsSaid) {
  std::string text = testing::drilled_plate();
  const std::string stated = "#6=MATERIAL('EN AW-6061','ALUMINIUM',());";
  text.replace(text.find(stated), stated.size(),
               "#6=MATERIAL('42CrMo4','STEEL',(#301,#302));\n"
               "#301=NUMERIC_PARAMETER('hardness',32.,'HRC');\n#302=DESCRIPTIVE_PARAMETER('grade','A');");
  put("plate.p21", text);
  const Ran r = run("plan plate.p21 -o a.json");
  // 32 HRC is 302 HB: the quenched and tempered card of 300 HB.
  EXPECT_THAT(r.err,
              HasSubstr("the part states hardness = 32 HRC; 42crmo4 is planned as '42crmo4_qt' (300 HB)"));
  EXPECT_THAT(r.err, Not(HasSubstr("hardness = 32 HRC for its material; planning does not use it")));
  EXPECT_THAT(r.err, HasSubstr("the part states grade = A for its material; planning does not use it"));
  EXPECT_THAT(run("explain a.json").out, HasSubstr("32 HRC is stated (302 HB): the card '42crmo4_qt'"));
}

TEST_F(CommandTest, AStateThatIsHarderThanTheCardIsRefusedInTheFileAndByTheCaller) {
  std::string text = testing::drilled_plate();
  const std::string stated = "MATERIAL('EN AW-6061','ALUMINIUM',())";
  text.replace(text.find(stated), stated.size(), "MATERIAL('16MnCr5 case-hardened','STEEL',())");
  put("plate.p21", text);
  const Ran of_file = run("plan plate.p21 -o a.json");
  EXPECT_GE(of_file.code, 2);
  EXPECT_THAT(of_file.err, AllOf(HasSubstr("'case-hardened'"), HasSubstr("nothing says how hard"),
                                 HasSubstr("HRC"), HasSubstr("plate.p21")));
  put("plate.p21", testing::drilled_plate());
  EXPECT_GE(run("plan plate.p21 --material '42CrMo4 nitriert' -o a.json").code, 2);
  EXPECT_THAT(run("plan plate.p21 --material '42CrMo4 nitriert' -o a.json").err, HasSubstr("'nitriert'"));
  EXPECT_LE(run("plan plate.p21 --material '42CrMo4 weichgegl\xC3\xBCht' -o a.json").code, 1);
}

TEST_F(CommandTest, OfAHardnessInTheNameAndAHarderPropertyTheHarderOneCounts) {
  std::string text = testing::drilled_plate();
  const std::string stated = "#6=MATERIAL('EN AW-6061','ALUMINIUM',());";
  text.replace(text.find(stated), stated.size(),
               "#6=MATERIAL('42CrMo4 300 HB','STEEL',(#301,#302));\n"
               "#301=NUMERIC_PARAMETER('hardness',50.,'HRC');\n"
               "#302=NUMERIC_PARAMETER('tensile strength',1000.,'N/mm2');");
  put("plate.p21", text);
  const Ran r = run("plan plate.p21 -o a.json");
  EXPECT_THAT(r.err,
              HasSubstr("the part states hardness = 50 HRC; 42crmo4 is planned as 'hardened_steel_50'"));
  EXPECT_THAT(r.err, Not(HasSubstr("tensile strength = 1000 N/mm2 for its material; planning does not use")));
}

TEST_F(CommandTest, AToolOfThePlanThatCannotCutTheMaterialIsSaidAndNotRunAtSomeSpeed) {
  // The plate's drill is of high-speed steel; its speed and feed are to be chosen anew.
  put("plate.p21", testing::drilled_plate());
  const Ran r = run("plan plate.p21 --material hardened_steel_55 --reopen technology -o a.json");
  EXPECT_THAT(r.err, HasSubstr("hardened_steel_55 is not cut with hss: its card has no speed for it"));
  EXPECT_THAT(r.err, HasSubstr("PIP-NO-PATH"));
}

}  // namespace
}  // namespace capstan::app
