#include "rules/rules.h"

namespace capstan::rules {
namespace {
TEST(ShippedRules, HaveNoGapContradictionDeadRowOrIncapableChain) {
  Job job;
  const auto base = load_rules("", job);
  ASSERT_TRUE(base) << to_text(base.error());
  for (const auto& finding : check(*base)) ADD_FAILURE() << finding.text();
}
}  // namespace
}  // namespace capstan::rules
