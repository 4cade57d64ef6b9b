#include "planner/ground/memo/memo.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "planner/door/pipeline/pipeline.h"
#include "tests/support/corpus.h"
#include "tests/support/plate.h"
#include "tests/support/scratch.h"
#include "tests/support/shop.h"

// A plan is the same with a memo and without, and a change re-runs what depends on it: counted, never timed.

namespace capstan::pipeline {
namespace {

using memo::Memo;
using memo::Stage;

constexpr Stage kOfSteps[] = {Stage::kPath, Stage::kSections, Stage::kFeeds};

/// All forms of a plan of this text, one after the other.
std::string planned(const std::string& text, Inputs inputs, std::shared_ptr<Memo> memo) {
  Job job;
  auto plan = read_plan(text, "part.p21", job);
  EXPECT_TRUE(plan) << (plan ? "" : to_text(plan.error()));
  if (!plan) return {};
  inputs.memo = std::move(memo);
  auto made = bind_checked(*plan, inputs, {}, job);
  EXPECT_TRUE(made) << (made ? "" : to_text(made.error()));
  if (!made) return {};
  std::string out;
  for (const Format f : {Format::kJson, Format::kLinuxCnc, Format::kToolTable, Format::kAp238}) {
    auto written = write_plan(made->plan, f, job);
    EXPECT_TRUE(written) << (written ? "" : to_text(written.error()));
    if (written) out += *written;
  }
  for (const auto& d : job.diagnostics()) out += to_text(d) + "\n";
  return out;
}

Inputs shop() {
  Job job;
  auto in = load_shop({}, job);
  EXPECT_TRUE(in) << (in ? "" : to_text(in.error()));
  return in ? *std::move(in) : Inputs{};
}

std::size_t made(const Memo& m, Stage s) { return m.counts(s).made; }

TEST(PlannedWithAMemo, IsTheSameToTheByte) {
  for (const char* name : {"bracket.p21", "two_setups.p21", "reference_pocket.p21", "surface.stl"}) {
    const std::string text = testing::slurp(testing::source_dir() + "/examples/" + name);
    Inputs in = shop();
    in.material_name = "EN AW-6061";
    const std::string folder = capstan::testing::scratch_file("memo_planned");
    std::filesystem::remove_all(folder);
    const auto without = planned(text, in, std::make_shared<Memo>(0));
    const auto kept = Memo::in_folder(folder);
    ASSERT_TRUE(kept);
    EXPECT_EQ(planned(text, in, *kept), without) << name << ", first";
    const auto again = Memo::in_folder(folder);
    ASSERT_TRUE(again);
    EXPECT_EQ(planned(text, in, *again), without) << name << ", from the folder";
    for (const Stage s : kOfSteps)
      EXPECT_EQ(made(**again, s), 0U) << name << ", stage " << static_cast<int>(s);
    std::filesystem::remove_all(folder);
  }
}

TEST(PlannedWithAMemo, AChangedFeatureIsMadeAnewAndNoOther) {
  const Inputs in = shop();
  const auto memo = std::make_shared<Memo>();
  const auto plate = testing::plate(24);
  const auto& text = plate.text;
  (void)planned(text, in, memo);
  std::map<Stage, std::size_t> before;
  for (const Stage s : kOfSteps) before[s] = made(*memo, s);
  // Drills and reamers are measured on cells, which lie otherwise about each hole.
  ASSERT_GT(before[Stage::kSections], plate.holes);
  EXPECT_LE(before[Stage::kSections], plate.holes + 2 * plate.dowel_holes + 3)
      << "one pocket's roughing both ways and its finishing, for all equal pockets";

  (void)planned(text, in, memo);
  for (const Stage s : kOfSteps) EXPECT_EQ(made(*memo, s), before[s]) << "nothing changed, nothing is made";

  const auto other = testing::plate(24, 3.5).text;
  ASSERT_NE(other, text);
  EXPECT_EQ(planned(other, in, memo), planned(other, in, std::make_shared<Memo>(0)));
  for (const Stage s : kOfSteps) {
    const std::size_t anew = made(*memo, s) - before[s];
    EXPECT_GE(anew, 1U) << "stage " << static_cast<int>(s);
    // The changed pocket was the first of the equal ones, for which both ways of roughing are tried: the next
    // one, which had the better way alone, now gets the path of the other, too.
    EXPECT_LE(anew, s == Stage::kPath ? 4U : 3U)
        << "stage " << static_cast<int>(s) << ": the pocket's roughing both ways and its finishing, no more";
  }
}

TEST(PlannedWithAMemo, AnotherMaterialMakesFeedsAnewAndNotSections) {
  Inputs in = shop();
  const auto memo = std::make_shared<Memo>();
  const auto text = testing::plate(8).text;
  (void)planned(text, in, memo);
  const std::size_t feeds = made(*memo, Stage::kFeeds), paths = made(*memo, Stage::kPath);
  in.material_name = "42CrMo4";
  EXPECT_EQ(planned(text, in, memo), planned(text, in, std::make_shared<Memo>(0)));
  EXPECT_GT(made(*memo, Stage::kFeeds), feeds);
  EXPECT_LT(made(*memo, Stage::kPath) - paths, paths) << "holes are drilled along the same paths";
}

}  // namespace
}  // namespace capstan::pipeline
