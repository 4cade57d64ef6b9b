#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <regex>
#include <sstream>

#include "planner/files/json/json.h"
#include "tests/door/app/command/command.h"
#include "tests/door/app/programs.h"
#include "tests/support/corpus.h"

// Parts of MFCAD at the command, ten times as large (docs/validation.md, section 18): rows of the record of
// their plans, and the tools that plans name.

namespace capstan::app {
namespace {

using ::testing::IsEmpty;

class CadPlansCorpus : public CommandTest {
 protected:
  static bool built() {
    return std::filesystem::exists(std::filesystem::path(command_file()).parent_path() / "capstan-brep");
  }
  /// Writes the part with its unit of length read as the centimetre, as record_plans.py does.
  void put_ten_times(const std::string& name) {
    std::string text = slurp(capstan::testing::corpus_folder() + "/cad/mfcad/" + name + ".step");
    const std::string unit = "SI_UNIT(.MILLI.,.METRE.)";
    std::size_t found = 0;
    for (std::size_t at = 0; (at = text.find(unit, at)) != std::string::npos; ++found)
      text.replace(at, unit.size(), "SI_UNIT(.CENTI.,.METRE.)");
    ASSERT_GT(found, 0U) << name;
    put(name + ".step", text);
  }
  /// What the first group of a pattern is; `none` where it does not occur.
  static std::string figure(const std::string& text, const std::string& pattern,
                            const std::string& none = {}) {
    std::smatch found;
    return std::regex_search(text, found, std::regex(pattern)) ? found[1].str() : none;
  }
  /// Features that are not planned, and inner corners that stay rounder than drawn, by name.
  static std::vector<std::string> lacking(const std::string& said) {
    std::vector<std::string> out;
    const std::regex pattern("feature '([^']+)' \\([^)]*\\) is not planned");
    for (auto at = std::sregex_iterator(said.begin(), said.end(), pattern); at != std::sregex_iterator();
         ++at)
      out.push_back((*at)[1]);
    return out;
  }
};

struct Recorded {
  std::string outcome, features, faces, raw, left, stays_mm3, overlap;
};

std::map<std::string, Recorded> record() {
  std::istringstream in(slurp(capstan::testing::source_dir() + "/docs/validation/cad_plans.csv"));
  std::map<std::string, Recorded> out;
  std::string line;
  while (std::getline(in, line)) {
    std::vector<std::string> c;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) c.push_back(cell);
    if (c.size() == 13 && c[0] == "mfcad" && c[3] == "x10")
      out[c[2]] = {c[4], c[5], c[6], c[7], c[8], c[9], c[11]};
  }
  return out;
}

// Three of the quick ones: two that are planned whole and one in part.
TEST_F(CadPlansCorpus, RowsOfTheRecordOfPlansAreThoseOfThisProgram) {
  if (capstan::testing::corpus_folder().empty()) GTEST_SKIP() << "corpus is absent";
  if (!built()) GTEST_SKIP() << "built without OpenCASCADE";
  const auto rows = record();
  for (const std::string name : {"1-13-19", "7-11-13-14-19", "8-8-11-13-19"}) {
    const auto row = rows.find(name);
    ASSERT_NE(row, rows.end()) << name;
    const Recorded& was = row->second;
    put_ten_times(name);
    const Ran r = run("plan " + name + ".step --material 6061 --threads 1 -o part.json -o part.ngc --force");
    const std::string said = r.err + r.out;
    const bool part = said.find("\nSafe, but not whole") != std::string::npos;
    const bool safe = said.find("\nSafe") != std::string::npos;
    EXPECT_EQ(part ? "in_part" : safe ? "whole" : "else", was.outcome) << name << "\n" << said;
    EXPECT_EQ(figure(said, "(\\d+) features? of \\d+ faces?; "), was.features) << name;
    EXPECT_EQ(figure(said, "\\d+ features? of (\\d+) faces?; "), was.faces) << name;
    EXPECT_EQ(figure(said, "(\\d+) faces? lies? on the sides"), was.raw) << name;
    EXPECT_EQ(figure(said, "(\\d+) groups? of faces or volumes?"), was.left) << name;
    EXPECT_EQ(figure(said, "about ([\\d.]+) mm3 of [\\d.]+ stay", "0"), was.stays_mm3) << name;
    EXPECT_EQ(figure(said, "finished part against[^\\n]*?([\\d.]+) % overlap"), was.overlap) << name;
  }
}

// Among them a feature whose walls no mill of its reach stands to cut within their tolerance.
TEST_F(CadPlansCorpus, FeaturesArePlannedWithExactlyTheToolsThatAreNamedForThem) {
  if (capstan::testing::corpus_folder().empty()) GTEST_SKIP() << "corpus is absent";
  if (!built()) GTEST_SKIP() << "built without OpenCASCADE";
  ASSERT_EQ(run("tools import generic -o generic.yaml").code, 0);
  // A shop without tools of long reach.
  std::string generic, line;
  bool deep = false;
  for (std::istringstream lines(slurp(folder_ / "generic.yaml")); std::getline(lines, line);) {
    if (line.starts_with("  - ")) deep = line.find("_deep/") != std::string::npos;
    if (!deep) generic += line + "\n";
  }
  put("some.yaml", generic);
  int named_in_all = 0;
  for (const std::string name : {"1-5-6-7-7-23", "0-0-0-3-14-23"}) {
    put_ten_times(name);
    const Ran first = run("plan " + name + ".step --material 6061 -o part.json --tools some.yaml --force");
    Job job;
    const auto plan = json::read_json(slurp(folder_ / "part.json"), "part.json", job);
    ASSERT_TRUE(plan) << first.err << first.out;
    std::string list = generic, named_for;
    for (const auto& p : plan->provenance) {
      if (!p.what.starts_with("needed tool ")) continue;
      list += "  - " + p.value + "\n";
      named_for += p.source;
    }
    if (named_for.empty()) continue;
    ++named_in_all;
    put("more.yaml", list);
    const Ran again = run("plan " + name + ".step --material 6061 --tools more.yaml -o part.json --force");
    for (const std::string& feature : lacking(again.err)) {
      EXPECT_EQ(named_for.find("'" + feature + "'"), std::string::npos) << name << ": " << feature << "\n"
                                                                        << again.err;
    }
    const bool all = first.err.find("to plan all of this part you need: ") != std::string::npos;
    if (all) {
      EXPECT_THAT(lacking(again.err), IsEmpty()) << name;
    }
  }
  EXPECT_GT(named_in_all, 0);
}

}  // namespace
}  // namespace capstan::app
