#include "planner/ground/base/tables/data_tree.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace capstan {
namespace {

DataNode scalar(std::string text, std::uint64_t line) {
  return {.kind = DataNode::Kind::kScalar, .text = std::move(text), .line = line};
}

/// Two documents with every kind of node, a text with each byte, and lines that take one, two and ten bytes.
std::vector<DataNode> documents() {
  std::string bytes;
  for (int b = 0; b < 256; ++b) bytes += static_cast<char>(b);
  DataNode list{.kind = DataNode::Kind::kList, .line = 128};
  list.items = {scalar(bytes, 1), DataNode{.line = ~std::uint64_t{0}}, scalar("", 127)};
  DataNode map{.kind = DataNode::Kind::kMap, .line = 300};
  map.entries = {{"z", list}, {"a", scalar(std::string(1000, 'x'), 2)}, {"", DataNode{}}};
  return {map, scalar("second", 9)};
}

TEST(PackedData, GivesBackWhatWasPacked) { EXPECT_EQ(unpack(pack(documents())), documents()); }

TEST(PackedData, KnowsEachChangeOfAValueAndOfALine) {
  auto changed = documents();
  changed[0].entries[1].second.text.back() = 'y';
  EXPECT_NE(pack(changed), pack(documents()));
  changed = documents();
  changed[1].line = 10;
  EXPECT_NE(pack(changed), pack(documents()));
}

TEST(PackedData, RefusesEachTextThatIsCutOff) {
  const std::string whole = pack(documents());
  for (std::size_t n = 0; n < whole.size(); ++n)
    EXPECT_THROW((void)unpack(std::string_view(whole).substr(0, n)), std::logic_error) << n;
}

TEST(DataNode, FindsTheFirstEntryOfAKey) {
  DataNode map{.kind = DataNode::Kind::kMap};
  map.entries = {{"a", scalar("1", 1)}, {"b", scalar("2", 2)}, {"a", scalar("3", 3)}};
  ASSERT_NE(map.find("a"), nullptr);
  EXPECT_EQ(map.find("a")->text, "1");
  EXPECT_EQ(map.find("c"), nullptr);
}

}  // namespace
}  // namespace capstan
