#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>

#include "tests/door/app/command/command.h"
#include "tests/door/app/plans.h"

// A shop's own settings at the command: made, found, and which of them hold.

namespace capstan::app {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class Shop : public CommandTest {
 protected:
  void SetUp() override { put("plate.p21", testing::drilled_plate()); }
};

TEST_F(Shop, WithAMachineOrToolsThatNoPlanTakesIsNotMade) {
  put("broken.yaml", "machine: [\n");
  for (const auto& [entry, word] :
       {std::pair("machine=generic_vmk", "generic_vmc"), std::pair("machine=broken.yaml", "broken.yaml"),
        std::pair("tools=nowhere.tbl", "nowhere.tbl"), std::pair("material=steeel", "steeel"),
        std::pair("workholding=no_such_vice", "no_such_vice"), std::pair("cases=nowhere.db", "nowhere.db")}) {
    const Ran r = run(std::string("shop init ") + entry);
    EXPECT_EQ(r.code, 2) << entry << r.err;
    EXPECT_THAT(r.err, HasSubstr(word)) << entry;
    EXPECT_FALSE(fs::exists(folder_ / "shop.yaml")) << entry;
  }
  ASSERT_EQ(run("shop init machine=small_router cache=kept").code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "kept")) << "trying it out makes nothing";
  EXPECT_LE(run("plan plate.p21 -o a.json").code, 1);
}

TEST_F(Shop, ThatCannotBeReadIsNamedAndNotPassedOver) {
  put("shop.yaml", "capstan_shop: 1\nmachine: [small_router\n");
  for (const char* call : {"plan plate.p21 -o a.json", "tools list", "shop show"}) {
    const Ran r = run(call);
    EXPECT_EQ(r.code, 2) << call << r.err;
    EXPECT_THAT(r.err, AllOf(HasSubstr("shop.yaml"), HasSubstr("--shop none"))) << call;
  }
  EXPECT_FALSE(fs::exists(folder_ / "a.json"));
  EXPECT_LE(run("plan plate.p21 --shop none -o a.json").code, 1);
}

// A plan was made for a machine, and holds its data: another's settings say nothing of it.
TEST_F(Shop, YieldsToThePlansOwnMachineInACheck) {
  ASSERT_LE(run("plan plate.p21 --allow-findings -o a.json -o a.ngc").code, 1);
  const std::string calls[] = {"check a.json --json", "check a.json a.ngc --json", "check plate.p21 --json"};
  std::vector<std::string> without;
  for (const std::string& call : calls) without.push_back(run(call + " --shop none").out);
  put("tiny.tbl", "T1 P1 D1 Z10 ;carbide end mill\n");
  put("shop.yaml", "capstan_shop: 1\nmachine: small_router\ncontrol: fanuc\ntools: tiny.tbl\n");
  EXPECT_EQ(run(calls[0]).out, without[0]);
  EXPECT_EQ(run(calls[1]).out, without[1]);
  // One that is named holds.
  const Ran named = run("check a.json --machine small_router --json");
  EXPECT_NE(named.out, without[0]) << "its spindle does not turn as slowly as the drill";
}

constexpr const char* kTexts =
    "capstan_shop: 1\n"
    "texts:\n"
    "  title: ACME <b>cell 3</b>\n"
    "  header: [\"ACME Precision, cell 3\", \"Ask for J. Smith\"]\n"
    "  footer: [\"Clean the vise\"]\n";

TEST_F(Shop, TextsStandInTheProgramOfEachControlAndTheCheckTakesThem) {
  put("bracket.p21", slurp(testing::example("bracket.p21")));
  put("shop.yaml", kTexts);
  for (const auto& [control, file] :
       {std::pair("linuxcnc", "a.ngc"), std::pair("fanuc", "a.nc"), std::pair("haas", "b.nc"),
        std::pair("siemens", "a.mpf"), std::pair("heidenhain", "a.h")}) {
    const Ran r = run(std::string("plan bracket.p21 --control ") + control + " -o a.json -o " + file);
    ASSERT_LE(r.code, 1) << control << r.err;  // a Fanuc is told of its path tolerance
    EXPECT_THAT(r.err, HasSubstr("settings of shop.yaml: texts"));
    std::string program = slurp(folder_ / file);
    std::transform(program.begin(), program.end(), program.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    const auto head = program.find("ACME PRECISION, CELL 3"), more = program.find("ASK FOR J. SMITH"),
               first = program.find("CAPSTAN STEP"), foot = program.find("CLEAN THE VISE");
    ASSERT_NE(head, std::string::npos) << control;
    ASSERT_NE(foot, std::string::npos) << control;
    EXPECT_LT(head, more);
    EXPECT_LT(more, first);
    EXPECT_GT(foot, program.rfind("CAPSTAN STEP"));
    const Ran with_plan = run(std::string("check a.json ") + file + " --shop none");
    EXPECT_EQ(with_plan.code, 0) << control << with_plan.err;
    EXPECT_LE(run(std::string("check ") + file + " --shop none").code, 1) << control;
  }
}

TEST_F(Shop, TextsStayWithThePlanAndItsTitleHeadsTheReport) {
  put("shop.yaml", kTexts);
  ASSERT_LE(run("plan plate.p21 --allow-findings -o a.json -o a.html").code, 1);
  const std::string page = slurp(folder_ / "a.html");
  EXPECT_THAT(page, HasSubstr("<h1>ACME &lt;b&gt;cell 3&lt;/b&gt;: plate.p21</h1>"));
  EXPECT_THAT(page, HasSubstr("<title>ACME &lt;b&gt;cell 3&lt;/b&gt;: plate.p21</title>"));
  ASSERT_LE(run("plan a.json --allow-findings --shop none -o b.ngc").code, 1);
  EXPECT_THAT(slurp(folder_ / "b.ngc"), HasSubstr("(Ask for J. Smith)"));
  ASSERT_LE(run("plan plate.p21 --allow-findings --shop none -o c.ngc -o c.html").code, 1);
  EXPECT_THAT(slurp(folder_ / "c.ngc"), Not(HasSubstr("ACME")));
  EXPECT_THAT(slurp(folder_ / "c.html"), HasSubstr("<h1>plate.p21</h1>"));
}

constexpr const char* kFixtures =
    "capstan_fixtures: 1\n"
    "fixtures:\n"
    "  - {id: our_vise, kind: vise, description: the vise of cell 3, width: 160, thickness: 30, height: 50,\n"
    "     opening: 240, length: 480, bed: 100, holding_force_n: 25000, parallels: [[8, 14], [8, 30]]}\n";

TEST_F(Shop, OwnFixturesAreListedShownAndHoldByTheirNames) {
  put("two_setups.p21", slurp(testing::example("two_setups.p21")));
  put("ours.yaml", kFixtures);
  put("shop.yaml", "capstan_shop: 1\nfixtures: [ours.yaml]\n");
  EXPECT_THAT(run("fixtures list").out, AllOf(HasSubstr("our_vise"), HasSubstr("vise_125")));
  EXPECT_THAT(run("fixtures show our_vise").out, HasSubstr("the vise of cell 3"));
  EXPECT_THAT(run("fixtures show vise_125").out, HasSubstr("25000"));
  EXPECT_THAT(run("fixtures list --shop none").out, Not(HasSubstr("our_vise")));
  EXPECT_THAT(run("shop show").out, HasSubstr("fixtures: ours.yaml"));
  const Ran r = run("plan two_setups.p21 --workholding our_vise -o a.json");
  EXPECT_LE(r.code, 1) << r.err;
  EXPECT_THAT(run("explain a.json").out, HasSubstr("our_vise"));
  EXPECT_THAT(slurp(folder_ / "a.json"), HasSubstr("the vise of cell 3"));
  const Ran unknown = run("plan two_setups.p21 --workholding our_vize -o b.json");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("our_vise"));
  EXPECT_EQ(run("plan two_setups.p21 --shop none --workholding our_vise -o b.json").code, 2);
}

TEST_F(Shop, FixturesAndTextsThatCannotBeTakenAreNamed) {
  put("holding.yaml",
      "capstan_workholding: 1\nunit: mm\nsetups: [{setup: 1, fixture: vise_125, fixed_jaw: -y}]\n");
  put("shop.yaml", "capstan_shop: 1\nfixtures: [holding.yaml]\n");
  EXPECT_THAT(run("fixtures list").err, HasSubstr("HOLD-KIND"));
  put("shop.yaml", "capstan_shop: 1\nfixtures: [absent.yaml]\n");
  EXPECT_THAT(run("fixtures list").err, HasSubstr("absent.yaml"));
  put("shop.yaml", "capstan_shop: 1\ntexts:\n  header: [\"CAPSTAN STEP x\"]\n");
  const Ran r = run("plan plate.p21 -o a.json");
  EXPECT_EQ(r.code, 2);
  EXPECT_THAT(r.err, AllOf(HasSubstr("shop.yaml:3"), HasSubstr("a mark of Capstan's own")));
}

}  // namespace
}  // namespace capstan::app
