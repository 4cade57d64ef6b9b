#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/kept/measure.h"

namespace capstan::kept {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

TEST(KeptTable, ReadsWhatItWrites) {
  const Table table = {"a processor",
                       "valgrind-9 x86_64",
                       {{"start-up", 1.25, std::nullopt},
                        {"a-row-with-a-name-that-is-very-long", 3.5, 4.0},
                        {"counted", std::nullopt, 7.0}}};
  const auto again = read(write(table), "fast.table");
  ASSERT_TRUE(again) << to_text(again.error());
  EXPECT_EQ(*again, table);
}

TEST(KeptTable, RefusesALineThatIsNoRow) {
  for (const char* text : {"row\n", "row 0 -\n", "row 1.5 x\n", "row 1.5 - more\n", "row -2 -\n"}) {
    const auto table = read("# a comment\n" + std::string(text), "fast.table");
    ASSERT_FALSE(table) << text;
    EXPECT_EQ(table.error().code, "KEPT-TABLE");
    EXPECT_EQ(table.error().line, 2U);
  }
}

TEST(KeptTable, ARowBeyondTheLimitIsToldWithItsRatiosTheLimitAndWhatToDo) {
  const std::vector<Cost> table = {{"json", 2.0, std::nullopt}};
  EXPECT_FALSE(fault({"json", 2.39, std::nullopt}, table));
  EXPECT_FALSE(fault({"json", 0.5, std::nullopt}, table)) << "faster is no fault";
  const auto wrong = fault({"json", 3.0, std::nullopt}, table);
  ASSERT_TRUE(wrong);
  for (const char* part : {"json", "3 times", "the table has 2", "50 % more", "the limit is 20 %", "--take"})
    EXPECT_THAT(*wrong, HasSubstr(part));
}

TEST(KeptTable, ARowThatTheTableDoesNotHaveIsAFault) {
  const auto wrong = fault({"new", 1.0, std::nullopt}, {});
  ASSERT_TRUE(wrong);
  EXPECT_THAT(*wrong, HasSubstr("no such row"));
}

TEST(KeptTable, InstructionsDecideWhereBothHaveThem) {
  const std::vector<Cost> table = {{"json", 2.0, 10.0}};
  EXPECT_FALSE(fault({"json", 9.0, 10.9}, table));
  EXPECT_TRUE(fault({"json", 2.0, 11.1}, table));
  EXPECT_TRUE(fault({"json", 9.0, std::nullopt}, table)) << "not counted here: the time decides";
  EXPECT_FALSE(fault({"json", std::nullopt, 10.0}, table)) << "no time taken";
}

TEST(KeptTable, NamesTheRowsThatNothingJudges) {
  const std::vector<Cost> table = {{"timed", 2.0, std::nullopt}, {"both", 2.0, 10.0}};
  EXPECT_THAT(not_judged({{"timed", std::nullopt, 4.0}, {"both", std::nullopt, 9.0}}, table),
              ::testing::ElementsAre("timed"));
}

/// A shell that counts to n, so that its work grows with n.
Row counting(int n) {
  return {"counting",
          {"/bin/sh", "-c", "i=0; while [ $i -lt " + std::to_string(n) + " ]; do i=$((i+1)); done"}};
}

TEST(Kept, ARowOfHalfAsMuchWorkAgainFailsAndTheSameWorkPasses) {
  if (counter().empty()) GTEST_SKIP() << "valgrind is not installed";
  const std::vector<Cost> table = measured({counting(20000)}, {0, true});
  ASSERT_THAT(table, SizeIs(1));
  ASSERT_TRUE(table.front().instructions_1e6);
  EXPECT_FALSE(table.front().time);
  std::vector<Cost> costs;
  EXPECT_THAT(check({counting(20000)}, table, {0, true}, costs), IsEmpty());
  EXPECT_THAT(check({counting(30000)}, table, {0, true}, costs), SizeIs(1));
  EXPECT_THAT(costs, SizeIs(2));
}

TEST(Kept, ATimeIsThatOfTheRowOverThatOfTheKernel) {
  const std::vector<Cost> costs = measured({counting(20000)}, {1, false});
  ASSERT_THAT(costs, SizeIs(1));
  ASSERT_TRUE(costs.front().time);
  EXPECT_GT(*costs.front().time, 0.0);
  EXPECT_FALSE(costs.front().instructions_1e6);
}

TEST(Kept, AProgramThatFailsIsNoMeasurement) {
  EXPECT_THROW((void)taken_by(std::vector<std::string>{"/bin/sh", "-c", "exit 3"}), std::runtime_error);
  EXPECT_THROW((void)taken_by(std::vector<std::string>{"/no/such/program"}), std::runtime_error);
  EXPECT_GT(taken_by(std::vector<std::string>{"/bin/sh", "-c", "true"}).cpu_s, 0.0);
}

}  // namespace
}  // namespace capstan::kept
