#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/corpus.h"
#include "tests/support/differences/plan_difference.h"
#include "tests/support/shop.h"
#include "tests/support/soak.h"

// A plan in each form that it is written in, read again, is the plan that was written.

namespace capstan::pipeline {
namespace {

struct Form {
  Format format;
  const char* ending;
};
constexpr Form kForms[] = {{Format::kJson, ".json"}, {Format::kIso14649, ".p21"}, {Format::kAp238, ".stpnc"}};

const Inputs& shop() {
  static const Inputs one = [] {
    Job job;
    return load_shop({}, job).value();
  }();
  return one;
}

/// What a reader says of a file that nobody edited: nothing of records that are malformed or edited.
std::string said_of_records(const Job& job) {
  std::string out;
  for (const Diagnostic& d : job.diagnostics()) {
    if (d.code == "EXC-RECORD" || d.code == "EXC-EDITED" || d.severity == Severity::kError)
      out += to_text(d) + "\n";
  }
  return out;
}

std::vector<std::string> findings(const model::Plan& plan) {
  Job job;
  std::vector<std::string> out;
  for (const auto& f : findings_of(plan, job)) out.push_back(f.step + ": " + f.code + " " + f.message);
  std::sort(out.begin(), out.end());
  return out;
}

std::size_t moves_of(const model::Plan& plan) {
  std::size_t out = 0;
  for (const auto& s : plan.steps) out += s.path ? s.path->size() : 0;
  return out;
}

void expect_back(const std::string& path, Bind level, bool judged) {
  SCOPED_TRACE(path + ", bound to level " + std::to_string(static_cast<int>(level)));
  Job job;
  auto read = read_plan(testing::slurp(path), path, job);
  if (!read) return;  // what cannot be read has no plan
  Policy policy;
  policy.bind = level;
  const auto plan = bind(*std::move(read), shop(), policy, job);
  if (!plan) return;
  const auto expected = judged ? findings(*plan) : std::vector<std::string>{};
  for (const Form& form : kForms) {
    SCOPED_TRACE(form.ending);
    Job quiet, again;
    const auto text = write_plan(*plan, form.format, quiet);
    ASSERT_TRUE(text) << to_text(text.error());
    const auto back = read_plan(*text, std::string("plan") + form.ending, again);
    ASSERT_TRUE(back) << to_text(back.error());
    EXPECT_EQ(said_of_records(again), "");
    testing::DifferenceOptions options;
    options.item_names = form.format != Format::kAp238;
    const testing::PlanDifference difference(*plan, *back, options);
    EXPECT_EQ(difference.text(), "");
    if (judged) {
      EXPECT_EQ(findings(*back), expected);
      // As many moves as the plan has: checking costs the same whatever form it was read from.
      EXPECT_EQ(moves_of(*back), moves_of(*plan));
    }
  }
}

class EachForm : public ::testing::TestWithParam<const char*> {};

TEST_P(EachForm, ReadsBackAsThePlanThatWasWritten) {
  const std::string path = capstan::testing::source_dir() + "/" + GetParam();
  expect_back(path, Bind::kAll, true);
  expect_back(path, Bind::kStrategy, false);
  expect_back(path, Bind::kTools, false);
}

INSTANTIATE_TEST_SUITE_P(WrittenPlan, EachForm,
                         ::testing::Values("examples/bracket.p21", "examples/plate_bound.p21",
                                           "examples/reference_pocket.p21", "examples/two_setups.p21",
                                           "docs/strategies/thread.p21",
                                           "tests/door/pipeline/parts/form_features.p21",
                                           "tests/door/pipeline/parts/far_ends.p21"),
                         [](const auto& which) {
                           std::string name = std::filesystem::path(which.param).stem().string();
                           std::erase_if(name,
                                         [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
                           return name;
                         });

// File by file of the whole corpus in the soak, what takes a few seconds otherwise.
TEST(CorpusEachFormOfRandomFiles, ReadsBackAsThePlanThatWasWritten) {
  const std::string corpus = testing::corpus_folder();
  if (corpus.empty()) GTEST_SKIP() << "corpus is absent";
  std::vector<std::string> files;
  if (soaking()) {
    for (const char* folder : {"/iso14649", "/ap238", "/cad"}) {
      for (const auto& e : std::filesystem::directory_iterator(corpus + folder)) {
        if (e.is_regular_file()) files.push_back(e.path().string());
      }
    }
    std::sort(files.begin(), files.end());
    // One at each of the 50 repetitions.
    if (files.empty()) GTEST_SKIP() << "corpus is empty";
    const auto turn = static_cast<std::size_t>(::testing::UnitTest::GetInstance()->random_seed());
    files = {files[turn % files.size()]};
  } else {
    for (const char* file :
         {"/iso14649/fdis_ex2.p21", "/iso14649/meduag_furo.p21", "/iso14649/ufsc_FuroConico.p21",
          "/iso14649/ufsc_RanhuraPerfilVee.p21", "/iso14649/nist_tiny.stp"})
      files.push_back(corpus + file);
  }
  for (const std::string& file : files) {
    expect_back(file, Bind::kAll, true);
    expect_back(file, Bind::kStrategy, false);
    expect_back(file, Bind::kTools, false);
  }
}

}  // namespace
}  // namespace capstan::pipeline
