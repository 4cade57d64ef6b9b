#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/casebase/postgres.h"
#include "tests/door/app/command/command.h"
#include "tests/support/corpus.h"

// A factory's case base on a server, through the whole command, by roles that have the least grants that the
// case base's README states, and no others.

namespace capstan::app {
namespace {

using casebase::PostgresPlace;
using ::testing::HasSubstr;

/// The statements of the README, so that they stand once.
std::string grants() {
  const std::string text = capstan::testing::slurp(capstan::testing::source_dir() + "/casebase/README.md");
  const std::string begin = "```sql\n";
  const std::size_t from = text.find(begin) + begin.size();
  return text.substr(from, text.find("```", from) - from);
}

class CasesOnAServer : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    place_ = PostgresPlace::make();
    if (!place_) GTEST_SKIP() << "there is no PostgreSQL on this machine";
    const std::string part = capstan::testing::source_dir() + "/examples/bracket.p21";
    ASSERT_EQ(run("plan '" + part + "' -o plan.json").code, 0);
    ASSERT_EQ(run("cases add '" + place_->uri() + "' plan.json").code, 0);
    place_->sql("DROP ROLE IF EXISTS capstan_add; DROP ROLE IF EXISTS capstan_plan; " + grants());
    place_->sql(
        "CREATE ROLE planner LOGIN IN ROLE capstan_plan; CREATE ROLE adder LOGIN IN ROLE capstan_add");
  }
  void TearDown() override {
    if (!place_) return;
    place_->sql(
        "DROP OWNED BY capstan_plan, capstan_add; DROP ROLE planner, adder, capstan_add, capstan_plan");
  }
  std::string uri_of(const std::string& role) const {
    std::string uri = place_->uri();
    return uri.replace(uri.find("shop@"), 5, role + "@");
  }
  std::string rows() const { return place_->sql("SELECT count(*) FROM capstan.head"); }
  /// "" where the role may run the statement.
  bool may(const std::string& role, const std::string& statement) const {
    return place_->sql("DO $$ BEGIN SET LOCAL ROLE " + role + "; " + statement +
                       "; RAISE NOTICE 'may'; EXCEPTION WHEN insufficient_privilege THEN CREATE TEMP TABLE "
                       "refused(x int); END $$; SELECT count(*) FROM pg_class WHERE relname = 'refused'") ==
           "0";
  }
  std::unique_ptr<PostgresPlace> place_;
};

TEST_F(CasesOnAServer, AreReadByThePlannersRoleWhichMayNotAdd) {
  const std::string part = capstan::testing::source_dir() + "/examples/bracket.p21";
  const Ran planned =
      run("plan '" + part + "' --reopen all --cases '" + uri_of("planner") + "' -o with.json");
  EXPECT_EQ(planned.code, 0) << planned.err;
  EXPECT_THAT(planned.err, HasSubstr("there are cases that change nothing"));
  const std::string before = rows();
  const Ran added = run("cases add '" + uri_of("planner") + "' with.json");
  EXPECT_NE(added.code, 0);
  EXPECT_THAT(added.err, HasSubstr("CASE-READ-ONLY"));
  EXPECT_EQ(rows(), before);
}

TEST_F(CasesOnAServer, AreAddedAndJudgedByTheAddersRoleWhichMayNotAlterThem) {
  const std::string part = capstan::testing::source_dir() + "/examples/bracket.p21";
  ASSERT_EQ(run("plan '" + part + "' --reopen all --margin careful -o careful.json").code, 0);
  const std::string before = rows();
  const Ran added = run("cases add '" + uri_of("adder") + "' careful.json");
  EXPECT_EQ(added.code, 0) << added.err;
  EXPECT_NE(rows(), before);
  const Ran planned = run("plan '" + part + "' --reopen all --cases '" + uri_of("adder") + "' -o with.json");
  EXPECT_EQ(planned.code, 0) << planned.err;
  const std::string id = run("cases list '" + uri_of("adder") + "' REAMING | sed -n 2p | cut -d' ' -f1").out;
  ASSERT_EQ(id.size(), 13u) << id;  // 12 digits and the end of the line
  const Ran judged = run("cases judge '" + uri_of("adder") + "' " + id.substr(0, 12) +
                         " --verdict bad --by \"A. Smith\" --reason bell-mouthed");
  EXPECT_EQ(judged.code, 0) << judged.err;
  EXPECT_TRUE(may("adder", "PERFORM count(*) FROM capstan.head"));
  for (const char* harm :
       {"DELETE FROM capstan.head", "UPDATE capstan.body SET body = ''", "DELETE FROM capstan.id",
        "DELETE FROM capstan.total", "CREATE TABLE capstan.more(x int)", "DROP TABLE capstan.head"})
    EXPECT_FALSE(may("adder", harm)) << harm;
  EXPECT_FALSE(may("planner", "INSERT INTO capstan.head VALUES(9, '')"));
}

TEST_F(CasesOnAServer, AreADestinationOfTraceWhichAddsThemOnceOrWritesNothing) {
  put("sheet.csv",
      "tool,workingstep,characteristics,operation,material_group,tool_class,machine_class,cutter_diameter_mm,"
      "teeth,path_length_mm\n1,DRILL,,DRILLING,N/aluminium,carbide/twist_drill,mill,10,2,100\n");
  put("log.csv", "time_s,tool,feed_mm_min,spindle_rpm\n0,1,600,3000\n10,1,600,3000\n12,1,0,3000\n");
  ASSERT_EQ(run("cases import base.db csv log.csv --plan sheet.csv --part 7").code, 0);
  const int before = std::stoi(rows());
  const std::string trace = "cases trace base.db sheet.csv -o a.jsonl -o ";
  const Ran refused = run(trace + "'" + uri_of("planner") + "'");  // who may not add
  EXPECT_NE(refused.code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.jsonl"));
  EXPECT_EQ(std::stoi(rows()), before);
  for (int i = 0; i < 2; ++i) {
    const Ran traced = run(trace + "'" + uri_of("adder") + "'");
    EXPECT_EQ(traced.code, 0) << traced.err;
    EXPECT_TRUE(std::filesystem::exists(folder_ / "a.jsonl"));
    EXPECT_EQ(std::stoi(rows()), before + 1);
  }
}

}  // namespace
}  // namespace capstan::app
