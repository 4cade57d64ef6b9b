#include "rules/rules.h"

namespace capstan::rules {
namespace {
TEST(ShippedRules, HaveNoGapContradictionDeadRowOrIncapableChain) {
  Job job;
  const auto base = load_rules("", job);
  ASSERT_TRUE(base) << to_text(base.error());
  for (const auto& finding : check(*base)) ADD_FAILURE() << finding.text();
}

bool same(const Row& a, const Row& b) {
  return a.id == b.id && a.priority == b.priority && a.when == b.when && a.conditional == b.conditional &&
         a.concludes_as(b) && a.text == b.text && a.source == b.source && a.file == b.file &&
         a.line == b.line;
}
bool same(const Capability& a, const Capability& b) {
  return a.action == b.action && a.finest_grade == b.finest_grade && a.finest_ra_um == b.finest_ra_um &&
         a.position_mm == b.position_mm && a.form_mm == b.form_mm && a.source == b.source;
}

TEST(ShippedRules, CompiledInAreWhatTheReaderOfYamlGives) {
  Job job;
  const auto compiled = load_rules("", job);
  const auto read = rules_from_texts(shipped_texts());
  ASSERT_TRUE(compiled) << to_text(compiled.error());
  ASSERT_TRUE(read) << to_text(read.error());
  ASSERT_EQ(compiled->tables.size(), read->tables.size());
  for (std::size_t t = 0; t < read->tables.size(); ++t) {
    const Table& a = compiled->tables[t];
    const Table& b = read->tables[t];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.facts, b.facts) << b.name;
    EXPECT_EQ(a.file, b.file) << b.name;
    ASSERT_EQ(a.rows.size(), b.rows.size()) << b.name;
    for (std::size_t r = 0; r < b.rows.size(); ++r) EXPECT_TRUE(same(a.rows[r], b.rows[r])) << b.rows[r].id;
  }
  ASSERT_EQ(compiled->capabilities.size(), read->capabilities.size());
  for (std::size_t c = 0; c < read->capabilities.size(); ++c)
    EXPECT_TRUE(same(compiled->capabilities[c], read->capabilities[c])) << read->capabilities[c].action;
}

TEST(UsersRules, ReadAliasesAndRefuseThoseThatNeverEnd) {
  const std::string table = "table: t\nfacts: [diameter_mm]\nrows:\n";
  const std::string row = "- {id: a, source: &s mine, cannot: *s}\n";
  const auto aliased = rules_from_texts({{"mine.yaml", table + row}});
  ASSERT_TRUE(aliased) << to_text(aliased.error());
  EXPECT_EQ(aliased->tables.front().rows.front().cannot, "mine");
  const auto endless = rules_from_texts({{"mine.yaml", table + row + "more: &m [*m]\n"}});
  ASSERT_FALSE(endless);
  EXPECT_EQ(endless.error().code, "RULE-SYNTAX");
}
}  // namespace
}  // namespace capstan::rules
