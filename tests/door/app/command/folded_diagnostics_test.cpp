#include "planner/door/app/command/folded_diagnostics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/door/app/command/command.h"
#include "tests/support/corpus.h"

// Words: what is said of many is said once, what is counted is what is named.

namespace capstan::app {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Diagnostic warning(std::string message) {
  return {.code = "PIP-CHANGED", .severity = Severity::kWarning, .message = std::move(message)};
}

std::size_t count_of(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

TEST(FoldedDiagnostics, EqualWordsAboutSeveralOperationsAreOneLineWithTheirNumberAndNames) {
  std::vector<Diagnostic> all;
  for (int i = 1; i <= 57; ++i)
    all.push_back(warning("operation 'D" + std::to_string(i) + "': machine 'm' has no mist: cut dry"));
  all.push_back(warning("operation 'D1': spins backwards"));
  const auto told = folded_diagnostics(all);
  ASSERT_EQ(told.size(), 2U);
  EXPECT_THAT(told[0].message, HasSubstr("57 operations ('D1', 'D2', 'D3'"));
  EXPECT_THAT(told[0].message, HasSubstr("'D57'): machine 'm' has no mist: cut dry"));
  EXPECT_EQ(told[1].message, "operation 'D1': spins backwards");
}

TEST(FoldedDiagnostics, StepsThatThePathNamesAreGatheredToo) {
  auto a = warning("its thread is not looked at"), b = a;
  a.path = "step 'one'";
  b.path = "step 'two'";
  const auto told = folded_diagnostics({a, b});
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].path, "2 steps ('one', 'two')");
}

TEST(FoldedDiagnostics, TheSameSentenceAgainSaysHowOften) {
  const auto told = folded_diagnostics({warning("POCKET: reduced"), warning("POCKET: reduced")});
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].message, "POCKET: reduced (2 times)");
}

TEST(FoldedDiagnostics, TheSameSentenceAboutTheSameLineStandsOnce) {
  auto a = warning("#77 has no boss"), other = a;
  a.line = 12;
  other.line = 13;
  EXPECT_EQ(without_repeats({a, a, other, a}), (std::vector<Diagnostic>{a, other}));
  const auto placeless = warning("POCKET: reduced");
  EXPECT_EQ(without_repeats({placeless, placeless}).size(), 2U) << "of two places that nobody names";
}

TEST(FoldedDiagnostics, OtherCodesFilesAndSubjectsStayApart) {
  auto other = warning("operation 'A': x");
  other.code = "PIP-ASSUMED";
  auto elsewhere = warning("operation 'A': x");
  elsewhere.file = "b";
  EXPECT_EQ(
      folded_diagnostics({warning("operation 'A': x"), other, elsewhere, warning("step 'A': x")}).size(), 4U);
}

using Words = CommandTest;

TEST_F(Words, HelpNamesEveryFormThatIsReadAndWritten) {
  const std::string help = run("plan --help").out;
  for (const char* form :
       {"AP238", "ISO 14649", ".p21", ".stp", ".stpnc", ".238", ".json", ".ngc", ".tbl", "STL"})
    EXPECT_THAT(help, HasSubstr(form));
  for (const char* command : {"bind", "convert"})
    EXPECT_THAT(run(std::string(command) + " --help").out, HasSubstr(".stpnc"));
}

TEST_F(Words, HelpSaysWhichToolsCountWhereNoneAreNamed) {
  // A line of help may end anywhere between two words.
  const auto help = [&](const char* command) {
    std::istringstream words(run(std::string(command) + " --help").out);
    std::string all;
    for (std::string word; words >> word;) all += word + " ";
    return all;
  };
  EXPECT_THAT(help("plan"), HasSubstr("`generic` (the default)"));
  EXPECT_THAT(help("bind"), HasSubstr("without it the plan's own, in its tool numbers"));
}

TEST_F(Words, AMachineWithoutCoolantIsToldOnceForAllOperations) {
  const std::string bound = "plan '" + capstan::testing::source_dir() + "/examples/bracket.p21' -o p.json";
  ASSERT_EQ(run(bound).code, 0);
  // The plan asks for flood; this machine has none.
  put("dry.yaml", [] {
    std::string text = slurp(capstan::testing::source_dir() + "/tooling/data/machines/generic_vmc.yaml");
    const auto at = text.find("flood:");
    EXPECT_NE(at, std::string::npos);
    text.replace(at, text.find(',', at) - at, "flood: false");
    return text;
  }());
  const Ran ran = run("plan p.json --machine dry.yaml -o q.json");
  EXPECT_EQ(count_of(ran.err, "has no flood coolant"), 1U) << ran.err;
}

TEST_F(Words, FeaturesNotPlannedAreCountedAsFeaturesWithTheReasonThatInspectKnows) {
  ASSERT_EQ(run("plan '" + capstan::testing::source_dir() + "/examples/bracket.p21' -o p.p21").code, 0);
  // A pocket without its depth: neither its roughing nor its finishing can be made, and it is one feature.
  std::string text = slurp(folder_ / "p.p21");
  auto at = text.find("=CLOSED_POCKET('POCKET'");
  ASSERT_NE(at, std::string::npos);
  at = text.find(',', text.find("),#", at) + 2) + 1;  // behind the operations and the placement: the depth
  text.replace(at, text.find(',', at) - at, "$");
  put("p.p21", text);
  ASSERT_THAT(run("inspect p.p21").out, HasSubstr("shape not known: the feature has no depth"));
  const Ran ran = run("plan p.p21 -o q.json");
  EXPECT_THAT(ran.err, HasSubstr("features is not planned; "));
  EXPECT_THAT(ran.err, HasSubstr("the feature has no depth"));
}

/// "4 min 10.6 s" in seconds.
double seconds(const std::string& text) {
  double out = 0.0, value = 0.0;
  std::string unit;
  std::istringstream in(text);
  while (in >> value >> unit) {
    if (unit.back() == ':' || unit.back() == ';' || unit.back() == ',') unit.pop_back();
    if (unit == "min") out += 60.0 * value;
    if (unit == "s") return out + value;
  }
  return -1.0;
}

TEST_F(Words, TheTimeIsTheSameWithTheSamePartsWhereverItIsTold) {
  for (const char* part : {"bracket.p21", "two_setups.p21"}) {
    SCOPED_TRACE(part);
    const Ran ran = run("plan '" + capstan::testing::source_dir() + "/examples/" + std::string(part) +
                        "' -o p.json -o p.ngc");
    const auto plan = nlohmann::json::parse(slurp(folder_ / "p.json"));
    const auto& sum = plan["summary"];
    const double total = sum["total_s"];
    double cutting = 0.0, rapid = 0.0;
    for (const auto& s : plan["steps"]) {
      cutting += s["cutting_s"].get<double>();
      rapid += s["rapid_s"].get<double>();
    }
    EXPECT_NEAR(sum["cutting_s"].get<double>(), cutting, 1e-9);
    EXPECT_NEAR(sum["rapid_s"].get<double>(), rapid, 1e-9);
    EXPECT_NEAR(total,
                cutting + rapid + sum["link_s"].get<double>() + sum["tool_change_s"].get<double>() +
                    sum["spindle_s"].get<double>(),
                1e-9);
    // A text rounds to tenths.
    const auto after = [](const std::string& text, const std::string& mark) {
      const auto at = text.find(mark);
      return at == std::string::npos ? std::string() : text.substr(at + mark.size(), 160);
    };
    EXPECT_NEAR(seconds(after(ran.err, " tools, ")), total, 0.05001);
    const std::string told = after(run("explain p.json").out, "\n  time      ");
    EXPECT_NEAR(seconds(told), total, 0.05001);
    EXPECT_NEAR(seconds(after(told, "cutting ")), cutting, 0.05001);
    EXPECT_NEAR(seconds(after(told, "rapids ")), rapid, 0.05001);
    const std::string line = told.substr(0, told.find('\n'));
    EXPECT_THAT(slurp(folder_ / "p.ngc"), HasSubstr("(time: " + line + ")"));
  }
  // One that is a feed slower: what `diff` tells of the totals is what both plans tell of themselves.
  ASSERT_EQ(run("plan '" + capstan::testing::source_dir() + "/examples/bracket.p21' -o a.json").code, 0);
  ASSERT_EQ(
      run("plan '" + capstan::testing::source_dir() + "/examples/bracket.p21' --feeds constant -o b.json")
          .code,
      0);
  const std::string told = run("diff a.json b.json").out;
  const auto at = told.find("Time in all: ");
  ASSERT_NE(at, std::string::npos) << told;
  const auto arrow = told.find(" -> ", at);
  for (const auto& [name, from] : {std::pair{"a.json", at + 13}, std::pair{"b.json", arrow + 4}}) {
    const auto sum = nlohmann::json::parse(slurp(folder_ / name))["summary"];
    EXPECT_NEAR(seconds(told.substr(from, 30)), sum["total_s"].get<double>(), 0.05001) << name;
  }
}

}  // namespace
}  // namespace capstan::app
