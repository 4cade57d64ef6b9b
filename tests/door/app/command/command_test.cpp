#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/door/app/command/command.h"
#include "tests/door/app/plans.h"
#include "tests/support/corpus.h"

// The built program, run as a user runs it.

namespace capstan::app {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(CommandTest, HelpAndVersionGoToStandardOutput) {
  const Ran help = run("--help");
  EXPECT_EQ(help.code, 0);
  EXPECT_THAT(help.out, HasSubstr("explain"));
  EXPECT_EQ(run("--version").out, "capstan 0.1.0\n");
}

TEST_F(CommandTest, WrongUsageEndsWithTwoAndSaysWhy) {
  EXPECT_EQ(run("").code, 2);
  EXPECT_EQ(run("polish part.p21").code, 2);
  EXPECT_EQ(run("plan").code, 2);
  EXPECT_EQ(run("plan part.p21").code, 2);  // no output
  EXPECT_EQ(run("plan part.p21 -o a.json --reopen everything").code, 2);
  EXPECT_EQ(run("plan part.p21 -o a.json --threads 0").code, 2);
  EXPECT_EQ(run("diff one.json").code, 2);
  const Ran stock = run("plan part.p21 -o a.json --stock ball:3");
  EXPECT_EQ(stock.code, 2);
  EXPECT_THAT(stock.err, HasSubstr("neither block:+2 nor box:"));
  EXPECT_THAT(run("bind part.p21 -o a.json --deadline soon").err, HasSubstr("'soon' is no time"));
}

TEST_F(CommandTest, WhatIsNotWrittenIsSaidBeforeAnyWork) {
  const Ran r = run("plan missing.p21 -o plan.stl");
  EXPECT_EQ(r.code, 2);
  EXPECT_THAT(r.err, HasSubstr("STL (.stl) is read and not written"));
  EXPECT_EQ(run("plan missing.p21 -o plan.xyz").code, 2);
  EXPECT_EQ(run("plan missing.p21 -o plan").code, 2);
  EXPECT_EQ(run("plan missing.p21 -o a.json -o ./a.json").code, 2);
}

TEST_F(CommandTest, Ap238IsWrittenByEitherEndingAndTakesThePlanBack) {
  put("plate.p21", testing::drilled_plate());
  const Ran there = run("convert plate.p21 -o plate.stpnc -o plate.238");
  EXPECT_EQ(there.code, 0) << there.err;
  EXPECT_EQ(slurp(folder_ / "plate.stpnc"), slurp(folder_ / "plate.238"));
  EXPECT_THAT(slurp(folder_ / "plate.stpnc"), HasSubstr("MODEL_BASED_INTEGRATED_MANUFACTURING_SCHEMA"));
  // The vendor's instance of the ISO 14649 file has no place in AP238: said, and counted.
  EXPECT_THAT(there.err, HasSubstr("TROCHOIDAL_WONDER, kept from ISO 14649, has no place in AP238"));
  EXPECT_THAT(there.err, HasSubstr("plate.stpnc (without 1 thing, see the notes)"));
  const Ran back = run("convert plate.stpnc -o back.p21");
  EXPECT_EQ(back.code, 0) << back.err;
  EXPECT_EQ(run("inspect back.p21 //round_hole/its_id").out,
            run("inspect plate.p21 //round_hole/its_id").out);
  EXPECT_EQ(run("inspect plate.stpnc '//round_hole[diameter.theoretical_size = 10]/its_id'").out, "'HOLE'\n");
  EXPECT_EQ(run("inspect plate.stpnc '//round_hole[diameter'").code, 2);
}

TEST_F(CommandTest, KeptInstancesOfAp238StayOutOfIso14649) {
  put("plate.p21", testing::drilled_plate());
  ASSERT_EQ(run("convert plate.p21 -o plate.stpnc").code, 0);
  std::string text = slurp(folder_ / "plate.stpnc");
  text.insert(text.rfind("ENDSEC;"), "#90000=DOCUMENT_TYPE('vendor');\n");
  put("vendor.stpnc", text);
  const Ran there = run("convert vendor.stpnc -o vendor.p21 -o again.stpnc -o vendor.json");
  EXPECT_EQ(there.code, 0) << there.err;
  EXPECT_THAT(there.err,
              HasSubstr("the .p21 form cannot store DOCUMENT_TYPE (kept from AP238); write .stpnc or .json"));
  EXPECT_THAT(slurp(folder_ / "vendor.p21"), Not(HasSubstr("DOCUMENT_TYPE")));
  EXPECT_THAT(slurp(folder_ / "again.stpnc"), HasSubstr("DOCUMENT_TYPE('vendor')"));
  // JSON loses nothing: it knows of which standard the text is.
  ASSERT_EQ(run("convert vendor.json -o json.stpnc -o json.p21").code, 0);
  EXPECT_THAT(slurp(folder_ / "json.stpnc"), HasSubstr("DOCUMENT_TYPE('vendor')"));
  EXPECT_THAT(slurp(folder_ / "json.p21"), Not(HasSubstr("DOCUMENT_TYPE")));
}

TEST_F(CommandTest, AnchorsAndReferencesStayAndASignatureGoes) {
  put("plate.p21", testing::drilled_plate());
  std::string text = slurp(folder_ / "plate.p21");
  const auto end = text.find("ENDSEC;") + 7;
  text.insert(
      end,
      "\nANCHOR;\n<hole>=#17;\n<#17 no>=#99999;\nENDSEC;\nREFERENCE;\n#88888=<other.stp#part>;\nENDSEC;");
  text += "SIGNATURE\nabcd\nENDSEC;\n";
  put("signed.p21", text);
  const Ran there = run("convert signed.p21 -o signed.stpnc -o again.p21");
  EXPECT_EQ(there.code, 0) << there.err;
  EXPECT_THAT(there.err, HasSubstr("the anchor <#17 no> names #99999, which the file does not hold"));
  EXPECT_THAT(there.err, HasSubstr("EXC-SIGNATURE"));
  EXPECT_THAT(there.err, HasSubstr("EXC-EXTERNAL"));
  for (const char* name : {"signed.stpnc", "again.p21"}) {
    const std::string written = slurp(folder_ / name);
    EXPECT_THAT(written, HasSubstr("#88888=<other.stp#part>;")) << name;
    EXPECT_THAT(written, HasSubstr("<#17 no>=#99999;")) << name;
    EXPECT_THAT(written, HasSubstr("'4;1'")) << name;
    EXPECT_THAT(written, Not(HasSubstr("SIGNATURE"))) << name;
    // The anchor is still at the hole, whatever its number is now.
    const auto at = written.find("<hole>=") + 7;
    const std::string number = written.substr(at, written.find(';', at) - at);
    EXPECT_THAT(run(std::string("inspect ") + name + " '" + number + "/its_id'").out, HasSubstr("HOLE"))
        << name;
  }
}

TEST_F(CommandTest, AFileThatCannotBeReadEndsWithThreeAndOneClearError) {
  const Ran missing = run("plan missing.p21 -o a.json");
  EXPECT_EQ(missing.code, 3);
  EXPECT_THAT(missing.err, HasSubstr("missing.p21: error: the file cannot be opened for reading"));
  EXPECT_EQ(run("inspect .").code, 3);
  put("broken.p21", "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n#1=PROJECT('P',\nENDSEC;\nEND-ISO-10303-21;\n");
  const Ran broken = run("inspect broken.p21");
  EXPECT_EQ(broken.code, 3);
  EXPECT_THAT(broken.err, HasSubstr("broken.p21:"));
  put("empty", "");
  EXPECT_EQ(run("inspect empty").code, 3);
  put("half.json", "{\"version\": 1, ");
  EXPECT_EQ(run("inspect half.json").code, 3);
}

TEST_F(CommandTest, AnEmptyValueIsNotTheSameAsNone) {
  put("plate.p21", testing::drilled_plate());
  for (const char* option : {"--machine", "--tools", "--material", "--rules", "--stock", "--cases",
                             "--workholding", "--general-tolerance", "--edges", "--revenue"}) {
    const Ran r = run(std::string("plan plate.p21 -o a.json ") + option + " ''");
    EXPECT_EQ(r.code, 2) << option;
    EXPECT_THAT(r.err, HasSubstr(std::string(option) + ": the value is empty")) << option;
  }
  EXPECT_EQ(run("plan plate.p21 -o a.json --material '  '").code, 2);
  EXPECT_EQ(run("plan '' -o a.json").code, 2);
  EXPECT_EQ(run("bind plate.p21 --tools '' -o a.json").code, 2);
  EXPECT_EQ(run("bind plate.p21 --deadline '' -o a.json").code, 2);
  EXPECT_EQ(run("check plate.p21 --machine ''").code, 2);
  EXPECT_EQ(run("tools list --tools ''").code, 2);
  EXPECT_EQ(run("rules check --rules ''").code, 2);
  EXPECT_EQ(files(), std::vector<std::string>{"plate.p21"});
}

TEST_F(CommandTest, WrongUsageEndsWithTwo) {
  put("plate.p21", testing::drilled_plate());
  const Ran tolerance = run("plan plate.p21 --general-tolerance 'ISO 2768-q' -o a.json");
  EXPECT_EQ(tolerance.code, 2);
  EXPECT_THAT(tolerance.err, HasSubstr("--general-tolerance: "));
  const Ran rules = run("plan plate.p21 --rules nowhere -o a.json");
  EXPECT_EQ(rules.code, 2);
  EXPECT_THAT(rules.err, HasSubstr("--rules: 'nowhere' is no folder"));
  EXPECT_EQ(run("plan plate.p21 -o nowhere/a.json").code, 2);
  EXPECT_EQ(run("plan plate.p21 --machine no_such_machine -o a.json").code, 2);
  EXPECT_EQ(files(), std::vector<std::string>{"plate.p21"});
}

TEST_F(CommandTest, AFamilyOfMaterialsIsRefusedWithItsNamesOnTheCommandLine) {
  put("plate.p21", testing::drilled_plate());
  const Ran r = run("plan plate.p21 --material STEEL -o a.json");
  EXPECT_EQ(r.code, 2);
  EXPECT_THAT(r.err, HasSubstr("'STEEL' names a family of materials, not a material"));
  EXPECT_THAT(r.err, HasSubstr("'mild_steel'"));
  EXPECT_THAT(r.err, HasSubstr("capstan materials list"));
  EXPECT_EQ(files(), std::vector<std::string>{"plate.p21"});
}

TEST_F(CommandTest, AProgramFromBeforeIsPutAsideWhateverEndsTheRun) {
  // The input cannot be read; a name is not known; the fixture's file is not there.
  put("broken.p21", "ISO-10303-21;\nrubbish");
  put("plate.p21", testing::drilled_plate());
  int n = 0;
  for (const auto& [arguments, code] : {std::pair("plan broken.p21", 3),
                                        {"plan missing.p21", 3},
                                        {"plan plate.p21 --machine nobody", 2},
                                        {"plan plate.p21 --workholding no/where.yaml", 3},
                                        {"bind broken.p21 --tools generic", 3}}) {
    put("x.ngc", "(from before " + std::to_string(++n) + ")\n");
    put("x.tbl", "T1 P1 Z+1 D+1 ;from before\n");
    const Ran r = run(std::string(arguments) + " -o x.ngc -o x.tbl");
    EXPECT_EQ(r.code, code) << arguments << r.err;
    EXPECT_FALSE(fs::exists(folder_ / "x.ngc")) << arguments;
    const std::string aside = n == 1 ? "x.ngc.before" : "x.ngc.before." + std::to_string(n);
    EXPECT_THAT(r.err, HasSubstr("renamed to " + aside)) << arguments;
    EXPECT_EQ(slurp(folder_ / aside), "(from before " + std::to_string(n) + ")\n") << arguments;
    EXPECT_EQ(slurp(folder_ / "x.tbl"), "T1 P1 Z+1 D+1 ;from before\n") << "it may be the machine's own";
  }
}

TEST_F(CommandTest, NothingIsWrittenWhenTheInputIsBad) {
  put("broken.p21", "ISO-10303-21;\nrubbish");
  EXPECT_EQ(run("plan broken.p21 -o a.json -o b.ngc").code, 3);
  EXPECT_EQ(files(), std::vector<std::string>{"broken.p21"});
}

TEST_F(CommandTest, OutputsAreWrittenWholeOrNotAtAll) {
  put("plate.p21", testing::drilled_plate());
  put("kept.json", "as it was");
  fs::create_directory(folder_ / "folder.p21");
  const Ran r = run("convert plate.p21 -o kept.json -o folder.p21");
  EXPECT_EQ(r.code, 2);
  EXPECT_THAT(r.err, HasSubstr("folder.p21: error: this is a folder"));
  EXPECT_EQ(slurp(folder_ / "kept.json"), "as it was");
  EXPECT_EQ(files(), (std::vector<std::string>{"folder.p21", "kept.json", "plate.p21"}));
}

TEST_F(CommandTest, ConvertsToJsonAndBackToTheSamePlan) {
  put("plate.p21", testing::drilled_plate());
  ASSERT_EQ(run("convert plate.p21 -o a.json -o a.p21").code, 0);
  ASSERT_EQ(run("convert a.json -o b.p21 -o b.json").code, 0);
  EXPECT_EQ(slurp(folder_ / "a.p21"), slurp(folder_ / "b.p21"));
  const Ran same = run("diff a.json b.p21");
  EXPECT_EQ(same.code, 0) << same.out;
  EXPECT_EQ(same.out, "the plans say the same\n");
}

TEST_F(CommandTest, JsonGoesToStandardOutputAndNothingElseDoes) {
  put("plate.p21", testing::drilled_plate());
  const Ran r = run("convert plate.p21 -o -");
  EXPECT_EQ(r.code, 0);
  EXPECT_EQ(r.out.front(), '{');
  EXPECT_EQ(r.out.find("capstan:"), std::string::npos);
  EXPECT_THAT(r.err, HasSubstr("capstan: converted plate.p21"));
}

TEST_F(CommandTest, InspectsAValueByPath) {
  put("plate.p21", testing::drilled_plate());
  const Ran r = run("inspect plate.p21 '/project/its_workpieces[0]/its_material/standard_identifier'");
  EXPECT_EQ(r.code, 0);
  EXPECT_EQ(r.out, "'EN AW-6061'\n");
  EXPECT_EQ(r.err, "");
  const Ran wrong = run("inspect plate.p21 /project/its_workpeaces");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_EQ(wrong.out, "");
  EXPECT_THAT(wrong.err, HasSubstr("expected its_id, main_workplan, its_workpieces"));
}

TEST_F(CommandTest, DiagnosticsMayBeJson) {
  const Ran r = run("--diagnostics json inspect missing.p21");
  EXPECT_EQ(r.code, 3);
  std::istringstream lines(r.err);
  std::size_t n = 0;
  for (std::string line; std::getline(lines, line); ++n) {
    EXPECT_EQ(line.front(), '{');
    EXPECT_EQ(line.back(), '}');
  }
  EXPECT_EQ(n, 2U);  // the fault, the summary
  EXPECT_THAT(r.err, HasSubstr("\"code\":\"FILE-READ\""));
}

TEST_F(CommandTest, NothingDrawsABarInAPipe) {
  put("plate.p21", testing::drilled_plate());
  EXPECT_THAT(run("inspect plate.p21").err, Not(HasSubstr("\r")));
}

TEST_F(CommandTest, ListsAndShowsTools) {
  const Ran list = run("tools list twist_drill");
  EXPECT_EQ(list.code, 0);
  EXPECT_THAT(list.out, HasSubstr("twist_drill"));
  EXPECT_THAT(list.out, Not(HasSubstr("reamer")));
  std::istringstream lines(list.out);
  std::string line;
  std::getline(lines, line);
  std::getline(lines, line);
  const std::string id = line.substr(0, line.find(' '));
  const Ran one = run("tools show " + id);
  EXPECT_EQ(one.code, 0);
  EXPECT_THAT(one.out, HasSubstr("cutting_diameter"));
  EXPECT_THAT(one.out, HasSubstr("default:"));
  EXPECT_EQ(run("tools show nonsense").code, 2);
}

TEST_F(CommandTest, ShippedRulesHaveNoFinding) {
  const Ran r = run("rules check");
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("no finding"));
  EXPECT_THAT(run("rules list").out, HasSubstr("source"));
}

TEST_F(CommandTest, RulesOfAShopWithFaultsEndWithOneAndNameTheBoxes) {
  fs::create_directory(folder_ / "shop");
  put("shop/shop.yaml", R"(table: hole
rows:
  - {id: hole.tiny, priority: 12, when: {diameter_mm: {from: 0, below: 0.3}}, cannot: "not here", source: shop}
  - {id: shop.drill, priority: 50, when: {bottom: [through], diameter_mm: {from: 3, below: 9}, it_grade: {from: 11, to: 12}},
     cannot: "not here", source: shop}
  - {id: shop.dead, priority: 999, when: {diameter_mm: {from: 0, below: 0.1}}, cannot: "never", source: shop}
  - {id: shop.all, priority: 1000, cannot: "never", source: shop}
)");
  const Ran r = run("rules check --rules shop");
  EXPECT_EQ(r.code, 1);
  EXPECT_THAT(r.err,
              HasSubstr("gap: no row for taper in {none}, bottom in {flat}, core in {none}, diameter_mm in "
                        "[0.3, 0.5), it_grade in [7, 19) [RULE-GAP]"))
      << "a row without conditions closes no gap";
  EXPECT_THAT(r.err,
              HasSubstr("contradiction: hole.drill and shop.drill conclude differently for taper in {none}, "
                        "bottom in {through}, core in {none}, diameter_mm in [3, 9), it_grade in [11, 13)"));
  EXPECT_THAT(r.err,
              HasSubstr("shop.yaml:6: warning: hole: dead row: shop.dead never decides: better rows cover "
                        "diameter_mm in [0, 0.1) [RULE-DEAD-ROW]"));
}

TEST_F(CommandTest, RulesOfAShopThatAreMissingEndWithTwoAndUnreadableOnesWithThree) {
  EXPECT_EQ(run("rules check --rules nowhere").code, 2);
  fs::create_directory(folder_ / "shop");
  put("shop/shop.yaml", "table: hole\nrows:\n  - {id: a, source: s, chains: [[laser]]}\n");
  const Ran r = run("rules check --rules shop");
  EXPECT_EQ(r.code, 3);
  EXPECT_THAT(r.err, HasSubstr("shop.yaml:3"));
  EXPECT_THAT(r.err, HasSubstr("no action named laser"));
}

TEST_F(CommandTest, RowsOfAShopReplaceAndAdd) {
  fs::create_directory(folder_ / "shop");
  put("shop/shop.yaml", R"(table: hole
rows:
  - {id: hole.tiny, priority: 12, when: {diameter_mm: {from: 0, below: 0.5}}, cannot: "no such drills", source: shop}
  - {id: shop.bore, priority: 40, when: {bottom: [through], core: [none], taper: [none], diameter_mm: {from: 7, below: 9},
     it_grade: {from: 7, to: 8}}, chains: [[centre, {do: drill, under_mm: 0.5}, bore]], text: "we bore", source: "our shop, 2024"}
)");
  EXPECT_EQ(run("rules check --rules shop").code, 0);
  const Ran listed = run("rules list --rules shop");
  EXPECT_THAT(listed.out, HasSubstr("no such drills"));
  EXPECT_THAT(listed.out, Not(HasSubstr("holes below 0.5 mm are not planned")));
  EXPECT_THAT(listed.out, HasSubstr("shop.bore (priority 40, "));
  EXPECT_THAT(listed.out, HasSubstr("source  our shop, 2024"));
}

// The dowel holes of the example, 8 H11, 8 H9 and 8 H7.
TEST_F(CommandTest, ATighterHoleGetsAnotherChainAndExplainCitesTheRow) {
  const std::string bracket = slurp(testing::example("bracket.p21"));
  const std::string h7 = "#95=PLUS_MINUS_VALUE(0.015,0.,3)";
  ASSERT_NE(bracket.find(h7), std::string::npos);
  const auto explained = [&](const std::string& upper) {
    std::string text = bracket;
    text.replace(text.find(h7), h7.size(), "#95=PLUS_MINUS_VALUE(" + upper + ",0.,3)");
    put(upper + ".p21", text);
    const Ran planned = run("plan " + upper + ".p21 -o " + upper + ".json");
    EXPECT_LE(planned.code, 1) << planned.err;
    const Ran drill = run("explain " + upper + ".json 'DOWEL HOLE 1 drill'");
    const Ran ream = run("explain " + upper + ".json 'DOWEL HOLE 1 ream'");
    return drill.out + (ream.code == 0 ? ream.out : "");
  };
  const std::string h11 = explained("0.09");
  EXPECT_THAT(h11, HasSubstr("[hole.drill; "));
  EXPECT_THAT(h11, Not(HasSubstr("REAMING")));
  EXPECT_THAT(explained("0.036"), HasSubstr("[hole.ream.it9; default, unsourced]"));
  EXPECT_THAT(explained("0.015"), HasSubstr("[hole.ream.it7; default, unsourced]"));
  EXPECT_EQ(explained("0.009"), "") << "8 H6: no chain holds it";
}

TEST_F(CommandTest, AMissingMachineIsAnUnreadableInput) {
  put("plate.p21", testing::drilled_plate());
  EXPECT_EQ(run("plate.p21").code, 2);
  const Ran r = run("plan plate.p21 --machine nowhere.yaml -o a.json");
  EXPECT_EQ(r.code, 3);
  EXPECT_THAT(r.err, HasSubstr("nowhere.yaml"));
  EXPECT_EQ(files(), std::vector<std::string>{"plate.p21"});
}

TEST_F(CommandTest, AnUnknownNameIsRefusedWithTheNearestOnesAndHowToListThem) {
  put("plate.p21", testing::drilled_plate());
  const auto refused = [&](const std::string& arguments, const std::string& said, const std::string& list) {
    const Ran r = run(arguments);
    EXPECT_EQ(r.code, 2) << arguments << "\n" << r.err;
    EXPECT_THAT(r.err, HasSubstr(said)) << arguments;
    EXPECT_THAT(r.err, HasSubstr("`" + list + "`")) << arguments;
    EXPECT_EQ(files(), std::vector<std::string>{"plate.p21"});
  };
  const std::string plan = "plan plate.p21 -o a.json ";
  refused(plan + "--material steeel", "unknown material 'steeel'. Did you mean 'mild_steel'",
          "capstan materials list");
  refused(plan + "--machine smal_router", "unknown machine 'smal_router'. Did you mean 'small_router'?",
          "capstan machines list");
  refused(plan + "--workholding vice_125", "unknown fixture 'vice_125'. Did you mean 'vise_125'",
          "capstan fixtures list");
  refused(plan + "--tools genric", "unknown tool library 'genric'. Did you mean 'generic' or 'generic-inch'?",
          "capstan tools list");
  refused("tools show generic/reamer_h7/88", "unknown cutter 'generic/reamer_h7/88'. Did you mean '",
          "capstan tools list");
  refused("check plate.p21 --machine smal_router", "unknown machine", "capstan machines list");
}

TEST_F(CommandTest, AnUnknownMaterialOfThePartIsRefusedAndAnUnnamedOneIsPlannedByDefault) {
  std::string text = testing::drilled_plate();
  const std::string stated = "MATERIAL('EN AW-6061','ALUMINIUM',())";
  const auto with = [&](const std::string& other) {
    std::string t = text;
    return t.replace(t.find(stated), stated.size(), other);
  };
  put("plate.p21", with("MATERIAL('UNOBTAINIUM','U',())"));
  const Ran unknown = run("plan plate.p21 -o a.json");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("#6 unknown material 'UNOBTAINIUM'"));
  EXPECT_THAT(unknown.err, HasSubstr("name one with --material"));
  EXPECT_THAT(run("plan plate.p21 --material C45 -o a.json").err, Not(HasSubstr("unknown material")));
  put("plate.p21", with("MATERIAL('','',())"));
  EXPECT_THAT(run("plan plate.p21 -o a.json").err,
              HasSubstr("no material is named; planned for tool_steel by default"));
}

TEST_F(CommandTest, AStatedPropertyOfTheMaterialThatIsNotUsedIsSaid) {
  std::string text = testing::drilled_plate();
  const std::string stated = "#6=MATERIAL('EN AW-6061','ALUMINIUM',());";
  text.replace(text.find(stated), stated.size(),
               "#6=MATERIAL('FC200','CAST IRON',(#301,#302));\n"
               "#301=NUMERIC_PARAMETER('hardness',200.,'HB');\n#302=DESCRIPTIVE_PARAMETER('grade','A');");
  put("plate.p21", text);
  const Ran r = run("plan plate.p21 -o a.json");
  EXPECT_THAT(r.err,
              HasSubstr("the part states hardness = 200 HB for its material; planning does not use it"));
  EXPECT_THAT(r.err, HasSubstr("the part states grade = A for its material"));
  EXPECT_THAT(r.err, HasSubstr("grey_cast_iron"));
  EXPECT_THAT(run("explain a.json").out, HasSubstr("grey_cast_iron"));
}

TEST_F(CommandTest, WhatIsKnownIsListed) {
  EXPECT_THAT(run("machines list").out, HasSubstr("small_router"));
  EXPECT_THAT(run("fixtures list").out, HasSubstr("vise_125"));
}

TEST_F(CommandTest, AMissingCaseBaseIsNotMadeByAsking) {
  const Ran r =
      run("cases nearest none.db --operation DRILLING --material C45 --tool hss/twist_drill --diameter 8");
  EXPECT_EQ(r.code, 3);
  EXPECT_TRUE(files().empty());
}

TEST_F(CommandTest, ATableWithoutToolsInTheMagazineCannotBind) {
  put("plate.p21", testing::drilled_plate());
  const Ran r = run("bind plate.p21 -o a.json");
  EXPECT_EQ(r.code, 2);
  EXPECT_THAT(r.err, HasSubstr("no cutter of the library is in the magazine"));
}

}  // namespace
}  // namespace capstan::app
