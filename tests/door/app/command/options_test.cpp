#include "planner/door/app/command/options.h"

#include <gtest/gtest.h>

namespace capstan::app {
namespace {

TEST(Options, DurationsAreReadWithTheirUnit) {
  using std::chrono::milliseconds;
  EXPECT_EQ(parse_duration("200ms"), milliseconds(200));
  EXPECT_EQ(parse_duration("1.5s"), milliseconds(1500));
  EXPECT_EQ(parse_duration("30"), milliseconds(30));
  for (const char* bad : {"", "ms", "0", "-5ms", "soon", "nan", "inf", "1e300s", "5 minutes"})
    EXPECT_FALSE(parse_duration(bad)) << bad;
}

TEST(Options, StockIsAnAllowanceOrABox) {
  InputOptions o;
  EXPECT_EQ(parse_stock("block:+2", o), "");
  EXPECT_EQ(o.stock_allowance_mm, 2.0);
  InputOptions p;
  EXPECT_EQ(parse_stock("box:0,0,-30,120,80,1", p), "");
  ASSERT_TRUE(p.stock);
  EXPECT_EQ(p.stock->hi.x, 120.0);
  EXPECT_EQ(p.stock->lo.z, -30.0);
}

TEST(Options, StockThatIsNoneIsRefusedWithAReason) {
  for (const char* bad : {"", "block", "block:", "block:-1", "block:nan", "box:", "box:1,2,3",
                          "box:0,0,0,1,1,0", "box:0,0,0,1,1,x", "box:0,0,0,1,1,1,1", "cylinder:5"}) {
    InputOptions o;
    EXPECT_NE(parse_stock(bad, o), "") << bad;
  }
}

TEST(Options, ACommandLineIsUnderstood) {
  const char* argv[] = {"capstan", "plan", "part.p21", "--reopen", "tools", "--machine", "m.yaml", "--solver",
                        "ipopt",   "-o",   "a.ngc",    "-o",       "a.tbl", "--threads", "2"};
  const auto parsed = parse_command_line(static_cast<int>(std::size(argv)), argv);
  ASSERT_TRUE(parsed.options) << parsed.ending.text;
  const Options& o = *parsed.options;
  EXPECT_EQ(o.command, Command::kPlan);
  EXPECT_EQ(o.files, std::vector<std::string>{"part.p21"});
  EXPECT_EQ(o.outputs, (std::vector<std::string>{"a.ngc", "a.tbl"}));
  EXPECT_EQ(o.reopen, pipeline::Reopen::kTools);
  EXPECT_EQ(o.inputs.machine, "m.yaml");
  EXPECT_EQ(o.inputs.solver, optimise::Solver::kIpopt);
  EXPECT_EQ(o.threads, 2U);
}

std::string refused(std::vector<const char*> more) {
  std::vector<const char*> argv{"capstan", "plan", "part.p21", "-o", "a.json"};
  argv.insert(argv.end(), more.begin(), more.end());
  const auto parsed = parse_command_line(static_cast<int>(argv.size()), argv.data());
  return parsed.options ? std::string() : parsed.ending.text;
}

TEST(Options, ProfitNeedsARevenueAndNothingElseDoes) {
  EXPECT_EQ(refused({"--objective", "profit", "--revenue", "12.5"}), "");
  EXPECT_NE(refused({"--objective", "profit"}).find("needs --revenue"), std::string::npos);
  EXPECT_NE(refused({"--revenue", "12.5"}).find("only --objective profit"), std::string::npos);
  for (const char* bad : {"", "0", "-3", "nan", "inf", "much"})
    EXPECT_NE(refused({"--objective", "profit", "--revenue", bad}), "") << bad;
}

TEST(Options, FeedsAreScheduledOrConstant) {
  EXPECT_EQ(refused({"--feeds", "constant"}), "");
  EXPECT_EQ(refused({"--feeds", "scheduled"}), "");
  EXPECT_NE(refused({"--feeds", "fast"}), "");
}

TEST(Options, EdgesAreAFiniteWidth) {
  EXPECT_EQ(refused({"--edges", "0.3"}), "");
  EXPECT_EQ(refused({"--edges", "0"}), "");
  for (const char* bad : {"nan", "inf", "-1", "0,3", "wide", ""})
    EXPECT_THAT(refused({"--edges", bad}), testing::HasSubstr("--edges")) << bad;
}

TEST(Options, AnEmptyValueIsNotTheSameAsNone) {
  EXPECT_THAT(refused({"--general-tolerance", ""}),
              testing::HasSubstr("--general-tolerance: the value is empty"));
  EXPECT_THAT(refused({"--workholding", ""}), testing::HasSubstr("--workholding"));
}

TEST(Options, ADecimalCommaIsRefused) {
  EXPECT_EQ(refused({"--general-tolerance", "+-0.1"}), "");
  EXPECT_THAT(refused({"--general-tolerance", "+-0,1"}), testing::HasSubstr("comma"));
}

TEST(Options, AFileMayFollowItsOutputs) {
  const char* argv[] = {"capstan", "plan", "-o", "a.json", "part.p21"};
  const auto parsed = parse_command_line(static_cast<int>(std::size(argv)), argv);
  ASSERT_TRUE(parsed.options) << parsed.ending.text;
  EXPECT_EQ(parsed.options->files, std::vector<std::string>{"part.p21"});
}

}  // namespace
}  // namespace capstan::app
