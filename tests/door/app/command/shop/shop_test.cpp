#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace capstan::app
