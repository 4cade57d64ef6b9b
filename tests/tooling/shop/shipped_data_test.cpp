#include <gtest/gtest.h>

#include "tooling/shop/data/data.h"

namespace capstan::tooling {
namespace {

TEST(ShippedData, CompiledInIsWhatTheReaderOfYamlGivesForEachFile) {
  ASSERT_FALSE(embedded_names().empty());
  for (const std::string_view name : embedded_names()) {
    const auto parsed = parse_documents(embedded_file(name), std::string(name));
    ASSERT_TRUE(parsed) << name << ": " << to_text(parsed.error());
    EXPECT_EQ(unpack(embedded_tree(name)), *parsed) << name;
    EXPECT_EQ(shipped_tree(name).value(), parsed->front()) << name;
  }
}

TEST(ShippedData, OfNoSuchFileIsEmpty) {
  EXPECT_EQ(shipped_tree("no_such_file.yaml").value(), Node{});
  EXPECT_EQ(embedded_tree("no_such_file.yaml").data(), nullptr);
}

}  // namespace
}  // namespace capstan::tooling
