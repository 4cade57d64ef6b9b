#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "tests/casebase/sample.h"
#include "tests/door/app/command/command.h"
#include "tests/support/corpus.h"

// The verbs of `capstan cases`, run as a user runs them.

namespace capstan::app {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Cases : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    const Ran planned = run("plan '" + capstan::testing::source_dir() +
                            "/examples/bracket.p21' -o plan.json -o plan.p21 -o plan.stpnc");
    ASSERT_EQ(planned.code, 0) << planned.err;
    const Ran added = run("cases add base.db plan.json");
    ASSERT_EQ(added.code, 0) << added.err;
    // Its counterbored hole makes cases, too: one of each part of it.
    ASSERT_THAT(added.err, HasSubstr("read 14 cases, 14 of them new"));
  }
  /// The id of the first case of the list, or what the list says.
  std::string first() {
    const std::string list = run("cases list base.db --json").out;
    const auto at = list.find("\"id\": \"");
    return at == std::string::npos ? list : list.substr(at + 7, 32);
  }
};

TEST_F(Cases, OfOnePlanCountOnceWhateverFileTheyComeFrom) {
  for (const std::string file : {"plan.json", "plan.p21", "plan.stpnc"})
    EXPECT_THAT(run("cases add base.db " + file).err, HasSubstr(", 0 of them new")) << file;
}

TEST_F(Cases, AreJudgedAndShownWithWhoSaidSo) {
  const std::string id = first();
  EXPECT_EQ(
      run("cases judge base.db " + id.substr(0, 12) + " --verdict bad --by Smith --reason chatter").code, 0);
  const Ran shown = run("cases show base.db " + id);
  EXPECT_THAT(shown.out, HasSubstr("by Smith: chatter"));
  EXPECT_THAT(run("cases list base.db bad").out, HasSubstr(id.substr(0, 12)));
  EXPECT_THAT(run("cases list base.db good").out, HasSubstr("no case"));
}

TEST_F(Cases, ThatAreAddedWithAnotherVerdictAreNamed) {
  const std::string id = first();
  ASSERT_EQ(run("cases judge base.db " + id + " --verdict good --by Smith --reason measured").code, 0);
  put("good.csv", run("cases export base.db").out);
  EXPECT_THAT(run("cases add base.db good.csv").err, Not(HasSubstr("CASE-VERDICT")));
  ASSERT_EQ(run("cases judge base.db " + id + " --verdict bad --by Smith --reason chatter").code, 0);
  const Ran again = run("cases add base.db good.csv");
  EXPECT_THAT(again.err, HasSubstr(", 0 of them new"));
  EXPECT_THAT(again.err, HasSubstr("1 case is there already with another verdict, which stays: " +
                                   id.substr(0, 12) + " (bad, now good)"));
  EXPECT_THAT(again.err, HasSubstr("CASE-VERDICT"));
  EXPECT_THAT(run("cases list base.db bad").out, HasSubstr(id.substr(0, 12)));
}

TEST_F(Cases, ThatAreRemovedStayAway) {
  const std::string id = first();
  EXPECT_EQ(run("cases remove base.db " + id + " --by Smith --reason 'wrong machine'").code, 0);
  EXPECT_THAT(run("cases add base.db plan.json").err, HasSubstr(", 0 of them new"));
  EXPECT_THAT(run("cases list base.db").out, Not(HasSubstr(id.substr(0, 12))));
}

TEST_F(Cases, AreCountedOnceWhereTheyAreNamedTwice) {
  const std::string id = first(), said = " --by Smith --reason chatter";
  EXPECT_THAT(run("cases judge base.db " + id + ' ' + id.substr(0, 12) + " --verdict bad" + said).err,
              HasSubstr("1 case judged bad"));
  EXPECT_THAT(run("cases remove base.db " + id + ' ' + id + said).err, HasSubstr("1 case removed"));
  const Ran again = run("cases remove base.db " + id + " --by Jones --reason again");
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_THAT(again.err, HasSubstr("was removed already, by Smith: chatter"));
  EXPECT_THAT(again.err, HasSubstr("no case removed"));
  const Ran judged = run("cases judge base.db " + id + " --verdict good" + said);
  EXPECT_EQ(judged.code, 2) << judged.err;
  EXPECT_THAT(judged.err, HasSubstr("CASE-REMOVED"));
}

TEST_F(Cases, ThatAreNotAllThereAreExportedWithFindings) {
  EXPECT_EQ(run("cases export base.db").code, 0);
  casebase::tamper((folder_ / "base.db").string(),
                   "UPDATE capstan_body SET body = x'00' WHERE number = (SELECT min(number) FROM capstan_body)");
  for (const std::string how : {"", " --json"}) {
    const Ran out = run("cases export base.db" + how);
    EXPECT_EQ(out.code, 1) << out.err;
    EXPECT_THAT(out.err, HasSubstr("CASE-ROW"));
    EXPECT_THAT(out.err, HasSubstr("not all that was stored"));
    EXPECT_THAT(out.out, HasSubstr("POCKET"));  // what is there still
  }
}

TEST_F(Cases, AreTheSameAfterAnExport) {
  put("cases.csv", run("cases export base.db").out);
  ASSERT_EQ(run("cases add other.db cases.csv").code, 0);
  EXPECT_EQ(run("cases list other.db").out, run("cases list base.db").out);
}

TEST_F(Cases, TeachWhatEachNumberCounts) {
  EXPECT_THAT(run("cases metric base.db").err, HasSubstr("the fixed scales"));
  const Ran none = run("cases metric base.db --learn");  // a plan's own simulation teaches nothing
  EXPECT_EQ(none.code, 4);
  EXPECT_THAT(none.err, HasSubstr("no case went well"));
  // The same cuts, as somebody entered them who saw them go well.
  std::istringstream lines(run("cases export base.db").out);
  std::string entered;  // without the ids, which are those of the simulated cases
  for (std::string line; std::getline(lines, line);) entered += line.substr(line.find(',') + 1) + '\n';
  const std::string from = ",simulated,", to = ",entered,";
  for (std::size_t at = entered.find(from); at != std::string::npos; at = entered.find(from, at))
    entered.replace(at, from.size(), to);
  put("entered.csv", entered);
  const Ran added = run("cases add entered.db entered.csv");
  ASSERT_EQ(added.code, 0) << added.err;
  const std::string list = run("cases list entered.db --json").out, key = "\"id\": \"";
  std::string ids;
  for (std::size_t at = list.find(key); at != std::string::npos; at = list.find(key, at + 1))
    ids += ' ' + list.substr(at + key.size(), 32);
  const Ran judged = run("cases judge entered.db" + ids + " --verdict good --by Smith --reason measured");
  ASSERT_EQ(judged.code, 0) << judged.err;
  const Ran learned = run("cases metric entered.db --learn");
  EXPECT_EQ(learned.code, 0) << learned.err;
  EXPECT_THAT(learned.err, HasSubstr("learned from"));
  EXPECT_EQ(run("cases metric entered.db").out, learned.out);
  EXPECT_NE(run("cases metric base.db").out, learned.out);
}

TEST_F(Cases, OfAServerTellNoPassword) {
  setenv("CAPSTAN_CASES", ".", 1);
  const std::string uri = " 'postgresql://shop:tr0ub4dor@127.0.0.1:1/cases' ";
  for (const std::string& call :
       {"cases list" + uri, "cases add plan.json" + uri,
        "plan '" + capstan::testing::source_dir() + "/examples/bracket.p21' -o other.json --cases" + uri}) {
    const Ran ran = run(call);
    EXPECT_NE(ran.code, 0) << call;
    EXPECT_THAT(ran.err, HasSubstr("postgresql://shop@127.0.0.1:1/cases")) << call;
    EXPECT_THAT(ran.err + ran.out, Not(HasSubstr("tr0ub4dor"))) << call;
  }
  unsetenv("CAPSTAN_CASES");
}

TEST_F(Cases, ThatShareNoCategoriesAreToldByTheOneThatDiffers) {
  const std::string call = "cases nearest base.db --diameter 8 --depth 30 --material 6061 --operation ";
  EXPECT_THAT(run(call + "REAMING --tool carbide/reamer --machine generic_vmc").out, HasSubstr("distance"));
  EXPECT_THAT(run(call + "REAMING --tool carbide/reamer --machine small_router").out,
              HasSubstr("in the machine: 'small_router' is asked, there it is 'generic_vmc'\n"));
  const Ran tool = run(call + "REAMING --tool reamer --machine generic_vmc");
  EXPECT_EQ(tool.code, 2) << tool.out;
  EXPECT_THAT(tool.err, HasSubstr("unknown tool 'reamer'. Did you mean 'carbide/reamer'"));
  const Ran operation = run(call + "reaming --tool carbide/reamer");
  EXPECT_EQ(operation.code, 2) << operation.out;
  EXPECT_THAT(operation.err, HasSubstr("Did you mean 'REAMING'"));
}

TEST_F(Cases, ThatAreNotThereAreWrongUsage) {
  EXPECT_EQ(run("cases show base.db zzz").code, 2);
  EXPECT_EQ(run("cases judge base.db zzz --verdict bad --by Smith --reason x").code, 2);
  EXPECT_EQ(run("cases judge base.db " + first() + " --verdict fine --by Smith --reason x").code, 2);
  EXPECT_EQ(run("cases list none.db").code, 3);
}

}  // namespace
}  // namespace capstan::app
