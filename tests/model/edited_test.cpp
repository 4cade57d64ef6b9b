#include "planner/model/plan/decision/edited.h"

#include <gtest/gtest.h>

#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/model.h"

namespace capstan::model {
namespace {

/// Technologies, each with a feed that the optimiser chose from the one before; `edited`: whose value is not
/// the one on record.
struct Chain {
  template <class Edited>
  Chain(std::size_t n, Edited&& edited) {
    const ReasonId why =
        ledger.reason({"limit.spindle_power", "the power held", "planner/physics/mechanics"});
    for (std::size_t i = 0; i < n; ++i) {
      MillingTechnology t;
      t.feedrate = 100.0;
      const DecisionKey key{model.add(t), "feedrate"};
      Decision d;
      d.binder = Binder::kOptimiser;
      d.reason = why;
      d.value_hash = hash_attribute(model, key.object, key.attribute) ^ (edited(i) ? 1U : 0U);
      if (!keys.empty()) d.depends_on = {keys.back()};
      ledger.set(key, d);
      keys.push_back(key);
    }
  }
  Model model;
  Ledger ledger;
  std::vector<DecisionKey> keys;
};

// A walk of the whole chain for each edit would pass 5e9 decisions.
TEST(EditsOfAPlan, AHundredThousandInOneChainAreTakenInTime) {
  constexpr std::size_t kAll = 100'000;
  Chain every(kAll, [](std::size_t) { return true; });
  const auto edits = take_edits(every.model, every.ledger);
  ASSERT_EQ(edits.size(), kAll);
  for (const Edited& e : edits) EXPECT_TRUE(e.opened.empty());
  // The first half edited: the second half was chosen from every one of them.
  Chain half(kAll, [](std::size_t i) { return i < kAll / 2; });
  const auto first = take_edits(half.model, half.ledger);
  ASSERT_EQ(first.size(), kAll / 2);
  std::size_t opened = 0;
  for (const Edited& e : first) opened += e.opened.size();
  EXPECT_EQ(opened, kAll / 2);
  // The second half edited: the first half's reasons speak of what was.
  Chain late(kAll, [](std::size_t i) { return i >= kAll / 2; });
  EXPECT_EQ(take_edits(late.model, late.ledger).size(), kAll / 2);
  EXPECT_EQ(late.ledger.reason(late.ledger.find(late.keys[0].object, "feedrate")->reason).id, kKept);
}

TEST(EditsOfAPlan, OpenWhatWasChosenFromThemAndKeepWhatTheyWereChosenFrom) {
  Chain chain(4, [](std::size_t i) { return i == 1; });
  const auto edits = take_edits(chain.model, chain.ledger);
  ASSERT_EQ(edits.size(), 1U);
  EXPECT_EQ(edits[0].opened, (std::vector{chain.keys[2], chain.keys[3]}));
  const auto at = [&](std::size_t i) -> const Decision& {
    return *chain.ledger.find(chain.keys[i].object, chain.keys[i].attribute);
  };
  EXPECT_EQ(at(0).state, DecisionState::kBound);
  EXPECT_EQ(chain.ledger.reason(at(0).reason).id, kKept);
  EXPECT_EQ(at(1).binder, Binder::kGiven);
  EXPECT_EQ(at(2).state, DecisionState::kOpen);
  EXPECT_EQ(at(3).state, DecisionState::kOpen);
}

// Three levels of curves, each ten thousand times the one below: a hash that followed each would see 1e12.
TEST(HashOfAValue, LooksThroughABoundedNumberOfReferences) {
  Model model;
  AnyRef curve = model.add(Polyline{});
  for (int level = 0; level < 3; ++level) {
    CompositeCurveSegment segment;
    segment.parent_curve = Ref<Curve>(curve);
    const auto one = model.add(segment);
    CompositeCurve composite;
    for (int i = 0; i < 10'000; ++i) composite.segments.push_back(one);
    curve = model.add(composite);
  }
  EXPECT_NE(hash_attribute(model, curve, "segments"), 0U);
}

}  // namespace
}  // namespace capstan::model
