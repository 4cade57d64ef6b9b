#include "planner/door/service/edits/edits_file.h"

#include <gtest/gtest.h>

#include "planner/model/plan/edit/edit.h"

namespace capstan::service {
namespace {

constexpr const char* kAll =
    "capstan_edits: 1\n"
    "edits:\n"
    "  - set: POCKET*/tool=T5\n"
    "  - pin: SLOT rough/feed=900\n"
    "  - limit: tool.diameter<=8\n"
    "  - forbid: operation=reaming\n"
    "  - set: HOLE*/cycles=explicit\n"
    "  - order: HOLE<POCKET\n";

TEST(EditsFile, IsReadWithTheNumberOfEachEditAndTheFilesName) {
  Job job;
  const auto edits = read_edits(kAll, "shop/part.edits.yaml", job);
  ASSERT_TRUE(edits) << to_text(edits.error());
  ASSERT_EQ(edits->size(), 6U);
  EXPECT_EQ(words_of(edits->front()), "edit 1 of part.edits.yaml: set POCKET*/tool=T5");
  EXPECT_EQ(words_of(edits->back()), "edit 6 of part.edits.yaml: order HOLE<POCKET");
}

TEST(EditsFile, MayBeJson) {
  Job job;
  const auto edits = read_edits(R"({"capstan_edits": 1, "edits": [{"limit": "feed<=2000"}]})", "e.json", job);
  ASSERT_TRUE(edits) << to_text(edits.error());
  EXPECT_EQ(edits->front().number, 2000.0);
}

TEST(EditsFile, ThatIsWrittenReadsBackAsTheSameEdits) {
  Job job;
  auto edits = read_edits(kAll, "part.edits.yaml", job);
  ASSERT_TRUE(edits);
  // What YAML would take for something else: quotes, a comment, a colon.
  for (const char* where : {"A \"B\"", "A\\B", "A: B", "A # B", "- A"}) {
    auto e = model::parse_edit(model::EditKind::kSet, std::string(where) + "/feed=100",
                               "edit " + std::to_string(edits->size() + 1) + " of part.edits.yaml");
    ASSERT_TRUE(e);
    edits->push_back(*e);
  }
  const std::string text = edits_text(*edits);
  const auto back = read_edits(text, "part.edits.yaml", job);
  ASSERT_TRUE(back) << to_text(back.error());
  EXPECT_EQ(*back, *edits);
  EXPECT_EQ(edits_text(*back), text);
  const auto none = read_edits(edits_text({}), "none.yaml", job);
  ASSERT_TRUE(none);
  EXPECT_TRUE(none->empty());
}

TEST(EditsFile, WithFaultsReportsEachWithItsLine) {
  Job job;
  const auto edits = read_edits(
      "capstan_edits: 1\nedits:\n  - set: POCKET/fed=5\n  - sett: POCKET/feed=5\n  - limit: feed<=x\n  - 7\n",
      "e.yaml", job);
  ASSERT_FALSE(edits);
  auto said = job.diagnostics();
  said.push_back(edits.error());  // the last is what ends it
  ASSERT_EQ(said.size(), 4U);
  for (std::size_t i = 0; i < said.size(); ++i) EXPECT_EQ(said[i].line, i + 3) << to_text(said[i]);
  EXPECT_EQ(said[0].code, "NAME-UNKNOWN");
  EXPECT_NE(said[1].message.find("'set'"), std::string::npos) << said[1].message;
}

TEST(EditsFile, OfAnotherShapeOrVersionIsRefused) {
  for (const char* bad :
       {"", "7", "edits: []", "capstan_edits: 2\nedits: []", "capstan_edits: 1\nedits: {a: b}",
        "capstan_edits: 1\nedits: []\nmore: 1", "[1, 2]"}) {
    Job job;
    const auto edits = read_edits(bad, "e.yaml", job);
    EXPECT_FALSE(edits) << bad;
  }
}

}  // namespace
}  // namespace capstan::service
