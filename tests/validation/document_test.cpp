#include <gtest/gtest.h>

#include <string>

#include "tests/support/corpus.h"
#include "tests/validation/comparisons.h"

namespace capstan::validation {
namespace {

std::string document() { return testing::slurp(capstan::testing::source_dir() + "/docs/validation.md"); }

// One test, for each runs in a process of its own, and all of them are computed in it.
TEST(Document, HasAPlaceForEachComparisonAndSaysTheFiguresThatAreComputed) {
  const std::string text = document();
  std::string skipped;
  for (const Comparison& c : all_comparisons(testing::corpus_folder())) {
    EXPECT_NE(text.find("<!-- begin " + c.name + " -->"), std::string::npos) << c.name;
    EXPECT_NE(text.find("<!-- end " + c.name + " -->"), std::string::npos) << c.name;
    if (!c.skipped.empty()) {
      skipped += c.name + " (" + c.skipped + ") ";
      continue;
    }
    EXPECT_EQ(standing(text, c.name), c.text) << c.name << ": run ./dev validate";
  }
  if (!skipped.empty()) GTEST_SKIP() << "not checked: " << skipped;
}

TEST(Document, IsQuotedByTheReadmeAsItStands) {
  const std::string readme = testing::slurp(capstan::testing::source_dir() + "/README.md");
  EXPECT_FALSE(standing(readme, "summary").empty());
  EXPECT_EQ(standing(readme, "summary"), standing(document(), "summary")) << "run ./dev validate";
}

TEST(Document, ShowsPicturesThatAreThere) {
  const std::string text = document();
  std::size_t at = 0;
  int pictures = 0;
  while ((at = text.find("](validation/", at)) != std::string::npos) {
    at += 2;
    const std::string file = text.substr(at, text.find(')', at) - at);
    EXPECT_FALSE(testing::slurp(capstan::testing::source_dir() + "/docs/" + file).empty()) << file;
    ++pictures;
  }
  EXPECT_GT(pictures, 0);
}

TEST(Document, IsRenewedBetweenItsMarkersOnly) {
  const std::string before = "a\n<!-- begin x -->\nold\n<!-- end x -->\nb\n";
  const Comparison c{.name = "x", .text = "new\n"};
  const std::string after = renewed(before, c);
  EXPECT_EQ(after, "a\n<!-- begin x -->\nnew\n<!-- end x -->\nb\n");
  EXPECT_EQ(standing(after, "x"), "new\n");
  EXPECT_EQ(renewed("no place", c), "");
}

}  // namespace
}  // namespace capstan::validation
