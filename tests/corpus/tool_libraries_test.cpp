#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>

#include "tests/corpus/session.h"
#include "tests/support/corpus.h"
#include "tests/support/soak.h"
#include "tooling/library/formats/import.h"

// Real parts with the libraries that people really have: a plan that nothing is found against, or a list of
// what is missing, never a plan that breaks a tool.

namespace capstan::corpus {
namespace {

namespace fs = std::filesystem;

/// Every library of the corpus that can be read, folders of FreeCAD as one.
std::vector<std::string> importable(const std::string& root) {
  std::vector<std::string> all = {root + "/freecad"};
  for (const char* folder : {"fusion", "linuxcnc", "iso13399", "din4000"}) {
    for (const auto& f : fs::directory_iterator(root + "/" + folder)) {
      if (f.is_regular_file()) all.push_back(f.path().string());
    }
  }
  std::sort(all.begin(), all.end());
  std::erase_if(all, [](const std::string& path) {
    Job job;
    return !tooling::import_library(path, {}, job).has_value();
  });
  return all;
}

void expect_a_sound_plan_or_a_list(const std::string& part, const std::string& tools) {
  Job job;
  pipeline::ShopFiles files;
  files.tools = tools;
  auto shop = pipeline::load_shop(files, job);
  if (!shop) return;  // holders or probes alone: said, and the command ends with 3
  auto plan = pipeline::read_plan(capstan::testing::slurp(part), fs::path(part).filename().string(), job);
  ASSERT_TRUE(plan) << to_text(plan.error());
  pipeline::Policy policy;
  policy.reopen = Reopen::kAll;
  const auto checked = pipeline::bind_checked(*plan, *shop, policy, job);
  ASSERT_TRUE(checked) << to_text(checked.error());
  const model::Plan* bound = &checked->plan;
  EXPECT_TRUE(!bound->steps.empty() || !bound->unplanned.empty());
  for (const auto& u : bound->unplanned) {
    EXPECT_TRUE(u.reason.find(" would") != std::string::npos || u.reason.find(':') != std::string::npos)
        << u.reason;
  }
  for (const auto& f : pipeline::findings_of(*checked, job)) {
    EXPECT_NE(f.severity, Severity::kError) << f.code << ": " << f.message;
  }
  for (const auto& s : bound->steps) {
    EXPECT_GT(s.feed_mm_min, 0.0) << s.cutter_id;
    EXPECT_GT(s.fz_mm, 0.0) << s.cutter_id;
  }
}

/// Every sixth library, another sixth for each part; where tests are repeated (./dev soak), the one that the
/// seed names, so that repetitions go through all of them.
bool in_sample(std::size_t number, std::size_t count, std::size_t part) {
  if (!soaking()) return number % 6 == part;
  return number == static_cast<std::size_t>(::testing::UnitTest::GetInstance()->random_seed()) % count;
}

TEST(CorpusRandomToolLibraries, TheBracketWithThemIsASoundPlanOrAListOfWhatIsMissing) {
  CAPSTAN_CORPUS_FILE(root, "tools");
  const auto libraries = importable(root);
  EXPECT_GE(libraries.size(), 20U);
  for (std::size_t i = 0; i < libraries.size(); ++i) {
    if (!in_sample(i, libraries.size(), 0)) continue;
    SCOPED_TRACE(libraries[i]);
    expect_a_sound_plan_or_a_list(capstan::testing::source_dir() + "/examples/bracket.p21", libraries[i]);
  }
}

TEST(CorpusRandomToolLibraries, ARealPartWithThemIsASoundPlanOrAListOfWhatIsMissing) {
  CAPSTAN_CORPUS_FILE(root, "tools");
  CAPSTAN_CORPUS_FILE(part, "iso14649/nist_ex1.stp");
  const auto libraries = importable(root);
  for (std::size_t i = 0; i < libraries.size(); ++i) {
    if (!in_sample(i, libraries.size(), 1)) continue;
    SCOPED_TRACE(libraries[i]);
    expect_a_sound_plan_or_a_list(part, libraries[i]);
  }
}

}  // namespace
}  // namespace capstan::corpus
