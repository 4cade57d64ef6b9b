#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/door/app/command/command.h"
#include "tests/door/app/plans.h"
#include "tests/support/corpus.h"

// The sessions that README shows are what the program says: each `$ capstan` line is run, in order, in one
// folder, and what it prints is held against the lines below it. "..." stands for lines, or for the rest of a
// line, that are left out.

namespace capstan::app {
namespace {

namespace fs = std::filesystem;

struct Shown {
  std::string arguments;
  std::vector<std::string> lines;
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

std::vector<Shown> sessions(const std::string& readme) {
  constexpr std::string_view kPrompt = "$ capstan ";
  std::vector<Shown> out;
  bool fenced = false, shown = false;
  for (const std::string& line : lines_of(readme)) {
    if (line.starts_with("```")) {
      fenced = !fenced;
      shown = false;
    } else if (fenced && line.starts_with(kPrompt)) {
      out.push_back({line.substr(kPrompt.size()), {}});
      shown = true;
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
  const auto shown = sessions(slurp(capstan::testing::source_dir() + "/README.md"));
  ASSERT_GE(shown.size(), 4U);
  for (const auto& e : fs::directory_iterator(capstan::testing::source_dir() + "/examples")) {
    if (e.is_regular_file()) fs::copy_file(e.path(), folder_ / e.path().filename());
  }
  for (const Shown& s : shown) {
    const Ran r = run(s.arguments);
    std::vector<std::string> printed;
    // Empty lines are layout.
    for (const std::string& line : lines_of(r.err + r.out)) {
      if (!line.empty()) printed.push_back(line);
    }
    EXPECT_EQ(missing(printed, s.lines), "") << "$ capstan " << s.arguments << "\n" << r.err << r.out;
  }
}

TEST(ReadmeSessions, AreComparedLineByLine) {
  using Lines = std::vector<std::string>;
  EXPECT_EQ(missing({"a", "b", "c"}, {"a", "...", "c"}), "");
  EXPECT_EQ(missing({"a", "b", "c"}, {"a", "c"}), "c");
  EXPECT_EQ(missing({"a 12"}, {"a ..."}), "");
  EXPECT_EQ(missing({"a 12"}, {"a 13"}), "a 13");
  EXPECT_EQ(missing(Lines{}, {"a"}), "a");
  EXPECT_EQ(sessions("$ capstan no\n```\n$ capstan x y\nz\n```\nw\n").at(0).arguments, "x y");
}

}  // namespace
}  // namespace capstan::app
