#include <algorithm>
#include <filesystem>

#include "planner/files/p21/print.h"
#include "planner/files/p21/read/parse.h"
#include "tests/support/amplify.h"
#include "tests/support/corpus.h"

namespace capstan::p21 {
namespace {

std::vector<std::string> part21_files(const std::string& folder) {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    std::string extension = entry.path().extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    for (const char* known : {".stp", ".step", ".p21", ".stpnc", ".238"}) {
      if (extension == known) paths.push_back(entry.path().string());
    }
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

TEST(Corpus, EveryFileReadsAndComesBackFromPrintingUnchanged) {
  if (testing::corpus_folder().empty()) GTEST_SKIP() << "corpus is absent";
  std::size_t files = 0;
  for (const std::string& path : part21_files(testing::corpus_folder())) {
    SCOPED_TRACE(path);
    Job job;
    const auto first = parse(testing::slurp(path), path, {}, job);
    if (!first) {
      ADD_FAILURE() << to_text(first.error());
      continue;
    }
    ++files;
    const std::string printed = print(*first);
    Job quiet;
    const auto second = parse(printed, path, {}, quiet);
    ASSERT_TRUE(second) << to_text(second.error());
    EXPECT_LE(quiet.diagnostics().size(), job.diagnostics().size());
    EXPECT_TRUE(same_content(*first, *second));
    EXPECT_EQ(print(*second), printed);
  }
  EXPECT_GE(files, 20U);
}

TEST(Corpus, TheStandardsExampleHangsTogether) {
  CAPSTAN_CORPUS_FILE(path, "iso14649/nist_ex1.stp");
  Job job;
  const auto file = parse(testing::slurp(path), path, {}, job);
  ASSERT_TRUE(file) << to_text(file.error());
  EXPECT_EQ(file->find(1)->keyword(), "PROJECT");
  EXPECT_EQ(file->schemas(), (std::vector<std::string>{"MACHINING_SCHEMA", "MILLING_SCHEMA"}));
  EXPECT_EQ(check_references(*file, job), 0U);
  EXPECT_TRUE(job.diagnostics().empty());
}

// As its origin says: "edition-3 anchors, two dangling references".
TEST(Corpus, TheEdition3FileHasItsAnchorsAndTwoDanglingReferences) {
  CAPSTAN_CORPUS_FILE(path, "ap238/exp2_stepnc_maker3_empty_ed3anchors.stpnc");
  Job job;
  const auto file = parse(testing::slurp(path), path, {}, job);
  ASSERT_TRUE(file) << to_text(file.error());
  ASSERT_EQ(file->verbatim_sections().size(), 1U);
  EXPECT_EQ(file->verbatim_sections()[0].keyword, "ANCHOR");
  EXPECT_EQ(check_references(*file, job), 2U);
}

// What the benchmark reads is a file like any other.
TEST(Corpus, AnAmplifiedFileHangsTogetherAndHasAboutTheSizeAskedFor) {
  CAPSTAN_CORPUS_FILE(path, "iso14649/nist_ex1E.stp");
  constexpr std::size_t kAsked = 2'000'000;
  const std::string bytes = testing::amplify_part21(testing::slurp(path), kAsked);
  EXPECT_NEAR(static_cast<double>(bytes.size()), kAsked, 0.1 * kAsked);
  Job job;
  const auto file = parse(bytes, path, {}, job);
  ASSERT_TRUE(file) << to_text(file.error());
  EXPECT_EQ(check_references(*file, job), 0U);
  EXPECT_TRUE(job.diagnostics().empty());
}

}  // namespace
}  // namespace capstan::p21
