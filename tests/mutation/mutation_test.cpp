#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "planner/proof/verify/verify.h"

#include "tests/mutation/study.h"
#include "tests/support/rs274.h"
#include "tests/support/soak.h"
#include "tooling/library/library.h"

namespace capstan::mutation {
namespace {

/// Other seeds in each repetition of `./dev soak`, and in each of its parts.
std::uint64_t next_seed() {
  static std::uint64_t seed =
      1 + 4000 * static_cast<std::uint64_t>(::testing::UnitTest::GetInstance()->random_seed());
  const std::uint64_t now = seed;
  seed += 1000;
  return now;
}

std::string told(const Row& row) {
  std::string out;
  for (const std::string& t : row.told) out += t + "\n";
  return out;
}

TEST(MutationSeed, EveryDangerousEditIsFoundAndNoBenignOneBlamed) {
  Options o;
  // 88 classes, four programs: a soak of 50 repetitions asks for more than 10,000 edits.
  o.edits = soaking() ? 3 : 1;
  o.first_seed = next_seed();
  o.planned = true;
  o.by_interpreter = testing::rs274_available();
  int edits = 0;
  for (const Row& row : study(o)) {
    edits += row.edits;
    EXPECT_EQ(row.dangerous_missed, 0) << told(row);
    EXPECT_EQ(row.different_missed, 0) << told(row);
    EXPECT_EQ(row.benign_blamed, 0) << told(row);
    if (row.of.kind == Kind::kBenign) {
      EXPECT_EQ(row.same, row.edits) << told(row);
    }
    EXPECT_GT(row.edits, 0) << row.of.name << " edits none of the programs";
  }
  RecordProperty("edits", edits);
}

TEST(MutationSeed, EveryDangerousEditOfAFanucAndAHaasProgramIsFoundAndNoBenignOneBlamed) {
  std::map<std::string, int> edits;  // by class, of both controls
  for (const char* dialect : {"fanuc", "haas"}) {
    Options o;
    o.edits = 4;
    o.first_seed = next_seed();
    o.dialect = dialect;
    for (const Row& row : study(o)) {
      edits[row.of.name] += row.edits;
      EXPECT_EQ(row.dangerous_missed, 0) << dialect << "\n" << told(row);
      EXPECT_EQ(row.different_missed, 0) << dialect << "\n" << told(row);
      EXPECT_EQ(row.benign_blamed, 0) << dialect << "\n" << told(row);
    }
  }
  int all = 0;
  for (const auto& [name, count] : edits) {
    EXPECT_GT(count, 0) << name << " edits none of the programs";
    all += count;
  }
  RecordProperty("edits", all);
}

TEST(MutationSeed, EveryDangerousEditOfASiemensProgramIsFoundAndNoBenignOneBlamed) {
  Options o;
  o.edits = soaking() ? 12 : 6;
  o.first_seed = next_seed();
  o.dialect = "siemens";
  int edits = 0;
  for (const Row& row : study(o)) {
    edits += row.edits;
    EXPECT_GT(row.edits, 0) << row.of.name << " edits none of the programs";
    EXPECT_EQ(row.dangerous_missed, 0) << told(row);
    EXPECT_EQ(row.different_missed, 0) << told(row);
    EXPECT_EQ(row.benign_blamed, 0) << told(row);
  }
  RecordProperty("edits", edits);
}

TEST(MutationSeed, EveryDangerousEditOfAHeidenhainProgramIsFoundAndNoBenignOneBlamed) {
  Options o;
  o.edits = soaking() ? 12 : 6;
  o.first_seed = next_seed();
  o.dialect = "heidenhain";
  int edits = 0;
  for (const Row& row : study(o)) {
    edits += row.edits;
    EXPECT_GT(row.edits, 0) << row.of.name << " edits none of the programs";
    EXPECT_EQ(row.dangerous_missed, 0) << told(row);
    EXPECT_EQ(row.different_missed, 0) << told(row);
    EXPECT_EQ(row.benign_blamed, 0) << told(row);
  }
  RecordProperty("edits", edits);
}

TEST(MutationSeed, EveryDangerousEditOfAGrblProgramIsFoundAndNoBenignOneBlamed) {
  Options o;
  o.edits = soaking() ? 12 : 6;
  o.first_seed = next_seed();
  o.dialect = "grbl";
  int edits = 0;
  std::set<std::string> own;
  for (const Class& c : dangerous_in_grbl()) own.insert(c.name);
  for (const Row& row : study(o)) {
    edits += row.edits;
    if (own.contains(row.of.name)) {
      EXPECT_GT(row.edits, 0) << row.of.name << " edits none of the programs";
    }
    EXPECT_EQ(row.dangerous_missed, 0) << told(row);
    EXPECT_EQ(row.different_missed, 0) << told(row);
    EXPECT_EQ(row.benign_blamed, 0) << told(row);
  }
  EXPECT_GT(edits, 0);
  RecordProperty("edits", edits);
}

TEST(MutationSeed, EveryDangerousEditOfAMach3ProgramIsFoundAndNoBenignOneBlamed) {
  Options o;
  o.edits = soaking() ? 12 : 6;
  o.first_seed = next_seed();
  o.dialect = "mach3";
  std::set<std::string> own;
  for (const Class& c : dangerous_in_mach3()) own.insert(c.name);
  for (const Row& row : study(o)) {
    if (own.contains(row.of.name)) {
      EXPECT_GT(row.edits, 0) << row.of.name << " edits none of the programs";
    }
    EXPECT_EQ(row.dangerous_missed, 0) << told(row);
    EXPECT_EQ(row.different_missed, 0) << told(row);
    EXPECT_EQ(row.benign_blamed, 0) << told(row);
  }
}

// A first block that names a work offset in place of ending the length offset (G59 for G49).
TEST(MutationSeed, AWorkOffsetBeforeTheFirstStepIsFound) {
  for (const Emitted& e : emitted()) {
    std::string text = e.text;
    const std::size_t at = text.find(" G49");
    ASSERT_NE(at, std::string::npos);
    text.replace(at, 4, " G59");
    Job job;
    const auto findings =
        verify::check_program({e.name, text, e.table}, &e.plan, e.plan.machine, e.plan.cutters, job);
    EXPECT_TRUE(std::any_of(findings.begin(), findings.end(), [](const auto& f) {
      return f.code == "CHK-TEXT-STATE" && f.message.find("G59") != std::string::npos;
    })) << e.name;
  }
}

std::vector<Emitted> all_emitted() {
  std::vector<Emitted> out = emitted_and_planned();
  for (const char* dialect : {"fanuc", "haas", "siemens", "heidenhain", "grbl"}) {
    for (Emitted& e : emitted_for(dialect)) {
      e.name += std::string(", ") + dialect;
      out.push_back(std::move(e));
    }
  }
  return out;
}

TEST(MutationSeed, AnEmittedProgramIsBlamedForNothingButWhatItsPlanLacks) {
  for (const Emitted& e : all_emitted()) {
    Job job;
    const auto findings =
        verify::check_program({e.name, e.text, e.table}, &e.plan, e.plan.machine, e.plan.cutters, job);
    std::set<std::string> found;
    for (const auto& f : findings) {
      if (f.severity == Severity::kNote) continue;
      found.insert(f.code);
      EXPECT_TRUE(e.found.contains(f.code)) << e.name << ": " << f.message;
    }
    EXPECT_EQ(found, e.found) << e.name;
    // With its table alone, which says what the tools are.
    auto tools = e.table.empty() ? Result<std::vector<model::Cutter>>(std::vector<model::Cutter>{})
                                 : tooling::read_tool_table(e.table, "table", job);
    ASSERT_TRUE(tools) << to_text(tools.error());
    for (const auto& f :
         verify::check_program({e.name, e.text, e.table}, nullptr, e.plan.machine, *tools, job))
      EXPECT_EQ(f.severity, Severity::kNote) << e.name << ", alone: " << f.message;
  }
}

}  // namespace
}  // namespace capstan::mutation
