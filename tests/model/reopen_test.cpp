#include <gtest/gtest.h>

#include <string>

#include "planner/model/nouns/all.h"
#include "planner/model/plan/decision/reopen_all.h"

namespace capstan::model {
namespace {

/// A chain of decisions, each on the one before; every fifth is pinned.
Ledger chain(Model& m, std::vector<AnyRef>& objects, std::size_t n) {
  Ledger out;
  for (std::size_t i = 0; i < n; ++i) {
    objects.push_back(m.add(Workplan{}));
    Decision d;
    d.pinned = i % 5 == 4;
    if (i > 0) d.depends_on = {{objects[i - 1], "its_id"}};
    out.set({objects[i], "its_id"}, std::move(d));
  }
  return out;
}

TEST(LedgerReopenAll, OpensWhatReopeningOneByOneOpens) {
  Model m;
  std::vector<AnyRef> objects;
  Ledger one = chain(m, objects, 12), all = one;
  const std::vector<DecisionKey> keys = {
      {objects[1], "its_id"}, {objects[4], "its_id"}, {objects[10], "its_id"}, {objects[0], "its_setup"}};
  for (const DecisionKey& k : keys) (void)one.reopen(k);
  reopen_all(all, keys);
  for (const AnyRef o : objects) EXPECT_EQ(all.is_open(o, "its_id"), one.is_open(o, "its_id")) << o.index;
  EXPECT_TRUE(all.is_open(objects[3], "its_id"));
  EXPECT_FALSE(all.is_open(objects[4], "its_id"));  // pinned
  EXPECT_FALSE(all.is_open(objects[5], "its_id"));
  EXPECT_TRUE(all.is_open(objects[0], "its_setup"));
  EXPECT_EQ(all.entries().size(), one.entries().size());
}

}  // namespace
}  // namespace capstan::model
