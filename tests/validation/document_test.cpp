#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <vector>

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

/// The cells of the rows of a table of the document, by the words of its head.
std::vector<std::map<std::string, std::string>> rows_of(const std::string& text, const std::string& first) {
  const auto cells = [](const std::string& line) {
    std::vector<std::string> out;
    std::istringstream in(line.substr(1));
    for (std::string cell; std::getline(in, cell, '|');) {
      const std::size_t from = cell.find_first_not_of(' '), to = cell.find_last_not_of(' ');
      out.push_back(from == std::string::npos ? "" : cell.substr(from, to - from + 1));
    }
    return out;
  };
  std::vector<std::map<std::string, std::string>> out;
  std::vector<std::string> head;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("|")) {
      head.clear();
    } else if (line.starts_with("| " + first + " |") && out.empty()) {
      head = cells(line);
    } else if (!head.empty() && !line.starts_with("|--")) {
      const auto row = cells(line);
      for (std::size_t i = 0; i < std::min(head.size(), row.size()); ++i) {
        if (i == 0) out.emplace_back();
        out.back()[head[i]] = row[i];
      }
    }
  }
  return out;
}

// The document's figures are those that are computed (above); these are the aims.
TEST(Document, ShowsEveryPartWithinItsAimAgainstAShopAndNothingThatTheCheckCondemns) {
  const auto parts = rows_of(standing(document(), "productivity"), "part");
  int aimed = 0;
  for (auto part : parts) {
    const std::string name = part["part"] + ", " + part["material"];
    EXPECT_EQ(part["errors"], "0") << name;
    EXPECT_EQ(part["not planned"], "0") << name;
    if (part["ratio"] == "-") continue;
    const double ratio = std::stod(part["ratio"]), aim = std::stod(part["aim"]);
    // The one that misses, which the judgement names: when it no longer does, this is to go.
    if (name == "nist_ex1.stp, re-opened, tool_steel") {
      EXPECT_GT(ratio, aim) << name;
      continue;
    }
    EXPECT_LE(ratio, aim) << name;
    ++aimed;
  }
  EXPECT_GE(aimed, 11);
}

TEST(Document, ShowsRoughingThatIsNotSlowerThanFreeCadsPathsAtEqualLimits) {
  const auto cuts = rows_of(standing(document(), "freecad"), "part");
  ASSERT_EQ(cuts.size(), 12u);  // two parts, two depths, three materials
  for (auto cut : cuts) {
    for (const char* rival :
         {"pocket, one feed", "adaptive, one feed", "pocket, our feeds", "adaptive, our feeds"}) {
      const std::string& cell = cut[rival];
      const std::size_t at = cell.find('(');
      ASSERT_NE(at, std::string::npos) << rival << ": " << cell;
      EXPECT_LE(std::stod(cell.substr(at + 1)), 1.0)
          << cut["part"] << ", " << cut["material"] << ": " << rival;
    }
  }
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
