#include "planner/door/app/command/options.h"

#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "planner/door/service/options.h"

namespace capstan::app {
namespace {

TEST(Options, ACommandLineIsUnderstood) {
  const char* argv[] = {"capstan", "plan", "part.p21", "--reopen", "tools", "--machine", "m.yaml", "--solver",
                        "ipopt",   "-o",   "a.ngc",    "-o",       "a.tbl", "--threads", "2"};
  const auto parsed = parse_command_line(static_cast<int>(std::size(argv)), argv);
  ASSERT_TRUE(parsed.options) << parsed.ending.text;
  const Options& o = *parsed.options;
  EXPECT_EQ(o.command, Command::kPlan);
  EXPECT_EQ(o.files, std::vector<std::string>{"part.p21"});
  EXPECT_EQ(o.outputs, (std::vector<std::string>{"a.ngc", "a.tbl"}));
  EXPECT_EQ(o.inputs.reopen, pipeline::Reopen::kTools);
  EXPECT_EQ(o.inputs.machine, "m.yaml");
  EXPECT_EQ(o.inputs.solver, optimise::Solver::kIpopt);
  EXPECT_EQ(o.inputs.threads, 2U);
}

std::string refused(std::vector<const char*> more) {
  std::vector<const char*> argv{"capstan", "plan", "part.p21", "-o", "a.json"};
  argv.insert(argv.end(), more.begin(), more.end());
  const auto parsed = parse_command_line(static_cast<int>(argv.size()), argv.data());
  return parsed.options ? std::string() : parsed.ending.text;
}

TEST(Options, WrongUsageSaysWhatIsWrongAndWhereToLook) {
  const char* bare[] = {"capstan", "plan", "part.p21"};
  const auto parsed = parse_command_line(static_cast<int>(std::size(bare)), bare);
  ASSERT_FALSE(parsed.options);
  EXPECT_EQ(parsed.ending.text,
            "capstan: error: --output is required; `capstan plan --help` shows how [USAGE]\n");
  const std::string stock = refused({"--stock", "blob"});
  EXPECT_THAT(stock, testing::StartsWith("capstan: error: --stock: 'blob' is neither"));
  EXPECT_THAT(stock, testing::EndsWith("; `capstan plan --help` shows how [USAGE]\n"));
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

/// The long options that a verb's help names.
std::set<std::string> long_options(const char* verb) {
  const char* argv[] = {"capstan", verb, "--help"};
  const std::string help = parse_command_line(static_cast<int>(std::size(argv)), argv).ending.text;
  std::set<std::string> out;
  std::istringstream lines(help);
  for (std::string line; std::getline(lines, line);) {
    // An option's own line is indented by two and begins with a dash; texts may name others.
    if (!line.starts_with("  -")) continue;
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (const auto at = word.find("--"); at != std::string::npos) {
      word = word.substr(at + 2);
      out.insert(word.substr(0, word.find_first_not_of("abcdefghijklmnopqrstuvwxyz-")));
    }
  }
  return out;
}

TEST(Options, EachOptionOfPlanBindAndCheckIsTheServicesOrTheTerminalsOwn) {
  const std::pair<const char*, service::Verb> verbs[] = {
      {"plan", service::Verb::kPlan}, {"bind", service::Verb::kBind}, {"check", service::Verb::kCheck}};
  std::set<std::string_view> terminal;
  for (const TerminalOption& t : terminal_options()) {
    EXPECT_FALSE(t.why.empty()) << t.name;
    EXPECT_EQ(service::find_option(t.name), nullptr) << t.name << " stands in both tables";
    terminal.insert(t.name);
  }
  for (const auto& [name, verb] : verbs) {
    const auto shown = long_options(name);
    EXPECT_GT(shown.size(), 4U) << name;
    for (const std::string& option : shown) {
      const service::Option* row = service::find_option(option);
      const bool known = (row != nullptr && row->help_of(verb) != nullptr) || terminal.count(option) != 0;
      EXPECT_TRUE(known) << name << " --" << option;
    }
    for (const service::Option& o : service::options()) {
      if (o.help_of(verb) != nullptr && !o.of_all_commands) {
        EXPECT_EQ(shown.count(std::string(o.name)), 1U) << name << " lacks --" << o.name;
      }
    }
  }
}

TEST(Options, AllowFindingsExcludesStrict) {
  EXPECT_EQ(refused({"--allow-findings"}), "");
  EXPECT_NE(refused({"--allow-findings", "--strict"}), "");
}

}  // namespace
}  // namespace capstan::app
