#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "planner/door/pipeline/pipeline.h"
#include "planner/files/exchange/exchange.h"
#include "planner/ground/base/file.h"
#include "planner/model/nouns/all.h"
#include "tests/support/corpus.h"
#include "tests/support/shop.h"

namespace capstan::exchange {
namespace {

#ifdef CAPSTAN_OCCT_SHAPES
#define NEEDS_OCCT(program) const std::string program = CAPSTAN_OCCT_SHAPES
#else
#define NEEDS_OCCT(program)       \
  const std::string program = ""; \
  GTEST_SKIP() << "OpenCASCADE is not installed or switched off"
#endif

// What the helper prints of a file.
std::string shapes(const std::string& program, const std::string& file) {
  std::string out;
  std::string command = program;
  command.append(" '").append(file).append("' 2>&1");
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return out;
  char buffer[512];
  while (std::fgets(buffer, sizeof buffer, pipe) != nullptr) {
    // The library's own messages are not of interest.
    const std::string line = buffer;
    for (const char* head : {"points ", "solids ", "volume ", "box ", "not read"}) {
      if (line.rfind(head, 0) == 0) out += line;
    }
  }
  EXPECT_EQ(pclose(pipe), 0) << out;
  return out;
}

std::string after(const std::string& text, const std::string& word) {
  const auto at = text.find(word);
  return at == std::string::npos ? "" : text.substr(at);
}

model::Plan read_whole(const std::string& path) {
  Job job;
  auto plan = read(path, job);
  EXPECT_TRUE(plan) << to_text(plan.error());
  return plan ? std::move(*plan) : model::Plan{};
}

std::string written_file(const model::Plan& plan, const testing::ScratchFolder& folder) {
  Job job;
  const auto out = write_ap238(plan, job);
  EXPECT_TRUE(out) << to_text(out.error());
  const std::string path = folder.file("written.stpnc");
  EXPECT_TRUE(out && write_file(path, out->bytes));
  return path;
}

std::size_t occurrences(const std::string& text, const std::string& word) {
  std::size_t n = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
  return n;
}

TEST(OpenCascade, SeesTheSameSolidsInAFileThatWasReadAndWrittenBack) {
  CAPSTAN_CORPUS_FILE(path, "ap238/ap238e4dis_annexJ_cc2.stp");
  NEEDS_OCCT(program);
  const testing::ScratchFolder folder;
  const std::string before = shapes(program, path),
                    back = shapes(program, written_file(read_whole(path), folder));
  EXPECT_NE(after(before, "solids "), "");
  EXPECT_EQ(before.find("solids 0"), std::string::npos) << before;
  EXPECT_EQ(after(back, "solids "), after(before, "solids "));
}

TEST(OpenCascade, KnowsEveryPointOfAPlanWithToolpaths) {
  NEEDS_OCCT(program);
  Job job;
  auto bytes = read_file(capstan::testing::source_dir() + "/examples/bracket.p21");
  ASSERT_TRUE(bytes);
  auto shop = pipeline::load_shop({}, job);
  auto part = pipeline::read_plan(std::move(*bytes), "bracket.p21", job);
  ASSERT_TRUE(shop && part);
  auto plan = pipeline::bind(*std::move(part), *shop, {}, job);
  ASSERT_TRUE(plan) << to_text(plan.error());
  const testing::ScratchFolder folder;
  const std::string path = written_file(*plan, folder);
  const std::string text = testing::slurp(path);
  // Via points are points of a kind that it does not know; it must read all others, and not stop at those.
  const std::size_t points = occurrences(text, "=CARTESIAN_POINT(");
  ASSERT_GT(points, 500u);
  std::string expected = std::to_string(points);
  expected.insert(0, "points ");
  EXPECT_EQ(shapes(program, path).substr(0, expected.size()), expected);
}

}  // namespace
}  // namespace capstan::exchange
