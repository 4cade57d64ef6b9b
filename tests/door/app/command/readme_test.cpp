#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>

#include <regex>

#include "planner/door/app/command/reference.h"
#include "planner/physics/mechanics/loads/margin.h"
#include "tests/door/app/command/command.h"
#include "tests/door/app/plans.h"
#include "tests/door/app/programs.h"
#include "tests/support/corpus.h"

// The sessions that README shows are what the program says: each `$ capstan` line is run, in order, in one
// folder, and what it prints is held against the lines below it. "..." stands for lines, or for the rest of a
// line, that are left out.

namespace capstan::app {
namespace {

namespace fs = std::filesystem;

std::string readme() { return slurp(capstan::testing::source_dir() + "/README.md"); }

struct Shown {
  std::string arguments;  ///< of capstan; of python3 where `python`
  bool python = false;
  std::vector<std::string> lines;
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

std::vector<Shown> sessions(const std::string& readme) {
  constexpr std::string_view kPrompt = "$ capstan ", kPython = "$ python3 ";
  std::vector<Shown> out;
  bool fenced = false, shown = false;
  for (const std::string& line : lines_of(readme)) {
    if (line.starts_with("```")) {
      fenced = !fenced;
      shown = false;
    } else if (fenced && line.starts_with(kPrompt)) {
      out.push_back({line.substr(kPrompt.size()), false, {}});
      shown = true;
    } else if (fenced && line.starts_with(kPython)) {
      // The session with a server is run by tests/door/transport/serve/example.py.
      shown = !line.starts_with("$ python3 serve.py ");
      if (shown) out.push_back({line.substr(kPython.size()), true, {}});
    } else if (shown && !line.empty()) {
      out.back().lines.push_back(line);
    }
  }
  return out;
}

bool fits(const std::string& printed, const std::string& shown) {
  const std::string_view dots = "...";
  if (!shown.ends_with(dots)) return printed == shown;
  return printed.starts_with(shown.substr(0, shown.size() - dots.size()));
}

/// The first line shown that is not printed where it should be; empty when all are.
std::string missing(const std::vector<std::string>& printed, const std::vector<std::string>& shown) {
  std::size_t at = 0;
  bool anywhere = false;
  for (const std::string& line : shown) {
    if (line.find_first_not_of(" .") == std::string::npos) {
      anywhere = true;
      continue;
    }
    while (anywhere && at < printed.size() && !fits(printed[at], line)) ++at;
    if (at >= printed.size() || !fits(printed[at], line)) return line;
    ++at;
    anywhere = false;
  }
  return {};
}

class Readme : public CommandTest {};

TEST_F(Readme, ShowsWhatTheProgramSays) {
  const auto shown = sessions(readme());
  ASSERT_GE(shown.size(), 4U);
  for (const auto& e : fs::directory_iterator(capstan::testing::source_dir() + "/examples")) {
    if (e.is_regular_file()) fs::copy_file(e.path(), folder_ / e.path().filename());
  }
  // Without OpenCASCADE, CAD parts are refused, and what follows has no plan of them.
  const bool cad = fs::exists(fs::path(command_file()).parent_path() / "capstan-brep");
  for (const Shown& s : shown) {
    if (!cad && s.arguments.find("cover.") != std::string::npos) continue;
    const Ran r = s.python ? run_python(s.arguments) : run(s.arguments);
    std::vector<std::string> printed;
    // Empty lines are layout.
    for (const std::string& line : lines_of(r.err + r.out)) {
      if (!line.empty()) printed.push_back(line);
    }
    EXPECT_EQ(missing(printed, s.lines), "")
        << (s.python ? "$ python3 " : "$ capstan ") << s.arguments << "\n"
        << r.err << r.out;
  }
}

TEST(ReadmeSessions, ShowEachCommandOfTheCaseBase) {
  const auto shown = sessions(readme());
  const auto all = command_reference().commands;
  const auto cases = std::find_if(all.begin(), all.end(), [](const auto& c) { return c.name == "cases"; });
  ASSERT_NE(cases, all.end());
  EXPECT_GE(cases->commands.size(), 11U);
  for (const CommandText& c : cases->commands) {
    const std::string begins = "cases " + c.name + " ";
    EXPECT_TRUE(std::any_of(shown.begin(), shown.end(),
                            [&](const Shown& s) { return s.arguments.starts_with(begins) && !s.lines.empty(); }))
        << begins;
  }
}

/// What stands outside of sessions, as one line.
std::string told(const std::string& text) {
  std::string out;
  bool fenced = false;
  for (const std::string& line : lines_of(text)) {
    if (line.starts_with("```")) fenced = !fenced;
    if (!fenced) out += line + " ";
  }
  return out;
}

/// A number with a unit of time or memory: what another machine, or another load, measures otherwise.
std::string machine_dependent(const std::string& text) {
  static const std::regex kMeasured("[0-9][0-9.,]* ?(ns|µs|ms|s|min|h|kB|MB|GB)\\b");
  std::smatch found;
  return std::regex_search(text, found, kMeasured) ? found.str() : "";
}

TEST(ReadmeFigures, DependOnNoMachine) { EXPECT_EQ(machine_dependent(told(readme())), ""); }

TEST(ReadmeFigures, ThatDependOnAMachineAreFound) {
  EXPECT_EQ(machine_dependent("read in 0.16 s"), "0.16 s");
  EXPECT_EQ(machine_dependent("69 MB of it"), "69 MB");
  EXPECT_EQ(machine_dependent("7 ms each"), "7 ms");
  EXPECT_EQ(machine_dependent("21 steps, 5 sizes, 1 set-up"), "");
  EXPECT_EQ(machine_dependent(told("a\n```\n3 min 24.8 s\n```\nb")), "");
}

// "19 of 20, 5 of 6 (the default) or 7 of 10 cuts stay below": careful, usual, bold.
TEST(ReadmeFigures, SayHowManyCutsStayBelowEachMargin) {
  const std::string text = told(readme());
  const std::regex share("([0-9]+) of ([0-9]+)");
  const auto from = text.find("`--margin careful`, `usual` or `bold`"),
             to = text.find("cuts stay below", from);
  ASSERT_NE(to, std::string::npos);
  const std::string sentence = text.substr(from, to - from);
  std::vector<double> shares;
  for (std::sregex_iterator it(sentence.begin(), sentence.end(), share), end; it != end; ++it)
    shares.push_back(std::stod((*it)[1]) / std::stod((*it)[2]));
  ASSERT_EQ(shares.size(), mechanics::kNamedMargins.size());
  for (std::size_t i = 0; i < shares.size(); ++i) {
    // Below k standard deviations lies this share of a normal distribution.
    const double below = 0.5 * std::erfc(-mechanics::kNamedMargins[i].deviations / std::sqrt(2.0));
    EXPECT_NEAR(shares[i], below, 0.01) << mechanics::kNamedMargins[i].name;
  }
}

TEST(ReadmeSessions, AreComparedLineByLine) {
  using Lines = std::vector<std::string>;
  EXPECT_EQ(missing({"a", "b", "c"}, {"a", "...", "c"}), "");
  EXPECT_EQ(missing({"a", "b", "c"}, {"a", "c"}), "c");
  EXPECT_EQ(missing({"a 12"}, {"a ..."}), "");
  EXPECT_EQ(missing({"a 12"}, {"a 13"}), "a 13");
  EXPECT_EQ(missing(Lines{}, {"a"}), "a");
  EXPECT_EQ(sessions("```\n$ python3 a.py b\nc\n$ python3 serve.py x\nd\n```\n").size(), 1U);
  EXPECT_EQ(sessions("$ capstan no\n```\n$ capstan x y\nz\n```\nw\n").at(0).arguments, "x y");
}

}  // namespace
}  // namespace capstan::app
