#include <gtest/gtest.h>

#include <string>

#include "tests/support/corpus.h"
#include "tests/support/shop.h"
#include "tests/validation/comparisons.h"

namespace capstan::validation {
namespace {

std::string document() { return testing::slurp(capstan::testing::source_dir() + "/docs/validation.md"); }

// One test, for all are computed together; of those that plan many parts a sample, since ./dev validate
// computes all of them.
TEST(Document, HasAPlaceForEachComparisonAndSaysTheFiguresThatAreComputed) {
  const std::string text = document();
  std::string skipped;
  for (const Comparison& c : all_comparisons(testing::corpus_folder(), Extent::kSample)) {
    EXPECT_NE(text.find("<!-- begin " + c.name + " -->"), std::string::npos) << c.name;
    EXPECT_NE(text.find("<!-- end " + c.name + " -->"), std::string::npos) << c.name;
    if (!c.skipped.empty()) {
      skipped += c.name + " (" + c.skipped + ") ";
      continue;
    }
    const std::string stands = standing(text, c.name);
    for (const std::string& line : c.lines)
      EXPECT_NE(stands.find("\n" + line), std::string::npos)
          << c.name << ": run ./dev validate; now " << line;
    if (c.lines.empty()) {
      EXPECT_EQ(stands, c.text) << c.name << ": run ./dev validate";
    }
  }
  if (!skipped.empty()) GTEST_SKIP() << "not checked: " << skipped;
}

TEST(Document, IsQuotedByTheReadmeAsItStands) {
  const std::string readme = testing::slurp(capstan::testing::source_dir() + "/README.md");
  EXPECT_FALSE(standing(readme, "summary").empty());
  EXPECT_EQ(standing(readme, "summary"), standing(document(), "summary")) << "run ./dev validate";
}

TEST(Document, ShowsPicturesThatAreThere) {
  constexpr std::size_t kLargest = 60000;  // bytes, of a drawn path
  for (const std::string name : {"validation", "strategies"}) {
    const std::string folder = capstan::testing::source_dir() + "/docs/",
                      text = testing::slurp(folder + name + ".md");
    std::size_t at = 0;
    int pictures = 0;
    while ((at = text.find("](" + name + "/", at)) != std::string::npos) {
      at += 2;
      const std::string file = text.substr(at, text.find(')', at) - at),
                        picture = testing::slurp(folder + file);
      EXPECT_FALSE(picture.empty()) << file;
      if (name == "strategies") {
        EXPECT_LT(picture.size(), kLargest) << file;
      }
      ++pictures;
    }
    EXPECT_GT(pictures, 0) << name;
  }
}

TEST(Document, OfStrategiesShowsPartsThatArePlannedWhole) {
  Job job;
  const auto shop = pipeline::load_shop({}, job);
  ASSERT_TRUE(shop) << to_text(shop.error());
  for (const char* name : {"strategies", "outside"}) {
    const std::string file = capstan::testing::source_dir() + "/docs/strategies/" + name + ".p21";
    const auto read = pipeline::read_plan(testing::slurp(file), file, job);
    ASSERT_TRUE(read) << to_text(read.error());
    const auto made = pipeline::bind_checked(*read, *shop, {}, job);
    ASSERT_TRUE(made) << to_text(made.error());
    EXPECT_TRUE(made->plan.unplanned.empty()) << name << ": " << made->plan.unplanned.front().reason;
    for (const auto& f : made->findings) EXPECT_NE(f.severity, Severity::kError) << name << ": " << f.message;
  }
}

TEST(Document, OfStrategiesShowsAHighFeedMillAndADrillWithInsertsAtWork) {
  Job job;
  const std::string folder = capstan::testing::source_dir() + "/docs/strategies/";
  const auto shop = pipeline::load_shop({"", folder + "leaning_tools.yaml", "", ""}, job);
  ASSERT_TRUE(shop) << to_text(shop.error());
  const auto read = pipeline::read_plan(testing::slurp(folder + "leaning.p21"), "leaning.p21", job);
  ASSERT_TRUE(read) << to_text(read.error());
  const auto made = pipeline::bind_checked(*read, *shop, {}, job);
  ASSERT_TRUE(made) << to_text(made.error());
  EXPECT_TRUE(made->plan.unplanned.empty());
  for (const auto& f : made->findings) EXPECT_NE(f.severity, Severity::kError) << f.message;
  std::vector<std::string> tools;
  for (const auto& s : made->plan.steps) tools.push_back(s.cutter_id);
  EXPECT_EQ(tools, (std::vector<std::string>{"high_feed_mill", "face_mill_45", "drill_insert"}));
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
