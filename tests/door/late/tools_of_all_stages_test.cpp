#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "planner/door/late/late.h"
#include "planner/model/plan/cutter/measured_length.h"
#include "tests/door/late/brought.h"
#include "tooling/library/library.h"

// A tool of the table is missing, worn, short, or the table is in inches; the plan that is brought has its
// paths, its tools alone or its operations alone. Whatever comes of it, each cutter of the answer is a line
// of the table: by number, diameter and length, and its program calls no other.

namespace capstan::late {
namespace {

constexpr double kMmPerInch = 25.4;
constexpr double kWornMm = 0.05, kShorterMm = 8.0;
/// Of what a table's text states with six decimals.
constexpr double kSameMm = 1e-4;

/// Diameter and length of each tool of a table, mm.
struct Row {
  double diameter_mm = 0.0, z_mm = 0.0;
};
std::map<int, Row> rows_of(const std::string& table, double mm_per_unit) {
  std::map<int, Row> out;
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line.substr(0, line.find(';')));
    int number = 0;
    for (std::string word; words >> word;) {
      const double v = std::stod(word.substr(1));
      if (word[0] == 'T') number = static_cast<int>(v);
      if (word[0] == 'D') out[number].diameter_mm = v * mm_per_unit;
      if (word[0] == 'Z') out[number].z_mm = v * mm_per_unit;
    }
  }
  return out;
}

/// The table with lengths and diameters in inches.
std::string in_inches(const std::string& table) {
  std::string out;
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    for (const char key : {'Z', 'D'}) {
      const auto at = line.find(std::string(1, key) + "+") + 2;
      const auto end = line.find(' ', at);
      line.replace(at, end - at, std::to_string(std::stod(line.substr(at, end - at)) / kMmPerInch));
    }
    out += line + "\n";
  }
  return out;
}

/// What the magazine has in place of a mill that is missing.
constexpr const char* kOtherMills =
    "T17 P17 Z+115.000000 D+6.000000 ;6 mm carbide end mill, 3 flutes\n"
    "T18 P18 Z+112.000000 D+5.000000 ;5 mm carbide end mill, 3 flutes\n";

enum class Stage { kPaths, kTools, kStrategy };
enum class What { kMissing, kWorn, kShort, kInch };
using Case = std::pair<Stage, What>;

class ToolsOfAllStages : public ::testing::TestWithParam<Case> {
 protected:
  static const std::string& part() {
    static const std::string kPart = testing::source_dir() + "/examples/reference_pocket.p21";
    return kPart;
  }
  static const Brought& whole() {
    static const Brought kWhole = brought(part(), pipeline::Format::kJson);
    return kWhole;
  }
  /// The plan as far as it is bound, read again from its file.
  static model::Plan as_far_as(Stage stage) {
    if (stage == Stage::kPaths) return whole().plan;
    Job job;
    auto read = pipeline::read_plan(testing::slurp(part()), part(), job);
    auto made = pipeline::bind(
        *std::move(read), shop({}),
        {.bind = stage == Stage::kTools ? pipeline::Bind::kTools : pipeline::Bind::kStrategy}, job);
    EXPECT_TRUE(made) << (made ? "" : to_text(made.error()));
    auto text = pipeline::write_plan(*made, pipeline::Format::kJson, job);
    auto again = pipeline::read_plan(*text, part(), job);
    EXPECT_TRUE(again);
    return *std::move(again);
  }
  /// The tool that is touched: an end mill of the plan.
  static int touched() {
    for (const model::Cutter& c : whole().plan.cutters)
      if (c.cutter_class == model::CutterClass::kEndmill) return c.pocket;
    return 0;
  }
};

TEST_P(ToolsOfAllStages, EachCutterOfTheAnswerIsALineOfTheTable) {
  const auto [stage, what] = GetParam();
  const int tool = touched();
  ASSERT_NE(tool, 0);
  std::string table = whole().table;
  const double mm_per_unit = what == What::kInch ? kMmPerInch : 1.0;
  if (what == What::kMissing) table = without(table, tool) + kOtherMills;
  if (what == What::kWorn) table = with(table, tool, "D", -kWornMm);
  if (what == What::kShort) table = with(table, tool, "Z", -kShorterMm);
  if (what == What::kInch) table = in_inches(table);
  ASSERT_NE(table, whole().table);
  pipeline::Inputs in = shop({});
  const std::string path = testing::scratch_file("stages.tbl");
  std::ofstream(path) << table;
  Job job;
  auto library =
      tooling::load_library(path, job, {.mm_per_unit = mm_per_unit, .offsets_against_reference = {}});
  ASSERT_TRUE(library) << to_text(library.error());
  in.library = *std::move(library);

  LatePolicy policy{.deadline = std::nullopt};
  policy.budget = policy.fallback_budget;  // no improvement
  const auto bound = bind(as_far_as(stage), in, policy, job);
  if (!bound) {
    // Other mills are there for one that is missing; only one that is too short may leave nothing that
    // reaches.
    EXPECT_EQ(what, What::kShort) << to_text(bound.error());
    EXPECT_TRUE(bound.error().code == "LATE-OPEN" || bound.error().code == "LATE-UNSAFE")
        << to_text(bound.error());
    return;
  }
  EXPECT_TRUE(bound->condemned.empty());
  const std::map<int, Row> rows = rows_of(table, mm_per_unit);
  ASSERT_FALSE(bound->plan.steps.empty());
  for (const model::StepResult& step : bound->plan.steps) {
    const model::Cutter* c = model::find_cutter(bound->plan, step.cutter_id);
    ASSERT_NE(c, nullptr);
    const auto row = rows.find(c->pocket);
    ASSERT_NE(row, rows.end()) << "T" << c->pocket << " is not in the table";
    EXPECT_NEAR(c->cutting_diameter_mm, row->second.diameter_mm, kSameMm);
    EXPECT_NEAR(c->functional_length_mm, row->second.z_mm, kSameMm);
    ASSERT_TRUE(c->table_line);
  }
  const std::string program =
      pipeline::write_plan(bound->plan, pipeline::Format::kLinuxCnc, job).value_or("");
  ASSERT_FALSE(program.empty());
  std::size_t calls = 0;
  for (std::size_t at = 0; (at = program.find("\nT", at)) != std::string::npos; ++at, ++calls)
    EXPECT_TRUE(rows.contains(std::stoi(program.substr(at + 2)))) << program.substr(at + 1, 20);
  EXPECT_GT(calls, 0U);
  if (what == What::kMissing) {
    EXPECT_FALSE(bound->kept);
  }
}

std::string name_of(const ::testing::TestParamInfo<Case>& info) {
  static constexpr const char* kStages[] = {"Paths", "Tools", "Strategy"};
  static constexpr const char* kWhats[] = {"Missing", "Worn", "Short", "Inch"};
  return std::string(kStages[static_cast<int>(info.param.first)]) +
         kWhats[static_cast<int>(info.param.second)];
}

INSTANTIATE_TEST_SUITE_P(
    Late, ToolsOfAllStages,
    ::testing::Values(Case{Stage::kPaths, What::kMissing}, Case{Stage::kPaths, What::kWorn},
                      Case{Stage::kPaths, What::kShort}, Case{Stage::kPaths, What::kInch},
                      Case{Stage::kTools, What::kMissing}, Case{Stage::kTools, What::kWorn},
                      Case{Stage::kTools, What::kShort}, Case{Stage::kTools, What::kInch},
                      Case{Stage::kStrategy, What::kMissing}, Case{Stage::kStrategy, What::kWorn},
                      Case{Stage::kStrategy, What::kShort}, Case{Stage::kStrategy, What::kInch}),
    name_of);

}  // namespace
}  // namespace capstan::late
